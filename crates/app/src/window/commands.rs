//! Execution of commands after a frame.

use std::sync::Arc;

use shagreen_formats::actuator_toml::built_in_actuators;

use super::Window;
use crate::author::inspector::name_field;
use crate::author::new_texture::copy_of;
use crate::author::texture_sheet::TextureSheet;
use crate::command::Command;
use crate::look::motion;
use crate::panel::Panel;
use crate::session::OutputChoice;
use crate::session::kept_path::kept_path;
use crate::sheets::Sheet;
use crate::sheets::devices::DevicesSheet;
use crate::sheets::guide_sheet::GuideSheet;
use crate::sheets::palette::PaletteSheet;
use crate::sheets::save::SaveSheet;
use crate::state::edit::Edit;
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
        self.carry_out(Command::Edit(Edit::Author(copy)), ctx);
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

    /// Closes the open sheet, and remembers the folder of an export.
    fn close_sheet(&mut self) {
        let folder = match &self.sheet {
            Sheet::Save(sheet) => sheet.folder_of_export(),
            Sheet::Export(sheet) => sheet.folder_of_export(),
            _ => None,
        };
        if let Some(folder) = folder {
            self.exports_folder = folder.to_owned();
        }
        self.sheet = Sheet::Closed;
        self.files.stay();
    }

    /// Executes a command.
    pub fn carry_out(&mut self, command: Command, ctx: &egui::Context) {
        match command {
            Command::File(command) => self.carry_out_file(command, ctx),
            Command::Edit(edit) => {
                // Edits apply to the selected texture, so that texture must be audible.
                self.compare.end();
                if matches!(edit, Edit::AddTextures(_)) {
                    self.pages.author.library.show_all();
                    self.pages.author.library.reveal = Some(self.session.textures().len());
                }
                self.history.apply(&mut self.project, edit, self.gesture.current());
            }
            Command::OpenTexture(id) => self.sheet = Sheet::Texture(Box::new(TextureSheet::new(id))),
            Command::RenameAuthored(key) => {
                if key != self.project.texture().key {
                    self.carry_out(Command::Edit(Edit::Select(key)), ctx);
                }
                // The inspector shows the selected texture, and not one that a comparison plays.
                self.compare.end();
                ctx.memory_mut(|memory| memory.request_focus(name_field()));
            }
            Command::Clipboard(command) => self.carry_out_clipboard(command, ctx),
            Command::RenameTexture(id) => self.sheet = Sheet::Texture(Box::new(TextureSheet::to_rename(id))),
            Command::OpenShortcuts => self.sheet = Sheet::Shortcuts,
            Command::OpenPalette => self.sheet = Sheet::Palette(PaletteSheet::default()),
            Command::OpenGuide => self.sheet = Sheet::Guide(Box::new(GuideSheet::new())),
            Command::BeginTour => {
                self.pages.workspace = Workspace::Author;
                self.tour.begin();
            }
            Command::Stroke(command) => self.carry_out_stroke(command, ctx),
            Command::ReadPhoto(source) => self.readers.photo.read(source, self.project.texture().key, ctx),
            Command::Prompt(command) => self.carry_out_prompt(command, ctx),
            Command::ShowMap(quantity) => self.pages.author.map = quantity,
            Command::Compare(command) => self.compare.carry_out(command),
            Command::Signals(command) => self.carry_out_signals(command, ctx),
            Command::Undo if self.painting_labels()[0].is_some() => self.pages.signals.undo(),
            Command::Undo => {
                self.history.undo(&mut self.project);
            }
            Command::Redo if self.painting_labels()[1].is_some() => self.pages.signals.redo(),
            Command::Redo => {
                self.history.redo(&mut self.project);
            }
            Command::ToggleHand => {
                let hand = (!self.session.hand_is_running()).then_some(self.pages.stage.pad.input());
                self.session.set_hand(hand);
            }
            Command::TogglePathTool => self.pages.author.canvas.tool.toggle(),
            Command::PlayPath(is_played) => self.session.play_path(is_played),
            Command::KeepPath => self.keep_path(ctx),
            Command::ToggleMute => self.session.toggle_mute(),
            Command::ToggleTheme => self.toggle_theme(ctx),
            Command::DismissMessage => self.session.forget_message(),
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
            Command::OpenImport => self.sheet.import(Vec::new(), ctx),
            Command::Import(sources) => self.sheet.import(sources, ctx),
            Command::ImportHere(sources) => self.sheet.import_here(sources, ctx),
            Command::Show(workspace) => self.pages.workspace = workspace,
            Command::ReadJudgments(sources) => self.pages.build.read(sources, ctx),
            Command::OpenSave => self.sheet = Sheet::Save(SaveSheet::library()),
            Command::SaveFigure(figure) => {
                self.sheet = Sheet::Save(SaveSheet::figure(figure, &self.exports_folder));
            }
            Command::CloseSheet => self.close_sheet(),
        }
    }
}
