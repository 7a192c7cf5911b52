//! The logs of a study: one file for each participant, in one folder.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::people::panel::simulated_name;
use shagreen_core::people::study::plan::Plan;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::study_log::{ReadLog, read_study_log, recover_study_log};

use crate::file::{ending_of, file_name, in_file, one_line, read_file};

/// Ending of the file name of a log.
pub const LOG_ENDING: &str = "jsonl";

/// A file of a folder of logs.
#[derive(Clone, Debug)]
pub struct ListedLog {
    /// Path of the file.
    pub path: PathBuf,
    /// The log, or why it cannot be read, in one line.
    pub log: Result<Box<ReadLog>, String>,
}

/// Folder of the logs of a plan file, unless another one is chosen: beside the plan, with its name and `-logs`.
pub fn usual_log_folder(plan: &Path) -> PathBuf {
    beside(plan, "logs")
}

/// Folder of the logs of simulated participants, unless another one is chosen, so that they do not lie among those of people:
/// beside the plan, with its name and `-logs-simulated`.
pub fn usual_simulated_log_folder(plan: &Path) -> PathBuf {
    beside(plan, "logs-simulated")
}

fn beside(plan: &Path, what: &str) -> PathBuf {
    let stem = plan.file_stem().unwrap_or_default().to_string_lossy();
    plan.with_file_name(format!("{stem}-{what}"))
}

/// Reads the log at a path.
///
/// # Errors
/// The file cannot be read, or it is not a log.
pub fn load_log(path: &Path) -> anyhow::Result<ReadLog> {
    let bytes = read_file(path, FileKind::Table)?;
    read_study_log(&bytes).with_context(|| in_file(path))
}

/// Reads the log at a path whose first line is damaged, with the text of the plan of its study.
///
/// # Errors
/// The file cannot be read, or it has no answers to trials of this plan.
pub(super) fn recover_log(path: &Path, plan_text: &str) -> anyhow::Result<ReadLog> {
    let bytes = read_file(path, FileKind::Table)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    recover_study_log(&bytes, plan_text, &name).with_context(|| in_file(path))
}

/// The logs of a folder, in the order of their names; none if the folder does not exist. Other files are ignored.
///
/// # Errors
/// The folder cannot be read.
pub fn list_logs(folder: &Path) -> anyhow::Result<Vec<ListedLog>> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let list = || -> std::io::Result<Vec<PathBuf>> {
        std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
    };
    let mut paths =
        list().context("cannot read the folder; check your permissions").with_context(|| in_file(folder))?;
    // A hidden file is a temporary one.
    paths.retain(|path| path.is_file() && ending_of(path) == LOG_ENDING && !file_name(path).starts_with('.'));
    paths.sort();
    let listed = |path: PathBuf| {
        let log = load_log(&path).map(Box::new).map_err(|error| one_line(&error));
        ListedLog { path, log }
    };
    Ok(paths.into_iter().map(listed).collect())
}

/// Checks that a session of a plan can be added to these logs.
///
/// # Errors
/// One of the logs belongs to another plan; the message names its file.
pub(super) fn check_same_study(plan: &Plan, logs: &[ListedLog]) -> anyhow::Result<()> {
    let other = logs.iter().find(|listed| listed.log.as_ref().is_ok_and(|log| log.plan != *plan));
    if let Some(ListedLog { path, .. }) = other {
        bail!(
            "the folder has the log of another study, or of an earlier version of this plan; choose another folder for the logs: {}",
            path.display()
        );
    }
    Ok(())
}

/// Number of the next participant of this kind, from 1, which determines the orders: the lowest one whose participants all
/// refused, so that Latin squares stay balanced, or else the one above those of all logs.
pub(super) fn next_number(logs: &[ListedLog], is_simulated: bool) -> usize {
    let (mut refused, mut taken) = (BTreeSet::new(), BTreeSet::new());
    let read = logs.iter().filter_map(|listed| listed.log.as_ref().ok());
    for log in read.filter(|log| log.header.is_simulated() == is_simulated) {
        let numbers = if log.has_refused() { &mut refused } else { &mut taken };
        numbers.insert(log.header.number());
    }
    let above = 1 + refused.iter().chain(&taken).max().copied().unwrap_or(0);
    // A log that cannot be read may have the number of its pseudonym.
    let is_unreadable = |number: &usize| {
        let name = format!("{}.{LOG_ENDING}", pseudonym(*number, is_simulated));
        logs.iter().any(|listed| listed.log.is_err() && file_name(&listed.path) == name)
    };
    let new = || (above..=above + logs.len()).find(|number| !is_unreadable(number)).unwrap_or(above);
    refused.difference(&taken).next().copied().unwrap_or_else(new)
}

/// First pseudonym, from that of this number on, that no file of the folder has.
pub(super) fn free_pseudonym(logs: &[ListedLog], number: usize, is_simulated: bool) -> String {
    let names: BTreeSet<String> = logs.iter().map(|listed| file_name(&listed.path)).collect();
    let is_free = |name: &String| !names.contains(&format!("{name}.{LOG_ENDING}"));
    let mut pseudonyms = (number..).map(|number| pseudonym(number, is_simulated));
    pseudonyms.find(is_free).unwrap_or_default()
}

/// Pseudonym of the participant with this number, from 1: `p01`, or `simulated-01` for a simulated one.
pub(super) fn pseudonym(number: usize, is_simulated: bool) -> String {
    if is_simulated { simulated_name(number) } else { format!("p{number:02}") }
}

/// Path of the log of a participant in a folder.
pub fn log_path(folder: &Path, participant: &str) -> PathBuf {
    folder.join(format!("{participant}.{LOG_ENDING}"))
}

/// Sentences about the lines of a log that are torn or damaged, each with the name of the file.
pub fn log_warnings(path: &Path, log: &ReadLog) -> Vec<String> {
    log.problems.iter().map(|problem| format!("{}, {problem}", file_name(path))).collect()
}
