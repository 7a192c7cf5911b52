//! Commands of the Studies workspace.

use std::path::PathBuf;

use crate::state::source::Source;

/// Command of the Studies workspace.
#[derive(Clone, Debug)]
pub enum StudiesCommand {
    /// Shows the workspace and opens a plan: the first of these files.
    Open(Vec<Source>),
    /// Starts or resumes a session over the whole window.
    Start(SessionStart),
    /// Saves the logs of the open plan in this folder from now on.
    ChooseLogFolder(PathBuf),
    /// Hands the judgments of the analyzed participants to the Build workspace.
    UseInBuild,
    /// Remembers the measured scale of the screen, in pixels per millimeter.
    SetScale(f32),
    /// Selects the output of the masking noise, by id, or none.
    SelectMaskingOutput(Option<String>),
}

/// Session to start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SessionStart {
    /// The session of the next participant.
    Next,
    /// The session of this log.
    Resume(PathBuf),
    /// Only the practice trials, without a log.
    Practice,
    /// The session of a simulated participant with this seed; an interrupted one of the study goes on.
    Simulated(u64),
}
