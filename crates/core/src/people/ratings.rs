//! Human ratings of textures: adjective pairs, averages, agreement between raters, and outlying raters.
//!
//! A rating runs from 0, the low pole of an adjective pair ("rough"), to 100, its high pole ("smooth"). Missing ratings
//! are never filled in: an average covers only those who rated and reports their number.

mod agreement;
mod outliers;
mod pair_name;
mod relevance;
mod table;

pub use agreement::{Agreement, AgreementError, IntraclassCorrelation, agreement};
pub use outliers::{OUTLIER_LIMIT, REVERSED_LIMIT, RaterFit, rater_fits};
pub use pair_name::{PairNameError, poles};
pub use relevance::{RELEVANCE_LIMIT, Relevance, RelevanceVote, VoteError, relevances};
pub use table::{RatingTable, RatingsError};

use crate::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
use crate::maths::statistics::mean;

/// Two adjectives of opposite meaning, the poles of a rating scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdjectivePair {
    /// The adjective at 0.
    pub low: String,
    /// The adjective at 100.
    pub high: String,
}

impl std::fmt::Display for AdjectivePair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}\u{2013}{}", self.low, self.high)
    }
}

/// One person's rating of one texture on one adjective pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Rating {
    /// Name of the participant who rated.
    pub participant: String,
    /// Name of the texture.
    pub texture: String,
    /// Adjective pair of the scale.
    pub pair: AdjectivePair,
    /// Rating from 0 (low pole) to 100 (high pole); `None` if the person gave no answer.
    pub value: Option<f64>,
}

/// If the highest rating does not exceed this value, the scale is probably not 0 to 100.
pub const SHORT_SCALE: f64 = 10.0;

/// Mean over raters, usually of the ratings of one texture on one adjective pair (0 to 100).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// Number of raters.
    pub n_raters: usize,
    /// Mean over those who rated, in the unit of the ratings; `None` if there are no ratings.
    pub mean: Option<f64>,
    /// Standard error of the mean; `None` with fewer than two raters.
    pub standard_error: Option<f64>,
    /// Half width of the 95 % confidence interval (Student's t); `None` with fewer than two raters. The interval may extend
    /// beyond the ends of the scale.
    pub half_width: Option<f64>,
}

impl Average {
    /// Average of a texture that nobody rated.
    pub const NONE: Self = Self { n_raters: 0, mean: None, standard_error: None, half_width: None };

    /// Average of these values, one for each rater.
    pub fn of(values: &[f64]) -> Self {
        if values.is_empty() {
            return Self::NONE;
        }
        let interval = mean_interval(values, Confidence::NINETY_FIVE);
        Self {
            n_raters: values.len(),
            mean: Some(mean(values)),
            standard_error: interval.map(|interval| interval.standard_error),
            half_width: interval.map(|interval| interval.half_width),
        }
    }
}

/// Averages on one adjective pair, one per texture.
///
/// # Panics
/// If `pair` is not an index of the table's pairs.
pub fn averages(table: &RatingTable, pair: usize) -> Vec<Average> {
    (0..table.textures().len()).map(|texture| Average::of(&table.raters_of(texture, pair))).collect()
}

#[cfg(test)]
mod tests;
