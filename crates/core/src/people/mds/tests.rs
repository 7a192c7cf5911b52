mod golden;
mod smacof;

use proptest::prelude::{ProptestConfig, prop_assert, proptest};

use super::objective::Objective;
use super::{
    ByDimension, MAX_DIMS, Mds, MdsError, MdsOptions, Transform, nonmetric, nonmetric_from, shepard, stress,
};
use crate::maths::procrustes::procrustes;
use crate::maths::rng::lcg_noise;
use crate::people::dissimilarities::Dissimilarities;
use smacof::smacof;

fn rows(values: &[f64], dims: usize) -> Vec<Vec<f64>> {
    values.chunks_exact(dims).map(<[f64]>::to_vec).collect()
}

fn distance(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Dissimilarities computed by `of` from the distance and index of each pair of points.
fn of_points(points: &[Vec<f64>], mut of: impl FnMut(f64, usize) -> Option<f64>) -> Dissimilarities {
    let mut condensed = Vec::new();
    for (i, p) in points.iter().enumerate() {
        for q in &points[i + 1..] {
            condensed.push(of(distance(p, q), condensed.len()));
        }
    }
    Dissimilarities::from_condensed(points.len(), condensed).unwrap()
}

/// Noisy dissimilarities of points in four dimensions; few `levels` make most of them tied.
fn noisy(n: usize, seed: u64, levels: f64) -> Dissimilarities {
    let noise = lcg_noise(n * n, seed + 1);
    let level = |d: f64, k: usize| (levels * d.powf(1.4) * (0.15 * noise[k]).exp()).round() / levels;
    of_points(&rows(&lcg_noise(4 * n, seed), 4), |d, k| Some(level(d, k)))
}

#[test]
fn the_gradient_is_the_slope() {
    for ties in [Transform::PrimaryTies, Transform::SecondaryTies, Transform::Interval] {
        for (dims, levels) in [(1, 2.0), (2, 2.0), (3, 1e6), (10, 5.0)] {
            let items = noisy(14, 5, levels);
            let mut objective = Objective::new(&items, ties);
            let at = lcg_noise(14 * dims, 77);
            let mut gradient = vec![0.0; at.len()];
            objective.evaluate(dims, &at, &mut gradient);
            let mut value = |k: usize, step: f64| {
                let mut moved = at.clone();
                moved[k] += step;
                objective.evaluate(dims, &moved, &mut vec![0.0; at.len()]).value
            };
            for (k, g) in gradient.iter().enumerate() {
                // Differences over 2e-6 of values near 0.1: rounding adds 1e-11, and a change of pools in the interval
                // adds 1e-6.
                let slope = (value(k, 1e-6) - value(k, -1e-6)) / 2e-6;
                assert!((g - slope).abs() < 1e-6, "{ties:?} in {dims}, coordinate {k}: {g} for {slope}");
            }
        }
    }
}

#[test]
fn what_comes_out_is_stationary_and_no_worse_than_smacof() {
    for (n, levels, ties) in [
        (12, 2.0, Transform::PrimaryTies),
        (30, 1e9, Transform::PrimaryTies),
        (20, 3.0, Transform::SecondaryTies),
        (20, 3.0, Transform::Interval),
    ] {
        let items = noisy(n, 100 + n as u64, levels);
        let condensed: Vec<f64> = items.pairs().map(|(_, _, value)| value).collect();
        for seed in 0..5 {
            let start = lcg_noise(2 * n, 500 + seed);
            let options = MdsOptions { transform: ties, ..MdsOptions::usual(1) };
            let found = nonmetric_from(&items, &rows(&start, 2), &options).unwrap();
            assert!(found.converged, "{found:?}");
            // A thousand further SMACOF steps gain nothing.
            let mut on = found.points.concat();
            let after = *smacof(&condensed, 2, ties, &mut on, 0.0).last().unwrap();
            assert!(found.stress - after < 1e-8, "{} falls to {after}", found.stress);
        }
    }
}

#[test]
fn points_are_found_again_from_the_order_of_their_distances() {
    let truth = rows(&lcg_noise(80, 8), 2);
    let items = of_points(&truth, |d, _| Some(d.powi(3)));
    let found = nonmetric(&items, 2, &MdsOptions::usual(1)).unwrap();
    assert!(found.converged && found.stress < 1e-4, "{}", found.stress);
    // The rank order of 780 distances almost determines the points.
    assert!(procrustes(&found.points, &truth).unwrap().r_squared > 0.9995);
}

#[test]
fn interval_scaling_finds_points_from_a_linear_function_of_their_distances() {
    let truth = rows(&lcg_noise(24, 8), 2);
    let items = of_points(&truth, |d, _| Some(0.5 + 2.0 * d));
    let options = MdsOptions { transform: Transform::Interval, ..MdsOptions::usual(1) };
    let found = nonmetric(&items, 2, &options).unwrap();
    assert!(found.stress < 1e-6, "{}", found.stress);
    assert!(procrustes(&found.points, &truth).unwrap().r_squared > 1.0 - 1e-9);
    // Disparities are a linear function of the dissimilarities.
    let pairs = shepard(&items, &found.points, Transform::Interval).unwrap();
    let slopes = pairs
        .windows(2)
        .map(|two| (two[1].disparity - two[0].disparity) / (two[1].dissimilarity - two[0].dissimilarity));
    let slopes: Vec<f64> = slopes.collect();
    assert!(slopes.iter().all(|slope| (slope / slopes[0] - 1.0).abs() < 1e-6), "{slopes:?}");
}

#[test]
fn only_the_order_of_dissimilarities_counts() {
    let items = noisy(20, 9, 1e9);
    let squared: Vec<Option<f64>> = items.pairs().map(|(_, _, d)| Some(d * d)).collect();
    let squared = Dissimilarities::from_condensed(20, squared).unwrap();
    let start = rows(&lcg_noise(40, 3), 2);
    let [one, other] =
        [&items, &squared].map(|items| nonmetric_from(items, &start, &MdsOptions::usual(1)).unwrap());
    assert_eq!((one.stress, one.n_steps), (other.stress, other.n_steps));
    let size = other.points[0][0] / one.points[0][0];
    for (a, b) in one.points.concat().iter().zip(other.points.concat()) {
        assert!((a * size - b).abs() < 1e-9);
    }
}

#[test]
fn points_are_centered_along_their_axes_and_as_large_as_the_dissimilarities() {
    let items = noisy(20, 4, 1e9);
    let found = nonmetric(&items, 3, &MdsOptions::usual(2)).unwrap();
    let sum = |of: &dyn Fn(&Vec<f64>) -> f64| found.points.iter().map(of).sum::<f64>();
    for axis in 0..3 {
        assert!(sum(&|p| p[axis]).abs() < 1e-12);
        for other in 0..axis {
            assert!(sum(&|p| p[axis] * p[other]).abs() < 1e-11);
            assert!(sum(&|p| p[axis] * p[axis]) < sum(&|p| p[other] * p[other]));
        }
    }
    let pairs = shepard(&items, &found.points, Transform::PrimaryTies).unwrap();
    let squares = |of: fn(&super::ShepardPair) -> f64| pairs.iter().map(|p| of(p) * of(p)).sum::<f64>();
    assert!((squares(|p| p.distance) / squares(|p| p.dissimilarity) - 1.0).abs() < 1e-12);
    assert_eq!(found.stress_by_start.len(), 21);
    assert!(found.stress_by_start.iter().all(|s| *s >= found.stress));
    assert_eq!(found, nonmetric(&items, 3, &MdsOptions::usual(2)).unwrap());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn disparities_are_a_projection(seed in 0_u64..1000, levels in 1_u32..6, primary: bool) {
        let items = noisy(12, seed, f64::from(levels));
        let points = rows(&lcg_noise(24, seed + 5000), 2);
        let ties = if primary { Transform::PrimaryTies } else { Transform::SecondaryTies };
        let pairs = shepard(&items, &points, ties).unwrap();
        prop_assert!(pairs.is_sorted_by(|a, b| a.dissimilarity <= b.dissimilarity && a.disparity <= b.disparity));
        for two in pairs.windows(2).filter(|two| two[0].dissimilarity == two[1].dissimilarity) {
            let primary = two[0].distance <= two[1].distance;
            let secondary = two[0].disparity == two[1].disparity;
            let in_order = if ties == Transform::PrimaryTies { primary } else { secondary };
            prop_assert!(in_order);
        }
        for pair in &pairs {
            let [i, j] = pair.items;
            prop_assert!(items.between(i, j) == Some(pair.dissimilarity));
            prop_assert!((distance(&points[i], &points[j]) - pair.distance).abs() < 1e-14);
        }
        // The residual of a projection onto a cone is orthogonal to the projection.
        let product: f64 = pairs.iter().map(|p| (p.distance - p.disparity) * p.disparity).sum();
        prop_assert!(product.abs() < 1e-11);
    }
}

#[test]
fn stress_is_what_the_result_says() {
    for ties in [Transform::PrimaryTies, Transform::SecondaryTies, Transform::Interval] {
        let items = noisy(15, 6, 3.0);
        let found = nonmetric(&items, 2, &MdsOptions { transform: ties, ..MdsOptions::usual(1) }).unwrap();
        // The points were rotated and scaled after their stress was computed.
        assert!((stress(&items, &found.points, ties).unwrap() - found.stress).abs() < 1e-12);
        let options = MdsOptions { transform: ties, ..MdsOptions::usual(1) };
        let scaling = ByDimension::new(&items, &options).unwrap();
        let mut by_dims = scaling.best(1..=4, None, &|| true).unwrap();
        // Continued later, it finds the same.
        let more = scaling.best(3..=4, Some(&by_dims[1]), &|| true).unwrap();
        assert_eq!(by_dims.split_off(2), more);
        by_dims.extend(more);
        let by_dims: Vec<f64> = by_dims.iter().map(|mds| mds.stress).collect();
        assert!(by_dims.is_sorted_by(|a, b| a >= b) && by_dims[1] <= found.stress, "{by_dims:?}");
    }
}

#[test]
fn pairs_that_were_never_compared_have_no_say() {
    let truth = rows(&lcg_noise(80, 8), 2);
    let items = of_points(&truth, |d, k| (k % 3 != 0).then_some(d));
    let found = nonmetric(&items, 2, &MdsOptions::usual(1)).unwrap();
    assert!(found.stress < 1e-3, "{}", found.stress);
    assert!(procrustes(&found.points, &truth).unwrap().r_squared > 0.999);
    assert_eq!(shepard(&items, &truth, Transform::PrimaryTies).unwrap().len(), 520);
}

#[test]
fn items_that_do_not_differ_may_coincide() {
    let mut truth = rows(&lcg_noise(24, 31), 2);
    truth.push(truth[3].clone());
    truth.push(truth[3].clone());
    let found = nonmetric(&of_points(&truth, |d, _| Some(d)), 2, &MdsOptions::usual(1)).unwrap();
    assert!(found.stress < 1e-3 && procrustes(&found.points, &truth).unwrap().r_squared > 0.98);
    // Coincident points in a start do not prevent scaling.
    let mut start = rows(&lcg_noise(28, 32), 2);
    start[5] = start[6].clone();
    let from = nonmetric_from(&of_points(&truth, |d, _| Some(d)), &start, &MdsOptions::usual(1)).unwrap();
    assert!(from.stress.is_finite());
}

#[test]
fn two_items_are_scaled_exactly() {
    let two = Dissimilarities::from_condensed(2, vec![Some(3.0)]).unwrap();
    let Mds { points, stress, converged, .. } = nonmetric(&two, 1, &MdsOptions::usual(1)).unwrap();
    assert!(stress == 0.0 && converged && (points[0][0].abs() - 1.5).abs() < 1e-15, "{points:?}");
}

#[test]
fn steps_that_run_out_are_said() {
    let found =
        nonmetric(&noisy(20, 9, 1e9), 2, &MdsOptions { max_steps: 2, ..MdsOptions::usual(1) }).unwrap();
    assert_eq!((found.converged, found.n_steps), (false, 2));
}

#[test]
fn what_cannot_be_scaled_is_named() {
    let usual = MdsOptions::usual(1);
    let of =
        |n: usize, condensed: &[Option<f64>]| Dissimilarities::from_condensed(n, condensed.to_vec()).unwrap();
    let items = of(4, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(Some));
    assert_eq!(nonmetric(&items, 0, &usual), Err(MdsError::Dims { dims: 0 }));
    assert_eq!(nonmetric(&items, MAX_DIMS + 1, &usual), Err(MdsError::Dims { dims: 11 }));
    assert_eq!(nonmetric(&items, 4, &usual), Err(MdsError::TooFew { dims: 4, n_items: 4 }));
    assert_eq!(nonmetric(&of(0, &[]), 1, &usual), Err(MdsError::TooFew { dims: 1, n_items: 0 }));
    assert!(nonmetric(&items, 3, &usual).is_ok());
    let equal = of(3, &[Some(2.0); 3]);
    assert_eq!(nonmetric(&equal, 1, &usual), Err(MdsError::AllEqual { value: 2.0 }));
    let apart = of(4, &[Some(1.0), None, None, None, None, Some(2.0)]);
    assert_eq!(nonmetric(&apart, 1, &usual), Err(MdsError::Apart { item: 2 }));
    let from = |start: &[Vec<f64>]| nonmetric_from(&items, start, &usual);
    assert_eq!(from(&[]), Err(MdsError::Shape { n_rows: 0, n_items: 4 }));
    assert_eq!(from(&[vec![1.0], vec![2.0], vec![3.0]]), Err(MdsError::Shape { n_rows: 3, n_items: 4 }));
    let ragged = [vec![1.0], vec![2.0], vec![3.0], vec![1.0, 2.0]];
    assert_eq!(from(&ragged), Err(MdsError::Shape { n_rows: 4, n_items: 4 }));
    assert_eq!(from(&vec![vec![]; 4]), Err(MdsError::OnePoint));
    assert_eq!(from(&vec![vec![1.0, 1.0]; 4]), Err(MdsError::OnePoint));
    let nan = [vec![1.0], vec![2.0], vec![f64::NAN], vec![4.0]];
    assert_eq!(from(&nan), Err(MdsError::NotFinite { item: 2 }));
}
