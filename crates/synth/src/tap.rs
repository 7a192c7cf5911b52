//! Tap transient at a contact onset: a decaying sinusoid that starts at the sample of the impact.
//!
//! A tap transient is stated for an impact at [`REFERENCE_IMPACT_MPS`]. Other impact speeds follow the law of Hertz
//! contact (K. L. Johnson, "Contact Mechanics", 1985, section 11.4): a tip that hits an elastic surface at speed `v` is
//! stopped with a peak acceleration proportional to `v^{6/5}` in a contact time proportional to `v^{-1/5}`. With
//! `s = v / v_reference`, the transient is therefore `a(t; s) = s^{6/5} a(s^{1/5} t; 1)`:
//!
//! - amplitude `A s^{6/5}`
//! - frequency `f s^{1/5}`
//! - decay rate `B s^{1/5}`, so that the transient keeps its shape and its peak is exactly proportional to `s^{6/5}`

use core::f64::consts::TAU;

/// Impact speed for which tap transients are stated, in m/s: a light tap by hand.
pub const REFERENCE_IMPACT_MPS: f64 = 0.1;
/// Exponent of the peak acceleration of a Hertz impact over its speed.
const PEAK_EXPONENT: f64 = 1.2;
/// Exponent of the frequency, the reciprocal of the contact time.
const FREQUENCY_EXPONENT: f64 = 0.2;

/// Factor on the amplitude of a tap transient at `strength`, the impact speed relative to [`REFERENCE_IMPACT_MPS`];
/// exactly 1 at 1.
#[must_use]
pub fn amplitude_factor(strength: f32) -> f64 {
    libm::pow(f64::from(strength), PEAK_EXPONENT)
}

/// Parameters of the tap transient `a(t) = A e^{-Bt} sin 2πft` (Okamura, Cutkosky and Dennerlein, 2001).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tap {
    /// Frequency `f`, in Hz.
    pub frequency_hz: f32,
    /// Decay rate `B`, in 1/s.
    pub decay_per_sec: f32,
    /// Amplitude `A`, in m/s².
    pub amplitude_mps2: f32,
}

impl Tap {
    /// No tap transient.
    pub const SILENT: Self = Self { frequency_hz: 0.0, decay_per_sec: 0.0, amplitude_mps2: 0.0 };

    /// The transient with at most this amplitude, in m/s².
    #[must_use]
    pub fn within(self, highest_mps2: f32) -> Self {
        Self { amplitude_mps2: self.amplitude_mps2.min(highest_mps2), ..self }
    }
}

/// Most transients at once; a fifth replaces the oldest.
const RINGING: usize = 4;
/// Envelope in m/s² at which a transient ends.
const ENDED_MPS2: f64 = 1e-5;
/// Slowest decay that is rendered, in 1/s; a longer transient is not plausible for a tap.
pub const SLOWEST_DECAY_PER_SEC: f64 = 5.0;
/// Highest amplitude that is rendered, in m/s².
pub const MAX_AMPLITUDE_MPS2: f64 = 1000.0;
/// Highest frequency that is rendered, as a share of the sample rate. A transient above it is rendered at this frequency,
/// with its own amplitude and decay: where a signal cannot hold the oscillation, its peak and its energy are what remains
/// of a hard landing.
pub const HIGHEST_SHARE: f64 = 0.4;

/// One transient by its recursion `y[n] = 2r cos θ y[n-1] - r² y[n-2]`.
#[derive(Clone, Copy, Debug, Default)]
struct Ringing {
    twice_cos: f64,
    square: f64,
    last: f64,
    before: f64,
    /// Envelope of the remaining oscillation.
    left: f64,
    decay: f64,
}

/// The active tap transients.
#[derive(Clone, Debug)]
pub struct Taps {
    rate_hz: f64,
    ringing: [Ringing; RINGING],
    next: usize,
}

impl Taps {
    /// No active transient, at a sample rate in Hz.
    pub fn new(rate_hz: f32) -> Self {
        Self { rate_hz: f64::from(rate_hz), ringing: [Ringing::default(); RINGING], next: 0 }
    }

