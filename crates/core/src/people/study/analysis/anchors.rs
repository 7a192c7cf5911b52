//! Positions between two anchors.

use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, Response};
use crate::people::study::plan::{Design, Part};
use crate::people::study::trial::Task;

/// Positions of a part, 0 (low anchor) to 100 (high anchor): participants × stimuli. `None` if the part has another design.
pub fn position_cells(part: &Part, records: &[Record]) -> Option<Cells> {
    let Design::Anchors { stimuli, .. } = &part.design else { return None };
    let entry = |(record, answer): (&Record, &Answer)| {
        let (Task::Place { stimulus, .. }, Response::Sliders(values)) =
            (&answer.trial.task, &answer.response)
        else {
            return None;
        };
        let column = stimuli.iter().position(|of| of == stimulus)?;
        Some(Entry { participant: record.participant.clone(), column, value: *values.first()? })
    };
    let entries: Vec<Entry> = scored(records, part).filter_map(entry).collect();
    Some(Cells::of(stimuli.clone(), records, &entries))
}
