use proptest::prelude::{Just, Strategy, prop, prop_assert, prop_assert_eq, prop_oneof, proptest};

use super::{Triangulation, TriangulationError, Xy, weights_at};
use crate::maths::rng::Random;

/// Reference: weights at a point in every triangle that contains it, with a tolerance of 1e-12 on the weights.
fn oracle(t: &Triangulation, at: Xy) -> Vec<(usize, [f64; 3])> {
    let weights = |i: usize| weights_at(t.corners(i).map(|corner| t.points()[corner]), at);
    (0..t.triangles().len())
        .map(|i| (i, weights(i)))
        .filter(|(_, w)| w.iter().all(|w| *w >= -1e-12))
        .collect()
}

/// Point represented by the weights.
fn place(t: &Triangulation, (triangle, weights): (usize, [f64; 3])) -> Xy {
    let corners = t.corners(triangle).map(|corner| t.points()[corner]);
    [0, 1].map(|axis| (0..3).map(|i| weights[i] * corners[i][axis]).sum())
}

fn distance(a: Xy, b: Xy) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Whether the weights are non-negative, sum to one, and represent the point within `tolerance`.
fn is_found(t: &Triangulation, at: Xy, found: Option<(usize, [f64; 3])>, tolerance: f64) -> bool {
    found.is_some_and(|(triangle, weights)| {
        let is_share = weights.iter().all(|w| *w >= 0.0) && (weights.iter().sum::<f64>() - 1.0).abs() < 1e-12;
        is_share && distance(place(t, (triangle, weights)), at) <= tolerance
    })
}

/// Degenerate point sets: nearly collinear, on grids, on circles, clustered, or coincident.
fn adversarial() -> impl Strategy<Value = Vec<Xy>> {
    let grid = (2_usize..9, 2_usize..9, 0.0_f64..6.3).prop_map(|(columns, rows, angle)| {
        let (sin, cos) = angle.sin_cos();
        let turned = move |i: usize| {
            let [x, y] = [(i % columns) as f64 / 7.0, (i / columns) as f64 / 7.0];
            [cos * x - sin * y, sin * x + cos * y]
        };
        (0..columns * rows).map(turned).collect::<Vec<Xy>>()
    });
    let line = (3_usize..30, 0.0_f64..2.0, prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 1..3))
        .prop_map(|(n, slope, mut points)| {
            points.extend((0..n).map(|i| i as f64 / 9.0).map(|x| [x, slope * x + 0.1]));
            points
        });
    let circle = (3_usize..40).prop_map(|n| {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| [angle(i).cos(), angle(i).sin()]).chain([[0.0, 0.0]]).collect()
    });
    let slivers = (3_usize..30, -15_i32..-3).prop_map(|(n, power)| {
        let mut random = Random::new(n as u64);
        (0..n).map(|_| [random.uniform(), 10.0_f64.powi(power) * random.uniform()]).collect()
    });
    let clusters = (prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 2..6), -14_i32..-4).prop_map(
        |(centers, power)| {
            let near = |c: &Xy| {
                let (step, [x, y]) = (10.0_f64.powi(power), *c);
                [[x, y], [x + step, y], [x, y + step], [x, y], [x - step, y - 2.0 * step]]
            };
            centers.iter().flat_map(near).collect()
        },
    );
    let scale = prop_oneof![Just(1.0), Just(1e-6), Just(1e6)];
    let shift = prop_oneof![Just(0.0), Just(1.0), Just(-1000.0)];
    (prop_oneof![grid, line, circle, slivers, clusters], scale, shift).prop_map(
        |(points, scale, shift): (Vec<Xy>, f64, f64)| {
            points.into_iter().map(|p| p.map(|c| scale * (c + shift))).collect()
        },
    )
}

fn size(points: &[Xy]) -> f64 {
    points.iter().flatten().fold(0.0, |largest: f64, c| largest.max(c.abs()))
}