    /// Starts a transient now. `strength` is the impact speed relative to [`REFERENCE_IMPACT_MPS`]; the transient follows
    /// from it by the law at the top of this module and is unchanged at 1.
    ///
    /// Parameters without a valid oscillation are ignored: a frequency that is not above zero, or a value that is not
    /// finite. The frequency is at most [`HIGHEST_SHARE`] of the sample rate, the decay at least
    /// [`SLOWEST_DECAY_PER_SEC`], and the amplitude at most [`MAX_AMPLITUDE_MPS2`], whatever the strength is.
    pub fn strike(&mut self, tap: Tap, strength: f32) {
        let quickening = libm::pow(f64::from(strength), FREQUENCY_EXPONENT);
        let frequency_hz = f64::from(tap.frequency_hz) * quickening;
        let decay_per_sec = (f64::from(tap.decay_per_sec) * quickening).max(SLOWEST_DECAY_PER_SEC);
        let amplitude = f64::from(tap.amplitude_mps2) * amplitude_factor(strength);
        let can_ring =
            frequency_hz > 0.0 && [frequency_hz, decay_per_sec, amplitude].iter().all(|x| x.is_finite());
        if !can_ring || amplitude == 0.0 {
            return;
        }
        let angle = (TAU * frequency_hz / self.rate_hz).min(TAU * HIGHEST_SHARE);
        let amplitude = amplitude.clamp(-MAX_AMPLITUDE_MPS2, MAX_AMPLITUDE_MPS2);
        let decay = libm::exp(-decay_per_sec / self.rate_hz);
        self.ringing[self.next] = Ringing {
            twice_cos: 2.0 * decay * libm::cos(angle),
            square: decay * decay,
            last: 0.0,
            // The value of the same curve one sample before the impact.
            before: -amplitude / decay * libm::sin(angle),
            left: amplitude.abs(),
            decay,
        };
        self.next = (self.next + 1) % RINGING;
    }

    /// Whether a transient is active.
    #[cfg(test)]
    fn are_ringing(&self) -> bool {
        self.ringing.iter().any(|r| r.left > 0.0)
    }

    /// Adds all active transients to a block in m/s².
    pub fn add_to(&mut self, block: &mut [f32]) {
        for r in self.ringing.iter_mut().filter(|r| r.left > 0.0) {
            for sample in block.iter_mut() {
                *sample += r.last as f32;
                (r.last, r.before) = (r.twice_cos * r.last - r.square * r.before, r.last);
                r.left *= r.decay;
                // Checked per sample, so that the result does not depend on block sizes.
                if r.left < ENDED_MPS2 {
                    r.left = 0.0;
                    break;
                }
            }
        }
    }

