//! What is not as it should be in sorts, by name.

use std::collections::BTreeMap;
use std::fmt;

use crate::sorting::{Sort, SorterFit};

/// Something about sorts that their owner should know. Nothing is left out because of it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// A sort has other groups than were to be made; a pair scores what was to be made, or what was made where that is
    /// more than the textures.
    GroupCount {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
        /// Groups that were to be made.
        wanted: usize,
        /// Groups that were made.
        made: usize,
    },
    /// A sort has everything in one group, which says nothing.
    OneGroup {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
    },
    /// A sort has every texture alone, which says nothing.
    AllAlone {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
    },
    /// A sort has fewer than two textures, and thus no pair.
    NoPair {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
    },
    /// No sort has both textures of some pairs; their similarities are not known.
    NeverTogether {
        /// Names of the textures of each pair.
        pairs: Vec<[String; 2]>,
    },
    /// A participant sorted unlike the others.
    Outlying {
        /// Who sorted.
        participant: String,
        /// Correlation with the others.
        correlation: f64,
        /// The middle one of all participants' correlations.
        median: f64,
    },
}

/// Pairs that a sentence names before it counts the rest.
const N_NAMED: usize = 3;

impl Finding {
    /// A short name that scripts can look for.
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
                write!(f, "participant {participant:?}, trial {trial:?} made {made} of {wanted} groups")
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
                    "{}{more} are in no sort together; their similarity is not known",
                    named.collect::<Vec<_>>().join(", ")
                )
            }
            Self::Outlying { participant, correlation, median } => write!(
                f,
                "participant {participant:?} correlates with the others by {correlation:.2}, the middle one by {median:.2}"
            ),
        }
    }
}

/// What is not as it should be in one sort.
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

/// Pairs that have no score.
pub(super) fn finding_of_pairs(textures: &[String], scores: &[Vec<Option<f64>>]) -> Option<Finding> {
    let pairs = (0..textures.len()).flat_map(|i| (i + 1..textures.len()).map(move |j| (i, j)));
    let unknown = pairs.filter(|(i, j)| scores[*i][*j].is_none());
    let pairs: Vec<[String; 2]> = unknown.map(|(i, j)| [textures[i].clone(), textures[j].clone()]).collect();
    (!pairs.is_empty()).then_some(Finding::NeverTogether { pairs })
}

/// Participants that sorted unlike the others.
pub(super) fn findings_of_agreements(agreements: &[SorterFit]) -> Vec<Finding> {
    let finding = |a: &SorterFit| {
        let (participant, correlation) = (a.participant.clone(), a.correlation?);
        a.outlying_from.map(|median| Finding::Outlying { participant, correlation, median })
    };
    agreements.iter().filter_map(finding).collect()
}
