//! Exponential sine sweep for calibration.

use std::f64::consts::{PI, TAU};

use crate::units::Hertz;

/// Minimum frequency ratio of a sweep: three octaves.
pub(super) const LEAST_RATIO: f64 = 8.0;
/// Fraction of the Nyquist frequency up to which converters are flat.
pub(super) const NYQUIST_SHARE: f64 = 0.9;
/// Fractions of the sweep duration used to fade in and out.
const FADE_IN_SHARE: f64 = 0.01;
const FADE_OUT_SHARE: f64 = 0.0025;

/// Sine whose frequency increases exponentially, with silence before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Start frequency.
    pub low: Hertz,
    /// End frequency, at least three octaves above the start frequency.
    pub high: Hertz,
    /// Duration in seconds, 1 to 600.
    pub seconds: f64,
    /// Peak amplitude relative to digital full scale, above 0, at most 1.
    pub amplitude: f64,
    /// Duration of the silence before and after the sweep in seconds, 0 to 60; the noise is measured there.
    pub silence_secs: f64,
}

/// Error of the sweep settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A number is out of range.
    #[error("{what} of the sweep is {value}, needs {needs}")]
    Number {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Valid values.
        needs: String,
    },
}

impl Sweep {
    /// Default: 20 s from 10 to 1000 Hz at half of full scale, with 2 s of silence on both sides.
    pub const USUAL: Self =
        Self { low: Hertz(10.0), high: Hertz(1000.0), seconds: 20.0, amplitude: 0.5, silence_secs: 2.0 };

    /// Samples to play, including the silence, -1 to 1.
    ///
    /// # Errors
    /// [`SweepError`] if a setting is out of range, or if the sweep ends above nine tenths of the Nyquist frequency.
    pub fn signal(&self, rate: Hertz) -> Result<Vec<f64>, SweepError> {
        self.check()?;
        let most_hz = NYQUIST_SHARE * 0.5 * rate.0;
        if most_hz.is_nan() || self.high.0 > most_hz {
            let needs = format!("{most_hz} or less at this rate");
            return Err(SweepError::Number { what: "the end in Hz", value: self.high.0, needs });
        }
        let silence = vec![0.0; (self.silence_secs * rate.0).round() as usize];
        Ok([silence.clone(), self.samples(rate), silence].concat())
    }

    /// Samples to play as `f32`, for an output with this sample rate in Hz.
    ///
    /// # Errors
    /// As [`Sweep::signal`].
    pub fn drive_samples(&self, rate_hz: f64) -> Result<Vec<f32>, SweepError> {
        let signal = self.signal(Hertz(rate_hz))?;
        Ok(signal.iter().map(|sample| *sample as f32).collect())
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`SweepError`] for the first setting out of range.
    pub fn check(&self) -> Result<(), SweepError> {
        let numbers = [
            ("the beginning in Hz", self.low.0, 0.1, 10_000.0),
            ("the end in Hz", self.high.0, LEAST_RATIO * self.low.0, 24_000.0),
            ("the length in s", self.seconds, 1.0, 600.0),
            ("the amplitude", self.amplitude, 1e-6, 1.0),
            ("the silence in s", self.silence_secs, 0.0, 60.0),
        ];
        for (what, value, least, most) in numbers {
            if !(least..=most).contains(&value) {
                return Err(SweepError::Number { what, value, needs: format!("{least} to {most}") });
            }
        }
        Ok(())
    }

    /// Samples of the sine sweep without the silence.
    pub(super) fn samples(&self, rate: Hertz) -> Vec<f64> {
        let n = (self.seconds * rate.0).round() as usize;
        let growth_secs = self.growth_secs();
        let cosine = |share: f64| 0.5 - 0.5 * (PI * share.clamp(0.0, 1.0)).cos();
        let sample = |i: usize| {
            let t = i as f64 / rate.0;
            let fade = cosine(t / (FADE_IN_SHARE * self.seconds))
                * cosine((self.seconds - t) / (FADE_OUT_SHARE * self.seconds));
            let phase = TAU * self.low.0 * growth_secs * (t / growth_secs).exp_m1();
            self.amplitude * fade * phase.sin()
        };
        (0..n).map(sample).collect()
    }

    /// Time in seconds in which the frequency grows by a factor of e.
    pub(super) fn growth_secs(&self) -> f64 {
        self.seconds / (self.high.0 / self.low.0).ln()
    }

    /// Time in seconds from the start of the sweep at which it reaches a frequency.
    pub(super) fn time_of(&self, frequency: Hertz) -> f64 {
        self.growth_secs() * (frequency.0 / self.low.0).ln()
    }

    /// First part of the sweep, up to a frequency, at the same speed and amplitude.
    pub(super) fn up_to(&self, high: Hertz) -> Self {
        Self { high, seconds: self.time_of(high), ..*self }
    }
}
