//! Haptic clips as signals: sines whose amplitude and frequency follow curves, and decaying bursts.
//!
//! Clips of other programs have amplitudes from 0 to 1 and no acceleration, so the acceleration of an amplitude of 1 is an argument
//! of [`HapticEnvelope::render`].
//!
//! A [`Voice`] is `level(t) · sin(2π φ(t))`; the phase `φ`, in periods, is the integral of its frequency and is 0 at the first
//! sample of the voice. A [`Burst`] is `amplitude · exp(−t / decay) · sin(2π · frequency · t)`.

mod curve;

use std::f64::consts::TAU;

pub use crate::signals::haptic_envelope::curve::{Curve, Law};

use crate::units::Hertz;

/// Longest clip that is rendered, in seconds.
pub const MAX_SECS: f64 = 120.0;
/// Frequencies that players of clips use if nothing else is stated, in Hz: those of a frequency of 0 and of 1.
pub const USUAL_BAND_HZ: [f64; 2] = [60.0, 300.0];
/// Decay time of a burst whose clip states none, in seconds.
pub const BURST_DECAY_SECS: f64 = 0.01;
/// Longest total duration of all voices and bursts, in seconds: ten of each length at once.
pub const MAX_TOTAL_SECS: f64 = 10.0 * MAX_SECS;
/// Decay times after which a burst ends; it has 0.7 % of its amplitude left.
const DECAYS: f64 = 5.0;

/// Vibration of a clip: all voices and bursts are added.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HapticEnvelope {
    /// Continuous vibrations.
    pub voices: Vec<Voice>,
    /// Short events.
    pub bursts: Vec<Burst>,
}

/// Sine whose amplitude and frequency change. It is silent before the first and after the last point of its level.
#[derive(Clone, Debug, PartialEq)]
pub struct Voice {
    /// Amplitude over time, from 0 to 1.
    pub level: Curve,
    /// Frequency over time in Hz, at least 0.
    pub frequency: Curve,
}

/// Decaying sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burst {
    /// Time at which it begins, in seconds.
    pub start_secs: f64,
    /// Amplitude at the beginning, from 0 to 1.
    pub amplitude: f64,
    /// Frequency.
    pub frequency: Hertz,
    /// Time in which the amplitude falls to 1/e, in seconds.
    pub decay_secs: f64,
}

/// Why a clip cannot be rendered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnvelopeError {
    /// A curve has no points.
    #[error("an envelope has no points; add at least one")]
    NoPoints,
    /// A time is negative, not finite, or before the point before it.
    #[error(
        "point {} of an envelope is at {secs} s; times must be finite, at least 0, and must not decrease",
        .index + 1
    )]
    Time {
        /// Index of the point, from zero.
        index: usize,
        /// Its time in seconds.
        secs: f64,
    },
    /// A value is not finite or outside its range.
    #[error("{what} is {value}, but must be between {low} and {high}")]
    Value {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// The value.
        value: f64,
        /// Lowest valid value.
        low: f64,
        /// Highest valid value.
        high: f64,
    },
    /// The clip has no duration.
    #[error("the clip has no duration; it needs two amplitudes at different times, or a transient")]
    Empty,
    /// The clip is too long.
    #[error("the clip lasts {secs:.1} s, but at most {MAX_SECS} s are rendered; cut it")]
    TooLong {
        /// Duration in seconds.
        secs: f64,
    },
    /// Too many voices and bursts overlap.
    #[error(
        "the events of the clip last {secs:.0} s together, but at most {MAX_TOTAL_SECS} s are rendered; leave events out"
    )]
    TooMany {
        /// Sum of their durations in seconds.
        secs: f64,
    },
}

impl HapticEnvelope {
    /// Duration in seconds: the end of the last voice or burst.
    pub fn seconds(&self) -> f64 {
        let voices = self.voices.iter().map(|voice| voice.level.end_secs());
        let bursts = self.bursts.iter().map(Burst::end_secs);
        voices.chain(bursts).fold(0.0, f64::max)
    }

    /// Highest frequency; 0 Hz without voices and bursts.
    pub fn highest(&self) -> Hertz {
        let voices = self.voices.iter().map(|voice| voice.frequency.extremes()[1]);
        let bursts = self.bursts.iter().map(|burst| burst.frequency.0);
        Hertz(voices.chain(bursts).fold(0.0, f64::max))
    }

