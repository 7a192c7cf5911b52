//! Label placement: labels beside dots cover neither each other nor a dot. A label without room beside its dot is
//! placed a little away, at the end of a leader line.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

use egui::{Align2, Id, Pos2, Rect, Ui, Vec2, vec2};

/// Distance from a dot to its label, in points.
const DISTANCE: f32 = 2.0;
/// Lengths of leader lines beyond the edge of the dot, in points, shortest first.
const LEADERS: [f32; 5] = [10.0, 18.0, 28.0, 40.0, 54.0];
/// Number of directions of leader lines.
const N_DIRECTIONS: u16 = 16;
/// Clearance between a leader line and other labels and dots, in points.
const CLEARANCE: f32 = 2.0;

/// Label to be placed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// Index of the dot that it belongs to.
    pub(crate) dot: usize,
    /// Size in points.
    pub(crate) size: Vec2,
    /// Preferred side of the dot; zero for no preference.
    pub(crate) side: Vec2,
    /// Whether the label is shown even if it covers something.
    pub(crate) is_needed: bool,
    /// Whether the label may be placed away from its dot, with a leader line.
    pub(crate) may_lead: bool,
}

/// Placed label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placed {
    pub(crate) area: Rect,
    /// Leader line from the edge of the dot to the label, if the label is placed away from its dot.
    pub(crate) leader: Option<[Pos2; 2]>,
}

/// Number of retries in which labels without room are placed first, to fit more labels.
const N_RETRIES: usize = 6;

/// Returns the places of labels; `None` for a label without room within `clip`.
/// Needed labels are placed first, then those that fit beside their dots, then those with leader lines. All `dots` have
/// the same `radius` in points. The rectangles in `taken` stay free too.
pub(crate) fn label_places(
    dots: &[Pos2],
    radius: f32,
    wishes: &[Wish],
    taken: &[Rect],
    clip: Rect,
) -> Vec<Option<Placed>> {
    let ground = || Ground { dots, radius, clip, frames: taken.to_vec(), leaders: Vec::new() };
    let mut urgent: Vec<usize> = Vec::new();
    let mut best = attempt(ground(), wishes, &urgent);
    let mut latest = best.clone();
    let count = |places: &[Option<Placed>]| places.iter().flatten().count();
    for _ in 0..N_RETRIES {
        let is_left_out = |i: &usize| latest[*i].is_none() && wishes[*i].may_lead && !urgent.contains(i);
        let left_out: Vec<usize> = (0..wishes.len()).filter(is_left_out).collect();
        if left_out.is_empty() {
            break;
        }
        urgent.splice(0..0, left_out);
        latest = attempt(ground(), wishes, &urgent);
        if count(&latest) > count(&best) {
            best.clone_from(&latest);
        }
    }
    best
}

/// Places labels; those with an index in `urgent` come before the others, beside or away from their dots.
fn attempt(mut ground: Ground<'_>, wishes: &[Wish], urgent: &[usize]) -> Vec<Option<Placed>> {
    let mut placed: Vec<Option<Placed>> = vec![None; wishes.len()];
    for (wish, place) in wishes.iter().zip(&mut placed).filter(|(wish, _)| wish.is_needed) {
        *place = ground.place(wish, &beside);
        if place.is_none() && wish.may_lead {
            *place = ground.place(wish, &away);
        }
        if place.is_none() {
            *place = beside(wish, &ground).first().copied();
            ground.frames.extend(place.map(|place| place.area));
        }
    }
    for i in urgent {
        placed[*i] = ground.place(&wishes[*i], &beside).or_else(|| ground.place(&wishes[*i], &away));
    }
    for (wish, place) in wishes.iter().zip(&mut placed).filter(|(_, place)| place.is_none()) {
        *place = ground.place(wish, &beside);
    }
    let is_left = |(wish, place): &(&Wish, &mut Option<Placed>)| place.is_none() && wish.may_lead;
    for (wish, place) in wishes.iter().zip(&mut placed).filter(is_left) {
        *place = ground.place(wish, &away);
    }
    placed
}

