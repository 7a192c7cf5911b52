//! Dissimilarities by magnitude estimation, and the normalized realism score of authored textures.
//!
//! Participants choose their own scale, so their numbers are normalized before they are averaged. The realism score of a pair is
//! 1 if it is as dissimilar as identical stimuli, and 0 if it is as dissimilar as the two most different ones:
//! `1 - (δ - lowest)/(highest - lowest)`, where `lowest` is the mean of the references with themselves.

use crate::maths::statistics::mean;
use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Record, Response};
use crate::people::study::plan::{Comparison, Design, Part, Plan};
use crate::people::study::trial::Task;

/// Normalization of the numbers of one participant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normalization {
    /// To 0 to 1, from the lowest to the highest answer: "normalized (0–1) for each participant", as published.
    #[default]
    Range,
    /// Divided by the highest answer, so that 0 stays "the same".
    Maximum,
    /// Divided by the geometric mean of the answers above 0, the usual treatment of magnitude estimates without modulus. The
    /// values have no upper limit.
    GeometricMean,
}

/// Normalized dissimilarities of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Dissimilarity {
    /// The comparisons, references last; columns of the cells.
    pub comparisons: Vec<Comparison>,
    /// Normalized dissimilarities: participants × comparisons.
    pub cells: Cells,
    /// Mean dissimilarities of the references; `None` if the part has none, or one was not answered.
    pub references: Option<References>,
    /// Participants who gave the same number everywhere, whose answers cannot be normalized and are missing.
    pub constant: Vec<String>,
}

/// Dissimilarities at the ends of the realism score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct References {
    /// Mean dissimilarity of the references with themselves.
    pub lowest: f64,
    /// Dissimilarity of the references with each other.
    pub highest: f64,
}

/// Realism score of a pair, usually 0 to 1: above 1 if the pair is less dissimilar than identical stimuli were.
pub fn normalized_realism(dissimilarity: f64, references: References) -> f64 {
    1.0 - (dissimilarity - references.lowest) / (references.highest - references.lowest)
}

/// Ends of the realism score from cells whose last three columns are the references: with each other, the first with itself, the
/// second with itself. `None` if one was not answered, or if the identical ones are not less dissimilar.
pub fn references_of(cells: &Cells) -> Option<References> {
    let averages = cells.averages();
    let [.., between, first, second] = averages.as_slice() else { return None };
    let (highest, lowest) = (between.mean?, 0.5 * (first.mean? + second.mean?));
    (highest > lowest).then_some(References { lowest, highest })
}

/// Normalized dissimilarities of a part; `None` if it has another design.
pub fn dissimilarities(
    part: &Part,
    records: &[Record],
    normalization: Normalization,
) -> Option<Dissimilarity> {
    let Design::Dissimilarity { reference, .. } = &part.design else { return None };
    let comparisons = part.design.comparisons();
    let (mut entries, mut constant) = (Vec::new(), Vec::new());
    for (participant, answers) in by_participant(records, part, &comparisons) {
        let values: Vec<f64> = answers.iter().map(|(_, value)| *value).collect();
        let Some(scale) = Scale::of(&values, normalization) else {
            if !values.is_empty() {
                constant.push(participant);
            }
            continue;
        };
        entries.extend(answers.into_iter().map(|(column, value)| Entry {
            participant: participant.clone(),
            column,
            value: (value - scale.zero) / scale.unit,
        }));
    }
    let names = comparisons.iter().map(Comparison::name).collect();
    let cells = Cells::of(names, records, &entries);
    let references = reference.as_ref().and_then(|_| references_of(&cells));
    Some(Dissimilarity { comparisons, cells, references, constant })
}

/// Mean realism scores of the pairs of a texture and a version of it, in the order of the comparisons: which one, and its
/// score. Empty without references.
pub fn realism_scores(plan: &Plan, dissimilarity: &Dissimilarity) -> Vec<(Comparison, f64)> {
    let Some(references) = dissimilarity.references else { return Vec::new() };
    let averages = dissimilarity.cells.averages();
    let is_version = |pair: &Comparison| {
        let two = plan.stimulus(&pair.first).zip(plan.stimulus(&pair.second));
        two.is_some_and(|(one, other)| one.source == other.source && one.variant != other.variant)
    };
    let pairs = dissimilarity.comparisons.iter().zip(averages).filter(|(pair, _)| is_version(pair));
    pairs.filter_map(|(pair, of)| Some((pair.clone(), normalized_realism(of.mean?, references)))).collect()
}

/// Answers of each participant: column and number.
fn by_participant(
    records: &[Record],
    part: &Part,
    comparisons: &[Comparison],
) -> Vec<(String, Vec<(usize, f64)>)> {
    let mut all: Vec<(String, Vec<(usize, f64)>)> = Vec::new();
    for (record, answer) in scored(records, part) {
        let (Task::Compare { pair, .. }, Response::Magnitude(value)) = (&answer.trial.task, &answer.response)
        else {
            continue;
        };
        let Some(column) = comparisons.iter().position(|of| of == pair) else { continue };
        match all.iter_mut().find(|(name, _)| *name == record.participant) {
            Some((_, answers)) => answers.push((column, *value)),
            None => all.push((record.participant.clone(), vec![(column, *value)])),
        }
    }
    all
}

/// Zero and unit of the scale of one participant.
struct Scale {
    zero: f64,
    unit: f64,
}

impl Scale {
    /// `None` if the values have no spread, or none is above 0.
    fn of(values: &[f64], normalization: Normalization) -> Option<Self> {
        let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
        // Also if there are no values.
        if highest <= lowest {
            return None;
        }
        Some(match normalization {
            Normalization::Range => Self { zero: lowest, unit: highest - lowest },
            Normalization::Maximum => Self { zero: 0.0, unit: highest },
            Normalization::GeometricMean => {
                let logs: Vec<f64> =
                    values.iter().filter(|value| **value > 0.0).map(|value| value.ln()).collect();
                Self { zero: 0.0, unit: mean(&logs).exp() }
            }
        })
    }
}
