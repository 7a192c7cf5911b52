//! Answers of a study as a tidy table for R, pandas and spreadsheets: one row for each value.
//!
//! A trial with several values, such as a rating on five scales or a sort of 25 textures, has several rows, which differ in
//! `item` and `value`. The columns are:
//!
//! | column | content |
//! |---|---|
//! | `participant`, `number`, `simulated` | pseudonym and number of the participant; 1 if simulated |
//! | `part`, `design`, `trial`, `practice` | where the trial is; practice trials have 1 and are not analyzed |
//! | `stimulus`, `other_stimulus` | what was judged, and what it was compared with |
//! | `item` | scale, adjective, statement, prompt and so on; empty if the design has none |
//! | `presented` | what was presented: `same` or `different`, the level of a staircase, the number of groups, the order |
//! | `value` | the response: a number, 1 or 0 for yes or no, or a side |
//! | `right` | 1 or 0 if the response can be right or wrong |
//! | `response_s`, `latency_ms` | response time, latency of the output |
//! | `distance_mm`, `mean_speed_mm_per_s`, `mean_force_n` | movement of the hand |
//! | `plays` | how often the stimuli were started, separated by spaces |
//! | `device`, `stimulus_hashes` | actuator profile, hashes of what was presented |
//!
//! An empty field was not measured. [`crate::sorting_csv`] and [`crate::ratings_csv`] write the tables from which a space is
//! built.

mod values;

use shagreen_core::people::study::answer::{Answer, Measured, Record, is_right};
use shagreen_core::people::study::plan::Plan;

use self::values::{Row, rows};
use crate::named_table::write_table;

/// Columns of the table.
const COLUMNS: [&str; 21] = [
    "participant",
    "number",
    "simulated",
    "part",
    "design",
    "trial",
    "practice",
    "stimulus",
    "other_stimulus",
    "item",
    "presented",
    "value",
    "right",
    "response_s",
    "latency_ms",
    "distance_mm",
    "mean_speed_mm_per_s",
    "mean_force_n",
    "plays",
    "device",
    "stimulus_hashes",
];

/// Writes the answers of all participants as a tidy table. Answers to parts that the plan does not have are left out.
pub fn tidy_csv(plan: &Plan, records: &[Record]) -> Vec<u8> {
    let first = COLUMNS.map(str::to_owned).to_vec();
    let of_record = |record: &Record| -> Vec<Vec<String>> {
        record.answers.iter().flat_map(|answer| table_rows(plan, record, answer)).collect()
    };
    write_table(std::iter::once(first).chain(records.iter().flat_map(of_record)))
}

fn table_rows(plan: &Plan, record: &Record, answer: &Answer) -> Vec<Vec<String>> {
    let Some(part) = plan.part(&answer.trial.part) else { return Vec::new() };
    let trial = &answer.trial;
    let begin = [
        record.participant.clone(),
        record.number.to_string(),
        flag(record.is_simulated),
        part.id.clone(),
        part.design.id().to_owned(),
        trial.number.to_string(),
        flag(trial.is_practice),
    ];
    let right = is_right(&trial.task, &answer.response).map_or_else(String::new, flag);
    let end = measured_fields(&answer.measured);
    let with_ends = |row: Row| {
        let middle = [row.stimulus, row.other_stimulus, row.item, row.presented, row.value, right.clone()];
        begin.iter().cloned().chain(middle).chain(end.iter().cloned()).collect()
    };
    rows(&part.design, &trial.task, &answer.response).into_iter().map(with_ends).collect()
}

fn measured_fields(measured: &Measured) -> [String; 8] {
    let motion = measured.motion;
    let plays: Vec<String> = measured.n_plays.iter().map(ToString::to_string).collect();
    [
        number(measured.response_secs),
        number(measured.latency_secs.map(|secs| 1e3 * secs)),
        number(motion.map(|motion| 1e3 * motion.distance_m)),
        number(motion.map(|motion| 1e3 * motion.mean_speed_mps)),
        number(motion.map(|motion| motion.mean_force_n)),
        plays.join(" "),
        measured.device.clone(),
        measured.stimulus_hashes.join(" "),
    ]
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

fn flag(is_set: bool) -> String {
    u8::from(is_set).to_string()
}

#[cfg(test)]
mod tests;