/// Dots, and what has been placed so far.
struct Ground<'a> {
    dots: &'a [Pos2],
    radius: f32,
    clip: Rect,
    frames: Vec<Rect>,
    leaders: Vec<[Pos2; 2]>,
}

impl Ground<'_> {
    /// The first of the `candidates` that covers nothing; it is then occupied.
    fn place(
        &mut self,
        wish: &Wish,
        candidates: &dyn Fn(&Wish, &Ground<'_>) -> Vec<Placed>,
    ) -> Option<Placed> {
        let place = candidates(wish, self).into_iter().find(|place| self.is_free(wish.dot, place))?;
        self.frames.push(place.area);
        self.leaders.extend(place.leader);
        Some(place)
    }

    fn is_free(&self, own: usize, place: &Placed) -> bool {
        let area = place.area;
        let circle = |pos: &Pos2| Rect::from_center_size(*pos, Vec2::splat(2.0 * self.radius));
        let others = || self.dots.iter().enumerate().filter(move |(dot, _)| *dot != own).map(|(_, pos)| pos);
        // A label with a leader line must not cover its own dot either.
        let is_on_dot = others().any(|pos| circle(pos).intersects(area))
            || (place.leader.is_some() && circle(&self.dots[own]).intersects(area));
        if !self.clip.contains_rect(area)
            || is_on_dot
            || self.frames.iter().any(|other| other.intersects(area))
            || self.leaders.iter().any(|line| crosses(*line, area.expand(CLEARANCE)))
        {
            return false;
        }
        place.leader.is_none_or(|line| {
            // A leader line can hardly avoid a dot that overlaps its own.
            let own = self.dots[own];
            let is_apart = |pos: &&Pos2| pos.distance(own) > self.radius;
            !others().filter(is_apart).any(|pos| distance(line, *pos) < self.radius + CLEARANCE)
                && !self.frames.iter().any(|other| crosses(line, other.expand(CLEARANCE)))
                && !self.leaders.iter().any(|other| cross(line, *other))
        })
    }
}

/// Candidates at the four sides of the dot, the preferred one first.
fn beside(wish: &Wish, ground: &Ground<'_>) -> Vec<Placed> {
    let reach = ground.radius + DISTANCE;
    let mut sides = [
        (vec2(0.0, reach), Align2::CENTER_TOP),
        (vec2(0.0, -reach), Align2::CENTER_BOTTOM),
        (vec2(reach + DISTANCE, 0.0), Align2::LEFT_CENTER),
        (vec2(-reach - DISTANCE, 0.0), Align2::RIGHT_CENTER),
    ];
    sides.sort_by(|a, b| b.0.normalized().dot(wish.side).total_cmp(&a.0.normalized().dot(wish.side)));
    let dot = ground.dots[wish.dot];
    let place = |(offset, align): (Vec2, Align2)| Placed {
        area: align.anchor_size(dot + offset, wish.size),
        leader: None,
    };
    sides.map(place).to_vec()
}

/// Candidates around the dot with leader lines, the shortest first.
fn away(wish: &Wish, ground: &Ground<'_>) -> Vec<Placed> {
    let dot = ground.dots[wish.dot];
    let place = |length: f32, direction: u16| {
        let angle = std::f32::consts::TAU * f32::from(direction) / f32::from(N_DIRECTIONS);
        let towards = Vec2::angled(angle);
        let end = dot + (ground.radius + length) * towards;
        // The label lies beyond the end of its line: beside it if the line runs sideways, otherwise above or below.
        let half = 0.5 * wish.size;
        let beyond = vec2(half.x * reaching(towards.x), half.y * reaching(towards.y));
        let area = Rect::from_center_size(end + beyond, wish.size);
        let start = dot + ground.radius * towards;
        Placed { area, leader: Some([start, area.clamp(end)]) }
    };
    LEADERS.iter().flat_map(|length| (0..N_DIRECTIONS).map(|direction| place(*length, direction))).collect()
}

