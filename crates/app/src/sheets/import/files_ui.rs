//! List of the imported files with their status.

use egui::{Label, Rect, RichText, Role, ScrollArea, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use crate::look::icons::close_button;
use crate::look::theme::{RADIUS, Tokens, tokens};
use crate::sheets::import::batch::{Batch, Content, State};
use crate::strings::import as strings;

/// Height of a row, in points.
const ROW: f32 = 40.0;

/// Draws the list; a click selects a file, and its cross removes it.
pub(super) fn files_ui(ui: &mut Ui, batch: &mut Batch, selected: &mut Option<u64>) {
    let t = tokens(ui.ctx());
    let mut left_out = None;
    ScrollArea::vertical().id_salt("files").auto_shrink(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        for file in batch.files() {
            let state = batch.state(file);
            let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
            let word = word_of(state);
            response.widget_info(|| {
                WidgetInfo::selected(
                    Role::Button,
                    true,
                    *selected == Some(file.id),
                    strings::file(&file.name, word),
                )
            });
            if response.gained_focus() {
                response.scroll_to_me(None);
            }
            if response.clicked() {
                *selected = Some(file.id);
            }
            if *selected == Some(file.id) || response.hovered() || response.has_focus() {
                ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
            }
            if *selected == Some(file.id) {
                let mark = Rect::from_min_size(area.min, vec2(3.0, area.height()));
                ui.painter().rect_filled(mark, 1.5, t.accent);
            }
            let text = Rect::from_min_max(area.min + vec2(11.0, 3.0), area.max - vec2(28.0, 0.0));
            let mut text = ui.new_child(UiBuilder::new().max_rect(text));
            text.spacing_mut().item_spacing.y = 1.0;
            text.add(Label::new(&file.name).truncate().selectable(false));
            let below = match &file.content {
                Content::Textures { entries, .. } if entries.len() > 1 => strings::n_textures(entries.len()),
                _ => word.to_owned(),
            };
            let below = RichText::new(below).small().color(color_of(state, t));
            text.add(Label::new(below).truncate().selectable(false));
            let cross = Rect::from_center_size(area.right_center() - vec2(15.0, 0.0), vec2(20.0, 20.0));
            let button = close_button(ui.ctx());
            let name = strings::leave_out(&file.name);
            if ui.put(cross, button).accessible_name(&name).on_hover_text(&name).clicked() {
                left_out = Some(file.id);
            }
        }
    });
    if let Some(id) = left_out {
        batch.remove(id);
    }
}

fn word_of(state: State) -> &'static str {
    match state {
        State::Working => strings::WORKING,
        State::Ready => strings::READY,
        State::Question => strings::QUESTION,
        State::Guessed => strings::GUESSED,
        State::Failed => strings::FAILED,
        State::Helper => strings::HELPER,
    }
}

fn color_of(state: State, t: &Tokens) -> egui::Color32 {
    match state {
        State::Working | State::Helper => t.text_weak,
        State::Ready => t.accent,
        State::Question | State::Guessed => t.warning,
        State::Failed => t.error,
    }
}
