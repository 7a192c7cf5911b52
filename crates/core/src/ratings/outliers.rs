//! Raters who rate otherwise than the rest: reported, never removed.

use super::RatingTable;
use crate::statistics::{centered, correlation, is_constant, mean};

/// Correlation with the mean of the others below which a rater is reported: less than a tenth of what the rater says
/// (0.3² = 9 %) is shared with the others.
pub const OUTLIER_LIMIT: f64 = 0.3;

/// Ratings of a pair that a rater must share with others before the two are correlated.
const MIN_SHARED: usize = 3;

/// How one rater agrees with the others.
#[derive(Clone, Debug, PartialEq)]
pub struct RaterFit {
    /// Index of the participant.
    pub participant: usize,
    /// How many ratings this person gave.
    pub n_ratings: usize,
    /// Correlation over all pairs with the mean of the others, each centered within its pair; `None` where the person
    /// gave too few ratings, or always the same.
    pub correlation: Option<f64>,
    /// The same pair by pair: clearly negative on one pair alone says that its poles were swapped.
    pub by_pair: Vec<Option<f64>>,
    /// Whether the correlation is known and below [`OUTLIER_LIMIT`].
    pub outlying: bool,
}

/// How every participant agrees with the mean of the others.
pub fn rater_fits(table: &RatingTable) -> Vec<RaterFit> {
    (0..table.participants().len()).map(|participant| rater_fit(table, participant)).collect()
}

fn rater_fit(table: &RatingTable, participant: usize) -> RaterFit {
    let (mut all_own, mut all_others) = (Vec::new(), Vec::new());
    let mut by_pair = Vec::with_capacity(table.pairs().len());
    let mut n_ratings = 0;
    for pair in 0..table.pairs().len() {
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for texture in 0..table.textures().len() {
            let Some(value) = table.value(participant, texture, pair) else { continue };
            n_ratings += 1;
            let rest = (0..table.participants().len()).filter(|p| *p != participant);
            let rest: Vec<f64> = rest.filter_map(|p| table.value(p, texture, pair)).collect();
            if !rest.is_empty() {
                own.push(value);
                others.push(mean(&rest));
            }
        }
        by_pair.push(if own.len() < MIN_SHARED { None } else { correlation(&own, &others) });
        all_own.extend(centered(&own));
        all_others.extend(centered(&others));
    }
    let enough = all_own.len() >= MIN_SHARED && !is_constant(&all_own) && by_pair.iter().any(Option::is_some);
    let correlation = if enough { correlation(&all_own, &all_others) } else { None };
    let outlying = correlation.is_some_and(|r| r < OUTLIER_LIMIT);
    RaterFit { participant, n_ratings, correlation, by_pair, outlying }
}
