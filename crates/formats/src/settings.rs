//! Saved settings of a user and a machine, independent of the project: one JSON file.

mod study_settings;

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::layout;
use crate::own_json::check_density;
use crate::parser_words::plain;
use crate::path_json;
use crate::photo_networks::PhotoNetworks;
use crate::rig_settings::RigSettings;

pub use study_settings::{LogFolder, MAX_LOG_FOLDERS, PIXELS_PER_MM, StudySettings};

/// Nesting depth up to which values get their own lines.
const OPEN_DEPTH: usize = 2;

/// Number of recent projects that are saved.
pub const MAX_RECENT: usize = 12;
/// Number of recent prompts that are saved.
pub const MAX_PROMPTS: usize = 24;
/// Number of permitted libraries that are saved.
pub const MAX_LIBRARIES: usize = 200;

/// The saved settings.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Settings {
    /// Recently opened projects, newest first.
    #[serde(serialize_with = "path_json::serialize_all")]
    pub recent: Vec<PathBuf>,
    /// Whether the light theme is selected; `None` follows the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub is_light: Option<bool>,
    /// Whether the introduction was shown or skipped.
    pub has_seen_tour: bool,
    /// Scale factor of the user interface; `None` for the default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<f32>,
    /// The project that new projects start from.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "path_json::serialize_option")]
    pub template: Option<PathBuf>,
    /// The device setup; `None` if the user has not selected any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rig: Option<RigSettings>,
    /// Whether the point does not play while it is dragged.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_silent_while_dragging: bool,
    /// Whether a texture plays while the pointer rests on it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub plays_on_hover: bool,
    /// Whether animations are off; `None` follows the desktop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reduces_motion: Option<bool>,
    /// Identifiers of the hints that the user has learned and that do not appear any more.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub learned_hints: Vec<String>,
    /// Sizes of the panels that the user has moved.
    #[serde(skip_serializing_if = "PanelSizes::is_usual")]
    pub panels: PanelSizes,
    /// Recent prompts, newest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub prompts: Vec<KeptPrompt>,
    /// Networks that predict attributes from photos; `None` if the user has not selected any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub photo_networks: Option<PhotoNetworks>,
    /// File of the model that predicts d' of two signals; `None` for the built-in one.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "path_json::serialize_option")]
    pub quality_model: Option<PathBuf>,
    /// Libraries outside the folders of their projects that the user has permitted, newest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub libraries: Vec<PermittedLibrary>,
    /// What studies with people need to know about this machine.
    #[serde(skip_serializing_if = "StudySettings::is_usual")]
    pub studies: StudySettings,
    /// Fields of other versions.
    #[serde(flatten)]
    pub unknown: Map<String, Value>,
}

/// Sizes of panels of the window in points; `None` is the usual size. The window limits them to its ranges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PanelSizes {
    /// Width of the texture list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<f32>,
    /// Width of the inspector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inspector: Option<f32>,
    /// Height of the row with pad and scope.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stage: Option<f32>,
}

impl PanelSizes {
    /// Whether all panels have their usual sizes.
    fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    fn is_finite(&self) -> bool {
        [self.library, self.inspector, self.stage].into_iter().flatten().all(f32::is_finite)
    }
}

/// A prompt, and how a picture was generated from it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptPrompt {
    /// Text of the prompt.
    pub prompt: String,
    /// The random seed.
    pub seed: u64,
    /// Whether the user's diffusion model generated the picture.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_diffusion: bool,
}

/// A library that a project may read although it lies outside the folder of the project.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PermittedLibrary {
    /// Absolute path of the project.
    #[serde(serialize_with = "path_json::serialize")]
    pub project: PathBuf,
    /// Absolute path of the library.
    #[serde(serialize_with = "path_json::serialize")]
    pub library: PathBuf,
}

/// Why the device setup in a settings file is unknown. Without it, an actuator would be driven without its limits.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// The file is not a JSON object.
    #[error("it is not a JSON object ({})", plain(&.0.to_string()))]
    Format(serde_json::Error),
    /// The device setup has a form that this version does not know.
    #[error("its field \"rig\" is invalid or from another version: {}", plain(&.0.to_string()))]
    Rig(serde_json::Error),
}