proptest! {
    #[test]
    fn walk_agrees_with_looking_at_every_triangle(
        points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..60),
        at in [-0.2_f64..1.2, -0.2_f64..1.2],
        hint in 0_usize..100,
    ) {
        let t = Triangulation::new(&points).unwrap();
        let expected = oracle(&t, at);
        let mut near = hint;
        for found in [t.locate_near(at, &mut near), t.locate(at)] {
            prop_assert_eq!(found.is_some(), !expected.is_empty());
            if found.is_some() {
                // Linear precision.
                prop_assert!(is_found(&t, at, found, 1e-9));
            }
        }
        prop_assert!(t.triangles().len() == 0 || near < t.triangles().len());
    }

    /// The affine map agrees with the barycentric formula, within the digits that the triangle's shape allows. Rounding
    /// error is amplified by the product of two edges over the area.
    #[test]
    fn weights_are_those_of_the_formula(
        points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..60),
        at in [0.0_f64..1.0, 0.0_f64..1.0],
    ) {
        let t = Triangulation::new(&points).unwrap();
        if let Some((triangle, weights)) = t.locate(at) {
            let [a, b, c] = t.corners(triangle).map(|corner| t.points()[corner]);
            let double_area = (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
            let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
            let tolerance = (4e-15 * longest * longest / double_area).max(1e-15);
            for (ours, formula) in weights.iter().zip(weights_at([a, b, c], at)) {
                prop_assert!((ours - formula.max(0.0)).abs() < tolerance, "{} {}", ours, formula);
            }
            if longest * longest < 250.0 * double_area {
                prop_assert!(tolerance <= 1e-12);
            }
        }
    }

    /// The hint does not change the result of a point inside the hull.
    #[test]
    fn every_hint_finds_the_same(
        points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..40),
        at in [0.0_f64..1.0, 0.0_f64..1.0],
    ) {
        let t = Triangulation::new(&points).unwrap();
        let from_grid = t.locate(at);
        for hint in 0..t.triangles().len() + 2 {
            let mut hint = hint;
            let found = t.locate_near(at, &mut hint);
            prop_assert_eq!(found, from_grid);
            prop_assert!(found.is_none_or(|(triangle, _)| triangle == hint));
        }
    }

    /// Every interior point is found from every start: corners, and points on edges and inside triangles. Rounding may
    /// have moved such a point across an edge or out of the hull.
    #[test]
    fn no_walk_misses_what_is_inside(points in adversarial(), hint in 0_usize..200) {
        let t = Triangulation::new(&points).unwrap();
        // A flat triangle is treated as its longest edge, which costs 1e-8 of its length; coincident points are
        // separated by 1e-9.
        let (tolerance, rounding) = (2e-8 * size(&points), 1e-15 * size(&points));
        let mut hint = hint;
        for corners in t.triangles() {
            let [a, b, c] = corners.map(|corner| t.points()[corner]);
            for [u, v, w] in [[0.25, 0.25, 0.5], [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0], [0.1, 0.899, 0.001]] {
                let at = [0, 1].map(|axis| u * a[axis] + v * b[axis] + w * c[axis]);
                for found in [t.locate(at), t.locate_near(at, &mut hint)] {
                    let is_outside = t.nearest_on_outline(at).is_some_and(|(on, _)| distance(on, at) <= rounding);
                    let is_right = is_found(&t, at, found, tolerance) || (found.is_none() && is_outside);
                    prop_assert!(is_right, "{:?} in {:?}: {:?}", at, [a, b, c], found);
                }
            }
        }
        for corner in t.triangles().flatten() {
            let at = t.points()[corner];
            let found = t.locate_near(at, &mut hint);
            prop_assert!(is_found(&t, at, found, tolerance), "{:?}: {:?}", at, found);
        }
    }

    /// Distant points are outside from every hint, and the walk ends.
    #[test]
    fn no_walk_finds_what_is_outside(points in adversarial(), angle in 0.0_f64..6.3, hint in 0_usize..200) {
        let t = Triangulation::new(&points).unwrap();
        for far in [3.0, 1e3, 1e30, 1e300] {
            let at = [far * size(&points) * angle.cos(), far * size(&points) * angle.sin()];
            let mut hint = hint;
            prop_assert_eq!(t.locate_near(at, &mut hint), None);
            prop_assert_eq!(t.locate(at), None);
        }
    }

    /// Bulk loading uses all points, neighbors are mutual, and no corner lies inside a circumcircle of another
    /// triangle.
    #[test]
    fn triangles_are_delaunay(points in adversarial()) {
        let t = Triangulation::new(&points).unwrap();
        let n = t.points().len();
        if t.triangles().len() > 0 {
            // Euler's formula: two triangles for each point, minus those lost at the hull.
            prop_assert_eq!(t.triangles().len() + t.outline().len() + 2, 2 * n);
        }
        let mut open = 0;
        for (i, mine) in t.triangles().enumerate() {
            for (corner, neighbor) in t.neighbors(i).into_iter().enumerate() {
                let edge = [mine[(corner + 1) % 3], mine[(corner + 2) % 3]];
                let Some(neighbor) = neighbor else {
                    open += 1;
                    continue;
                };
                let others = t.corners(neighbor);
                prop_assert!(edge.iter().all(|v| others.contains(v)));
                prop_assert!(t.neighbors(neighbor).contains(&Some(i)));
                let Some(opposite) = others.into_iter().find(|v| !edge.contains(v)) else { unreachable!() };
                prop_assert!(in_circle(mine.map(|v| t.points()[v]), t.points()[opposite]) <= 1e-12);
            }
        }
        prop_assert!(t.triangles().len() == 0 || open == t.outline().len());
    }

    #[test]
    fn nearest_on_outline_is_no_farther_than_any_point_of_it(
        points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 1..20),
        at in [-2.0_f64..3.0, -2.0_f64..3.0],
    ) {
        let t = Triangulation::new(&points).unwrap();
        let (on, ends) = t.nearest_on_outline(at).unwrap();
        for [a, b] in t.outline() {
            for step in 0..=20 {
                let s = f64::from(step) / 20.0;
                let p = [0, 1].map(|k| (1.0 - s) * t.points()[*a][k] + s * t.points()[*b][k]);
                prop_assert!(distance(on, at) <= distance(p, at) + 1e-9);
            }
        }
        prop_assert!((ends[0].1 + ends[1].1 - 1.0).abs() < 1e-12);
    }
}

