//! Commands of the user and their keyboard shortcuts.

pub mod axes;
pub mod clipboard;
pub mod networks;
pub mod prompt;
pub mod relief;
mod shortcuts;
pub mod signals;
pub mod stroke;
pub mod studies;

use std::path::PathBuf;

use egui::{Key, KeyboardShortcut, Modifiers};

pub use self::shortcuts::pressed;
pub(crate) use self::shortcuts::was_writing;
use crate::command::axes::AxesCommand;
use crate::command::clipboard::ClipboardCommand;
use crate::command::networks::NetworksCommand;
use crate::command::prompt::PromptCommand;
use crate::command::relief::ReliefCommand;
use crate::state::leave::Leave;
use crate::state::source::Source;
use shagreen_core::space::heat_map::Quantity;
use shagreen_formats::gallery::GalleryProject;
use shagreen_studio::export::WAV;

use crate::command::signals::SignalsCommand;
use crate::command::stroke::StrokeCommand;
use crate::command::studies::StudiesCommand;
use crate::state::blank_file::BlankFile;
use crate::state::compare::{CompareCommand, Side};
use crate::state::edit::Edit;
use crate::state::figure_file::FigureFile;
use crate::state::rig::Rig;
use crate::strings::{about, axes as axes_words, networks as networks_words, papers, relief as relief_words};
use crate::workspace::Workspace;

/// Command of the user, executed after the frame.
#[derive(Clone, Debug)]
pub enum Command {
    /// Changes the project.
    Edit(Edit),
    /// Undoes the last edit.
    Undo,
    /// Redoes the last undone edit.
    Redo,
    /// Shows a workspace.
    Show(Workspace),
    /// Turns the path tool of the canvas on or off.
    TogglePathTool,
    /// Makes the texture follow the path, or return to the point.
    PlayPath(bool),
    /// Adds the path as a texture to the list.
    KeepPath,
    /// Starts or stops the automatic stroke.
    ToggleHand,
    /// Freezes or resumes the scope.
    ToggleFreeze,
    /// Mutes or unmutes the output.
    ToggleMute,
    /// Switches between the dark and the light theme.
    ToggleTheme,
    /// Removes the message from the status bar.
    DismissMessage,
    /// Lists the outputs again.
    ListOutputs,
    /// Opens the output with this id.
    OpenOutput(String),
    /// Opens the devices sheet.
    OpenDevices,
    /// Duplicates the selected authored texture.
    DuplicateTexture,
    /// Turns the stroke while the point is dragged and after clicks on textures on or off.
    ToggleDragStroke,
    /// Turns the audition of the texture under the pointer on or off.
    ToggleHover,
    /// Turns animations off or on.
    ToggleMotion,
    /// Shows the details of the texture with this id.
    OpenTexture(String),
    /// Shows the details of the texture with this id, with the keyboard focus on its name.
    RenameTexture(String),
    /// Changes the device setup.
    SetRig(Box<Rig>),
    /// Plays a test tone instead of the texture.
    PlayTone {
        /// Frequency in Hz.
        frequency_hz: f64,
        /// Amplitude in m/s².
        amplitude_mps2: f64,
    },
    /// Stops the test tone.
    StopTone,
    /// Closes the output, so that another program or the calibration can use the device.
    LetGoOfOutput,
    /// Reopens the output that was closed by [`Command::LetGoOfOutput`].
    TakeOutputBack,
    /// Lists the pens again.
    ListPens,
    /// Resets the limiter, which silences the output after a fault.
    ResetLimiter,
    /// Takes over the output on which another Shagreen plays.
    TakeOverOutput,
    /// Opens the import sheet.
    OpenImport,
    /// Opens these files in the import sheet and predicts positions for the recordings.
    ImportHere(Vec<Source>),
    /// Reads these files as sortings, ratings or relevance votes.
    ReadJudgments(Vec<Source>),
    /// Opens the sheet that saves the library.
    OpenSave,
    /// Opens the sheet that saves a figure.
    SaveFigure(FigureFile),
    /// Opens the sheet that saves a blank table or the instructions of a questionnaire.
    SaveBlank(BlankFile),
    /// Closes the open sheet.
    CloseSheet,
    /// Sets a photo as the picture of the selected texture.
    ReadPhoto(Source),
    /// Shows a heat map behind the canvas, or none.
    ShowMap(Option<Quantity>),
    /// Compares authored textures.
    Compare(CompareCommand),
    /// Shows the keyboard shortcuts.
    OpenShortcuts,
    /// Opens the command palette.
    OpenPalette,
    /// Opens the guide.
    OpenGuide,
    /// Opens the sheet that repeats the procedures of papers.
    OpenPapers,
    /// Shows version, licenses, and paths of files.
    OpenAbout,
    /// Starts the tour.
    BeginTour,
    /// Selects the authored texture with this key and puts the keyboard focus on its name.
    RenameAuthored(u32),
    /// Selects the authored texture with this key and opens the export sheet.
    ExportAuthored(u32),
    /// Puts the keyboard focus on the name of the selected authored texture.
    RenameSelected,
    /// Deletes the selected authored texture, unless it is the last one.
    DeleteSelected,
    /// Command about the axes of the space.
    Axes(AxesCommand),
    /// Command about the clipboard.
    Clipboard(ClipboardCommand),
    /// Command of the Signals workspace.
    Signals(SignalsCommand),
    /// Command of the Studies workspace.
    Studies(StudiesCommand),
    /// Command about prompts and photos.
    Prompt(PromptCommand),
    /// Command about the networks that predict attributes from photos.
    Networks(NetworksCommand),
    /// Command about reliefs from pictures.
    Relief(ReliefCommand),
    /// Command about stroke recordings.
    Stroke(StrokeCommand),
    /// Command about files.
    File(FileCommand),
}

