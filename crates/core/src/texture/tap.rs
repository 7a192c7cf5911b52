//! Tap transient: the vibration when the tip makes contact, a decaying sinusoid.

use crate::units::Hertz;

/// Tap transient `a(t) = A e^{-Bt} sin 2πft` from the moment of contact (A. Okamura, M. Cutkosky and J. Dennerlein,
/// "Reality-based models for vibration feedback in virtual environments", 2001).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Frequency `f`.
    pub frequency: Hertz,
    /// Decay rate `B`, in 1/s.
    pub decay_per_sec: f64,
    /// Amplitude `A` in m/s², at the measured impact speed; it grows with impact speed.
    pub amplitude_mps2: f64,
}

impl Tap {
    /// Acceleration in m/s² at a time in seconds since contact; zero before contact.
    pub fn at(&self, time_secs: f64) -> f64 {
        if time_secs < 0.0 {
            return 0.0;
        }
        let phase = std::f64::consts::TAU * self.frequency.0 * time_secs;
        self.amplitude_mps2 * (-self.decay_per_sec * time_secs).exp() * phase.sin()
    }
}

impl From<Tap> for shagreen_synth::tap::Tap {
    fn from(tap: Tap) -> Self {
        Self {
            frequency_hz: tap.frequency.0 as f32,
            decay_per_sec: tap.decay_per_sec as f32,
            amplitude_mps2: tap.amplitude_mps2 as f32,
        }
    }
}
