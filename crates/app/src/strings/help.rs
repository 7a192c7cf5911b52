//! Tour and shortcut sheet.

use crate::choices::tour::Step;

pub const HELP: &str = "Help";
pub const SHORTCUTS: &str = "Shortcuts";
pub const TOUR: &str = "Tour";
pub const CLOSE: &str = "Close";
pub const FIND_COMMAND: &str = "Find a command";
pub const NO_COMMAND: &str = "No command contains these words.";
pub const PALETTE: &str = "Commands";
pub const GUIDE: &str = "Guide";
pub const BACK: &str = "Back";
pub const NEXT: &str = "Next";
pub const DONE: &str = "Done";
pub const SKIP: &str = "Skip tour";

/// Keys and pointer actions that are not commands, with what they do.
pub const MORE_KEYS: [(&str, &str); 9] = [
    ("Arrow keys", "Move the selected point (Shift: larger steps)"),
    ("Tab", "Move the keyboard focus: title bar, status bar, stroke pad, scope, textures, inspector, space"),
    ("Escape", "Restore the state before a drag, end a comparison, or end solo"),
    ("Enter on a texture", "Play it alone"),
    ("Ctrl with + - 0", "Zoom the interface in or out, or reset it"),
    ("Wheel over the space", "Zoom the view of the space"),
    ("Right or middle button", "Pan the view of the space"),
    ("Menu or Shift+F10", "Open the menu of the focused control"),
    ("Wheel over the stroke pad", "Change the normal force of the mouse and the automatic stroke"),
];

/// Heading and text of a step.
pub fn step(step: Step) -> [&'static str; 2] {
    match step {
        Step::Drag => [
            "Drag the point",
            "Each point of this space is a texture: rough on the left, smooth on the right, hard at the bottom, soft at the \
             top. Drag the point to choose one. Click a picture to play it alone.",
        ],
        Step::Stroke => [
            "Feel it",
            "Stroke this pad with the mouse or a pen, or press Stroke for an automatic stroke. Devices… selects the output: \
             a voice-coil actuator, or headphones for a first try.",
        ],
        Step::Blend => [
            "See its contributions",
            "Name the texture here, set its position in numbers, and see the textures with the largest weights. \
             The S button plays one of them alone.",
        ],
        Step::Keep => [
            "Save it",
            "The File menu saves the project, exports the audible texture as WAV, and opens the gallery. The Add button creates \
             another texture for comparison. Every edit can be undone.",
        ],
    }
}

pub fn progress(number: usize, n_steps: usize) -> String {
    format!("{number} of {n_steps}")
}

/// Command that exports the texture in a format.
pub fn export_as(format: &str) -> String {
    format!("Export the texture as {format}")
}
