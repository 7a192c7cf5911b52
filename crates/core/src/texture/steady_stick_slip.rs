//! Stick-slip vibration of a steady stroke, as the renderer computes it.
//!
//! Its amplitude has no closed form, so the renderer's model ([`shagreen_synth::stick_slip`]) runs until it is steady. The
//! spectrum of a texture's grain ([`crate::texture::blend`]) does not contain it.

use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::stick_slip::{Friction, StickSlip};

use crate::dsp::spectrum::{rms, welch};
use crate::texture::plane::Plane;
use crate::units::{Contact, Hertz};

/// Time for an oscillation to arise or to die, and length of the analyzed vibration after it, in seconds.
const SETTLING_SECS: f64 = 1.0;
const ANALYZED_SECS: f64 = 2.0;

/// Number of samples that are computed at once.
const TICK: usize = 5;

/// Weakest vibration that counts, in m/s² rms: far below the detection threshold.
const LEAST_MPS2: f64 = 1e-3;

/// Lowest frequency that is searched: the corner of the renderer's high-pass.
const LOWEST: Hertz = Hertz(10.0);

/// Steady stick-slip vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyStickSlip {
    /// Frequency of sticking, to a hertz.
    pub frequency: Hertz,
    /// Root mean square acceleration, in m/s².
    pub rms_mps2: f64,
    /// One-sided power spectral density in (m/s²)²/Hz in bins of a hertz, from zero to half of the model rate.
    pub density: Vec<(Hertz, f64)>,
}

/// Returns the stick-slip vibration of a mixture of planes at a constant contact; `None` if the tip slides steadily, and
/// without friction. All planes must have the same rate. Cost: 3 s of the renderer's stick-slip model, some milliseconds.
///
/// As in the renderer, one tip moves on the mean friction of the planes that have one, and the sum of their weights
/// multiplies its acceleration.
pub fn steady_stick_slip(parents: &[(&Plane, f64)], contact: Contact) -> Option<SteadyStickSlip> {
    let rate = parents.first()?.0.rate();
    let frictions = parents.iter().filter_map(|(plane, weight)| Some((plane.friction()?, *weight as f32)));
    let (friction, weight) = Friction::mean(frictions)?;
    let contact = SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 };
    let n_settling = (SETTLING_SECS * rate.0) as usize;
    let mut signal = vec![0.0_f32; n_settling + (ANALYZED_SECS * rate.0) as usize];
    let mut model = StickSlip::new(rate.0 as f32);
    for tick in signal.chunks_mut(TICK) {
        model.add_tick(friction, (contact, contact), (weight, weight), tick);
    }
    let steady: Vec<f64> = signal[n_settling..].iter().map(|x| f64::from(*x)).collect();
    let rms_mps2 = rms(&steady);
    if rms_mps2 < LEAST_MPS2 {
        return None;
    }
    let density = welch(&steady, rate, rate.0.round() as usize);
    // The harmonics of the acceleration can be stronger than its fundamental; those of the velocity are not.
    let velocity = |(frequency, density): &&(Hertz, f64)| density / (frequency.0 * frequency.0);
    let audible = density.iter().filter(|(frequency, _)| frequency.0 >= LOWEST.0);
    let (frequency, _) = audible.max_by(|a, b| velocity(a).total_cmp(&velocity(b)))?;
    Some(SteadyStickSlip { frequency: *frequency, rms_mps2, density })
}

#[cfg(test)]
mod tests {
    use super::{SteadyStickSlip, steady_stick_slip};
    use crate::dsp::spectrum::rms;
    use crate::texture::TextureModel;
    use crate::texture::blend::Mode;
    use crate::texture::plane::Plane;
    use crate::texture::render::{RenderPlan, render};
    use crate::texture::stick_slip::StickSlip;
    use crate::texture::test_textures::two_resonances;
    use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

    const KINETIC: f64 = 0.8;
    const RUBBER: StickSlip = StickSlip { static_ratio: 1.6, stribeck_speed: MetersPerSecond(0.02) };

    fn rubber() -> TextureModel {
        let texture = two_resonances(&[0.05, 0.1, 0.2], &[0.5, 1.0, 2.0]);
        texture.with_friction(Some(KINETIC)).unwrap().with_stick_slip(Some(RUBBER))
    }

    fn at(plane: &Plane, speed_mps: f64) -> Option<SteadyStickSlip> {
        steady_stick_slip(&[(plane, 1.0)], Contact { speed: MetersPerSecond(speed_mps), force: Newtons(1.0) })
    }

    /// Oracle: the whole renderer. Its power is that of the grain plus that of stick-slip, which are independent.
    #[test]
    fn the_renderer_has_the_power_of_the_grain_and_of_stick_slip() {
        let plane = Plane::new(&rubber());
        let prepared = plane.prepare();
        for speed_mps in [0.01, 0.02] {
            let contact = Contact { speed: MetersPerSecond(speed_mps), force: Newtons(1.0) };
            let stick_slip = at(&plane, speed_mps).unwrap();
            let plan = RenderPlan {
                parents: &[(&prepared, 1.0)],
                mode: Mode::Shared,
                rate: Hertz(1000.0),
                seconds: 6.0,
                seed: 1,
            };
            let rendered = render(&plan, &mut |_: f64| contact).unwrap();
            let steady: Vec<f64> = rendered[1000..].iter().map(|x| f64::from(*x)).collect();
            let expected = plane.at(contact).level_mps2.hypot(stick_slip.rms_mps2);
            // The level of five seconds of noise has a standard error of 1 to 2 %, and stick-slip is stronger.
            assert!((rms(&steady) / expected - 1.0).abs() < 0.04, "{} for {expected}", rms(&steady));
            // The density integrates to the power; the Hann window weights the ends less.
            let power: f64 = stick_slip.density.iter().map(|(_, density)| density).sum();
            assert!((power.sqrt() / stick_slip.rms_mps2 - 1.0).abs() < 0.05, "{}", power.sqrt());
        }
    }

    /// Just below the critical speed the tip hardly sticks and oscillates at the resonance of pen and grip,
    /// sqrt(k / m) / 2π = 43.6 Hz; where it sticks, the period is longer.
    #[test]
    fn it_ends_above_the_critical_speed_and_is_slower_where_the_tip_sticks() {
        let plane = Plane::new(&rubber());
        let critical_mps = RUBBER.critical_speed(KINETIC, Newtons(1.0)).unwrap().0;
        let frequency = |share: f64| at(&plane, share * critical_mps).map(|of| of.frequency.0);
        let (slow_hz, fast_hz) = (frequency(0.3).unwrap(), frequency(0.9).unwrap());
        assert!((fast_hz - 43.6).abs() < 6.0, "{fast_hz} Hz");
        assert!(slow_hz <= fast_hz && slow_hz > 10.0, "{slow_hz} and {fast_hz} Hz");
        assert_eq!(at(&plane, 2.5 * critical_mps), None);
        assert_eq!(at(&plane, 0.0), None);
        // Without stick-slip friction there is none at any speed, and half of the weight has half of the amplitude.
        assert_eq!(at(&Plane::new(&two_resonances(&[0.1], &[1.0])), 0.01), None);
        let contact = Contact { speed: MetersPerSecond(0.02), force: Newtons(1.0) };
        let half = steady_stick_slip(&[(&plane, 0.5)], contact).unwrap();
        assert!((half.rms_mps2 / at(&plane, 0.02).unwrap().rms_mps2 - 0.5).abs() < 1e-3);
    }
}
