//! A codec for texture signals at 1.75 to 3.15 kbit/s: code-excited linear prediction.
//!
//! Signals at 2 kHz are cut into frames of 20 ms. A frame says its spectrum (ten line spectral frequencies, quantized in
//! three parts about their mean), and for each of its halves what excites it: a stretch of the excitation before (its lag
//! in samples), one of many fixed codes, and the gains of both. The encoder tries what the decoder would do, and keeps what
//! sounds nearest once errors are weighted by `A(z/0.94)/A(z/0.6)`, so that they hide under the resonances of the texture.
//!
//! The encoder looks 15 ms beyond a frame: what is decoded is [`DELAY_SAMPLES`] late. Frames have a fixed number of bits
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

/// Samples a second.
pub const CODEC_RATE: Hertz = Hertz(2000.0);
/// Samples of a frame: 20 ms.
pub const FRAME_SAMPLES: usize = 40;
/// Frames a second.
pub const FRAMES_PER_SEC: u32 = 50;
/// Samples that the encoder looks beyond a frame: 15 ms.
pub const LOOK_AHEAD_SAMPLES: usize = 30;
/// From a sample that goes in to the same sample that comes out: a frame and what is looked ahead, 35 ms.
pub const DELAY_SAMPLES: usize = FRAME_SAMPLES + LOOK_AHEAD_SAMPLES;

/// Samples of half a frame.
const HALF_SAMPLES: usize = FRAME_SAMPLES / 2;
/// Line spectral frequencies.
const ORDER: usize = 10;
/// Parts in which they are quantized, and where each begins and ends.
const N_SPLITS: usize = 3;
const SPLITS: [(usize, usize); N_SPLITS] = [(0, 3), (3, 6), (6, ORDER)];
/// Shortest and longest lag in samples.
const LAGS: (usize, usize) = (20, 147);
/// How far the lag of the second half may lie below that of the first, and how many lags there are from there.
const LAG_BELOW: usize = 16;
const N_LAGS_SECOND: usize = 32;
/// Most fixed codes, and the seed of their noise.
const N_CODES_MOST: usize = 4096;
const CODES_SEED: u64 = 20_240;

/// Energy below which there is nothing to match.
const NOTHING: f64 = 1e-12;

/// The index of the least of some numbers; 0 of none.
fn least(numbers: impl Iterator<Item = f64>) -> usize {
    numbers.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}
