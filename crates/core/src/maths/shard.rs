//! Parts of a list of work that is divided among several computers.

use std::fmt;
use std::str::FromStr;

/// Largest number of parts.
pub const MAX_SHARDS: usize = 10_000;

/// One part of a list, such as the second of four. It takes every fourth entry, so that neighboring entries, which often take
/// equally long, lie in different parts. All parts together have every entry once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From zero.
    index: usize,
    of: usize,
}

/// Why a text or numbers are not a part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ShardError {
    /// Not two whole numbers with a slash between them.
    #[error("write the number of the part and the number of parts, as in 1/4")]
    Form,
    /// The numbers do not fit each other.
    #[error("part {number} of {of} does not exist; use 1/{of} to {of}/{of}, with at most {MAX_SHARDS} parts")]
    Range {
        /// Number of the part, from one.
        number: usize,
        /// Number of parts.
        of: usize,
    },
}

impl Shard {
    /// The only part: the whole list.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// Part `number`, from one, of `of` parts.
    ///
    /// # Errors
    /// [`ShardError::Range`].
    pub fn new(number: usize, of: usize) -> Result<Self, ShardError> {
        match number.checked_sub(1) {
            Some(index) if index < of && of <= MAX_SHARDS => Ok(Self { index, of }),
            _ => Err(ShardError::Range { number, of }),
        }
    }

    /// Whether the entry with this index belongs to the part.
    pub fn takes(self, index: usize) -> bool {
        index % self.of == self.index
    }

    /// Indices of the entries of the part, in a list of this length.
    pub fn indices(self, n: usize) -> impl Iterator<Item = usize> {
        (self.index..n).step_by(self.of)
    }

    /// Number of the part, from one.
    pub fn number(self) -> usize {
        self.index + 1
    }

    /// Number of parts.
    pub fn of(self) -> usize {
        self.of
    }

    /// Whether there is only this part.
    pub fn is_whole(self) -> bool {
        self.of == 1
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (number, of) = text.split_once('/').ok_or(ShardError::Form)?;
        let whole = |text: &str| text.trim().parse().map_err(|_| ShardError::Form);
        Self::new(whole(number)?, whole(of)?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number(), self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::{MAX_SHARDS, Shard, ShardError};

    #[test]
    fn the_parts_are_the_whole() {
        for n in [0, 1, 7, 100] {
            for of in [1, 2, 3, 9] {
                let mut all: Vec<usize> =
                    (1..=of).flat_map(|number| Shard::new(number, of).unwrap().indices(n)).collect();
                all.sort_unstable();
                assert_eq!(all, (0..n).collect::<Vec<_>>(), "{n} in {of}");
            }
        }
        let second = Shard::new(2, 3).unwrap();
        assert!((0..20).all(|i| second.takes(i) == second.indices(20).any(|taken| taken == i)));
        assert!(Shard::WHOLE.is_whole() && !second.is_whole());
    }

    #[test]
    fn a_part_is_two_numbers() {
        assert_eq!(" 2/4".parse(), Shard::new(2, 4));
        assert_eq!(Shard::new(2, 4).unwrap().to_string(), "2/4");
        for text in ["", "2", "a/4", "2/", "-1/4", "1/4/4"] {
            assert_eq!(text.parse::<Shard>(), Err(ShardError::Form), "{text:?}");
        }
        for (number, of) in [(0, 4), (5, 4), (1, 0), (1, MAX_SHARDS + 1)] {
            assert_eq!(Shard::new(number, of), Err(ShardError::Range { number, of }));
        }
    }
}
