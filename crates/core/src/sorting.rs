//! Cluster sorting: people put textures that feel alike into one group, and how often two share a group says how alike
//! they are.
//!
//! A participant sorts the textures once or several times, into few large groups or many small ones; each is a [`Sort`].
//! Two textures in one group score the number of groups of the sort, since it means more to share one of nine groups than
//! one of three. Their similarity is the score as a percentage of the highest that the pair could have: the groups of all
//! sorts in which both were sorted. With complete data that is a scale common to all pairs; missing sorts and textures
//! take nothing away from anybody.

mod agreement;
mod finding;

use std::collections::{BTreeMap, BTreeSet};

pub use crate::sorting::agreement::{FAR_BELOW, MIN_PAIRS, SorterFit};
pub use crate::sorting::finding::Finding;

use crate::dissimilarities::{Dissimilarities, DissimilaritiesError};
use crate::sorting::agreement::agreement;
use crate::sorting::finding::{finding_of_pairs, findings_of_sort};

/// One sorting of textures by one participant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sort {
    /// Who sorted.
    pub participant: String,
    /// Which of the participant's sorts it is.
    pub trial: String,
    /// How many groups were to be made; `None` where the participant was free, or a number above that of the textures
    /// sorted, count the groups made.
    pub n_groups: Option<usize>,
    /// Where textures were put; one that is not here was not sorted.
    pub placements: Vec<Grouped>,
}

/// Where a texture was put in a [`Sort`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grouped {
    /// Name of the texture.
    pub texture: String,
    /// Label of the group, of meaning within its sort only.
    pub group: String,
}

/// How alike textures were sorted.
#[derive(Clone, Debug, PartialEq)]
pub struct Similarity {
    /// Names of the textures, in the order of everything below.
    pub textures: Vec<String>,
    /// Similarity of each pair, 0..100, a row for each texture; 100 of a texture with itself, `None` where no sort has
    /// both.
    pub scores: Vec<Vec<Option<f64>>>,
    /// How many participants sorted both textures of a pair in one sort, and each texture at all.
    pub n_participants: Vec<Vec<usize>>,
    /// How each participant agrees with the others, in the order of first appearance.
    pub agreements: Vec<SorterFit>,
    /// What is not as it should be.
    pub findings: Vec<Finding>,
}

/// Why sorts have no similarity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SortingError {
    /// Too few textures.
    #[error("similarities need at least 3 textures, got {n_textures}")]
    TooFewTextures {
        /// The textures.
        n_textures: usize,
    },
    /// Two textures have one name.
    #[error("two textures are called {texture:?}; give one of them another name")]
    RepeatedName {
        /// The name.
        texture: String,
    },
    /// There is nothing to score.
    #[error("there are no sorts")]
    NoSorts,
    /// A participant did one trial twice.
    #[error(
        "participant {participant:?} has trial {trial:?} twice; give one of them another name, or leave it out"
    )]
    RepeatedTrial {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
    },
    /// A sort has a texture that nobody knows.
    #[error(
        "participant {participant:?}, trial {trial:?}: {texture:?} is none of the textures; correct its name, or add it"
    )]
    UnknownTexture {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
        /// The name that was found.
        texture: String,
    },
    /// A sort has a texture twice.
    #[error(
        "participant {participant:?}, trial {trial:?}: {texture:?} is in the groups {first:?} and {second:?}; a texture goes into one group"
    )]
    TextureTwice {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
        /// Name of the texture.
        texture: String,
        /// Where it is first.
        first: String,
        /// Where it is again.
        second: String,
    },
    /// No groups were to be made.
    #[error("participant {participant:?}, trial {trial:?}: textures cannot be sorted into 0 groups")]
    NoGroups {
        /// Who sorted.
        participant: String,
        /// Which sort.
        trial: String,
    },
}

/// How alike `textures` were sorted.
///
/// # Errors
/// See [`SortingError`]; what can be lived with is among the findings.
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

impl Similarity {
    /// Dissimilarities `100 - similarity`; pairs that no sort has together are not compared.
    ///
    /// # Errors
    /// None while the scores are as [`similarity`] made them.
    pub fn dissimilarities(&self) -> Result<Dissimilarities, DissimilaritiesError> {
        let n = self.textures.len();
        let above = self.scores.iter().enumerate().flat_map(|(i, row)| &row[(i + 1).min(row.len())..]);
        Dissimilarities::from_condensed(n, above.map(|score| score.map(|s| 100.0 - s)).collect())
    }
}

/// What one participant, or all, gave to each pair of textures, row by row.
struct Tally {
    n_textures: usize,
    score: Vec<f64>,
    /// The highest score that was possible.
    most: Vec<f64>,
}

impl Tally {
    fn new(n_textures: usize) -> Self {
        let zeros = vec![0.0; n_textures * n_textures];
        Self { n_textures, score: zeros.clone(), most: zeros }
    }

    /// Adds a sort, `groups` of which hold indices of textures.
    fn add(&mut self, sort: &Sort, groups: &BTreeMap<&str, Vec<usize>>) {
        let sorted: Vec<usize> = groups.values().flatten().copied().collect();
        // More groups than textures cannot have been meant: such a sort counts the groups that were made.
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

    /// What is left when `part` of it is taken away.
    fn without(&self, part: &Self) -> Self {
        let less = |all: &[f64], part: &[f64]| all.iter().zip(part).map(|(a, p)| a - p).collect();
        Self {
            n_textures: self.n_textures,
            score: less(&self.score, &part.score),
            most: less(&self.most, &part.most),
        }
    }

    /// Similarities 0..100, a row for each texture.
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

/// The groups of a sort by label, as indices of textures.
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
