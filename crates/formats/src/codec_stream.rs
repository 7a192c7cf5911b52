//! Streams of the texture codec: a header, then blocks of eight frames, each with a checksum.
//!
//! # Layout
//!
//! Numbers are little-endian. The header has 24 bytes: `SHGC`; the version, 1; a zero; bits a second (`u16`); samples of the
//! signal (`u32`, at 2 kHz); the root mean square of the signal and its highest magnitude in m/s² (`f32` each); CRC-32 (ISO-HDLC)
//! of these 20 bytes, which every version has there. Eight frames of 35 to 63 bits are 35 to 63 whole bytes: a block is these, then CRC-16 (IBM-3740) of its number
//! (`u32`, from zero) and its bytes. The last block has the frames that are left, filled up with zero bits to a byte.
//!
//! What is damaged costs its block, 160 ms, which a decoder fills in; what is cut off ends the signal earlier.

use crc::{CRC_16_IBM_3740, CRC_32_ISO_HDLC, Crc};
use shagreen_core::codec::FRAME_SAMPLES;
use shagreen_core::codec::bitrate::Bitrate;
use shagreen_core::codec::coded::Coded;
use shagreen_core::codec::frame::{BitReader, BitWriter, Frame};
use shagreen_core::words::counted;

use crate::imported::Imported;

const MAGIC: &[u8; 4] = b"SHGC";
const VERSION: u8 = 1;
const HEADER_BYTES: usize = 24;
/// Bytes of the header that its checksum is of.
const CHECKED_BYTES: usize = 20;
/// Frames of a block: as many as a byte has bits, so that any frame makes whole bytes.
const BLOCK_FRAMES: usize = 8;
/// Bytes of the checksum of a block.
const CHECK_BYTES: usize = 2;
const HEADER_CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);
const BLOCK_CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// Why bytes are no stream.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodecStreamError {
    /// Something else.
    #[error("this is no stream of the texture codec; give a file that \"shagreen codec encode\" wrote")]
    NotStream,
    /// A stream of a later program.
    #[error("the stream has version {found}, this program reads version {VERSION}; install a newer one")]
    Version {
        /// The version found.
        found: u8,
    },
    /// The header is cut off, or not as it was written.
    #[error("the head of the stream is damaged, and nothing can be told without it; get the file anew")]
    Header,
    /// A header as it was written by a program that says what cannot be.
    #[error("the stream says {what}; get it from another program")]
    Nonsense {
        /// What it says.
        what: String,
    },
    /// More samples than a stream can count.
    #[error("{n_samples} samples do not fit a stream; encode {} or fewer at once", u32::MAX)]
    TooLong {
        /// Samples of the signal.
        n_samples: usize,
    },
}

