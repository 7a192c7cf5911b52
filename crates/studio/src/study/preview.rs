//! What a participant of a plan meets: parts, trials, estimated time, order.

use std::sync::Arc;

use shagreen_core::people::study::answer::{Event, Record};
use shagreen_core::people::study::order::{Order, n_rows};
use shagreen_core::people::study::plan::{Design, Part, Plan};
use shagreen_core::people::study::progress::ProgressError;
use shagreen_core::people::study::schedule::{part_order, trials};
use shagreen_core::people::study::simulated::{Observers, SimulationError, World, simulated_session};
use shagreen_core::people::study::touch::required_mm;
use shagreen_core::people::study::trial::{Shown, Task, Trial};

use crate::study::plans::StudyPlan;
use crate::study::presented::stimuli_of;

/// What one participant meets.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyPreview {
    /// Number of the participant, from 1.
    pub participant: usize,
    /// Parts in the order of presentation.
    pub parts: Vec<PartPreview>,
    /// Number of trials, practice included; estimated if there are staircases.
    pub n_trials: usize,
    /// Estimated time of the session, in minutes, without consent and breaks.
    pub minutes: f64,
    /// Numbers of participants that are multiples of this one are balanced: every order is equally frequent.
    pub balanced_multiple: usize,
}

/// What one participant meets in one part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartPreview {
    /// Identifier.
    pub id: String,
    /// Heading that participants see.
    pub title: String,
    /// Identifier of the design.
    pub design: &'static str,
    /// Number of practice trials.
    pub n_practice: usize,
    /// Number of further trials; estimated for a staircase.
    pub n_scored: usize,
    /// Whether the number of trials is estimated.
    pub is_estimated: bool,
    /// Number of offered breaks.
    pub n_breaks: usize,
    /// Distance in mm that an answer needs over each stimulus, if any.
    pub touch_mm: Option<f64>,
    /// Estimated time, in minutes.
    pub minutes: f64,
    /// Identifiers of the stimuli, which participants do not see.
    pub stimuli: Vec<String>,
    /// Each trial in one line, with the labels on the screen and the stimuli behind them; empty for a staircase.
    pub trials: Vec<String>,
}

/// Estimated time of a response, in s: for a trial, and for each of its values. The numbers are ours.
const SORT_SECS: (f64, f64) = (10.0, 8.0);
const VOTE_SECS: (f64, f64) = (8.0, 1.5);
const RATE_SECS: (f64, f64) = (8.0, 4.0);
const PAIR_SECS: (f64, f64) = (12.0, 0.0);
const SUCCESSION_SECS: (f64, f64) = (3.0, 0.0);
const QUESTION_SECS: (f64, f64) = (25.0, 5.0);
const PAGE_SECS: (f64, f64) = (10.0, 8.0);

/// What the participant with this number meets, from 1.
///
/// # Errors
/// The plan cannot be run, or the number is 0.
pub fn preview(study: &StudyPlan, participant: usize) -> Result<StudyPreview, SimulationError> {
    let plan = &study.plan;
    if participant == 0 {
        return Err(ProgressError::Participant.into());
    }
    let staircase_trials = simulated_counts(plan, participant)?;
    let of_part = |index: usize| part_preview(plan, &plan.parts[index], participant, &staircase_trials);
    let parts: Vec<PartPreview> = part_order(plan, participant).into_iter().map(of_part).collect();
    Ok(StudyPreview {
        participant,
        n_trials: parts.iter().map(|part| part.n_practice + part.n_scored).sum(),
        minutes: parts.iter().map(|part| part.minutes).sum(),
        balanced_multiple: balanced_multiple(plan),
        parts,
    })
}

/// Number of answers of a simulated participant to each part with a staircase; empty without any.
fn simulated_counts(plan: &Arc<Plan>, participant: usize) -> Result<Vec<(String, usize)>, SimulationError> {
    let has_staircase = |part: &&Part| matches!(part.design, Design::Staircase { .. });
    let staircases: Vec<&Part> = plan.parts.iter().filter(has_staircase).collect();
    if staircases.is_empty() {
        return Ok(Vec::new());
    }
    let world = World::invented(plan, plan.seed);
    let events: Vec<Event> = simulated_session(plan, &world, &Observers::usual(), participant, plan.seed)?;
    let record = Record::of(String::new(), participant, true, &events);
    let count = |part: &&Part| {
        let scored =
            record.answers.iter().filter(|answer| answer.trial.part == part.id && !answer.trial.is_practice);
        (part.id.clone(), scored.count())
    };
    Ok(staircases.iter().map(count).collect())
}

