//! Tool that draws a path through the space, with the path, its points and its controls.

use std::sync::Arc;

use egui::{
    Align2, Button, Color32, ComboBox, CursorIcon, DragValue, FontId, Galley, Key, Label, Pos2, Rect,
    Response, RichText, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2,
};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::{Along, AtEnd, MAX_KEYS};
use shagreen_core::space::texture_path::{LEAST_STEP, UserPath};

use super::site_labels::backing_ui;
use crate::author::context_menu::had_open_menu;
use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::drag::dragged_to;
use crate::look::list::ShowList as _;
use crate::look::plot::short;
use crate::look::theme::{Tokens, tokens};
use crate::look::together::together_ui;
use crate::panel::Panel;
use crate::state::edit::{Edit, PathChange};
use crate::strings::path as strings;

/// Half the side of the area that grabs a path point, in points.
const GRAB: f32 = 8.0;
/// Ranges of the path length, in mm and in s.
const LENGTHS_MM: std::ops::RangeInclusive<f64> = 5.0..=5000.0;
const LENGTHS_SECS: std::ops::RangeInclusive<f64> = 0.2..=120.0;

/// Path tool, with the line that the pointer is drawing.
#[derive(Clone, Debug, Default)]
pub struct PathTool {
    /// Whether clicks and drags on the canvas draw a path.
    pub is_on: bool,
    line: Vec<SpacePoint>,
}

impl PathTool {
    /// Turns the tool on or off.
    pub fn toggle(&mut self) {
        self.is_on = !self.is_on;
        self.line.clear();
    }

    /// Turns the tool off.
    pub(crate) fn leave(&mut self) {
        *self = Self::default();
    }

    /// Handles the pointer on the background: a drag draws a new path, a click adds a point.
    pub(super) fn follow(
        &mut self,
        ui: &Ui,
        axes: Axes,
        panel: &Panel<'_>,
        background: &Response,
    ) -> Option<Command> {
        if background.drag_started() {
            let begin = ui.input(|i| i.pointer.press_origin());
            self.line = begin.map(|pos| panel.on_slice(axes.space_from_ui(pos))).into_iter().collect();
        }
        // A click beside an open menu only closes it.
        if background.clicked()
            && !had_open_menu(ui.ctx())
            && let Some(pos) = background.interact_pointer_pos()
        {
            return added(panel, panel.on_slice(axes.space_from_ui(pos)));
        }
        let at = panel.on_slice(axes.space_from_ui(dragged_to(ui, background)?));
        if self.line.last().is_none_or(|last| last.distance(at) >= LEAST_STEP) {
            self.line.push(at);
        }
        let path = drawn(panel).drawn(&self.line);
        (self.line.len() > 1).then(|| change(PathChange::Draw, Some(path)))
    }
}

fn change(what: PathChange, path: Option<UserPath>) -> Command {
    Command::Edit(Edit::ChangePath(what, path))
}

/// Path of the selected texture, or an empty one.
fn drawn(panel: &Panel<'_>) -> UserPath {
    panel.project.texture().path.clone().unwrap_or_default()
}

/// Command that adds a point at the end of the path. `None` if the path is full or the point is too close to its end.
pub(super) fn added(panel: &Panel<'_>, at: SpacePoint) -> Option<Command> {
    let mut path = drawn(panel);
    let is_further = path.points.last().is_none_or(|last| last.distance(at) >= LEAST_STEP);
    if path.points.len() >= MAX_KEYS || !is_further {
        return None;
    }
    path.points.push(at);
    Some(change(PathChange::AddPoint, Some(path)))
}

/// Draws the path with arrows in its direction.
pub(super) fn path_line(ui: &Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) {
    let Some(path) = &panel.project.texture().path else { return };
    let painter = ui.painter();
    let points: Vec<Pos2> = path.points.iter().map(|p| axes.ui_from_space(*p)).collect();
    painter.add(Shape::line(points.clone(), Stroke::new(6.0, t.background)));
    painter.add(Shape::line(points.clone(), Stroke::new(2.5, t.text)));
    for pair in points.windows(2) {
        let (way, middle) = (pair[1] - pair[0], pair[0].lerp(pair[1], 0.5));
        if way.length() > 24.0 {
            let (forward, side) = (6.0 * way.normalized(), 4.5 * way.normalized().rot90());
            let arrow = vec![middle + forward, middle - forward + side, middle - forward - side];
            painter.add(Shape::convex_polygon(arrow, t.text, Stroke::new(1.0, t.background)));
        }
    }
}

