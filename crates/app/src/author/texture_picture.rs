//! Picture of a texture, and its position as text.

use egui::Ui;
use shagreen_core::space::{LabelSource, SpacePoint};

use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::strings;

/// Position of a texture, with its standard deviation if it was estimated with one, and its source.
pub(crate) fn place_in_words(panel: &Panel<'_>, index: usize, at: SpacePoint) -> String {
    let source = panel.session.place_source(index).map_or(strings::NO_SOURCE, LabelSource::label);
    strings::lies_at(at, panel.session.poles(), panel.session.place_deviation(index), source)
}

/// Draws the picture of a texture in `area`, or a plain square while there is none.
pub(crate) fn picture_ui(ui: &Ui, panel: &Panel<'_>, index: usize, area: egui::Rect) {
    let radius = f32::from(crate::look::theme::RADIUS) - 1.0;
    match panel.pictures.thumbnail(index) {
        Some(picture) => {
            let uv = egui::Rect::from_min_max(egui::pos2(0.2, 0.2), egui::pos2(0.8, 0.8));
            let shape = egui::epaint::RectShape::filled(area, radius, egui::Color32::WHITE);
            ui.painter().add(shape.with_texture(picture.id(), uv));
        }
        None => {
            ui.painter().rect_filled(area, radius, tokens(ui.ctx()).control);
        }
    }
}
