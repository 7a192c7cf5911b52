//! What is decided in a simulated study, by design.

use shagreen_core::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
use shagreen_core::maths::hypothesis_tests::t_tests::one_sample_t;
use shagreen_core::maths::statistics::correlation;
use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::people::sorting::similarity;
use shagreen_core::people::study::analysis::Cells;
use shagreen_core::people::study::analysis::abx::matches;
use shagreen_core::people::study::analysis::anchors::position_cells;
use shagreen_core::people::study::analysis::discrimination::discriminations;
use shagreen_core::people::study::analysis::dissimilarity::{Normalization, dissimilarities};
use shagreen_core::people::study::analysis::likert::grades;
use shagreen_core::people::study::analysis::mushra::page_ratings;
use shagreen_core::people::study::analysis::rating::rating_cells;
use shagreen_core::people::study::analysis::relevance::votes;
use shagreen_core::people::study::analysis::similarity::similarity_cells;
use shagreen_core::people::study::analysis::sorting::sorts;
use shagreen_core::people::study::analysis::thresholds::threshold_cells;
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Comparison, Design, Part, Plan};
use shagreen_core::people::study::same_different::{Correction, d_prime};
use shagreen_core::people::study::simulated::World;

use crate::study::analysis::{ConditionComparison, SIGNIFICANT};

/// Correlation of similarities with hidden distances from which a sorting counts as right; it is negative.
const SORTED: f64 = -0.8;

/// Decision about one part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decision<'a> {
    part: &'a Part,
    precision: f64,
}

impl<'a> Decision<'a> {
    /// Decision about a part; `precision` is the wanted one of a threshold, as a share of it.
    pub(super) fn of(part: &'a Part, precision: f64) -> Self {
        Self { part, precision }
    }

    /// Whether the decision holds for these answers, from participants who perceive this world.
    pub(super) fn holds(self, plan: &Plan, records: &[Record], world: &World) -> bool {
        let part = self.part;
        match &part.design {
            Design::Sorting { stimuli, .. } => {
                sorting_correlation(plan, part, stimuli, records, world).is_some_and(|r| r <= SORTED)
            }
            Design::Relevance { stimuli, .. } => differ(vote_cells(plan, part, stimuli, records)),
            Design::Rating { .. } => differ(rating_cells(part, records).into_iter().next()),
            Design::Dissimilarity { .. } => {
                differ(dissimilarities(part, records, Normalization::Range).map(|found| found.cells))
            }
            Design::SameDifferent { .. } => is_discriminated(part, records),
            Design::Staircase { .. } => {
                relative_error(part, records).is_some_and(|error| error <= self.precision)
            }
            Design::Similarity { .. } => differ(Some(similarity_cells(part, records))),
            Design::Likert { .. } => differ(grades(part, records).into_iter().next().map(|of| of.cells)),
            Design::Abx { .. } => {
                matches(part, records).first().is_some_and(|of| of.pooled.p_by_chance() < SIGNIFICANT)
            }
            Design::Mushra { .. } => {
                differ(page_ratings(part, records, &[]).into_iter().next().map(|page| page.cells))
            }
            Design::Anchors { .. } => differ(position_cells(part, records)),
        }
    }

    /// The decision in one sentence.
    pub(super) fn sentence(self, world: &World) -> String {
        match &self.part.design {
            Design::Sorting { .. } => {
                format!(
                    "The similarities correlate with the hidden distances on {} dimensions with {SORTED} or less.",
                    world.dimensions.len()
                )
            }
            Design::Relevance { adjectives, .. } => format!(
                "The stimuli differ in the votes for \"{}\" (p < {SIGNIFICANT}).",
                adjectives.first().map_or("", String::as_str)
            ),
            Design::Rating { pairs, .. } => format!(
                "The stimuli differ on {} (p < {SIGNIFICANT}).",
                pairs.first().map_or_else(String::new, AdjectivePair::name)
            ),
            Design::SameDifferent { pairs, .. } => format!(
                "The mean d' of {} is above 0 (t test over participants, p < {SIGNIFICANT}).",
                pairs.first().map_or_else(String::new, Comparison::name)
            ),
            Design::Staircase { .. } => format!(
                "The 95 % confidence interval of the geometric mean threshold is within {:.0} %.",
                100.0 * self.precision
            ),
            Design::Likert { statements, .. } => format!(
                "The conditions differ in the grades of \"{}\" (p < {SIGNIFICANT}).",
                statements.first().map_or("", |of| of.id.as_str())
            ),
            Design::Abx { pairs } => format!(
                "The pair {} is distinguished (more right answers than by guessing, p < {SIGNIFICANT}).",
                pairs.first().map_or_else(String::new, Comparison::name)
            ),
            Design::Mushra { pages } => format!(
                "The versions of {} and the hidden reference differ (p < {SIGNIFICANT}).",
                pages.first().map_or("", |page| page.reference.as_str())
            ),
            Design::Dissimilarity { .. } | Design::Similarity { .. } => {
                format!("The pairs differ (p < {SIGNIFICANT}).")
            }
            Design::Anchors { .. } => format!("The stimuli differ in position (p < {SIGNIFICANT})."),
        }
    }
}

