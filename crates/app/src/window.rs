//! The window itself: lays out the panels, carries out commands, keeps the frame going.

use std::path::PathBuf;
use std::sync::Arc;

use egui::{CentralPanel, Frame, Margin, Panel as Side, RichText, Ui};
use shagreen_core::units::Contact;
use shagreen_formats::actuator_toml::built_in_actuators;
use shagreen_formats::library::Library;

use crate::build::page::BuildPage;
use crate::canvas::{PathTool, canvas_ui, point_id};
use crate::command::{Command, pressed};
use crate::devices::DevicesSheet;
use crate::history::{Gesture, History};
use crate::import::sheet::ImportSheet;
use crate::inspector::inspector_ui;
use crate::kept_path::kept_path;
use crate::library_panel::library_ui;
use crate::pad::{PadState, pad_ui};
use crate::panel::Panel;
use crate::pictures::Pictures;
use crate::project::{Edit, Project};
use crate::save::SaveSheet;
use crate::scope::scope_ui;
use crate::session::{OutputChoice, Session};
use crate::sheets::Sheet;
use crate::status_bar::status_ui;
use crate::strings;
use crate::theme::{INSPECTOR_WIDTH, LIBRARY_WIDTH, PAD_WIDTH, STAGE_HEIGHT, install, tokens};
use crate::workspace::Workspace;

/// Pictures that are blended into that of a field: more take longer and show nothing more.
const MAX_PICTURED: usize = 6;

/// The program with its window.
pub struct Window {
    project: Project,
    history: History,
    session: Session,
    pictures: Pictures,
    pad: PadState,
    path_tool: PathTool,
    search: String,
    /// A texture that has just joined, to be scrolled to.
    reveal: Option<usize>,
    gesture: u64,
    was_holding: bool,
    sheet: Sheet,
    workspace: Workspace,
    build: BuildPage,
    /// Where figures are saved unless another path is chosen.
    figures_folder: PathBuf,
}

impl Window {
    /// The window on a library; the output is opened in the background.
    ///
    /// # Errors
    /// The library's positions make no space.
    pub fn new(ctx: &egui::Context, library: Library, output: OutputChoice) -> anyhow::Result<Self> {
        install(ctx);
        let sources = library.textures.iter().map(|t| t.picture.clone()).collect();
        let mut session = Session::new(library)?;
        session.list_outputs(ctx);
        session.open_output(output, ctx);
        let project = Project::default();
        session.follow(&project, ctx);
        Ok(Self {
            project,
            history: History::default(),
            session,
            pictures: Pictures::new(ctx, sources),
            pad: PadState::default(),
            path_tool: PathTool::default(),
            search: String::new(),
            reveal: None,
            gesture: 0,
            was_holding: false,
            sheet: Sheet::Closed,
            workspace: Workspace::default(),
            build: BuildPage::default(),
            // Where there is none, the path is one to be completed.
            figures_folder: std::env::current_dir().unwrap_or_default(),
        })
    }

    /// What the user makes.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// What is open and what sounds.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The workspace that is shown.
    pub fn workspace(&self) -> Workspace {
        self.workspace
    }

    /// The workspace where spaces are built.
    pub fn build(&self) -> &BuildPage {
        &self.build
    }

    /// The import sheet, where it is open.
    pub fn import(&self) -> Option<&ImportSheet> {
        match &self.sheet {
            Sheet::Import(sheet) => Some(sheet),
            _ => None,
        }
    }

    /// One frame.
    pub fn frame_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let t = tokens(&ctx);
        self.pictures.collect(&ctx);
        self.next_gesture(&ctx);
        let hand = self.pad.hand;
        self.session
            .update(Contact::from_mm_per_s_and_n(1e3 * f64::from(hand.speed_mps), f64::from(hand.force_n)));
        self.build.collect();
        let mut commands = if self.sheet.is_open() { Vec::new() } else { pressed(&ctx, point_id()) };
        if self.workspace == Workspace::Build && !self.session.hand_is_running() {
            // Where nothing shows the hand it can be stopped, but does not start unseen.
            commands.retain(|command| !matches!(command, Command::ToggleHand));
        }
        if self.workspace == Workspace::Build {
            commands.retain(|command| !matches!(command, Command::TogglePathTool));
        } else if self.path_tool.is_on
            && !self.sheet.is_open()
            && ctx.input_mut(|i| i.consume_key(egui::Modifiers::NONE, egui::Key::Escape))
        {
            commands.push(Command::TogglePathTool);
        }

