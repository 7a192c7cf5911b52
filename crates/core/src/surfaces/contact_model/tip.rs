//! Filtering of a height profile by the ball tip and its contact patch.

use crate::dsp::contact_patch::patch_gain;
use crate::dsp::dft321::check_run;
use crate::dsp::spectrum::rms;
use crate::dsp::square_transform::transpose;
use crate::maths::rng::Random;
use realfft::RealFftPlanner;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Wavelength above which the spectrum of the friction process is flat.
const FRICTION_ROLL_OFF_M: f64 = 2e-3;

/// Hurst exponent of the friction process.
const FRICTION_HURST: f64 = 0.6;

/// Height of the lowest point of a ball resting on the profile: `max over u of h(x+u) + √(R² − u²) − R`.
///
/// Morphological dilation by a ball. `step_m` is the point spacing; no surface exists beyond the profile's ends. Cost:
/// number of points times the reach of the ball over the profile's height range.
pub(super) fn dilate(heights_m: &[f64], step_m: f64, tip_radius_m: f64) -> Vec<f64> {
    let (low, high) = heights_m
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(*h), high.max(*h)));
    // Where the ball lies above the height range of the profile, it cannot touch.
    let reach: Vec<f64> = (0..=(tip_radius_m / step_m).floor() as usize)
        .map(|i| (tip_radius_m.powi(2) - (i as f64 * step_m).powi(2)).max(0.0).sqrt() - tip_radius_m)
        .take_while(|cap| -cap <= high - low)
        .collect();
    let mut lowest = heights_m.to_vec();
    for (distance, cap) in reach.iter().enumerate().skip(1) {
        let n_pairs = heights_m.len().saturating_sub(distance);
        for (lowest, height) in lowest[..n_pairs].iter_mut().zip(&heights_m[heights_m.len() - n_pairs..]) {
            *lowest = lowest.max(height + cap);
        }
        let n = lowest.len();
        for (lowest, height) in lowest[n - n_pairs..].iter_mut().zip(&heights_m[..n_pairs]) {
            *lowest = lowest.max(height + cap);
        }
    }
    lowest
}

/// Dilation by a ball on a periodic tile of `n_cells` × `n_cells` heights, row by row.
///
/// Dilates the rows, then the columns. Together they have a cap of `r²/2R + (x⁴ + y⁴)/8R³` instead of `r²/2R + r⁴/8R³`, a
/// difference far below the heights of a texture.
pub(super) fn dilate_tile(heights_m: &[f64], n_cells: usize, step_m: f64, tip_radius_m: f64) -> Vec<f64> {
    let mut tip_m = dilate_rows(heights_m, n_cells, step_m, tip_radius_m);
    transpose(&mut tip_m, n_cells);
    tip_m = dilate_rows(&tip_m, n_cells, step_m, tip_radius_m);
    transpose(&mut tip_m, n_cells);
    tip_m
}

/// Dilation by a ball along each row of a periodic tile.
fn dilate_rows(heights_m: &[f64], n_cells: usize, step_m: f64, tip_radius_m: f64) -> Vec<f64> {
    let margin = ((tip_radius_m / step_m).ceil() as usize).min(n_cells);
    let dilated = |row: &[f64]| {
        let around: Vec<f64> =
            row[n_cells - margin..].iter().chain(row).chain(&row[..margin]).copied().collect();
        dilate(&around, step_m, tip_radius_m)[margin..margin + n_cells].to_vec()
    };
    heights_m.chunks_exact(n_cells).flat_map(dilated).collect()
}

/// Profile averaged over the contact patch with Hertz pressure weighting.
///
/// The gain is `3 (sin ka − ka cos ka) / (ka)³` at angular wave number k for patch radius a. The profile is treated as
/// periodic, so its ends mix over one patch radius.
pub(super) fn patch_low_pass(heights_m: &[f64], step_m: f64, patch_radius_m: f64) -> Vec<f64> {
    let n = heights_m.len();
    if n == 0 {
        return Vec::new();
    }
    let mut planner = RealFftPlanner::<f64>::new();
    let forward = planner.plan_fft_forward(n);
    let inverse = planner.plan_fft_inverse(n);
    let mut spectrum = forward.make_output_vec();
    let mut signal = heights_m.to_vec();
    check_run(&forward.process(&mut signal, &mut spectrum));
    for (i, value) in spectrum.iter_mut().enumerate() {
        let k_per_m = TAU * i as f64 / (n as f64 * step_m);
        *value *= patch_gain(k_per_m * patch_radius_m) / n as f64;
    }
    check_run(&inverse.process(&mut spectrum, &mut signal));
    signal
}

/// Friction process of unit variance along a path, with features `elongation` times as long as across the lay.
pub(super) fn friction_process(n_points: usize, step_m: f64, elongation: f64, seed: u64) -> Vec<f64> {
    let n = n_points.next_multiple_of(256).max(256);
    let mut random = Random::new(seed);
    let mut planner = RealFftPlanner::<f64>::new();
    let inverse = planner.plan_fft_inverse(n);
    let mut spectrum = inverse.make_input_vec();
    for (i, value) in spectrum.iter_mut().enumerate().skip(1).take(n / 2 - 1) {
        let q = i as f64 / (n as f64 * step_m) * (FRICTION_ROLL_OFF_M * elongation);
        let power = (1.0 + q * q).powf(-FRICTION_HURST - 0.5);
        *value = power.sqrt() * Complex::new(random.normal(), random.normal());
    }
    let mut process = inverse.make_output_vec();
    check_run(&inverse.process(&mut spectrum, &mut process));
    let rms = rms(&process);
    process.truncate(n_points);
    for value in &mut process {
        *value /= rms;
    }
    process
}

