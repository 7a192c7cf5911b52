//! Cluster sorting: participants group textures that feel similar, and shared groups yield a similarity for each pair.
//!
//! A participant sorts the textures once or several times, into few large groups or many small ones; each time is a
//! [`Sort`]. If two textures share a group, the pair scores the number of groups of the sort, because sharing one of
//! nine groups means more than sharing one of three. Similarity is this score as a percentage of the maximum possible
//! for the pair: the sum of the numbers of groups over all sorts that contain both textures. With complete data the
//! maximum is the same for all pairs. Missing sorts and textures do not lower a similarity.

mod agreement;
mod finding;

use std::collections::{BTreeMap, BTreeSet};

pub use crate::people::sorting::agreement::{FAR_BELOW, MIN_PAIRS, SorterFit};
pub use crate::people::sorting::finding::Finding;

use crate::people::dissimilarities::{Dissimilarities, DissimilaritiesError};
use crate::people::sorting::agreement::agreement;
use crate::people::sorting::finding::{finding_of_pairs, findings_of_sort};

/// One sorting of the textures by one participant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sort {
    /// Name of the participant.
    pub participant: String,
    /// Name of this trial among the participant's sorts.
    pub trial: String,
    /// Number of groups the participant was asked to make. If it is `None` (a free sort) or exceeds the number of
    /// sorted textures, the number of groups actually made is used.
    pub n_groups: Option<usize>,
    /// Group assignments; a texture that is not listed was not sorted.
    pub placements: Vec<Grouped>,
}

/// Group assignment of one texture in a [`Sort`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grouped {
    /// Name of the texture.
    pub texture: String,
    /// Label of the group; it has a meaning only within its sort.
    pub group: String,
}

/// Similarities of textures derived from sorts.
#[derive(Clone, Debug, PartialEq)]
pub struct Similarity {
    /// Names of the textures; all other fields use this order.
    pub textures: Vec<String>,
    /// Similarity of each pair, 0..100, one row per texture. It is 100 for a texture with itself, and `None` if no sort
    /// contains both textures.
    pub scores: Vec<Vec<Option<f64>>>,
    /// Number of participants who sorted both textures of a pair in one sort; on the diagonal, who sorted the texture.
    pub n_participants: Vec<Vec<usize>>,
    /// Agreement of each participant with the others, in the order of first appearance.
    pub agreements: Vec<SorterFit>,
    /// Irregularities in the sorts.
    pub findings: Vec<Finding>,
}

/// Reasons why sorts have no similarities.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SortingError {
    /// There are too few textures.
    #[error("similarities need at least 3 textures, got {n_textures}")]
    TooFewTextures {
        /// Number of textures.
        n_textures: usize,
    },
    /// Two textures have the same name.
    #[error("two textures are named {texture:?}; rename one of them")]
    RepeatedName {
        /// The name.
        texture: String,
    },
    /// There are no sorts.
    #[error("there are no sorts; add at least one")]
    NoSorts,
    /// A participant has two trials of the same name.
    #[error("participant {participant:?} has trial {trial:?} twice; rename one of them, or leave it out")]
    RepeatedTrial {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
    },
    /// A sort contains an unknown texture.
    #[error(
        "participant {participant:?}, trial {trial:?}: {texture:?} is not one of the textures; correct the name, or add the texture"
    )]
    UnknownTexture {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
        /// The unknown name.
        texture: String,
    },
    /// A sort contains a texture twice.
    #[error(
        "participant {participant:?}, trial {trial:?}: {texture:?} is in the groups {first:?} and {second:?}; assign each texture to one group"
    )]
    TextureTwice {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
        /// Name of the texture.
        texture: String,
        /// First group of the texture.
        first: String,
        /// Second group of the texture.
        second: String,
    },
    /// The requested number of groups is 0.
    #[error(
        "participant {participant:?}, trial {trial:?}: textures cannot be sorted into 0 groups; give 1 or more"
    )]
    NoGroups {
        /// Name of the participant.
        participant: String,
        /// Name of the trial.
        trial: String,
    },
}

/// Similarities of `textures` from all sorts.
///
/// # Errors
/// See [`SortingError`]. Irregularities that do not prevent a result are reported in [`Similarity::findings`].
pub fn similarity(textures: &[String], sorts: &[Sort]) -> Result<Similarity, SortingError> {
    let n = textures.len();
    if n < 3 {
        return Err(SortingError::TooFewTextures { n_textures: n });
    }
    let index = index_of(textures)?;
    if sorts.is_empty() {
        return Err(SortingError::NoSorts);
    }
    let mut trials = BTreeSet::new();
    let mut names: Vec<&str> = Vec::new();
    let mut index_of_name: BTreeMap<&str, usize> = BTreeMap::new();
    let mut tallies: Vec<Tally> = Vec::new();
    let mut findings = Vec::new();
    for sort in sorts {
        if !trials.insert((&sort.participant, &sort.trial)) {
            let (participant, trial) = (sort.participant.clone(), sort.trial.clone());
            return Err(SortingError::RepeatedTrial { participant, trial });
        }
        let groups = groups_of(sort, &index)?;
        findings.extend(findings_of_sort(sort, &groups));
        let at = *index_of_name.entry(&sort.participant).or_insert_with(|| {
            names.push(&sort.participant);
            tallies.push(Tally::new(n));
            names.len() - 1
        });
        tallies[at].add(sort, &groups);
    }
    let mut all = Tally::new(n);
    for tally in &tallies {
        all.merge(tally);
    }
    let scores = all.scores();
    findings.extend(finding_of_pairs(textures, &scores));
    let seen = |i: usize, j: usize| tallies.iter().filter(|t| t.most[i * n + j] > 0.0).count();
    let agreements = agreement(&names, &tallies);
    findings.extend(finding::findings_of_agreements(&agreements));
    Ok(Similarity {
        textures: textures.to_vec(),
        scores,
        n_participants: (0..n).map(|i| (0..n).map(|j| seen(i, j)).collect()).collect(),
        agreements,
        findings,
    })
}

