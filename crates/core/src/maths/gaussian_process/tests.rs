use nalgebra::{DMatrix, DVector};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};

use super::{GaussianProcess, GaussianProcessError};
use crate::maths::rng::lcg_noise;

/// Random feature rows, and a smooth function of them plus noise.
fn examples(n: usize, n_features: usize, noise: f64, seed: u64) -> (Vec<Vec<f64>>, Vec<f64>) {
    let values = lcg_noise(n * (n_features + 1), seed);
    let rows: Vec<Vec<f64>> = values[..n * n_features].chunks(n_features).map(<[f64]>::to_vec).collect();
    let smooth = |row: &Vec<f64>| 40.0 + 10.0 * (2.0 * row[0]).sin() + 6.0 * row[row.len() - 1];
    let targets =
        rows.iter().zip(&values[n * n_features..]).map(|(row, e)| smooth(row) + noise * e).collect();
    (rows, targets)
}

/// Reference implementation: the equations of Rasmussen and Williams with explicit matrix inverses.
fn oracle(learned: &GaussianProcess, values: &[f64], place: &[f64]) -> (f64, f64) {
    let n = values.len();
    let kernel = learned.kernel();
    let matrix = DMatrix::from_fn(n, n, |i, j| {
        kernel.of(&learned.places[i], &learned.places[j]) + if i == j { kernel.noise } else { 0.0 }
    });
    let inverse = matrix.try_inverse().unwrap();
    let mean = values.iter().sum::<f64>() / n as f64;
    let centered = DVector::from_iterator(n, values.iter().map(|v| v - mean));
    let scale = centered.dot(&(&inverse * &centered)) / n as f64;
    let place = learned.scaling.apply(place);
    let k = DVector::from_iterator(n, learned.places.iter().map(|known| kernel.of(&place, known)));
    let variance = kernel.of(&place, &place) + kernel.noise - k.dot(&(&inverse * &k));
    (mean + k.dot(&(&inverse * &centered)), (scale * variance).sqrt())
}

#[test]
fn a_prediction_is_that_of_the_textbook() {
    let (rows, values) = examples(20, 3, 1.0, 5);
    let learned = GaussianProcess::learn(&rows, &values).unwrap();
    for place in [vec![0.1, -0.4, 0.3], vec![3.0, 3.0, 3.0], rows[4].clone()] {
        let (mean, deviation) = oracle(&learned, &values, &place);
        let got = learned.at(&place);
        // Condition numbers of these matrices are below 1e5.
        assert!((got.mean - mean).abs() < 1e-8 && (got.deviation - deviation).abs() < 1e-8, "{got:?}");
    }
}

#[test]
fn leaving_one_out_is_learning_without_it_with_the_same_kernel() {
    let (rows, values) = examples(12, 2, 0.5, 9);
    let learned = GaussianProcess::learn(&rows, &values).unwrap();
    let all = learned.leave_one_out();
    let kernel = learned.kernel();
    let mean = values.iter().sum::<f64>() / 12.0;
    for (index, got) in all.iter().enumerate() {
        let others: Vec<usize> = (0..12).filter(|i| *i != index).collect();
        let matrix = DMatrix::from_fn(11, 11, |i, j| {
            kernel.of(&learned.places[others[i]], &learned.places[others[j]])
                + if i == j { kernel.noise } else { 0.0 }
        });
        let inverse = matrix.try_inverse().unwrap();
        let k = DVector::from_iterator(
            11,
            others.iter().map(|i| kernel.of(&learned.places[index], &learned.places[*i])),
        );
        let centered = DVector::from_iterator(11, others.iter().map(|i| values[*i] - mean));
        let expected = mean + k.dot(&(&inverse * centered));
        assert!((got.mean - expected).abs() < 1e-8, "example {index}: got {}, expected {expected}", got.mean);
        let own = kernel.of(&learned.places[index], &learned.places[index]) + kernel.noise;
        let variance = learned.signal_variance * (own - k.dot(&(&inverse * &k)));
        assert!((got.deviation - variance.sqrt()).abs() < 1e-8);
    }
}

#[test]
fn it_finds_a_curve_and_says_how_unsure_it_is() {
    let (rows, values) = examples(60, 2, 0.2, 3);
    let learned = GaussianProcess::learn(&rows, &values).unwrap();
    let (new, truth) = examples(40, 2, 0.0, 4);
    let (mut z, mut errors) = (Vec::new(), Vec::new());
    for (row, truth) in new.iter().zip(&truth) {
        let got = learned.at(row);
        errors.push((got.mean - truth).abs());
        z.push((got.mean - truth) / got.deviation);
    }
    // The target values have a standard deviation of 9.
    assert!(errors.iter().sum::<f64>() / errors.len() as f64 <= 1.0, "{errors:?}");
    let spread = (z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64).sqrt();
    assert!((0.1..2.0).contains(&spread), "{spread}");
    let (near, far) = (learned.at(&rows[0]), learned.at(&[9.0, -9.0]));
    assert!(far.deviation > 3.0 * near.deviation, "{near:?} {far:?}");
}

#[test]
fn equal_values_are_said_again_and_constant_features_say_nothing() {
    let (mut rows, values) = examples(10, 2, 0.1, 7);
    let equal = GaussianProcess::learn(&rows, &[5.0; 10]).unwrap().at(&[0.3, 0.3]);
    assert!((equal.mean - 5.0).abs() < 1e-9 && equal.deviation < 1e-3, "{equal:?}");
    let before = GaussianProcess::learn(&rows, &values).unwrap().at(&[0.2, 0.2]);
    for row in &mut rows {
        row.insert(1, 4.0);
    }
    // A feature that is constant in training is ignored, whatever its value in a later prediction.
    assert_eq!(GaussianProcess::learn(&rows, &values).unwrap().at(&[0.2, 77.0, 0.2]), before);
}

#[test]
fn what_cannot_be_learned_from_is_named() {
    let (rows, values) = examples(6, 2, 0.1, 7);
    let learn = |rows: &[Vec<f64>], values: &[f64]| GaussianProcess::learn(rows, values).unwrap_err();
    assert_eq!(learn(&rows[..3], &values[..3]), GaussianProcessError::TooFew { n: 3 });
    assert_eq!(learn(&vec![vec![1.0]; 6], &values), GaussianProcessError::Alike);
    let mut odd = rows.clone();
    odd[2].pop();
    assert_eq!(learn(&odd, &values), GaussianProcessError::Shape { index: 2, n: 1, expected: 2 });
    let mut broken = values.clone();
    broken[5] = f64::NAN;
    assert_eq!(learn(&rows, &broken), GaussianProcessError::NotFinite { index: 5 });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn units_of_features_and_values_do_not_matter(scale in 0.01..100.0_f64, shift in -50.0..50.0_f64, seed in 0..99_u64) {
        let (rows, values) = examples(9, 2, 1.0, seed);
        let scaled: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().map(|x| scale * x + shift).collect()).collect();
        let moved: Vec<f64> = values.iter().map(|v| 2.0 * v - 7.0).collect();
        let place = [0.1, 0.6];
        let once = GaussianProcess::learn(&rows, &values).unwrap().at(&place);
        let again = GaussianProcess::learn(&scaled, &moved).unwrap().at(&place.map(|x| scale * x + shift));
        prop_assert!((2.0 * once.mean - 7.0 - again.mean).abs() < 1e-5, "{once:?} {again:?}");
        prop_assert!((2.0 * once.deviation - again.deviation).abs() < 1e-5);
    }
}
