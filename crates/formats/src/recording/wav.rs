//! Samples of WAV files.
//!
//! This reader exists because no library in use reads what recorders write. `hound`, which writes our files, rejects
//! 64-bit floats, sizes that a recorder never filled in, and truncated files.

use crate::recording::RecordingFileError;

/// Maximum number of channels.
const MAX_CHANNELS: usize = 64;
/// Size field that was never filled in.
const UNKNOWN_SIZE: u64 = 0xffff_ffff;
const PCM: u16 = 1;
const FLOAT: u16 = 3;
const EXTENSIBLE: u16 = 0xfffe;

/// Samples of a WAV file.
#[derive(Debug)]
pub(super) struct WavSamples {
    /// Sample rate in Hz.
    pub(super) rate_hz: u32,
    /// One column per channel; integers are scaled to -1..1.
    pub(super) channels: Vec<Vec<f64>>,
    /// Whether the samples are floats, which may be in any unit.
    pub(super) float: bool,
    /// Sentences for the user.
    pub(super) warnings: Vec<String>,
}

struct Format {
    float: bool,
    n_channels: usize,
    rate_hz: u32,
    bytes_a_sample: usize,
}

/// Returns whether bytes begin with a WAV header.
pub(super) fn is_wav(bytes: &[u8]) -> bool {
    matches!(bytes.get(..4), Some(b"RIFF" | b"RF64" | b"BW64")) && bytes.get(8..12) == Some(b"WAVE")
}

/// Number of channels that the header of a WAV file states; 0 if it does not.
pub(super) fn n_channels(bytes: &[u8]) -> usize {
    let format = chunks(bytes).find(|chunk| chunk.name == b"fmt ");
    format.and_then(|chunk| u16_at(chunk.there(), 2)).map_or(0, usize::from).min(MAX_CHANNELS)
}

/// A chunk of a WAV file.
struct Chunk<'a> {
    name: &'a [u8],
    /// Stated number of bytes.
    stated: u64,
    /// All bytes after its header.
    rest: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// The stated bytes, as far as they exist.
    fn there(&self) -> &'a [u8] {
        &self.rest[..self.rest.len().min(usize::try_from(self.stated).unwrap_or(usize::MAX))]
    }
}

fn chunks(bytes: &[u8]) -> impl Iterator<Item = Chunk<'_>> {
    let mut bytes = bytes.get(12..).unwrap_or(&[]);
    std::iter::from_fn(move || {
        let (head, rest) = bytes.split_at_checked(8)?;
        let chunk = Chunk { name: &head[..4], stated: u64::from(u32_at(head, 4)?), rest };
        // Chunks are aligned to even offsets.
        bytes = rest.get(chunk.there().len().next_multiple_of(2)..).unwrap_or(&[]);
        Some(chunk)
    })
}

fn error(problem: impl Into<String>) -> RecordingFileError {
    RecordingFileError::Wav { problem: problem.into() }
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    bytes.get(at..at + 2)?.try_into().ok().map(u16::from_le_bytes)
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes)
}

