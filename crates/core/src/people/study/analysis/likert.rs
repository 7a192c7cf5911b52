//! Grades of statements under conditions, averaged over prompts.
//!
//! In the published study, eleven participants graded five statements after five prompts under three conditions: 75 grades
//! each. Averaged over the prompts, they are 15 values for each participant, 165 in all.

use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, Response};
use crate::people::study::plan::{Design, Part, Statement};
use crate::people::study::trial::Task;

/// Grades of one statement.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementGrades {
    /// Identifier of the statement.
    pub statement: String,
    /// Mean grade over the prompts: participants × conditions.
    pub cells: Cells,
}

/// Grades of each statement of a part, in its order; none if it has another design.
pub fn grades(part: &Part, records: &[Record]) -> Vec<StatementGrades> {
    let Design::Likert { conditions, statements, .. } = &part.design else { return Vec::new() };
    let names: Vec<String> = conditions.iter().map(|condition| condition.id.clone()).collect();
    let of_statement = |index: usize| {
        let entry = |(record, answer): (&Record, &Answer)| {
            let (Task::Question { condition, .. }, Response::Grades { grades, .. }) =
                (&answer.trial.task, &answer.response)
            else {
                return None;
            };
            let column = names.iter().position(|name| name == condition)?;
            let value = f64::from(*grades.get(index)?);
            Some(Entry { participant: record.participant.clone(), column, value })
        };
        let entries: Vec<Entry> = scored(records, part).filter_map(entry).collect();
        Cells::of(names.clone(), records, &entries)
    };
    let with_name = |(index, statement): (usize, &Statement)| StatementGrades {
        statement: statement.id.clone(),
        cells: of_statement(index),
    };
    statements.iter().enumerate().map(with_name).collect()
}
