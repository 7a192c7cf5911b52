//! Project files: menu, opening, saving, and recovery.

pub const UNTITLED: &str = "Untitled";
pub const BROKE_OFF: &str = "Opening or saving stopped unexpectedly. Try again.";
pub const CANNOT_READ: &str = "The file cannot be read; check its path and permissions";
pub const NEITHER: &str = "This is neither a project nor a texture library; choose another file, or import it as a recording or model";
pub const NO_FILE: &str = "This is a folder or a device, not a file; choose another path";

// File menu.
pub const FILE: &str = "File";
pub const NEW: &str = "New";
pub const NEW_HELP: &str = "Starts a project with one authored texture and the starter library. If a template is set, starts from a copy of it.";
pub const OPEN: &str = "Open…";
pub const RECENT: &str = "Recent projects";
pub const SAVE: &str = "Save";
/// Notice after the project was saved.
pub const SAVED: &str = "Saved";
pub const FOLDERS: &str = "Folders";
pub const FOLDERS_HELP: &str = "Lists recently used folders";
pub const SAVE_AS: &str = "Save as…";
pub const KEEP_INSIDE: &str = "Embed library in the project";
pub const KEEP_INSIDE_HELP: &str = "Stores all textures in the project file, so that you can share the file without its library. Otherwise the project only refers to the library.";
pub const DRAG_STROKE: &str = "Play while dragging and after clicks";
pub const DRAG_STROKE_HELP: &str =
    "The automatic stroke runs while the point is dragged, and for a moment after a click on a texture";
pub const HOVER: &str = "Play under the pointer";
pub const HOVER_HELP: &str = "A texture on the canvas plays while the pointer rests on it";
pub const TEMPLATE: &str = "Use as template for new projects";
pub const TEMPLATE_HELP: &str = "New projects start as a copy of this project's file. To stop using a template, choose this command again.";
pub const TEMPLATE_NEEDS_FILE: &str = "Save the project first: new projects start as a copy of its file.";
pub const QUIT: &str = "Quit";

// Name of the project.
pub const PROJECT_NOTES: &str = "Notes on the project";
pub const PROJECT_NOTES_HINT: &str = "What this project is for";

// Opening.
pub const OPEN_TITLE: &str = "Open a project or library";
pub const OPEN_KIND: &str = "Projects and libraries";
/// Accessible name of the path field.
pub const OPEN_PATH: &str = "File to open";
pub const OPEN_HINT: &str = "e.g. woods.shagreen or library.json";
pub const OPEN_NOW: &str = "Open";
pub const UP: &str = "Parent folder";
pub const LISTING: &str = "Reading the folder…";
pub const NOTHING_HERE: &str = "No file in this folder can be opened here.";
pub const OPENING: &str = "Opening… Escape cancels.";
pub const CANCEL: &str = "Cancel";

// Library outside the folder of its project.
pub const OUTSIDE_TITLE: &str = "Library outside the folder of the project";
pub const READ_LIBRARY: &str = "Read";
pub const READ_LIBRARY_HELP: &str =
    "Reads this library, now and whenever this project is opened on this computer";
pub const CHOOSE_LIBRARY: &str = "Choose another…";
pub const CHOOSE_LIBRARY_HELP: &str =
    "Opens the project with another library, which is stored when the project is saved";
pub const OPEN_WITHOUT: &str = "Open without";
pub const OPEN_WITHOUT_HELP: &str = "Opens a copy of the project with the starter library. Textures of the other library are missing, and its file is not read.";
/// Accessible name of the path field.
pub const OTHER_LIBRARY: &str = "Library file";
pub const OTHER_LIBRARY_HINT: &str = "e.g. library.json";
pub const USE_LIBRARY: &str = "Use this library";

/// Question before a project reads a library.
pub fn outside(project: &str) -> String {
    format!(
        "{project} reads a library outside its own folder. If someone sent you the project, this file did not come with it. Read it?"
    )
}

// Saving.
pub const LEAVE_PAINTING: &str = "Leave the painted signal?";
pub const PAINTING_LOST: &str = "Signal B in Signals was edited, and signals are not part of a project. To keep it, cancel, press Feel at B, and use File > Export.";
pub const LEAVE_IT: &str = "Leave it";
pub const LEAVE_TITLE: &str = "Save the changes first?";
pub const SAVE_FIRST: &str = "Save";
pub const DO_NOT_SAVE: &str = "Don't save";
pub const SAVE_TITLE: &str = "Save the project";
pub const SAVE_PATH: &str = "Project file";
pub const SAVE_HINT: &str = "e.g. woods.shagreen";

// Recovery.
pub const RECOVERED_TITLE: &str = "Unsaved work";
pub const RECOVERED_HELP: &str =
    "Shagreen ended before this work was saved. It is offered again at the next start unless you discard it.";
pub const RECOVERED_SEVERAL_HELP: &str = "Shagreen ended before this work was saved. Recover one project now; the others are offered again at the next start unless you discard them.";
pub const RECOVER: &str = "Recover";
pub const DISCARD: &str = "Discard";
pub const LATER: &str = "Later";
pub const NO_RECOVERY: &str = "there is no recovery folder";
pub const CHANGED: &str = "has unsaved changes";

pub fn would_be_lost(project: &str) -> String {
    format!("If you do not save, the changes in \"{project}\" are lost.")
}

pub const EXISTS: &str = "A project file exists at this path. Replace it, or choose another path.";

/// Says that the file of this name was not opened.
pub fn canceled(name: &str) -> String {
    format!("Opening {name} was canceled")
}

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
    format!("The file at this path is not a project and is not replaced ({reason}). Choose another path.")
}

/// Why new projects do not start from the template.
pub fn no_template(reason: &str) -> String {
    format!(
        "The template cannot be used, and the new project starts with the starter library. Choose another template, or restore its file: {reason}"
    )
}

/// Reason why the template cannot be used: its file is a library.
pub fn is_library(path: &str) -> String {
    format!("{path} is a texture library, not a project")
}

pub fn not_saved(reason: &str) -> String {
    format!("Not saved: {reason}")
}

/// Help of the project's name, followed by the notes on the project.
pub fn with_notes(help: &str, notes: &str) -> String {
    if notes.is_empty() { help.to_owned() } else { format!("{help}\n\n{notes}") }
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
    format!("Autosave does not work ({reason}). Save often: a crash would lose unsaved work.")
}
