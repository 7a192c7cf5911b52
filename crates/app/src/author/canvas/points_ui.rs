//! The authored points on the canvas.

mod compared_point;
mod fan;
mod names_ui;

use std::sync::Arc;

use egui::{
    CursorIcon, FontId, Key, Popup, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo,
    vec2,
};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Authored;
use shagreen_formats::project::AuthoredTexture;

use self::compared_point::{compared_point, compared_point_ui};
use self::fan::fanned;
use self::names_ui::names_ui;
use super::path_tool::PathTool;
use super::status_line::{moved_axis, played_point};
use super::{BIG_STEP, POINT_SIZE, SITE_RADIUS, move_to, point_id, site_radius};
use crate::author::authored_menu::{authored_keys, authored_menu};
use crate::author::whole_space::own_help;
use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::drag::dragged_to;
use crate::look::theme::Tokens;
use crate::look::tooltips::{Hint, is_learned, learn, may_appear};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, authored};

/// Step of an arrow key, in axis units (0 to 100). With Shift it is [`BIG_STEP`].
const STEP: f64 = 1.0;

/// Draws the authored points, the selected one on top. A click or drag selects another one. Points at one position fan
/// out around the first one. Names of points avoid the areas in `covered`.
pub(super) fn authored_points_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    covered: &[Rect],
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    if let Some(authored) = panel.session.authored() {
        outside_ui(ui, axes, panel, authored, t);
    }
    let textures = &panel.project.authored;
    let places: Vec<Pos2> = textures.iter().map(|texture| axes.ui_from_space(texture.at)).collect();
    let places = fanned(&places);
    for (index, (texture, pos)) in textures.iter().zip(&places).enumerate() {
        if index != panel.project.selected {
            commands.extend(other_point_ui(ui, axes, panel, (texture, *pos), tool, t));
        }
    }
    let selected = places.get(panel.project.selected);
    let selected = selected.copied().unwrap_or_else(|| axes.ui_from_space(panel.project.texture().at));
    commands.extend(point_ui(ui, axes, panel, selected, tool, t));
    names_ui(ui, point_radius(axes, true), panel, &places, covered, t);
    commands
}

/// Areas that the authored points cover, in the order of the project.
pub(super) fn point_areas(axes: Axes, panel: &Panel<'_>) -> Vec<Rect> {
    let textures = &panel.project.authored;
    let places: Vec<Pos2> = textures.iter().map(|texture| axes.ui_from_space(texture.at)).collect();
    let area = |(index, (texture, pos)): (usize, (&Arc<AuthoredTexture>, Pos2))| {
        let is_large = index == panel.project.selected || compared_point(panel, texture).is_some();
        let radius = if is_large { point_radius(axes, false) + RING } else { OTHER_RADIUS + OTHER_RING };
        Rect::from_center_size(pos, Vec2::splat(2.0 * radius))
    };
    textures.iter().zip(fanned(&places)).enumerate().map(area).collect()
}

/// Radius of a point that is neither selected nor compared, and widths of the rings around the points, in points.
const OTHER_RADIUS: f32 = 6.5;
const OTHER_RING: f32 = 2.0;
const RING: f32 = 2.5;
/// Width of the surface that the point shows, in mm.
const SHOWN_MM: f64 = 9.0;

/// Interaction of the authored points: only hovering while a path is drawn, so that clicks and drags reach the canvas.
fn point_sense(tool: &PathTool) -> Sense {
    if tool.is_on { Sense::hover() } else { Sense::click_and_drag() }
}

/// Draws an authored point that is not selected, at a position on the canvas.
fn other_point_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    (texture, pos): (&AuthoredTexture, Pos2),
    tool: &PathTool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let area = Rect::from_center_size(pos, vec2(20.0, 20.0));
    let response = ui.interact(area, point_id(texture.key), point_sense(tool));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, authored::on_canvas(&texture.name)));
    if response.clicked() || response.drag_started() {
        response.request_focus();
        commands.push(Command::Edit(Edit::Select(texture.key)));
    }
    // The drag goes on with the selected point.
    drag_offset(ui, &response, pos - axes.ui_from_space(texture.at));
    commands.extend(authored_keys(&response, panel, texture));
    commands.extend(authored_menu(&response, panel, texture));
    let is_pointed = response.hovered() || response.has_focus();
    if let Some(compared) = compared_point(panel, texture) {
        compared_point_ui(ui, pos, point_radius(axes, is_pointed), compared, t);
    } else {
        let radius = if is_pointed { 8.0 } else { OTHER_RADIUS };
        ui.painter().circle_filled(pos, radius + OTHER_RING, t.background);
        ui.painter().circle_filled(pos, radius, t.authored[usize::from(texture.color)]);
        ui.painter().circle_filled(pos, 2.5, t.background);
    }
    let mut help = point_help(panel, texture);
    if let Some(own) = own_help(panel, texture) {
        help = format!("{help}\n{own}");
    }
    response.on_hover_text(help);
    commands
}

