//! A signal for direct playback: a test tone, or the sweep of an actuator measurement.

use std::f64::consts::TAU;

use shagreen_synth::drive::Driven;

/// Longest signal, in seconds.
pub const MAX_SIGNAL_SECS: f64 = 120.0;
/// Duration of a tone's fade-in and fade-out, in seconds.
const TONE_FADE_SECS: f64 = 0.05;

/// Samples at the device's rate, with their kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    samples: Box<[f32]>,
    driven: Driven,
}

/// Reasons why samples are not a valid signal.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// There are no samples.
    #[error("the signal has no samples; make it longer")]
    Empty,
    /// The signal is too long.
    #[error("the signal lasts {secs:.1} s, but the limit is {MAX_SIGNAL_SECS} s; play a shorter one")]
    TooLong {
        /// Duration in seconds.
        secs: f64,
    },
    /// The sample rate is not a positive number.
    #[error("the sample rate of the signal is {rate_hz} Hz; use the sample rate of the output")]
    Rate {
        /// Given rate, in Hz.
        rate_hz: f64,
    },
    /// A sample is not finite.
    #[error("sample {index} of the signal is not a finite number; remove or replace it")]
    NotFinite {
        /// Index of the sample, from zero.
        index: usize,
    },
}

impl Signal {
    /// A signal with these samples; `rate_hz` is the sample rate of the output, in Hz. The samples are accelerations in
    /// m/s², or drive as fractions of the device's full scale, according to `driven`. The actuator's limits apply to
    /// both.
    ///
    /// # Errors
    /// [`SignalError`] names the problem.
    pub fn new(samples: Vec<f32>, rate_hz: f64, driven: Driven) -> Result<Self, SignalError> {
        if samples.is_empty() {
            return Err(SignalError::Empty);
        }
        check_length(samples.len() as f64, rate_hz)?;
        if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
            return Err(SignalError::NotFinite { index });
        }
        Ok(Self { samples: samples.into_boxed_slice(), driven })
    }

    /// A sine of acceleration with a fade-in and a fade-out.
    ///
    /// # Errors
    /// [`SignalError`] if it is too long or an argument is not finite.
    pub fn tone(
        frequency_hz: f64,
        amplitude_mps2: f64,
        secs: f64,
        rate_hz: f64,
    ) -> Result<Self, SignalError> {
        let n_frames = (secs * rate_hz).round();
        check_length(n_frames, rate_hz)?;
        let sample = |i: usize| {
            let t = i as f64 / rate_hz;
            let fade = (t.min(secs - t) / TONE_FADE_SECS).clamp(0.0, 1.0);
            (amplitude_mps2 * fade * (TAU * frequency_hz * t).sin()) as f32
        };
        Self::new((0..n_frames as usize).map(sample).collect(), rate_hz, Driven::Acceleration)
    }

    /// Number of samples.
    pub fn n_frames(&self) -> usize {
        self.samples.len()
    }

    pub(crate) fn driven(&self) -> Driven {
        self.driven
    }

    /// Up to `n` samples from index `begin`.
    pub(crate) fn part(&self, begin: usize, n: usize) -> &[f32] {
        let begin = begin.min(self.samples.len());
        &self.samples[begin..self.samples.len().min(begin + n)]
    }
}

/// Checks that the signal is not too long.
fn check_length(n_frames: f64, rate_hz: f64) -> Result<(), SignalError> {
    if !(rate_hz.is_finite() && rate_hz > 0.0) {
        return Err(SignalError::Rate { rate_hz });
    }
    let secs = n_frames / rate_hz;
    if secs > MAX_SIGNAL_SECS { Err(SignalError::TooLong { secs }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::{Driven, MAX_SIGNAL_SECS, Signal, SignalError};

    #[test]
    fn what_is_no_signal_is_refused() {
        let of = |samples| Signal::new(samples, 48_000.0, Driven::Drive).unwrap_err();
        assert_eq!(of(Vec::new()), SignalError::Empty);
        assert_eq!(of(vec![0.0, f32::NAN]), SignalError::NotFinite { index: 1 });
        for rate_hz in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(Signal::new(vec![0.0], rate_hz, Driven::Drive), Err(SignalError::Rate { rate_hz }));
        }
        for secs in [0.0, 1e9, f64::NAN] {
            assert!(Signal::tone(100.0, 1.0, secs, 48_000.0).is_err());
        }
        assert!(Signal::tone(f64::NAN, 1.0, 1.0, 48_000.0).is_err());
    }

    #[test]
    fn a_signal_is_as_long_as_it_takes_whatever_the_rate() {
        for rate_hz in [8000.0, 192_000.0] {
            let n = (MAX_SIGNAL_SECS * rate_hz) as usize;
            let of = |n| Signal::new(vec![0.0; n], rate_hz, Driven::Drive);
            assert_eq!(of(n).unwrap().n_frames(), n);
            let error = of(n + rate_hz as usize / 2).unwrap_err();
            assert_eq!(error, SignalError::TooLong { secs: 120.5 });
            assert!(
                error.to_string().contains("120.5 s") && error.to_string().contains("shorter"),
                "{error}"
            );
            let error = Signal::tone(100.0, 1.0, 121.0, rate_hz).unwrap_err();
            assert_eq!(error, SignalError::TooLong { secs: 121.0 });
        }
    }

    #[test]
    fn a_tone_comes_and_goes_softly() {
        let tone = Signal::tone(250.0, 2.0, 0.5, 48_000.0).unwrap();
        assert_eq!((tone.n_frames(), tone.driven()), (24_000, Driven::Acceleration));
        let samples = tone.part(0, usize::MAX / 2);
        let peak = |x: &[f32]| x.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
        assert!(peak(&samples[..24]) < 0.03 && peak(&samples[23_976..]) < 0.03);
        assert!((peak(&samples[4800..19_200]) - 2.0).abs() < 1e-3);
        assert_eq!(tone.part(23_999, 10).len(), 1);
        assert!(tone.part(24_000, 10).is_empty());
    }
}
