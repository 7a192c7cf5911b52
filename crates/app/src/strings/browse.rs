//! Texts of the button that opens the file dialog of the system.

/// Button.
pub const BROWSE: &str = "Browse…";
/// Explanation of the button.
pub const BROWSE_HELP: &str = "Choose with the file dialog of the system";
/// Explanation on a system without a file dialog.
pub const MISSING: &str =
    "This system offers no file dialog (on Linux: a desktop portal or zenity). Type the path.";

/// Accessible name of the button beside the field of this name.
pub fn browse_for(of: &str) -> String {
    format!("Browse: {of}")
}
