//! Irregularities in sorts, each with a name and a sentence.

use std::collections::BTreeMap;
use std::fmt;

use crate::people::sorting::{Sort, SorterFit};

/// An irregularity in the sorts that the user should know of. No data are excluded because of it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// A sort has a different number of groups than requested. Its pairs score the requested number, or the number made
    /// if the request exceeds the number of textures.
    GroupCount {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
        /// Number of groups requested.
        wanted: usize,
        /// Number of groups made.
        made: usize,
    },
    /// All textures of a sort are in one group, so it carries no information.
    OneGroup {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
    },
    /// Every texture of a sort is in a group of its own, so it carries no information.
    AllAlone {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
    },
    /// A sort has fewer than two textures, and therefore no pair.
    NoPair {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
    },
    /// No sort contains both textures of these pairs; their similarities are unknown.
    NeverTogether {
        /// Texture names of each pair.
        pairs: Vec<[String; 2]>,
    },
    /// The correlation of a participant with the others is far below the median.
    Outlying {
        /// Name of the participant.
        participant: String,
        /// Correlation with the others.
        correlation: f64,
        /// Median of all participants' correlations.
        median: f64,
        /// Lowest correlation that is not outlying.
        limit: f64,
    },
}

/// Maximum number of pairs listed in one sentence; the rest are only counted.
const N_NAMED: usize = 3;

impl Finding {
    /// Short, stable name for scripts to match.
    pub fn name(&self) -> &'static str {
        match self {
            Self::GroupCount { .. } => "group count",
            Self::OneGroup { .. } => "one group",
            Self::AllAlone { .. } => "all alone",
            Self::NoPair { .. } => "no pair",
            Self::NeverTogether { .. } => "never together",
            Self::Outlying { .. } => "outlying participant",
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::GroupCount { participant, trial, wanted, made } => {
                write!(
                    f,
                    "participant {participant:?}, trial {trial:?} has {made} groups instead of {wanted}"
                )
            }
            Self::OneGroup { participant, trial } => {
                write!(f, "participant {participant:?}, trial {trial:?} has all textures in one group")
            }
            Self::AllAlone { participant, trial } => {
                write!(
                    f,
                    "participant {participant:?}, trial {trial:?} has every texture in a group of its own"
                )
            }
            Self::NoPair { participant, trial } => {
                write!(f, "participant {participant:?}, trial {trial:?} has fewer than two textures")
            }
            Self::NeverTogether { pairs } => {
                let named = pairs.iter().take(N_NAMED).map(|[a, b]| format!("{a:?} and {b:?}"));
                let more = match pairs.len().saturating_sub(N_NAMED) {
                    0 => String::new(),
                    1 => ", and 1 more pair".to_owned(),
                    n => format!(", and {n} more pairs"),
                };
                write!(
                    f,
                    "{}{more} are never in the same sort; their similarity is unknown",
                    named.collect::<Vec<_>>().join(", ")
                )
            }
            Self::Outlying { participant, correlation, median, limit } => write!(
                f,
                "the sorts of participant {participant:?} correlate with those of the others by {correlation:.2}, below the limit of {limit:.2} for these sorts; the median participant correlates by {median:.2} (not excluded)"
            ),
        }
    }
}

/// Irregularities of one sort.
pub(super) fn findings_of_sort(sort: &Sort, groups: &BTreeMap<&str, Vec<usize>>) -> Vec<Finding> {
    let (participant, trial) = (sort.participant.clone(), sort.trial.clone());
    let (n_sorted, made) = (sort.placements.len(), groups.len());
    if n_sorted < 2 {
        return vec![Finding::NoPair { participant, trial }];
    }
    let mut findings = Vec::new();
    if let Some(wanted) = sort.n_groups.filter(|wanted| *wanted != made) {
        findings.push(Finding::GroupCount {
            participant: participant.clone(),
            trial: trial.clone(),
            wanted,
            made,
        });
    }
    if made == 1 {
        findings.push(Finding::OneGroup { participant, trial });
    } else if made == n_sorted {
        findings.push(Finding::AllAlone { participant, trial });
    }
    findings
}

/// Reports all pairs without a score.
pub(super) fn finding_of_pairs(textures: &[String], scores: &[Vec<Option<f64>>]) -> Option<Finding> {
    let pairs = (0..textures.len()).flat_map(|i| (i + 1..textures.len()).map(move |j| (i, j)));
    let unknown = pairs.filter(|(i, j)| scores[*i][*j].is_none());
    let pairs: Vec<[String; 2]> = unknown.map(|(i, j)| [textures[i].clone(), textures[j].clone()]).collect();
    (!pairs.is_empty()).then_some(Finding::NeverTogether { pairs })
}

/// Reports all outlying participants.
pub(super) fn findings_of_agreements(agreements: &[SorterFit]) -> Vec<Finding> {
    let finding = |a: &SorterFit| {
        let (participant, correlation) = (a.participant.clone(), a.correlation?);
        let limit = a.limit?;
        a.outlying_from.map(|median| Finding::Outlying { participant, correlation, median, limit })
    };
    agreements.iter().filter_map(finding).collect()
}
