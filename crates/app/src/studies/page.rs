//! Page of the Studies workspace: the open plan, its sessions, and the session that runs.

mod devices_ui;
mod log_folder_ui;
mod plan_ui;
mod preview_ui;
mod results_ui;
mod running;
mod scale_ui;
mod sessions_ui;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{CentralPanel, Context, Frame, Margin, Panel as Side, ScrollArea, Ui};
use shagreen_formats::project::Project;
use shagreen_formats::settings::StudySettings;
use shagreen_formats::study_plan::has_placeholder_consent;
use shagreen_studio::study::analysis::{StudyJudgments, StudyReport};
use shagreen_studio::study::logs::{usual_log_folder, usual_simulated_log_folder};
use shagreen_studio::study::session::StudySession;

pub use crate::studies::sessions::{ListedSession, SessionState};

pub(crate) use self::scale_ui::{points_per_mm, screen_scale};

use self::devices_ui::devices_ui;
use self::log_folder_ui::LogFolderField;
use self::plan_ui::plan_ui;
use self::preview_ui::preview_ui;
use self::results_ui::results_ui;
use self::running::Starting;
use self::scale_ui::{ScaleState, scale_ui};
use self::sessions_ui::sessions_ui;

use crate::browse::Browse;
use crate::command::Command;
use crate::command::studies::SessionStart;
use crate::look::theme::{BUILD_INPUTS_WIDTH, GAP, SCROLL_BAR_ROOM, VERDICT_WIDTH, tokens};
use crate::panel::Panel;
use crate::session::MaskingOutput;
use crate::state::background::in_background;
use crate::state::source::Source;
use crate::strings::studies as strings;
use crate::studies::open_study::{self, OpenStudy, Origin, usual_path};
use crate::studies::results::{Analysis, Results};
use crate::studies::runner::Runner;
use crate::studies::sessions::Sessions;

/// What the middle of the page shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Shown {
    #[default]
    Preview,
    Results,
    Scale,
}

/// State of the Studies workspace.
#[derive(Default)]
pub struct StudiesPage {
    open: Option<OpenStudy>,
    /// Why the last plan cannot be run, in sentences.
    problems: Vec<String>,
    /// File that was read last, to read it again.
    file: Option<Source>,
    reading: Option<Receiver<Result<OpenStudy, Vec<String>>>>,
    /// Path of a plan, as it is typed.
    typed: String,
    /// Path at which an unsaved plan will be saved, as it is typed.
    save_to: String,
    browse: Browse,
    sessions: Sessions,
    /// Folder that was chosen for the logs of the open plan; `None` for the usual one.
    logs: Option<PathBuf>,
    log_folder_field: LogFolderField,
    /// Session that waits until the experimenter confirms the placeholder of the consent text.
    unconfirmed: Option<SessionStart>,
    shown: Shown,
    scale: ScaleState,
    analysis: Option<Analysis>,
    results: Option<Results>,
    /// Session whose stimuli are being made.
    starting: Option<Starting>,
    /// Why the last session or analysis did not begin.
    failure: Option<String>,
    runner: Option<Runner>,
    masking: Option<MaskingOutput>,
    /// Seed of a simulated participant who takes part as soon as a plan is open.
    simulation_seed: Option<u64>,
    /// Settings of this machine.
    settings: StudySettings,
    /// Folder in which plans are saved, unless another one is chosen.
    folder: PathBuf,
}

impl StudiesPage {
    /// Lets a simulated participant take part as soon as a plan is open.
    pub(crate) fn simulate(&mut self, seed: Option<u64>) {
        self.simulation_seed = seed;
    }

    /// Whether a plan that can be run is open.
    pub fn has_plan(&self) -> bool {
        self.open.is_some()
    }

    /// Why the last plan cannot be run, in sentences.
    pub fn problems(&self) -> &[String] {
        &self.problems
    }

    /// Sessions of the open study.
    pub fn sessions(&self) -> &[ListedSession] {
        &self.sessions.listed
    }

    /// Session that runs over the whole window, if one does.
    pub fn running(&self) -> Option<&StudySession> {
        self.runner.as_ref().map(Runner::session)
    }

    /// Report that was computed last.
    pub fn report(&self) -> Option<&StudyReport> {
        self.results.as_ref().and_then(Results::report)
    }

    /// Whether something runs in the background.
    pub fn is_busy(&self) -> bool {
        self.reading.is_some()
            || self.starting.is_some()
            || self.analysis.is_some()
            || self.sessions.is_reading()
            || self.results.as_ref().is_some_and(Results::is_saving)
    }

    /// Reads a plan in the background.
    fn begin_reading(&mut self, origin: Origin, project: &Project, ctx: &Context) {
        let project = project.clone();
        self.problems.clear();
        self.failure = None;
        self.file = if let Origin::File(source) = &origin { Some(source.clone()) } else { None };
        self.reading = Some(in_background(ctx.clone(), move || open_study::read(&origin, &project)));
    }

    /// Opens the first of these plans.
    pub(crate) fn open_file(&mut self, sources: Vec<Source>, project: &Project, ctx: &Context) {
        if let Some(source) = sources.into_iter().next() {
            self.begin_reading(Origin::File(source), project, ctx);
        }
    }

