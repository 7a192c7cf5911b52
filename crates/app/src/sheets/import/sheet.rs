//! Import sheet: files on the left, the selected one on the right, accept and cancel at the bottom.

use std::path::PathBuf;

use egui::{Align, Button, Checkbox, Context, Key, Label, Layout, RichText, TextEdit, Ui, UiBuilder, vec2};

use shagreen_studio::open::OTHER_ENDINGS;
use shagreen_studio::place_estimate::can_estimate;

use crate::browse::{Asked, Browse};
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::look::motion::busy_ui;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::look::together::at_right_ui;
use crate::sheets::folders_ui::folders_ui;
use crate::sheets::import::batch::{Batch, Content, State};
use crate::sheets::import::draft_ui::draft_ui;
use crate::sheets::import::files_ui::files_ui;
use crate::sheets::import::import_context::ImportContext;
use crate::sheets::import::model_ui::model_ui;
use crate::state::edit::Edit;
use crate::state::source::{Source, paths_in};
use crate::strings::import as strings;
use crate::strings::sentence;

/// Width of the list of files, in points.
const FILES_WIDTH: f32 = 212.0;
/// Margin around the sheet, in points.
const AROUND: f32 = 22.0;

/// State of the open sheet.
pub struct ImportSheet {
    batch: Batch,
    selected: Option<u64>,
    paths: String,
    for_all: bool,
    is_fresh: bool,
    /// Whether recordings get estimated positions, if the library permits that.
    are_placed: bool,
    /// Whether the library permits estimates; determined once.
    can_place: Option<bool>,
    /// Id of the latest file whose failure was shown.
    last_seen: u64,
    folders: Vec<PathBuf>,
    browse: Browse,
}

impl ImportSheet {
    /// A sheet without files.
    pub fn new(ctx: &Context) -> Self {
        Self {
            batch: Batch::new(ctx),
            selected: None,
            paths: String::new(),
            for_all: true,
            is_fresh: true,
            are_placed: false,
            can_place: None,
            last_seen: 0,
            folders: Vec::new(),
            browse: Browse::default(),
        }
    }

    /// Offers recently used folders.
    pub fn offer(&mut self, folders: Vec<PathBuf>) {
        self.folders = folders;
    }

    /// Lets recordings get estimated positions, unless the user turns this off.
    pub fn place_recordings(&mut self) {
        self.are_placed = true;
    }

    /// Reads more files in the background. Photos become a prompt.
    pub fn load(&mut self, sources: Vec<Source>) {
        if !sources.is_empty() {
            self.batch.load(sources);
        }
    }

    /// Files, and the textures made from them.
    pub fn batch(&self) -> &Batch {
        &self.batch
    }

    /// Draws the sheet; returns the requested commands.
    pub fn show(&mut self, ctx: &Context, around: ImportContext<'_>) -> Vec<Command> {
        let can_place = *self.can_place.get_or_insert_with(|| can_estimate(around.library));
        self.are_placed &= can_place;
        self.batch.place_in(self.are_placed.then_some(around.space_rate_hz));
        self.batch.collect();
        self.show_failure();
        let is_there = |id: &u64| self.batch.files().iter().any(|file| file.id == *id);
        self.selected = self.selected.filter(is_there).or(self.batch.files().first().map(|file| file.id));
        let size = ctx.content_rect().size() - vec2(2.0 * AROUND, 2.0 * AROUND);
        let inner = size - vec2(28.0, 28.0);
        let shown = sheet(ctx, "import sheet", |ui| {
            ui.set_min_size(inner);
            ui.set_max_size(inner);
            self.content_ui(ui, around)
        });
        let mut commands = shown.inner;
        let photos = self.batch.take_photos();
        if !photos.is_empty() {
            commands.push(Command::Prompt(PromptCommand::Look(photos)));
        }
        // The photos find their places behind the sheet. It stays for other files.
        if self.batch.has_only_photos() {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    /// Selects a file that was read in vain, so that its reason is visible.
    fn show_failure(&mut self) {
        let new = self.batch.files().iter().filter(|file| file.id > self.last_seen);
        let failed = new.clone().find(|file| self.batch.state(file) == State::Failed).map(|file| file.id);
        self.last_seen = new.map(|file| file.id).max().unwrap_or(self.last_seen);
        self.selected = failed.or(self.selected);
    }

    fn content_ui(&mut self, ui: &mut Ui, around: ImportContext<'_>) -> Vec<Command> {
        self.head_ui(ui);
        self.browse.missing_ui(ui);
        ui.add_space(GAP);
        let area = ui.available_rect_before_wrap();
        let foot = 34.0;
        let middle = egui::Rect::from_min_max(area.min, egui::pos2(area.right(), area.bottom() - foot - GAP));
        let (left, right) = middle.split_left_right_at_x(middle.left() + FILES_WIDTH);
        let right = egui::Rect::from_min_max(right.min + vec2(GROUP_GAP, 0.0), right.max);
        // Without files, the text about them is in the middle of the sheet.
        let right = if self.batch.files().is_empty() { middle } else { right };
        self.side_ui(&mut ui.new_child(UiBuilder::new().max_rect(left).layout(Layout::top_down(Align::Min))));
        let mut child = ui.new_child(UiBuilder::new().max_rect(right).layout(Layout::top_down(Align::Min)));
        self.chosen_ui(&mut child, around);
        let foot = egui::Rect::from_min_max(egui::pos2(area.left(), area.bottom() - foot), area.max);
        let builder = UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center));
        self.foot_ui(&mut ui.new_child(builder), around)
    }