        let bar = |margin: i8| Frame::new().fill(t.panel).inner_margin(Margin::symmetric(10, margin));
        Side::top("title").exact_size(38.0).frame(bar(4)).show(ui, |ui| commands.extend(self.title_ui(ui)));
        let panel = Panel { project: &self.project, session: &self.session, pictures: &self.pictures };
        Side::bottom("status")
            .exact_size(32.0)
            .frame(bar(2))
            .show(ui, |ui| commands.extend(status_ui(ui, &panel)));
        match self.workspace {
            Workspace::Author => self.author_ui(ui, &ctx, &mut commands),
            Workspace::Build => {
                let panel =
                    Panel { project: &self.project, session: &self.session, pictures: &self.pictures };
                commands.extend(self.build.show(ui, &panel));
            }
        }

        if self.sheet.is_open() {
            // What lies below a sheet goes on as it was.
            commands.clear();
        }
        commands.extend(self.sheet.show(&ctx, &self.session, self.workspace));
        for command in commands {
            self.carry_out(command, &ctx);
        }
        self.session.follow(&self.project, &ctx);
        let (project, textures) = (&self.project, self.session.textures());
        self.pictures.follow(&ctx, project.library, &project.added, textures);
        self.keep_going(&ctx);
    }

    fn title_ui(&self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal_centered(|ui| {
            let t = tokens(ui.ctx());
            ui.add(
                egui::Label::new(RichText::new(strings::APP).heading().strong().color(t.accent))
                    .selectable(false),
            );
            ui.add_space(10.0);
            for workspace in Workspace::ALL {
                let command = Command::Show(workspace);
                let keys = command.shortcut().map_or(String::new(), |s| ui.ctx().format_shortcut(&s));
                let tab = ui.selectable_label(self.workspace == workspace, workspace.name());
                if tab.on_hover_text(format!("{} ({keys})", workspace.help())).clicked() {
                    commands.push(command);
                }
            }
            ui.add_space(10.0);
            for (command, name, label) in [
                (Command::Undo, strings::UNDO, self.history.undo_label()),
                (Command::Redo, strings::REDO, self.history.redo_label()),
            ] {
                let what = label.map_or(name.to_owned(), |l| strings::verb(name, l));
                let keys = command.shortcut().map_or(String::new(), |s| ui.ctx().format_shortcut(&s));
                let button = ui.add_enabled(label.is_some(), egui::Button::new(name));
                if button.on_hover_text(format!("{what} ({keys})")).clicked() {
                    commands.push(command);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let to = if ui.visuals().dark_mode { strings::TO_LIGHT } else { strings::TO_DARK };
                if ui.button(to).clicked() {
                    commands.push(Command::ToggleTheme);
                }
                let keys =
                    Command::OpenDevices.shortcut().map_or(String::new(), |s| ui.ctx().format_shortcut(&s));
                let help = format!("{} ({keys})", strings::devices::OPEN_HELP);
                if ui.button(strings::devices::OPEN).on_hover_text(help).clicked() {
                    commands.push(Command::OpenDevices);
                }
                let mute = if self.session.is_muted() { strings::UNMUTE } else { strings::MUTE };
                if ui.selectable_label(self.session.is_muted(), mute).clicked() {
                    commands.push(Command::ToggleMute);
                }
            });
        });
        commands
    }

    /// The workspace Author.
    fn author_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        self.stage_ui(ui, ctx, commands);
        let panel = Panel { project: &self.project, session: &self.session, pictures: &self.pictures };
        let (search, reveal) = (&mut self.search, &mut self.reveal);
        Side::left("library").exact_size(LIBRARY_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(library_ui(ui, &panel, search, reveal));
        });
        Side::right("inspector").exact_size(INSPECTOR_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(inspector_ui(ui, &panel));
        });
        let frame = Frame::new().fill(tokens(ctx).panel).inner_margin(Margin::same(6));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            commands.extend(canvas_ui(ui, &panel, &mut self.path_tool));
        });
    }

    /// The row at the foot: pad and scope.
    fn stage_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let parents = self.session.authored().map_or(&[][..], |authored| &authored.parents);
        let picture = self.pictures.blend(ctx, &pictured(parents)).map(|(texture, mm)| (texture.id(), mm));
        let panel = Panel { project: &self.project, session: &self.session, pictures: &self.pictures };
        let pad = &mut self.pad;
        let mut mouse = None;
        Side::bottom("stage").exact_size(STAGE_HEIGHT).resizable(false).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let (width, height) = (ui.available_width(), ui.available_height());
                let top_down = egui::Layout::top_down(egui::Align::Min);
                let pad_width = (0.36 * width).max(PAD_WIDTH.min(0.5 * width));
                ui.allocate_ui_with_layout(egui::vec2(pad_width, height), top_down, |ui| {
                    let outcome = pad_ui(ui, &panel, pad, picture);
                    commands.extend(outcome.commands);
                    mouse = outcome.mouse;
                });
                ui.allocate_ui_with_layout(ui.available_size(), top_down, |ui| scope_ui(ui, &panel));
            });
        });
        if let Some(report) = mouse {
            self.session.mouse(report, self.pad.hand.force_n);
        }
        if self.session.hand_is_running() {
            self.session.set_hand(Some(self.pad.hand));
        }
    }

    /// Does what was asked for.
    pub fn carry_out(&mut self, command: Command, ctx: &egui::Context) {
        match command {
            Command::Edit(edit) => {
                if matches!(edit, Edit::AddTextures(_)) {
                    self.search.clear();
                    self.reveal = Some(self.session.textures().len());
                }
                self.history.apply(&mut self.project, edit, Gesture(self.gesture));
            }
            Command::Undo => {
                self.history.undo(&mut self.project);
            }
            Command::Redo => {
                self.history.redo(&mut self.project);
            }
            Command::ToggleHand => {
                let hand = (!self.session.hand_is_running()).then_some(self.pad.hand);
                self.session.set_hand(hand);
            }
            Command::TogglePathTool => self.path_tool.toggle(),
            Command::PlayPath(is_played) => self.session.play_path(is_played),
            Command::KeepPath => match kept_path(&self.project, &self.session) {
                Some(Ok(entry)) => {
                    self.carry_out(Command::Edit(Edit::AddTextures(vec![Arc::new(entry)])), ctx);
                }
                Some(Err(error)) => self.session.say(error.to_string()),
                None => {}
            },
            Command::ToggleMute => self.session.toggle_mute(),
            Command::ToggleTheme => {
                let dark = ctx.theme() == egui::Theme::Dark;
                ctx.set_theme(if dark { egui::Theme::Light } else { egui::Theme::Dark });
            }
            Command::ListOutputs => self.session.list_outputs(ctx),
            Command::OpenOutput(id) => self.session.open_output(OutputChoice::Id(id), ctx),
            Command::ResetLimiter => self.session.reset_limiter(),
            Command::OpenDevices => match built_in_actuators() {
                Ok(actuators) => {
                    self.session.list_outputs(ctx);
                    self.session.list_pens(ctx);
                    self.session.list_inputs(ctx);
                    let sheet = DevicesSheet::new(self.session.rig(), actuators);
                    self.sheet = Sheet::Devices(Box::new(sheet));
                }
                Err(error) => self.session.say(error.to_string()),
            },
            Command::SetRig(rig) => self.session.set_rig(*rig, ctx),
            Command::PlayTone { frequency_hz, amplitude_mps2 } => {
                self.session.play_tone(frequency_hz, amplitude_mps2);
            }
            Command::StopTone => self.session.stop_tone(),
            Command::LetGoOfOutput => self.session.let_go_of_output(),
            Command::TakeOutputBack => self.session.take_output_back(ctx),
            Command::ListPens => self.session.list_pens(ctx),
            Command::OpenImport => self.sheet.import(Vec::new(), ctx),
            Command::Import(sources) => self.sheet.import(sources, ctx),
            Command::Show(workspace) => self.workspace = workspace,
            Command::ReadJudgments(sources) => self.build.read(sources, ctx),
            Command::OpenSave => self.sheet = Sheet::Save(SaveSheet::library()),
            Command::SaveFigure(figure) => {
                self.sheet = Sheet::Save(SaveSheet::figure(figure, &self.figures_folder));
            }
            Command::CloseSheet => {
                if let Sheet::Save(sheet) = &self.sheet
                    && let Some(folder) = sheet.folder_of_figure()
                {
                    self.figures_folder = folder.to_owned();
                }
                self.sheet = Sheet::Closed;
            }
        }
    }

    /// A gesture lasts while a button or key is held, and for the frame in which it is let go.
    fn next_gesture(&mut self, ctx: &egui::Context) {
        let holding = ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty());
        if !holding && !self.was_holding {
            self.gesture += 1;
        }
        self.was_holding = holding;
    }

    /// Something moves while something sounds; otherwise a few frames a second show how the output is doing.
    fn keep_going(&self, ctx: &egui::Context) {
        let sounding = self.session.touch().contact.force_n > 0.0 || self.session.scope().rms(0.5) > 1e-4;
        if self.session.hand_is_running() || sounding {
            ctx.request_repaint();
        } else {
            ctx.request_repaint_after(std::time::Duration::from_millis(100));
        }
    }
}

/// What the picture of a blend is made of: of a field the textures that say the most, as shares of one.
fn pictured(parents: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let largest = &parents[..parents.len().min(MAX_PICTURED)];
    let sum: f64 = largest.iter().map(|(_, weight)| weight.max(0.0)).sum();
    let share = |(texture, weight): &(usize, f64)| (*texture, weight.max(0.0) / sum);
    largest.iter().map(share).filter(|(_, share)| *share > 0.0).collect()
}
