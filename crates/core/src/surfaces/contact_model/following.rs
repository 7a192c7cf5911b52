//! Following: the acceleration of a tip that follows the heights of its path exactly, and what the pen makes of it.
//!
//! A tip that follows a height `h` at the speed `v` has the acceleration `v² h''`. The pen of the contact model has more or
//! less: its contact resonates and yields, slopes push it sideways, and it can lose contact. [`Following`] states the
//! difference as a gain and a power of speed: `a = gain (v / v₀)^(p - 2) v² h''` with the speed v₀ of
//! [`REFERENCE_CONTACT`].

use crate::surfaces::contact_model::{PressedSurface, REFERENCE_CONTACT, StrokeError, recorded, run_over};
use crate::units::MetersPerSecond;

/// Vibration of the pen on a relief, relative to a tip that follows the relief exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// Ratio of root mean square accelerations at the reference speed, above 0.
    pub gain: f64,
    /// Power of speed p with which the acceleration grows, 0 to 2; an exact follower has 2.
    pub speed_exponent: f64,
}

/// Following of a tip that keeps to the relief.
const EXACT: Following = Following { gain: 1.0, speed_exponent: 2.0 };

/// Returns the acceleration of a tip that follows a pressed surface exactly, in m/s² at
/// [`STROKE_RATE`](crate::surfaces::contact_model::STROKE_RATE), over the same path and through the same filters as
/// [`drag`](crate::surfaces::contact_model::drag).
///
/// # Errors
/// Those of [`drag`](crate::surfaces::contact_model::drag).
pub fn follow(
    pressed: &PressedSurface,
    speed: MetersPerSecond,
    duration_secs: f64,
    seed: u64,
) -> Result<Vec<f64>, StrokeError> {
    let run = run_over(&pressed.path, speed, duration_secs, seed)?;
    let step_m = run.speed_mps / run.rate_hz;
    let height_m = |i: usize| pressed.path.at(run.start_m + i as f64 * step_m).0;
    let accel_mps2: Vec<f64> = (1..=run.n_steps)
        .map(|i| (height_m(i + 1) - 2.0 * height_m(i) + height_m(i - 1)) * run.rate_hz * run.rate_hz)
        .collect();
    Ok(recorded(&accel_mps2, duration_secs))
}

impl Following {
    /// Fits the ratios of root mean square accelerations, pen to exact follower, at several speeds: least squares of the
    /// logarithm of the ratio over the logarithm of the speed. The exponent is limited to 0 to 2. Ratios that are not
    /// finite and above 0 are left out; without any, the tip follows exactly.
    pub fn fitted(ratios: &[(MetersPerSecond, f64)]) -> Self {
        let points: Vec<[f64; 2]> = ratios
            .iter()
            .filter(|(speed, ratio)| speed.0 > 0.0 && *ratio > 0.0 && ratio.is_finite())
            .map(|(speed, ratio)| [(speed.0 / REFERENCE_CONTACT.speed.0).ln(), ratio.ln()])
            .collect();
        if points.is_empty() {
            return EXACT;
        }
        let mean = [0, 1].map(|of| points.iter().map(|point| point[of]).sum::<f64>() / points.len() as f64);
        let spread: f64 = points.iter().map(|[x, _]| (x - mean[0]).powi(2)).sum();
        let slope = if spread > 0.0 {
            points.iter().map(|[x, y]| (x - mean[0]) * (y - mean[1])).sum::<f64>() / spread
        } else {
            0.0
        };
        let speed_exponent = (2.0 + slope).clamp(0.0, 2.0);
        // The line with the limited slope still passes through the mean.
        Self { gain: (mean[1] - (speed_exponent - 2.0) * mean[0]).exp(), speed_exponent }
    }
}

#[cfg(test)]
mod tests {
    use super::{EXACT, Following, follow};
    use crate::dsp::spectrum::rms;
    use crate::surfaces::contact_model::dynamics::{Path, Springs};
    use crate::surfaces::contact_model::{PEN, PressedSurface, StrokeError, drag};
    use crate::units::MetersPerSecond;
    use proptest::prelude::{prop_assert, proptest};
    use std::f64::consts::{SQRT_2, TAU};

