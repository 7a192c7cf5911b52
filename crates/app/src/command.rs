//! What a user can ask for, and the keys that ask for it.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::import::source::Source;
use crate::project::Edit;
use crate::rig::Rig;
use crate::save::FigureFile;
use crate::workspace::Workspace;

/// A request of the user, carried out after the frame.
#[derive(Clone, Debug)]
pub enum Command {
    /// Change the project.
    Edit(Edit),
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// Show a workspace.
    Show(Workspace),
    /// Draw paths on the canvas, or leave that.
    TogglePathTool,
    /// Let the texture follow the path, or the point again.
    PlayPath(bool),
    /// Make a texture of the list of the path.
    KeepPath,
    /// Start or stop the automatic hand.
    ToggleHand,
    /// Silence the output, or sound again.
    ToggleMute,
    /// Change between the dark and the light theme.
    ToggleTheme,
    /// Look for outputs again.
    ListOutputs,
    /// Open the output with this identity.
    OpenOutput(String),
    /// Open the sheet of devices.
    OpenDevices,
    /// Take over another rig.
    SetRig(Box<Rig>),
    /// Play a tone in the place of the texture: frequency in Hz, amplitude in m/s².
    PlayTone {
        /// In Hz.
        frequency_hz: f64,
        /// In m/s².
        amplitude_mps2: f64,
    },
    /// End the tone.
    StopTone,
    /// Close the output, so that something else can have it.
    LetGoOfOutput,
    /// Open the output again that was let go of.
    TakeOutputBack,
    /// Look for pens again.
    ListPens,
    /// End the latched silence of the limiter.
    ResetLimiter,
    /// Open the sheet that imports files.
    OpenImport,
    /// Import these files, in the sheet.
    Import(Vec<Source>),
    /// Read these files as sortings, ratings or votes.
    ReadJudgments(Vec<Source>),
    /// Open the sheet that saves the library.
    OpenSave,
    /// Open the sheet that saves a figure.
    SaveFigure(FigureFile),
    /// Close the sheet that is open.
    CloseSheet,
}

/// The commands that have a key.
pub const WITH_KEYS: [Command; 9] = [
    Command::Undo,
    Command::Redo,
    Command::Show(Workspace::Author),
    Command::Show(Workspace::Build),
    Command::TogglePathTool,
    Command::ToggleHand,
    Command::ToggleMute,
    Command::ToggleTheme,
    Command::OpenDevices,
];

impl Command {
    /// The keys that ask for it.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
            Self::Show(Workspace::Author) => (Modifiers::COMMAND, Key::Num1),
            Self::Show(Workspace::Build) => (Modifiers::COMMAND, Key::Num2),
            Self::TogglePathTool => (Modifiers::NONE, Key::P),
            Self::ToggleHand => (Modifiers::NONE, Key::Space),
            Self::ToggleMute => (Modifiers::NONE, Key::M),
            Self::ToggleTheme => (Modifiers::COMMAND, Key::T),
            Self::OpenDevices => (Modifiers::COMMAND, Key::D),
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
