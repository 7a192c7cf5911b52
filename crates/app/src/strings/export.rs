//! Export of textures and signals for other programs.

pub const EXPORT: &str = "Export…";
pub const EXPORT_HELP: &str = "Writes the audible texture, or all authored ones, for other programs: as the signal of a stroke, or as a texture model. The sheet lists what a format cannot store.";
pub const TITLE: &str = "Export textures";
pub const EXPORT_NOW: &str = "Export";
/// Accessible name of the path field.
pub const PATH: &str = "Path of the exported file";
pub const HINT: &str = "e.g. /path/to/texture";
pub const LOST: &str = "Not stored in the file:";
pub const NOTHING_LOST: &str = "The file stores the whole texture.";
pub const CHECKING: &str = "Checking what the file cannot store…";
/// Hint of the path of a folder.
pub const FOLDER_HINT: &str = "e.g. /path/to/folder";
pub const ALL_HELP: &str = "One file for each authored texture, with its name, in the folder below";

/// Added to the summary of an export into a folder that does not exist.
pub const NEW_FOLDER: &str = " The folder is created.";
/// What a file lacks of an authored texture whose path does not play.
pub const PATH_LOST: &str = "the path: the file has the texture at the point. To export the path as a WAV signal, select \"Play path\" above the space first";
/// What several files lack if each is scaled to its own peak.
pub const LEVELS_LOST: &str = "the differences in level between the textures: each file has its own full scale. Select \"One scale for all\" to keep them";

/// What the files lack of authored textures with these names, which have paths.
pub fn paths_lost(names: &[&str]) -> String {
    format!(
        "the paths of {}: the files have the textures at the points. To export a path as a WAV signal, select \"Play path\" above the space and export this texture alone",
        names.join(", ")
    )
}

/// Why the folder of the files cannot be created.
pub fn no_folder(reason: &str, folder: &str) -> String {
    format!("Cannot create the folder ({reason}). Choose another folder: {folder}")
}

/// Exported texture whose signal follows its path.
pub fn along_path(subject: &str) -> String {
    format!("{subject} along its path")
}

/// Name of a format with the ending of its files.
pub fn format(name: &str, ending: &str) -> String {
    format!("{name} (.{ending})")
}

/// Property that a format cannot store.
pub fn lost(property: &str) -> String {
    format!("• {property}")
}

/// Warning about written files.
pub fn warning(warning: &str) -> String {
    format!("Warning: {warning}")
}

/// Option that exports all authored textures.
pub fn all_of(n: usize) -> String {
    format!("All {n} authored textures")
}

/// Summary of the texture that is exported.
pub fn texture_to_save(name: &str, format: &str) -> String {
    format!("Saves \"{name}\" as {format}.")
}

/// First line of the sheet: the exported texture, or the number of all authored ones.
pub fn subject(name: &str, is_solo: bool, n_all: Option<usize>) -> String {
    match n_all {
        Some(n) => format!("Exports all {n} authored textures"),
        None if is_solo => format!("Exports \"{name}\" of the list (solo)"),
        None => format!("Exports \"{name}\""),
    }
}

/// Summary of an export of `n` textures into files with these names.
pub fn all_to_save(names: &str, n: usize, format: &str) -> String {
    format!("Saves {n} files in this folder as {format}: {names}")
}

/// Number of files that are not named, after those that are.
pub fn and_more(n: usize) -> String {
    format!(" and {n} more")
}

/// Question before `n` files of the same format with these names are replaced.
pub fn exists(names: &str, n: usize) -> String {
    match n {
        1 => format!("{names} exists. Replace it, or choose another path."),
        n => format!("{n} files exist: {names}. Replace them, or choose another folder."),
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
