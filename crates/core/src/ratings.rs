//! Ratings of textures by people: adjective pairs, averages, agreement, raters who rate otherwise.
//!
//! A rating runs from 0, the low pole of a pair ("rough"), to 100, its high pole ("smooth"). What was not rated is
//! missing and stays missing: an average is over those who rated, and says how many they were.

mod agreement;
mod outliers;
mod pair_name;
mod relevance;
mod table;

pub use agreement::{Agreement, AgreementError, IntraclassCorrelation, agreement};
pub use outliers::{OUTLIER_LIMIT, RaterFit, rater_fits};
pub use pair_name::{PairNameError, poles};
pub use relevance::{RELEVANCE_LIMIT, Relevance, RelevanceVote, VoteError, relevances};
pub use table::{RatingTable, RatingsError};

use crate::statistics::{mean, standard_deviation, t_quantile_two_sided};

/// Two adjectives of opposite meaning.
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

/// What one person says of one texture on one adjective pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Rating {
    /// Who rated.
    pub participant: String,
    /// What was rated.
    pub texture: String,
    /// Between which adjectives.
    pub pair: AdjectivePair,
    /// 0 (low pole) to 100 (high pole); `None` where the person gave no answer.
    pub value: Option<f64>,
}

/// Highest value at which a scale of 0 to 100 looks like another one.
pub const SHORT_SCALE: f64 = 10.0;

/// The average rating of one texture on one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// How many rated.
    pub n_raters: usize,
    /// The mean of those who rated, 0..100; `None` where nobody did.
    pub mean: Option<f64>,
    /// Half the width of the 95 % confidence interval by Student's t, in points; `None` with fewer than two raters.
    /// The interval may reach beyond 0 or 100.
    pub half_width: Option<f64>,
}

/// The averages of a pair, texture by texture.
///
/// # Panics
/// If the table has no pair of that index.
pub fn averages(table: &RatingTable, pair: usize) -> Vec<Average> {
    (0..table.textures().len()).map(|texture| average(&table.raters_of(texture, pair))).collect()
}

fn average(values: &[f64]) -> Average {
    let n = values.len();
    let half_width = (n > 1)
        .then(|| t_quantile_two_sided(0.05, (n - 1) as f64) * standard_deviation(values) / (n as f64).sqrt());
    Average { n_raters: n, mean: (n > 0).then(|| mean(values)), half_width }
}

#[cfg(test)]
mod tests;
