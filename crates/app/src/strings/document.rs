//! Project files: menu, opening, saving, and recovery.

pub const UNTITLED: &str = "Untitled";
pub const BROKE_OFF: &str = "The operation stopped unexpectedly; try again";
pub const CANNOT_READ: &str = "The file cannot be read; check its path and permissions";
pub const NEITHER: &str = "This is neither a project nor a texture library; choose another file, or import it as a recording or model";
pub const NO_FILE: &str = "This is a folder or a device, not a file; choose another path";

// File menu.
pub const FILE: &str = "File";
pub const NEW: &str = "New";
pub const NEW_HELP: &str =
    "Starts a project with one texture on the starter library, or a copy of your template project";
pub const OPEN: &str = "Open…";
pub const RECENT: &str = "Recent projects";
pub const SAVE: &str = "Save";
pub const SAVE_AS: &str = "Save as…";
pub const KEEP_INSIDE: &str = "Embed library in the project";
pub const KEEP_INSIDE_HELP: &str = "Stores all textures in the project file, so that the file can be shared alone. Otherwise the project only refers to its library.";
pub const TEMPLATE: &str = "Use as template for new projects";
pub const TEMPLATE_HELP: &str =
    "New projects start as a copy of this project's file. Choose it again to start with the starter library.";
pub const TEMPLATE_NEEDS_FILE: &str = "Save the project first: new projects start as a copy of its file.";
pub const QUIT: &str = "Quit";

// Opening.
pub const OPEN_TITLE: &str = "Open a project or library";
pub const OPEN_PATH: &str = "File to open";
pub const OPEN_HINT: &str = "woods.shagreen or library.json";
pub const OPEN_NOW: &str = "Open";
pub const UP: &str = "Parent folder";
pub const LISTING: &str = "Reading the folder…";
pub const NOTHING_HERE: &str = "No project or library in this folder.";
pub const OPENING: &str = "Opening…";
pub const CANCEL: &str = "Cancel";

// Saving.
pub const LEAVE_TITLE: &str = "Save the changes first?";
pub const SAVE_FIRST: &str = "Save";
pub const DO_NOT_SAVE: &str = "Don't save";
pub const SAVE_TITLE: &str = "Save the project";
pub const SAVE_PATH: &str = "Project file";
pub const SAVE_HINT: &str = "woods.shagreen";

// Recovery.
pub const RECOVERED_TITLE: &str = "Unsaved work";
pub const RECOVERED_HELP: &str = "Shagreen ended before this work was saved. Recover one project now; the others are offered again at the next start unless you discard them.";
pub const RECOVER: &str = "Recover";
pub const DISCARD: &str = "Discard";
pub const LATER: &str = "Later";
pub const CHANGED: &str = "changed since it was saved";

pub fn would_be_lost(project: &str) -> String {
    format!("Otherwise the unsaved changes in \"{project}\" are lost.")
}

pub const EXISTS: &str = "A project of this name exists. Replace it?";

pub fn to_save(n_textures: usize, is_inside: bool) -> String {
    let textures = if n_textures == 1 {
        "1 authored texture".to_owned()
    } else {
        format!("{n_textures} authored textures")
    };
    let library = if is_inside { "with the library embedded" } else { "with a reference to the library" };
    format!("{textures}, {library}.")
}

/// Why an existing file is not replaced by a project.
pub fn no_project(reason: &str) -> String {
    format!("A file of this name exists, is not a project, and is not replaced: {reason}")
}

/// Why new projects do not start from the template.
pub fn no_template(reason: &str) -> String {
    format!(
        "New projects start with the starter library until the template can be read or you choose another: {reason}"
    )
}

/// Why the template is no longer a project.
pub fn is_library(path: &str) -> String {
    format!("{path} is now a texture library")
}

pub fn not_saved(reason: &str) -> String {
    format!("Not saved: {reason}")
}

/// Path of the project, and whether it has unsaved changes.
pub fn kept_at(path: &str, is_changed: bool) -> String {
    if is_changed { format!("{path}\n{CHANGED}") } else { path.to_owned() }
}

pub fn ago(secs: u64) -> String {
    match secs {
        0..60 => format!("{secs} s ago"),
        60..3600 => format!("{} min ago", secs / 60),
        3600..86_400 => format!("{} h ago", secs / 3600),
        _ => format!("{} days ago", secs / 86_400),
    }
}

/// Accessible name of a button that acts on the project of this name.
pub fn about(verb: &str, name: &str) -> String {
    format!("{verb} {name}")
}

/// Warning that autosave does not work.
pub fn no_recovery(reason: &str) -> String {
    format!("Unsaved work cannot be recovered after a crash ({reason}): save often")
}
