//! Texture names on the canvas.

use std::sync::Arc;

use egui::{FontId, Galley, Painter, Pos2, Rect, Stroke, Ui, Vec2, vec2};

use crate::look::label_places::{Placed, Wish, label_places, remembered_places};
use crate::look::theme::Tokens;
use crate::panel::Panel;

/// Font size of the names, in points: equal for all, so that no name moves when the contributing textures change.
const SIZE: f32 = 11.5;

/// What the names must not cover.
pub(super) struct Around<'a> {
    /// Rectangles of labels that are already drawn.
    pub(super) words: &'a [Rect],
    /// Rectangle of the selected authored point. Since it moves, names avoid it only while it is on their places.
    pub(super) point: Rect,
}

/// Opacity of the backing of names.
const BACKING: f32 = 0.9;

/// Draws the backing of the text in `area`, in the color of the canvas, so that no line strikes the text through.
pub(super) fn backing_ui(painter: &Painter, area: Rect, t: &Tokens) {
    painter.rect_filled(area.expand2(vec2(3.0, -1.0)), 3.0, t.background.gamma_multiply(BACKING));
}

/// Draws the names of the textures at `sites`, whose dots all have the same `radius`.
/// Names of contributing textures and of the texture under the pointer (`pointed`) come first: they may take the places
/// of others. Other names that do not fit or would be partly covered are left out. Returns the areas of the drawn names.
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
    let made_room = |dot: usize, is_needed: bool, before: &[(usize, Placed)]| {
        let others = places.iter().enumerate().filter(|(other, _)| *other != dot);
        let mut taken: Vec<Rect> = others.filter_map(|(_, place)| Some(place.as_ref()?.area)).collect();
        taken.extend(before.iter().map(|(_, place)| place.area));
        taken.extend(around.words);
        taken.push(around.point);
        label_places(&dots, radius, &[Wish { is_needed, ..wishes[dot] }], &taken, clip)[0]
    };
    // The most important names come first.
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|dot| (!is_pointed(*dot), rank(*dot).map_or(3, |rank| rank.min(2))));
    let mut wanted: Vec<(usize, Placed)> = Vec::new();
    for dot in order {
        let is_needed = rank(dot).is_some() || is_pointed(dot);
        let is_covered = |place: &Placed| place.area.intersects(around.point);
        let place = match places[dot].filter(|place| !is_covered(place)) {
            None if is_needed || places[dot].is_some() => made_room(dot, is_needed, &wanted),
            place => place,
        };
        wanted.extend(place.map(|place| (dot, place)));
    }
    let drawn = uncovered(wanted, around.point, is_pointed);
    // All lines and backgrounds come before the first name, so that they cover none.
    for (dot, Placed { leader, .. }) in &drawn {
        if let Some(line) = *leader {
            ui.painter().line_segment(line, Stroke::new(1.0, galleys[*dot].1.gamma_multiply(0.8)));
        }
    }
    for (_, Placed { area, .. }) in &drawn {
        backing_ui(ui.painter(), *area, t);
    }
    for (dot, Placed { area, .. }) in &drawn {
        let (galley, color) = &galleys[*dot];
        ui.painter().galley(area.min, Arc::clone(galley), *color);
    }
    drawn.into_iter().map(|(_, place)| place.area).collect()
}

/// The names of which nothing is covered. Earlier names cover later ones, and `point` covers all. A name for which
/// `is_kept` returns true is always among them.
fn uncovered(
    names: Vec<(usize, Placed)>,
    point: Rect,
    is_kept: impl Fn(usize) -> bool,
) -> Vec<(usize, Placed)> {
    let mut kept: Vec<(usize, Placed)> = Vec::with_capacity(names.len());
    for (dot, place) in names {
        let is_covered = |cover: &Rect| cover.intersects(place.area);
        let is_whole = !is_covered(&point) && !kept.iter().any(|(_, other)| is_covered(&other.area));
        if is_whole || is_kept(dot) {
            kept.push((dot, place));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::uncovered;
    use crate::look::label_places::Placed;
    use egui::{Pos2, Rect, pos2, vec2};

    fn name(dot: usize, at: Pos2) -> (usize, Placed) {
        (dot, Placed { area: Rect::from_center_size(at, vec2(60.0, 14.0)), leader: None })
    }

    #[test]
    fn a_name_is_shown_whole_or_not_at_all() {
        let point = Rect::from_center_size(pos2(300.0, 100.0), vec2(27.0, 27.0));
        let names = vec![
            name(4, pos2(100.0, 50.0)),
            // Half of it is below the first one.
            name(2, pos2(130.0, 55.0)),
            name(7, pos2(100.0, 80.0)),
            // At the authored point.
            name(1, pos2(320.0, 100.0)),
        ];
        assert_eq!(uncovered(names.clone(), point, |_| false), [names[0], names[2]]);
        // The name under the pointer is always shown.
        assert_eq!(uncovered(names.clone(), point, |dot| dot == 1), [names[0], names[2], names[3]]);
    }
}
