//! Tip speed computed from positions.

use std::f64::consts::{LN_2, TAU};

/// Cutoff frequency (gain 1/√2) of the position smoothing, in Hz; hand speed does not change faster.
pub const SPEED_CUTOFF_HZ: f64 = 20.0;
/// Half width of the smoothing window, in standard deviations.
const WINDOW_DEVIATIONS: f64 = 4.0;
/// Rate at which speeds are computed, in Hz: 25 times [`SPEED_CUTOFF_HZ`], so that linear interpolation has an error
/// below 0.8 %.
const SPEED_RATE_HZ: f64 = 500.0;

/// Speed in m/s at each of `times` (s, strictly ascending), from `positions` (m, one slice for each axis) at these
/// times.
///
/// At each time, a line is fitted to each axis by least squares with Gaussian weights. The speed is the norm of the
/// slopes. Away from the ends this equals the derivative after a zero-delay low-pass filter `exp(-(2πfσ)²/2)`; σ gives
/// a gain of 1/√2 at [`SPEED_CUTOFF_HZ`]. Irregular times and the ends need no special treatment. Zero if there are
/// fewer than two times.
pub fn speed_from_positions(times: &[f64], positions: &[&[f64]]) -> Vec<f64> {
    let sigma = LN_2.sqrt() / (TAU * SPEED_CUTOFF_HZ);
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Vec::new() };
    let spacing = 1.0 / SPEED_RATE_HZ;
    let n_knots = ((last - first) / spacing).floor() as usize + 2;
    if times.len() <= n_knots {
        return times.iter().map(|time| speed_at(times, positions, *time, sigma)).collect();
    }
    let knots: Vec<f64> =
        (0..n_knots).map(|i| speed_at(times, positions, first + i as f64 * spacing, sigma)).collect();
    times
        .iter()
        .map(|time| {
            let place = (time - first) / spacing;
            let knot = (place.floor() as usize).min(n_knots - 2);
            let share = place - knot as f64;
            knots[knot] + share * (knots[knot + 1] - knots[knot])
        })
        .collect()
}

fn speed_at(times: &[f64], positions: &[&[f64]], time: f64, sigma: f64) -> f64 {
    let reach = WINDOW_DEVIATIONS * sigma;
    let mut first = times.partition_point(|t| *t < time - reach);
    let mut end = times.partition_point(|t| *t <= time + reach);
    // At a low rate, only the neighboring samples are available.
    if end - first < 3 {
        first = first.saturating_sub(1);
        end = (end + 1).min(times.len());
    }
    let mut weights = Vec::with_capacity(end - first);
    let (mut sum, mut moment) = (0.0, 0.0);
    for t in &times[first..end] {
        let weight = (-0.5 * ((t - time) / sigma).powi(2)).exp().max(f64::MIN_POSITIVE);
        weights.push(weight);
        sum += weight;
        moment += weight * t;
    }
    let middle = moment / sum;
    let spread: f64 =
        weights.iter().zip(&times[first..end]).map(|(weight, t)| weight * (t - middle).powi(2)).sum();
    if spread <= 0.0 {
        return 0.0;
    }
    let slope = |axis: &&[f64]| {
        let part = weights.iter().zip(&times[first..end]).zip(&axis[first..end]);
        part.map(|((weight, t), position)| weight * (t - middle) * position).sum::<f64>() / spread
    };
    positions.iter().map(|axis| slope(axis).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::{SPEED_CUTOFF_HZ, speed_from_positions};
    use std::f64::consts::TAU;

    #[test]
    fn straight_lines_have_their_speed_at_the_ends_too() {
        // Irregular times.
        let times: Vec<f64> = (0..500).map(|i| f64::from(i) * 1e-3 + 2e-4 * f64::from(i % 3)).collect();
        let x: Vec<f64> = times.iter().map(|t| 1.0 + 0.3 * t).collect();
        let y: Vec<f64> = times.iter().map(|t| -0.4 * t).collect();
        let speeds = speed_from_positions(&times, &[&x, &y]);
        assert!(speeds.iter().all(|speed| (speed - 0.5).abs() < 1e-9), "{speeds:?}");
        assert!(speed_from_positions(&[], &[]).is_empty());
        assert_eq!(speed_from_positions(&[1.0], &[&[2.0]]), [0.0]);
    }

    #[test]
    fn at_the_cutoff_the_gain_is_that_of_three_decibels() {
        for rate in [1000.0, 48_000.0] {
            let times: Vec<f64> = (0..rate as usize).map(|i| i as f64 / rate).collect();
            let turn = TAU * SPEED_CUTOFF_HZ;
            let x: Vec<f64> = times.iter().map(|t| 0.01 * (turn * t).sin()).collect();
            let speeds = speed_from_positions(&times, &[&x]);
            // Half a second is an integer number of cycles, where the speed is maximal. Interpolation from 500 Hz loses
            // 0.8 %.
            let peak = speeds[rate as usize / 2];
            let expected = 0.01 * turn / 2.0_f64.sqrt();
            assert!((peak / expected - 1.0).abs() < 0.01, "got {peak}, expected {expected} at {rate} Hz");
        }
    }
}
