//! Texture names on the canvas.

use std::sync::Arc;

use egui::{FontId, Galley, Pos2, Rect, Stroke, Ui, Vec2, vec2};

use crate::look::label_places::{Placed, Wish, label_places, remembered_places};
use crate::look::theme::Tokens;
use crate::panel::Panel;

/// Font size of the names, in points: equal for all, so that no name moves when the contributing textures change.
const SIZE: f32 = 11.5;

/// What the names must not cover.
pub(super) struct Around<'a> {
    /// Rectangles of labels that are already drawn.
    pub(super) words: &'a [Rect],
    /// Rectangle of the authored point. Since it moves, only names of contributing textures avoid it.
    pub(super) point: Rect,
    /// Whether a map is drawn behind the names.
    pub(super) on_map: bool,
}

/// Draws the names of the textures at `sites`, whose dots all have the same `radius`.
/// Names of contributing textures and of the texture under the pointer (`pointed`) are always drawn, even over other
/// items. Other names are left out if they do not fit. Returns the areas of the drawn names.
pub(super) fn site_labels(
    ui: &Ui,
    panel: &Panel<'_>,
    sites: &[(usize, Pos2)],
    radius: f32,
    around: &Around<'_>,
    pointed: Option<usize>,
    t: &Tokens,
) -> Vec<Rect> {
    let rank = |dot: usize| panel.session.parent_rank(sites[dot].0);
    let is_pointed = |dot: usize| pointed == Some(sites[dot].0);
    let galley = |dot: usize| {
        let color = match rank(dot) {
            Some(rank) => t.parents[rank.min(2)],
            None if is_pointed(dot) => t.text,
            None => t.text_weak,
        };
        let name = panel.session.textures()[sites[dot].0].name.clone();
        (ui.painter().layout_no_wrap(name, FontId::proportional(SIZE), color), color)
    };
    let galleys: Vec<(Arc<Galley>, egui::Color32)> = (0..sites.len()).map(galley).collect();
    let wish = |dot: usize| Wish {
        dot,
        size: galleys[dot].0.size(),
        side: Vec2::ZERO,
        is_needed: false,
        may_lead: true,
    };
    let dots: Vec<Pos2> = sites.iter().map(|(_, pos)| *pos).collect();
    let wishes: Vec<Wish> = (0..sites.len()).map(wish).collect();
    let clip = ui.clip_rect();
    let places = remembered_places(ui, "names on the canvas", &dots, radius, &wishes, around.words, clip);
    // Other names keep their positions when a name must be drawn.
    let made_room = |dot: usize| {
        let others = places.iter().enumerate().filter(|(other, _)| *other != dot);
        let mut taken: Vec<Rect> = others.filter_map(|(_, place)| Some(place.as_ref()?.area)).collect();
        taken.extend(around.words);
        taken.push(around.point);
        label_places(&dots, radius, &[Wish { is_needed: true, ..wishes[dot] }], &taken, clip)[0]
    };
    // Names that must be drawn are drawn last.
    let mut order: Vec<usize> = (0..sites.len()).collect();
    let mut drawn = Vec::new();
    order.sort_by_key(|dot| (is_pointed(*dot), rank(*dot).map_or(0, |rank| 3 - rank.min(2))));
    for dot in order {
        let is_parent = rank(dot).is_some();
        let is_covered = |place: &Placed| is_parent && place.area.intersects(around.point);
        let place = match places[dot].filter(|place| !is_covered(place)) {
            None if is_parent || is_pointed(dot) => made_room(dot),
            place => place,
        };
        let Some(Placed { area, leader }) = place else { continue };
        let (galley, color) = &galleys[dot];
        if let Some(line) = leader {
            ui.painter().line_segment(line, Stroke::new(1.0, color.gamma_multiply(0.8)));
        }
        let back = match (is_parent || is_pointed(dot), around.on_map) {
            (true, _) => 0.9,
            (false, true) => 0.75,
            (false, false) => 0.0,
        };
        ui.painter().rect_filled(area.expand2(vec2(4.0, -1.0)), 3.0, t.background.gamma_multiply(back));
        ui.painter().galley(area.min, Arc::clone(galley), *color);
        drawn.push(area);
    }
    drawn
}
