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

use crate::maths::statistics::{mean, standard_deviation, t_quantile_two_sided};

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

/// Mean rating of one texture on one adjective pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// Number of raters.
    pub n_raters: usize,
    /// Mean over those who rated, 0..100; `None` if there are no ratings.
    pub mean: Option<f64>,
    /// Standard error of the mean, in points; `None` with fewer than two raters.
    pub standard_error: Option<f64>,
    /// Half width of the 95 % confidence interval (Student's t), in points; `None` with fewer than two raters. The
    /// interval may extend below 0 or above 100.
    pub half_width: Option<f64>,
}

impl Average {
    /// Average of a texture that nobody rated.
    pub const NONE: Self = Self { n_raters: 0, mean: None, standard_error: None, half_width: None };
}

/// Averages on one adjective pair, one per texture.
///
/// # Panics
/// If `pair` is not an index of the table's pairs.
pub fn averages(table: &RatingTable, pair: usize) -> Vec<Average> {
    (0..table.textures().len()).map(|texture| average(&table.raters_of(texture, pair))).collect()
}

fn average(values: &[f64]) -> Average {
    let n = values.len();
    if n == 0 {
        return Average::NONE;
    }
    let standard_error = (n > 1).then(|| standard_deviation(values) / (n as f64).sqrt());
    let half_width = standard_error.map(|error| t_quantile_two_sided(0.05, (n - 1) as f64) * error);
    Average { n_raters: n, mean: Some(mean(values)), standard_error, half_width }
}

#[cfg(test)]
mod tests;
