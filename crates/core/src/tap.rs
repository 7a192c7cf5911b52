//! The transient when the tip lands: a decaying oscillation.

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
