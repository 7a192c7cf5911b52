//! Region of a map: its outline, and values continued beyond it.

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authoring, Blending, Outside};
use shagreen_core::texture::blend::Mode;

/// Number of points of an extrapolated outline along each edge of the convex hull, and around each of its corners.
const POINTS_AN_EDGE: usize = 16;
const POINTS_A_CORNER: usize = 8;
/// Distance from the hull of the points that are moved back to the outline, in points of the axes. It is longer than the
/// diagonal of the space.
const FAR: f64 = 200.0;

/// Outline of the region in which textures are interpolated: the convex hull of the textures, or the limit of the
/// extrapolation. Fewer than three points enclose nothing.
pub(super) fn outline(authoring: &Authoring, blending: &Blending) -> Vec<SpacePoint> {
    let space = authoring.space();
    let hull: Vec<SpacePoint> = space.hull().filter_map(|[from, _]| space.position(from)).collect();
    if hull.len() < 3 || blending.mode != Mode::Field || blending.outside == Outside::Clamped {
        return hull;
    }
    let reached = |point: SpacePoint| authoring.author(point, blending).map(|authored| authored.location.at);
    around(&hull).into_iter().filter_map(reached).collect()
}

/// Points far outside a convex polygon. The nearest point of the polygon moves once around it from one to the next.
fn around(hull: &[SpacePoint]) -> Vec<SpacePoint> {
    let n = hull.len();
    let corner = |i: usize| [hull[i % n].x(), hull[i % n].y()];
    let turn: f64 = (0..n).map(|i| cross(corner(i), corner(i + 1))).sum();
    // Angle of the normal that points outward from the edge after a corner.
    let normal = |i: usize| {
        let ([x, y], [next_x, next_y]) = (corner(i), corner(i + 1));
        let (along_x, along_y) = (turn.signum() * (next_x - x), turn.signum() * (next_y - y));
        (-along_x).atan2(along_y)
    };
    let moved =
        |[x, y]: [f64; 2], angle: f64| SpacePoint::plane(x + FAR * angle.cos(), y + FAR * angle.sin());
    let mut points = Vec::new();
    for i in 0..n {
        let ([x, y], [next_x, next_y]) = (corner(i), corner(i + 1));
        let angle = normal(i);
        for step in 0..=POINTS_AN_EDGE {
            let share = step as f64 / POINTS_AN_EDGE as f64;
            points.push(moved([x + share * (next_x - x), y + share * (next_y - y)], angle));
        }
        let turned = (normal(i + 1) - angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        for step in 1..POINTS_A_CORNER {
            let share = step as f64 / POINTS_A_CORNER as f64;
            points.push(moved([next_x, next_y], angle + share * turned));
        }
    }
    points
}

fn cross([a_x, a_y]: [f64; 2], [b_x, b_y]: [f64; 2]) -> f64 {
    a_x * b_y - a_y * b_x
}

/// Values of a map with `side` cells along each side, continued by means of neighbors into the cells outside the convex
/// hull. Inside the hull, a cell without a value stays without one.
pub(super) fn continued(
    values: &[Option<f64>],
    side: usize,
    is_inside: impl Fn(usize) -> bool,
) -> Vec<Option<f64>> {
    let mut continued = values.to_vec();
    let mut empty: Vec<usize> =
        (0..values.len()).filter(|cell| values[*cell].is_none() && !is_inside(*cell)).collect();
    while !empty.is_empty() {
        let mean = |cell: usize| {
            let (column, row) = (cell % side, cell / side);
            let rows = row.saturating_sub(1)..(row + 2).min(side);
            let near = rows.flat_map(|row| {
                (column.saturating_sub(1)..(column + 2).min(side)).map(move |column| row * side + column)
            });
            let (sum, n) = near
                .filter_map(|cell| continued[cell])
                .fold((0.0, 0_u32), |(sum, n), value| (sum + value, n + 1));
            (n > 0).then(|| sum / f64::from(n))
        };
        let found: Vec<(usize, Option<f64>)> = empty.iter().map(|cell| (*cell, mean(*cell))).collect();
        if found.iter().all(|(_, value)| value.is_none()) {
            break;
        }
        for (cell, value) in found {
            continued[cell] = value;
        }
        empty.retain(|cell| continued[*cell].is_none());
    }
    continued
}

#[cfg(test)]
mod tests {
    use super::{around, continued, outline};
    use shagreen_core::space::authoring::{Authoring, Blending};
    use shagreen_core::space::{Space, SpacePoint};

    fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
        SpacePoint::plane(rough_smooth, hard_soft)
    }

    fn space() -> Space {
        let places = [at(10.0, 10.0), at(90.0, 20.0), at(50.0, 40.0), at(40.0, 80.0)];
        Space::new(&places.map(Some)).unwrap()
    }

    #[test]
    fn the_outline_is_the_convex_hull() {
        let corners = outline(&Authoring::new(space()), &Blending::default());
        assert_eq!(corners.len(), 3);
        for corner in [at(10.0, 10.0), at(90.0, 20.0), at(40.0, 80.0)] {
            assert!(corners.contains(&corner), "{corner}");
        }
        let single = Space::new(&[Some(at(10.0, 10.0))]).unwrap();
        assert!(outline(&Authoring::new(single), &Blending::default()).len() < 3);
    }

    /// Moved back to the hull, the points walk around it once, whichever way its corners are listed.
    #[test]
    fn the_points_around_a_hull_lead_around_it() {
        let (space, corners) = (space(), [at(10.0, 10.0), at(90.0, 20.0), at(40.0, 80.0)]);
        let edges = [[0, 1], [1, 2], [2, 0]];
        let circumference: f64 = edges.iter().map(|[a, b]| corners[*a].distance(corners[*b])).sum();
        for hull in [corners, [corners[2], corners[1], corners[0]]] {
            let mut way: Vec<SpacePoint> =
                around(&hull).into_iter().map(|point| space.locate(point).unwrap().at).collect();
            way.push(way[0]);
            let length: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            assert!((length - circumference).abs() < 1e-6, "{length} instead of {circumference}");
        }
    }

    #[test]
    fn values_continue_outside_and_not_inside() {
        let values = [Some(1.0), None, None, Some(3.0), None, None, None, None, None];
        // The cell in the middle is inside the hull and has no value.
        let all = continued(&values, 3, |cell| cell == 4);
        assert_eq!((all[0], all[4], all[1], all[6]), (Some(1.0), None, Some(2.0), Some(3.0)));
        assert!(all.iter().enumerate().all(|(cell, value)| cell == 4 || value.is_some()), "{all:?}");
        let nothing = [None; 9];
        assert_eq!(continued(&nothing, 3, |_| false), nothing);
    }
}
