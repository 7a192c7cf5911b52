//! The transient when the tip lands: a decaying oscillation.

mod landing;
mod ring;

use crate::recording::Recording;
use crate::tap::landing::landings;
use crate::tap::ring::ring;
use crate::units::Hertz;

/// `a(t) = A e^{-Bt} sin 2πft` from the moment of landing (A. Okamura, M. Cutkosky and J. Dennerlein, "Reality-based
/// models for vibration feedback in virtual environments", 2001).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// `f`.
    pub frequency: Hertz,
    /// `B`, in 1/s.
    pub decay_per_sec: f64,
    /// `A`, in m/s², at the landing it was measured at: it grows with the speed of the landing.
    pub amplitude_mps2: f64,
}

impl Tap {
    /// Acceleration at a time in seconds since the landing, in m/s²; zero before.
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

/// The oscillation that stands for the landings of some recordings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landed {
    /// The oscillation; its amplitude is that of the mean landing.
    pub tap: Tap,
    /// How many landings were found.
    pub n_landings: usize,
    /// Share of the energy of the landings that the oscillation explains, each at its own amplitude, 0..1.
    pub explained: f64,
}

/// The landings of recordings and the oscillation through them, or `None` where the tip never lands within what is usable.
///
/// A landing is a force that comes from below [`crate::segment::MIN_FORCE`] and stays above it; recordings of different
/// rates each count at their own.
pub fn fit_landings(recordings: &[Recording]) -> Option<Landed> {
    let transients: Vec<_> = recordings.iter().flat_map(landings).collect();
    ring(&transients)
}

#[cfg(test)]
mod tests;
