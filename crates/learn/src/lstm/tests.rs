use candle_core::{Device, Tensor, Var};

use super::gates::{sigmoid, tanh};
use super::tiles::Tiles;
use super::{Exactness, lstm, step_by_step};
use crate::init::Uniform;

fn noise(shape: &[usize], scale: f32, seed: u64) -> Tensor {
    let n = shape.iter().product();
    Tensor::from_vec(Uniform::new(seed).within(scale, n), shape, &Device::Cpu).unwrap()
}

fn largest_difference(a: &Tensor, b: &Tensor) -> f32 {
    (a - b).unwrap().abs().unwrap().flatten_all().unwrap().max(0).unwrap().to_scalar().unwrap()
}

#[test]
fn curves_are_those_of_the_standard_library() {
    for step in -4000..=4000_i16 {
        let x = f32::from(step) * 0.025;
        let exact = f64::from(x);
        assert!((f64::from(tanh(x)) - exact.tanh()).abs() < 2e-7, "tanh {x}");
        assert!((f64::from(sigmoid(x)) - 1.0 / (1.0 + (-exact).exp())).abs() < 2e-7, "sigmoid {x}");
    }
    assert!(tanh(f32::NAN).is_nan() && sigmoid(f32::NAN).is_nan());
    assert_eq!((tanh(f32::INFINITY), sigmoid(f32::NEG_INFINITY) < 1e-30), (1.0, true));
}

#[test]
fn a_product_by_tiles_is_its_definition_to_half_a_unit_of_each_row() {
    for (n_rows, n_columns) in [(1, 1), (7, 3), (8, 64), (19, 100)] {
        let row = Uniform::new(1).within(1.0, n_rows);
        let mut matrix = Uniform::new(2).within(1.0, n_rows * n_columns);
        // Rows of very different magnitude: zero and subnormal rows as well.
        for (index, row) in matrix.chunks_exact_mut(n_columns).enumerate() {
            let factor = [1.0, 1e-6, 1e6, 0.0, 1e-44][index % 5];
            for x in row {
                *x *= factor;
            }
        }
        let before = Uniform::new(3).within(1.0, n_columns);
        let mut tiles = Tiles::of(&matrix, n_columns);
        let largest = |r: usize| {
            matrix[r * n_columns..][..n_columns]
                .iter()
                .fold(0.0, |most, x| f64::max(most, f64::from(x.abs())))
        };
        // Each row separately, within half of its quantization step.
        for r in 0..n_rows {
            let mut one = vec![0.0; n_rows];
            one[r] = 1.0;
            let mut sums = vec![0.0; n_columns];
            tiles.add_product(&one, &mut sums);
            for (sum, weight) in sums.iter().zip(&matrix[r * n_columns..]) {
                assert!((f64::from(*sum) - f64::from(*weight)).abs() <= 1.6e-5 * largest(r) + 1e-40);
            }
        }
        let mut sums = before.clone();
        tiles.add_product(&row, &mut sums);
        let within: f64 = (0..n_rows).map(|r| f64::from(row[r].abs()) * largest(r) * 1.6e-5).sum();
        for (c, (sum, before)) in sums.iter().zip(&before).enumerate() {
            let product = |r: usize| f64::from(row[r]) * f64::from(matrix[r * n_columns + c]);
            let expected = f64::from(*before) + (0..n_rows).map(product).sum::<f64>();
            assert!((f64::from(*sum) - expected).abs() <= within + 1e-6, "{sum} {expected} {within}");
        }
    }
}

#[test]
fn what_is_no_number_stays_none() {
    for none in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut sums = vec![0.0; 70];
        let mut matrix = vec![0.5; 3 * 70];
        matrix[100] = none;
        Tiles::of(&matrix, 70).add_product(&[0.1, 0.2, 0.3], &mut sums);
        assert!(sums.iter().all(|sum| !sum.is_finite()), "{none}");
    }
}

#[test]
fn weights_of_sixteen_bits_change_states_by_little() {
    for (n_steps, n_sequences, n_units) in [(200, 1, 128), (30, 3, 17), (30, 5, 17)] {
        let inputs = noise(&[n_steps, n_sequences, 4 * n_units], 1.5, 1);
        let weights = noise(&[n_units, 4 * n_units], 0.1, 2);
        let [full, quick] = [Exactness::Full, Exactness::Sixteen]
            .map(|exactness| lstm(&inputs, &weights, exactness).unwrap());
        let difference = largest_difference(&full, &quick);
        assert!(difference < 2e-5, "{difference}");
        assert_eq!(difference > 0.0, n_sequences < 4, "large batches must use full precision");
    }
}

#[test]
fn one_operation_is_the_same_as_many_there_and_back() {
    // Cases: a single step, and unit counts that do not fill a SIMD vector.
    for (n_steps, n_sequences, n_units) in [(6, 5, 8), (9, 2, 5), (1, 3, 4), (4, 1, 17)] {
        let inputs = Var::from_tensor(&noise(&[n_steps, n_sequences, 4 * n_units], 1.5, 1)).unwrap();
        let weights = Var::from_tensor(&noise(&[n_units, 4 * n_units], 0.7, 2)).unwrap();
        let wanted = noise(&[n_steps, n_sequences, n_units], 1.0, 3);
        let run = |layer: fn(&Tensor, &Tensor) -> candle_core::Result<Tensor>| {
            let states = layer(&inputs, &weights).unwrap();
            let gradients = (&states * &wanted).unwrap().sum_all().unwrap().backward().unwrap();
            let of = |var: &Var| gradients.get(var).cloned();
            (states, of(&inputs).unwrap(), of(&weights))
        };
        let (fused, slow) =
            (run(|inputs, weights| lstm(inputs, weights, Exactness::Full)), run(step_by_step));
        assert!(largest_difference(&fused.0, &slow.0) < 1e-6);
        assert!(largest_difference(&fused.1, &slow.1) < 1e-5);
        let zero = weights.zeros_like().unwrap();
        // A single step has no previous state.
        let [fused, slow] = [fused.2, slow.2].map(|gradient| gradient.unwrap_or(zero.clone()));
        assert!(largest_difference(&fused, &slow) < 1e-5);
    }
}

#[test]
fn shapes_that_do_not_fit_are_refused() {
    let error = lstm(&noise(&[3, 2, 16], 1.0, 1), &noise(&[5, 20], 1.0, 2), Exactness::Full).unwrap_err();
    assert!(error.to_string().contains("16"), "{error}");
}
