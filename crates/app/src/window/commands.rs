//! Execution of commands after a frame.

use std::sync::Arc;
use std::time::Instant;

use egui::Popup;
use shagreen_core::space::texture_path::UserPath;
use shagreen_formats::actuator_toml::built_in_actuators;
use shagreen_studio::export::WAV;
use shagreen_studio::file::shown_name;
use shagreen_studio::height_map::ReliefPlace;
use shagreen_studio::models::ModelFolder;

use super::Window;
use crate::author::inspector::name_field;
use crate::author::new_texture::copy_of;
use crate::author::texture_sheet::TextureSheet;
use crate::command::networks::NetworksCommand;
use crate::command::{Command, FileCommand};
use crate::look::motion;
use crate::look::notice::{clear_earlier_notice, clear_notice, show_notice};
use crate::look::text_selection::select_all;
use crate::panel::Panel;
use crate::session::OutputChoice;
use crate::session::kept_path::kept_path;
use crate::sheets::Sheet;
use crate::sheets::about_sheet::AboutSheet;
use crate::sheets::devices::DevicesSheet;
use crate::sheets::guide_sheet::GuideSheet;
use crate::sheets::networks_sheet::NetworksSheet;
use crate::sheets::palette::PaletteSheet;
use crate::sheets::papers_sheet::PapersSheet;
use crate::sheets::save::SaveSheet;
use crate::state::compare::CompareCommand;
use crate::state::edit::{Edit, name_of_snapshot};
use crate::state::lost_coordinates::{dropped_axes, unstated_axes};
use crate::strings::{authored, axes, document, stroke};
use crate::workspace::Workspace;

impl Window {
    fn open_devices(&mut self, ctx: &egui::Context) {
        match built_in_actuators() {
            Ok(actuators) => {
                self.session.list_outputs(ctx);
                self.session.list_pens(ctx);
                self.session.list_inputs(ctx);
                let sheet = DevicesSheet::new(self.session.rig(), actuators);
                self.sheet = Sheet::Devices(Box::new(sheet));
            }
            Err(error) => self.session.say(error.to_string()),
        }
    }

    /// Executes a command about the networks that predict attributes from photos.
    fn carry_out_networks(&mut self, command: NetworksCommand) {
        match command {
            NetworksCommand::Open => {
                let models = self.files.keeping.models.clone().map(ModelFolder::new);
                let sheet = NetworksSheet::new(self.files.settings.photo_networks.as_ref(), models);
                self.sheet = Sheet::Networks(Box::new(sheet));
            }
            NetworksCommand::Use(networks) => {
                self.files.settings.photo_networks = Some(networks.clone());
                self.prompts.use_networks(Some(networks));
            }
        }
    }

    fn toggle_theme(&mut self, ctx: &egui::Context) {
        let dark = ctx.theme() == egui::Theme::Dark;
        self.files.settings.is_light = Some(dark);
        ctx.set_theme(if dark { egui::Theme::Light } else { egui::Theme::Dark });
    }

    fn toggle_motion(&mut self, ctx: &egui::Context) {
        let is_reduced = !motion::is_reduced(ctx);
        self.files.settings.reduces_motion = Some(is_reduced);
        motion::set_reduced(ctx, is_reduced);
    }

    /// Adds a copy of the selected authored texture.
    fn duplicate(&mut self, ctx: &egui::Context) {
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let copy = copy_of(&panel, self.project.texture());
        self.carry_out(Command::Edit(Edit::Author(Box::new(copy))), ctx);
    }

    /// Selects an authored texture and its name, so that typing replaces the name.
    fn rename_authored(&mut self, key: u32, ctx: &egui::Context) {
        if key != self.project.texture().key {
            self.carry_out(Command::Edit(Edit::Select(key)), ctx);
        }
        // The inspector shows the selected texture, and not one that a comparison plays.
        self.compare.end();
        ctx.memory_mut(|memory| memory.request_focus(name_field()));
        select_all(ctx, name_field(), &self.project.texture().name);
    }

