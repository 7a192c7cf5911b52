//! Inspector of an authored texture: name, sliders, interpolation mode, shape and contributions.
//!
//! It shows the selected texture. While a comparison plays another one, it shows that one, which cannot be edited: edits
//! apply to the selected texture.

use egui::{Label, Rect, RichText, Role, Sense, TextEdit, Ui, WidgetInfo, vec2};

use crate::author::axis_sliders::axis_sliders;
use crate::author::blend_choice::blend_ui;
use crate::author::details::details_ui;
use crate::author::locks::lock_button;
use crate::author::lost_pins::lost_pins_ui;
use crate::author::shape_ui::shape_ui;
use crate::author::solo::solo_button;
use crate::author::texture_picture::picture_ui;
use crate::command::Command;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::theme::{GAP, GROUP_GAP, RADIUS, tokens};
use crate::panel::Panel;
use crate::session::N_SHOWN_PARENTS;
use crate::state::compare::{CompareCommand, Side};
use crate::state::edit::Edit;
use crate::strings::{self, compare as words};

/// Height of the bar of all contributing textures, in points.
const SHARES_HEIGHT: f32 = 6.0;
/// Height of the heading of the contributions, in points.
const HEADING_HEIGHT: f32 = 18.0;
/// Height of the card of a contributing texture, in points: three of them fit into a window of 1280 by 720.
const CARD_HEIGHT: f32 = 36.0;
/// Maximum number of cards, in a window with room for them.
const MAX_CARDS: usize = 8;
/// Distance between cards, in points.
const CARD_GAP: f32 = 4.0;
/// Margin of the panel on the right, in points.
const PANEL_MARGIN: f32 = 8.0;
/// Distance between the content and the scroll bar at its widest, in points.
const BAR_GAP: f32 = 2.0;
/// Distance of the picture from the edges of its card, in points.
const PICTURE_MARGIN: f32 = 3.0;

/// Widget id of the field with the name of the texture.
pub(crate) fn name_field() -> egui::Id {
    egui::Id::unique("name of the authored texture")
}

/// Draws the inspector; returns the requested commands.
pub fn inspector_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let height = ui.available_height();
    // The scroll bar lies in the margin of the panel, or it would cover the buttons on the right.
    let inside = ui.available_rect_before_wrap();
    let outside = Rect::from_min_max(inside.min, inside.max + vec2(PANEL_MARGIN, 0.0));
    let layout = egui::Layout::top_down(egui::Align::Min);
    let mut wide = ui.new_child(egui::UiBuilder::new().max_rect(outside).layout(layout));
    let area = egui::ScrollArea::vertical().auto_shrink(false);
    let shown = area.show(&mut wide, |ui| {
        ui.set_max_width(outside.width() - ui.spacing().scroll.bar_width - BAR_GAP);
        let commands = content_ui(ui, panel, height);
        scroll_to_focus(ui);
        commands
    });
    shown.inner
}

/// Draws the content of an inspector of this height, in points.
fn content_ui(ui: &mut Ui, panel: &Panel<'_>, height: f32) -> Vec<Command> {
    let mut commands = Vec::new();
    let bottom = ui.cursor().top() + height;
    ui.add_space(GAP);
    if let Some(side) = panel.compare.heard() {
        commands.extend(compared_ui(ui, panel, side));
        if panel.compare.is_hidden() {
            let help = RichText::new(words::HIDDEN_HELP).color(tokens(ui.ctx()).text_weak);
            ui.add(Label::new(help).wrap().selectable(false));
            return commands;
        }
    }
    let asked = ui.add_enabled_ui(panel.can_edit(), |ui| settings_ui(ui, panel)).inner;
    if panel.can_edit() {
        // A screen reader may set a slider that is not enabled.
        commands.extend(asked);
    }
    ui.add_space(GROUP_GAP);
    let room = bottom - ui.cursor().top();
    commands.extend(parents_ui(ui, panel, room));
    commands
}

