//! Time-domain simulation of the pen on the springs and dampers of contact and hand.

use crate::surfaces::contact_model::Tool;
use std::f64::consts::TAU;

/// Largest accurate product of contact resonance (rad/s) and integration time step.
const MAX_PHASE_STEP: f64 = 0.025;

/// Minimum integration steps per sample, for dynamics faster than the resonance of a soft contact.
const MIN_SUBSTEPS: f64 = 4.0;

/// Surface height and friction along the path of the tip.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) heights_m: Vec<f64>,
    /// Deviation of the friction force from its mean.
    pub(super) drag_n: Vec<f64>,
    pub(super) step_m: f64,
}

impl Path {
    pub(super) fn length_m(&self) -> f64 {
        self.heights_m.len() as f64 * self.step_m
    }

    /// Returns height and friction at a position, by linear interpolation.
    pub(super) fn at(&self, x_m: f64) -> (f64, f64) {
        let position = x_m / self.step_m;
        let i = position as usize;
        let t = position - i as f64;
        let between = |values: &[f64]| values[i] + t * (values[i + 1] - values[i]);
        (between(&self.heights_m), between(&self.drag_n))
    }
}

/// The springs, dampers and friction between path, pen and hand.
#[derive(Clone, Debug)]
pub(super) struct Springs {
    pub(super) contact_n_per_m: f64,
    pub(super) damping_n_s_per_m: f64,
    pub(super) friction_coefficient: f64,
    pub(super) tool: Tool,
}

/// Start position, speed and sampling of a stroke.
pub(super) struct Run {
    pub(super) start_m: f64,
    pub(super) speed_mps: f64,
    pub(super) rate_hz: f64,
    pub(super) n_steps: usize,
}

/// Returns the normal and lateral acceleration of the pen in m/s², `n_steps` samples each.
///
/// Semi-implicit Euler integration. Each sample is the mean over enough substeps to resolve the contact resonance.
pub(super) fn accelerations_mps2(path: &Path, springs: &Springs, force_n: f64, run: &Run) -> [Vec<f64>; 2] {
    let Tool { mass_kg, hand_stiffness_n_per_m, hand_damping_n_s_per_m, .. } = springs.tool;
    let resonance_per_s = (springs.contact_n_per_m / mass_kg).sqrt();
    let n_substeps = (resonance_per_s / run.rate_hz / MAX_PHASE_STEP).ceil().max(MIN_SUBSTEPS);
    let dt = 1.0 / (run.rate_hz * n_substeps);
    let lateral_per_s = TAU * springs.tool.lateral_resonance_hz;
    let lateral_damping_per_s = 2.0 * springs.tool.lateral_damping_ratio * lateral_per_s;

    let mut x_m = run.start_m;
    let rest_m = path.at(x_m).0;
    let (mut previous_m, mut z_m, mut z_mps) = (rest_m, rest_m, 0.0);
    let (mut u_m, mut u_mps) = (0.0, 0.0);
    let mut axes = [Vec::with_capacity(run.n_steps), Vec::with_capacity(run.n_steps)];
    for _ in 0..run.n_steps {
        let (mut normal_sum, mut lateral_sum) = (0.0, 0.0);
        for _ in 0..n_substeps as usize {
            x_m += run.speed_mps * dt;
            let (height_m, drag_n) = path.at(x_m);
            let slope = (height_m - previous_m) / (dt * run.speed_mps);
            previous_m = height_m;

            let spring_n = springs.contact_n_per_m * (height_m - z_m);
            let damper_n = springs.damping_n_s_per_m * (slope * run.speed_mps - z_mps);
            // The contact pushes but never pulls: the tip can lose contact.
            let contact_n = (force_n + spring_n + damper_n).max(0.0);
            let hand_n = hand_damping_n_s_per_m * z_mps + hand_stiffness_n_per_m * (z_m - rest_m);
            let normal = (contact_n - force_n - hand_n) / mass_kg;
            z_mps += normal * dt;
            z_m += z_mps * dt;

            let pull_n = drag_n + springs.friction_coefficient * (contact_n - force_n) + contact_n * slope;
            let lateral =
                pull_n / mass_kg - lateral_damping_per_s * u_mps - lateral_per_s * lateral_per_s * u_m;
            u_mps += lateral * dt;
            u_m += u_mps * dt;

            normal_sum += normal;
            lateral_sum += lateral;
        }
        axes[0].push(normal_sum / n_substeps);
        axes[1].push(lateral_sum / n_substeps);
    }
    axes
}

#[cfg(test)]
mod tests {
    use super::{Path, Run, Springs, TAU, accelerations_mps2};
    use crate::surfaces::contact_model::PEN;
    use rustfft::num_complex::Complex;

