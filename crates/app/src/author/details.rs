//! Details of an authored texture: color, tags, notes and picture.

use std::sync::Arc;

use egui::{
    Align, Button, DragValue, Label, Layout, PopupCloseBehavior, RichText, Role, Sense, TextEdit, Ui,
    WidgetInfo, containers::menu, vec2,
};

use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;

use crate::author::new_texture::copy_of;
use crate::command::Command;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{authored as words, relief};

/// Width of the menu, in points.
const WIDTH: f32 = 230.0;
/// Range of the surface width that a picture shows, in mm.
const WIDTHS_MM: std::ops::RangeInclusive<f64> = 1.0..=2000.0;
/// Side of a color swatch, in points.
const SWATCH: f32 = 22.0;

/// Draws the button that opens the details; returns the requested commands.
pub(crate) fn details_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    let config = menu::MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let button = menu::MenuButton::new(words::DETAILS).config(config);
    let (response, _) = button.ui(ui, |ui| {
        ui.set_width(WIDTH);
        // A menu is justified, which would tear sentences apart.
        ui.vertical(|ui| commands.extend(content_ui(ui, panel)));
    });
    response.on_hover_text(words::DETAILS_HELP);
    commands
}

fn content_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let texture = panel.project.texture();
    let mut commands = Vec::new();
    // Without a fill, a button of a menu looks like text.
    let button = |text: &'static str| Button::new(text).fill(t.control);
    let heading = |ui: &mut Ui, text: &str| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
    };
    heading(ui, words::COLOR);
    commands.extend(colors_ui(ui, texture.color));
    heading(ui, words::TAGS);
    let id = ui.scope_id().with("tags");
    // The text stays as typed: an incomplete tag must not vanish while it is being typed.
    let mut tags = ui.data_mut(|data| data.get_temp(id)).unwrap_or_else(|| texture.tags.join(", "));
    let field = TextEdit::singleline(&mut tags).hint_text(words::TAGS_HINT).desired_width(f32::INFINITY);
    let field = ui.add(field).accessible_name(words::TAGS);
    if field.changed() {
        commands.push(Command::Edit(Edit::SetTags(tags_in(&tags))));
    }
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, tags));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    heading(ui, words::NOTES);
    let mut notes = texture.notes.clone();
    let field = TextEdit::multiline(&mut notes)
        .hint_text(words::NOTES_HINT)
        .desired_rows(4)
        .desired_width(f32::INFINITY);
    if ui.add(field).accessible_name(words::NOTES).changed() {
        commands.push(Command::Edit(Edit::SetNotes(notes)));
    }
    heading(ui, words::PICTURE);
    commands.extend(picture_ui(ui, texture));
    if ui.add(button(relief::MENU)).on_hover_text(relief::MENU_HELP).clicked() {
        let of = Some(ReliefOf::Authored(texture.key));
        commands.push(Command::Relief(ReliefCommand::Begin(of, None)));
        ui.close();
    }
    ui.add_space(GAP);
    ui.separator();
    ui.horizontal(|ui| {
        if ui.add(button(words::DUPLICATE)).on_hover_text(words::DUPLICATE_HELP).clicked() {
            commands.push(Command::Edit(Edit::Author(Box::new(copy_of(panel, texture)))));
            ui.close();
        }
        // Apart from the others, so that no click meant for them deletes.
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let can_go = panel.project.authored.len() > 1;
            let delete = ui.add_enabled(can_go, button(words::DELETE));
            if delete.on_disabled_hover_text(words::IS_LAST).clicked() {
                commands.push(Command::Edit(Edit::Remove(texture.key)));
                ui.close();
            }
        });
    });
    commands
}

/// Draws the surface width of the texture's own picture, in mm, and the button that removes the picture.
fn picture_ui(ui: &mut Ui, texture: &AuthoredTexture) -> Option<Command> {
    let Some(picture) = &texture.picture else {
        let weak = RichText::new(words::NO_PICTURE).small().color(tokens(ui.ctx()).text_weak);
        ui.add(Label::new(weak).wrap());
        return None;
    };
    let mut changed = None;
    ui.horizontal(|ui| {
        let mut millimeters = picture.millimeters;
        let width =
            DragValue::new(&mut millimeters).range(WIDTHS_MM).speed(0.5).fixed_decimals(1).suffix(" mm");
        let width = ui.add(width).accessible_name(words::PICTURE_WIDTH);
        if width.on_hover_text(words::PICTURE_WIDTH_HELP).changed() {
            changed = Some(Some(Arc::new(Picture { millimeters, ..Picture::clone(picture) })));
        }
        if ui.button(words::TAKE_PICTURE_AWAY).clicked() {
            changed = Some(None);
        }
    });
    changed.map(|picture| Command::Edit(Edit::SetPicture(picture)))
}

fn colors_ui(ui: &mut Ui, chosen: u8) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (index, color) in t.authored.iter().enumerate() {
            let is_chosen = index == usize::from(chosen);
            let (area, response) = ui.allocate_exact_size(vec2(SWATCH, SWATCH), Sense::click());
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, words::color(index)));
            ui.painter().circle_filled(area.center(), 0.36 * SWATCH, *color);
            if is_chosen || response.hovered() || response.has_focus() {
                let ring = egui::Stroke::new(if is_chosen { 2.0 } else { 1.0 }, t.text);
                ui.painter().circle_stroke(area.center(), 0.46 * SWATCH, ring);
            }
            if response.on_hover_text(words::COLORS[index]).clicked() {
                asked = Some(Command::Edit(Edit::SetColor(index as u8)));
            }
        }
    });
    asked
}

/// Tags in a comma-separated text, without duplicates.
fn tags_in(text: &str) -> Vec<String> {
    let mut tags: Vec<String> = Vec::new();
    for tag in text.split(',').map(str::trim).filter(|tag| !tag.is_empty()) {
        if !tags.iter().any(|other| other == tag) {
            tags.push(tag.to_owned());
        }
    }
    tags
}

#[cfg(test)]
mod tests {
    use super::tags_in;

    #[test]
    fn tags_stand_between_commas_and_once() {
        assert_eq!(tags_in(" wood, dry ,, wood,old oak,"), ["wood", "dry", "old oak"]);
        assert!(tags_in(" , ").is_empty());
    }
}
