//! Names beside textures.

use egui::{FontId, Pos2, Rect, Stroke, Ui, Vec2, vec2};

use crate::label_places::{Placed, Wish, label_places};
use crate::panel::Panel;
use crate::theme::Tokens;

/// Draws the names of the textures at `sites`, all with the same `radius`. Parents come first and are always named, as is
/// the one that is `pointed` at, over whatever is there; another name that fits nowhere is left out. What is `taken` is
/// kept free.
pub(super) fn site_labels(
    ui: &Ui,
    panel: &Panel<'_>,
    sites: &[(usize, Pos2)],
    radius: f32,
    taken: &[Rect],
    pointed: Option<usize>,
    t: &Tokens,
) {
    let rank = |dot: usize| panel.session.parent_rank(sites[dot].0);
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|dot| rank(*dot).unwrap_or(usize::MAX));
    let (mut wishes, mut galleys) = (Vec::with_capacity(order.len()), Vec::with_capacity(order.len()));
    for dot in order {
        let is_pointed = pointed == Some(sites[dot].0);
        let (size, color) = match rank(dot) {
            Some(rank) => (12.5, t.parents[rank.min(2)]),
            None => (10.5, if is_pointed { t.text } else { t.text_weak }),
        };
        let name = panel.session.textures()[sites[dot].0].name.clone();
        let galley = ui.painter().layout_no_wrap(name, FontId::proportional(size), color);
        let is_needed = rank(dot).is_some();
        wishes.push(Wish { dot, size: galley.size(), side: Vec2::ZERO, is_needed, may_lead: true });
        galleys.push((galley, color));
    }
    let dots: Vec<Pos2> = sites.iter().map(|(_, pos)| *pos).collect();
    let clip = ui.clip_rect();
    let places = label_places(&dots, radius, &wishes, taken, clip);
    // Whoever points at a texture does not see the other names move for it.
    let over = |wish: &Wish| {
        let alone = Wish { is_needed: true, may_lead: false, ..*wish };
        label_places(&dots, radius, &[alone], taken, clip)[0]
    };
    let mut last = None;
    for ((wish, (galley, color)), place) in wishes.iter().zip(galleys).zip(places) {
        let is_pointed = pointed == Some(sites[wish.dot].0);
        let Some(Placed { area, leader }) = place.or_else(|| over(wish).filter(|_| is_pointed)) else {
            continue;
        };
        if is_pointed {
            last = Some((galley, color, area, leader));
            continue;
        }
        if let Some(line) = leader {
            ui.painter().line_segment(line, Stroke::new(1.0, color.gamma_multiply(0.7)));
        }
        if wish.is_needed {
            ui.painter().rect_filled(area.expand2(vec2(4.0, 1.0)), 3.0, t.background.gamma_multiply(0.85));
        }
        ui.painter().galley(area.min, galley, color);
    }
    if let Some((galley, color, area, leader)) = last {
        if let Some(line) = leader {
            ui.painter().line_segment(line, Stroke::new(1.0, color));
        }
        ui.painter().rect_filled(area.expand2(vec2(4.0, 1.0)), 3.0, t.background);
        ui.painter().galley(area.min, galley, color);
    }
}
