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
    /// What one of the unit of the frames is, in m/s², above 0: the root mean square of the signal.
    pub scale_mps2: f64,
    /// The highest magnitude of the signal in m/s², which what is decoded does not exceed.
    pub limit_mps2: f64,
    /// Its frames, `None` for those that were lost.
    pub frames: Vec<Option<Frame>>,
}

impl Coded {
    /// Encodes a signal of [`CODEC_RATE`] in m/s². What is no finite number counts as silence.
    pub fn encode(signal_mps2: &[f64], rate: Bitrate, books: &Arc<Codebooks>) -> Self {
        let finite: Vec<f64> = signal_mps2.iter().map(|x| if x.is_finite() { *x } else { 0.0 }).collect();
        let limit_mps2 = finite.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let level = rms(&finite);
        let scale_mps2 = if level > 0.0 { level } else { 1.0 };
        let scaled: Vec<f64> = finite.iter().map(|x| x / scale_mps2).collect();
        let (mut encoder, mut frames) = (Encoder::new(rate, Arc::clone(books)), Vec::new());
        encoder.push(&scaled, &mut frames);
        encoder.finish(&mut frames);
        let frames = frames.into_iter().map(Some).collect();
        Self { rate, n_samples: signal_mps2.len(), scale_mps2, limit_mps2, frames }
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

/// How far the signal lies over what another differs by, in dB: `10 log₁₀(Σ x² / Σ (x - y)²)`; infinite where they are equal.
///
/// # Panics
/// If the lengths differ.
pub fn snr_db(signal: &[f64], other: &[f64]) -> f64 {
    assert_eq!(signal.len(), other.len(), "signals are compared sample by sample");
    let noise: f64 = signal.iter().zip(other).map(|(x, y)| (x - y).powi(2)).sum();
    let power: f64 = signal.iter().map(|x| x * x).sum();
    if noise == 0.0 { f64::INFINITY } else { 10.0 * (power / noise).log10() }
}
