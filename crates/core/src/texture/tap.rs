//! Tap transient: the vibration when the tip makes contact, a decaying sinusoid.

use std::ops::RangeInclusive;

use shagreen_synth::tap::{MAX_AMPLITUDE_MPS2, SLOWEST_DECAY_PER_SEC};

use crate::units::Hertz;

/// Valid frequencies of a tap transient, in Hz: from what a voice coil can follow to the upper limit of hearing. Above
/// about 1 kHz, a transient is only heard.
pub const TAP_FREQUENCIES_HZ: RangeInclusive<f64> = 1.0..=20_000.0;

/// Valid decay rates of a tap transient, in 1/s. The renderer uses at least [`SLOWEST_DECAY_PER_SEC`], because a slower
/// decay would drive the actuator for seconds.
pub const TAP_DECAYS_PER_SEC: RangeInclusive<f64> = 0.5..=1e5;

/// Valid amplitudes of a tap transient, in m/s².
pub const TAP_AMPLITUDES_MPS2: RangeInclusive<f64> = 0.0..=MAX_AMPLITUDE_MPS2;

/// Highest energy `A²/4B` of a tap transient, in (m/s²)²·s. A pen that hits glass at 0.1 m/s has about 600.
pub const MAX_TAP_ENERGY: f64 = 1000.0;

/// Reasons why numbers are not a valid tap transient.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TapError {
    /// A value is out of range or not a number.
    #[error("its {what} is {value:e}; it must be between {low} and {high} {unit}")]
    Value {
        /// Quantity that is out of range.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Lowest valid value.
        low: f64,
        /// Highest valid value.
        high: f64,
        /// Unit of the values.
        unit: &'static str,
    },
    /// The transient is too strong for its duration.
    #[error(
        "its energy A²/4B is {energy:.0} (m/s²)²·s; it must be at most {MAX_TAP_ENERGY}; reduce the amplitude A or increase the decay B"
    )]
    Energy {
        /// The energy.
        energy: f64,
    },
}

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
    /// Returns the transient if its values and its energy are within the valid ranges.
    ///
    /// # Errors
    /// See [`TapError`].
    pub fn checked(self) -> Result<Self, TapError> {
        for (what, value, range, unit) in [
            ("frequency", self.frequency.0, &TAP_FREQUENCIES_HZ, "Hz"),
            ("decay", self.decay_per_sec, &TAP_DECAYS_PER_SEC, "1/s"),
            ("amplitude", self.amplitude_mps2, &TAP_AMPLITUDES_MPS2, "m/s²"),
        ] {
            if !range.contains(&value) {
                return Err(TapError::Value { what, value, low: *range.start(), high: *range.end(), unit });
            }
        }
        let energy = self.energy();
        if energy > MAX_TAP_ENERGY { Err(TapError::Energy { energy }) } else { Ok(self) }
    }

    /// Returns the transient with every value clamped to its valid range. If the energy is then still too high, the
    /// amplitude is reduced.
    #[must_use]
    pub fn bounded(self) -> Self {
        let within = |value: f64, range: &RangeInclusive<f64>| value.clamp(*range.start(), *range.end());
        let frequency = Hertz(within(self.frequency.0, &TAP_FREQUENCIES_HZ));
        let decay_per_sec = within(self.decay_per_sec, &TAP_DECAYS_PER_SEC);
        // Slightly less than the limit, so that rounding in a file does not exceed it.
        let strongest = 0.999 * (4.0 * decay_per_sec.max(SLOWEST_DECAY_PER_SEC) * MAX_TAP_ENERGY).sqrt();
        let amplitude_mps2 = within(self.amplitude_mps2, &TAP_AMPLITUDES_MPS2);
        let bounded = Self { frequency, decay_per_sec, amplitude_mps2 };
        if bounded.energy() > MAX_TAP_ENERGY {
            Self { amplitude_mps2: strongest, ..bounded }
        } else {
            bounded
        }
    }

    /// Approximate energy `A²/4B` of the rendered transient in (m/s²)²·s: the integral of the squared acceleration, if
    /// the decay takes many periods.
    pub fn energy(&self) -> f64 {
        self.amplitude_mps2.powi(2) / (4.0 * self.decay_per_sec.max(SLOWEST_DECAY_PER_SEC))
    }

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

#[cfg(test)]
mod tests {
    use super::{MAX_TAP_ENERGY, Tap, TapError};
    use crate::units::Hertz;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    const WOOD: Tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 6.0 };

    #[test]
    fn a_tap_that_could_hurt_is_refused() {
        assert_eq!(WOOD.checked(), Ok(WOOD));
        for bad in [0.0, 1e300, f64::NAN, -3.0] {
            assert!(matches!(Tap { frequency: Hertz(bad), ..WOOD }.checked(), Err(TapError::Value { .. })));
        }
        for bad in [1e-9, 0.0, 0.4, f64::INFINITY, f64::NAN] {
            assert!(matches!(Tap { decay_per_sec: bad, ..WOOD }.checked(), Err(TapError::Value { .. })));
        }
        let loud = Tap { amplitude_mps2: 3e38, ..WOOD }.checked().unwrap_err().to_string();
        assert!(loud.contains("amplitude is 3e38") && loud.contains("1000 m/s²"), "{loud}");
        let long = Tap { amplitude_mps2: 900.0, decay_per_sec: 6.0, ..WOOD }.checked().unwrap_err();
        assert!(matches!(long, TapError::Energy { energy } if energy > MAX_TAP_ENERGY), "{long}");
    }

    #[test]
    fn the_energy_is_that_of_the_acceleration() {
        let step_secs = 1e-5;
        let sum: f64 = (0..100_000).map(|i| WOOD.at(f64::from(i) * step_secs).powi(2) * step_secs).sum();
        // The exact integral is A²/4B · ω²/(ω²+B²), and here B is a twelfth of ω.
        assert!((sum / WOOD.energy() - 1.0).abs() < 0.01, "{sum} for {}", WOOD.energy());
    }

    proptest! {
        #[test]
        fn bounded_taps_pass_the_check(f in -1e6_f64..1e6, b in -1e6_f64..1e6, a in -1e6_f64..1e6) {
            let tap = Tap { frequency: Hertz(f), decay_per_sec: b, amplitude_mps2: a };
            let bounded = tap.bounded();
            // As after rounding to six digits in a file.
            let rounded = |x: f64| format!("{x:.5e}").parse::<f64>().unwrap();
            let in_file = Tap {
                frequency: Hertz(rounded(bounded.frequency.0)),
                decay_per_sec: rounded(bounded.decay_per_sec),
                amplitude_mps2: rounded(bounded.amplitude_mps2),
            };
            prop_assert!(in_file.checked().is_ok(), "{bounded:?}");
            if tap.checked().is_ok() {
                prop_assert_eq!(bounded, tap);
            }
        }
    }
}