    /// Stops all transients at once.
    pub fn reset(&mut self) {
        self.ringing = [Ringing::default(); RINGING];
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{TAU, Tap, Taps, amplitude_factor};
    use std::vec;
    use std::vec::Vec;

    const WOOD: Tap = Tap { frequency_hz: 180.0, decay_per_sec: 90.0, amplitude_mps2: 6.0 };

    #[test]
    fn rings_as_the_equation_says_in_any_blocks() {
        for block in [1, 100, 4800] {
            let mut taps = Taps::new(48_000.0);
            taps.strike(Tap { amplitude_mps2: 3.0, ..WOOD }, 1.0);
            let mut out = vec![0.0_f32; 4800];
            out.chunks_mut(block).for_each(|part| taps.add_to(part));
            for (i, x) in out.iter().enumerate() {
                let t = i as f64 / 48_000.0;
                let expected = 3.0 * (-90.0 * t).exp() * (TAU * 180.0 * t).sin();
                // The tolerance is a millionth of the amplitude, from rounding to `f32`.
                assert!((f64::from(*x) - expected).abs() < 3e-6, "{x} for {expected} at {t} s");
            }
        }
    }

    /// Samples of one landing.
    fn landing(tap: Tap, strength: f32, n: usize) -> Vec<f32> {
        let mut taps = Taps::new(48_000.0);
        taps.strike(tap, strength);
        let mut out = vec![0.0_f32; n];
        taps.add_to(&mut out);
        out
    }

    #[test]
    fn impact_speed_follows_the_law_of_hertz_contact() {
        for strength in [0.1_f64, 0.5, 1.0, 2.0, 3.0] {
            let (peak, speed) = (strength.powf(1.2), strength.powf(0.2));
            for (i, x) in landing(WOOD, strength as f32, 2400).iter().enumerate() {
                let t = i as f64 / 48_000.0;
                let expected = 6.0 * peak * (-90.0 * speed * t).exp() * (TAU * 180.0 * speed * t).sin();
                // Rounding to `f32`, also of the strength, and the end of the transient at 1e-5 m/s².
                assert!((f64::from(*x) - expected).abs() < 2e-5 * (1.0 + peak), "{x} for {expected}");
            }
            // The peak of the waveform, not only its amplitude. At 225 Hz, half a sample is 0.015 rad, where a sine is
            // 0.01 % below its peak.
            let highest = |strength: f64| {
                landing(WOOD, strength as f32, 2400).iter().fold(0.0_f32, |peak, x| peak.max(x.abs()))
            };
            let ratio = f64::from(highest(strength)) / f64::from(highest(1.0));
            assert!((ratio / peak - 1.0).abs() < 5e-4, "{ratio} for {peak}");
        }
    }

    #[test]
    fn a_reference_impact_is_the_stated_transient_to_the_last_bit() {
        let angle = TAU * 180.0 / 48_000.0;
        let decay = libm::exp(-90.0 / 48_000.0);
        let (mut last, mut before) = (0.0, -6.0 / decay * libm::sin(angle));
        for (i, x) in landing(WOOD, 1.0, 2400).into_iter().enumerate() {
            assert_eq!(x.to_bits(), (last as f32).to_bits(), "sample {i}");
            (last, before) = (2.0 * decay * libm::cos(angle) * last - decay * decay * before, last);
        }
        assert_eq!(amplitude_factor(1.0), 1.0);
    }

    /// A tap on glass at the sample rate of a texture model, which cannot hold its 900 Hz.
    #[test]
    fn a_transient_above_the_band_keeps_its_peak_and_its_energy() {
        let glass = Tap { frequency_hz: 900.0, decay_per_sec: 157.0, amplitude_mps2: 691.0 };
        let mut taps = Taps::new(1000.0);
        taps.strike(glass, 1.0);
        let mut out = vec![0.0_f32; 200];
        taps.add_to(&mut out);
        let peak = out.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
        assert!((0.6..=1.0).contains(&(peak / 691.0)), "{peak} m/s²");
        let energy = out.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / 1000.0;
        // The integral of a decaying sinusoid of many periods; here the decay takes two periods.
        let expected = 691.0_f64.powi(2) / (4.0 * 157.0);
        assert!((0.8..1.25).contains(&(energy / expected)), "{energy} for {expected}");
        // Below this frequency, nothing changes.
        let mut taps = Taps::new(1000.0);
        taps.strike(Tap { frequency_hz: 399.0, ..WOOD }, 1.0);
        let mut out = [0.0_f32; 2];
        taps.add_to(&mut out);
        let expected = 6.0 * (-0.09_f64).exp() * (TAU * 0.399).sin();
        assert!((f64::from(out[1]) - expected).abs() < 1e-5, "{} for {expected}", out[1]);
    }

    #[test]
    fn landings_add_up_end_and_make_room() {
        let mut taps = Taps::new(48_000.0);
        let mut once = vec![0.0_f32; 480];
        taps.strike(WOOD, 1.0);
        taps.add_to(&mut once);
        taps.reset();
        assert!(!taps.are_ringing());
        let mut twice = vec![0.0_f32; 480];
        taps.strike(WOOD, 1.0);
        taps.strike(WOOD, 1.0);
        taps.add_to(&mut twice);
        assert!(once.iter().zip(&twice).all(|(x, y)| (2.0 * x - y).abs() < 1e-5));
        for _ in 0..50 {
            taps.strike(WOOD, 1.0);
        }
        let mut many = vec![0.0_f32; 48_000];
        taps.add_to(&mut many);
        assert!(many.iter().fold(0.0_f32, |peak, x| peak.max(x.abs())) < 4.0 * 6.0);
        assert!(!taps.are_ringing());
    }

    #[test]
    fn what_cannot_ring_is_silent() {
        let mut taps = Taps::new(48_000.0);
        for bad in [f32::NAN, f32::INFINITY, -1.0, 0.0] {
            taps.strike(Tap { frequency_hz: bad, ..WOOD }, 1.0);
        }
        for bad in [f32::NAN, f32::INFINITY, 0.0] {
            taps.strike(Tap { amplitude_mps2: bad, ..WOOD }, 1.0);
            taps.strike(WOOD, bad);
        }
        taps.strike(WOOD, -1.0);
        taps.strike(Tap { decay_per_sec: f32::INFINITY, ..WOOD }, 1.0);
        taps.strike(Tap::SILENT, 1.0);
        assert!(!taps.are_ringing());
        // A transient that would never decay ends too, and one that is too strong is bounded.
        taps.strike(Tap { amplitude_mps2: f32::MAX, ..WOOD }, 1.0);
        let mut strong = vec![0.0; 4800];
        taps.add_to(&mut strong);
        assert!(strong.iter().all(|x| f64::from(x.abs()) <= super::MAX_AMPLITUDE_MPS2));
        taps.reset();
        // The bound holds after the law of the impact speed.
        taps.strike(Tap { amplitude_mps2: 900.0, ..WOOD }, 3.0);
        let mut fast = vec![0.0; 4800];
        taps.add_to(&mut fast);
        assert!(fast.iter().all(|x| f64::from(x.abs()) <= super::MAX_AMPLITUDE_MPS2));
        taps.reset();
        taps.strike(Tap { decay_per_sec: -5.0, ..WOOD }, 1.0);
        taps.add_to(&mut vec![0.0; 480_000]);
        assert!(!taps.are_ringing());
    }
}
