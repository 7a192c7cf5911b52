//! Names beside dots, placed so that they cover neither each other nor a dot.

use egui::{Align2, Pos2, Rect, Vec2, vec2};

/// Distance from a dot to its name, in points.
const DISTANCE: f32 = 2.0;

/// A name that wants a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// Which of the dots it belongs to.
    pub(crate) dot: usize,
    /// How large it is, in points.
    pub(crate) size: Vec2,
    /// On which side of the dot it is best; zero where that does not matter.
    pub(crate) side: Vec2,
    /// Whether it is shown even where that covers something.
    pub(crate) is_needed: bool,
}

/// Where names go, first come first served; `None` for one that fits nowhere within `clip`. All `dots` have the same
/// `radius` in points; `taken` is kept free too.
pub(crate) fn label_places(
    dots: &[Pos2],
    radius: f32,
    wishes: &[Wish],
    taken: &[Rect],
    clip: Rect,
) -> Vec<Option<Rect>> {
    let n_dots = dots.len();
    let circles = dots.iter().map(|pos| Rect::from_center_size(*pos, vec2(2.0 * radius, 2.0 * radius)));
    let mut taken: Vec<Rect> = circles.chain(taken.iter().copied()).collect();
    let reach = radius + DISTANCE;
    let mut place = |wish: &Wish| {
        let mut sides = [
            (vec2(0.0, reach), Align2::CENTER_TOP),
            (vec2(0.0, -reach), Align2::CENTER_BOTTOM),
            (vec2(reach + DISTANCE, 0.0), Align2::LEFT_CENTER),
            (vec2(-reach - DISTANCE, 0.0), Align2::RIGHT_CENTER),
        ];
        sides.sort_by(|a, b| b.0.normalized().dot(wish.side).total_cmp(&a.0.normalized().dot(wish.side)));
        let places = sides.map(|(offset, align)| align.anchor_size(dots[wish.dot] + offset, wish.size));
        let is_free = |area: &&Rect| {
            let mut others = taken.iter().enumerate().filter(|(k, _)| *k >= n_dots || *k != wish.dot);
            clip.contains_rect(**area) && !others.any(|(_, other)| other.intersects(**area))
        };
        let first = wish.is_needed.then_some(&places[0]);
        let area = places.iter().find(is_free).or(first).copied()?;
        taken.push(area);
        Some(area)
    };
    wishes.iter().map(&mut place).collect()
}

#[cfg(test)]
mod tests {
    use super::{Wish, label_places};
    use egui::{Pos2, Rect, Vec2, pos2, vec2};

    fn wish(dot: usize) -> Wish {
        Wish { dot, size: vec2(30.0, 10.0), side: Vec2::ZERO, is_needed: false }
    }

    #[test]
    fn names_cover_neither_each_other_nor_a_dot() {
        let dots: Vec<Pos2> =
            (0..40_u16).map(|i| pos2(f32::from(i * 37 % 100) * 3.0, f32::from(i * 53 % 100) * 2.0)).collect();
        let wishes: Vec<Wish> = (0..dots.len()).map(wish).collect();
        let clip = Rect::from_min_max(pos2(-40.0, -20.0), pos2(340.0, 220.0));
        let places = label_places(&dots, 4.0, &wishes, &[], clip);
        let shown: Vec<(usize, Rect)> =
            places.iter().enumerate().filter_map(|(i, p)| Some((i, (*p)?))).collect();
        assert!(shown.len() > 25, "{} of 40 fit", shown.len());
        for (at, (i, area)) in shown.iter().enumerate() {
            assert!(clip.contains_rect(*area));
            assert!(shown[at + 1..].iter().all(|(_, other)| !other.intersects(*area)));
            let covers = |(j, dot): (usize, &Pos2)| {
                j != *i && Rect::from_center_size(*dot, vec2(8.0, 8.0)).intersects(*area)
            };
            assert!(!dots.iter().enumerate().any(covers));
        }
    }

    #[test]
    fn what_is_needed_is_shown_and_what_is_taken_stays_free() {
        let dots = [pos2(50.0, 50.0)];
        let clip = Rect::from_min_max(pos2(0.0, 0.0), pos2(100.0, 100.0));
        let below = label_places(&dots, 4.0, &[wish(0)], &[], clip)[0].unwrap();
        let beside = label_places(&dots, 4.0, &[wish(0)], &[below], clip)[0].unwrap();
        assert!(below.center().y > 50.0 && beside.center().y < 50.0);
        assert_eq!(label_places(&dots, 4.0, &[wish(0)], &[clip], clip), [None]);
        let left = Wish { side: vec2(-2.0, 1.0), ..wish(0) };
        assert!(label_places(&dots, 4.0, &[left], &[], clip)[0].unwrap().right() < 50.0);
        let needed = Wish { is_needed: true, ..wish(0) };
        assert_eq!(label_places(&dots, 4.0, &[needed], &[clip], clip), [Some(below)]);
    }
}
