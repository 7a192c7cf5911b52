//! Right answers of matching trials (ABX).

use crate::maths::statistics::binomial_upper_tail;
use crate::people::study::analysis::scored;
use crate::people::study::answer::{Record, is_right};
use crate::people::study::plan::{Comparison, Design, Part};
use crate::people::study::trial::Task;

/// Right answers to the trials of one pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matches {
    /// The two stimuli.
    pub pair: Comparison,
    /// Answers of all participants together.
    pub pooled: RightAnswers,
    /// Answers of each participant with answers.
    pub by_participant: Vec<(String, RightAnswers)>,
}

/// Number of right answers among all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RightAnswers {
    /// Number of right answers.
    pub n_right: u64,
    /// Number of answers.
    pub n_trials: u64,
}

impl RightAnswers {
    /// Proportion of right answers, 0 to 1; `None` without answers.
    pub fn proportion(self) -> Option<f64> {
        (self.n_trials > 0).then(|| self.n_right as f64 / self.n_trials as f64)
    }

    /// Probability of at least as many right answers by guessing, exact (binomial, one-sided).
    pub fn p_by_chance(self) -> f64 {
        binomial_upper_tail(self.n_right, self.n_trials, 0.5)
    }

    fn add(&mut self, is_right: bool) {
        self.n_trials += 1;
        self.n_right += u64::from(is_right);
    }
}

/// Right answers to each pair of a part, in its order; none if it has another design.
pub fn matches(part: &Part, records: &[Record]) -> Vec<Matches> {
    let Design::Abx { pairs } = &part.design else { return Vec::new() };
    let empty = |pair: &Comparison| Matches {
        pair: pair.clone(),
        pooled: RightAnswers::default(),
        by_participant: Vec::new(),
    };
    let mut all: Vec<Matches> = pairs.iter().map(empty).collect();
    for (record, answer) in scored(records, part) {
        let Task::Match { pair, .. } = &answer.trial.task else { continue };
        let Some(right) = is_right(&answer.trial.task, &answer.response) else { continue };
        let Some(of_pair) = all.iter_mut().find(|of| of.pair == *pair) else { continue };
        of_pair.pooled.add(right);
        let answers = &mut of_pair.by_participant;
        let at = answers.iter().position(|(name, _)| *name == record.participant).unwrap_or_else(|| {
            answers.push((record.participant.clone(), RightAnswers::default()));
            answers.len() - 1
        });
        answers[at].1.add(right);
    }
    all
}
