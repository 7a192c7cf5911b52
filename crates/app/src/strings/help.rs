//! Words of the tour and of the sheet of shortcuts.

use crate::tour::Step;

/// The menu of help.
pub const HELP: &str = "Help";
/// Opens the sheet of shortcuts.
pub const SHORTCUTS: &str = "Shortcuts";
/// Begins the tour.
pub const TOUR: &str = "Tour";
/// Leaves a sheet.
pub const CLOSE: &str = "Close";
/// Goes to the next step.
pub const NEXT: &str = "Next";
/// Ends the tour.
pub const DONE: &str = "Done";
/// Ends the tour before its end.
pub const SKIP: &str = "Skip tour";
/// Keys that are no commands, and what they do.
pub const MORE_KEYS: [(&str, &str); 6] = [
    ("Arrow keys", "Move the selected point (Shift: bigger steps)"),
    ("Tab", "Go to the next control"),
    ("Ctrl with + - 0", "Everything larger, smaller, as usual"),
    ("Wheel over the space", "Zoom"),
    ("Right or middle button", "Move the view of the space"),
    ("Wheel over the pad", "Force of mouse and hand"),
];

/// The heading and the words of a step.
pub fn step(step: Step) -> [&'static str; 2] {
    match step {
        Step::Drag => [
            "Drag the point",
            "Each place in this space is a texture: rough to the left, smooth to the right, hard below, soft above. Drag the \
             point, or click one of the pictures.",
        ],
        Step::Stroke => [
            "Feel it",
            "Stroke the large picture here with the mouse or a pen, or press Stroke and the hand does it. Devices… says where it plays: \
             to headphones at first, to a voice coil when you have one.",
        ],
        Step::Blend => [
            "See what it is made of",
            "Name it here, set its place in numbers, and see the textures that say most about it with their shares. S lets one \
             of them be heard alone.",
        ],
        Step::Keep => [
            "Keep it",
            "File saves the project, exports what you hear as WAV, and opens the gallery. Add, below, makes another texture to \
             compare with. Everything can be undone.",
        ],
    }
}

/// How far the tour is.
pub fn progress(number: usize, n_steps: usize) -> String {
    format!("{number} of {n_steps}")
}
