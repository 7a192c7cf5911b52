//! Same-different answers as counts and as d′.

use crate::people::study::analysis::scored;
use crate::people::study::answer::{Record, Response};
use crate::people::study::plan::{Comparison, Design, Part};
use crate::people::study::same_different::{
    Correction, Counts, d_prime, differencing, independent_observation,
};
use crate::people::study::trial::Task;

/// Answers to the trials of one pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Discrimination {
    /// The reference and its processed version.
    pub pair: Comparison,
    /// Counts of all participants together, as published.
    pub pooled: Counts,
    /// Counts of each participant with answers.
    pub by_participant: Vec<(String, Counts)>,
}

/// d′ of the same counts by three models of the observer ([`crate::people::study::same_different`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discriminability {
    /// `z(H) - z(F)`, as published; it can be negative.
    pub yes_no: f64,
    /// Of an observer who compares the difference with a criterion, 0 or more.
    pub differencing: f64,
    /// Of an observer who classifies each stimulus by itself, 0 or more.
    pub independent_observation: f64,
}

/// d′ by all models; `None` if one kind of trial is missing.
pub fn discriminability(counts: Counts, correction: Correction) -> Option<Discriminability> {
    let rates = counts.rates(correction)?;
    Some(Discriminability {
        yes_no: d_prime(counts, correction)?,
        differencing: differencing(rates),
        independent_observation: independent_observation(rates),
    })
}

/// Counts of each pair of a part, in its order; none if it has another design.
pub fn discriminations(part: &Part, records: &[Record]) -> Vec<Discrimination> {
    let Design::SameDifferent { pairs, .. } = &part.design else { return Vec::new() };
    let empty = |pair: &Comparison| Discrimination {
        pair: pair.clone(),
        pooled: Counts::default(),
        by_participant: Vec::new(),
    };
    let mut all: Vec<Discrimination> = pairs.iter().map(empty).collect();
    for (record, answer) in scored(records, part) {
        let (Task::Discriminate { pair, is_different, .. }, Response::IsDifferent(answered)) =
            (&answer.trial.task, &answer.response)
        else {
            continue;
        };
        let Some(of_pair) = all.iter_mut().find(|of| of.pair == *pair) else { continue };
        add(&mut of_pair.pooled, *is_different, *answered);
        let counts = &mut of_pair.by_participant;
        let at = counts.iter().position(|(name, _)| *name == record.participant).unwrap_or_else(|| {
            counts.push((record.participant.clone(), Counts::default()));
            counts.len() - 1
        });
        add(&mut counts[at].1, *is_different, *answered);
    }
    all
}

fn add(counts: &mut Counts, is_different: bool, answered: bool) {
    let (n, n_answered) = if is_different {
        (&mut counts.n_different, &mut counts.hits)
    } else {
        (&mut counts.n_same, &mut counts.false_alarms)
    };
    *n += 1;
    *n_answered += u64::from(answered);
}
