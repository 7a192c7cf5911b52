//! Amplitudes from -1 to 1 for quantities with a unit.

use crate::library::{DIGITS, digits};

/// Lowest and highest exponent: both leave room in a `f64` and fit the field.
const EXPONENTS: [f64; 2] = [-100.0, 100.0];
/// Significant digits of a gain: so many more than those of an amplitude that a full quantity has the amplitude 1.
const GAIN_DIGITS: usize = 9;

/// Scale of a channel: a quantity is its amplitude times `gain` times 10 to the power of `exponent`, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// Power of ten, for `perception_unit_exponent`.
    pub(super) exponent: i8,
    /// Gain of the channel, above 0.1 and up to 1 for usual quantities.
    pub(super) gain: f64,
}

impl Scale {
    /// Scale on which `full` has the amplitude 1; zero and numbers below have any.
    pub(super) fn of(full: f64) -> Self {
        if full <= 0.0 {
            return Self { exponent: 0, gain: 1.0 };
        }
        let exponent = full.log10().ceil().clamp(EXPONENTS[0], EXPONENTS[1]);
        Self { exponent: exponent as i8, gain: digits(full / 10_f64.powf(exponent), GAIN_DIGITS) }
    }

    /// Amplitude of a quantity, in as many digits as files have.
    pub(super) fn amplitude(self, value: f64) -> f64 {
        digits(value / (self.gain * 10_f64.powi(i32::from(self.exponent))), DIGITS)
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn a_full_quantity_has_the_amplitude_one() {
        for (full, exponent) in [(1.0, 0), (0.4, 0), (0.04, -1), (2.5, 1), (31_622.7, 5), (1e300, 100)] {
            let scale = Scale::of(full);
            assert_eq!((scale.exponent, scale.amplitude(full)), (exponent, 1.0), "{full}");
            assert!((scale.amplitude(0.5 * full) - 0.5).abs() < 1e-6);
            let back = scale.gain * 10_f64.powi(i32::from(scale.exponent));
            // The gain is rounded.
            assert!((back / full - 1.0).abs() < 1e-8, "{full}");
        }
        assert_eq!((Scale::of(0.0).gain, Scale::of(0.0).amplitude(0.0)), (1.0, 0.0));
    }
}