fn part_preview(plan: &Plan, part: &Part, participant: usize, staircases: &[(String, usize)]) -> PartPreview {
    let of_staircase = staircases.iter().find(|(id, _)| *id == part.id).map(|(_, n)| *n);
    let of_plan = part.design.n_trials().map(|n| n * part.n_repeats);
    let n_scored = of_plan.or(of_staircase).unwrap_or(0);
    let n_all = part.n_practice + n_scored;
    PartPreview {
        id: part.id.clone(),
        title: if part.title.is_empty() { part.id.clone() } else { part.title.clone() },
        design: part.design.id(),
        n_practice: part.n_practice,
        n_scored,
        is_estimated: of_plan.is_none(),
        // Practice does not count, and there is no break after the last trial.
        n_breaks: part.break_every.map_or(0, |every| n_scored.saturating_sub(1) / every.max(1)),
        touch_mm: required_mm(part),
        minutes: n_all as f64 * trial_secs(part) / 60.0,
        stimuli: stimuli_of(part).into_iter().map(str::to_owned).collect(),
        trials: trials(plan, part, participant).iter().map(trial_line).collect(),
    }
}

/// Estimated time of a trial, in s.
fn trial_secs(part: &Part) -> f64 {
    let ((first, each), n_values, n_presented) = match &part.design {
        Design::Sorting { stimuli, .. } => (SORT_SECS, stimuli.len(), 0.0),
        Design::Relevance { adjectives, .. } => (VOTE_SECS, adjectives.len(), 1.0),
        Design::Rating { pairs, .. } => (RATE_SECS, pairs.len(), 1.0),
        Design::Dissimilarity { .. } | Design::Similarity { .. } => (PAIR_SECS, 0, 2.0),
        Design::SameDifferent { .. } | Design::Staircase { .. } => (SUCCESSION_SECS, 0, 2.0),
        Design::Likert { statements, .. } => (QUESTION_SECS, statements.len(), 1.0),
        Design::Abx { .. } => (PAIR_SECS, 0, 3.0),
        Design::Mushra { pages } => {
            let most = pages.iter().map(|page| 1 + page.tested.len() + page.anchors.len()).max();
            (PAGE_SECS, most.unwrap_or(0), 0.0)
        }
        Design::Anchors { .. } => (PAIR_SECS, 0, 1.0),
    };
    let timing = part.timing;
    let presented = n_presented * timing.stimulus_secs.unwrap_or(0.0);
    let between = (n_presented - 1.0_f64).max(0.0) * timing.gap_secs;
    first + each * n_values as f64 + timing.lead_secs + presented + between + timing.pause_secs
}

/// Smallest number of participants among whom all Latin squares of the plan are complete.
fn balanced_multiple(plan: &Plan) -> usize {
    let of_parts = (plan.part_order == Order::LatinSquare).then_some(plan.parts.len());
    let of_trials = plan.parts.iter().filter(|part| part.order == Order::LatinSquare).filter_map(|part| {
        match &part.design {
            Design::Likert { conditions, .. } => Some(conditions.len()),
            design => design.n_trials(),
        }
    });
    of_parts.into_iter().chain(of_trials).map(n_rows).fold(1, least_common_multiple)
}

fn least_common_multiple(a: usize, b: usize) -> usize {
    let (mut rest, mut divisor) = (a, b);
    while divisor != 0 {
        (rest, divisor) = (divisor, rest % divisor);
    }
    (a / rest.max(1)).saturating_mul(b)
}

