//! Agreement of each participant's sorts with those of the others.

use crate::dsp::spectrum::median;
use crate::maths::statistics::correlation;
use crate::people::sorting::Tally;

/// Agreement of one participant with the others.
#[derive(Clone, Debug, PartialEq)]
pub struct SorterFit {
    /// Name of the participant.
    pub participant: String,
    /// Correlation of the participant's similarities with the pooled similarities of all others, over the pairs that
    /// both have. `None` if either is constant, or with fewer than [`MIN_PAIRS`] common pairs.
    pub correlation: Option<f64>,
    /// Median of all participants' correlations if this one is outlying (see [`FAR_BELOW`]), else `None`.
    pub outlying_from: Option<f64>,
    /// Lowest correlation that is not outlying, the same for all participants; `None` with too few participants.
    pub limit: Option<f64>,
}

/// Minimum number of pairs for a meaningful correlation.
pub const MIN_PAIRS: usize = 3;

/// Minimum number of participants for outlier detection.
const MIN_PARTICIPANTS: usize = 4;

/// Outlier limit in robust standard deviations below the median. About one in 700 normally distributed values is lower.
pub const FAR_BELOW: f64 = 3.0;

/// Minimum distance of an outlier below the median: correlations of ten equal simulated participants spread by 0.15.
const NEAR: f64 = 0.2;

/// Ratio of the standard deviation to the median absolute deviation for a normal distribution.
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
        let limit = (known.len() >= MIN_PARTICIPANTS).then_some(lowest);
        let far = correlation.zip(limit).is_some_and(|(c, lowest)| c < lowest);
        SorterFit {
            participant: (*name).to_owned(),
            correlation,
            outlying_from: far.then_some(middle),
            limit,
        }
    };
    names.iter().zip(correlations).map(one).collect()
}

/// Correlation of one participant's similarities (`own`) with those of the others (`all` minus `own`).
fn with_others(own: &Tally, all: &Tally) -> Option<f64> {
    let n = own.n_textures;
    // Scores are integers, so the difference is exact.
    let [own, others] = [own.scores(), all.without(own).scores()];
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let (own, others): (Vec<f64>, Vec<f64>) = pairs.filter_map(|(i, j)| own[i][j].zip(others[i][j])).unzip();
    if own.len() < MIN_PAIRS { None } else { correlation(&own, &others) }
}