/// Command about files.
#[derive(Clone, Debug)]
pub enum FileCommand {
    /// Creates a project.
    New,
    /// Opens the gallery.
    OpenGallery,
    /// Creates a project from one of the gallery.
    BeginFromGallery(GalleryProject),
    /// Opens the sheet that opens files.
    AskWhatToOpen,
    /// Opens a project or a library.
    Open(PathBuf),
    /// Answers the question about a library outside the folder of its project.
    AnswerLibrary(LibraryAnswer),
    /// Saves the project to its file.
    Save,
    /// Sets the template of new projects; `None` removes it.
    SetTemplate(Option<PathBuf>),
    /// Asks for a path and saves the project there.
    SaveAs,
    /// Saves the project to this file, which becomes its file.
    SaveTo(PathBuf),
    /// Opens the export sheet with the format of this id.
    Export(&'static str),
    /// Embeds the library in the project.
    KeepLibraryInside,
    /// Closes the program.
    Quit,
    /// Saves the project and then leaves it.
    SaveAndLeave(Leave),
    /// Leaves the project without saving its changes.
    LeaveUnsaved(Leave),
    /// Opens the project file again, which another window or program has changed. The open project is kept aside.
    Reload,
    /// Saves the project over its changed file.
    Overwrite,
    /// Opens a recovered project, by its index in the list.
    Recover(usize),
    /// Deletes a recovered project, by its index in the list.
    Discard(usize),
}

/// Answer to the question whether a project may read a library outside its folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LibraryAnswer {
    /// The project may read it.
    Read,
    /// This library takes its place.
    Instead(PathBuf),
    /// A copy of the project opens on the starter library.
    Without,
}

/// Label and shortcut of a command.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Short description of the command.
    pub label: &'static str,
    /// Keyboard shortcut.
    pub shortcut: Option<KeyboardShortcut>,
}

impl Entry {
    const fn new(label: &'static str) -> Self {
        Self { label, shortcut: None }
    }

