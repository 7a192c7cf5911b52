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
//! | `distance_mm`, `mean_speed_mm_per_s`, `mean_force_n` | movement of the hand; empty without contact |
//! | `touched_mm` | distance over each stimulus, separated by spaces |
//! | `plays` | how often the stimuli were started, separated by spaces |
//! | `device`, `stimulus_hashes` | actuator profile of this trial, hashes of what was presented |
//! | `output` | name of the output, or `no output` for the silent one |
//! | `actuator`, `masking_output` | actuator profile and output of the masking noise, or `none` |
//! | `pen` | name of the pen, or `pointer` |
//! | `screen` | `measured` or `assumed`: the scale of the screen |
//! | `program` | name and version of the program |
//!
//! An empty field was not measured, or is not stated by the log. [`crate::sorting_csv`] and [`crate::ratings_csv`] write the
//! tables from which a space is built, [`pairs_csv`] that of discriminated pairs.

mod devices;
mod pairs;
mod values;

use shagreen_core::people::study::answer::{Answer, Measured, Record, is_right};
use shagreen_core::people::study::plan::Plan;

use self::devices::device_fields;
use self::values::{Row, rows};
use crate::named_table::write_table;

pub use pairs::pairs_csv;

/// Columns of the table.
const COLUMNS: [&str; 28] = [
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
    "touched_mm",
    "plays",
    "device",
    "stimulus_hashes",
    "output",
    "actuator",
    "masking_output",
    "pen",
    "screen",
    "program",
];

/// Writes the answers of all participants as a tidy table. Answers to parts that the plan does not have are left out.
pub fn tidy_csv(plan: &Plan, records: &[Record]) -> Vec<u8> {
    let first = COLUMNS.map(str::to_owned).to_vec();
    let of_record = |record: &Record| -> Vec<Vec<String>> {
        let indices = 0..record.answers.len();
        indices.flat_map(|index| table_rows(plan, record, index)).collect()
    };
    write_table(std::iter::once(first).chain(records.iter().flat_map(of_record)))
}

/// Rows of one answer, by its index.
fn table_rows(plan: &Plan, record: &Record, index: usize) -> Vec<Vec<String>> {
    let answer: &Answer = &record.answers[index];
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
    let measured = measured_fields(&answer.measured);
    let devices = device_fields(record.setup_at(index));
    let with_ends = |row: Row| {
        let middle = [row.stimulus, row.other_stimulus, row.item, row.presented, row.value, right.clone()];
        let end = measured.iter().chain(&devices).cloned();
        begin.iter().cloned().chain(middle).chain(end).collect()
    };
    rows(&part.design, &trial.task, &answer.response).into_iter().map(with_ends).collect()
}

fn measured_fields(measured: &Measured) -> [String; 9] {
    let motion = measured.motion;
    let plays: Vec<String> = measured.n_plays.iter().map(ToString::to_string).collect();
    let touched: Vec<String> = measured.touched_m.iter().map(|meters| (1e3 * meters).to_string()).collect();
    [
        number(measured.response_secs),
        number(measured.latency_secs.map(|secs| 1e3 * secs)),
        number(motion.map(|motion| 1e3 * motion.distance_m)),
        number(motion.map(|motion| 1e3 * motion.mean_speed_mps)),
        number(motion.map(|motion| motion.mean_force_n)),
        touched.join(" "),
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