/// Reads a WAV file: integers of 8 to 32 bits, floats of 32 or 64 bits, chunks in any order.
pub(super) fn read_wav(bytes: &[u8]) -> Result<WavSamples, RecordingFileError> {
    let mut format = None;
    let mut data_size_64 = None;
    for chunk in chunks(bytes) {
        let there = chunk.there();
        match chunk.name {
            b"fmt " => format = Some(read_format(there)?),
            b"ds64" => {
                let size = there.get(8..16).and_then(|part| part.try_into().ok());
                data_size_64 = size.map(u64::from_le_bytes);
            }
            b"data" => {
                let Chunk { stated, rest, .. } = chunk;
                let format = format.ok_or_else(|| error("has samples before its format chunk"))?;
                let stated =
                    if stated == UNKNOWN_SIZE { data_size_64.unwrap_or(UNKNOWN_SIZE) } else { stated };
                // A recorder that was switched off wrote no size; all remaining bytes are samples.
                let open = stated == UNKNOWN_SIZE || (stated == 0 && !rest.is_empty() && is_open(bytes));
                let n_bytes = if open { rest.len() as u64 } else { stated.min(rest.len() as u64) };
                let mut samples = read_samples(&rest[..n_bytes as usize], &format);
                if open {
                    samples
                        .warnings
                        .push("the file does not state its length; it is read to its end".to_owned());
                } else if n_bytes < stated {
                    samples.warnings.push(format!(
                        "the file is truncated: it states {stated} bytes of samples but holds {n_bytes}"
                    ));
                }
                if samples.channels[0].is_empty() {
                    return Err(error("has no samples"));
                }
                return Ok(samples);
            }
            _ => {}
        }
    }
    Err(error(if format.is_some() { "has no samples" } else { "has no valid format chunk" }))
}

/// Returns whether the size of the whole file was never filled in.
fn is_open(bytes: &[u8]) -> bool {
    matches!(u32_at(bytes, 4), Some(0 | u32::MAX))
}

fn read_format(body: &[u8]) -> Result<Format, RecordingFileError> {
    let short = || error("has no valid format chunk");
    let mut tag = u16_at(body, 0).ok_or_else(short)?;
    let n_channels = usize::from(u16_at(body, 2).ok_or_else(short)?);
    let rate_hz = u32_at(body, 4).ok_or_else(short)?;
    let block = usize::from(u16_at(body, 12).ok_or_else(short)?);
    let bits = u16_at(body, 14).ok_or_else(short)?;
    if tag == EXTENSIBLE {
        tag = u16_at(body, 24).ok_or_else(short)?;
    }
    if !(1..=MAX_CHANNELS).contains(&n_channels) {
        return Err(error(format!("has {n_channels} channels, but 1 to {MAX_CHANNELS} are supported")));
    }
    let bytes_a_sample = if block > 0 && block.is_multiple_of(n_channels) {
        block / n_channels
    } else {
        usize::from(bits.div_ceil(8))
    };
    let float = match (tag, bytes_a_sample) {
        (PCM, 1..=4) => false,
        (FLOAT, 4 | 8) => true,
        (PCM | FLOAT, n) => return Err(error(format!("has samples of {n} bytes, which are not supported"))),
        (other, _) => return Err(error(format!("is compressed (format {other})"))),
    };
    Ok(Format { float, n_channels, rate_hz, bytes_a_sample })
}

fn read_samples(data: &[u8], format: &Format) -> WavSamples {
    let frame = format.n_channels * format.bytes_a_sample;
    let mut channels = vec![Vec::with_capacity(data.len() / frame); format.n_channels];
    for frame in data.chunks_exact(frame) {
        for (channel, bytes) in channels.iter_mut().zip(frame.chunks_exact(format.bytes_a_sample)) {
            channel.push(sample(bytes, format.float));
        }
    }
    WavSamples { rate_hz: format.rate_hz, channels, float: format.float, warnings: Vec::new() }
}

/// Converts one sample. An integer fills its bytes from the most significant bit, whatever its number of valid bits.
fn sample(bytes: &[u8], float: bool) -> f64 {
    const INTEGER: f64 = 2_147_483_648.0;
    match (bytes, float) {
        ([a, b, c, d], true) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
        ([a, b, c, d, e, f, g, h], true) => f64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]),
        ([a], _) => (f64::from(*a) - 128.0) / 128.0,
        ([a, b], _) => f64::from(i32::from_le_bytes([0, 0, *a, *b])) / INTEGER,
        ([a, b, c], _) => f64::from(i32::from_le_bytes([0, *a, *b, *c])) / INTEGER,
        ([a, b, c, d], _) => f64::from(i32::from_le_bytes([*a, *b, *c, *d])) / INTEGER,
        // The format check excludes other sizes.
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests;
