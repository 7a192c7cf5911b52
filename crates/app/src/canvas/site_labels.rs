//! Names beside textures, placed so that they cover neither each other nor a texture.

use egui::{Align2, FontId, Pos2, Rect, Ui, vec2};

use crate::panel::Panel;
use crate::theme::Tokens;

/// Distance from a texture's picture to its name, in points.
const DISTANCE: f32 = 2.0;

/// Draws the names of the textures at `sites`, all with the same `radius`. Parents come first and are always named;
/// another name that fits nowhere is left out.
pub(super) fn site_labels(ui: &Ui, panel: &Panel<'_>, sites: &[(usize, Pos2)], radius: f32, t: &Tokens) {
    let circle = |pos: Pos2| Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
    let mut taken: Vec<Rect> = sites.iter().map(|(_, pos)| circle(*pos)).collect();
    let rank = |texture: usize| panel.session.parent_rank(texture);
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|i| rank(sites[*i].0).unwrap_or(usize::MAX));
    for i in order {
        let (texture, pos) = sites[i];
        let (size, color) = match rank(texture) {
            Some(rank) => (12.5, t.parents[rank.min(2)]),
            None => (10.5, t.text_weak),
        };
        let name = panel.session.textures()[texture].name.clone();
        let galley = ui.painter().layout_no_wrap(name, FontId::proportional(size), color);
        let reach = radius + DISTANCE;
        let places = [
            (vec2(0.0, reach), Align2::CENTER_TOP),
            (vec2(0.0, -reach), Align2::CENTER_BOTTOM),
            (vec2(reach + DISTANCE, 0.0), Align2::LEFT_CENTER),
            (vec2(-reach - DISTANCE, 0.0), Align2::RIGHT_CENTER),
        ]
        .map(|(offset, align)| align.anchor_size(pos + offset, galley.size()));
        let is_free = |area: &&Rect| {
            let others = taken.iter().enumerate().filter(|(k, _)| *k != i);
            ui.clip_rect().contains_rect(**area) && !others.into_iter().any(|(_, r)| r.intersects(**area))
        };
        let Some(area) = places.iter().find(is_free).or_else(|| rank(texture).and(places.first())) else {
            continue;
        };
        if rank(texture).is_some() {
            ui.painter().rect_filled(area.expand2(vec2(4.0, 1.0)), 3.0, t.background.gamma_multiply(0.85));
        }
        ui.painter().galley(area.min, galley, color);
        taken.push(*area);
    }
}