/// A trial in one line: what the participant sees, and in parentheses what it is.
fn trial_line(trial: &Trial) -> String {
    let practice = if trial.is_practice { "practice: " } else { "" };
    let asked = match &trial.task {
        Task::Sort { n_groups, .. } => format!("sort into {n_groups} groups"),
        Task::Vote { .. } => "choose adjectives".to_owned(),
        Task::Rate { .. } => "rate".to_owned(),
        Task::Compare { .. } => "state a number for the difference".to_owned(),
        Task::Discriminate { segment, .. } => format!("same or different, segment {}", segment + 1),
        Task::Detect { .. } => "which side".to_owned(),
        Task::Grade { .. } => "grade the similarity".to_owned(),
        Task::Question { prompt, condition } => format!("text {}, condition {condition}", prompt + 1),
        Task::Match { .. } => "which one is X".to_owned(),
        Task::Page { .. } => "rate beside the reference".to_owned(),
        Task::Place { .. } => "place on the line".to_owned(),
    };
    let shown: Vec<String> = trial.task.shown().iter().map(behind_label).collect();
    let behind = if shown.is_empty() { String::new() } else { format!(" ({})", shown.join(", ")) };
    format!("{}. {practice}{asked}{behind}", trial.number)
}

fn behind_label(shown: &Shown) -> String {
    if shown.label.is_empty() {
        shown.stimulus.clone()
    } else {
        format!("{} = {}", shown.label, shown.stimulus)
    }
}

#[cfg(test)]
mod tests {
    use super::{balanced_multiple, least_common_multiple, preview};
    use crate::study::plans::template;

    #[test]
    fn least_common_multiples_are_exact() {
        for (a, b, expected) in [(1, 6, 6), (4, 6, 12), (10, 5, 10), (7, 3, 21), (1, 1, 1)] {
            assert_eq!(least_common_multiple(a, b), expected);
        }
    }

    #[test]
    fn a_participant_sees_labels_and_the_experimenter_what_is_behind_them() {
        let study = template("abx").unwrap().study;
        let shown = preview(&study, 3).unwrap();
        assert_eq!((shown.participant, shown.parts.len()), (3, 1));
        let part = &shown.parts[0];
        assert_eq!(part.trials.len(), part.n_practice + part.n_scored);
        assert_eq!(shown.n_trials, part.trials.len());
        assert!(part.trials[0].starts_with("1. practice: which one is X (A = "), "{}", part.trials[0]);
        assert!(shown.minutes > 1.0 && !part.is_estimated);
        assert!(preview(&study, 0).unwrap_err().to_string().contains("numbered from 1"));
    }

    /// Two trials of practice, and 16 that count with a break after each eight.
    #[test]
    fn breaks_are_those_of_the_session() {
        let study = template("anchor-rating").unwrap().study;
        let part = &preview(&study, 1).unwrap().parts[0];
        assert_eq!((part.n_practice, part.n_scored, part.n_breaks), (2, 16, 1));
    }

    /// The tip moves by itself over stimuli that follow each other.
    #[test]
    fn a_touch_is_stated_where_an_answer_needs_one() {
        let touch_mm = |id: &str| preview(&template(id).unwrap().study, 1).unwrap().parts[0].touch_mm;
        assert_eq!((touch_mm("anchor-rating"), touch_mm("same-different")), (Some(20.0), None));
    }

    /// The number of trials of a staircase follows from answers, so it is estimated.
    #[test]
    fn the_trials_of_a_staircase_are_estimated() {
        let study = template("gap-detection").unwrap().study;
        let shown = preview(&study, 1).unwrap();
        assert!(shown.parts[0].is_estimated && shown.parts[0].trials.is_empty());
        assert!((20..=200).contains(&shown.parts[0].n_scored), "{}", shown.parts[0].n_scored);
    }

    /// Three conditions need six rows, because a single square of an odd number is not balanced.
    #[test]
    fn latin_squares_ask_for_a_number_of_participants() {
        let study = template("text-to-texture").unwrap().study;
        assert_eq!(balanced_multiple(&study.plan), 6);
        assert_eq!(balanced_multiple(&template("bipolar-rating").unwrap().study.plan), 1);
        // Five parts.
        assert_eq!(balanced_multiple(&template("same-different").unwrap().study.plan), 10);
    }
}
