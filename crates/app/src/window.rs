//! The window: lays out the panels, executes commands and requests frames.

mod commands;
pub(crate) mod file_menu;
mod files;
mod pages;
mod prompts;
mod rig;
mod signals;
pub mod status_bar;
pub(crate) mod stopwatch;
mod strokes;
mod title_bar;
pub mod tour;

use self::rig::open_as_left;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{CentralPanel, Frame, Margin, Panel as Side, Ui};
use shagreen_core::space::heat_map::Quantity;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_studio::models::ModelFolder;

use crate::Begin;
use crate::author::canvas::{CanvasState, ShownMap, canvas_ui, point_id};
use crate::author::inspector::inspector_ui;
use crate::author::library_panel::{LibraryState, library_ui};
use crate::author::pad::{PadState, pad_ui};
use crate::author::prompt::Prompts;
use crate::author::prompt::bar_ui::bar_ui;
use crate::author::prompt::card_ui::card_ui;
use crate::author::scope::{ScopeState, scope_ui};
use crate::build::page::BuildPage;
use crate::command::{Command, pressed};
use crate::look::scale::Scale;
use crate::look::theme::{
    INSPECTOR_WIDTH, LIBRARY_WIDTH, PAD_WIDTH, STAGE_HEIGHTS, STAGE_SHARE, install, map_color, tokens,
};
use crate::panel::Panel;
use crate::session::{OutputChoice, Session};
use crate::sheets::Sheet;
use crate::sheets::import::sheet::ImportSheet;
use crate::signals::page::SignalsPage;
use crate::state::compare::Compare;
use crate::state::document::Document;
use crate::state::edit::Edit;
use crate::state::files::Files;
use crate::state::heat_map::{Grid, HeatMap, Wanted};
use crate::state::history::History;
use crate::state::photo::{OwnPicture, PhotoReader};
use crate::state::pictures::Pictures;
use crate::state::recorded_stroke::StrokeReader;
use crate::window::pages::Pages;
use crate::window::status_bar::status_ui;
use crate::window::tour::{Places, Tour};
use crate::workspace::Workspace;

/// Maximum number of pictures that are blended for the pad. More take longer without a visible difference.
const MAX_PICTURED: usize = 6;

/// The program window.
pub struct Window {
    project: Project,
    history: History,
    session: Session,
    files: Files,
    pictures: Pictures,
    photo: PhotoReader,
    own_picture: OwnPicture,
    prompts: Prompts,
    guess_picture: OwnPicture,
    strokes: StrokeReader,
    compare: Compare,
    heat: HeatMap,
    map: Option<Quantity>,
    pad: PadState,
    scope: ScopeState,
    scale: Scale,
    canvas: CanvasState,
    library: LibraryState,
    has_been_shown: bool,
    gesture: u64,
    was_holding: bool,
    /// Widget with the keyboard focus in the last frame.
    writing: Option<egui::Id>,
    sheet: Sheet,
    tour: Tour,
    /// Rectangles of the tour's steps in the last frame.
    tour_places: Places,
    workspace: Workspace,
    pages: Pages,
    /// Default folder for saved figures, strokes and signals.
    exports_folder: PathBuf,
    /// Output that the user selected in this window, until it is open.
    asked_output: Option<String>,
    /// Whether the output was given at program start and no other has been selected since.
    is_output_given: bool,
}