    const STEP_M: f64 = 10e-6;

    /// A relief of sines on a contact of this stiffness, without friction.
    fn sines(period_m: f64, amplitude_m: f64, contact_n_per_m: f64) -> PressedSurface {
        let heights_m: Vec<f64> =
            (0..30_000).map(|i| amplitude_m * (TAU * f64::from(i) * STEP_M / period_m).sin()).collect();
        let springs = Springs {
            contact_n_per_m,
            damping_n_s_per_m: 0.4 * (contact_n_per_m * PEN.mass_kg).sqrt(),
            friction_coefficient: 0.0,
            tool: PEN,
        };
        let drag_n = vec![0.0; heights_m.len()];
        PressedSurface { path: Path { heights_m, drag_n, step_m: STEP_M }, springs, force_n: 1.0 }
    }

    #[test]
    fn a_sine_is_followed_by_its_second_derivative() {
        for (period_m, speed_mps) in [(5e-3, 0.2), (1e-3, 0.05), (2e-3, 0.1)] {
            let pressed = sines(period_m, 1e-6, 1e5);
            let signal = follow(&pressed, MetersPerSecond(speed_mps), 0.5, 1).expect("valid stroke");
            let expected = 1e-6 * (TAU * speed_mps / period_m).powi(2) / SQRT_2;
            // Half a second has whole periods; the high-pass of 10 Hz takes 1 % at 40 Hz.
            assert!((rms(&signal) / expected - 1.0).abs() < 0.02, "{} for {expected}", rms(&signal));
        }
    }

    #[test]
    fn a_stiff_contact_follows_and_a_soft_one_falls_behind() {
        let at = |contact_n_per_m: f64| {
            let pressed = sines(1e-3, 1e-8, contact_n_per_m);
            let ratios = [0.04, 0.06, 0.1, 0.15].map(|mps| {
                let speed = MetersPerSecond(mps);
                let level = |signal: Result<Vec<f64>, StrokeError>| rms(&signal.expect("valid stroke"));
                (speed, level(drag(&pressed, speed, 0.5, 1)) / level(follow(&pressed, speed, 0.5, 1)))
            });
            Following::fitted(&ratios)
        };
        let (stiff, soft) = (at(1e6), at(2e3));
        // Up to 150 Hz. Slopes push sideways as well, most at low speed; the resonance of the stiff contact is at 800 Hz,
        // that of the soft one at 36 Hz.
        assert!(stiff.gain > 0.9 && soft.gain < 0.7 * stiff.gain, "{stiff:?} {soft:?}");
        assert!(soft.speed_exponent < stiff.speed_exponent, "{stiff:?} {soft:?}");
    }

    #[test]
    fn without_a_ratio_the_tip_follows_exactly() {
        assert_eq!(Following::fitted(&[]), EXACT);
        let bad =
            [(MetersPerSecond(0.1), f64::NAN), (MetersPerSecond(0.0), 1.0), (MetersPerSecond(0.2), 0.0)];
        assert_eq!(Following::fitted(&bad), EXACT);
        let one = Following::fitted(&[(MetersPerSecond(0.2), 3.0)]);
        assert!((one.gain - 3.0).abs() < 1e-12 && one.speed_exponent == 2.0);
    }

    proptest! {
        #[test]
        fn a_power_law_is_found(gain in 0.01..20.0_f64, exponent in 0.0..=2.0_f64) {
            let ratio = |mps: f64| (MetersPerSecond(mps), gain * (mps / 0.1).powf(exponent - 2.0));
            let found = Following::fitted(&[0.03, 0.07, 0.12, 0.18, 0.25].map(ratio));
            prop_assert!((found.gain / gain - 1.0).abs() < 1e-9);
            prop_assert!((found.speed_exponent - exponent).abs() < 1e-9);
        }
    }
}
