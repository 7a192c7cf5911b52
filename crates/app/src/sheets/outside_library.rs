//! Question before a project reads a library outside its folder for the first time. Someone who sends a project can name
//! any file of this computer in it.

use std::path::PathBuf;

use egui::{Button, Context, Key, Label, RichText, TextEdit, Ui};
use shagreen_studio::file::{folder_of, shown_name};

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::command::{Command, FileCommand, LibraryAnswer};
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::state::files::Reading;
use crate::strings::document as strings;

/// Width of the sheet, in points.
const WIDTH: f32 = 520.0;

/// State of the question.
pub(crate) struct OutsideLibrarySheet {
    /// Path of the project.
    pub(crate) project: PathBuf,
    /// Path of the library that it names.
    pub(crate) library: PathBuf,
    /// Purpose of reading the project.
    pub(crate) reading: Reading,
    /// Path of another library, once the user chooses one.
    other: Option<String>,
    /// Whether the field of this path, which has just appeared, takes the keyboard focus.
    wants_focus: bool,
    browse: Browse,
    failure: Option<String>,
}

impl OutsideLibrarySheet {
    /// Question about the library of a project.
    pub(crate) fn new(project: PathBuf, library: PathBuf, reading: Reading) -> Self {
        let (other, wants_focus) = (None, false);
        Self { project, library, reading, other, wants_focus, browse: Browse::default(), failure: None }
    }

    /// Shows why the project could not be opened.
    pub(crate) fn say(&mut self, reason: String) {
        self.failure = Some(reason);
    }

    /// Draws the question; returns the requested commands. `is_opening` is true while a file is being read.
    pub(crate) fn show(&mut self, ctx: &Context, is_opening: bool) -> Vec<Command> {
        sheet(ctx, "outside library", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui, is_opening)
        })
        .inner
    }

    fn content_ui(&mut self, ui: &mut Ui, is_opening: bool) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut answer = None;
        let mut is_canceled = false;
        ui.add(Label::new(RichText::new(strings::OUTSIDE_TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        ui.add(Label::new(strings::outside(&shown_name(&self.project))).wrap());
        ui.add(Label::new(RichText::new(self.library.display().to_string()).strong()).wrap());
        ui.add_space(GAP);
        ui.add_enabled_ui(!is_opening, |ui| {
            answer = self.other_ui(ui);
            foot_ui(ui, |ui| {
                let read = ui.button(strings::READ_LIBRARY).on_hover_text(strings::READ_LIBRARY_HELP);
                if read.clicked() {
                    answer = Some(LibraryAnswer::Read);
                }
                let choose = Button::new(strings::CHOOSE_LIBRARY);
                let choose = ui.add_enabled(self.other.is_none(), choose);
                if choose.on_hover_text(strings::CHOOSE_LIBRARY_HELP).clicked() {
                    (self.other, self.wants_focus) = (Some(String::new()), true);
                    let folder = folder_of(&self.project);
                    self.browse.begin(ui.ctx(), &Asked { folder: Some(&folder), ..asked() });
                }
                let without = ui.button(strings::OPEN_WITHOUT).on_hover_text(strings::OPEN_WITHOUT_HELP);
                if without.clicked() {
                    answer = Some(LibraryAnswer::Without);
                }
                is_canceled = ui.button(strings::CANCEL).clicked();
            });
        });
        let message = if is_opening { Some(strings::OPENING) } else { self.failure.as_deref() };
        let color = if is_opening { t.text_weak } else { t.error };
        ui.add(Label::new(RichText::new(message.unwrap_or_default()).color(color)).wrap());
        if answer.is_some() {
            self.failure = None;
        }
        let answer = answer.map(|answer| Command::File(FileCommand::AnswerLibrary(answer)));
        answer.into_iter().chain(is_canceled.then_some(Command::CloseSheet)).collect()
    }

    /// Draws the field for the path of another library; returns the answer when a path is confirmed.
    fn other_ui(&mut self, ui: &mut Ui) -> Option<LibraryAnswer> {
        let other = self.other.as_mut()?;
        let folder = folder_of(&self.project);
        let (is_entered, chosen) = ui
            .horizontal(|ui| {
                let field = TextEdit::singleline(other).hint_text(strings::OTHER_LIBRARY_HINT);
                let field = ui.add(field.desired_width(ui.available_width() - BROWSE_WIDTH));
                if std::mem::take(&mut self.wants_focus) {
                    field.request_focus();
                }
                let asked = Asked { folder: Some(&folder), ..asked() };
                let chosen = self.browse.show(ui, strings::OTHER_LIBRARY, &asked);
                let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
                field.accessible_name(strings::OTHER_LIBRARY);
                (is_entered, chosen)
            })
            .inner;
        self.browse.missing_ui(ui);
        let path = other.trim();
        let is_named = !path.is_empty();
        let use_it = ui.add_enabled(is_named, Button::new(strings::USE_LIBRARY));
        let typed = (is_named && (use_it.clicked() || is_entered)).then(|| folder.join(path));
        chosen.into_iter().next().or(typed).map(LibraryAnswer::Instead)
    }
}

/// What the dialog of the system asks for.
fn asked() -> Asked<'static> {
    Asked {
        title: strings::CHOOSE_LIBRARY,
        kind: strings::OTHER_LIBRARY,
        endings: &["json"],
        ..Asked::default()
    }
}
