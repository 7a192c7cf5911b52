//! Names of authored points on the canvas.

use std::sync::Arc;

use egui::{FontId, Pos2, Rect, Ui, Vec2};

use crate::author::canvas::point_id;
use crate::author::canvas::site_labels::backing_ui;
use crate::author::whole_space::own_textures;
use crate::look::label_places::{Placed, Wish, label_places};
use crate::look::theme::Tokens;
use crate::panel::Panel;

/// Font size of the names, in points.
const SIZE: f32 = 11.5;

/// Draws the name of the selected point where it covers nothing in `covered`, and that of the point under the pointer. During a
/// drag and a comparison the selected one has none.
pub(super) fn names_ui(
    ui: &Ui,
    radius: f32,
    panel: &Panel<'_>,
    places: &[Pos2],
    covered: &[Rect],
    t: &Tokens,
) {
    let is_selected_named = panel.compare.heard().is_none();
    for (index, (texture, pos)) in panel.project.authored.iter().zip(places).enumerate() {
        let id = point_id(texture.key);
        let response = ui.ctx().read_response(id);
        let is_pointed = response.is_some_and(|response| response.hovered() || response.has_focus());
        let is_selected = index == panel.project.selected && is_selected_named;
        if ui.ctx().is_being_dragged(id) || !(is_pointed || is_selected) {
            continue;
        }
        // The texture generated for it lies below it and has the same name.
        let is_same = |own: &usize| {
            panel.session.position(*own) == Some(panel.session.fitted(texture.at))
                && panel.session.textures()[*own].name == texture.name
        };
        if is_selected && !is_pointed && own_textures(panel, texture).iter().any(is_same) {
            continue;
        }
        let galley = ui.painter().layout_no_wrap(texture.name.clone(), FontId::proportional(SIZE), t.text);
        let wish =
            Wish { dot: 0, size: galley.size(), side: Vec2::ZERO, is_needed: is_pointed, may_lead: false };
        let placed = label_places(&[*pos], radius, &[wish], covered, ui.clip_rect()).first().copied();
        let Some(Placed { area, .. }) = placed.flatten() else { continue };
        backing_ui(ui.painter(), area, t);
        ui.painter().galley(area.min, Arc::clone(&galley), t.text);
    }
}
