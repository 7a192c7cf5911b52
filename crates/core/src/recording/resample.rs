//! Interpolation of rows at irregular times to the regular clock.

/// Number of rows on each side that the interpolating polynomial passes through.
pub(super) const SIDE_ROWS: usize = 8;

/// Value at `time` of the polynomial of degree 15 through the eight rows on each side.
///
/// `times` must be strictly ascending. `after` is the index of the first time later than `time`, and at least
/// [`SIDE_ROWS`] from both ends. Uses the barycentric form (J.-P. Berrut and L. N. Trefethen, "Barycentric Lagrange
/// interpolation", 2004). For a sine at a quarter of the sample rate and a jitter of a fifth of a step, the error in
/// the middle is below 0.5 %.
pub(super) fn interpolate_local(times: &[f64], values: &[f64], after: usize, time: f64) -> f64 {
    let first = after - SIDE_ROWS;
    let nodes = &times[first..after + SIDE_ROWS];
    let (mut above, mut below) = (0.0, 0.0);
    // Distances in units of steps keep the products of fifteen factors near one.
    let per_step = (nodes.len() - 1) as f64 / (nodes[nodes.len() - 1] - nodes[0]);
    for (i, node) in nodes.iter().enumerate() {
        let away = (time - node) * per_step;
        if away == 0.0 {
            return values[first + i];
        }
        let product: f64 = nodes
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != i)
            .map(|(_, other)| (node - other) * per_step)
            .product();
        let weight = 1.0 / (product * away);
        above += weight * values[first + i];
        below += weight;
    }
    above / below
}

/// Linear interpolation between the rows around `time`.
pub(super) fn interpolate_line(times: &[f64], values: &[f64], after: usize, time: f64) -> f64 {
    let share = (time - times[after - 1]) / (times[after] - times[after - 1]);
    values[after - 1] + share * (values[after] - values[after - 1])
}

#[cfg(test)]
mod tests {
    use super::{SIDE_ROWS, interpolate_line, interpolate_local};
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::TAU;

    proptest! {
        #[test]
        fn a_sine_at_jittered_times_comes_back(
            jitter in prop::collection::vec(-0.2..0.2_f64, 40),
            cycles_per_row in 0.0..0.25_f64,
            phase in 0.0..TAU,
            at in 0.0..1.0_f64,
        ) {
            let times: Vec<f64> = jitter.iter().enumerate().map(|(i, j)| i as f64 + j).collect();
            let sine = |time: f64| (TAU * cycles_per_row * time + phase).sin();
            let time = 10.0 + 20.0 * at;
            let after = times.partition_point(|t| *t <= time);
            let got = interpolate_local(&times, &times.iter().map(|t| sine(*t)).collect::<Vec<_>>(), after, time);
            // The remainder is at most (2 pi f)^16 / 16! times the product of the sixteen distances: 0.003 for
            // equidistant times.
            prop_assert!((got - sine(time)).abs() < 5e-3, "got {got}, expected {}", sine(time));
        }

        #[test]
        fn polynomials_are_exact(coefficients in prop::collection::vec(-1.0..1.0_f64, 16), at in 0.0..1.0_f64) {
            let times: Vec<f64> = (0..16).map(|i| f64::from(i) + 0.1 * f64::from(i % 3)).collect();
            let polynomial = |t: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * (t - 7.5) / 8.0 + c);
            let time = 7.2 + 0.7 * at;
            let after = times.partition_point(|t| *t <= time);
            if after == SIDE_ROWS {
                let got = interpolate_local(&times, &times.iter().map(|t| polynomial(*t)).collect::<Vec<_>>(), after, time);
                // Rounding errors of values near ten, times a Lebesgue constant of two.
                prop_assert!((got - polynomial(time)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_row_comes_back_at_its_own_time() {
        let times: Vec<f64> = (0..16).map(f64::from).collect();
        let values: Vec<f64> = (0..16).map(|i| [7.0, 9.0][i % 2]).collect();
        assert_eq!(interpolate_local(&times, &values, 8, 7.0), 9.0);
        assert_eq!(interpolate_line(&times, &times, 8, 7.25), 7.25);
    }
}