/// Draws which side of the comparison is audible, with a button that ends the comparison. It selects the audible texture,
/// unless the comparison is blind.
fn compared_ui(ui: &mut Ui, panel: &Panel<'_>, side: Side) -> Option<Command> {
    let mut asked = None;
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, egui::Layout::right_to_left(egui::Align::Center), |ui| {
        let texture = panel.inspected();
        let is_hidden = panel.compare.is_hidden();
        let (name, help) =
            if is_hidden { (words::END, words::END_HELP) } else { (words::EDIT, words::EDIT_HELP) };
        if ui.button(name).on_hover_text(help).clicked() {
            // To select the audible texture ends the comparison, like every edit.
            asked = Some(if is_hidden || panel.can_edit() {
                Command::Compare(CompareCommand::Hear(side))
            } else {
                Command::Edit(Edit::Select(texture.key))
            });
        }
        let said =
            if is_hidden { words::HIDDEN.to_owned() } else { words::you_hear(side.letter(), &texture.name) };
        ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
            let text = RichText::new(&said).color(tokens(ui.ctx()).accent);
            ui.add(Label::new(text).truncate().selectable(false)).on_hover_text(&said);
        });
    });
    ui.add_space(GAP);
    asked
}

/// Draws the name, the sliders, the interpolation mode and the shape.
fn settings_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    let mut name = panel.inspected().name.clone();
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, egui::Layout::right_to_left(egui::Align::Center), |ui| {
        commands.extend(details_ui(ui, panel));
        let field =
            TextEdit::singleline(&mut name).font(egui::TextStyle::Heading).desired_width(f32::INFINITY);
        let field = ui.add(field.id(name_field()));
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, strings::NAME));
        if field.changed() {
            commands.push(Command::Edit(Edit::Rename(name)));
        }
    });
    ui.add_space(GAP);
    commands.extend(axis_sliders(ui, panel));
    ui.add_space(GROUP_GAP);
    commands.extend(blend_ui(ui, panel));
    lost_pins_ui(ui, panel);
    commands.extend(shape_ui(ui, panel));
    commands
}

/// Draws the contributing textures with pictures and weights, and a summary of those without a card, in `room` points of
/// height or more.
fn parents_ui(ui: &mut Ui, panel: &Panel<'_>, room: f32) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let heading = HEADING_HEIGHT + SHARES_HEIGHT + 2.0 * ui.spacing().item_spacing.y;
    let parents = parents_with_cards(panel, room - heading);
    let row = vec2(ui.available_width(), HEADING_HEIGHT);
    ui.allocate_ui_with_layout(row, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.add(Label::new(RichText::new(strings::PARENTS).strong()).selectable(false))
            .on_hover_text(strings::PARENTS_HELP);
        let Some(rest) = besides(panel, parents.len()) else { return };
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let text = RichText::new(&rest).small().color(t.text_weak);
            ui.add(Label::new(text).truncate().selectable(false)).on_hover_text(strings::PARENTS_HELP);
        });
    });
    shares_ui(ui, panel);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = CARD_GAP;
        for (rank, parent) in parents.into_iter().enumerate() {
            let color = t.parents.get(rank).copied().unwrap_or(t.text_weak);
            commands.extend(card(ui, panel, parent, color));
        }
    });
    commands
}

/// Library indices and weights of the contributing textures with cards: those with colors of their own, then as many others
/// as fit into `room` points of height.
fn parents_with_cards(panel: &Panel<'_>, room: f32) -> Vec<(usize, f64)> {
    let parents = panel.session.parents();
    let fitting = ((room + CARD_GAP) / (CARD_HEIGHT + CARD_GAP)).max(0.0) as usize;
    // A weight that would be displayed as 0.0 % gets no card. In a field, distant textures contribute negatively.
    let is_worthwhile = |(rank, (_, weight)): &(usize, &(usize, f64))| {
        let size = if *rank < N_SHOWN_PARENTS { weight.abs() } else { *weight };
        size >= 5e-4
    };
    let worthwhile = parents.iter().enumerate().filter(is_worthwhile).map(|(_, parent)| *parent);
    worthwhile.take(fitting.clamp(N_SHOWN_PARENTS, MAX_CARDS)).collect()
}

