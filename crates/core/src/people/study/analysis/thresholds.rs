//! Thresholds from staircases.

use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, is_right};
use crate::people::study::plan::{Design, Part};
use crate::people::study::staircase::{Staircase, Threshold};
use crate::people::study::trial::Task;

/// One staircase of one participant.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Name of the participant.
    pub participant: String,
    /// Number of the staircase, from 0.
    pub track: usize,
    /// Level and correctness of each answer, in order.
    pub answers: Vec<(f64, bool)>,
    /// Levels of the reversals.
    pub reversals: Vec<f64>,
    /// Threshold, in the unit of the level; `None` if there are too few reversals.
    pub threshold: Option<Threshold>,
}

/// All staircases of a part with at least one answer; none if it has another design.
pub fn tracks(part: &Part, records: &[Record]) -> Vec<Track> {
    let Design::Staircase { rule, .. } = &part.design else { return Vec::new() };
    let mut tracks: Vec<Track> = Vec::new();
    for record in records {
        let of_record = std::slice::from_ref(record);
        let mut answers: Vec<&Answer> = scored(of_record, part).map(|(_, answer)| answer).collect();
        answers.sort_by_key(|answer| answer.trial.number);
        for track in 0..part.n_repeats {
            let answers: Vec<(f64, bool)> =
                answers.iter().filter_map(|answer| of_track(answer, track)).collect();
            if answers.is_empty() {
                continue;
            }
            let mut staircase = Staircase::new(rule.clone());
            for (level, right) in &answers {
                staircase.answer(*level, *right);
            }
            tracks.push(Track {
                participant: record.participant.clone(),
                track,
                answers,
                reversals: staircase.reversals().to_vec(),
                threshold: staircase.threshold(),
            });
        }
    }
    tracks
}

fn of_track(answer: &Answer, wanted: usize) -> Option<(f64, bool)> {
    match answer.trial.task {
        Task::Detect { track, level, .. } if track == wanted => {
            Some((level, is_right(&answer.trial.task, &answer.response)?))
        }
        _ => None,
    }
}

/// Threshold of each participant, the mean over the staircases that have one: participants × one column.
pub fn threshold_cells(part: &Part, records: &[Record]) -> Cells {
    let entry = |track: &Track| {
        let value = track.threshold?.level;
        Some(Entry { participant: track.participant.clone(), column: 0, value })
    };
    let entries: Vec<Entry> = tracks(part, records).iter().filter_map(entry).collect();
    Cells::of(vec!["threshold".to_owned()], records, &entries)
}