/// Whether the conditions of cells differ.
fn differ(cells: Option<Cells>) -> bool {
    cells
        .and_then(|cells| ConditionComparison::of(&cells).ok())
        .is_some_and(|comparison| comparison.is_significant())
}

/// Votes for the first adjective, 1 or 0: participants × stimuli.
fn vote_cells(plan: &Plan, part: &Part, stimuli: &[String], records: &[Record]) -> Option<Cells> {
    let Design::Relevance { adjectives, .. } = &part.design else { return None };
    let adjective = adjectives.first()?;
    let mut votes = votes(plan, part, records);
    votes.retain(|vote| vote.adjective == *adjective);
    let value = |record: &Record, stimulus: &String| {
        let name = plan.texture_name(stimulus);
        let of_stimulus = votes
            .iter()
            .find(|vote| vote.participant == record.participant && vote.texture.as_deref() == Some(name));
        of_stimulus.map(|vote| f64::from(u8::from(vote.relevant)))
    };
    let values: Vec<Vec<Option<f64>>> =
        records.iter().map(|record| stimuli.iter().map(|id| value(record, id)).collect()).collect();
    let counted = |row: &Vec<Option<f64>>| row.iter().map(|value| usize::from(value.is_some())).collect();
    Some(Cells {
        participants: records.iter().map(|record| record.participant.clone()).collect(),
        columns: stimuli.to_vec(),
        n_answers: values.iter().map(counted).collect(),
        values,
    })
}

/// Correlation of the similarities of all pairs with their hidden distances.
fn sorting_correlation(
    plan: &Plan,
    part: &Part,
    stimuli: &[String],
    records: &[Record],
    world: &World,
) -> Option<f64> {
    let textures: Vec<String> = stimuli.iter().map(|id| plan.texture_name(id).to_owned()).collect();
    let found = similarity(&textures, &sorts(plan, part, records)).ok()?;
    let (mut distances, mut scores) = (Vec::new(), Vec::new());
    for (i, one) in stimuli.iter().enumerate() {
        for (j, other) in stimuli.iter().enumerate().skip(i + 1) {
            let (one, other) = (world.positions.get(one)?, world.positions.get(other)?);
            distances.push(one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt());
            scores.push(found.scores[i][j]?);
        }
    }
    correlation(&distances, &scores)
}

/// Whether the d′ of the first pair is above 0 over the participants.
fn is_discriminated(part: &Part, records: &[Record]) -> bool {
    let pairs = discriminations(part, records);
    let Some(first) = pairs.first() else { return false };
    let values: Vec<f64> = first
        .by_participant
        .iter()
        .filter_map(|(_, counts)| d_prime(*counts, Correction::LogLinear))
        .collect();
    let test = one_sample_t(&values, 0.0, Confidence::NINETY_FIVE).ok();
    let ratio = test.and_then(|test| test.ratio);
    ratio.is_some_and(|ratio| ratio.t > 0.0 && ratio.p_value < SIGNIFICANT)
}

/// Half width of the interval of the geometric mean threshold, as a share of it.
fn relative_error(part: &Part, records: &[Record]) -> Option<f64> {
    let logs: Vec<f64> = threshold_cells(part, records).column(0).iter().map(|value| value.ln()).collect();
    Some(mean_interval(&logs, Confidence::NINETY_FIVE)?.half_width.exp() - 1.0)
}
