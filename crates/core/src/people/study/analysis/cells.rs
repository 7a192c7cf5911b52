//! One value for each participant and condition.

use std::collections::BTreeMap;

use crate::people::ratings::Average;
use crate::people::study::answer::Record;

/// Values of participants in conditions: the table that tests of hypotheses read.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Names of the participants, in the order of the records.
    pub participants: Vec<String>,
    /// Names of the conditions.
    pub columns: Vec<String>,
    /// Mean of the answers of each participant (row) in each condition (column); `None` without an answer.
    pub values: Vec<Vec<Option<f64>>>,
    /// Number of answers in each cell.
    pub n_answers: Vec<Vec<usize>>,
}

/// One answer in a cell.
pub(super) struct Entry {
    pub(super) participant: String,
    /// Index of the condition.
    pub(super) column: usize,
    pub(super) value: f64,
}

impl Cells {
    /// Cells of these answers, with a row for every participant of the records.
    pub(super) fn of(columns: Vec<String>, records: &[Record], entries: &[Entry]) -> Self {
        let mut participants: Vec<String> = Vec::new();
        let mut rows: BTreeMap<&str, usize> = BTreeMap::new();
        for record in records {
            rows.entry(&record.participant).or_insert_with(|| {
                participants.push(record.participant.clone());
                participants.len() - 1
            });
        }
        let mut sums = vec![vec![0.0; columns.len()]; participants.len()];
        let mut n_answers = vec![vec![0_usize; columns.len()]; participants.len()];
        for Entry { participant, column, value } in entries {
            if let Some(row) = rows.get(participant.as_str()) {
                sums[*row][*column] += value;
                n_answers[*row][*column] += 1;
            }
        }
        let mean = |(sum, n): (&f64, &usize)| (*n > 0).then(|| sum / *n as f64);
        let values =
            sums.iter().zip(&n_answers).map(|(sums, n)| sums.iter().zip(n).map(mean).collect()).collect();
        Self { participants, columns, values, n_answers }
    }

    /// Values in one condition, without the missing ones.
    ///
    /// # Panics
    /// If `column` is not an index of the columns.
    pub fn column(&self, column: usize) -> Vec<f64> {
        self.values.iter().filter_map(|row| row[column]).collect()
    }

    /// Mean over the participants in each condition, with its 95 % confidence interval.
    pub fn averages(&self) -> Vec<Average> {
        (0..self.columns.len()).map(|column| Average::of(&self.column(column))).collect()
    }

    /// Number of cells with a value.
    pub fn n_values(&self) -> usize {
        self.values.iter().flatten().flatten().count()
    }

    /// Number of answers of one participant.
    ///
    /// # Panics
    /// If `row` is not an index of the participants.
    pub fn n_answers_of(&self, row: usize) -> usize {
        self.n_answers[row].iter().sum()
    }
}
