//! What a user can ask for: its text, its help and its keys in one place, for buttons and keyboard alike.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::project::Edit;
use crate::strings;

/// A request of the user, carried out after the frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Change the project.
    Edit(Edit),
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// Start or stop the automatic hand.
    ToggleHand,
    /// Silence the output, or sound again.
    ToggleMute,
    /// Change between the dark and the light theme.
    ToggleTheme,
    /// Open the output with this identity.
    OpenOutput(String),
    /// End the latched silence of the limiter.
    ResetLimiter,
}

/// The commands that have a key.
pub const WITH_KEYS: [Command; 5] =
    [Command::Undo, Command::Redo, Command::ToggleHand, Command::ToggleMute, Command::ToggleTheme];

impl Command {
    /// The words on its button.
    pub fn text(&self) -> &'static str {
        match self {
            Self::Edit(edit) => edit.label(),
            Self::Undo => strings::UNDO,
            Self::Redo => strings::REDO,
            Self::ToggleHand => strings::HAND_START,
            Self::ToggleMute => strings::MUTE,
            Self::ToggleTheme => strings::TO_LIGHT,
            Self::OpenOutput(_) => strings::OUTPUT,
            Self::ResetLimiter => strings::RESET_LIMITER,
        }
    }

    /// The keys that ask for it.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
            Self::ToggleHand => (Modifiers::NONE, Key::Space),
            Self::ToggleMute => (Modifiers::NONE, Key::M),
            Self::ToggleTheme => (Modifiers::COMMAND, Key::T),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }
}

/// The commands whose keys were pressed in this frame. Plain keys count while nothing has the keyboard, or `canvas` has:
/// on a button they are the button's own, in a text field they are text.
pub fn pressed(ctx: &egui::Context, canvas: egui::Id) -> Vec<Command> {
    let focused = ctx.memory(egui::Memory::focused);
    let plain_keys_are_ours = focused.is_none_or(|f| f == canvas);
    // Redo holds undo's keys and one more, so it is asked first.
    let has_shift = |c: &Command| c.shortcut().is_some_and(|s| s.modifiers.shift);
    let mut commands = WITH_KEYS.to_vec();
    commands.sort_by_key(|c| !has_shift(c));
    commands.retain(|command| {
        let Some(shortcut) = command.shortcut() else { return false };
        let plain = shortcut.modifiers == Modifiers::NONE;
        (plain_keys_are_ours || !plain) && ctx.input_mut(|i| i.consume_shortcut(&shortcut))
    });
    commands
}
