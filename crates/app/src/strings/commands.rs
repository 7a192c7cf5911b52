//! What commands with keys do, as the sheet of shortcuts says it.

/// A new project.
pub const NEW_PROJECT: &str = "New project";
/// The sheet of files.
pub const OPEN: &str = "Open a project or a library";
/// Writes the project.
pub const SAVE: &str = "Save the project";
/// Asks where.
pub const SAVE_AS: &str = "Save the project elsewhere";
/// Ends.
pub const QUIT: &str = "Quit";
/// Takes back.
pub const UNDO: &str = "Undo";
/// Does again.
pub const REDO: &str = "Redo";
/// The first workspace.
pub const SHOW_AUTHOR: &str = "Workspace Author";
/// The second workspace.
pub const SHOW_BUILD: &str = "Workspace Build";
/// The third workspace.
pub const SHOW_SIGNALS: &str = "Workspace Signals";
/// The path tool.
pub const DRAW_PATHS: &str = "Draw paths, or points again";
/// Compare.
pub const HEAR_A: &str = "Hear A, or the selected texture again; feel signal A";
/// Compare.
pub const HEAR_B: &str = "Hear B, or the selected texture again; feel signal B";
/// Compare.
pub const HEAR_X: &str = "Hear X, which is A or B";
/// The automatic hand.
pub const STROKE: &str = "Let the hand stroke, or stop it";
/// The scope.
pub const FREEZE: &str = "Freeze the scope, or let it run";
/// Silence.
pub const MUTE: &str = "Mute, or sound again";
/// The theme.
pub const THEME: &str = "Dark or light theme";
/// The devices.
pub const DEVICES: &str = "Devices";
/// This sheet.
pub const SHORTCUTS: &str = "These shortcuts";
