//! List of the authored textures and their snapshots.

use egui::{
    Button, Id, Label, Rect, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2,
    vec2,
};
use shagreen_core::space::{MIDDLE, SpacePoint};
use shagreen_formats::project::AuthoredTexture;
use shagreen_studio::axes::axis_poles;

use crate::author::authored_menu::{authored_keys, authored_menu};
use crate::author::compare_ui::compare_ui;
use crate::author::context_menu::context_menu;
use crate::author::new_texture::{fresh, of_snapshot};
use crate::author::renamed_row::{begin_rename, is_renamed, rename_ui};
use crate::author::whole_space::own_help;
use crate::command::Command;
use crate::look::theme::{RADIUS, SCROLL_BAR_ROOM, tokens};
use crate::panel::Panel;
use crate::state::edit::{Edit, name_of_snapshot};
use crate::strings::{self, authored as words, compare};

/// Height of a row, in points.
const ROW: f32 = 22.0;
/// Height of a snapshot button, in points.
const CHIP: f32 = 18.0;
/// Number of rows of the list in a small and in a large window, if it has that many.
const N_ROWS: [f32; 2] = [3.0, 12.0];
/// Maximum share of the column height that the list takes.
const LIST_SHARE: f32 = 0.21;
/// Center of the canvas.
const CENTER: SpacePoint = SpacePoint::plane(MIDDLE, MIDDLE);

/// Draws the list; returns the requested commands.
pub(crate) fn authored_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(words::HEADING).heading()).selectable(false))
            .on_hover_text(words::HELP);
        ui.add(
            Label::new(RichText::new(panel.project.authored.len().to_string()).color(t.text_weak))
                .selectable(false),
        );
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.button(words::ADD).on_hover_text(words::ADD_HELP).clicked() {
                // Its name is selected, so that typing replaces it.
                let added = Command::Edit(Edit::Author(Box::new(fresh(panel, CENTER))));
                commands.extend([added, Command::RenameSelected]);
            }
        });
    });
    let n_rows = rows_in(ui.available_height());
    let is_scrolled = panel.project.authored.len() as f32 > n_rows;
    let is_other = selected_another(ui, panel.project.texture().key);
    let area = ScrollArea::vertical().id_salt("authored").auto_shrink([false, true]);
    area.max_height(n_rows * ROW).show(ui, |ui| {
        if is_scrolled {
            ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        for (index, texture) in panel.project.authored.iter().enumerate() {
            let is_selected = index == panel.project.selected;
            let top = ui.cursor().left_top();
            commands.extend(row(ui, panel, texture, is_selected));
            if is_selected && is_other {
                // The selection may have changed elsewhere: on the canvas, by a prompt, or by undo.
                ui.scroll_to_rect(Rect::from_min_size(top, vec2(0.0, ROW)), None);
            }
        }
    });
    ui.add_space(2.0);
    commands.extend(snapshots_ui(ui, panel));
    ui.add_space(2.0);
    commands.extend(compare_ui(ui, panel));
    commands
}

/// Number of rows of the list in a column of this height, in points. No row is partly visible.
fn rows_in(height: f32) -> f32 {
    (LIST_SHARE * height / ROW).floor().clamp(N_ROWS[0], N_ROWS[1])
}

/// Whether the selection has changed since the list was last drawn.
fn selected_another(ui: &Ui, key: u32) -> bool {
    let id = Id::unique("selected authored texture");
    ui.data_mut(|data| {
        let before = data.get_temp(id);
        data.insert_temp(id, key);
        before != Some(key)
    })
}

