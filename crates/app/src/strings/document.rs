//! Words about the file of a project.

/// A project without a file.
pub const UNTITLED: &str = "Untitled";
/// A thread ended without a word.
pub const BROKE_OFF: &str = "It broke off for no reason that is known; try again";
/// A file cannot be read.
pub const CANNOT_READ: &str = "The file cannot be read; check the path and your rights";
/// Neither of what can be opened.
pub const NEITHER: &str = "This is neither a project nor a texture library; choose another file, or import it as a recording or model";
/// A folder or a device.
pub const NO_FILE: &str = "This is no file; choose another";
/// The menu of files.
pub const FILE: &str = "File";
/// Begins a project.
pub const NEW: &str = "New";
/// What a new project is.
pub const NEW_HELP: &str =
    "A project of one texture on the starter library, or a copy of the one you chose to begin with";
/// Opens the sheet of files.
pub const OPEN: &str = "Open…";
/// Projects that were open.
pub const RECENT: &str = "Open again";
/// Writes the project.
pub const SAVE: &str = "Save";
/// Asks where to write the project.
pub const SAVE_AS: &str = "Save as…";
/// Makes the library a part of the project.
pub const KEEP_INSIDE: &str = "Keep library in the project";
/// What that is good for.
pub const KEEP_INSIDE_HELP: &str = "The file of the project then holds all textures, and can be passed on alone. Otherwise it only names its library.";
/// Makes the project what new ones begin like.
pub const TEMPLATE: &str = "Begin new projects like this";
/// What that does.
pub const TEMPLATE_HELP: &str = "New projects then begin as a copy of this one's file. Choose it again to begin with the starter library.";
/// It has no file.
pub const TEMPLATE_NEEDS_FILE: &str = "Save the project first: new ones begin as a copy of its file.";
/// Closes the program.
pub const QUIT: &str = "Quit";
/// The title of the sheet that opens a file.
pub const OPEN_TITLE: &str = "Open a project or a library";
/// The field for a path.
pub const OPEN_PATH: &str = "File to open";
/// What the field takes.
pub const OPEN_HINT: &str = "woods.shagreen, or a library.json";
/// Opens what the field says.
pub const OPEN_NOW: &str = "Open";
/// The folder above.
pub const UP: &str = "Folder above";
/// A folder is being read.
pub const LISTING: &str = "Reading the folder…";
/// Nothing to open in a folder.
pub const NOTHING_HERE: &str = "No project or library in this folder.";
/// A file is being read.
pub const OPENING: &str = "Opening…";
/// Leaves a sheet.
pub const CANCEL: &str = "Cancel";
/// The title of the sheet that asks before work is lost.
pub const LEAVE_TITLE: &str = "Save the changes first?";
/// Saves before it goes on.
pub const SAVE_FIRST: &str = "Save";
/// Goes on without saving.
pub const DO_NOT_SAVE: &str = "Don't save";
/// The title of the sheet that saves a project.
pub const SAVE_TITLE: &str = "Save the project";
/// The field for its path.
pub const SAVE_PATH: &str = "Project file";
/// What the field takes.
pub const SAVE_HINT: &str = "woods.shagreen";
/// The title of the sheet of what was left.
pub const RECOVERED_TITLE: &str = "Work that was not saved";
/// How it came about.
pub const RECOVERED_HELP: &str = "Shagreen ended without saving this. Recover one now; the others are offered again next time, unless you discard them.";
/// Opens what was left.
pub const RECOVER: &str = "Recover";
/// Takes away what was left.
pub const DISCARD: &str = "Discard";
/// Decides later.
pub const LATER: &str = "Later";
/// Changes that are in no file, in the title.
pub const CHANGED: &str = "changed since it was saved";

/// What would be lost.
pub fn would_be_lost(project: &str) -> String {
    format!("What you changed in \"{project}\" since it was saved is lost otherwise.")
}

/// A project would be replaced.
pub const EXISTS: &str = "There is a project of this name. Replace it?";

/// What is saved.
pub fn to_save(n_textures: usize, is_inside: bool) -> String {
    let textures = if n_textures == 1 {
        "1 authored texture".to_owned()
    } else {
        format!("{n_textures} authored textures")
    };
    let library = if is_inside { "with its library inside" } else { "its library by name" };
    format!("{textures}, {library}.")
}

/// A file of this name would be replaced by a project but is something else.
pub fn no_project(reason: &str) -> String {
    format!("There is a file of this name that is no project, and stays: {reason}")
}

/// What new projects begin like cannot be had.
pub fn no_template(reason: &str) -> String {
    format!(
        "New projects begin as usual until the one that you chose to begin with can be read, or another is chosen: {reason}"
    )
}

/// It is no project.
pub fn is_library(path: &str) -> String {
    format!("{path} is a texture library now")
}

/// Saving did not work.
pub fn not_saved(reason: &str) -> String {
    format!("Not saved: {reason}")
}

/// Where a project is kept, and whether all of it is.
pub fn kept_at(path: &str, is_changed: bool) -> String {
    if is_changed { format!("{path}\n{CHANGED}") } else { path.to_owned() }
}

/// How long ago something was written.
pub fn ago(secs: u64) -> String {
    match secs {
        0..60 => format!("{secs} s ago"),
        60..3600 => format!("{} min ago", secs / 60),
        3600..86_400 => format!("{} h ago", secs / 3600),
        _ => format!("{} days ago", secs / 86_400),
    }
}

/// Accessible name of a button about a piece of work.
pub fn about(verb: &str, name: &str) -> String {
    format!("{verb} {name}")
}

/// Autosave does not work.
pub fn no_recovery(reason: &str) -> String {
    format!("Work cannot be kept through a crash ({reason}): save often")
}
