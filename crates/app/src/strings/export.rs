//! Export of textures and signals for other programs.

pub const EXPORT: &str = "Export…";
pub const EXPORT_HELP: &str = "Writes the audible texture, or all authored ones, for other programs: as WAV signals, or as texture models. The sheet lists what a format cannot store.";
pub const TITLE: &str = "Export textures";
pub const EXPORT_NOW: &str = "Export";
/// Accessible name of the path field.
pub const PATH: &str = "Path of the exported file";
pub const HINT: &str = "/path/to/texture";
pub const LOST: &str = "Not stored in the file:";
pub const NOTHING_LOST: &str = "The file stores the whole texture.";
pub const CHECKING: &str = "Checking what the file cannot store…";
pub const ALL_HELP: &str =
    "One file for each authored texture, with its name, in the folder of the path below";

/// Name of a format with the ending of its files.
pub fn format(name: &str, ending: &str) -> String {
    format!("{name} (.{ending})")
}

/// Property that a format cannot store.
pub fn lost(property: &str) -> String {
    format!("• {property}")
}

/// Option that exports all authored textures.
pub fn all_of(n: usize) -> String {
    format!("All {n} authored textures")
}

/// Summary of the texture that is exported.
pub fn texture_to_save(name: &str, format: &str) -> String {
    format!("Saves \"{name}\" as {format}.")
}

/// Summary of an export of all authored textures.
pub fn all_to_save(n: usize, format: &str) -> String {
    format!("Saves {n} files as {format}.")
}

/// Question before files of the same format are replaced: the one at the path, or `n` in its folder.
pub fn exists(n: usize, is_all: bool) -> String {
    match (n, is_all) {
        (_, false) => {
            "A file of this format exists at this path. Replace it, or choose another path.".to_owned()
        }
        (1, true) => {
            "One of the files exists in this folder. Replace it, or choose another folder.".to_owned()
        }
        (n, true) => {
            format!("{n} files of this format exist in this folder. Replace them, or choose another folder.")
        }
    }
}

/// Why a file is not replaced.
pub fn not_replaced(path: &str) -> String {
    format!("This file is of another kind and is not replaced. Choose another path: {path}")
}

/// Result of an export of several files.
pub fn saved_all(n: usize, folder: &str) -> String {
    format!("Saved {n} files in {folder}")
}

/// Reason why an authored texture cannot be exported.
pub fn of_texture(name: &str, reason: &str) -> String {
    format!("\"{name}\": {reason}")
}
