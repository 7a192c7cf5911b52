//! Grades of the similarity of pairs.

use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, Response};
use crate::people::study::plan::{Comparison, Part};
use crate::people::study::trial::Task;

/// Grades of a part: participants × pairs, in the order of the plan.
pub fn similarity_cells(part: &Part, records: &[Record]) -> Cells {
    let pairs = part.design.comparisons();
    let entry = |(record, answer): (&Record, &Answer)| {
        let (Task::Grade { pair, .. }, Response::Grade(grade)) = (&answer.trial.task, &answer.response)
        else {
            return None;
        };
        let column = pairs.iter().position(|of| of == pair)?;
        Some(Entry { participant: record.participant.clone(), column, value: f64::from(*grade) })
    };
    let entries: Vec<Entry> = scored(records, part).filter_map(entry).collect();
    Cells::of(pairs.iter().map(Comparison::name).collect(), records, &entries)
}
