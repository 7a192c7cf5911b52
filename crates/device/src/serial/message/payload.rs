//! Reader and writer for the little-endian numbers of a payload.

use super::{Malformed, SampleBytes};
use crate::serial::frame::MAX_PAYLOAD;

/// Unread rest of a payload.
pub(super) struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    pub(super) fn new(payload: &'a [u8]) -> Self {
        Self(payload)
    }

    pub(super) fn take(&mut self, n: usize) -> Result<&'a [u8], Malformed> {
        let (taken, left) = self.0.split_at_checked(n).ok_or(Malformed)?;
        self.0 = left;
        Ok(taken)
    }

    pub(super) fn u8(&mut self) -> Result<u8, Malformed> {
        Ok(self.take(1)?[0])
    }

    pub(super) fn u16(&mut self) -> Result<u16, Malformed> {
        let bytes = self.take(2)?;
        Ok(u16::from_le_bytes([bytes[0], bytes[1]]))
    }

    pub(super) fn u32(&mut self) -> Result<u32, Malformed> {
        Ok(u32::from(self.u16()?) | u32::from(self.u16()?) << 16)
    }

    /// Reads all remaining bytes as 1 to `most` samples.
    pub(super) fn samples(&mut self, most: usize) -> Result<SampleBytes<'a>, Malformed> {
        let bytes = core::mem::take(&mut self.0);
        let is_whole = bytes.len().is_multiple_of(2) && (1..=most).contains(&(bytes.len() / 2));
        if is_whole { Ok(SampleBytes(bytes)) } else { Err(Malformed) }
    }

    /// Reads all remaining bytes, up to `most`.
    pub(super) fn text(&mut self, most: usize) -> &'a [u8] {
        let bytes = core::mem::take(&mut self.0);
        &bytes[..bytes.len().min(most)]
    }
}

/// Writer of a payload. Excess bytes are dropped; no message is that long.
pub(super) struct Writer {
    bytes: [u8; MAX_PAYLOAD],
    len: usize,
}

impl Writer {
    pub(super) fn new() -> Self {
        Self { bytes: [0; MAX_PAYLOAD], len: 0 }
    }

    pub(super) fn payload(&self) -> &[u8] {
        &self.bytes[..self.len]
    }

    pub(super) fn u8(&mut self, byte: u8) {
        if let Some(place) = self.bytes.get_mut(self.len) {
            *place = byte;
            self.len += 1;
        }
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.u8(byte);
        }
    }

    pub(super) fn u16(&mut self, number: u16) {
        self.bytes(&number.to_le_bytes());
    }

    pub(super) fn u32(&mut self, number: u32) {
        self.bytes(&number.to_le_bytes());
    }

    pub(super) fn samples(&mut self, samples: &[i16]) {
        for sample in samples {
            self.bytes(&sample.to_le_bytes());
        }
    }
}