    const STEP_M: f64 = 10e-6;
    const RATE_HZ: f64 = 16_000.0;
    const SPEED_MPS: f64 = 0.1;

    fn springs(contact_n_per_m: f64, damping_ratio: f64) -> Springs {
        Springs {
            contact_n_per_m,
            damping_n_s_per_m: 2.0 * damping_ratio * (contact_n_per_m * PEN.mass_kg).sqrt(),
            friction_coefficient: 0.0,
            tool: PEN,
        }
    }

    fn sine_path(frequency_hz: f64, amplitude_m: f64, drag_n: f64) -> Path {
        let wave = |i: usize| (TAU * frequency_hz / SPEED_MPS * i as f64 * STEP_M).sin();
        let n = 11_000;
        Path {
            heights_m: (0..n).map(|i| amplitude_m * wave(i)).collect(),
            drag_n: (0..n).map(|i| drag_n * wave(i)).collect(),
            step_m: STEP_M,
        }
    }

    fn run_at(n_steps: usize) -> Run {
        Run { start_m: 0.0, speed_mps: SPEED_MPS, rate_hz: RATE_HZ, n_steps }
    }

    /// Amplitude over the last half second, which must contain a whole number of periods of the frequency.
    fn amplitude(signal: &[f64], frequency_hz: f64) -> f64 {
        let tail = &signal[signal.len() - RATE_HZ as usize / 2..];
        let sum: Complex<f64> = tail
            .iter()
            .enumerate()
            .map(|(i, value)| Complex::from_polar(*value, -TAU * frequency_hz * i as f64 / RATE_HZ))
            .sum();
        2.0 * sum.norm() / tail.len() as f64
    }

    /// Closed form: `|H_c(f)| (2πf)² A`, with `H_c = (k + iωc) / (k + K − mω² + iω(c + B))`.
    #[test]
    fn small_relief_follows_the_linear_contact() {
        for (stiffness, damping_ratio) in [(8e4, 0.15), (1.3e4, 0.4), (1.1e3, 0.7)] {
            for frequency_hz in [20.0, 60.0, 150.0, 240.0, 400.0] {
                let springs = springs(stiffness, damping_ratio);
                let path = sine_path(frequency_hz, 1e-8, 0.0);
                let [normal, _] = accelerations_mps2(&path, &springs, 1.0, &run_at(16_000));
                let w = TAU * frequency_hz;
                let c = springs.damping_n_s_per_m;
                let above = Complex::new(stiffness, w * c);
                let below = Complex::new(
                    stiffness + PEN.hand_stiffness_n_per_m - PEN.mass_kg * w * w,
                    w * (c + PEN.hand_damping_n_s_per_m),
                );
                let expected = (above / below).norm() * w * w * 1e-8;
                let ratio = amplitude(&normal, frequency_hz) / expected;
                // First-order integration with a 1/40 rad phase step at resonance errs by about 1 % at these
                // frequencies.
                assert!((ratio - 1.0).abs() < 0.015, "k {stiffness}, {frequency_hz} Hz: {ratio}");
            }
        }
    }

    /// Closed form: `(F/m) ω² / |ω_l² − ω² + 2iζω_lω|` for a friction force F.
    #[test]
    fn friction_drives_the_lateral_mode() {
        for frequency_hz in [30.0, 110.0, 300.0] {
            let path = sine_path(frequency_hz, 0.0, 0.02);
            let [normal, lateral] = accelerations_mps2(&path, &springs(5e4, 0.2), 1.0, &run_at(16_000));
            let (w, w_l) = (TAU * frequency_hz, TAU * PEN.lateral_resonance_hz);
            let below = Complex::new(w_l * w_l - w * w, 2.0 * PEN.lateral_damping_ratio * w_l * w).norm();
            let ratio = amplitude(&lateral, frequency_hz) / (0.02 / PEN.mass_kg * w * w / below);
            assert!((ratio - 1.0).abs() < 0.03, "{frequency_hz} Hz: {ratio}");
            assert_eq!(amplitude(&normal, frequency_hz), 0.0);
        }
    }

    #[test]
    fn rough_relief_throws_the_pen_off_the_surface() {
        let path = sine_path(100.0, 20e-6, 0.0);
        let [normal, _] = accelerations_mps2(&path, &springs(8e4, 0.2), 0.15, &run_at(16_000));
        // Without contact only preload and hand force act, so downward acceleration stays below (F + hand force) / m.
        let strongest_down = normal.iter().copied().fold(0.0, f64::min);
        let hand = PEN.hand_damping_n_s_per_m * 0.05 + PEN.hand_stiffness_n_per_m * 2e-4;
        assert!(strongest_down >= -(0.15 + hand) / PEN.mass_kg, "{strongest_down}");
        assert!(normal.iter().copied().fold(0.0, f64::max) > 10.0);
    }
}