    /// Selects an authored texture and opens the export sheet, which exports what is audible, once its models are computed.
    fn export_authored(&mut self, key: u32, ctx: &egui::Context) {
        self.carry_out(Command::Edit(Edit::Select(key)), ctx);
        self.follow_project(ctx);
        self.pages.author.to_export = Some(key);
        self.open_awaited_export(ctx);
    }

    /// Opens the export sheet that waits for the models of an authored texture. Another audible texture, a sheet or another
    /// workspace ends the wait.
    pub(super) fn open_awaited_export(&mut self, ctx: &egui::Context) {
        let Some(key) = self.pages.author.to_export else { return };
        let is_wanted = self.heard_texture().is_some_and(|texture| texture.key == key)
            && !self.sheet.is_open()
            && self.pages.workspace == Workspace::Author;
        if is_wanted && self.session.is_preparing() {
            return;
        }
        self.pages.author.to_export = None;
        if is_wanted {
            self.carry_out(Command::File(FileCommand::Export(WAV.id)), ctx);
        }
    }

    /// Deletes the selected authored texture, unless the key may be meant for something else: for a point of the path, for a
    /// texture that plays alone, for an open menu, or for what a blind comparison plays.
    fn delete_selected(&mut self, ctx: &egui::Context) {
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let is_for_another = self.pages.author.canvas.tool.is_on
            || panel.solo().is_some()
            || Popup::is_any_open(ctx)
            || self.compare.is_hidden();
        if is_for_another || self.project.authored.len() < 2 {
            return;
        }
        self.carry_out(Command::Edit(Edit::Remove(self.project.texture().key)), ctx);
    }

    /// What the status bar says of an edit whose result may not be visible where the user looks.
    fn said_of(&self, edit: &Edit, ctx: &egui::Context) -> Option<String> {
        let keys = Command::Undo.shortcut_text(ctx);
        match edit {
            Edit::Remove(key) if self.project.authored.len() > 1 => {
                let removed = self.project.authored.iter().find(|texture| texture.key == *key);
                removed.map(|texture| authored::deleted(&texture.name, &keys))
            }
            Edit::RestoreSnapshot(index) => {
                let (number, name) = (index + 1, name_of_snapshot(&self.project, *index));
                let snapshot = self.project.snapshots.get(*index)?;
                Some(match &unstated_axes(&self.project, snapshot)[..] {
                    [] => authored::restored(number, name, &keys),
                    means => authored::restored_on(means, number, name, &keys),
                })
            }
            Edit::Author(texture) => {
                let means = unstated_axes(&self.project, texture);
                (!means.is_empty()).then(|| authored::added_on(&means, &texture.name, &keys))
            }
            _ => None,
        }
    }

    /// Executes a command about a comparison. A hidden texture does not begin with the sound of the previous one, which
    /// would reveal that they differ.
    fn carry_out_compare(&mut self, command: CompareCommand) {
        if matches!(command, CompareCommand::Hear(_)) {
            for texture in self.compare.textures() {
                self.session.prepare(texture);
            }
        }
        self.compare.carry_out(command);
        if self.compare.is_hidden() {
            self.session.fall_silent();
        }
    }

    /// Whether the path tool has drawn a path that can play, so that a stroke is meant for the path. Another texture that plays
    /// instead of the selected one has priority.
    fn draws_path(&self) -> bool {
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let is_other = panel.solo().is_some() || self.compare.heard().is_some();
        let route = self.project.texture().path.as_ref().and_then(UserPath::route);
        self.pages.author.canvas.tool.is_on && !is_other && route.is_some() && !self.session.is_path_playing()
    }

    /// Adds the path of the selected authored texture to the list of textures.
    fn keep_path(&mut self, ctx: &egui::Context) {
        match kept_path(&self.project, &self.session) {
            Some(Ok(entry)) => {
                self.carry_out(Command::Edit(Edit::AddTextures(vec![Arc::new(entry)])), ctx);
            }
            Some(Err(error)) => self.session.say(error.to_string()),
            None => {}
        }
    }

