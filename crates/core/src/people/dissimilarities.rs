//! Pairwise dissimilarities of a set of items: validated, symmetric, with missing pairs allowed.

/// Dissimilarities of all pairs of items: each is 0 or more, or missing if the pair was never compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Dissimilarities {
    n_items: usize,
    /// Upper triangle without the diagonal, row by row.
    condensed: Vec<Option<f64>>,
}

/// Reasons why numbers are not valid dissimilarities.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DissimilaritiesError {
    /// The number of dissimilarities does not match the number of pairs.
    #[error(
        "{n_items} items have {wanted} pairs, but {given} dissimilarities are given; give one for each pair"
    )]
    Count {
        /// Number of items.
        n_items: usize,
        /// Number of pairs of these items.
        wanted: usize,
        /// Number of dissimilarities given.
        given: usize,
    },
    /// The matrix is not square.
    #[error(
        "row {row} has {len} columns, but the matrix has {n_items} rows; a dissimilarity matrix must be square"
    )]
    NotSquare {
        /// Row index, from 0.
        row: usize,
        /// Number of rows of the matrix.
        n_items: usize,
        /// Number of columns of the row.
        len: usize,
    },
    /// A dissimilarity is not finite.
    #[error(
        "the dissimilarity of items {first} and {second} is not a finite number; leave the pair out instead"
    )]
    NotFinite {
        /// Index of the first item.
        first: usize,
        /// Index of the second item.
        second: usize,
    },
    /// A dissimilarity is below zero.
    #[error("the dissimilarity of items {first} and {second} is {value}; it must be 0 or more")]
    Negative {
        /// Index of the first item.
        first: usize,
        /// Index of the second item.
        second: usize,
        /// The dissimilarity given.
        value: f64,
    },
    /// The upper and the lower triangle of the matrix differ.
    #[error(
        "the matrix is not symmetric: items {first} and {second} have dissimilarity {one} above the diagonal and {other} below it; choose one value, or average them"
    )]
    Asymmetric {
        /// Index of the first item.
        first: usize,
        /// Index of the second item.
        second: usize,
        /// Value above the diagonal.
        one: f64,
        /// Value below the diagonal.
        other: f64,
    },
    /// The dissimilarity of an item with itself is not 0.
    #[error(
        "the dissimilarity of item {item} with itself is {value}; it must be 0 (to convert a similarity, subtract it from its maximum)"
    )]
    Diagonal {
        /// Index of the item.
        item: usize,
        /// The dissimilarity given.
        value: f64,
    },
}

/// Relative difference between the two triangles of a matrix that counts as rounding error.
const ROUNDING: f64 = 1e-9;

impl Dissimilarities {
    /// Dissimilarities from one value per pair, in the order (0, 1), (0, 2) … (1, 2) …, the upper triangle row by row.
    /// `None` marks a pair that was never compared.
    ///
    /// # Errors
    /// `Count`, `NotFinite`, `Negative`: see [`DissimilaritiesError`].
    pub fn from_condensed(n_items: usize, condensed: Vec<Option<f64>>) -> Result<Self, DissimilaritiesError> {
        let wanted = n_items * n_items.saturating_sub(1) / 2;
        if condensed.len() != wanted {
            return Err(DissimilaritiesError::Count { n_items, wanted, given: condensed.len() });
        }
        let dissimilarities = Self { n_items, condensed };
        for (first, second, value) in dissimilarities.pairs() {
            if !value.is_finite() {
                return Err(DissimilaritiesError::NotFinite { first, second });
            }
            if value < 0.0 {
                return Err(DissimilaritiesError::Negative { first, second, value });
            }
        }
        Ok(dissimilarities)
    }

    /// Dissimilarities from a full matrix with one row per item.
    ///
    /// # Errors
    /// See [`DissimilaritiesError`]. Triangles that differ only by rounding are averaged.
    pub fn from_matrix(matrix: &[Vec<f64>]) -> Result<Self, DissimilaritiesError> {
        let n_items = matrix.len();
        if let Some((row, columns)) = matrix.iter().enumerate().find(|(_, columns)| columns.len() != n_items)
        {
            return Err(DissimilaritiesError::NotSquare { row, n_items, len: columns.len() });
        }
        let mut condensed = Vec::with_capacity(n_items * n_items.saturating_sub(1) / 2);
        for (first, row) in matrix.iter().enumerate() {
            if row[first] != 0.0 {
                return Err(DissimilaritiesError::Diagonal { item: first, value: row[first] });
            }
            for second in first + 1..n_items {
                let (one, other) = (row[second], matrix[second][first]);
                if !one.is_finite() || !other.is_finite() {
                    return Err(DissimilaritiesError::NotFinite { first, second });
                }
                if (one - other).abs() > ROUNDING * one.abs().max(other.abs()) {
                    return Err(DissimilaritiesError::Asymmetric { first, second, one, other });
                }
                condensed.push(Some(0.5 * (one + other)));
            }
        }
        Self::from_condensed(n_items, condensed)
    }

