//! What a user can ask for, and the keys that ask for it.

use std::path::PathBuf;

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::import::source::Source;
use crate::leaving::Leave;
use crate::prompt::PromptCommand;
use shagreen_core::heat_map::Quantity;
use shagreen_formats::gallery::GalleryProject;

use crate::compare::{CompareCommand, Side};
use crate::edit::Edit;
use crate::recorded_stroke::StrokeCommand;
use crate::rig::Rig;
use crate::save::FigureFile;
use crate::signals::SignalsCommand;
use crate::strings::commands as strings;
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
    /// Hold what the scope shows, or show what is played again.
    ToggleFreeze,
    /// Silence the output, or sound again.
    ToggleMute,
    /// Change between the dark and the light theme.
    ToggleTheme,
    /// The message at the foot was read.
    DismissMessage,
    /// Look for outputs again.
    ListOutputs,
    /// Open the output with this identity.
    OpenOutput(String),
    /// Open the sheet of devices.
    OpenDevices,
    /// Show what is known of the texture of the list with this identifier.
    OpenTexture(String),
    /// The same, with the keyboard in its name.
    RenameTexture(String),
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
    /// The same for files dropped on the canvas: recordings find their places.
    ImportHere(Vec<Source>),
    /// Read these files as sortings, ratings or votes.
    ReadJudgments(Vec<Source>),
    /// Open the sheet that saves the library.
    OpenSave,
    /// Open the sheet that saves a figure.
    SaveFigure(FigureFile),
    /// Close the sheet that is open.
    CloseSheet,
    /// Make a photo the picture of the selected texture.
    ReadPhoto(Source),
    /// Show a map behind the canvas, or none.
    ShowMap(Option<Quantity>),
    /// Compare authored textures.
    Compare(CompareCommand),
    /// Show the keys.
    OpenShortcuts,
    /// Begin the tour.
    BeginTour,
    /// Something about the signals of the bench.
    Signals(SignalsCommand),
    /// Something about prompts and photos.
    Prompt(PromptCommand),
    /// Something about recorded strokes.
    Stroke(StrokeCommand),
    /// Something about files.
    File(FileCommand),
}

/// What can be asked about files.
#[derive(Clone, Debug)]
pub enum FileCommand {
    /// Begin a new project.
    New,
    /// Open the gallery.
    OpenGallery,
    /// Begin with a project of the gallery.
    BeginFromGallery(GalleryProject),
    /// Open the sheet that opens files.
    AskWhatToOpen,
    /// Open a project or a library.
    Open(PathBuf),
    /// Write the project to its file.
    Save,
    /// New projects begin like this file, or as usual.
    SetTemplate(Option<PathBuf>),
    /// Ask where to write the project.
    SaveAs,
    /// Write the project to this file from now on.
    SaveTo(PathBuf),
    /// Save what is heard as a signal.
    ExportSignal,
    /// Make the library a part of the project.
    KeepLibraryInside,
    /// Close the program.
    Quit,
    /// Save, and then leave the project.
    SaveAndLeave(Leave),
    /// Leave the project as its file has it.
    LeaveUnsaved(Leave),
    /// Open what a program left behind, by its place in the list.
    Recover(usize),
    /// Take away what a program left behind, by its place in the list.
    Discard(usize),
}

/// The commands that have a key.
pub const WITH_KEYS: [Command; 20] = [
    Command::File(FileCommand::New),
    Command::File(FileCommand::AskWhatToOpen),
    Command::File(FileCommand::Save),
    Command::File(FileCommand::SaveAs),
    Command::File(FileCommand::Quit),
    Command::Undo,
    Command::Redo,
    Command::Show(Workspace::Author),
    Command::Show(Workspace::Build),
    Command::Show(Workspace::Signals),
    Command::TogglePathTool,
    Command::Compare(CompareCommand::Hear(Side::A)),
    Command::Compare(CompareCommand::Hear(Side::B)),
    Command::Compare(CompareCommand::Hear(Side::X)),
    Command::ToggleHand,
    Command::ToggleFreeze,
    Command::ToggleMute,
    Command::ToggleTheme,
    Command::OpenDevices,
    Command::OpenShortcuts,
];

