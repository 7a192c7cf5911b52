//! Sums over samples, written for automatic vectorization: with several accumulators the compiler may reorder
//! additions; with one it may not.

use std::ops::{Add, AddAssign, Mul};

use pulp::{Arch, Simd, WithSimd};

/// Number of accumulators for one sum.
const N_LANES: usize = 8;

/// Number of lags summed in one pass. With [`LAG_LANES`] accumulators each, they use half of 16 vector registers.
const N_LAGS: usize = 4;

/// Number of accumulators for each lag.
const LAG_LANES: usize = 4;

/// `Σ value(x)`.
pub(crate) fn sum_of(x: &[f64], value: impl Fn(f64) -> f64) -> f64 {
    let chunks = x.chunks_exact(N_LANES);
    let rest: f64 = chunks.remainder().iter().map(|v| value(*v)).sum();
    let mut lanes = [0.0; N_LANES];
    for chunk in chunks {
        for (lane, v) in lanes.iter_mut().zip(chunk) {
            *lane += value(*v);
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// Adds values times a factor, one by one.
pub(crate) fn add_times<T: Copy + AddAssign + Mul<Output = T>>(values: &[T], factor: T, sum: &mut [T]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * *value;
    }
}

/// Adds each column times its factor to `sum`, in the order of the columns. `columns` has one column of `n_rows` values after
/// the other, one for each factor. Only the first rows of a column are added if `sum` is shorter.
pub(crate) fn add_columns<T>(columns: &[T], factors: &[T], n_rows: usize, sum: &mut [T])
where
    T: Copy + Add<Output = T> + AddAssign + Mul<Output = T>,
{
    Arch::new().dispatch(AddColumns { columns, factors, n_rows, sum });
}

/// Arguments of [`add_columns`].
struct AddColumns<'a, T> {
    columns: &'a [T],
    factors: &'a [T],
    n_rows: usize,
    sum: &'a mut [T],
}

impl<T> WithSimd for AddColumns<'_, T>
where
    T: Copy + Add<Output = T> + AddAssign + Mul<Output = T>,
{
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "without inlining, the loop is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { columns, factors, n_rows, sum } = self;
        // Four columns at once, so that the sums are read and written a quarter as often. The order of the additions is that
        // of the columns.
        let mut fours = factors.chunks_exact(4);
        let mut rest = columns;
        for four in &mut fours {
            let (now, later) = rest.split_at(4 * n_rows);
            let (first, others) = now.split_at(n_rows);
            let (second, others) = others.split_at(n_rows);
            let (third, fourth) = others.split_at(n_rows);
            for ((((sum, a), b), c), d) in sum.iter_mut().zip(first).zip(second).zip(third).zip(fourth) {
                *sum = *sum + four[0] * *a + four[1] * *b + four[2] * *c + four[3] * *d;
            }
            rest = later;
        }
        for (factor, column) in fours.remainder().iter().zip(rest.chunks_exact(n_rows)) {
            for (sum, x) in sum.iter_mut().zip(column) {
                *sum += *factor * *x;
            }
        }
    }
}

/// Autocorrelation sums `Σ x[i] x[i + k]` for each lag `k` from 0 to `max_lag`. `max_lag` must be below the length;
/// `energy` is the sum at lag 0.
///
/// Computed directly: up to the highest model order in use this is exact and faster than two Fourier transforms.
pub(crate) fn lag_sums(x: &[f64], energy: f64, max_lag: usize) -> Vec<f64> {
    let mut sums = Vec::with_capacity(max_lag + N_LAGS);
    sums.push(energy);
    while sums.len() <= max_lag {
        let first = sums.len();
        sums.extend(four_lags(x, first));
    }
    sums.truncate(max_lag + 1);
    sums
}

/// Sums for the lags `first` to `first + 3`; zero for a lag not shorter than the signal.
fn four_lags(x: &[f64], first: usize) -> [f64; N_LAGS] {
    let n_common = x.len().saturating_sub(first + N_LAGS - 1);
    let n_chunked = n_common - n_common % LAG_LANES;
    let mut lanes = [[0.0; LAG_LANES]; N_LAGS];
    let later = x.get(first..).unwrap_or_default();
    for (chunk, start) in x[..n_chunked].chunks_exact(LAG_LANES).zip(0..) {
        let shifted = &later[LAG_LANES * start..][..LAG_LANES + N_LAGS - 1];
        for (lag, lanes) in lanes.iter_mut().enumerate() {
            for j in 0..LAG_LANES {
                lanes[j] += chunk[j] * shifted[j + lag];
            }
        }
    }
    let mut sums = lanes.map(|lanes| lanes.iter().sum::<f64>());
    for (lag, sum) in sums.iter_mut().enumerate() {
        let later = later.get(n_chunked + lag..).unwrap_or_default();
        *sum += x[n_chunked..].iter().zip(later).map(|(a, b)| a * b).sum::<f64>();
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::{lag_sums, sum_of};
    use crate::maths::rng::lcg_noise;

    #[test]
    fn sums_are_those_of_the_plain_loops() {
        for n in [1, 2, 5, 8, 21, 22, 40, 333] {
            let x = lcg_noise(n, 3);
            let energy = sum_of(&x, |v| v * v);
            for max_lag in [0, 1, 4, 20] {
                let max_lag = max_lag.min(n - 1);
                let got = lag_sums(&x, energy, max_lag);
                assert_eq!(got.len(), max_lag + 1);
                for (k, got) in got.iter().enumerate() {
                    let plain: f64 = x.iter().zip(&x[k..]).map(|(a, b)| a * b).sum();
                    // A few rounding errors of a sum of up to 333 numbers near one.
                    assert!((got - plain).abs() < 1e-12, "{n} samples, lag {k}: got {got}, expected {plain}");
                }
            }
        }
    }
}
