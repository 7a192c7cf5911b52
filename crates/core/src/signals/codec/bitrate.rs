//! The five bit rates and their bit allocations.

use crate::signals::codec::N_SPLITS;

/// Bit rate of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Bitrate {
    /// 1750 bit/s.
    Kbps1_75,
    /// 2150 bit/s.
    Kbps2_15,
    /// 2450 bit/s.
    Kbps2_45,
    /// 2750 bit/s.
    Kbps2_75,
    /// 3150 bit/s.
    Kbps3_15,
}

/// Bit allocation of one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Allocation {
    /// Bits for each part of the line spectral frequencies.
    pub lsf: [u32; N_SPLITS],
    /// Bits for the lag of each subframe.
    pub lag: [u32; 2],
    /// Bits for the gain pair of a subframe.
    pub gain: u32,
    /// Bits for the fixed codebook entry of a subframe.
    pub code: u32,
}

impl Bitrate {
    /// All bit rates, lowest first.
    pub const ALL: [Self; 5] =
        [Self::Kbps1_75, Self::Kbps2_15, Self::Kbps2_45, Self::Kbps2_75, Self::Kbps3_15];

    /// Returns the rate in bit/s.
    pub fn bits_per_sec(self) -> u32 {
        match self {
            Self::Kbps1_75 => 1750,
            Self::Kbps2_15 => 2150,
            Self::Kbps2_45 => 2450,
            Self::Kbps2_75 => 2750,
            Self::Kbps3_15 => 3150,
        }
    }

    /// Returns the rate in kbit/s.
    pub fn kbps(self) -> f64 {
        f64::from(self.bits_per_sec()) / 1e3
    }

    /// Returns the bit rate with this many bit/s, if there is one.
    pub fn from_bits_per_sec(bits_per_sec: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|rate| rate.bits_per_sec() == bits_per_sec)
    }

    /// Returns the bit allocation of a frame.
    pub fn allocation(self) -> Allocation {
        let allocation = |lsf, gain, code| Allocation { lsf, lag: [7, 5], gain, code };
        match self {
            Self::Kbps1_75 => allocation([4, 4, 3], 4, 2),
            Self::Kbps2_15 => allocation([5; 3], 4, 4),
            Self::Kbps2_45 => allocation([5; 3], 5, 6),
            Self::Kbps2_75 => allocation([5; 3], 5, 9),
            Self::Kbps3_15 => allocation([5; 3], 6, 12),
        }
    }
}

impl Allocation {
    /// Returns the total bits of a frame.
    pub fn n_bits(&self) -> u32 {
        self.lsf.iter().sum::<u32>() + self.lag.iter().sum::<u32>() + 2 * (self.gain + self.code)
    }

    /// Returns the size of the fixed codebook.
    pub fn n_codes(&self) -> usize {
        1 << self.code
    }
}

#[cfg(test)]
mod tests {
    use super::Bitrate;
    use crate::signals::codec::FRAMES_PER_SEC;

    #[test]
    fn bits_are_those_of_the_rate() {
        for rate in Bitrate::ALL {
            assert_eq!(rate.allocation().n_bits() * FRAMES_PER_SEC, rate.bits_per_sec());
            assert_eq!(Bitrate::from_bits_per_sec(rate.bits_per_sec()), Some(rate));
        }
        assert_eq!(Bitrate::from_bits_per_sec(2000), None);
    }
}
