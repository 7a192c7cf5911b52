//! A frame as numbers, and as bits.

use super::bitrate::{Allocation, Bitrate};
use super::{LAG_BELOW, LAGS, N_LAGS_SECOND, N_SPLITS};

/// What one frame says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frame {
    /// The entry of each part of the line spectral frequencies.
    pub lsf: [u16; N_SPLITS],
    /// Both halves.
    pub halves: [Half; 2],
}

/// What excites half a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Half {
    /// The lag, counted from the shortest that may stand here.
    pub lag: u16,
    /// The entry of the pair of gains.
    pub gain: u16,
    /// The fixed code.
    pub code: u16,
}

/// The lags in samples that a half can say: first and last. The second half says its lag relative to the first's.
pub(super) fn lags(first: Option<usize>) -> (usize, usize) {
    match first {
        None => LAGS,
        Some(first) => {
            let low = first.saturating_sub(LAG_BELOW).max(LAGS.0);
            (low, (low + N_LAGS_SECOND - 1).min(LAGS.1))
        }
    }
}

impl Frame {
    /// The lags of both halves in samples. A lag that no encoder says is taken for the longest.
    pub(super) fn lags(&self) -> [usize; 2] {
        let of = |half: &Half, (low, high): (usize, usize)| (low + half.lag as usize).min(high);
        let first = of(&self.halves[0], lags(None));
        [first, of(&self.halves[1], lags(Some(first)))]
    }

    /// Adds the bits of the frame to a stream.
    pub fn pack(&self, rate: Bitrate, bits: &mut BitWriter) {
        for (value, n_bits) in self.fields(&rate.allocation()) {
            bits.put(value, n_bits);
        }
    }

    /// The next frame of a stream; `None` where fewer bits are left than it has.
    pub fn unpack(rate: Bitrate, bits: &mut BitReader<'_>) -> Option<Self> {
        let allocation = rate.allocation();
        if bits.n_left() < allocation.n_bits() as usize {
            return None;
        }
        let mut take = |n_bits: u32| bits.take(n_bits);
        let mut frame = Self { lsf: allocation.lsf.map(&mut take), ..Self::default() };
        for (half, n_lag) in frame.halves.iter_mut().zip(allocation.lag) {
            (half.lag, half.gain, half.code) = (take(n_lag), take(allocation.gain), take(allocation.code));
        }
        Some(frame)
    }

    /// Values and their bits, in the order of the stream.
    fn fields(&self, allocation: &Allocation) -> impl Iterator<Item = (u16, u32)> {
        let Allocation { lsf, lag, gain, code } = *allocation;
        let halves = self
            .halves
            .into_iter()
            .zip(lag)
            .flat_map(move |(half, n_lag)| [(half.lag, n_lag), (half.gain, gain), (half.code, code)]);
        self.lsf.into_iter().zip(lsf).chain(halves)
    }
}

/// Bits one after the other, the highest of each value first.
#[derive(Clone, Debug, Default)]
pub struct BitWriter {
    bytes: Vec<u8>,
    n_bits: usize,
}

impl BitWriter {
    /// Bits so far.
    pub fn n_bits(&self) -> usize {
        self.n_bits
    }

    /// All of them, the last byte filled up with zeros.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    fn put(&mut self, value: u16, n_bits: u32) {
        for i in (0..n_bits).rev() {
            if self.n_bits.is_multiple_of(8) {
                self.bytes.push(0);
            }
            let bit = (value >> i & 1) as u8;
            if let Some(last) = self.bytes.last_mut() {
                *last |= bit << (7 - self.n_bits % 8);
            }
            self.n_bits += 1;
        }
    }
}

/// Reads what [`BitWriter`] wrote.
#[derive(Clone, Debug)]
pub struct BitReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> BitReader<'a> {
    /// A reader at the first bit.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bits that are left.
    pub fn n_left(&self) -> usize {
        8 * self.bytes.len() - self.at
    }

    /// The next bits as a number; zeros where there are none.
    fn take(&mut self, n_bits: u32) -> u16 {
        let mut value = 0;
        for _ in 0..n_bits {
            let byte = self.bytes.get(self.at / 8).copied().unwrap_or(0);
            value = value << 1 | u16::from(byte >> (7 - self.at % 8) & 1);
            self.at += 1;
        }
        value
    }
}