    /// Closes the open sheet, and remembers the folder of an export. A file that the sheet is opening is discarded.
    fn close_sheet(&mut self) {
        let folder = match &self.sheet {
            Sheet::Save(sheet) => sheet.folder_of_export(),
            Sheet::Export(sheet) => sheet.folder_of_export(),
            _ => None,
        };
        if let Some(folder) = folder {
            self.exports_folder = folder.to_owned();
        }
        if let Some(message) = self.cancel_opening() {
            self.session.say(message);
        }
        self.sheet = Sheet::Closed;
        self.files.stay();
    }

    /// Discards the file that the open sheet is opening; returns the message about it.
    fn cancel_opening(&mut self) -> Option<String> {
        match &self.sheet {
            Sheet::Open(sheet) if sheet.is_for_strokes() => {
                self.readers.strokes.cancel().then(|| stroke::CANCELED.to_owned())
            }
            Sheet::Open(sheet) if !sheet.is_for_projects() => None,
            Sheet::Open(_) | Sheet::OutsideLibrary(_) => {
                self.files.cancel_opening().map(|path| document::canceled(&shown_name(&path)))
            }
            _ => None,
        }
    }

    /// Applies an edit.
    fn carry_out_edit(&mut self, edit: Edit, ctx: &egui::Context) {
        // Edits apply to the selected texture, so that texture must be audible.
        self.compare.end();
        // Undo no longer reverts what an earlier notice names.
        clear_earlier_notice(ctx);
        self.session.forget_read_message(Instant::now());
        let adds_row = match &edit {
            Edit::AddTextures(_) => true,
            Edit::AddRelief { place, .. } => !matches!(place, ReliefPlace::InPlaceOf(_)),
            _ => false,
        };
        if adds_row {
            self.pages.author.library.show_all();
            self.pages.author.library.reveal = Some(self.session.textures().len());
        }
        let said = self.said_of(&edit, ctx);
        let replaces_axes = matches!(edit, Edit::OpenLibrary(_) | Edit::UseSpace(_));
        let before = replaces_axes.then(|| self.project.clone());
        self.history.apply(&mut self.project, edit, self.gesture.current());
        let dropped = before.map_or_else(Vec::new, |before| dropped_axes(&before, &self.project));
        if !dropped.is_empty() {
            show_notice(ctx, axes::coordinates_dropped(&dropped, &Command::Undo.shortcut_text(ctx)));
        } else if let Some(said) = said {
            show_notice(ctx, said);
        }
    }

    /// Starts or stops the automatic stroke; on a path that is shown, it begins with playing the path.
    fn toggle_hand(&mut self) {
        let starts = !self.session.hand_is_running();
        if starts && self.draws_path() {
            self.session.play_path(true);
        }
        self.session.set_hand(starts.then_some(self.pages.stage.pad.input()));
    }

