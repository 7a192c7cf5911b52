//! About sheet: version, licenses, and where files lie.

pub const ABOUT: &str = "About Shagreen";
pub const PARTS: &str = "Licenses of the parts";
pub const FILES: &str = "Files on this computer";
pub const SETTINGS: &str = "Settings";
pub const UNSAVED: &str = "Unsaved work";
pub const NETWORKS: &str = "Networks";
pub const LOG: &str = "Log";
pub const NO_LOG: &str = "no file: messages go to the terminal";
pub const NOT_STORED: &str = "not stored";
pub const COPY: &str = "Copy";

pub fn version(version: &str) -> String {
    format!("Version {version}")
}

pub fn license(license: &str) -> String {
    format!("License: {license}")
}

/// Accessible name of the button that copies a path.
pub fn copy_path_of(name: &str) -> String {
    format!("Copy the path: {}", name.to_lowercase())
}