/// Shift of a label past the end of its line in one direction, from -1 to 1. It is a full shift unless the line hardly
/// runs in that direction.
fn reaching(towards: f32) -> f32 {
    (3.0 * towards).clamp(-1.0, 1.0)
}

/// Distance of a point from a line segment.
fn distance([a, b]: [Pos2; 2], point: Pos2) -> f32 {
    let along = b - a;
    let share = ((point - a).dot(along) / along.length_sq().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    point.distance(a + share * along)
}

/// Whether a line segment touches a rectangle.
fn crosses(line: [Pos2; 2], frame: Rect) -> bool {
    let [a, b, c, d] = [frame.left_top(), frame.right_top(), frame.right_bottom(), frame.left_bottom()];
    frame.contains(line[0]) || [[a, b], [b, c], [c, d], [d, a]].into_iter().any(|edge| cross(line, edge))
}

/// Whether two line segments cross.
fn cross([a, b]: [Pos2; 2], [c, d]: [Pos2; 2]) -> bool {
    let side = |from: Pos2, to: Pos2, point: Pos2| (to - from).rot90().dot(point - from);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// Result of [`label_places`], cached until its input changes. `name` distinguishes several caches in one window.
pub(crate) fn remembered_places(
    ui: &Ui,
    name: &str,
    dots: &[Pos2],
    radius: f32,
    wishes: &[Wish],
    taken: &[Rect],
    clip: Rect,
) -> Arc<Vec<Option<Placed>>> {
    let mut hasher = DefaultHasher::new();
    let vectors = wishes.iter().flat_map(|wish| [wish.size.to_pos2(), wish.side.to_pos2()]);
    let frames = taken.iter().chain([&clip]).flat_map(|frame| [frame.min, frame.max]);
    for pos in dots.iter().copied().chain(vectors).chain(frames) {
        (pos.x.to_bits(), pos.y.to_bits()).hash(&mut hasher);
    }
    for wish in wishes {
        (wish.dot, wish.is_needed, wish.may_lead).hash(&mut hasher);
    }
    let (id, key) = (Id::unique(name), (radius.to_bits(), hasher.finish()));
    let known = ui.data(|data| data.get_temp::<((u32, u64), Arc<Vec<Option<Placed>>>)>(id));
    if let Some((_, places)) = known.filter(|(known, _)| *known == key) {
        return places;
    }
    let places = Arc::new(label_places(dots, radius, wishes, taken, clip));
    ui.data_mut(|data| data.insert_temp(id, (key, Arc::clone(&places))));
    places
}

#[cfg(test)]
mod tests {
    use super::{Placed, Wish, crosses, distance, label_places};
    use egui::{Pos2, Rect, Vec2, pos2, vec2};

    fn wish(dot: usize) -> Wish {
        Wish { dot, size: vec2(30.0, 10.0), side: Vec2::ZERO, is_needed: false, may_lead: false }
    }

    fn leading(dot: usize) -> Wish {
        Wish { may_lead: true, ..wish(dot) }
    }

    /// Checks that nothing covers anything. Returns the number of shown labels, and how many of them have leader lines.
    fn check(dots: &[Pos2], wishes: &[Wish], clip: Rect) -> (usize, usize) {
        let places = label_places(dots, 4.0, wishes, &[], clip);
        let shown: Vec<(usize, Placed)> =
            wishes.iter().zip(&places).filter_map(|(wish, place)| Some((wish.dot, (*place)?))).collect();
        for (at, (i, place)) in shown.iter().enumerate() {
            assert!(clip.contains_rect(place.area));
            assert!(shown[at + 1..].iter().all(|(_, other)| !other.area.intersects(place.area)));
            let covers = |(j, dot): (usize, &Pos2)| {
                (j != *i || place.leader.is_some())
                    && Rect::from_center_size(*dot, vec2(8.0, 8.0)).intersects(place.area)
            };
            assert!(!dots.iter().enumerate().any(covers));
            let Some(line) = place.leader else { continue };
            assert!(
                (line[0].distance(dots[*i]) - 4.0).abs() < 1e-3 && place.area.expand(0.1).contains(line[1])
            );
            assert!(dots.iter().enumerate().all(|(j, dot)| j == *i || distance(line, *dot) > 4.0));
            let mut names = shown.iter().filter(|(j, _)| j != i);
            assert!(names.all(|(_, other)| !crosses(line, other.area)));
        }
        (shown.len(), shown.iter().filter(|(_, place)| place.leader.is_some()).count())
    }

    #[test]
    fn names_cover_neither_each_other_nor_a_dot() {
        let dots: Vec<Pos2> =
            (0..40_u16).map(|i| pos2(f32::from(i * 37 % 100) * 3.0, f32::from(i * 53 % 100) * 2.0)).collect();
        let clip = Rect::from_min_max(pos2(-40.0, -20.0), pos2(340.0, 220.0));
        let wishes: Vec<Wish> = (0..dots.len()).map(wish).collect();
        let (n_shown, n_away) = check(&dots, &wishes, clip);
        assert!(n_shown > 25 && n_away == 0, "{n_shown} of 40 fit");
    }

    /// Nine crowded dots: beside them there is room for few labels, around them for all but one.
    #[test]
    fn crowded_dots_keep_their_names_at_the_end_of_lines() {
        let dots: Vec<Pos2> = (0..9_u16)
            .map(|i| pos2(200.0 + 9.0 * f32::from(i % 3), 100.0 + 9.0 * f32::from(i / 3) + f32::from(i % 2)))
            .collect();
        let clip = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 200.0));
        let near: Vec<Wish> = (0..dots.len()).map(wish).collect();
        let lead: Vec<Wish> = (0..dots.len()).map(leading).collect();
        let (n_near, _) = check(&dots, &near, clip);
        let (n_shown, n_away) = check(&dots, &lead, clip);
        // The dot in the middle cannot be reached without crossing another one.
        assert!(n_near < 7 && n_shown == 8 && n_away > 0, "{n_near}, {n_shown}, {n_away}");
    }

    #[test]
    fn what_is_needed_is_shown_and_what_is_taken_stays_free() {
        let dots = [pos2(50.0, 50.0)];
        let clip = Rect::from_min_max(pos2(0.0, 0.0), pos2(100.0, 100.0));
        let area = |wish: Wish, taken: &[Rect]| label_places(&dots, 4.0, &[wish], taken, clip)[0];
        let below = area(wish(0), &[]).unwrap().area;
        let beside = area(wish(0), &[below]).unwrap().area;
        assert!(below.center().y > 50.0 && beside.center().y < 50.0);
        assert_eq!(area(wish(0), &[clip]), None);
        let left = Wish { side: vec2(-2.0, 1.0), ..wish(0) };
        assert!(area(left, &[]).unwrap().area.right() < 50.0);
        let needed = Wish { is_needed: true, ..leading(0) };
        assert_eq!(area(needed, &[clip]), Some(Placed { area: below, leader: None }));
        // If only the sides are taken, a leader line passes between them.
        let around = |size: f32| Rect::from_center_size(dots[0], Vec2::splat(size));
        assert_eq!(area(needed, &[around(24.0)]).unwrap().leader, None, "no line goes through what is taken");
        let corners = [vec2(0.0, 16.0), vec2(0.0, -16.0), vec2(22.0, 0.0), vec2(-22.0, 0.0)];
        let sides = corners.map(|offset| Rect::from_center_size(dots[0] + offset, vec2(12.0, 10.0)));
        let led = area(leading(0), &sides).unwrap();
        assert!(led.leader.is_some() && sides.iter().all(|side| !side.intersects(led.area)), "{led:?}");
        // Dots that overlap both have their labels.
        let twins = [dots[0], dots[0] + vec2(0.5, 0.0)];
        let places = label_places(&twins, 4.0, &[leading(0), leading(1)], &sides, clip);
        assert!(places.iter().all(|place| place.is_some_and(|place| place.leader.is_some())), "{places:?}");
    }
}