fn row(ui: &mut Ui, panel: &Panel<'_>, texture: &AuthoredTexture, is_selected: bool) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    // In a comparison, another texture than the selected one is audible. In a blind one, nothing tells which.
    let is_marked = !panel.compare.is_hidden() && panel.inspected().key == texture.key;
    response
        .widget_info(|| WidgetInfo::selected(Role::Button, true, is_marked, words::select(&texture.name)));
    if is_marked {
        ui.painter().rect_filled(area, f32::from(RADIUS), t.chosen);
    } else if is_selected {
        let outline = Stroke::new(1.5, t.chosen);
        ui.painter().rect_stroke(area, f32::from(RADIUS), outline, StrokeKind::Inside);
    } else if response.hovered() || response.has_focus() || response.context_menu_opened() {
        ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
    }
    let dot = pos2(area.left() + 11.0, area.center().y);
    ui.painter().circle_filled(dot, 6.5, t.background);
    ui.painter().circle_filled(dot, 5.0, t.authored[usize::from(texture.color)]);
    let mut room = Rect::from_min_max(pos2(area.left() + 24.0, area.top() + 2.0), area.max);
    let color = if is_marked { t.on_chosen } else { t.text };
    if let Some(side) = panel.compare.side_of(texture.key) {
        let corner = pos2(area.right() - 5.0, area.center().y);
        let font = egui::FontId::proportional(11.5);
        ui.painter().text(corner, egui::Align2::RIGHT_CENTER, side.letter(), font, color);
        room.max.x -= 16.0;
    }
    if is_selected && is_renamed(ui, texture.key) {
        commands.extend(rename_ui(ui, room, texture));
    } else {
        let mut name = ui.new_child(egui::UiBuilder::new().max_rect(room));
        let shown = if texture.name.trim().is_empty() { words::UNNAMED } else { &texture.name };
        let label = Label::new(RichText::new(shown).color(color)).truncate().selectable(false);
        // The tooltip of the row has the whole name.
        name.add(label.show_tooltip_when_elided(false));
    }
    if response.clicked() {
        commands.push(Command::Edit(Edit::Select(texture.key)));
    }
    if response.double_clicked() {
        begin_rename(ui, texture);
    }
    commands.extend(authored_keys(&response, panel, texture));
    commands.extend(authored_menu(&response, panel, texture));
    let mut help =
        format!("{}\n{}", texture.name, strings::place_in_words(texture.at, panel.session.poles()));
    let own = own_help(panel, texture).unwrap_or_default();
    let selected = if is_selected && !is_marked { compare::SELECTED } else { "" };
    for more in [texture.tags.join(", ").as_str(), &texture.notes, own, selected] {
        if !more.is_empty() {
            help = format!("{help}\n{more}");
        }
    }
    response.on_hover_text(help);
    commands
}

/// Row of snapshot buttons: numbers in the colors of their textures.
fn snapshots_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let height = std::mem::replace(&mut ui.spacing_mut().interact_size.y, CHIP);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 3.0);
        ui.spacing_mut().button_padding = vec2(5.0, 1.0);
        let keep = Button::new(RichText::new(words::KEEP).small());
        if ui.add(keep).on_hover_text(words::KEEP_HELP).clicked() {
            commands.push(Command::Edit(Edit::KeepSnapshot));
        }
        for (index, snapshot) in panel.project.snapshots.iter().enumerate() {
            let color = t.authored[usize::from(snapshot.color)];
            let chip = Button::new(RichText::new((index + 1).to_string()).small().color(color));
            let name = words::snapshot(index + 1, &snapshot.name);
            let response = ui.add(chip).accessible_name(&name);
            if response.clicked() {
                commands.push(Command::Edit(Edit::RestoreSnapshot(index)));
            }
            context_menu(&response, |ui| {
                if ui.button(words::AS_OWN).on_hover_text(words::AS_OWN_HELP).clicked() {
                    commands.push(Command::Edit(Edit::Author(Box::new(of_snapshot(
                        panel,
                        snapshot,
                        index + 1,
                    )))));
                }
                if ui.button(words::delete_snapshot(index + 1)).clicked() {
                    commands.push(Command::Edit(Edit::RemoveSnapshot(index)));
                }
            });
            // It may have been taken on other axes.
            let own: Option<Vec<[String; 2]>> =
                snapshot.axes.as_ref().map(|axes| axes.iter().map(|axis| axis_poles(axis)).collect());
            let poles = own.as_deref().unwrap_or(panel.session.poles());
            let place = strings::place_in_words(snapshot.at, poles);
            let is_there = panel.project.authored.iter().any(|texture| texture.key == snapshot.key);
            let effect = words::restore_help(name_of_snapshot(panel.project, index), is_there);
            response.on_hover_text(format!("{name}\n{place}\n{effect}\n{}", words::SNAPSHOTS_HELP));
        }
    });
    ui.spacing_mut().interact_size.y = height;
    commands
}

#[cfg(test)]
mod tests {
    use super::rows_in;

    #[test]
    fn the_list_shows_whole_rows() {
        for (height, n_rows) in [(0.0, 3.0), (430.0, 4.0), (620.0, 5.0), (3000.0, 12.0)] {
            assert_eq!(rows_in(height), n_rows, "{height}");
        }
    }
}
