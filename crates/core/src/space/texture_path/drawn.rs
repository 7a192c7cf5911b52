//! Paths drawn in the space, which the texture follows along a stroke.

use crate::space::SpacePoint;
use crate::space::texture_path::{Along, AtEnd, Route, Stop};

/// Maximum number of points to which a drawn line is simplified; the user can add more points one by one, up to the
/// limit of a route.
const MOST_DRAWN: usize = 24;
/// Minimum distance of two points, in points of the axes; closer points count as one.
pub const LEAST_STEP: f64 = 0.5;
/// Initial tolerance of the simplification of a drawn line, in points of the axes.
const STRAIGHT: f64 = 0.75;

/// A path as drawn by the user.
#[derive(Clone, Debug, PartialEq)]
pub struct UserPath {
    /// Points of the path in the space; with fewer than two, the path is not complete yet.
    pub points: Vec<SpacePoint>,
    /// Quantity that is measured along the path.
    pub along: Along,
    /// Length in m, used if distance is measured.
    pub length_m: f64,
    /// Length in s, used if time is measured.
    pub length_secs: f64,
    /// Behavior at the end of the path.
    pub at_end: AtEnd,
}

impl Default for UserPath {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            along: Along::Distance,
            length_m: 0.2,
            length_secs: 3.0,
            at_end: AtEnd::Turn,
        }
    }
}

impl UserPath {
    /// Route along the stroke, with the length distributed in proportion to the drawn line. `None` if the path has
    /// fewer than two distinct points.
    pub fn route(&self) -> Option<Route> {
        let length = match self.along {
            Along::Distance => self.length_m,
            Along::Time => self.length_secs,
        };
        let mut way = 0.0;
        let mut stops: Vec<Stop> = Vec::with_capacity(self.points.len());
        for (i, at) in self.points.iter().enumerate() {
            let step = i.checked_sub(1).map_or(0.0, |before| self.points[before].distance(*at));
            // A point that coincides with the previous one is skipped.
            if i == 0 || step > 1e-9 {
                way += step;
                stops.push(Stop { at: *at, along: way });
            }
        }
        for stop in &mut stops {
            stop.along *= length / way.max(1e-9);
        }
        // An incomplete path has no route and is not played.
        Route::new(self.along, self.at_end, stops).ok()
    }

    /// This path with new points: a hand-drawn line, simplified to few points that follow it closely.
    #[must_use]
    pub fn drawn(&self, line: &[SpacePoint]) -> Self {
        let mut tolerance = STRAIGHT;
        let mut points = simplified(line, tolerance);
        while points.len() > MOST_DRAWN {
            tolerance *= 1.5;
            points = simplified(line, tolerance);
        }
        Self { points, ..self.clone() }
    }
}

/// Line simplification to within `tolerance` (U. Ramer 1972; D. Douglas and T. Peucker 1973).
fn simplified(line: &[SpacePoint], tolerance: f64) -> Vec<SpacePoint> {
    let mut kept = vec![false; line.len()];
    let mut open = vec![(0, line.len().saturating_sub(1))];
    while let Some((first, last)) = open.pop() {
        if line.is_empty() {
            break;
        }
        (kept[first], kept[last]) = (true, true);
        let away = |i: usize| beside(line[i], line[first], line[last]);
        let farthest = (first + 1..last).max_by(|a, b| away(*a).total_cmp(&away(*b)));
        if let Some(farthest) = farthest.filter(|i| away(*i) > tolerance) {
            open.push((first, farthest));
            open.push((farthest, last));
        }
    }
    line.iter().zip(kept).filter(|(_, is_kept)| *is_kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from the segment between two others, in points of the axes.
fn beside(point: SpacePoint, from: SpacePoint, to: SpacePoint) -> f64 {
    let (mut squared, mut product) = (0.0, 0.0);
    for ((from, to), point) in from.coordinates().iter().zip(to.coordinates()).zip(point.coordinates()) {
        squared += (to - from) * (to - from);
        product += (point - from) * (to - from);
    }
    let share: f64 = if squared > 0.0 { (product / squared).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(from.toward(to, share))
}

#[cfg(test)]
mod tests {
    use super::{MOST_DRAWN, UserPath, beside};
    use crate::space::SpacePoint;
    use crate::space::texture_path::{Along, AtEnd};

    fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
        SpacePoint::plane(rough_smooth, hard_soft)
    }

    #[test]
    fn parts_are_as_long_as_they_were_drawn() {
        let points = vec![at(10.0, 10.0), at(40.0, 10.0), at(40.0, 10.0), at(40.0, 20.0)];
        let mut path = UserPath { points, length_m: 0.08, at_end: AtEnd::Hold, ..UserPath::default() };
        let route = path.route().unwrap();
        let along: Vec<f64> = route.stops().iter().map(|stop| stop.along).collect();
        assert!(along.iter().zip([0.0, 0.06, 0.08]).all(|(a, b)| (a - b).abs() < 1e-12) && along.len() == 3);
        assert!(route.point_at(0.03).distance(at(25.0, 10.0)) < 1e-9);
        path.along = Along::Time;
        assert!((path.route().unwrap().length() - path.length_secs).abs() < 1e-12);
        path.points.truncate(1);
        assert_eq!(path.route(), None);
        path.points = vec![at(1.0, 1.0); 4];
        assert_eq!(path.route(), None, "coincident points give no route");
    }

    /// A hand-drawn line of a few hundred points is simplified to a few points that follow it.
    #[test]
    fn a_drawn_line_keeps_its_shape_in_few_points() {
        let line: Vec<SpacePoint> = (0..=400)
            .map(|i| f64::from(i) / 400.0)
            .map(|t| at(10.0 + 80.0 * t, 50.0 + 30.0 * (9.0 * t).sin()))
            .collect();
        let path = UserPath::default().drawn(&line);
        assert!(path.points.len() <= MOST_DRAWN && path.points.len() >= 8, "{}", path.points.len());
        assert_eq!((path.points[0], path.points[path.points.len() - 1]), (line[0], line[400]));
        for point in &line {
            let nearest = path.points.windows(2).map(|s| beside(*point, s[0], s[1])).fold(f64::MAX, f64::min);
            assert!(nearest < 2.0, "{point} is {nearest} from the path");
        }
        let straight = UserPath::default().drawn(&[at(0.0, 0.0), at(5.0, 5.0), at(9.0, 9.0)]);
        assert_eq!(straight.points, [at(0.0, 0.0), at(9.0, 9.0)]);
        assert!(UserPath::default().drawn(&[]).points.is_empty());
    }
}
