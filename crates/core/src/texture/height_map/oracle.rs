//! Acceleration of a tip on a height map by its Fourier series: slow and exact, to compare the renderer with.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;
use shagreen_synth::height_map::PATCH_FORCES;

use crate::dsp::contact_patch::patch_gain;
use crate::texture::height_map::{HeightMap, REFERENCE_MPS};
use crate::units::{Hertz, Newtons};

impl HeightMap {
    /// Acceleration in m/s² of a tip at these positions (x, y) in m, one for each sample at `rate`, pressed with `force`:
    /// the equation of [`crate::texture::height_map`] in `f64`, without the high-pass of the renderer. Speed and direction
    /// are central differences of the positions; a tip at rest has no acceleration.
    ///
    /// Waves of two steps and less are left out, as in the renderer. Cost: the number of positions times the number of
    /// waves.
    pub fn acceleration(&self, path_m: &[[f64; 2]], force: Newtons, rate: Hertz) -> Vec<f64> {
        let relative = (force.0 / self.options.force.0).max(0.0);
        let [least, _, most] = PATCH_FORCES.map(f64::from);
        let radius_m = self.options.patch_radius_m * relative.clamp(least, most).cbrt();
        let gain = relative.min(most).cbrt();
        let waves = self.waves();
        let last = path_m.len().saturating_sub(1);
        let acceleration = |i: usize| {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            let [dx_m, dy_m] = [0, 1].map(|axis| path_m[after][axis] - path_m[before][axis]);
            let way_m = dx_m.hypot(dy_m);
            if way_m == 0.0 {
                return 0.0;
            }
            let (ux, uy) = (dx_m / way_m, dy_m / way_m);
            let speed_mps = way_m * rate.0 / (after - before) as f64;
            let [x_m, y_m] = path_m[i];
            let curvature = |[kx, ky]: [f64; 2], amplitude: Complex<f64>| {
                let k = TAU / self.side_m * (kx * ux + ky * uy);
                let phase = TAU * (kx * x_m + ky * y_m) / self.side_m;
                -k * k * (amplitude * Complex::from_polar(1.0, phase)).re
            };
            let sum: f64 = waves
                .iter()
                .map(|wave| {
                    let periods = wave.periods.map(|periods| periods as f64);
                    patch_gain(wave.k_per_m * radius_m) * curvature(periods, wave.amplitude)
                })
                .sum();
            let level = REFERENCE_MPS.powi(2) * (speed_mps / REFERENCE_MPS).powf(self.options.speed_exponent);
            gain * level * sum
        };
        (0..path_m.len()).map(acceleration).collect()
    }
}
