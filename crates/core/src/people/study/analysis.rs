//! Analysis of the answers of a study, one file for each design.
//!
//! Input: a part of the plan and the records of all participants. Output: the tables that scaling and space building read
//! ([`sorting`], [`rating`]), counts ([`discrimination`], [`abx`]), or [`Cells`]: one value for each participant and
//! condition, the mean over repeats, or nothing where an answer is missing. Tests of hypotheses begin with these cells.
//! Answers of practice trials are left out. [`limits`] counts the answers that say less than they seem to.

pub mod abx;
pub mod anchors;
mod cells;
pub mod discrimination;
pub mod dissimilarity;
pub mod likert;
pub mod limits;
pub mod mushra;
pub mod rating;
pub mod relevance;
pub mod similarity;
pub mod sorting;
pub mod thresholds;

pub use cells::Cells;

use crate::people::study::answer::{Answer, Record};
use crate::people::study::plan::Part;

/// Answers of a part that count, with the record of their participant.
fn scored<'a>(records: &'a [Record], part: &'a Part) -> impl Iterator<Item = (&'a Record, &'a Answer)> {
    scored_by_index(records, part).map(|(record, _, answer)| (record, answer))
}

/// Answers of a part that count, with the record of their participant and their index in it.
fn scored_by_index<'a>(
    records: &'a [Record],
    part: &'a Part,
) -> impl Iterator<Item = (&'a Record, usize, &'a Answer)> {
    records.iter().flat_map(move |record| {
        let all = record.answers.iter().enumerate();
        all.filter(move |(_, answer)| answer.trial.part == part.id && !answer.trial.is_practice)
            .map(move |(index, answer)| (record, index, answer))
    })
}

#[cfg(test)]
mod tests;
