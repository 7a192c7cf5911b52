//! Ratings on adjective pairs.

use crate::people::ratings::Rating;
use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, Response};
use crate::people::study::plan::{Design, Part, Plan};
use crate::people::study::trial::Task;

/// Ratings on each adjective pair of the part, in its order: participants × stimuli. None if it has another design.
pub fn rating_cells(part: &Part, records: &[Record]) -> Vec<Cells> {
    let Design::Rating { stimuli, pairs, .. } = &part.design else { return Vec::new() };
    let of_pair = |pair: usize| {
        let entry = |(record, answer): (&Record, &Answer)| entry_of(record, answer, stimuli, pair);
        let entries: Vec<Entry> = scored(records, part).filter_map(entry).collect();
        Cells::of(stimuli.clone(), records, &entries)
    };
    (0..pairs.len()).map(of_pair).collect()
}

fn entry_of(record: &Record, answer: &Answer, stimuli: &[String], pair: usize) -> Option<Entry> {
    let (Task::Rate { stimulus }, Response::Sliders(values)) = (&answer.trial.task, &answer.response) else {
        return None;
    };
    let column = stimuli.iter().position(|of| of == stimulus)?;
    Some(Entry { participant: record.participant.clone(), column, value: *values.get(pair)? })
}

/// Ratings of a part, averaged over repeats, for the tables from which a space is built; missing answers are left out. Textures
/// have the names of [`Plan::texture_name`].
pub fn ratings(plan: &Plan, part: &Part, records: &[Record]) -> Vec<Rating> {
    let Design::Rating { stimuli, pairs, .. } = &part.design else { return Vec::new() };
    let all = rating_cells(part, records);
    let mut ratings = Vec::new();
    let participants = all.first().map(|cells| cells.participants.clone()).unwrap_or_default();
    for (row, participant) in participants.iter().enumerate() {
        for (column, stimulus) in stimuli.iter().enumerate() {
            for (pair, cells) in pairs.iter().zip(&all) {
                let Some(value) = cells.values[row][column] else { continue };
                ratings.push(Rating {
                    participant: participant.clone(),
                    texture: plan.texture_name(stimulus).to_owned(),
                    pair: pair.clone(),
                    value: Some(value),
                });
            }
        }
    }
    ratings
}