/// Dissimilarities of `textures` from all sorts together, as [`Similarity::dissimilarities`], without the agreement of
/// the participants.
///
/// # Errors
/// [`SortingError`] for a sort that names a texture not in `textures` or that has no groups.
pub(crate) fn pooled_dissimilarities(
    textures: &[String],
    sorts: &[&Sort],
) -> Result<Result<Dissimilarities, DissimilaritiesError>, SortingError> {
    let index = index_of(textures)?;
    let mut all = Tally::new(textures.len());
    for sort in sorts {
        all.add(sort, &groups_of(sort, &index)?);
    }
    Ok(dissimilarities(&all.scores()))
}

fn dissimilarities(scores: &[Vec<Option<f64>>]) -> Result<Dissimilarities, DissimilaritiesError> {
    let above = scores.iter().enumerate().flat_map(|(i, row)| &row[(i + 1).min(row.len())..]);
    Dissimilarities::from_condensed(scores.len(), above.map(|score| score.map(|s| 100.0 - s)).collect())
}

impl Similarity {
    /// Dissimilarities `100 - similarity`; pairs that no sort contains together stay missing.
    ///
    /// # Errors
    /// None for scores that [`similarity`] computed.
    pub fn dissimilarities(&self) -> Result<Dissimilarities, DissimilaritiesError> {
        dissimilarities(&self.scores)
    }
}

/// Scores of all pairs of textures for one participant or for all participants, row by row.
struct Tally {
    n_textures: usize,
    score: Vec<f64>,
    /// Maximum possible score of each pair.
    most: Vec<f64>,
}

impl Tally {
    fn new(n_textures: usize) -> Self {
        let zeros = vec![0.0; n_textures * n_textures];
        Self { n_textures, score: zeros.clone(), most: zeros }
    }

    /// Adds a sort; `groups` holds the texture indices of each group.
    fn add(&mut self, sort: &Sort, groups: &BTreeMap<&str, Vec<usize>>) {
        let sorted: Vec<usize> = groups.values().flatten().copied().collect();
        // A number of groups above the number of textures is an error in the data; use the number of groups made
        // instead.
        let worth = sort.n_groups.filter(|n| *n <= sorted.len()).unwrap_or(groups.len()) as f64;
        for i in &sorted {
            for j in &sorted {
                self.most[i * self.n_textures + j] += worth;
            }
        }
        for group in groups.values() {
            for i in group {
                for j in group {
                    self.score[i * self.n_textures + j] += worth;
                }
            }
        }
    }

    fn merge(&mut self, other: &Self) {
        for (to, from) in [(&mut self.score, &other.score), (&mut self.most, &other.most)] {
            for (to, from) in to.iter_mut().zip(from) {
                *to += from;
            }
        }
    }

    /// This tally minus the contribution of `part`.
    fn without(&self, part: &Self) -> Self {
        let less = |all: &[f64], part: &[f64]| all.iter().zip(part).map(|(a, p)| a - p).collect();
        Self {
            n_textures: self.n_textures,
            score: less(&self.score, &part.score),
            most: less(&self.most, &part.most),
        }
    }

    /// Similarities 0..100, one row per texture.
    fn scores(&self) -> Vec<Vec<Option<f64>>> {
        let rows = self.score.chunks(self.n_textures).zip(self.most.chunks(self.n_textures));
        let percent = |(score, most): (&f64, &f64)| (*most > 0.0).then(|| 100.0 * score / most);
        let mut scores: Vec<Vec<_>> = rows.map(|(s, m)| s.iter().zip(m).map(percent).collect()).collect();
        for (i, row) in scores.iter_mut().enumerate() {
            row[i] = Some(100.0);
        }
        scores
    }
}

fn index_of(textures: &[String]) -> Result<BTreeMap<&str, usize>, SortingError> {
    let mut index = BTreeMap::new();
    for (i, texture) in textures.iter().enumerate() {
        if index.insert(texture.as_str(), i).is_some() {
            return Err(SortingError::RepeatedName { texture: texture.clone() });
        }
    }
    Ok(index)
}

/// Groups of a sort by label, as texture indices.
fn groups_of<'a>(
    sort: &'a Sort,
    index: &BTreeMap<&str, usize>,
) -> Result<BTreeMap<&'a str, Vec<usize>>, SortingError> {
    let who = || (sort.participant.clone(), sort.trial.clone());
    if sort.n_groups == Some(0) {
        let (participant, trial) = who();
        return Err(SortingError::NoGroups { participant, trial });
    }
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut placed: BTreeMap<usize, &str> = BTreeMap::new();
    for Grouped { texture, group } in &sort.placements {
        let Some(i) = index.get(texture.as_str()) else {
            let (participant, trial) = who();
            return Err(SortingError::UnknownTexture { participant, trial, texture: texture.clone() });
        };
        if let Some(first) = placed.insert(*i, group) {
            let ((participant, trial), texture) = (who(), texture.clone());
            let (first, second) = (first.to_owned(), group.clone());
            return Err(SortingError::TextureTwice { participant, trial, texture, first, second });
        }
        groups.entry(group).or_default().push(*i);
    }
    Ok(groups)
}

#[cfg(test)]
mod tests;
