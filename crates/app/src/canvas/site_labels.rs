//! Names beside textures.

use egui::{FontId, Pos2, Rect, Ui, Vec2, vec2};

use crate::label_places::{Wish, label_places};
use crate::panel::Panel;
use crate::theme::Tokens;

/// Draws the names of the textures at `sites`, all with the same `radius`. Parents come first and are always named;
/// another name that fits nowhere is left out. What is `taken` is kept free.
pub(super) fn site_labels(
    ui: &Ui,
    panel: &Panel<'_>,
    sites: &[(usize, Pos2)],
    radius: f32,
    taken: &[Rect],
    t: &Tokens,
) {
    let rank = |dot: usize| panel.session.parent_rank(sites[dot].0);
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|dot| rank(*dot).unwrap_or(usize::MAX));
    let (mut wishes, mut galleys) = (Vec::with_capacity(order.len()), Vec::with_capacity(order.len()));
    for dot in order {
        let (size, color) = match rank(dot) {
            Some(rank) => (12.5, t.parents[rank.min(2)]),
            None => (10.5, t.text_weak),
        };
        let name = panel.session.textures()[sites[dot].0].name.clone();
        let galley = ui.painter().layout_no_wrap(name, FontId::proportional(size), color);
        wishes.push(Wish { dot, size: galley.size(), side: Vec2::ZERO, is_needed: rank(dot).is_some() });
        galleys.push((galley, color));
    }
    let dots: Vec<Pos2> = sites.iter().map(|(_, pos)| *pos).collect();
    let places = label_places(&dots, radius, &wishes, taken, ui.clip_rect());
    for ((wish, (galley, color)), area) in wishes.iter().zip(galleys).zip(places) {
        let Some(area) = area else { continue };
        if wish.is_needed {
            ui.painter().rect_filled(area.expand2(vec2(4.0, 1.0)), 3.0, t.background.gamma_multiply(0.85));
        }
        ui.painter().galley(area.min, galley, color);
    }
}