#[cfg(test)]
mod tests {
    use super::{
        Complex, FRICTION_HURST, RealFftPlanner, TAU, dilate, dilate_tile, friction_process, patch_low_pass,
    };
    use crate::maths::rng::lcg_noise;

    const STEP_M: f64 = 10e-6;
    const RADIUS_M: f64 = 1.5e-3;

    /// Slow oracle: the definition over all pairs of points.
    fn dilate_slowly(heights_m: &[f64]) -> Vec<f64> {
        let at = |i: usize, j: usize| {
            let u = i.abs_diff(j) as f64 * STEP_M;
            if u <= RADIUS_M { heights_m[j] + (RADIUS_M * RADIUS_M - u * u).sqrt() - RADIUS_M } else { -1.0 }
        };
        (0..heights_m.len())
            .map(|i| (0..heights_m.len()).map(|j| at(i, j)).fold(f64::NEG_INFINITY, f64::max))
            .collect()
    }

    #[test]
    fn a_flat_profile_stays_flat() {
        assert_eq!(dilate(&[3e-6; 40], STEP_M, RADIUS_M), [3e-6; 40]);
        assert!(dilate(&[], STEP_M, RADIUS_M).is_empty());
    }

    #[test]
    fn a_spike_becomes_the_cap_of_the_ball() {
        let mut heights = vec![0.0; 101];
        heights[50] = 20e-6;
        for (i, got) in dilate(&heights, STEP_M, RADIUS_M).iter().enumerate() {
            let u = i.abs_diff(50) as f64 * STEP_M;
            let cap = 20e-6 - RADIUS_M + (RADIUS_M * RADIUS_M - u * u).sqrt();
            assert!((got - cap.max(0.0)).abs() < 1e-18);
        }
    }

    #[test]
    fn dilation_matches_its_definition() {
        for (scale, n) in [(1e-6, 300), (1e-4, 300), (5e-3, 200)] {
            let heights: Vec<f64> = lcg_noise(n, 4).iter().map(|v| v * scale).collect();
            for (got, expected) in dilate(&heights, STEP_M, RADIUS_M).iter().zip(dilate_slowly(&heights)) {
                assert!((got - expected).abs() < 1e-15 * scale / 1e-6);
            }
        }
    }

    #[test]
    fn a_ball_on_a_tile_touches_its_highest_neighborhood() {
        let (n, step_m) = (24, 60e-6);
        let heights: Vec<f64> = lcg_noise(n * n, 6).iter().map(|v| 1e-5 * v).collect();
        let dilated = dilate_tile(&heights, n, step_m, RADIUS_M);
        // Slow oracle: the ball over all cells of the tile and its eight copies.
        let around = |a: usize, b: usize| {
            let off = a.abs_diff(b);
            off.min(n - off) as f64 * step_m
        };
        for (i, got) in dilated.iter().enumerate() {
            let mut expected = f64::NEG_INFINITY;
            for (j, height) in heights.iter().enumerate() {
                let r = around(i % n, j % n).hypot(around(i / n, j / n));
                if r <= RADIUS_M {
                    expected = expected.max(height + (RADIUS_M * RADIUS_M - r * r).sqrt() - RADIUS_M);
                }
            }
            // Heights of 20 µm lie within r = 0.16 R: the caps differ by r⁴/16R³ at most.
            assert!((0.0..8e-8).contains(&(got - expected + 1e-15)), "{got} {expected}");
        }
    }

    #[test]
    fn the_patch_scales_a_sine_by_its_gain() {
        let n = 2000_u16;
        for (n_periods, patch_m) in [(4.0, 50e-6), (40.0, 100e-6), (100.0, 80e-6), (3.0, 2e-3)] {
            let k = TAU * n_periods / (f64::from(n) * STEP_M);
            let sine: Vec<f64> = (0..n).map(|i| (k * f64::from(i) * STEP_M).sin()).collect();
            let ka = k * patch_m;
            let gain = 3.0 * (ka.sin() - ka * ka.cos()) / ka.powi(3);
            for (got, sine) in patch_low_pass(&sine, STEP_M, patch_m).iter().zip(&sine) {
                assert!((got - gain * sine).abs() < 1e-12, "ka {ka}");
            }
        }
    }

    #[test]
    fn friction_has_unit_variance_and_its_slope() {
        let n = 1 << 16;
        let mut process = friction_process(n, STEP_M, 1.0, 2);
        let power = process.iter().map(|v| v * v).sum::<f64>() / n as f64;
        assert!((power - 1.0).abs() < 1e-12);
        let forward = RealFftPlanner::<f64>::new().plan_fft_forward(n);
        let mut spectrum = forward.make_output_vec();
        forward.process(&mut process, &mut spectrum).expect("own plan");
        let band = |first: usize| {
            spectrum[first..2 * first].iter().map(Complex::norm_sqr).sum::<f64>() / first as f64
        };
        // Well above the roll-off, power falls by 2^(2H+1) per octave. With 3277 or more bins the error is 1 to 2 %.
        let slope = (band(4000) / band(8000)).log2();
        assert!((slope - (2.0 * FRICTION_HURST + 1.0)).abs() < 0.15, "slope {slope}");
    }

    #[test]
    fn friction_along_the_lay_is_slower() {
        let steps = |elongation: f64| {
            let process = friction_process(1 << 16, STEP_M, elongation, 5);
            process.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum::<f64>()
        };
        // Above the roll-off, the power at one frequency falls as the elongation to the power of -2H.
        let ratio = (steps(8.0) / steps(1.0)).log2() / 8.0_f64.log2();
        assert!((ratio + 2.0 * FRICTION_HURST).abs() < 0.3, "{ratio}");
    }
}
