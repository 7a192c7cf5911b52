//! Sheet that opens a project, library, stroke, signal or model of d': with the file dialog of the system, by its path, or by
//! browsing folders in the sheet, since not every Linux system has such a dialog.

use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

use egui::{Button, Context, Key, Label, RichText, ScrollArea, TextEdit, Ui};
use shagreen_formats::project::EXTENSION;
use shagreen_formats::quality_model;

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::choices::signals::Slot;
use crate::command::signals::SignalsCommand;
use crate::command::stroke::StrokeCommand;
use crate::command::{Command, FileCommand};
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::signals::reading::SIGNAL_ENDINGS;
use crate::state::background::in_background;
use crate::state::recorded_stroke::TABLE_ENDINGS;
use crate::state::source::Source;
use crate::strings::{differences, document as strings, signals, stroke};

/// Height of the list, in points.
const LIST_HEIGHT: f32 = 260.0;

pub(crate) struct OpenSheet {
    wanted: Wanted,
    folder: PathBuf,
    path: String,
    entries: Option<Vec<Entry>>,
    listing: Option<Receiver<Vec<Entry>>>,
    is_focused: bool,
    failure: Option<String>,
    browse: Browse,
}

/// Type of file to open.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// Projects and libraries.
    Projects,
    /// Stroke recordings.
    Strokes,
    /// File that becomes a signal in a slot of the Signals workspace.
    Signal(Slot),
    /// Models of d'.
    Models,
}

impl Wanted {
    fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Projects => &[EXTENSION, "json"],
            Self::Strokes => &TABLE_ENDINGS,
            Self::Signal(_) => &SIGNAL_ENDINGS,
            Self::Models => &[quality_model::EXTENSION],
        }
    }

    fn dialog(self, folder: &Path) -> Asked<'_> {
        let (title, kind) = match self {
            Self::Projects => (strings::OPEN_TITLE, strings::OPEN_KIND),
            Self::Strokes => (stroke::OPEN_TITLE, stroke::OPEN_KIND),
            Self::Signal(_) => (signals::OPEN_TITLE, signals::OPEN_KIND),
            Self::Models => (differences::OPEN_MODEL_TITLE, differences::OPEN_MODEL_KIND),
        };
        Asked { title, kind, endings: self.endings(), folder: Some(folder), ..Asked::default() }
    }
}

/// File or folder that can be opened.
struct Entry {
    name: String,
    path: PathBuf,
    is_folder: bool,
}

impl OpenSheet {
    /// Sheet that opens a project or a library, starting in `folder`.
    pub(crate) fn new(folder: &Path, ctx: &Context) -> Self {
        Self::of(Wanted::Projects, folder, ctx)
    }

    /// Sheet that opens a stroke, starting in `folder`.
    pub(crate) fn of_strokes(folder: &Path, ctx: &Context) -> Self {
        Self::of(Wanted::Strokes, folder, ctx)
    }

    /// Sheet that opens a signal, starting in `folder`.
    pub(crate) fn of_signals(slot: Slot, folder: &Path, ctx: &Context) -> Self {
        Self::of(Wanted::Signal(slot), folder, ctx)
    }

    /// Sheet that opens a model of d', starting in `folder`.
    pub(crate) fn of_models(folder: &Path, ctx: &Context) -> Self {
        Self::of(Wanted::Models, folder, ctx)
    }

    fn of(wanted: Wanted, folder: &Path, ctx: &Context) -> Self {
        let mut sheet = Self {
            wanted,
            folder: PathBuf::new(),
            path: String::new(),
            entries: None,
            listing: None,
            is_focused: false,
            failure: None,
            browse: Browse::default(),
        };
        sheet.walk(folder, ctx);
        sheet.browse.begin(ctx, &wanted.dialog(folder));
        sheet
    }

    /// Whether the sheet opens a project or a library.
    pub(crate) fn is_for_projects(&self) -> bool {
        self.wanted == Wanted::Projects
    }

    /// Whether the sheet opens a stroke.
    pub(crate) fn is_for_strokes(&self) -> bool {
        self.wanted == Wanted::Strokes
    }

    /// Shows why the file could not be opened.
    pub(crate) fn say(&mut self, reason: String) {
        self.failure = Some(reason);
        // A disabled field has lost the keyboard focus.
        self.is_focused = false;
    }

    fn walk(&mut self, folder: &Path, ctx: &Context) {
        folder.clone_into(&mut self.folder);
        self.entries = None;
        let (folder, wanted) = (folder.to_owned(), self.wanted);
        self.listing = Some(in_background(ctx.clone(), move || entries_of(&folder, wanted)));
    }

    /// Draws the sheet; returns the requested commands. `is_opening` is true while a file is being read.
    pub(crate) fn show(&mut self, ctx: &Context, is_opening: bool) -> Vec<Command> {
        if let Some(entries) = self.listing.as_ref().and_then(|listing| listing.try_recv().ok()) {
            (self.entries, self.listing) = (Some(entries), None);
        }
        sheet(ctx, "open sheet", |ui| {
            ui.set_width(560.0);
            self.content_ui(ui, is_opening)
        })
        .inner
    }

