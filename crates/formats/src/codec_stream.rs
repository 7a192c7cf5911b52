//! Bit streams of the texture codec: a header, then blocks of eight frames, each block with a checksum.
//!
//! # Layout
//!
//! Numbers are little-endian. The header has 24 bytes:
//!
//! - the magic bytes `SHGC`, the version 1, and a zero byte;
//! - the bit rate in bit/s (`u16`) and the number of samples at 2 kHz (`u32`);
//! - the root mean square and the peak magnitude of the signal in m/s² (`f32` each);
//! - the CRC-32 (ISO-HDLC) of these 20 bytes, at the same place in every version.
//!
//! Eight frames of 35 to 63 bits fill 35 to 63 whole bytes. A block consists of these bytes and the CRC-16 (IBM-3740)
//! of the block number (`u32`, from zero) and the bytes. The last block holds the remaining frames, padded with zero
//! bits to a whole byte.
//!
//! A damaged block loses 160 ms, which the decoder conceals. A truncated stream yields a shorter signal.

use crc::{CRC_16_IBM_3740, CRC_32_ISO_HDLC, Crc};
use shagreen_core::signals::codec::FRAME_SAMPLES;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::frame::{BitReader, BitWriter, Frame};
use shagreen_core::words::counted;

use crate::imported::Imported;

const MAGIC: &[u8; 4] = b"SHGC";
const VERSION: u8 = 1;
const HEADER_BYTES: usize = 24;
/// Header bytes that its checksum covers.
const CHECKED_BYTES: usize = 20;
/// Frames per block: eight, so that frames of any size fill whole bytes.
const BLOCK_FRAMES: usize = 8;
/// Bytes of a block checksum.
const CHECK_BYTES: usize = 2;
const HEADER_CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);
const BLOCK_CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// Why bytes are not a codec stream.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodecStreamError {
    /// The bytes have another format.
    #[error("the file is not a texture codec stream; use a file written by \"shagreen codec encode\"")]
    NotStream,
    /// The stream has an unsupported version.
    #[error(
        "the codec stream has version {found}, but this program reads version {VERSION}; use a newer version of Shagreen"
    )]
    Version {
        /// The version found.
        found: u8,
    },
    /// The header is truncated or damaged.
    #[error(
        "the header of the codec stream is damaged, so the stream cannot be decoded; get a new copy of the file"
    )]
    Header,
    /// An intact header with an impossible value.
    #[error("the header of the codec stream states {what}; encode the signal again")]
    Nonsense {
        /// The impossible value.
        what: String,
    },
    /// The signal has more samples than the header can count.
    #[error(
        "the signal has {n_samples} samples, too many for a codec stream; encode {} or fewer at once",
        u32::MAX
    )]
    TooLong {
        /// Samples of the signal.
        n_samples: usize,
    },
}

/// Returns whether bytes begin with the magic bytes of a stream, of any version.
pub fn is_stream(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Serializes coded frames. A lost frame is written as zeros, and its block gets an invalid checksum, so the whole
/// block stays lost.
///
/// # Errors
/// [`CodecStreamError::TooLong`].
pub fn write_stream(coded: &Coded) -> Result<Vec<u8>, CodecStreamError> {
    let n_samples = coded.n_samples;
    let n = u32::try_from(n_samples).map_err(|_| CodecStreamError::TooLong { n_samples })?;
    let mut bytes = MAGIC.to_vec();
    bytes.extend([VERSION, 0]);
    // The highest bit rate is 3150 bit/s, which fits `u16`.
    bytes.extend((coded.rate.bits_per_sec() as u16).to_le_bytes());
    bytes.extend(n.to_le_bytes());
    bytes.extend((coded.scale_mps2 as f32).to_le_bytes());
    // Rounding to `f32` must not lower the limit.
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

/// Reads a codec stream up to its end or truncation.
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
        .ok_or_else(|| nonsense(format!("{bits_per_sec} bit/s, which is not a bit rate of the codec")))?;
    let (n_samples, scale, limit) = (word(8) as usize, f32::from_bits(word(12)), f32::from_bits(word(16)));
    if !(scale.is_finite() && scale > 0.0) {
        return Err(nonsense(format!("a root mean square of {scale} m/s²")));
    }
    if !(limit.is_finite() && limit >= 0.0) {
        return Err(nonsense(format!("a peak magnitude of {limit} m/s²")));
    }
    let n_frames = n_samples.div_ceil(FRAME_SAMPLES);
    let (frames, warnings) = read_blocks(body, rate, n_frames);
    let n_samples = n_samples.min(frames.len() * FRAME_SAMPLES);
    let (scale_mps2, limit_mps2) = (f64::from(scale), f64::from(limit));
    Ok(Imported { value: Coded { rate, n_samples, scale_mps2, limit_mps2, frames }, warnings })
}

/// Reads up to `n_frames` frames; also returns warnings.
fn read_blocks(mut body: &[u8], rate: Bitrate, n_frames: usize) -> (Vec<Option<Frame>>, Vec<String>) {
    let mut frames = Vec::new();
    let mut n_damaged = 0;
    let mut warnings = Vec::new();
    for index in 0.. {
        let n_left = n_frames - frames.len();
        if n_left == 0 {
            if !body.is_empty() {
                warnings.push(format!("{} bytes after the end of the stream are ignored", body.len()));
            }
            break;
        }
        let n_block = n_left.min(BLOCK_FRAMES);
        let n_bytes = (n_block * rate.allocation().n_bits() as usize).div_ceil(8);
        let Some((block, rest)) = body.split_at_checked(n_bytes + CHECK_BYTES) else {
            warnings.push(format!("the stream is truncated: it holds {} of {n_frames} frames", frames.len()));
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
        let pieces = counted(n_damaged, "block");
        warnings.push(format!("the stream is damaged: {pieces} of up to 160 ms will be concealed"));
    }
    (frames, warnings)
}

/// Checksum of a block, which includes its number.
fn checksum(index: usize, body: &[u8]) -> u16 {
    let mut digest = BLOCK_CRC.digest();
    digest.update(&(index as u32).to_le_bytes());
    digest.update(body);
    digest.finalize()
}

#[cfg(test)]
mod tests;