/// Radius of the selected point, and of those that are compared, in points.
fn point_radius(axes: Axes, is_pointed: bool) -> f32 {
    let usual = if is_pointed { 13.0 } else { 11.0 };
    usual * site_radius(axes) / SITE_RADIUS
}

/// Draws the selected authored point at `pos` on the canvas, and handles its drags and arrow keys.
fn point_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    pos: Pos2,
    tool: &PathTool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let texture = panel.project.texture();
    let point = panel.session.fitted(texture.at);
    let id = point_id(texture.key);
    let response = ui.interact(Rect::from_center_size(pos, vec2(28.0, 28.0)), id, point_sense(tool));
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(strings::place_in_words(point, panel.session.poles())),
        ..WidgetInfo::labeled(Role::Slider, true, strings::POINT)
    });
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let offset = drag_offset(ui, &response, pos - axes.ui_from_space(point));
    if let Some(pointer) = dragged_to(ui, &response) {
        learn(ui.ctx(), Hint::DragPoint);
        commands.push(move_to(panel.on_slice(axes.space_from_ui(pointer - offset))));
    }
    commands.extend(authored_menu(&response, panel, texture));
    if let Some(to) = nudged(ui, id, point) {
        commands.push(move_to(to));
    }
    let grown = point_radius(axes, response.hovered() || response.dragged() || response.has_focus());
    if let Some(compared) = compared_point(panel, texture) {
        compared_point_ui(ui, pos, grown, compared, t);
    } else {
        selected_disc_ui(ui, pos, grown, panel, t);
    }
    if response.has_focus() {
        ui.painter().circle_stroke(pos, grown + 4.0, Stroke::new(1.5, t.accent));
    }
    // The point follows the pointer, so that its tooltip would stay open while it is dragged.
    if may_appear(ui.ctx()) {
        let mut help = point_help(panel, texture);
        if !is_learned(ui.ctx(), Hint::DragPoint) {
            help = format!("{help}\n{}", strings::POINT_HELP);
        }
        response.on_hover_text(help);
    }
    commands
}

/// Name and position of an authored texture. With more axes than the canvas shows, each coordinate is named.
fn point_help(panel: &Panel<'_>, texture: &AuthoredTexture) -> String {
    let at = panel.session.fitted(texture.at);
    if panel.session.is_sliced() {
        format!("{}\n{}", texture.name, strings::place_in_words(at, panel.session.poles()))
    } else {
        format!("{} {at}", texture.name)
    }
}

/// Offset of a point from its position when its drag began, in points; `now` is the present one. A point that is drawn beside
/// others at its position does not jump when it is dragged.
fn drag_offset(ui: &Ui, response: &Response, now: Vec2) -> Vec2 {
    let id = response.id.with("offset of the drag");
    ui.data_mut(|data| {
        if response.drag_started() {
            data.insert_temp(id, now);
        }
        data.get_temp(id).unwrap_or_default()
    })
}

/// Draws the disc of the selected point, with the surface at this point as on the pad, and the color of the texture.
fn selected_disc_ui(ui: &Ui, pos: Pos2, radius: f32, panel: &Panel<'_>, t: &Tokens) {
    let painter = ui.painter();
    painter.circle_filled(pos, radius + RING, t.background);
    painter.circle_filled(pos, radius, t.accent);
    if let Some((surface, [width_mm, height_mm])) = panel.pictures.surface() {
        let part = vec2((SHOWN_MM / width_mm) as f32, (SHOWN_MM / height_mm) as f32);
        let uv = Rect::from_min_size(Pos2::ZERO, part);
        let inner = Rect::from_center_size(pos, vec2(2.0, 2.0) * (radius - 2.5));
        let disc = egui::epaint::RectShape::filled(inner, radius - 2.5, egui::Color32::WHITE);
        painter.add(disc.with_texture(surface, uv));
    }
    painter.circle_filled(pos, 4.0, t.background);
    painter.circle_filled(pos, 3.0, t.authored[usize::from(panel.project.texture().color)]);
}

