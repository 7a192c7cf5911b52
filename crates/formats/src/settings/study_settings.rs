//! What studies with people need to know about a machine.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{joined, newer};
use crate::path_json;

/// What studies with people need to know about a machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StudySettings {
    /// Pixels of the screen per millimeter, measured with a card; `None` before the measurement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixels_per_mm: Option<f32>,
    /// Id of the output of the masking noise: the headphones of the participant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub masking_output: Option<String>,
    /// Folders of logs that the user has chosen for plans, newest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub log_folders: Vec<LogFolder>,
}

/// Folder that the user has chosen for the logs of a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LogFolder {
    /// Absolute path of the plan file.
    #[serde(serialize_with = "path_json::serialize", deserialize_with = "path_json::deserialize")]
    pub plan: PathBuf,
    /// Absolute path of the folder.
    #[serde(serialize_with = "path_json::serialize", deserialize_with = "path_json::deserialize")]
    pub folder: PathBuf,
}

/// Number of folders of logs that are saved.
pub const MAX_LOG_FOLDERS: usize = 200;
/// Possible densities of a screen, in pixels per millimeter: from a projector to the finest screens.
pub const PIXELS_PER_MM: std::ops::RangeInclusive<f32> = 0.5..=50.0;

impl StudySettings {
    /// Whether nothing is selected.
    pub(super) fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// Folder that the user has chosen for the logs of the plan at a path.
    pub fn log_folder_of(&self, plan: &Path) -> Option<&Path> {
        let plan = absolute(plan);
        self.log_folders.iter().find(|chosen| chosen.plan == plan).map(|chosen| chosen.folder.as_path())
    }

    /// Records the folder that the user has chosen for the logs of the plan at a path.
    pub fn choose_log_folder(&mut self, plan: &Path, folder: &Path) {
        let chosen = LogFolder { plan: absolute(plan), folder: absolute(folder) };
        self.log_folders.retain(|other| other.plan != chosen.plan);
        self.log_folders.insert(0, chosen);
        self.log_folders.truncate(MAX_LOG_FOLDERS);
    }

    /// The same without an impossible density.
    pub(super) fn checked(self) -> Self {
        Self { pixels_per_mm: self.pixels_per_mm.filter(|density| PIXELS_PER_MM.contains(density)), ..self }
    }

    /// As [`super::merged`].
    pub(super) fn merged(base: &Self, ours: &Self, theirs: Self) -> Self {
        Self {
            pixels_per_mm: newer(&base.pixels_per_mm, &ours.pixels_per_mm, theirs.pixels_per_mm),
            masking_output: newer(&base.masking_output, &ours.masking_output, theirs.masking_output),
            log_folders: joined(&base.log_folders, &ours.log_folders, theirs.log_folders, MAX_LOG_FOLDERS),
        }
    }
}

/// The path from the root. One whose folder cannot be found stays as it is.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
