//! Two-dimensional Fourier series of square periodic arrays, stored row by row.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Fourier coefficients C of an `n` × `n` array, so that `value[y][x] = Σ C[j][i] exp(2πi (i x + j y) / n)`. Row j and
/// column i of the result belong to the wave numbers [`wave_number`] of j and i.
///
/// The number of values must be a square.
pub(crate) fn coefficients(values: &[f64]) -> Vec<Complex<f64>> {
    let scale = 1.0 / values.len().max(1) as f64;
    let mut field: Vec<Complex<f64>> = values.iter().map(|value| Complex::new(scale * value, 0.0)).collect();
    let n = field.len().isqrt();
    if n > 0 {
        let rows = FftPlanner::new().plan_fft_forward(n);
        for _ in 0..2 {
            rows.process(&mut field);
            transpose(&mut field, n);
        }
    }
    field
}

/// Replaces Fourier coefficients, as [`coefficients`] returns them, by the values of their series.
pub(crate) fn series(field: &mut [Complex<f64>]) {
    let n = field.len().isqrt();
    if n > 0 {
        let rows = FftPlanner::new().plan_fft_inverse(n);
        for _ in 0..2 {
            rows.process(field);
            transpose(field, n);
        }
    }
}

/// Wave number of a row or column of coefficients in cycles per side: `-n/2 + 1` to `n/2`.
pub(crate) fn wave_number(index: usize, n: usize) -> isize {
    let index = index.cast_signed();
    if 2 * index > n.cast_signed() { index - n.cast_signed() } else { index }
}

/// Row or column of the coefficients of a wave number, from `-n/2 + 1` to `n/2`.
pub(crate) fn index_of(wave_number: isize, n: usize) -> usize {
    wave_number.rem_euclid(n.cast_signed()).cast_unsigned()
}

/// Swaps the rows and the columns of an `n` × `n` array.
pub(crate) fn transpose<T>(values: &mut [T], n: usize) {
    const BLOCK: usize = 32;
    for row_block in (0..n).step_by(BLOCK) {
        for column_block in (row_block..n).step_by(BLOCK) {
            for row in row_block..(row_block + BLOCK).min(n) {
                for column in column_block.max(row + 1)..(column_block + BLOCK).min(n) {
                    values.swap(row * n + column, column * n + row);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Complex, coefficients, index_of, series, wave_number};
    use crate::maths::rng::lcg_noise;
    use std::f64::consts::TAU;

    #[test]
    fn coefficients_are_those_of_the_definition() {
        for n in [2, 8, 12] {
            let values = lcg_noise(n * n, 5);
            let found = coefficients(&values);
            for (at, got) in found.iter().enumerate() {
                let (i, j) = (wave_number(at % n, n), wave_number(at / n, n));
                let wave = |k: usize| {
                    let phase = (i * (k % n).cast_signed() + j * (k / n).cast_signed()) as f64 / n as f64;
                    Complex::from_polar(1.0, -TAU * phase)
                };
                let expected: Complex<f64> =
                    values.iter().enumerate().map(|(k, value)| wave(k) * *value).sum::<Complex<f64>>()
                        / (n * n) as f64;
                assert!((got - expected).norm() < 1e-13, "{got} is not {expected} at {i}, {j} of {n}");
                assert_eq!(index_of(j, n) * n + index_of(i, n), at);
            }
            let mut back = found;
            series(&mut back);
            for (value, got) in values.iter().zip(&back) {
                assert!((got - Complex::new(*value, 0.0)).norm() < 1e-13);
            }
        }
    }

    #[test]
    fn an_empty_array_has_no_coefficients() {
        assert!(coefficients(&[]).is_empty());
        series(&mut []);
    }
}
