//! Project file that was changed by another window or program.

use crate::choices::conflict::{Change, Part};

pub const TITLE: &str = "The project file has changed";
pub const NO_PROJECT: &str = "The file is no longer a project that can be read.";
pub const NO_DIFFERENCE: &str = "Only the selection differs.";
pub const SAVE_AS_HELP: &str = "Saves this project under another name. The changed file stays.";
pub const RELOAD: &str = "Reload";
pub const RELOAD_HELP: &str = "Opens the changed file. The project of this window is kept in the recovery folder and is offered at the next start.";
pub const OVERWRITE: &str = "Overwrite";
pub const OVERWRITE_HELP: &str =
    "Replaces the changed file by this project. The changes in the file are lost.";

pub fn changed_since(project: &str) -> String {
    format!(
        "Another window or program has changed the file of \"{project}\" since you opened it. Nothing is saved yet. These parts differ:"
    )
}

pub fn part(part: &Part) -> &str {
    match part {
        Part::Texture(name) => name,
        Part::Library => "Library and added textures",
        Part::Space => "Space",
        Part::Notes => "Project notes",
        Part::Snapshots => "Snapshots",
        Part::Other => "Stars, order of the list, or other details",
    }
}

pub fn change(change: Change) -> &'static str {
    match change {
        Change::Here => "changed in this window",
        Change::There => "changed in the file",
        Change::Both => "different in this window and in the file",
        Change::AddedHere => "only in this window (added)",
        Change::AddedThere => "only in the file (added)",
        Change::RemovedHere => "only in the file (deleted here)",
        Change::RemovedThere => "only in this window (deleted in the file)",
    }
}

/// Why the changed file is not opened: the changes in the window would be lost.
pub fn not_kept(reason: &str) -> String {
    format!(
        "The file was not reloaded, because your changes cannot be kept ({reason}). Save them under another name first."
    )
}
