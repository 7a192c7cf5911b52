//! The window: lays out the panels, executes commands and requests frames.

mod author_page;
mod axes;
mod begin;
mod clipboard;
mod commands;
mod escape;
mod exports;
pub(crate) mod file_menu;
mod files;
mod focus_ring;
mod gesture_counter;
mod hints;
mod outside_library;
mod pages;
mod preview;
mod prompts;
mod reliefs;
mod rig;
mod signals;
mod stage;
pub mod status_bar;
pub(crate) mod stopwatch;
mod strokes;
mod studies;
mod title_bar;
pub mod tour;

pub use self::begin::Begin;
use self::focus_ring::focus_ring_ui;
use self::gesture_counter::GestureCounter;
use self::rig::SelectedOutput;
pub use self::stopwatch::WindowTimes;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{Frame, Margin, Panel as Side, Ui};
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::author::canvas::point_id;
use crate::author::context_menu::note_open_menu;
use crate::author::prompt::Prompts;
use crate::build::page::BuildPage;
use crate::command::{Command, FileCommand, pressed};
use crate::look::scale::Scale;
use crate::look::theme::tokens;
use crate::look::tooltips::follow_drags;
use crate::panel::Panel;
use crate::session::Session;
use crate::sheets::Sheet;
use crate::sheets::import::sheet::ImportSheet;
use crate::signals::page::SignalsPage;
use crate::state::compare::Compare;
use crate::state::document::Document;
use crate::state::edit::Edit;
use crate::state::files::Files;
use crate::state::history::History;
use crate::state::photo::PhotoReader;
use crate::state::pictures::Pictures;
use crate::state::recorded_stroke::StrokeReader;
use crate::studies::page::StudiesPage;
use crate::window::pages::Pages;
use crate::window::preview::Preview;
use crate::window::status_bar::status_ui;
use crate::window::tour::Tour;
use crate::workspace::Workspace;

/// Height of the status bar, in points.
const STATUS_HEIGHT: f32 = 32.0;
/// Interval between frames while the window is idle, so that the status bar stays current.
const IDLE: std::time::Duration = std::time::Duration::from_secs(4);

/// Readers of files, in the background.
#[derive(Default)]
struct Readers {
    photo: PhotoReader,
    strokes: StrokeReader,
}

/// The program window. It has many fields, because it owns all that its panels only read.
pub struct Window {
    project: Project,
    history: History,
    session: Session,
    files: Files,
    pictures: Pictures,
    readers: Readers,
    prompts: Prompts,
    compare: Compare,
    scale: Scale,
    has_been_shown: bool,
    gesture: GestureCounter,
    sheet: Sheet,
    tour: Tour,
    pages: Pages,
    /// Default folder for saved figures, strokes and signals.
    exports_folder: PathBuf,
    output: SelectedOutput,
    preview: Preview,
    /// File to open or import in the second frame.
    take: Option<PathBuf>,
}

impl Window {
    /// Open project.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// File of the project.
    pub fn document(&self) -> &Document {
        &self.files.document
    }

    /// Session with the library and the output.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Pictures of the textures; they load in the background.
    pub fn pictures(&self) -> &Pictures {
        &self.pictures
    }

    /// Visible workspace.
    pub fn workspace(&self) -> Workspace {
        self.pages.workspace
    }

    /// Build workspace.
    pub fn build(&self) -> &BuildPage {
        &self.pages.build
    }

    /// Prompt box and its results.
    pub fn prompts(&self) -> &Prompts {
        &self.prompts
    }

    /// Signals workspace.
    pub fn signals(&self) -> &SignalsPage {
        &self.pages.signals
    }

    /// Studies workspace.
    pub fn studies(&self) -> &StudiesPage {
        &self.pages.studies
    }

    /// Import sheet, if open.
    pub fn import(&self) -> Option<&ImportSheet> {
        match &self.sheet {
            Sheet::Import(sheet) => Some(sheet),
            _ => None,
        }
    }

    /// Runs one frame: updates all state, draws the window and executes commands.
    pub fn frame_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let t = tokens(&ctx);
        note_open_menu(&ctx);
        // Workers start after the first frame, which would otherwise be delayed.
        if self.has_been_shown {
            self.session.begin_work(&ctx);
            self.pictures.begin_work(&ctx);
            if let Some(path) = self.take.take_if(|_| !self.sheet.is_open()) {
                self.carry_out(Command::File(FileCommand::Open(path)), &ctx);
            }
        } else {
            self.has_been_shown = true;
            ctx.request_repaint();
        }
        self.pictures.collect(&ctx);
        self.gesture.follow(&ctx);
        follow_drags(&ctx);
        self.session.update(self.pages.stage.pad.contact(&self.session));
        self.pages.collect(&ctx);
        self.pages.signals.store_model(&mut self.files.settings.quality_model);
        self.collect_files(&ctx);
        self.collect_photo(&ctx);
        self.collect_prompt(&ctx);
        self.collect_simulated(&ctx);
        self.collect_strokes();
        self.remember_output();
        self.follow_studies(&ctx);
        if self.study_ui(ui, &ctx) {
            return;
        }
        let escaped = self.escaped(&ctx);
        let mut commands = if self.sheet.is_open() {
            Vec::new()
        } else {
            pressed(&ctx, point_id(self.project.texture().key))
        };
        let is_author = self.pages.workspace == Workspace::Author;
        let has_stage = is_author || self.pages.current().is_some_and(|page| page.has_stage());
        if !has_stage && !self.session.hand_is_running() {
            // The automatic stroke may be stopped where it is not visible, but not started.
            commands.retain(|command| !matches!(command, Command::ToggleHand));
        }
        if !is_author {
            commands.retain(|command| {
                let is_of_author = matches!(
                    command,
                    Command::TogglePathTool
                        | Command::Clipboard(_)
                        | Command::RenameSelected
                        | Command::DeleteSelected
                );
                !is_of_author
            });
        }
        if let Some(page) = self.pages.current() {
            commands = commands.into_iter().filter_map(|command| page.accept(command)).collect();
        }
        commands.extend(escaped);

