//! Frame parameters and their bit packing.

use super::bitrate::{Allocation, Bitrate};
use super::{LAG_BELOW, LAGS, N_LAGS_SECOND, N_SPLITS};

/// Parameters of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frame {
    /// VQ index of each part of the line spectral frequencies.
    pub lsf: [u16; N_SPLITS],
    /// Both subframes.
    pub halves: [Half; 2],
}

/// Excitation parameters of a subframe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Half {
    /// Adaptive-codebook (pitch) lag, in samples above the shortest allowed lag of this subframe.
    pub lag: u16,
    /// Index of the gain pair.
    pub gain: u16,
    /// Index in the fixed codebook.
    pub code: u16,
}

/// Returns the shortest and longest lag, in samples, that a subframe can code.
///
/// `first` is the lag of the first subframe, or `None` for the first subframe itself. The range of the second subframe is
/// placed around it.
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
    /// Returns the lags of both subframes in samples. Out-of-range lags are clamped to the longest lag.
    pub(super) fn lags(&self) -> [usize; 2] {
        let of = |half: &Half, (low, high): (usize, usize)| (low + half.lag as usize).min(high);
        let first = of(&self.halves[0], lags(None));
        [first, of(&self.halves[1], lags(Some(first)))]
    }

    /// Appends the bits of the frame to a stream.
    pub fn pack(&self, rate: Bitrate, bits: &mut BitWriter) {
        for (value, n_bits) in self.fields(&rate.allocation()) {
            bits.put(value, n_bits);
        }
    }

    /// Returns the next frame of a stream; `None` if too few bits remain.
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

    /// Returns values and their bit counts, in stream order.
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

/// Bit-stream writer, most significant bit first.
#[derive(Clone, Debug, Default)]
pub struct BitWriter {
    bytes: Vec<u8>,
    n_bits: usize,
}

impl BitWriter {
    /// Returns the number of bits written.
    pub fn n_bits(&self) -> usize {
        self.n_bits
    }

    /// Returns all bits; the last byte is padded with zeros.
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

/// Bit-stream reader for data from [`BitWriter`].
#[derive(Clone, Debug)]
pub struct BitReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> BitReader<'a> {
    /// Returns a reader at the first bit.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Returns the number of remaining bits.
    pub fn n_left(&self) -> usize {
        8 * self.bytes.len() - self.at
    }

    /// Returns the next bits as a number; missing bits read as zeros.
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