/// Draws the current position of the stroke on the path.
pub(super) fn path_marker(ui: &Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) {
    let Some(at) = panel.session.path_point() else { return };
    let at = axes.ui_from_space(at);
    let corners = |r: f32| vec![at + vec2(0.0, -r), at + vec2(r, 0.0), at + vec2(0.0, r), at + vec2(-r, 0.0)];
    ui.painter().add(Shape::convex_polygon(corners(11.0), t.background, Stroke::NONE));
    ui.painter().add(Shape::convex_polygon(corners(9.0), t.accent, Stroke::NONE));
}

/// Areas of the numbers of the path points, which are shown while the tool is on.
pub(super) fn number_areas(ui: &Ui, axes: Axes, panel: &Panel<'_>, tool: &PathTool) -> Vec<Rect> {
    let path = panel.project.texture().path.as_ref().filter(|_| tool.is_on);
    let points = path.into_iter().flat_map(|path| path.points.iter().enumerate());
    points.map(|(i, point)| number_of_point(ui, i + 1, axes.ui_from_space(*point)).1).collect()
}

/// Number of a path point at `pos`, and its area on the screen.
fn number_of_point(ui: &Ui, number: usize, pos: Pos2) -> (Arc<Galley>, Rect) {
    let font = FontId::proportional(10.5);
    let galley = ui.painter().layout_no_wrap(number.to_string(), font, Color32::PLACEHOLDER);
    let area = Align2::LEFT_BOTTOM.anchor_size(pos + vec2(9.0, -9.0), galley.size());
    (galley, area)
}

/// Draws the path points. While the tool is on, they can be moved and deleted.
pub(super) fn path_points(
    ui: &Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let Some(path) = &panel.project.texture().path else { return commands };
    for (i, point) in path.points.iter().enumerate() {
        let pos = axes.ui_from_space(*point);
        if !tool.is_on {
            ui.painter().circle_filled(pos, 3.0, t.text);
            continue;
        }
        let area = Rect::from_center_size(pos, vec2(2.0 * GRAB, 2.0 * GRAB));
        let response = ui.interact(area, ui.scope_id().with(("path point", i)), Sense::click_and_drag());
        let name = strings::point(i + 1);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
        if response.drag_started() || response.clicked() {
            response.request_focus();
        }
        let mut changed = path.clone();
        if let Some(to) = dragged_to(ui, &response) {
            changed.points[i] = panel.session.fitted(*point).on_canvas_at(axes.space_from_ui(to));
            commands.push(change(PathChange::MovePoint, Some(changed)));
        } else {
            let is_deleted = response.has_focus()
                && ui.input_mut(|i| {
                    let none = egui::Modifiers::NONE;
                    i.consume_key(none, Key::Delete) || i.consume_key(none, Key::Backspace)
                });
            if response.secondary_clicked() || is_deleted {
                changed.points.remove(i);
                let left = (!changed.points.is_empty()).then_some(changed);
                commands.push(change(PathChange::DeletePoint, left));
            }
        }
        let is_pointed = response.hovered() || response.dragged() || response.has_focus();
        let radius = if is_pointed { 7.0 } else { 5.5 };
        ui.painter().circle_filled(pos, radius, t.background);
        ui.painter().circle_stroke(pos, radius, Stroke::new(2.0, if is_pointed { t.accent } else { t.text }));
        let (number, area) = number_of_point(ui, i + 1, pos);
        backing_ui(ui.painter(), area, t);
        ui.painter().galley(area.min, number, t.text);
        response.on_hover_text(format!("{name}\n{}", strings::POINT_HELP));
    }
    commands
}