impl Settings {
    /// Records that a project was opened or saved.
    pub fn note_project(&mut self, path: &Path) {
        // An absolute path is valid from every folder.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }

    /// Records that the project at a path may read a library outside its folder.
    pub fn permit_library(&mut self, project: &Path, library: &Path) {
        let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let permitted = PermittedLibrary { project: absolute(project), library: absolute(library) };
        self.libraries.retain(|other| *other != permitted);
        self.libraries.insert(0, permitted);
        self.libraries.truncate(MAX_LIBRARIES);
    }

    /// Returns the libraries outside its folder that the project at a path may read.
    pub fn libraries_of(&self, project: &Path) -> Vec<PathBuf> {
        let project = std::path::absolute(project).unwrap_or_else(|_| project.to_owned());
        let of_project = self.libraries.iter().filter(|permitted| permitted.project == project);
        of_project.map(|permitted| permitted.library.clone()).collect()
    }

    /// Records a prompt.
    pub fn note_prompt(&mut self, kept: KeptPrompt) {
        self.prompts.retain(|other| *other != kept);
        self.prompts.insert(0, kept);
        self.prompts.truncate(MAX_PROMPTS);
    }
}

/// Reads settings, each independently: an unreadable one takes its default. An unreadable device setup is also returned
/// as an error.
pub fn read_settings(bytes: &[u8]) -> (Settings, Option<SettingsError>) {
    if check_density(bytes).is_err() {
        let error = serde::de::Error::custom("it has more values than settings need");
        return (Settings::default(), Some(SettingsError::Format(error)));
    }
    let mut all: Map<String, Value> = match serde_json::from_slice(bytes) {
        Ok(all) => all,
        Err(error) => return (Settings::default(), Some(SettingsError::Format(error))),
    };
    let (rig, error) = match all.remove("rig").map(serde_json::from_value).transpose() {
        Ok(rig) => (rig.flatten(), None),
        Err(error) => (None, Some(SettingsError::Rig(error))),
    };
    let settings = Settings {
        recent: taken(&mut all, "recent")
            .map(|paths: Vec<Value>| paths.iter().filter_map(path_json::from_json).collect())
            .unwrap_or_default(),
        is_light: taken(&mut all, "is_light"),
        has_seen_tour: taken(&mut all, "has_seen_tour").unwrap_or_default(),
        is_silent_while_dragging: taken(&mut all, "is_silent_while_dragging").unwrap_or_default(),
        plays_on_hover: taken(&mut all, "plays_on_hover").unwrap_or_default(),
        reduces_motion: taken(&mut all, "reduces_motion"),
        learned_hints: taken(&mut all, "learned_hints").unwrap_or_default(),
        scale: taken(&mut all, "scale").filter(|scale: &f32| scale.is_finite()),
        template: taken(&mut all, "template").and_then(|path: Value| path_json::from_json(&path)),
        panels: taken(&mut all, "panels").filter(PanelSizes::is_finite).unwrap_or_default(),
        prompts: taken(&mut all, "prompts").unwrap_or_default(),
        photo_networks: taken(&mut all, "photo_networks")
            .and_then(|networks: Value| PhotoNetworks::from_json(&networks)),
        quality_model: taken(&mut all, "quality_model").and_then(|path: Value| path_json::from_json(&path)),
        libraries: taken(&mut all, "libraries")
            .map(|all: Vec<Value>| all.iter().filter_map(permitted_library).collect())
            .unwrap_or_default(),
        studies: taken(&mut all, "studies").map(StudySettings::checked).unwrap_or_default(),
        rig,
        unknown: all,
    };
    (settings, error)
}

/// Merges settings by key: those that changed from `base` to `ours` are ours, the others are `theirs`. Lists of recent
/// things keep both. Two windows therefore do not undo each other's settings.
pub fn merged(base: &Settings, ours: &Settings, theirs: Settings) -> Settings {
    Settings {
        recent: joined(&base.recent, &ours.recent, theirs.recent, MAX_RECENT),
        is_light: newer(&base.is_light, &ours.is_light, theirs.is_light),
        has_seen_tour: ours.has_seen_tour || theirs.has_seen_tour,
        is_silent_while_dragging: newer(
            &base.is_silent_while_dragging,
            &ours.is_silent_while_dragging,
            theirs.is_silent_while_dragging,
        ),
        plays_on_hover: newer(&base.plays_on_hover, &ours.plays_on_hover, theirs.plays_on_hover),
        reduces_motion: newer(&base.reduces_motion, &ours.reduces_motion, theirs.reduces_motion),
        learned_hints: joined(&base.learned_hints, &ours.learned_hints, theirs.learned_hints, usize::MAX),
        scale: newer(&base.scale, &ours.scale, theirs.scale),
        template: newer(&base.template, &ours.template, theirs.template),
        rig: newer(&base.rig, &ours.rig, theirs.rig),
        panels: newer(&base.panels, &ours.panels, theirs.panels),
        prompts: joined(&base.prompts, &ours.prompts, theirs.prompts, MAX_PROMPTS),
        photo_networks: newer(&base.photo_networks, &ours.photo_networks, theirs.photo_networks),
        quality_model: newer(&base.quality_model, &ours.quality_model, theirs.quality_model),
        libraries: joined(&base.libraries, &ours.libraries, theirs.libraries, MAX_LIBRARIES),
        studies: StudySettings::merged(&base.studies, &ours.studies, theirs.studies),
        unknown: theirs.unknown,
    }
}

/// Our value if it has changed, otherwise theirs.
fn newer<T: Clone + PartialEq>(base: &T, ours: &T, theirs: T) -> T {
    if base == ours { theirs } else { ours.clone() }
}

/// Our list with what theirs has in addition, if ours has changed, otherwise theirs.
fn joined<T: Clone + PartialEq>(base: &[T], ours: &[T], theirs: Vec<T>, most: usize) -> Vec<T> {
    if base == ours {
        return theirs;
    }
    let others = theirs.into_iter().filter(|item| !ours.contains(item));
    ours.iter().cloned().chain(others).take(most).collect()
}

fn permitted_library(wire: &Value) -> Option<PermittedLibrary> {
    let path = |name: &str| path_json::from_json(wire.get(name)?);
    Some(PermittedLibrary { project: path("project")?, library: path("library")? })
}

/// Removes and parses a setting whose loss is harmless.
fn taken<T: DeserializeOwned>(all: &mut Map<String, Value>, name: &str) -> Option<T> {
    // The user can select an unreadable setting again.
    all.remove(name).and_then(|value| serde_json::from_value(value).ok())
}

/// Serializes settings as JSON.
pub fn write_settings(settings: &Settings) -> Vec<u8> {
    layout::to_bytes(settings, OPEN_DEPTH)
}

#[cfg(test)]
mod tests;