    /// Executes a command.
    pub fn carry_out(&mut self, command: Command, ctx: &egui::Context) {
        match command {
            Command::File(command) => self.carry_out_file(command, ctx),
            Command::Edit(edit) => self.carry_out_edit(edit, ctx),
            Command::OpenTexture(id) => self.sheet = Sheet::Texture(Box::new(TextureSheet::new(id))),
            Command::RenameAuthored(key) => self.rename_authored(key, ctx),
            Command::ExportAuthored(key) => self.export_authored(key, ctx),
            Command::RenameSelected => self.rename_authored(self.project.texture().key, ctx),
            Command::DeleteSelected => self.delete_selected(ctx),
            Command::Axes(command) => self.carry_out_axes(command, ctx),
            Command::Clipboard(command) => self.carry_out_clipboard(command, ctx),
            Command::RenameTexture(id) => self.sheet = Sheet::Texture(Box::new(TextureSheet::to_rename(id))),
            Command::OpenShortcuts => self.sheet = Sheet::Shortcuts,
            Command::OpenPalette => self.sheet = Sheet::Palette(PaletteSheet::default()),
            Command::OpenGuide => self.sheet = Sheet::Guide(Box::new(GuideSheet::new())),
            Command::OpenPapers => self.sheet = Sheet::Papers(Box::new(PapersSheet::new())),
            Command::OpenAbout => self.sheet = Sheet::About(AboutSheet::new(&self.files.keeping)),
            Command::BeginTour => {
                self.pages.workspace = Workspace::Author;
                self.tour.begin();
            }
            Command::Stroke(command) => self.carry_out_stroke(command, ctx),
            Command::ReadPhoto(source) => self.readers.photo.read(source, self.project.texture().key, ctx),
            Command::Prompt(command) => self.carry_out_prompt(command, ctx),
            Command::Networks(command) => self.carry_out_networks(command),
            Command::Relief(command) => self.carry_out_relief(command, ctx),
            Command::ShowMap(quantity) => self.pages.author.map = quantity,
            Command::Compare(command) => self.carry_out_compare(command),
            Command::Signals(command) => self.carry_out_signals(command, ctx),
            Command::Studies(command) => self.carry_out_studies(command, ctx),
            Command::Undo if self.painting_labels()[0].is_some() => self.pages.signals.undo(),
            Command::Undo => {
                clear_notice(ctx);
                self.history.undo(&mut self.project);
            }
            Command::Redo if self.painting_labels()[1].is_some() => self.pages.signals.redo(),
            Command::Redo => {
                clear_notice(ctx);
                self.history.redo(&mut self.project);
            }
            Command::ToggleHand => self.toggle_hand(),
            Command::TogglePathTool => self.pages.author.canvas.tool.toggle(),
            Command::PlayPath(is_played) => self.session.play_path(is_played),
            Command::KeepPath => self.keep_path(ctx),
            Command::ToggleMute => self.session.toggle_mute(),
            Command::ToggleTheme => self.toggle_theme(ctx),
            Command::DismissMessage => self.session.forget_messages(),
            Command::ListOutputs => self.session.list_outputs(ctx),
            Command::OpenOutput(id) => {
                self.output.asked = Some(id.clone());
                self.session.open_output(OutputChoice::Id(id), ctx);
            }
            Command::ResetLimiter => self.session.reset_limiter(),
            Command::TakeOverOutput => {
                self.output.asked = self.session.claimed_output().map(str::to_owned);
                self.session.take_over_output(ctx);
            }
            Command::OpenDevices => self.open_devices(ctx),
            Command::DuplicateTexture => self.duplicate(ctx),
            Command::ToggleDragStroke => self.files.settings.is_silent_while_dragging ^= true,
            Command::ToggleHover => self.files.settings.plays_on_hover ^= true,
            Command::ToggleMotion => self.toggle_motion(ctx),
            Command::ToggleFreeze => {
                let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
                self.pages.stage.scope.toggle_freeze(&panel);
            }
            Command::SetRig(rig) => {
                self.remember_rig(&rig);
                self.session.set_rig(*rig, ctx);
            }
            Command::PlayTone { frequency_hz, amplitude_mps2 } => {
                self.session.play_tone(frequency_hz, amplitude_mps2);
            }
            Command::StopTone => self.session.stop_tone(),
            Command::LetGoOfOutput => self.session.let_go_of_output(),
            Command::TakeOutputBack => self.session.take_output_back(ctx),
            Command::ListPens => self.session.list_pens(ctx),
            Command::OpenImport => {
                self.sheet.import(Vec::new(), ctx);
                self.offer_folders();
            }
            Command::ImportHere(sources) => {
                self.sheet.import_here(sources, ctx);
                self.offer_folders();
            }
            Command::Show(workspace) => self.pages.workspace = workspace,
            Command::ReadJudgments(sources) => self.pages.build.read(sources, ctx),
            Command::OpenSave => self.sheet = Sheet::Save(SaveSheet::library(&self.project)),
            Command::SaveFigure(figure) => {
                self.sheet = Sheet::Save(SaveSheet::figure(figure, &self.exports_folder));
            }
            Command::SaveBlank(file) => {
                self.sheet = Sheet::Save(SaveSheet::blank(file, &self.exports_folder));
            }
            Command::CloseSheet => self.close_sheet(),
        }
    }
}
