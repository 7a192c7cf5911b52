use super::{Fractal, Line, PI, RealFftPlanner, Tile, tile_heights};
use crate::surfaces::material::tests::plain;

const TILE: Tile = Tile { n_cells: 256, spacing_m: 40e-6 };
const ACROSS: Line = Line { cos: 1.0, sin: 0.0 };

fn check_variance(hurst: f64, stretch: f64, tolerance: f64) {
    let mut material = plain();
    material.hurst = hurst;
    material.stretch = stretch;
    material.roll_off_m = 0.6e-3;
    let fractal = Fractal::new(&material, TILE);
    let heights = tile_heights(&fractal, TILE, 3);
    let variance = heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64;
    let detail: f64 = (1..200_000).map(|i| 2.0 * fractal.line_residual_m3(ACROSS, f64::from(i)) * 1.0).sum();
    let ratio = (variance + detail) / material.height_rms_m.powi(2);
    assert!((ratio - 1.0).abs() < tolerance, "H {hurst}, stretch {stretch}: {ratio}");
}

#[test]
fn tile_and_detail_share_the_whole_variance() {
    // About 200 independent patches of roll-off size give a sample variance within 4 × 10 %; a stretched tile has
    // fewer.
    check_variance(0.5, 1.0, 0.2);
    check_variance(0.8, 1.0, 0.2);
    check_variance(0.7, 4.0, 0.4);
}

/// Closed form: a line through a two-dimensional spectrum of exponent H+1 has exponent H+1/2.
#[test]
fn mean_spectrum_of_the_rows_is_the_closed_form() {
    let mut material = plain();
    material.roll_off_m = 0.6e-3;
    let fractal = Fractal::new(&material, TILE);
    let n = TILE.n_cells;
    let mut planner = RealFftPlanner::<f64>::new();
    let forward = planner.plan_fft_forward(n);
    let mut power = vec![0.0; n / 2 + 1];
    let n_tiles = 8;
    for seed in 0..n_tiles {
        for row in tile_heights(&fractal, TILE, seed).chunks_exact_mut(n) {
            let mut spectrum = forward.make_output_vec();
            forward.process(row, &mut spectrum).expect("own plan");
            for (power, value) in power.iter_mut().zip(&spectrum) {
                *power += value.norm_sqr() * TILE.spacing_m / (n * n) as f64 / n_tiles as f64;
            }
        }
    }
    let h = material.hurst;
    // Γ(H+1/2)/Γ(H+1) for H = 0.7 is 0.918169/0.908639.
    let gamma_ratio = 0.918_168_742_4 / 0.908_638_732_9;
    let at_zero = h * material.roll_off_m * material.height_rms_m.powi(2) / PI.sqrt() * gamma_ratio;
    // Octave bands from 0.6 to 5 per mm: tens of bins × many rows, but neighboring rows are correlated.
    for band in [6..12, 12..24, 24..50] {
        let n_bins = band.len() as f64;
        let (mut got, mut expected) = (0.0, 0.0);
        for i in band.clone() {
            let q = i as f64 / TILE.side_m();
            got += (power[i] + fractal.line_residual_m3(ACROSS, q)) / n_bins;
            expected += at_zero * (1.0 + (q * material.roll_off_m).powi(2)).powf(-h - 0.5) / n_bins;
        }
        assert!((got / expected - 1.0).abs() < 0.1, "bins {band:?}: {}", got / expected);
    }
}

#[test]
fn beyond_the_tile_the_detail_is_the_whole_line_spectrum() {
    let material = plain();
    let fractal = Fractal::new(&material, TILE);
    let gamma_ratio = 0.918_168_742_4 / 0.908_638_732_9;
    let at_zero =
        material.hurst * material.roll_off_m * material.height_rms_m.powi(2) / PI.sqrt() * gamma_ratio;
    for q in [7e3, 1e4, 2e4] {
        let expected = at_zero * (1.0 + (q * material.roll_off_m).powi(2)).powf(-material.hurst - 0.5);
        let ratio = fractal.line_residual_m3(ACROSS, q) / expected;
        // The midpoint rule with these nodes is accurate to 1 %.
        assert!((ratio - 1.0).abs() < 0.01, "at {q} per m: {ratio}");
    }
}

/// Slow oracle: the density summed across the line, everywhere outside the tile's band.
fn residual_slowly_m3(fractal: &Fractal, line: Line, q_per_m: f64) -> f64 {
    let n = 100_000;
    // Steps that grow with the distance from zero: p = q₀ sinh u.
    let step = 24.0 / f64::from(n);
    (0..n)
        .map(|i| {
            let u = (f64::from(i) + 0.5) * step - 12.0;
            let across = fractal.roll_off_per_m * u.sinh();
            let qx = q_per_m * line.cos - across * line.sin;
            let qy = q_per_m * line.sin + across * line.cos;
            let is_in_band = qx.abs().max(qy.abs()) <= fractal.tile_band_per_m;
            let width = fractal.roll_off_per_m * u.cosh() * step;
            if is_in_band { 0.0 } else { fractal.density_m4(qx, qy) * width }
        })
        .sum()
}

#[test]
fn the_detail_at_any_angle_is_what_the_tile_lacks() {
    for stretch in [1.0, 4.0, 60.0] {
        let mut material = plain();
        material.stretch = stretch;
        let fractal = Fractal::new(&material, TILE);
        for degrees in [0.0_f64, 20.0, 45.0, 90.0, 135.0, 260.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let line = Line { cos, sin };
            for q_per_m in [40.0, 700.0, 4000.0, 7000.0, 12_000.0] {
                let expected = residual_slowly_m3(&fractal, line, q_per_m);
                let ratio = fractal.line_residual_m3(line, q_per_m) / expected;
                // The midpoint rule with these nodes is accurate to 2 %; the oracle's steps are 0.024 % wide.
                assert!((ratio - 1.0).abs() < 0.03, "stretch {stretch}, {degrees}°, {q_per_m}: {ratio}");
            }
        }
    }
}

#[test]
fn features_are_as_long_along_the_lay_as_the_stretch_says() {
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Line { cos, sin }.elongation(8.0)
    };
    assert_eq!(at(0.0), 1.0);
    assert!(
        (at(90.0) - 8.0).abs() < 1e-12 && (at(45.0) - (2.0 / (1.0 + 1.0 / 64.0_f64)).sqrt()).abs() < 1e-12
    );
}
