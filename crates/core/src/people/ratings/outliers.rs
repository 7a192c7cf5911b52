//! Detection of outlying raters, of raters who always give the same value, and of reversed poles. They are reported,
//! never removed or corrected.

use super::RatingTable;
use crate::maths::statistics::{centered, correlation, is_constant, mean};

/// Correlation with the mean of the other raters below which a rater is reported. At this limit, a rater shares only 9
/// % of the variance (0.3²) with the others.
pub const OUTLIER_LIMIT: f64 = 0.3;

/// Correlation with the mean of the other raters on one adjective pair below which its poles are probably reversed. With
/// `MIN_FOR_REVERSED` textures, unrelated ratings are below it with a probability of 0.03 (one-sided t-test).
pub const REVERSED_LIMIT: f64 = -0.7;

/// Minimum number of textures, rated by this rater and by others, for a correlation on one adjective pair.
const MIN_SHARED: usize = 3;

/// Minimum number of such textures for the detection of reversed poles.
const MIN_FOR_REVERSED: usize = 8;

/// Minimum number of participants for the detection of reversed poles: of two who contradict each other, either may be
/// right.
const MIN_PARTICIPANTS: usize = 3;

/// Agreement of one rater with the others.
#[derive(Clone, Debug, PartialEq)]
pub struct RaterFit {
    /// Index of the participant.
    pub participant: usize,
    /// Number of ratings this person gave.
    pub n_ratings: usize,
    /// Correlation over all adjective pairs with the mean of the other raters, with values centered within each pair.
    /// `None` if the person gave too few ratings or always the same one.
    pub correlation: Option<f64>,
    /// Correlation on each adjective pair. A clearly negative value on one pair alone suggests swapped poles.
    pub by_pair: Vec<Option<f64>>,
    /// Whether the correlation is known and below [`OUTLIER_LIMIT`].
    pub outlying: bool,
    /// Indices of the adjective pairs on which the person gave the same rating to three textures or more, and no other.
    pub constant_pairs: Vec<usize>,
    /// Indices of the adjective pairs on which the poles are probably reversed: the correlation is below
    /// [`REVERSED_LIMIT`] over enough textures and participants.
    pub reversed_pairs: Vec<usize>,
}

/// Agreement of every participant with the mean of the others.
pub fn rater_fits(table: &RatingTable) -> Vec<RaterFit> {
    (0..table.participants().len()).map(|participant| rater_fit(table, participant)).collect()
}

fn rater_fit(table: &RatingTable, participant: usize) -> RaterFit {
    let (mut all_own, mut all_others) = (Vec::new(), Vec::new());
    let mut by_pair = Vec::with_capacity(table.pairs().len());
    let (mut constant_pairs, mut reversed_pairs) = (Vec::new(), Vec::new());
    let mut n_ratings = 0;
    for pair in 0..table.pairs().len() {
        let (mut given, mut own, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for texture in 0..table.textures().len() {
            let Some(value) = table.value(participant, texture, pair) else { continue };
            n_ratings += 1;
            given.push(value);
            let rest = (0..table.participants().len()).filter(|p| *p != participant);
            let rest: Vec<f64> = rest.filter_map(|p| table.value(p, texture, pair)).collect();
            if !rest.is_empty() {
                own.push(value);
                others.push(mean(&rest));
            }
        }
        if given.len() >= MIN_SHARED && is_constant(&given) {
            constant_pairs.push(pair);
        }
        let on_pair = if own.len() < MIN_SHARED { None } else { correlation(&own, &others) };
        let is_enough = own.len() >= MIN_FOR_REVERSED && table.participants().len() >= MIN_PARTICIPANTS;
        if is_enough && on_pair.is_some_and(|r| r < REVERSED_LIMIT) {
            reversed_pairs.push(pair);
        }
        by_pair.push(on_pair);
        all_own.extend(centered(&own));
        all_others.extend(centered(&others));
    }
    let enough = all_own.len() >= MIN_SHARED && !is_constant(&all_own) && by_pair.iter().any(Option::is_some);
    let correlation = if enough { correlation(&all_own, &all_others) } else { None };
    let outlying = correlation.is_some_and(|r| r < OUTLIER_LIMIT);
    RaterFit { participant, n_ratings, correlation, by_pair, outlying, constant_pairs, reversed_pairs }
}