impl Window {
    /// Opens a window on a project; the output is opened in the background.
    ///
    /// # Errors
    /// The library cannot be read, or its positions do not form a space.
    pub fn new(ctx: &egui::Context, begin: Begin) -> anyhow::Result<Self> {
        install(ctx);
        let Begin { project, path, output, keeping } = begin;
        let mut session = Session::new(project.library.clone())?;
        session.list_outputs(ctx);
        let leftovers = Files::leftovers(&keeping);
        // Without a settings file the tour would start at every program start, so it is not shown.
        let can_remember = keeping.settings.is_some();
        let sheet = if leftovers.is_empty() { Sheet::Closed } else { Sheet::Recovered(leftovers) };
        let prompts = Prompts::new(keeping.models.clone().map(ModelFolder::new));
        let files = Files::new(&project, path, keeping);
        let is_output_given = output != OutputChoice::SystemDefault;
        open_as_left(&mut session, output, &files, ctx);
        session.follow(&project, None, ctx);
        let pictures = Pictures::new(project.library.clone(), &project.joined, session.textures());
        let is_new_here = can_remember && !files.settings.has_seen_tour;
        let tour = if is_new_here { Tour::begun() } else { Tour::default() };
        if let Some(is_light) = files.settings.is_light {
            ctx.set_theme(if is_light { egui::Theme::Light } else { egui::Theme::Dark });
        }
        let scale = Scale::new(files.settings.scale);
        ctx.set_zoom_factor(scale.set());
        Ok(Self {
            project,
            history: History::default(),
            session,
            pictures,
            photo: PhotoReader::new(),
            own_picture: OwnPicture::default(),
            prompts,
            guess_picture: OwnPicture::default(),
            strokes: StrokeReader::default(),
            files,
            compare: Compare::by_chance(),
            heat: HeatMap::default(),
            map: None,
            pad: PadState::default(),
            scope: ScopeState::default(),
            scale,
            canvas: CanvasState::default(),
            library: LibraryState::default(),
            has_been_shown: false,
            gesture: 0,
            was_holding: false,
            writing: None,
            sheet,
            tour,
            tour_places: [egui::Rect::NOTHING; 4],
            workspace: Workspace::default(),
            pages: Pages::default(),
            // Without a current folder, the user completes the path.
            exports_folder: std::env::current_dir().unwrap_or_default(),
            asked_output: None,
            is_output_given,
        })
    }

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
        self.workspace
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
        // Workers start after the first frame, which would otherwise be delayed.
        if self.has_been_shown {
            self.session.begin_work(&ctx);
            self.pictures.begin_work(&ctx);
        } else {
            self.has_been_shown = true;
            ctx.request_repaint();
        }
        self.pictures.collect(&ctx);
        self.next_gesture(&ctx);
        self.session.update(self.pad.contact(&self.session));
        self.pages.collect(&ctx);
        self.collect_files(&ctx);
        self.collect_photo(&ctx);
        self.collect_prompt(&ctx);
        self.collect_strokes();
        self.remember_output();
        let mut commands = if self.sheet.is_open() {
            Vec::new()
        } else {
            pressed(&ctx, point_id(self.project.texture().key))
        };
        let is_author = self.workspace == Workspace::Author;
        let has_stage = is_author || self.pages.page(self.workspace).is_some_and(|page| page.has_stage());
        if !has_stage && !self.session.hand_is_running() {
            // The automatic stroke may be stopped where it is not visible, but not started.
            commands.retain(|command| !matches!(command, Command::ToggleHand));
        }
        if !is_author {
            commands.retain(|command| !matches!(command, Command::TogglePathTool));
        }
        if let Some(page) = self.pages.page(self.workspace) {
            commands = commands.into_iter().filter_map(|command| page.accept(command)).collect();
        }
        if self.workspace == Workspace::Author
            && self.canvas.tool.is_on
            && !self.sheet.is_open()
            && ctx.input_mut(|i| i.consume_key(egui::Modifiers::NONE, egui::Key::Escape))
        {
            commands.push(Command::TogglePathTool);
        }

        let bar = |margin: i8| Frame::new().fill(t.panel).inner_margin(Margin::symmetric(10, margin));
        Side::top("title").exact_size(38.0).frame(bar(4)).show(ui, |ui| commands.extend(self.title_ui(ui)));
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        Side::bottom("status")
            .exact_size(32.0)
            .frame(bar(2))
            .show(ui, |ui| commands.extend(status_ui(ui, &panel)));
        if is_author {
            self.author_ui(ui, &ctx, &mut commands);
        } else {
            if has_stage {
                self.stage_ui(ui, &ctx, &mut commands);
            }
            let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
            if let Some(page) = self.pages.page(self.workspace) {
                commands.extend(page.show(ui, &panel));
            }
        }