    fn head_ui(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.allocate_ui_with_layout(vec2(FILES_WIDTH, 26.0), Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(FILES_WIDTH);
                ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
            });
            ui.add_space(GROUP_GAP - GAP);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let is_wanted =
                    ui.add_enabled(!self.paths.trim().is_empty(), Button::new(strings::READ)).clicked();
                let asked = Asked {
                    title: strings::TITLE,
                    kind: strings::KIND,
                    endings: &OTHER_ENDINGS,
                    several: true,
                    ..Asked::default()
                };
                let chosen = self.browse.show(ui, strings::PATHS, &asked);
                self.load(chosen.into_iter().map(Source::Path).collect());
                if let Some(folder) = folders_ui(ui, &self.folders) {
                    self.paths = folder.join("").display().to_string();
                    self.is_fresh = true;
                }
                let is_empty = self.batch.files().is_empty() && !self.batch.is_working();
                // Displayed as one line, but pasted lines stay separate.
                let field = TextEdit::singleline(&mut self.paths)
                    .hint_text(strings::PATHS_HINT)
                    .desired_width(f32::INFINITY);
                let field = ui.add(field).accessible_name(strings::PATHS).on_hover_text(strings::DROP_KINDS);
                if std::mem::take(&mut self.is_fresh) && (!self.paths.is_empty() || is_empty) {
                    field.request_focus();
                }
                let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
                if is_wanted || is_entered {
                    let paths = std::mem::take(&mut self.paths);
                    self.load(paths_in(&paths));
                }
                if is_entered {
                    field.request_focus();
                }
            });
        });
    }

    fn side_ui(&mut self, ui: &mut Ui) {
        if self.batch.n_recordings() > 1 {
            let mut are_one = self.batch.are_one();
            if ui.checkbox(&mut are_one, strings::ARE_ONE).on_hover_text(strings::ARE_ONE_HELP).changed() {
                self.batch.set_are_one(are_one);
            }
        }
        files_ui(ui, &mut self.batch, &mut self.selected);
    }

    fn chosen_ui(&mut self, ui: &mut Ui, around: ImportContext<'_>) {
        let t = tokens(ui.ctx());
        let Some(id) = self.selected else {
            self.empty_ui(ui);
            return;
        };
        let Some(file) = self.batch.file_mut(id) else { return };
        match &mut file.content {
            Content::Recording(_) => draft_ui(ui, &mut self.batch, id, &mut self.for_all, around),
            Content::Textures { entries, warnings, shown } => model_ui(ui, entries, warnings, shown, around),
            Content::Helper(note) => {
                ui.label(RichText::new(*note).color(t.text_weak));
            }
            Content::Failed(reason) => {
                ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
                ui.add(Label::new(RichText::new(strings::ACCEPTED).small().color(t.text_weak)).wrap());
            }
        }
    }

    /// Draws the text shown before the first file has been read.
    fn empty_ui(&self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        ui.add_space(0.38 * ui.available_height());
        ui.vertical_centered(|ui| {
            if self.batch.is_broken() {
                ui.add(Label::new(RichText::new(strings::BROKEN).color(t.error)).wrap());
            } else if self.batch.is_working() {
                ui.add(Label::new(RichText::new(strings::READING).color(t.text_weak)).selectable(false));
            } else {
                ui.add(Label::new(RichText::new(strings::DROP_HERE).heading()).selectable(false));
                let kinds = RichText::new(strings::DROP_KINDS).color(t.text_weak);
                ui.add(Label::new(kinds).wrap().selectable(false));
            }
        });
    }

    fn foot_ui(&mut self, ui: &mut Ui, around: ImportContext<'_>) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        if self.batch.is_working() {
            busy_ui(ui);
            ui.add(Label::new(RichText::new(strings::READING).small().color(t.text_weak)).selectable(false));
        } else if self.batch.is_broken() {
            ui.add(Label::new(RichText::new(strings::BROKEN).small().color(t.error)).selectable(false));
        }
        let is_left_out = |state: State| matches!(state, State::Failed);
        let waits = |state: State, file: u64| {
            state == State::Question && self.batch.draft_of(file).is_none_or(|draft| draft.fitted().is_none())
        };
        let files = self.batch.files().iter().map(|file| (self.batch.state(file), file.id));
        let n_left = files.filter(|(state, id)| is_left_out(*state) || waits(*state, *id)).count();
        let left_out = RichText::new(strings::left_out(n_left)).small().color(t.warning);
        ui.add(Label::new(left_out).selectable(false));
        if self.batch.has_recordings() {
            let can_place = self.can_place != Some(false);
            let tick = Checkbox::new(&mut self.are_placed, strings::PLACE_THEM);
            let tick = ui.add_enabled(can_place, tick);
            tick.on_hover_text(strings::PLACE_THEM_HELP).on_disabled_hover_text(strings::CANNOT_PLACE);
        }
        at_right_ui(ui, |ui| {
            let n_ready = self.batch.n_ready();
            if primary_ui(ui, &strings::add(n_ready), n_ready > 0).clicked() {
                let entries = self.batch.entries(around.library, around.space_rate_hz);
                commands.push(Command::Edit(Edit::AddTextures(entries)));
                commands.push(Command::CloseSheet);
            }
            if ui.button(strings::CANCEL).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
        commands
    }
}