    /// Acceleration in m/s² at this sample rate. `full_scale_mps2` is the acceleration of an amplitude of 1.
    ///
    /// # Errors
    /// See [`EnvelopeError`]. Frequencies must be below half the sample rate.
    pub fn render(&self, rate: Hertz, full_scale_mps2: f64) -> Result<Vec<f64>, EnvelopeError> {
        self.check(rate)?;
        let secs = self.seconds();
        let n_samples = (secs * rate.0).round() as usize;
        if n_samples == 0 {
            return Err(EnvelopeError::Empty);
        }
        if secs > MAX_SECS {
            return Err(EnvelopeError::TooLong { secs });
        }
        let voices = self.voices.iter().map(|voice| voice.level.end_secs() - voice.level.start_secs());
        let total_secs: f64 = voices.chain(self.bursts.iter().map(|burst| DECAYS * burst.decay_secs)).sum();
        if total_secs > MAX_TOTAL_SECS {
            return Err(EnvelopeError::TooMany { secs: total_secs });
        }
        let mut samples = vec![0.0; n_samples];
        for voice in &self.voices {
            voice.add_to(&mut samples, rate);
        }
        for burst in &self.bursts {
            burst.add_to(&mut samples, rate);
        }
        for sample in &mut samples {
            *sample *= full_scale_mps2;
        }
        Ok(samples)
    }

    fn check(&self, rate: Hertz) -> Result<(), EnvelopeError> {
        let within = |what: &'static str, value: f64, [low, high]: [f64; 2]| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(EnvelopeError::Value { what, value, low, high })
            }
        };
        // At half the rate, all samples of a sine may be zero.
        let frequencies = [0.0, 0.499 * rate.0];
        for voice in &self.voices {
            for level in voice.level.extremes() {
                within("the amplitude", level, [0.0, 1.0])?;
            }
            for hz in voice.frequency.extremes() {
                within("the frequency in Hz", hz, frequencies)?;
            }
        }
        for burst in &self.bursts {
            within("the time of a transient in s", burst.start_secs, [0.0, MAX_SECS])?;
            within("the amplitude of a transient", burst.amplitude, [0.0, 1.0])?;
            within("the frequency of a transient in Hz", burst.frequency.0, frequencies)?;
            within("the decay time of a transient in s", burst.decay_secs, [0.0, MAX_SECS])?;
        }
        Ok(())
    }
}

impl Voice {
    fn add_to(&self, samples: &mut [f64], rate: Hertz) {
        let [start_secs, end_secs] = [self.level.start_secs(), self.level.end_secs()];
        let first = (start_secs * rate.0).ceil() as usize;
        let (mut level, mut frequency) = (self.level.cursor(), self.frequency.cursor());
        // In periods, from 0 to 1, so that it stays exact in long clips.
        let mut phase = 0.0_f64;
        let mut before_hz = None;
        for (index, sample) in samples.iter_mut().enumerate().skip(first) {
            let secs = index as f64 / rate.0;
            if secs > end_secs {
                break;
            }
            let hz = frequency.at(secs);
            // The trapezoidal rule is exact for a frequency that changes linearly.
            phase += before_hz.map_or(0.0, |before_hz: f64| 0.5 * (before_hz + hz) / rate.0);
            phase -= phase.floor();
            before_hz = Some(hz);
            *sample += level.at(secs) * (TAU * phase).sin();
        }
    }
}

impl Burst {
    /// Time at which the burst ends, in seconds.
    fn end_secs(&self) -> f64 {
        self.start_secs + DECAYS * self.decay_secs
    }

    fn add_to(&self, samples: &mut [f64], rate: Hertz) {
        let first = (self.start_secs * rate.0).ceil() as usize;
        for (index, sample) in samples.iter_mut().enumerate().skip(first) {
            let secs = index as f64 / rate.0 - self.start_secs;
            if secs > DECAYS * self.decay_secs {
                break;
            }
            // A decay time of zero has only its first sample, whose sine is zero.
            let gain = if self.decay_secs > 0.0 { (-secs / self.decay_secs).exp() } else { 0.0 };
            *sample += self.amplitude * gain * (TAU * self.frequency.0 * secs).sin();
        }
    }
}

#[cfg(test)]
mod tests;
