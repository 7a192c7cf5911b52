//! The sine that is played.

use std::f64::consts::{PI, TAU};

use crate::units::Hertz;

/// Least ratio of the ends of a sweep: three octaves.
pub(super) const LEAST_RATIO: f64 = 8.0;
/// The share of half the rate to which converters are flat.
pub(super) const NYQUIST_SHARE: f64 = 0.9;
/// Shares of the sweep in which it fades in and out.
const FADE_IN_SHARE: f64 = 0.01;
const FADE_OUT_SHARE: f64 = 0.0025;

/// A sine whose frequency rises exponentially, with silence around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Where it begins.
    pub low: Hertz,
    /// Where it ends, at least three octaves above.
    pub high: Hertz,
    /// How long it takes, 1 to 600.
    pub seconds: f64,
    /// Its peak as a share of digital full scale, above 0 to 1.
    pub amplitude: f64,
    /// Length of the silence before and behind it, 0 to 60: noise is measured there.
    pub silence_secs: f64,
}

/// Why a sweep has no meaning.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A number has no meaning.
    #[error("{what} of the sweep is {value}, needs {needs}")]
    Number {
        /// What it is of, with its unit.
        what: &'static str,
        /// The number.
        value: f64,
        /// What would have a meaning.
        needs: String,
    },
}

impl Sweep {
    /// 20 s from 10 to 1000 Hz at half of full scale, 2 s of silence on either side.
    pub const USUAL: Self =
        Self { low: Hertz(10.0), high: Hertz(1000.0), seconds: 20.0, amplitude: 0.5, silence_secs: 2.0 };

    /// The samples to play, silence included, -1 to 1.
    ///
    /// # Errors
    /// [`SweepError`], also where the sweep ends above nine tenths of half the rate.
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

    /// The same for an output of a rate in Hz.
    ///
    /// # Errors
    /// As [`Sweep::signal`].
    pub fn drive_samples(&self, rate_hz: f64) -> Result<Vec<f32>, SweepError> {
        let signal = self.signal(Hertz(rate_hz))?;
        Ok(signal.iter().map(|sample| *sample as f32).collect())
    }

    /// Whether its numbers have a meaning.
    ///
    /// # Errors
    /// [`SweepError`] for the first that has none.
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

    /// The sine alone.
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

    /// In how long its frequency grows by a factor of e.
    pub(super) fn growth_secs(&self) -> f64 {
        self.seconds / (self.high.0 / self.low.0).ln()
    }

    /// When it has a frequency, in seconds from its beginning.
    pub(super) fn time_of(&self, frequency: Hertz) -> f64 {
        self.growth_secs() * (frequency.0 / self.low.0).ln()
    }

    /// Its beginning, up to a frequency: as fast and as loud.
    pub(super) fn up_to(&self, high: Hertz) -> Self {
        Self { high, seconds: self.time_of(high), ..*self }
    }
}