        let bar = |margin: i8| Frame::new().fill(t.panel).inner_margin(Margin::symmetric(10, margin));
        Side::top("title").exact_size(38.0).frame(bar(4)).show(ui, |ui| commands.extend(self.title_ui(ui)));
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let says_source = is_author && !self.pages.author.canvas.is_narrow;
        Side::bottom("status")
            .exact_size(STATUS_HEIGHT)
            .frame(bar(2))
            .show(ui, |ui| commands.extend(status_ui(ui, &panel, says_source)));
        if is_author {
            self.author_ui(ui, &ctx, &mut commands);
        } else {
            if has_stage {
                self.stage_ui(ui, &ctx, &mut commands);
            }
            let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
            if let Some(page) = self.pages.current() {
                commands.extend(page.show(ui, &panel));
            }
        }

        if self.sheet.is_open() {
            // Everything under an open sheet stays unchanged.
            commands.clear();
        }
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let target = self.pages.current().and_then(|page| page.drop_target());
        commands.extend(self.sheet.show(&ctx, &panel, &self.files.document, self.pages.workspace, target));
        if self.pages.workspace == Workspace::Author && !self.sheet.is_open() && self.tour.show(&ctx) {
            self.files.settings.has_seen_tour = true;
        }
        self.revert_escaped_drag(&mut commands, &ctx);
        self.follow_preview(&mut commands, &ctx);
        focus_ring_ui(&ctx);
        for command in commands {
            self.carry_out(command, &ctx);
        }
        self.follow_project(&ctx);
        self.open_awaited_export(&ctx);
        let (project, textures) = (&self.project, self.session.textures());
        self.pictures.follow(&project.library, &project.joined, textures);
        self.remember_hints(&ctx);
        self.keep_scale(&ctx);
        self.keep_going(&ctx);
    }

    /// Authored texture that a comparison makes audible.
    fn compared_texture(&self) -> Option<Arc<AuthoredTexture>> {
        let compared = self.compare.heard_key()?;
        self.project.authored.iter().find(|texture| texture.key == compared).map(Arc::clone)
    }

    /// Audible authored texture, or `None` while a texture of the list is soloed.
    fn heard_texture(&self) -> Option<Arc<AuthoredTexture>> {
        let selected = || Arc::clone(&self.project.authored[self.project.selected]);
        self.compared_texture().or_else(|| self.project.solo.is_none().then(selected))
    }

    /// Sets a loaded photo as the picture of the texture that was selected when the photo was dropped.
    fn collect_photo(&mut self, ctx: &egui::Context) {
        match self.readers.photo.collect() {
            // The texture may have been deleted in the meantime.
            Some((key, Ok(_))) if !self.project.authored.iter().any(|texture| texture.key == key) => {}
            Some((key, Ok(picture))) => {
                for edit in [Edit::Select(key), Edit::SetPicture(Some(Arc::new(picture)))] {
                    self.carry_out(Command::Edit(edit), ctx);
                }
            }
            Some((_, Err(reason))) => self.session.say(reason),
            None => {}
        }
    }

    /// Updates the session to the project, the comparison and the selected signal.
    fn follow_project(&mut self, ctx: &egui::Context) {
        self.compare.follow(&self.project);
        let in_gallery = self.preview.gallery_texture();
        self.session.set_hidden(self.compare.is_hidden());
        let is_bench = self.pages.workspace == Workspace::Signals && in_gallery.is_none();
        self.session.feel(self.pages.signals.felt_signal().filter(|_| is_bench));
        let heard = in_gallery.or_else(|| self.compared_texture());
        let project = self.preview.applied_to(&self.project, self.session.textures());
        self.session.follow(&project, heard.as_deref(), ctx);
    }

    /// Follows the zoom factor, which the keyboard and the window size determine, and stores the zoom that the user
    /// wants.
    fn keep_scale(&mut self, ctx: &egui::Context) {
        let now = ctx.zoom_factor();
        let scale = self.scale.follow(now, ctx.content_rect().size());
        if (scale - now).abs() > 1e-3 {
            ctx.set_zoom_factor(scale);
        }
        self.files.settings.scale = self.scale.wanted();
    }

    /// Requests continuous frames while something is playing. Otherwise only the status bar and the notice of a long
    /// computation can change by themselves: input, the pen and background jobs request their own frames.
    fn keep_going(&self, ctx: &egui::Context) {
        let sounding = self.session.touch().contact.force_n > 0.0 || self.session.scope().rms(0.5) > 1e-4;
        if self.session.hand_is_running() || sounding {
            ctx.request_repaint();
        } else if self.session.is_preparing() {
            // The notice that it takes long comes by time alone.
            ctx.request_repaint_after(std::time::Duration::from_millis(100));
        } else {
            ctx.request_repaint_after(IDLE);
        }
    }
}