/// In-circle determinant, positive inside the circle, relative to the sum of the magnitudes of its products.
fn in_circle(triangle: [Xy; 3], at: Xy) -> f64 {
    let [a, b, c] = triangle.map(|p| {
        let [x, y] = [p[0] - at[0], p[1] - at[1]];
        [x, y, x * x + y * y]
    });
    let terms = [
        a[0] * b[1] * c[2],
        a[1] * b[2] * c[0],
        a[2] * b[0] * c[1],
        -a[2] * b[1] * c[0],
        -a[1] * b[0] * c[2],
        -a[0] * b[2] * c[1],
    ];
    terms.iter().sum::<f64>() / terms.iter().map(|t| t.abs()).sum::<f64>().max(f64::MIN_POSITIVE)
}

#[test]
fn among_many_points_the_grid_begins_close_by() {
    let mut random = Random::new(3);
    let points: Vec<Xy> = (0..20_000).map(|_| [random.uniform(), random.uniform()]).collect();
    let t = Triangulation::new(&points).unwrap();
    let (mut hint, mut farthest, mut n_inside) = (0, 0.0_f64, 0);
    for _ in 0..20_000 {
        let at = [random.uniform(), random.uniform()];
        let found = t.locate(at);
        assert_eq!(found, t.locate_near(at, &mut hint));
        let start = t.corners(t.grid.near(at)).map(|corner| t.points()[corner]);
        farthest = farthest.max(distance(start[0], at));
        n_inside += usize::from(is_found(&t, at, found, 1e-12));
    }
    // The mean distance between points is 0.007; about one point in a thousand lies outside the hull of as many points.
    assert!(farthest < 0.1, "{farthest}");
    assert!(n_inside > 19_900, "{n_inside}");
}

#[test]
fn what_is_no_point_is_nowhere_and_does_not_move_the_hint() {
    let t = Triangulation::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]).unwrap();
    for at in [[f64::NAN, 0.5], [0.5, f64::NAN], [f64::INFINITY, 0.5], [0.5, f64::NEG_INFINITY]] {
        let mut hint = 1;
        assert_eq!((t.locate(at), t.locate_near(at, &mut hint)), (None, None));
        assert!(hint < 2);
    }
    let mut hint = usize::MAX;
    assert!(t.locate_near([0.9, 0.8], &mut hint).is_some() && hint < 2);
}

#[test]
fn collinear_equal_and_single_points_are_chains() {
    let line = Triangulation::new(&[[0.0, 0.0], [2.0, 2.0], [1.0, 1.0]]).unwrap();
    assert_eq!(line.triangles().len(), 0);
    assert_eq!(line.outline(), [[0, 2], [2, 1]]);
    assert_eq!((line.locate([1.0, 1.0]), line.locate_near([1.0, 1.0], &mut 7)), (None, None));
    let one = Triangulation::new(&[[0.3, 0.4]]).unwrap();
    assert_eq!(one.nearest_on_outline([9.0, 9.0]).unwrap().1[0], (0, 1.0));
    assert_eq!(Triangulation::new(&[]).unwrap().nearest_on_outline([0.0, 0.0]), None);
    let twins = Triangulation::new(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).unwrap();
    assert_eq!(n_used(&twins), 4, "a point equal to another was lost");
}

fn n_used(t: &Triangulation) -> usize {
    t.triangles().flatten().collect::<std::collections::BTreeSet<_>>().len()
}

#[test]
fn zeros_of_either_sign_and_numbers_next_to_zero_are_one_place_and_none_is_lost() {
    for zero in [-0.0, 1e-50, 1e-200, -1e-200, f64::MIN_POSITIVE] {
        let t = Triangulation::new(&[[0.0, 0.0], [zero, 0.0], [0.0, zero], [1.0, 0.0], [0.0, 1.0]]).unwrap();
        assert_eq!(n_used(&t), 5, "the point at {zero} was lost");
        assert!(t.points().iter().flatten().all(|c| *c == 0.0 || c.abs() > 1e-42));
    }
}

#[test]
fn nonsense_coordinates_are_named() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let error = Triangulation::new(&[[0.0, 0.0], [1.0, bad]]).unwrap_err();
        assert_eq!(error, TriangulationError::Coordinate { index: 1 });
    }
}
