//! A whole signal as frames, with what it takes to make it again in its own unit.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::Codebooks;
use super::decoder::Decoder;
use super::encoder::Encoder;
use super::frame::Frame;
use super::{CODEC_RATE, FRAME_SAMPLES};
use crate::spectrum::rms;

/// A signal of [`CODEC_RATE`] in m/s² that was encoded.
#[derive(Clone, Debug, PartialEq)]
pub struct Coded {
    /// Bits a second.
    pub rate: Bitrate,
    /// Samples of the signal: the last frame may hold fewer than the others.
    pub n_samples: usize,
    /// What one of the unit of the frames is, in m/s², above 0: the root mean square of the signal, or 1 of silence.
    pub scale_mps2: f64,
    /// The highest magnitude of the signal in m/s², which what is decoded does not exceed.
    pub limit_mps2: f64,
    /// Its frames, `None` for those that were lost.
    pub frames: Vec<Option<Frame>>,
}

/// Why a signal cannot be encoded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodedError {
    /// A sample that is no number.
    #[error("sample {index} of the signal is not a finite number; cut it out")]
    NotFinite {
        /// Which, from zero.
        index: usize,
    },
    /// A signal that no actuator makes.
    #[error(
        "the signal goes up to {peak_mps2:e} m/s², which is no acceleration of a touch; correct its unit"
    )]
    Level {
        /// Its highest magnitude in m/s².
        peak_mps2: f64,
    },
}

/// Highest magnitude of a signal that is not silent, in m/s²: far beyond what is felt on both sides.
const PEAKS_MPS2: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

impl Coded {
    /// Encodes a signal of [`CODEC_RATE`] in m/s².
    ///
    /// # Errors
    /// See [`CodedError`].
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

    /// The signal that the frames make, in m/s²; as long as the frames that there are.
    pub fn decode(&self, books: &Arc<Codebooks>) -> Vec<f64> {
        let limit = self.limit_mps2 / self.scale_mps2;
        let mut decoder = Decoder::new(self.rate, Arc::clone(books), limit);
        let mut signal = Vec::with_capacity(self.frames.len() * FRAME_SAMPLES);
        for frame in &self.frames {
            let samples = decoder.decode(frame.as_ref());
            // Rounding may not lead beyond what was promised.
            let in_unit = |x: f64| (x * self.scale_mps2).clamp(-self.limit_mps2, self.limit_mps2);
            signal.extend(samples.map(in_unit));
        }
        signal.truncate(self.n_samples);
        signal
    }

    /// Bits of all frames, lost ones too.
    pub fn n_bits(&self) -> u64 {
        self.frames.len() as u64 * u64::from(self.rate.allocation().n_bits())
    }

    /// Length of the signal in s.
    pub fn seconds(&self) -> f64 {
        self.n_samples as f64 / CODEC_RATE.0
    }
}

/// A signal as the encoder takes it, and what one of it is in the unit of the signal: its root mean square, which becomes one,
/// or one where it is silent.
pub(super) fn of_unit_level(signal: &[f64]) -> (Vec<f64>, f64) {
    let level = rms(signal);
    let scale = if level > 0.0 { level } else { 1.0 };
    (signal.iter().map(|x| x / scale).collect(), scale)
}
