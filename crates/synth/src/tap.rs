//! Tap transient at a contact onset: a decaying sinusoid that starts at the sample of the impact.

use core::f64::consts::TAU;

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

    /// Starts a transient now, scaled by `strength` relative to the measured tap. Parameters without a valid
    /// oscillation are ignored: a frequency of zero or of at least half the sample rate, or a value that is not finite.
    /// The decay is at least [`SLOWEST_DECAY_PER_SEC`], and the amplitude at most [`MAX_AMPLITUDE_MPS2`].
    pub fn strike(&mut self, tap: Tap, strength: f32) {
        let angle = TAU * f64::from(tap.frequency_hz) / self.rate_hz;
        let decay_per_sec = f64::from(tap.decay_per_sec).max(SLOWEST_DECAY_PER_SEC);
        let amplitude = f64::from(tap.amplitude_mps2) * f64::from(strength);
        let can_ring = angle > 0.0 && angle < TAU / 2.0 && amplitude.is_finite() && decay_per_sec.is_finite();
        if !can_ring || amplitude == 0.0 {
            return;
        }
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
    use super::{TAU, Tap, Taps};
    use std::vec;

    const WOOD: Tap = Tap { frequency_hz: 180.0, decay_per_sec: 90.0, amplitude_mps2: 6.0 };

    #[test]
    fn rings_as_the_equation_says_in_any_blocks() {
        for block in [1, 100, 4800] {
            let mut taps = Taps::new(48_000.0);
            taps.strike(WOOD, 0.5);
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
        for bad in [f32::NAN, f32::INFINITY, -1.0, 0.0, 30_000.0] {
            taps.strike(Tap { frequency_hz: bad, ..WOOD }, 1.0);
        }
        for bad in [f32::NAN, f32::INFINITY, 0.0] {
            taps.strike(Tap { amplitude_mps2: bad, ..WOOD }, 1.0);
            taps.strike(WOOD, bad);
        }
        taps.strike(Tap { decay_per_sec: f32::INFINITY, ..WOOD }, 1.0);
        taps.strike(Tap::SILENT, 1.0);
        assert!(!taps.are_ringing());
        // A transient that would never decay ends too, and one that is too strong is bounded.
        taps.strike(Tap { amplitude_mps2: f32::MAX, ..WOOD }, 1.0);
        let mut strong = vec![0.0; 4800];
        taps.add_to(&mut strong);
        assert!(strong.iter().all(|x| f64::from(x.abs()) <= super::MAX_AMPLITUDE_MPS2));
        taps.reset();
        taps.strike(Tap { decay_per_sec: -5.0, ..WOOD }, 1.0);
        taps.add_to(&mut vec![0.0; 480_000]);
        assert!(!taps.are_ringing());
    }
}