impl Command {
    /// The keys that ask for it.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::File(FileCommand::New) => (Modifiers::COMMAND, Key::N),
            Self::File(FileCommand::AskWhatToOpen) => (Modifiers::COMMAND, Key::O),
            Self::File(FileCommand::Save) => (Modifiers::COMMAND, Key::S),
            Self::File(FileCommand::SaveAs) => (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::S),
            Self::File(FileCommand::Quit) => (Modifiers::COMMAND, Key::Q),
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
            Self::Show(Workspace::Author) => (Modifiers::COMMAND, Key::Num1),
            Self::Show(Workspace::Build) => (Modifiers::COMMAND, Key::Num2),
            Self::Show(Workspace::Signals) => (Modifiers::COMMAND, Key::Num3),
            Self::TogglePathTool => (Modifiers::NONE, Key::P),
            Self::Compare(CompareCommand::Hear(Side::A)) => (Modifiers::NONE, Key::Num1),
            Self::Compare(CompareCommand::Hear(Side::B)) => (Modifiers::NONE, Key::Num2),
            Self::Compare(CompareCommand::Hear(Side::X)) => (Modifiers::NONE, Key::Num3),
            Self::ToggleHand => (Modifiers::NONE, Key::Space),
            Self::ToggleFreeze => (Modifiers::NONE, Key::F),
            Self::ToggleMute => (Modifiers::NONE, Key::M),
            Self::ToggleTheme => (Modifiers::COMMAND, Key::T),
            Self::OpenDevices => (Modifiers::COMMAND, Key::D),
            Self::OpenShortcuts => (Modifiers::NONE, Key::F1),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// What those with keys do, in a few words.
    pub fn label(&self) -> Option<&'static str> {
        Some(match self {
            Self::File(FileCommand::New) => strings::NEW_PROJECT,
            Self::File(FileCommand::AskWhatToOpen) => strings::OPEN,
            Self::File(FileCommand::Save) => strings::SAVE,
            Self::File(FileCommand::SaveAs) => strings::SAVE_AS,
            Self::File(FileCommand::Quit) => strings::QUIT,
            Self::Undo => strings::UNDO,
            Self::Redo => strings::REDO,
            Self::Show(Workspace::Author) => strings::SHOW_AUTHOR,
            Self::Show(Workspace::Build) => strings::SHOW_BUILD,
            Self::Show(Workspace::Signals) => strings::SHOW_SIGNALS,
            Self::TogglePathTool => strings::DRAW_PATHS,
            Self::Compare(CompareCommand::Hear(Side::A)) => strings::HEAR_A,
            Self::Compare(CompareCommand::Hear(Side::B)) => strings::HEAR_B,
            Self::Compare(CompareCommand::Hear(Side::X)) => strings::HEAR_X,
            Self::ToggleHand => strings::STROKE,
            Self::ToggleFreeze => strings::FREEZE,
            Self::ToggleMute => strings::MUTE,
            Self::ToggleTheme => strings::THEME,
            Self::OpenDevices => strings::DEVICES,
            Self::OpenShortcuts => strings::SHORTCUTS,
            _ => return None,
        })
    }
}

/// The commands whose keys were pressed in this frame. Plain keys count while nothing has the keyboard, or `canvas` has:
/// on a button they are the button's own, in a text field they are text.
pub fn pressed(ctx: &egui::Context, canvas: egui::Id) -> Vec<Command> {
    let focused = ctx.memory(egui::Memory::focused);
    let plain_keys_are_ours = focused.is_none_or(|f| f == canvas);
    // Redo holds undo's keys and one more, as saving elsewhere does those of saving: they are asked first.
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