/// Draws the settings and actions of a path in a wrapped row; returns the requested commands. What belongs together stays in one
/// row.
pub(super) fn path_settings_ui(ui: &mut Ui, panel: &Panel<'_>, path: &UserPath) -> Vec<Command> {
    let mut commands = Vec::new();
    let is_playing = panel.session.is_path_playing();
    let can_play = path.route().is_some();
    let play = Button::new(if is_playing { strings::STOP } else { strings::PLAY }).selected(is_playing);
    if ui.add_enabled(can_play, play).on_hover_text(strings::PLAY_HELP).clicked() {
        commands.push(Command::PlayPath(!is_playing));
    }
    commands.extend(together_ui(ui, "path progress", |ui| progress_ui(ui, path)));
    commands.extend(together_ui(ui, "path end", |ui| end_ui(ui, path)));
    let mode = panel.session.blend_in_space(&panel.project.texture().blend).mode;
    let can_keep = can_play && mode.makes_a_model() && !panel.session.is_preparing();
    together_ui(ui, "path actions", |ui| {
        let keep = ui.add_enabled(can_keep, Button::new(strings::KEEP));
        if keep.on_hover_text(strings::KEEP_HELP).on_disabled_hover_text(strings::CANNOT_KEEP).clicked() {
            commands.push(Command::KeepPath);
        }
        if ui.button(strings::CLEAR).on_hover_text(strings::CLEAR_HELP).clicked() {
            commands.push(change(PathChange::Clear, None));
        }
    });
    commands
}

/// Draws the label of a list.
fn label_ui(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false));
}

/// Draws what the texture follows along the path, and how far it goes; returns the requested commands.
fn progress_ui(ui: &mut Ui, path: &UserPath) -> Vec<Command> {
    let mut commands = Vec::new();
    label_ui(ui, strings::ALONG_LABEL);
    let name = |along: Along| if along == Along::Distance { strings::DISTANCE } else { strings::TIME };
    let combo = ComboBox::from_id_salt("path along").width(76.0).selected_text(name(path.along));
    let shown = combo.show_list(ui, |ui| {
        for along in Along::ALL {
            if ui.selectable_label(path.along == along, name(along)).clicked() {
                commands.push(change(PathChange::Along, Some(UserPath { along, ..path.clone() })));
            }
        }
    });
    shown.response.accessible_name(strings::ALONG).on_hover_text(strings::ALONG_HELP);
    let mut changed = path.clone();
    let (factor, unit) = path.along.unit();
    let (value, range) = match path.along {
        Along::Distance => (&mut changed.length_m, LENGTHS_MM),
        Along::Time => (&mut changed.length_secs, LENGTHS_SECS),
    };
    let mut shown = *value / factor;
    let speed = 0.01 * shown.max(1.0);
    // The same text at every scale of the window.
    let written = |value: f64, _| short((10.0 * value).round() / 10.0);
    let length = DragValue::new(&mut shown).range(range).speed(speed).max_decimals(1);
    let length = length.custom_formatter(written).suffix(format!(" {unit}"));
    let length = ui.add(length).accessible_name(strings::LENGTH).on_hover_text(strings::LENGTH_HELP);
    if length.changed() {
        *value = shown * factor;
        commands.push(change(PathChange::Length, Some(changed)));
    }
    commands
}

/// Draws what happens at the end of the path; returns the requested commands.
fn end_ui(ui: &mut Ui, path: &UserPath) -> Vec<Command> {
    let mut commands = Vec::new();
    label_ui(ui, strings::AT_END_LABEL);
    let combo = ComboBox::from_id_salt("path end").width(84.0).selected_text(end_name(path.at_end));
    let shown = combo.show_list(ui, |ui| {
        for at_end in AtEnd::ALL {
            if ui.selectable_label(path.at_end == at_end, end_name(at_end)).clicked() {
                commands.push(change(PathChange::AtEnd, Some(UserPath { at_end, ..path.clone() })));
            }
        }
    });
    shown.response.accessible_name(strings::AT_END).on_hover_text(strings::AT_END_HELP);
    commands
}

fn end_name(at_end: AtEnd) -> &'static str {
    match at_end {
        AtEnd::Hold => strings::HOLD,
        AtEnd::Turn => strings::TURN,
        AtEnd::Repeat => strings::REPEAT,
    }
}