/// Draws one bar of all contributing textures: those with cards in their colors, all others together in gray. A field
/// has small negative weights too, so shares are of the sum of magnitudes.
fn shares_ui(ui: &mut Ui, panel: &Panel<'_>) {
    let t = tokens(ui.ctx());
    let Some(authored) = panel.session.authored() else { return };
    let sum: f64 = authored.parents.iter().map(|(_, weight)| weight.abs()).sum();
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), SHARES_HEIGHT), Sense::hover());
    ui.painter().rect_filled(area, 3.0, t.text_weak.gamma_multiply(0.45));
    let mut left = area.left();
    for ((_, weight), color) in panel.session.shown_parents().iter().zip(t.parents) {
        let right = left + area.width() * (weight.abs() / sum.max(f64::MIN_POSITIVE)) as f32;
        let part = Rect::from_min_max(egui::pos2(left, area.top()), egui::pos2(right, area.bottom()));
        ui.painter().rect_filled(part, 0.0, color);
        left = right;
    }
}

/// Weight of the pinned texture, or else the number of the contributing textures without one of the `n_cards` cards.
fn besides(panel: &Panel<'_>, n_cards: usize) -> Option<String> {
    let authored = panel.session.authored()?;
    if let Some((texture, share)) = authored.lock.filter(|_| panel.solo().is_none()) {
        return Some(strings::locked_share(&panel.session.textures()[texture].name, 100.0 * share));
    }
    let n_named = n_cards.max(panel.session.shown_parents().len());
    let n_rest = authored.parents.len().saturating_sub(n_named);
    (n_rest > 0).then(|| strings::more_parents(n_rest))
}

/// Card of a contributing texture. With the texture that can be edited, it has a solo button and, in the Field mode, a pin
/// button.
fn card(
    ui: &mut Ui,
    panel: &Panel<'_>,
    (texture, weight): (usize, f64),
    color: egui::Color32,
) -> Option<Command> {
    let t = tokens(ui.ctx());
    let entry = &panel.session.textures()[texture];
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), CARD_HEIGHT), Sense::hover());
    let percent = 100.0 * weight;
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::parent(&entry.name, percent)));
    ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
    let side = CARD_HEIGHT - 2.0 * PICTURE_MARGIN;
    let picture = Rect::from_min_size(area.min + vec2(PICTURE_MARGIN, PICTURE_MARGIN), vec2(side, side));
    picture_ui(ui, panel, texture, picture);
    ui.painter().rect_stroke(
        picture,
        f32::from(RADIUS) - 1.0,
        egui::Stroke::new(2.0, color),
        egui::StrokeKind::Outside,
    );
    let left = picture.right() + 10.0;
    let right = area.right() - 10.0;
    let font = egui::FontId::proportional(14.0);
    let number = ui.painter().text(
        egui::pos2(right, area.top() + 4.0),
        egui::Align2::RIGHT_TOP,
        format!("{percent:.1} %"),
        font,
        t.text,
    );
    // The pin button does not move with the width of the number.
    let button = Rect::from_center_size(egui::pos2(right - 66.0, number.center().y), vec2(22.0, 22.0));
    let can_edit = panel.can_edit();
    let can_lock = can_edit && panel.can_lock() && panel.solo().is_none();
    let mut command = if can_lock { lock_button(ui, panel, texture, button) } else { None };
    let solo = button.translate(vec2(-24.0, 0.0));
    if can_edit {
        command = command.or(solo_button(ui, panel, texture, solo));
    }
    let end = solo.left() - 4.0;
    let mut name = ui.new_child(
        egui::UiBuilder::new()
            .max_rect(Rect::from_min_max(egui::pos2(left, area.top() + 3.0), egui::pos2(end, area.bottom()))),
    );
    name.add(Label::new(RichText::new(&entry.name).color(color)).truncate().selectable(false));
    let bar =
        Rect::from_min_max(egui::pos2(left, area.bottom() - 10.0), egui::pos2(right, area.bottom() - 5.0));
    ui.painter().rect_filled(bar, 3.0, t.control);
    let share = (weight as f32).clamp(0.0, 1.0);
    let filled = Rect::from_min_size(bar.min, vec2(bar.width() * share, bar.height()));
    ui.painter().rect_filled(filled, 3.0, color);
    command
}