    /// Takes in the results of background jobs.
    pub(crate) fn collect(&mut self, ctx: &Context) {
        self.collect_plan(ctx);
        self.sessions.collect();
        if let Some(done) = self.analysis.as_ref().and_then(Analysis::collect) {
            self.analysis = None;
            match (done, self.report_folder()) {
                (Ok(reports), Some(folder)) => {
                    self.results = Some(Results::new(reports, &folder));
                    self.shown = Shown::Results;
                }
                (Ok(_), None) => {}
                (Err(reason), _) => self.failure = Some(reason),
            }
        }
        if let Some(results) = &mut self.results {
            results.collect();
        }
        self.collect_start(ctx);
    }

    fn collect_plan(&mut self, ctx: &Context) {
        let Some(reading) = &self.reading else { return };
        let read = match reading.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => Err(vec![strings::BROKEN_OFF.to_owned()]),
            Ok(read) => read,
        };
        self.reading = None;
        match read {
            Ok(open) => {
                let is_other = self.open.as_ref().is_none_or(|before| before.path != open.path);
                if is_other {
                    self.sessions.clear();
                    self.results = None;
                }
                let kept = |path| self.settings.log_folder_of(path).map(PathBuf::from);
                // Simulated logs must not lie beside those of people.
                let simulated = |path| self.simulation_seed.map(|_| usual_simulated_log_folder(path));
                self.logs = open.path.as_deref().and_then(|path| simulated(path).or_else(|| kept(path)));
                self.unconfirmed = None;
                self.shown = Shown::Preview;
                self.save_to = usual_path(&self.folder, &open.study).display().to_string();
                self.open = Some(open);
                self.read_sessions(ctx);
            }
            Err(problems) => (self.problems, self.open) = (problems, None),
        }
    }

    /// Lists the sessions of the open study again.
    fn read_sessions(&mut self, ctx: &Context) {
        if let Some((folder, open)) = self.log_folder().zip(self.open.as_ref()) {
            self.sessions.read(folder, open.study.plan.as_ref().clone(), ctx);
        }
    }

    /// Folder of the logs; `None` for a plan that is not saved yet.
    fn log_folder(&self) -> Option<PathBuf> {
        let plan = self.open.as_ref()?.path.as_deref()?;
        Some(self.logs.clone().unwrap_or_else(|| usual_log_folder(plan)))
    }

    /// Saves the logs of the open plan in a folder from now on, and lists the sessions in it.
    pub(crate) fn choose_log_folder(&mut self, folder: PathBuf, ctx: &Context) {
        self.logs = Some(std::path::absolute(&folder).unwrap_or(folder));
        (self.failure, self.unconfirmed) = (None, None);
        (self.analysis, self.results) = (None, None);
        self.sessions.clear();
        self.read_sessions(ctx);
    }

    /// The open plan file with the folder that was chosen for its logs. That of simulated participants is not remembered, or
    /// people would answer in it later.
    pub(crate) fn chosen_log_folder(&self) -> Option<(&Path, &Path)> {
        let chosen = self.open.as_ref()?.path.as_deref().zip(self.logs.as_deref());
        chosen.filter(|(plan, folder)| *folder != usual_simulated_log_folder(plan))
    }

    /// Usual folder of a report: beside the plan.
    fn report_folder(&self) -> Option<PathBuf> {
        let path = self.open.as_ref()?.path.as_deref()?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Some(path.with_file_name(format!("{stem}-report")))
    }

    /// Begins to analyze the sessions of the open study.
    fn analyze(&mut self, ctx: &Context) {
        self.failure = None;
        if let Some((folder, open)) = self.log_folder().zip(self.open.as_ref()) {
            self.analysis = Some(Analysis::begin(folder, open.study.clone(), ctx));
        }
    }

    /// Whether participants of the open plan would read the placeholder of a consent text.
    fn has_placeholder_consent(&self) -> bool {
        self.open.as_ref().is_some_and(|open| has_placeholder_consent(&open.study.plan))
    }

    /// Whether an analysis runs.
    fn is_analyzing(&self) -> bool {
        self.analysis.is_some()
    }

    /// Judgments of the analyzed participants, and the name of their study.
    pub(crate) fn judgments(&self) -> Option<(String, StudyJudgments)> {
        let report = self.report()?;
        Some((strings::judgments_of(&report.plan.name), report.judgments.clone()))
    }

    /// Draws the page; returns the requested commands.
    pub(crate) fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        let column = |ui: &mut Ui, name: &str, content: &mut dyn FnMut(&mut Ui)| {
            ScrollArea::vertical().id_salt(name).auto_shrink(false).show(ui, |ui| {
                ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
                ui.add_space(GAP);
                content(ui);
            });
        };
        Side::left("plan of a study").exact_size(BUILD_INPUTS_WIDTH).resizable(false).show(ui, |ui| {
            column(ui, "plan", &mut |ui| plan_ui(ui, self, panel));
        });
        Side::right("sessions of a study").exact_size(VERDICT_WIDTH).resizable(false).show(ui, |ui| {
            column(ui, "sessions", &mut |ui| {
                commands.extend(devices_ui(ui, self, panel.session));
                commands.extend(sessions_ui(ui, self));
            });
        });
        let frame = Frame::new().fill(t.panel).inner_margin(Margin::same(10));
        CentralPanel::default().frame(frame).show(ui, |ui| match self.shown {
            Shown::Scale => commands.extend(scale_ui(ui, self)),
            Shown::Results => commands.extend(results_ui(ui, self)),
            Shown::Preview => preview_ui(ui, self),
        });
        commands
    }
}