        if self.sheet.is_open() {
            // Everything under an open sheet stays unchanged.
            commands.clear();
        }
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let target = self.pages.page(self.workspace).and_then(|page| page.drop_target());
        commands.extend(self.sheet.show(&ctx, &panel, &self.files.document, self.workspace, target));
        if self.workspace == Workspace::Author
            && !self.sheet.is_open()
            && self.tour.show(&ctx, self.tour_places)
        {
            self.files.settings.has_seen_tour = true;
        }
        for command in commands {
            self.carry_out(command, &ctx);
        }
        self.follow_project(&ctx);
        let (project, textures) = (&self.project, self.session.textures());
        self.pictures.follow(&project.library, &project.joined, textures);
        self.keep_scale(&ctx);
        self.keep_going(&ctx);
    }

    /// Draws the Author workspace.
    fn author_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let map = self.follow_map(ctx);
        self.stage_ui(ui, ctx, commands);
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let library = &mut self.library;
        Side::left("library").exact_size(LIBRARY_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(library_ui(ui, &panel, library));
        });
        Side::right("inspector").exact_size(INSPECTOR_WIDTH).resizable(false).show(ui, |ui| {
            self.tour_places[2] = ui.max_rect();
            commands.extend(inspector_ui(ui, &panel));
        });
        let frame = Frame::new().fill(tokens(ctx).panel).inner_margin(Margin::same(6));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            commands.extend(bar_ui(ui, &mut self.prompts, &self.files.settings.prompts));
            let guess = self.prompts.guess_of(self.project.texture());
            if let Some(guess) = guess {
                let picture =
                    self.guess_picture.follow(Some(&guess.picture), ctx).map(|(picture, _)| picture);
                commands.extend(card_ui(ui, &panel, guess, self.prompts.is_busy(), picture));
            }
            self.tour_places[0] = ui.available_rect_before_wrap();
            commands.extend(canvas_ui(ui, &panel, &mut self.canvas, map.as_ref(), guess));
        });
    }

    /// Heat map behind the canvas, as far as it is computed.
    fn follow_map(&mut self, ctx: &egui::Context) -> Option<ShownMap> {
        let session = &self.session;
        let contact = self.pad.contact(session);
        let wanted = self.map.map(|quantity| Wanted {
            quantity,
            blending: session.blending(&self.project.texture().blend),
            contact,
            generation: session.generation(),
        });
        self.heat.follow(wanted, || (session.authoring().clone(), session.planes().to_vec()), ctx);
        let quantity = self.map?;
        let range = self.heat.grid().and_then(Grid::range);
        Some(ShownMap {
            quantity,
            picture: self.heat.picture(ctx, map_color).map(egui::TextureHandle::id),
            range,
        })
    }

    /// Draws the lower row with pad and scope.
    fn stage_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let parents = self.session.authored().map_or(&[][..], |authored| &authored.parents);
        let parents = pictured(parents);
        let blended = if parents.is_empty() { None } else { self.pictures.blend(ctx, &parents) };
        let blended = blended.map(|(texture, mm)| (texture.id(), [mm, mm]));
        let is_felt = self.session.felt_name().is_some();
        let heard = self.heard_texture().filter(|_| !self.compare.is_hidden() && !is_felt);
        let own = heard.and_then(|texture| texture.picture.clone());
        let own = self.own_picture.follow(own.as_ref(), ctx).map(|(texture, mm)| (texture.id(), mm));
        let picture = own.or(blended);
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let (pad, scope, place) = (&mut self.pad, &mut self.scope, &mut self.tour_places[1]);
        let mut mouse = None;
        let stage_height =
            (STAGE_SHARE * ctx.content_rect().height()).clamp(*STAGE_HEIGHTS.start(), *STAGE_HEIGHTS.end());
        Side::bottom("stage").exact_size(stage_height).resizable(false).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let (width, height) = (ui.available_width(), ui.available_height());
                let top_down = egui::Layout::top_down(egui::Align::Min);
                let pad_width = (0.36 * width).max(PAD_WIDTH.min(0.5 * width));
                ui.allocate_ui_with_layout(egui::vec2(pad_width, height), top_down, |ui| {
                    *place = ui.max_rect();
                    let outcome = pad_ui(ui, &panel, pad, picture);
                    commands.extend(outcome.commands);
                    mouse = outcome.mouse;
                });
                ui.allocate_ui_with_layout(ui.available_size(), top_down, |ui| {
                    commands.extend(scope_ui(ui, &panel, scope));
                });
            });
        });
        if let Some(report) = mouse {
            self.session.mouse(report, self.pad.hand.force_n);
        }
        if self.session.hand_is_running() {
            self.session.set_hand(Some(self.pad.input()));
        }
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

    /// Sets a loaded photo as the picture of the texture on which it was dropped.
    fn collect_photo(&mut self, ctx: &egui::Context) {
        match self.photo.collect() {
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
        let heard = self.compared_texture();
        self.session.set_hidden(self.compare.is_hidden());
        let is_bench = self.workspace == Workspace::Signals;
        self.session.feel(self.pages.signals.felt_signal().filter(|_| is_bench));
        self.session.follow(&self.project, heard.as_deref(), ctx);
    }

    /// Counts gestures. A gesture lasts while a button or key is held or a text field has the focus, and one frame
    /// longer.
    fn next_gesture(&mut self, ctx: &egui::Context) {
        // Typing in one text field is one gesture, regardless of the number of keys.
        let is_writing = ctx.memory(egui::Memory::focused) == self.writing && ctx.text_edit_focused();
        self.writing = ctx.memory(egui::Memory::focused);
        let holding = is_writing || ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty());
        if !holding && !self.was_holding {
            self.gesture += 1;
        }
        self.was_holding = holding;
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

    /// Requests continuous frames while something is playing, otherwise a few frames a second for the status bar.
    fn keep_going(&self, ctx: &egui::Context) {
        let sounding = self.session.touch().contact.force_n > 0.0 || self.session.scope().rms(0.5) > 1e-4;
        if self.session.hand_is_running() || sounding {
            ctx.request_repaint();
        } else {
            ctx.request_repaint_after(std::time::Duration::from_millis(100));
        }
    }
}

/// Textures with the largest weights, and their weights normalized to a sum of one, for the blended picture.
fn pictured(parents: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let largest = &parents[..parents.len().min(MAX_PICTURED)];
    let sum: f64 = largest.iter().map(|(_, weight)| weight.max(0.0)).sum();
    let share = |(texture, weight): &(usize, f64)| (*texture, weight.max(0.0) / sum);
    largest.iter().map(share).filter(|(_, share)| *share > 0.0).collect()
}