    const fn keys(self, modifiers: Modifiers, key: Key) -> Self {
        Self { shortcut: Some(KeyboardShortcut::new(modifiers, key)), ..self }
    }

    const fn key(self, key: Key) -> Self {
        self.keys(Modifiers::NONE, key)
    }

    const fn command(self, key: Key) -> Self {
        self.keys(Modifiers::COMMAND, key)
    }

    const fn command_shift(self, key: Key) -> Self {
        self.keys(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
    }
}

/// Commands of the palette and of the list of shortcuts, in this order. Each has an [`Entry`].
pub fn listed() -> impl Iterator<Item = Command> {
    let workspaces = Workspace::ALL.into_iter().map(Command::Show);
    FILES_AND_EDITS.into_iter().chain(workspaces).chain(OTHERS)
}

const FILES_AND_EDITS: [Command; 12] = [
    Command::File(FileCommand::New),
    Command::File(FileCommand::AskWhatToOpen),
    Command::File(FileCommand::OpenGallery),
    Command::File(FileCommand::Save),
    Command::File(FileCommand::SaveAs),
    Command::File(FileCommand::Export(WAV.id)),
    Command::File(FileCommand::KeepLibraryInside),
    Command::File(FileCommand::Quit),
    Command::OpenImport,
    Command::OpenSave,
    Command::Undo,
    Command::Redo,
];

const OTHERS: [Command; 33] = [
    Command::Clipboard(ClipboardCommand::Copy(None)),
    Command::Clipboard(ClipboardCommand::Cut(None)),
    Command::Clipboard(ClipboardCommand::Paste),
    Command::DuplicateTexture,
    Command::RenameSelected,
    Command::DeleteSelected,
    Command::ToggleDragStroke,
    Command::ToggleHover,
    Command::ToggleMotion,
    Command::OpenPalette,
    Command::Axes(AxesCommand::Open),
    Command::Axes(AxesCommand::Swap),
    Command::TogglePathTool,
    Command::KeepPath,
    Command::Relief(ReliefCommand::Begin(None, None)),
    Command::Compare(CompareCommand::Hear(Side::A)),
    Command::Compare(CompareCommand::Hear(Side::B)),
    Command::Compare(CompareCommand::Hear(Side::X)),
    Command::ToggleHand,
    Command::Stroke(StrokeCommand::AskWhatToOpen),
    Command::Stroke(StrokeCommand::Save),
    Command::ToggleFreeze,
    Command::ToggleMute,
    Command::ResetLimiter,
    Command::TakeOverOutput,
    Command::ToggleTheme,
    Command::OpenDevices,
    Command::Networks(NetworksCommand::Open),
    Command::OpenGuide,
    Command::OpenShortcuts,
    Command::BeginTour,
    Command::OpenPapers,
    Command::OpenAbout,
];

impl Command {
    /// Label and shortcut of a command in [`listed`].
    pub fn entry(&self) -> Option<Entry> {
        Some(match self {
            Self::File(FileCommand::New) => Entry::new("New project").command(Key::N),
            Self::File(FileCommand::AskWhatToOpen) => Entry::new("Open a project or library").command(Key::O),
            Self::File(FileCommand::OpenGallery) => Entry::new("Open the gallery"),
            Self::File(FileCommand::Save) => Entry::new("Save the project").command(Key::S),
            Self::File(FileCommand::SaveAs) => {
                Entry::new("Save the project under another name").command_shift(Key::S)
            }
            Self::File(FileCommand::Export(_)) => Entry::new("Export the texture"),
            Self::File(FileCommand::KeepLibraryInside) => Entry::new("Embed the library in the project"),
            Self::File(FileCommand::Quit) => Entry::new("Quit").command(Key::Q),
            Self::OpenImport => Entry::new("Import recordings and models"),
            Self::OpenSave => Entry::new("Save the library"),
            Self::Undo => Entry::new("Undo").command(Key::Z),
            Self::Redo => Entry::new("Redo").command_shift(Key::Z),
            Self::Show(workspace) => Entry::new(workspace.info().show).command(workspace.info().key),
            Self::OpenPalette => Entry::new("Find a command").command_shift(Key::P),
            Self::Axes(AxesCommand::Open) => Entry::new(axes_words::BUTTON),
            Self::Axes(AxesCommand::Swap) => Entry::new(axes_words::SWAP),
            Self::TogglePathTool => Entry::new("Turn the path tool on or off").key(Key::P),
            Self::KeepPath => Entry::new("Add the path as a texture"),
            Self::Relief(ReliefCommand::Begin(None, None)) => Entry::new(relief_words::TITLE),
            Self::Compare(CompareCommand::Hear(Side::A)) => {
                Entry::new("Play A in the comparison; in Signals: feel A").key(Key::Num1)
            }
            Self::Compare(CompareCommand::Hear(Side::B)) => {
                Entry::new("Play B in the comparison; in Signals: feel B").key(Key::Num2)
            }
            Self::Compare(CompareCommand::Hear(Side::X)) => {
                Entry::new("Play X (A or B at random) in the comparison").key(Key::Num3)
            }
            Self::ToggleHand => Entry::new("Start or stop the automatic stroke").key(Key::Space),
            Self::Stroke(StrokeCommand::AskWhatToOpen) => Entry::new("Open a stroke recording"),
            Self::Stroke(StrokeCommand::Save) => Entry::new("Save the stroke recording"),
            Self::ToggleFreeze => Entry::new("Freeze or resume the scope").key(Key::F),
            Self::ToggleMute => Entry::new("Mute or unmute").key(Key::M),
            Self::ResetLimiter => Entry::new("Reset the limiter after a fault"),
            Self::TakeOverOutput => Entry::new("Take over the output from another Shagreen"),
            Self::ToggleTheme => Entry::new("Switch between dark and light theme").command(Key::T),
            Self::OpenDevices => Entry::new("Devices").command_shift(Key::D),
            Self::Networks(NetworksCommand::Open) => Entry::new(networks_words::COMMAND),
            Self::Clipboard(ClipboardCommand::Copy(_)) => {
                Entry::new("Copy the authored texture").command(Key::C)
            }
            Self::Clipboard(ClipboardCommand::Cut(_)) => {
                Entry::new("Cut the authored texture").command(Key::X)
            }
            Self::Clipboard(ClipboardCommand::Paste) => {
                Entry::new("Paste an authored texture").command(Key::V)
            }
            Self::DuplicateTexture => Entry::new("Duplicate the authored texture").command(Key::D),
            Self::RenameSelected => Entry::new("Rename the authored texture").key(Key::F2),
            Self::DeleteSelected => Entry::new("Delete the authored texture").key(Key::Delete),
            Self::ToggleDragStroke => Entry::new("Play or be silent while dragging and after clicks"),
            Self::ToggleHover => Entry::new("Play textures under the pointer, or do not"),
            Self::ToggleMotion => Entry::new("Turn animations off or on"),
            Self::OpenGuide => Entry::new("Open the guide"),
            Self::OpenShortcuts => Entry::new("Keyboard shortcuts").key(Key::F1),
            Self::BeginTour => Entry::new("Start the tour"),
            Self::OpenPapers => Entry::new(papers::COMMAND),
            Self::OpenAbout => Entry::new(about::ABOUT),
            _ => return None,
        })
    }

    /// Keyboard shortcut.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        self.entry()?.shortcut
    }

    /// Keyboard shortcut as text, in the notation of this system; empty if there is none.
    pub(crate) fn shortcut_text(&self, ctx: &egui::Context) -> String {
        self.shortcut().map_or(String::new(), |keys| ctx.format_shortcut(&keys))
    }
}
