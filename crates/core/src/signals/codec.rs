//! CELP (code-excited linear prediction) codec for texture signals at 1.75 to 3.15 kbit/s.
//!
//! Signals at 2 kHz are split into frames of 20 ms. A frame holds the spectral envelope: ten line spectral frequencies
//! (LSF), quantized in three parts relative to their mean (split VQ). Each half of a frame, a subframe, holds its
//! excitation: the lag of past excitation in samples (adaptive codebook), an entry of the fixed codebook, and the gains
//! of both. The encoder searches by analysis by synthesis (closed loop). It keeps the candidate with the smallest
//! error after the weighting filter `A(z/0.94)/A(z/0.6)`, which lets errors hide under the resonances of the texture.
//!
//! The encoder looks 15 ms ahead of a frame; the total delay is [`DELAY_SAMPLES`]. Frames have a fixed number of bits
//! ([`bitrate::Allocation`]); [`frame::Frame`] packs them.

pub mod bitrate;
pub mod books;
mod code_search;
pub mod coded;
pub mod corpus;
pub mod decoder;
pub mod encoder;
pub mod frame;
mod spectrum;
mod synthesis;
#[cfg(test)]
mod tests;
pub mod train;

use crate::units::Hertz;

/// Sampling rate.
pub const CODEC_RATE: Hertz = Hertz(2000.0);
/// Samples per frame: 20 ms.
pub const FRAME_SAMPLES: usize = 40;
/// Frames per second.
pub const FRAMES_PER_SEC: u32 = 50;
/// Look-ahead of the encoder beyond a frame, in samples: 15 ms.
pub const LOOK_AHEAD_SAMPLES: usize = 30;
/// Delay from input to decoded output, in samples: one frame plus the look-ahead, 35 ms.
pub const DELAY_SAMPLES: usize = FRAME_SAMPLES + LOOK_AHEAD_SAMPLES;

/// Samples per subframe.
const HALF_SAMPLES: usize = FRAME_SAMPLES / 2;
/// Number of line spectral frequencies.
const ORDER: usize = 10;
/// Number of parts of the split VQ, and the index range of each part.
const N_SPLITS: usize = 3;
const SPLITS: [(usize, usize); N_SPLITS] = [(0, 3), (3, 6), (6, ORDER)];
/// Shortest and longest lag of the adaptive codebook, in samples.
const LAGS: (usize, usize) = (20, 147);
/// Lags of the second subframe: how far they start below the lag of the first, and how many there are.
const LAG_BELOW: usize = 16;
const N_LAGS_SECOND: usize = 32;
/// Size of the fixed codebook, and the seed of its noise.
const N_CODES_MOST: usize = 4096;
const CODES_SEED: u64 = 20_240;

/// Energy below which a signal counts as silent.
const NOTHING: f64 = 1e-12;

/// Returns the index of the smallest number; 0 if there are none.
fn least(numbers: impl Iterator<Item = f64>) -> usize {
    numbers.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}
