//! An encoded signal: its frames, and the scale that restores its unit.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::Codebooks;
use super::decoder::Decoder;
use super::encoder::Encoder;
use super::frame::Frame;
use super::{CODEC_RATE, FRAME_SAMPLES};
use crate::dsp::spectrum::rms;

/// An encoded signal of [`CODEC_RATE`] in m/s².
#[derive(Clone, Debug, PartialEq)]
pub struct Coded {
    /// Bit rate.
    pub rate: Bitrate,
    /// Number of samples of the signal; the last frame may be partly used.
    pub n_samples: usize,
    /// Scale of the frames in m/s², above 0: the RMS of the signal, or 1 for silence.
    pub scale_mps2: f64,
    /// Peak magnitude of the signal in m/s²; the decoded signal does not exceed it.
    pub limit_mps2: f64,
    /// Frames; `None` for lost frames.
    pub frames: Vec<Option<Frame>>,
}

/// Reasons why a signal cannot be encoded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodedError {
    /// A sample is not a finite number.
    #[error("sample {index} of the signal is not a finite number; cut it out")]
    NotFinite {
        /// Index of the sample, from 0.
        index: usize,
    },
    /// The level is not plausible for a touch signal.
    #[error(
        "the signal peaks at {peak_mps2:e} m/s², which is not plausible for acceleration; correct its unit"
    )]
    Level {
        /// Peak magnitude in m/s².
        peak_mps2: f64,
    },
}

/// Range of plausible peak magnitudes in m/s², far wider than perceptible levels.
const PEAKS_MPS2: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

impl Coded {
    /// Returns the encoding of a signal of [`CODEC_RATE`] in m/s².
    ///
    /// # Errors
    /// [`CodedError::NotFinite`], or [`CodedError::Level`] if the peak is not plausible.
    pub fn encode(signal_mps2: &[f64], rate: Bitrate, books: &Arc<Codebooks>) -> Result<Self, CodedError> {
        if let Some(index) = signal_mps2.iter().position(|x| !x.is_finite()) {
            return Err(CodedError::NotFinite { index });
        }
        let peak_mps2 = signal_mps2.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if peak_mps2 > 0.0 && !PEAKS_MPS2.contains(&peak_mps2) {
            return Err(CodedError::Level { peak_mps2 });
        }
        let (scaled, scale_mps2) = of_unit_level(signal_mps2);
        let (mut encoder, mut frames) = (Encoder::new(rate, Arc::clone(books)), Vec::new());
        encoder.push(&scaled, &mut frames);
        encoder.finish(&mut frames);
        let frames = frames.into_iter().map(Some).collect();
        Ok(Self { rate, n_samples: signal_mps2.len(), scale_mps2, limit_mps2: peak_mps2, frames })
    }

    /// Returns the decoded signal in m/s²: `n_samples` samples, or fewer if frames are missing at the end.
    pub fn decode(&self, books: &Arc<Codebooks>) -> Vec<f64> {
        let limit = self.limit_mps2 / self.scale_mps2;
        let mut decoder = Decoder::new(self.rate, Arc::clone(books), limit);
        let mut signal = Vec::with_capacity(self.frames.len() * FRAME_SAMPLES);
        for frame in &self.frames {
            let samples = decoder.decode(frame.as_ref());
            // Rounding must not exceed the stated limit.
            let in_unit = |x: f64| (x * self.scale_mps2).clamp(-self.limit_mps2, self.limit_mps2);
            signal.extend(samples.map(in_unit));
        }
        signal.truncate(self.n_samples);
        signal
    }

    /// Returns the bits of all frames, lost frames included.
    pub fn n_bits(&self) -> u64 {
        self.frames.len() as u64 * u64::from(self.rate.allocation().n_bits())
    }

    /// Returns the duration of the signal in s.
    pub fn seconds(&self) -> f64 {
        self.n_samples as f64 / CODEC_RATE.0
    }
}

/// Returns the signal scaled to unit RMS, and the scale factor in the unit of the signal.
///
/// The factor is the RMS of the signal, or 1 for silence.
pub(super) fn of_unit_level(signal: &[f64]) -> (Vec<f64>, f64) {
    let level = rms(signal);
    let scale = if level > 0.0 { level } else { 1.0 };
    (signal.iter().map(|x| x / scale).collect(), scale)
}