    /// Number of items.
    pub fn n_items(&self) -> usize {
        self.n_items
    }

    /// Dissimilarity of two items, in either order: `None` if the pair was never compared, 0 for an item and itself.
    pub fn between(&self, one: usize, other: usize) -> Option<f64> {
        let (first, second) = (one.min(other), one.max(other));
        if first == second {
            return Some(0.0);
        }
        self.condensed[first * (2 * self.n_items - first - 1) / 2 + second - first - 1]
    }

    /// Iterates over all compared pairs in order, as (first, second, dissimilarity) with first < second.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let mut rest = &self.condensed[..];
        (0..self.n_items).flat_map(move |first| {
            let (row, after) = rest.split_at(self.n_items - first - 1);
            rest = after;
            let pair = move |(k, value): (usize, &Option<f64>)| value.map(|v| (first, first + 1 + k, v));
            row.iter().enumerate().filter_map(pair)
        })
    }

    /// Index of an item that no chain of compared pairs connects to item 0, or `None` if all are connected.
    pub fn unreachable(&self) -> Option<usize> {
        // Complete data are the common case and need no search.
        if self.condensed.iter().all(Option::is_some) {
            return None;
        }
        let mut part: Vec<usize> = (0..self.n_items).collect();
        for (first, second, _) in self.pairs() {
            let (from, to) = (part[first].max(part[second]), part[first].min(part[second]));
            if from != to {
                for p in part.iter_mut().filter(|p| **p == from) {
                    *p = to;
                }
            }
        }
        part.iter().position(|p| *p != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Dissimilarities, DissimilaritiesError};

    #[test]
    fn bad_numbers_are_named() {
        let nan = Dissimilarities::from_condensed(3, vec![Some(1.0), Some(f64::NAN), None]);
        assert_eq!(nan, Err(DissimilaritiesError::NotFinite { first: 0, second: 2 }));
        let negative = Dissimilarities::from_condensed(3, vec![Some(1.0), None, Some(-2.0)]);
        assert_eq!(negative, Err(DissimilaritiesError::Negative { first: 1, second: 2, value: -2.0 }));
        let count = Dissimilarities::from_condensed(4, vec![None; 5]);
        assert_eq!(count, Err(DissimilaritiesError::Count { n_items: 4, wanted: 6, given: 5 }));
        let matrix = |rows: &[[f64; 3]; 3]| {
            Dissimilarities::from_matrix(&rows.iter().map(|r| r.to_vec()).collect::<Vec<_>>())
        };
        let asymmetric = matrix(&[[0.0, 1.0, 2.0], [1.0, 0.0, 3.0], [2.5, 3.0, 0.0]]);
        let expected = DissimilaritiesError::Asymmetric { first: 0, second: 2, one: 2.0, other: 2.5 };
        assert_eq!(asymmetric, Err(expected));
        let similarity = matrix(&[[100.0, 1.0, 2.0], [1.0, 100.0, 3.0], [2.0, 3.0, 100.0]]);
        assert_eq!(similarity, Err(DissimilaritiesError::Diagonal { item: 0, value: 100.0 }));
        let nan = matrix(&[[0.0, 1.0, 2.0], [f64::NAN, 0.0, 3.0], [2.0, 3.0, 0.0]]);
        assert_eq!(nan, Err(DissimilaritiesError::NotFinite { first: 0, second: 1 }));
        let ragged = Dissimilarities::from_matrix(&[vec![0.0, 1.0], vec![1.0]]);
        assert_eq!(ragged, Err(DissimilaritiesError::NotSquare { row: 1, n_items: 2, len: 1 }));
    }

    #[test]
    fn pairs_are_found_again() {
        let condensed = (0..10).map(|k| if k == 4 { None } else { Some(f64::from(k)) }).collect();
        let five = Dissimilarities::from_condensed(5, condensed).unwrap();
        assert_eq!(five.pairs().count(), 9);
        for (first, second, value) in five.pairs() {
            assert_eq!(five.between(first, second), Some(value));
            assert_eq!(five.between(second, first), Some(value));
        }
        assert_eq!((five.between(1, 2), five.between(3, 3)), (None, Some(0.0)));
    }

    #[test]
    fn chains_of_pairs_join_items() {
        // Compared pairs: 0-1, 2-3 and, if `last` has a value, 1-3.
        let with = |last| {
            let condensed = vec![Some(1.0), None, None, None, last, Some(2.0)];
            Dissimilarities::from_condensed(4, condensed).unwrap().unreachable()
        };
        assert_eq!(with(Some(3.0)), None);
        assert_eq!(with(None), Some(2));
    }
}