    fn content_ui(&mut self, ui: &mut Ui, is_opening: bool) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        let (title, hint) = match self.wanted {
            Wanted::Projects => (strings::OPEN_TITLE, strings::OPEN_HINT),
            Wanted::Strokes => (stroke::OPEN_TITLE, stroke::OPEN_HINT),
            Wanted::Signal(_) => (signals::OPEN_TITLE, signals::OPEN_PATH_HINT),
            Wanted::Models => (differences::OPEN_MODEL_TITLE, differences::OPEN_MODEL_HINT),
        };
        ui.add(Label::new(RichText::new(title).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let mut browsed = Vec::new();
        let field = ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.path).hint_text(hint);
            let field = ui.add(field.desired_width(ui.available_width() - BROWSE_WIDTH));
            browsed = self.browse.show(ui, strings::OPEN_PATH, &self.wanted.dialog(&self.folder));
            field.accessible_name(strings::OPEN_PATH)
        });
        let field = field.inner;
        if !std::mem::replace(&mut self.is_focused, true) {
            field.request_focus();
        }
        let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        self.browse.missing_ui(ui);
        ui.add_space(GAP);
        let browsed = browsed.into_iter().next();
        let wanted =
            browsed.or(self.folder_ui(ui)).or_else(|| is_entered.then(|| self.folder.join(self.path.trim())));
        let message = if is_opening { Some(strings::OPENING) } else { self.failure.as_deref() };
        let color = if is_opening { t.text_weak } else { t.error };
        ui.add(Label::new(RichText::new(message.unwrap_or_default()).color(color)).wrap());
        let mut open = wanted;
        foot_ui(ui, |ui| {
            let is_named = !self.path.trim().is_empty();
            if primary_ui(ui, strings::OPEN_NOW, is_named && !is_opening).clicked() {
                open = Some(self.folder.join(self.path.trim()));
            }
            if ui.button(strings::CANCEL).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
        if let Some(path) = open.filter(|_| !is_opening) {
            self.failure = None;
            if path.is_dir() {
                self.path.clear();
                self.is_focused = false;
                self.walk(&path, ui.ctx());
            } else if !path.as_os_str().is_empty() {
                commands.push(match self.wanted {
                    Wanted::Projects => Command::File(FileCommand::Open(path)),
                    Wanted::Strokes => Command::Stroke(StrokeCommand::Read(vec![Source::Path(path)])),
                    Wanted::Signal(slot) => Command::Signals(SignalsCommand::Read(slot, Source::Path(path))),
                    Wanted::Models => Command::Signals(SignalsCommand::ReadModel(path)),
                });
            }
        }
        commands
    }

    /// Draws the folder and its entries; returns the path that was clicked.
    fn folder_ui(&self, ui: &mut Ui) -> Option<PathBuf> {
        let t = tokens(ui.ctx());
        let mut clicked = None;
        ui.horizontal(|ui| {
            let above = self.folder.parent();
            if ui.add_enabled(above.is_some(), Button::new(strings::UP)).clicked() {
                clicked = above.map(Path::to_owned);
            }
            let folder = RichText::new(self.folder.display().to_string()).color(t.text_weak);
            ui.add(Label::new(folder).truncate().selectable(false));
        });
        let list = ScrollArea::vertical()
            .max_height(LIST_HEIGHT)
            .min_scrolled_height(LIST_HEIGHT)
            .auto_shrink(false);
        list.show(ui, |ui| match &self.entries {
            None => drop(ui.label(strings::LISTING)),
            Some(entries) if entries.is_empty() => {
                ui.label(RichText::new(strings::NOTHING_HERE).color(t.text_weak));
            }
            Some(entries) => {
                for entry in entries {
                    let name = if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
                    if ui.selectable_label(false, name).clicked() {
                        clicked = Some(entry.path.clone());
                    }
                }
            }
        });
        clicked
    }
}

/// Folders, then files of the wanted type, each by name. Hidden entries are left out.
fn entries_of(folder: &Path, wanted: Wanted) -> Vec<Entry> {
    let endings = wanted.endings();
    // An unreadable folder shows no entries; a path can still be typed.
    let Ok(found) = std::fs::read_dir(folder) else { return Vec::new() };
    let entry = |entry: std::fs::DirEntry| {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let is_folder = path.is_dir();
        let is_ours = path.extension().is_some_and(|extension| endings.iter().any(|e| extension == *e));
        (!name.starts_with('.') && (is_folder || is_ours)).then_some(Entry { name, path, is_folder })
    };
    let mut entries: Vec<Entry> = found.filter_map(|each| entry(each.ok()?)).collect();
    entries.sort_by_key(|entry| (!entry.is_folder, entry.name.to_lowercase()));
    entries
}

#[cfg(test)]
mod tests {
    use super::{Wanted, entries_of};

    #[test]
    fn a_folder_shows_what_can_be_opened() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.shagreen", "A.json", "notes.txt", ".hidden.json"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("z")).unwrap();
        for (wanted, expected) in
            [(Wanted::Projects, &["z", "A.json", "b.shagreen"][..]), (Wanted::Strokes, &["z", "notes.txt"])]
        {
            let found = entries_of(folder.path(), wanted);
            assert_eq!(found.iter().map(|entry| entry.name.as_str()).collect::<Vec<_>>(), expected);
            assert!(entries_of(&folder.path().join("none"), wanted).is_empty());
        }
    }
}
