//! The logs of a study: one file for each participant, in one folder.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::people::panel::simulated_name;
use shagreen_core::people::study::plan::Plan;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::study_log::{LogHeader, ReadLog, read_study_log};

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
    let stem = plan.file_stem().unwrap_or_default().to_string_lossy();
    plan.with_file_name(format!("{stem}-logs"))
}

/// Reads the log at a path.
///
/// # Errors
/// The file cannot be read, or it is not a log.
pub fn load_log(path: &Path) -> anyhow::Result<ReadLog> {
    let bytes = read_file(path, FileKind::Table)?;
    read_study_log(&bytes).with_context(|| in_file(path))
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

/// Number of the next participant of this kind, from 1: above those of all logs. It determines the orders.
pub(super) fn next_number(logs: &[ListedLog], is_simulated: bool) -> usize {
    let headers = logs.iter().filter_map(|listed| listed.log.as_ref().ok()).map(|log| &log.header);
    let numbers = headers.filter(|header| header.is_simulated() == is_simulated).map(LogHeader::number);
    1 + numbers.max().unwrap_or(0)
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