/// Whether bytes begin as a stream does, of whatever version.
pub fn is_stream(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// The bytes of a stream. A frame that was lost is written as zeros whose checksum is wrong, so that it stays lost, with its
/// block.
///
/// # Errors
/// [`CodecStreamError::TooLong`].
pub fn write_stream(coded: &Coded) -> Result<Vec<u8>, CodecStreamError> {
    let n_samples = coded.n_samples;
    let n = u32::try_from(n_samples).map_err(|_| CodecStreamError::TooLong { n_samples })?;
    let mut bytes = MAGIC.to_vec();
    bytes.extend([VERSION, 0]);
    // The highest rate is 3150.
    bytes.extend((coded.rate.bits_per_sec() as u16).to_le_bytes());
    bytes.extend(n.to_le_bytes());
    bytes.extend((coded.scale_mps2 as f32).to_le_bytes());
    // Rounding may not lower it.
    let limit = coded.limit_mps2 as f32;
    let limit = if f64::from(limit) < coded.limit_mps2 { limit.next_up() } else { limit };
    bytes.extend(limit.to_le_bytes());
    bytes.extend(HEADER_CRC.checksum(&bytes).to_le_bytes());
    for (index, block) in coded.frames.chunks(BLOCK_FRAMES).enumerate() {
        let mut bits = BitWriter::default();
        for frame in block {
            frame.unwrap_or_default().pack(coded.rate, &mut bits);
        }
        let body = bits.into_bytes();
        let check = checksum(index, &body);
        bytes.extend(body);
        let is_whole = block.iter().all(Option::is_some);
        bytes.extend(if is_whole { check } else { !check }.to_le_bytes());
    }
    Ok(bytes)
}

/// Reads a stream as far as it goes.
///
/// # Errors
/// See [`CodecStreamError`].
pub fn read_stream(bytes: &[u8]) -> Result<Imported<Coded>, CodecStreamError> {
    if !is_stream(bytes) {
        return Err(CodecStreamError::NotStream);
    }
    let found = *bytes.get(MAGIC.len()).ok_or(CodecStreamError::Header)?;
    let (head, body) = bytes.split_at_checked(HEADER_BYTES).ok_or(CodecStreamError::Header)?;
    let (checked, check) = head.split_at(CHECKED_BYTES);
    if HEADER_CRC.checksum(checked).to_le_bytes() != check {
        return Err(CodecStreamError::Header);
    }
    if found != VERSION {
        return Err(CodecStreamError::Version { found });
    }
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let bits_per_sec = u32::from(u16::from_le_bytes([head[6], head[7]]));
    let nonsense = |what: String| CodecStreamError::Nonsense { what };
    let rate = Bitrate::from_bits_per_sec(bits_per_sec)
        .ok_or_else(|| nonsense(format!("{bits_per_sec} bits a second, which no rate of the codec has")))?;
    let (n_samples, scale, limit) = (word(8) as usize, f32::from_bits(word(12)), f32::from_bits(word(16)));
    if !(scale.is_finite() && scale > 0.0) {
        return Err(nonsense(format!("a root mean square of {scale} m/s²")));
    }
    if !(limit.is_finite() && limit >= 0.0) {
        return Err(nonsense(format!("a highest magnitude of {limit} m/s²")));
    }
    let n_frames = n_samples.div_ceil(FRAME_SAMPLES);
    let (frames, warnings) = read_blocks(body, rate, n_frames);
    let n_samples = n_samples.min(frames.len() * FRAME_SAMPLES);
    let (scale_mps2, limit_mps2) = (f64::from(scale), f64::from(limit));
    Ok(Imported { value: Coded { rate, n_samples, scale_mps2, limit_mps2, frames }, warnings })
}

/// The frames that there are, at most so many, and what is odd about them.
fn read_blocks(mut body: &[u8], rate: Bitrate, n_frames: usize) -> (Vec<Option<Frame>>, Vec<String>) {
    let mut frames = Vec::new();
    let mut n_damaged = 0;
    let mut warnings = Vec::new();
    for index in 0.. {
        let n_left = n_frames - frames.len();
        if n_left == 0 {
            if !body.is_empty() {
                warnings.push(format!("{} bytes follow the stream and were left", body.len()));
            }
            break;
        }
        let n_block = n_left.min(BLOCK_FRAMES);
        let n_bytes = (n_block * rate.allocation().n_bits() as usize).div_ceil(8);
        let Some((block, rest)) = body.split_at_checked(n_bytes + CHECK_BYTES) else {
            warnings.push(format!("the stream is cut off: {} of {n_frames} frames are there", frames.len()));
            break;
        };
        body = rest;
        let (block, check) = block.split_at(n_bytes);
        if checksum(index, block).to_le_bytes() == check {
            let mut bits = BitReader::new(block);
            frames.extend((0..n_block).map(|_| Frame::unpack(rate, &mut bits)));
        } else {
            n_damaged += 1;
            frames.extend(std::iter::repeat_n(None, n_block));
        }
    }
    if n_damaged > 0 {
        let pieces = counted(n_damaged, "piece");
        warnings.push(format!("the stream is damaged: {pieces} of up to 160 ms were filled in"));
    }
    (frames, warnings)
}

/// The checksum of a block, which tells its place too.
fn checksum(index: usize, body: &[u8]) -> u16 {
    let mut digest = BLOCK_CRC.digest();
    digest.update(&(index as u32).to_le_bytes());
    digest.update(body);
    digest.finalize()
}

#[cfg(test)]
mod tests;