/// Draws lines from the audible point to the contributing textures.
pub(super) fn lines_to_parents(ui: &Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) {
    let Some(authored) = panel.session.authored() else { return };
    let on = axes.ui_from_space(authored.location.at);
    for ((texture, weight), color) in panel.session.shown_parents().iter().zip(t.parents) {
        if let Some(site) = panel.session.space().position(*texture) {
            let width = 1.0 + 4.0 * (*weight as f32).clamp(0.0, 1.0);
            let site = axes.ui_from_space(site);
            let start = site + (on - site).normalized() * site_radius(axes).min((on - site).length());
            ui.painter().line_segment([on, start], Stroke::new(width, color.gamma_multiply(0.75)));
        }
    }
}

/// Outside the convex hull: marks the nearest point of the hull that plays instead, or the distance of extrapolation.
fn outside_ui(ui: &Ui, axes: Axes, panel: &Panel<'_>, authored: &Authored, t: &Tokens) {
    let wanted = played_point(panel);
    let pos = axes.ui_from_space(wanted);
    let on = axes.ui_from_space(authored.location.at);
    let painter = ui.painter();
    if authored.is_extrapolated
        && let Some(nearest) = panel.session.space().locate(wanted)
    {
        let outline = axes.ui_from_space(nearest.at);
        painter.extend(Shape::dashed_line(&[outline, on], Stroke::new(2.0, t.accent), 8.0, 5.0));
        painter.circle_stroke(outline, 4.0, Stroke::new(1.5, t.accent));
        let words =
            painter.layout_no_wrap(strings::EXTRAPOLATED.to_owned(), FontId::proportional(11.5), t.accent);
        // Below the line, and not over the point at its end.
        let below = outline.lerp(on, 0.5) + vec2(0.0, 0.5 * words.size().y + 4.0);
        let area = Rect::from_center_size(below, words.size());
        let point = Rect::from_center_size(pos, POINT_SIZE);
        let overlap = if area.intersects(point) { point.bottom() - area.top() } else { 0.0 };
        let shift = (axes.rect.right() + 30.0 - area.right()).min(0.0);
        let area = area.translate(vec2(shift, overlap));
        painter.rect_filled(area.expand(2.0), 3.0, t.background.gamma_multiply(0.9));
        painter.galley(area.min, words, t.accent);
    }
    if moved_axis(panel, authored).is_some() {
        painter.extend(Shape::dashed_line(&[pos, on], Stroke::new(1.5, t.warning), 5.0, 4.0));
        painter.circle_filled(on, 4.0, t.warning);
    }
}

/// New position of the point after arrow keys, if it has the keyboard focus or nothing has.
fn nudged(ui: &Ui, id: egui::Id, from: SpacePoint) -> Option<SpacePoint> {
    let focused = ui.memory(egui::Memory::focused);
    if focused.is_some_and(|f| f != id) {
        return None;
    }
    // With the focus on the point, arrow keys move the point and not the focus. In an open menu they move the focus.
    let has_open_menu = Popup::is_any_open(ui.ctx());
    if focused == Some(id) {
        let (horizontal_arrows, vertical_arrows) = (!has_open_menu, !has_open_menu);
        let filter = egui::EventFilter { horizontal_arrows, vertical_arrows, ..Default::default() };
        ui.memory_mut(|m| m.set_focus_lock_filter(id, filter));
    }
    if has_open_menu {
        return None;
    }
    let (dx, dy) = ui.input(|i| {
        let step = if i.modifiers.shift { BIG_STEP } else { STEP };
        let count = |key: Key| f64::from(i.num_presses(key) as u32);
        (
            step * (count(Key::ArrowRight) - count(Key::ArrowLeft)),
            step * (count(Key::ArrowUp) - count(Key::ArrowDown)),
        )
    });
    (dx != 0.0 || dy != 0.0).then(|| from.with(0, from.x() + dx).with(1, from.y() + dy))
}
