//! Nearest point of a convex hull in several dimensions (P. Wolfe, "Finding the nearest point in a polytope", 1976).
//!
//! The nearest point is a convex combination of at most one more point than there are dimensions. The algorithm keeps such
//! a set of points, adds the one that lies farthest toward the target, and drops those whose weight falls to zero.

use nalgebra::{DMatrix, DVector};

/// Progress toward the target below which no point lies farther, relative to the largest squared distance.
const STOP: f64 = 1e-14;
/// Weight below which a point takes no part.
const LEAST_WEIGHT: f64 = 1e-12;
/// Largest number of steps; a few for each dimension suffice.
const MOST_STEPS: usize = 500;

/// Indices of points with their weights.
type Weighted = Vec<(usize, f64)>;

/// Returns the point of the convex hull of `points` that is nearest to `to`, with the points that it is a mean of and their
/// weights, which are positive and sum to one. `None` without points.
///
/// `to` must be finite. Cost: a few passes over the points for each dimension.
pub(crate) fn nearest_in_hull<const N: usize>(
    points: &[[f64; N]],
    to: [f64; N],
) -> Option<([f64; N], Weighted)> {
    let off = |index: usize| -> [f64; N] { std::array::from_fn(|axis| points[index][axis] - to[axis]) };
    let squared = |index: usize| dot(&off(index), &off(index));
    let nearest = (0..points.len()).min_by(|a, b| squared(*a).total_cmp(&squared(*b)))?;
    let largest = (0..points.len()).map(squared).fold(0.0, f64::max);
    let mut corral = vec![(nearest, 1.0)];
    let mut x = off(nearest);
    for _ in 0..MOST_STEPS {
        let toward = |index: &usize| dot(&x, &off(*index));
        let next = (0..points.len()).min_by(|a, b| toward(a).total_cmp(&toward(b)))?;
        let is_there = corral.iter().any(|(index, _)| *index == next);
        if is_there || dot(&x, &x) - toward(&next) <= STOP * largest {
            break;
        }
        corral.push((next, 0.0));
        // Without a unique solution, the points are degenerate and the present one is as near as can be told.
        let Some(better) = shortest(corral.clone(), &off) else {
            corral.pop();
            break;
        };
        corral = better;
        let before = dot(&x, &x);
        x = std::array::from_fn(|axis| corral.iter().map(|(index, weight)| weight * off(*index)[axis]).sum());
        if dot(&x, &x) >= before {
            break;
        }
    }
    let at =
        std::array::from_fn(|axis| corral.iter().map(|(index, weight)| weight * points[*index][axis]).sum());
    Some((at, corral))
}

/// Moves the weights of a corral to its shortest convex combination, dropping points whose weight falls to zero.
fn shortest<const N: usize>(mut corral: Weighted, off: &impl Fn(usize) -> [f64; N]) -> Option<Weighted> {
    loop {
        let wanted = affine(&corral, off)?;
        if wanted.iter().all(|weight| *weight > LEAST_WEIGHT) {
            return Some(corral.iter().zip(wanted).map(|((index, _), weight)| (*index, weight)).collect());
        }
        let steps = corral.iter().zip(&wanted).filter(|(_, wanted)| **wanted <= LEAST_WEIGHT);
        let step = steps.map(|((_, weight), wanted)| weight / (weight - wanted)).fold(1.0, f64::min);
        for ((_, weight), wanted) in corral.iter_mut().zip(&wanted) {
            *weight += step * (wanted - *weight);
        }
        let n_before = corral.len();
        corral.retain(|(_, weight)| *weight > LEAST_WEIGHT);
        if corral.len() == n_before || corral.is_empty() {
            return None;
        }
        let sum: f64 = corral.iter().map(|(_, weight)| weight).sum();
        for (_, weight) in &mut corral {
            *weight /= sum;
        }
    }
}

/// Weights, of any sign and with the sum one, of the shortest combination of some points: the solution of
/// `(1 1ᵀ + PᵀP) u = 1`, scaled. `None` if the points are affinely dependent.
fn affine<const N: usize>(corral: &[(usize, f64)], off: &impl Fn(usize) -> [f64; N]) -> Option<Vec<f64>> {
    let vectors: Vec<[f64; N]> = corral.iter().map(|(index, _)| off(*index)).collect();
    // Of the size of the points, so that both terms count alike.
    let scale = vectors.iter().map(|vector| dot(vector, vector)).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let n = vectors.len();
    let gram = DMatrix::from_fn(n, n, |i, j| 1.0 + dot(&vectors[i], &vectors[j]) / scale);
    let solved = gram.cholesky()?.solve(&DVector::from_element(n, 1.0));
    let sum = solved.sum();
    let weights: Vec<f64> = solved.iter().map(|weight| weight / sum).collect();
    weights.iter().all(|weight| weight.is_finite()).then_some(weights)
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{dot, nearest_in_hull};
    use crate::maths::triangulation::Triangulation;
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn few_points_in_closed_form() {
        assert_eq!(nearest_in_hull::<3>(&[], [0.0; 3]), None);
        let one = nearest_in_hull(&[[1.0, 2.0, 3.0]], [0.0; 3]).unwrap();
        assert_eq!(one, ([1.0, 2.0, 3.0], vec![(0, 1.0)]));
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        let (at, weights) = nearest_in_hull(&corners, [0.0; 3]).unwrap();
        assert!(at.iter().all(|x| (x - 1.0 / 3.0).abs() < 1e-9) && weights.len() == 3, "{at:?}");
        let (at, _) = nearest_in_hull(&corners, [0.9, 0.3, -1.0]).unwrap();
        assert!((at[0] - 0.8).abs() < 1e-9 && (at[1] - 0.2).abs() < 1e-9 && at[2].abs() < 1e-9, "{at:?}");
    }

    proptest! {
        /// The result is optimal if no point of the hull lies farther toward the target.
        #[test]
        fn no_point_of_the_hull_is_nearer(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0, 0.0_f64..1.0, 0.0_f64..1.0, 0.0_f64..1.0, 0.0_f64..1.0], 1..60),
            to in [-0.3_f64..1.3, -0.3_f64..1.3, -0.3_f64..1.3, -0.3_f64..1.3, -0.3_f64..1.3, -0.3_f64..1.3],
            n_doubled in 0_usize..5,
        ) {
            let doubled: Vec<[f64; 6]> = points.iter().take(n_doubled).copied().collect();
            let all = [points, doubled].concat();
            let (at, weights) = nearest_in_hull(&all, to).unwrap();
            prop_assert!(weights.len() <= 7 && weights.iter().all(|(_, weight)| *weight > 0.0));
            prop_assert!((weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-9);
            let rest: [f64; 6] = std::array::from_fn(|axis| to[axis] - at[axis]);
            for point in &all {
                let off: [f64; 6] = std::array::from_fn(|axis| point[axis] - at[axis]);
                prop_assert!(dot(&rest, &off) < 1e-7, "{point:?} lies farther");
            }
        }

        /// In the plane, the triangulation is the oracle.
        #[test]
        fn in_the_plane_it_is_the_nearest_point_of_the_outline(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..40),
            to in [-0.5_f64..1.5, -0.5_f64..1.5],
        ) {
            let triangulation = Triangulation::new(&points).unwrap();
            let expected = match triangulation.locate(to) {
                Some(_) => to,
                None => triangulation.nearest_on_outline(to).unwrap().0,
            };
            let (at, _) = nearest_in_hull(&points, to).unwrap();
            prop_assert!((at[0] - expected[0]).hypot(at[1] - expected[1]) < 1e-6, "{at:?} for {expected:?}");
        }
    }
}
