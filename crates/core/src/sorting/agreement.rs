//! How each participant's sorting agrees with the others'.

use crate::sorting::Tally;
use crate::spectrum::median;
use crate::statistics::correlation;

/// How a participant agrees with the others.
#[derive(Clone, Debug, PartialEq)]
pub struct SorterFit {
    /// Who sorted.
    pub participant: String,
    /// Correlation of the participant's similarities with those of all others together, over the pairs that both have;
    /// `None` where either is the same for all pairs, or there are fewer than [`MIN_PAIRS`].
    pub correlation: Option<f64>,
    /// The middle one of all correlations where this one lies far below it: see [`FAR_BELOW`].
    pub outlying_from: Option<f64>,
}

/// The fewest pairs of which a correlation says anything.
pub const MIN_PAIRS: usize = 3;

/// The fewest participants of whom one may be called outlying.
const MIN_PARTICIPANTS: usize = 4;

/// Robust standard deviations below the middle one from which on a correlation is outlying: one in 700 of normal ones.
pub const FAR_BELOW: f64 = 3.0;

/// Distance below the middle one that is never outlying: ten simulated participants of one kind already spread by 0.15.
const NEAR: f64 = 0.2;

/// Standard deviation of a normal distribution, in median absolute deviations.
const NORMAL: f64 = 1.4826;

pub(super) fn agreement(names: &[&str], tallies: &[Tally]) -> Vec<SorterFit> {
    let mut all = Tally::new(tallies.first().map_or(0, |tally| tally.n_textures));
    for tally in tallies {
        all.merge(tally);
    }
    let correlations: Vec<Option<f64>> = tallies.iter().map(|own| with_others(own, &all)).collect();
    let known: Vec<f64> = correlations.iter().flatten().copied().collect();
    let middle = median(known.clone());
    let deviation = NORMAL * median(known.iter().map(|c| (c - middle).abs()).collect());
    let lowest = middle - NEAR.max(FAR_BELOW * deviation);
    let one = |(name, correlation): (&&str, Option<f64>)| {
        let far = known.len() >= MIN_PARTICIPANTS && correlation.is_some_and(|c| c < lowest);
        SorterFit { participant: (*name).to_owned(), correlation, outlying_from: far.then_some(middle) }
    };
    names.iter().zip(correlations).map(one).collect()
}

/// Correlation of the similarities of one participant with those of the others together: of `all`, less `own`.
fn with_others(own: &Tally, all: &Tally) -> Option<f64> {
    let n = own.n_textures;
    // Scores are whole numbers, so what is left is exact.
    let [own, others] = [own.scores(), all.without(own).scores()];
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let (own, others): (Vec<f64>, Vec<f64>) = pairs.filter_map(|(i, j)| own[i][j].zip(others[i][j])).unzip();
    if own.len() < MIN_PAIRS { None } else { correlation(&own, &others) }
}
