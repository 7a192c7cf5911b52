//! Sessions of the page: their start, and the one that runs over the whole window.

use std::path::{Path, PathBuf};

use egui::{Context, ViewportCommand};
use shagreen_device::output::NULL_ID;
use shagreen_formats::project::Project;
use shagreen_formats::settings::StudySettings;
use shagreen_formats::study_log::ReadLog;
use shagreen_studio::file::one_line;
use shagreen_studio::study::logs::load_log;
use shagreen_studio::study::plans::StudyPlan;
use shagreen_studio::study::session::{LogPlace, NewSession, StudySession};

use super::StudiesPage;
use crate::command::Command;
use crate::command::studies::{SessionStart, StudiesCommand};
use crate::session::{MaskingOutput, Session};
use crate::state::source::Source;
use crate::strings::studies as strings;
use crate::studies::open_study;
use crate::studies::runner::loaded_stimuli::{LoadedStimuli, Loading};
use crate::studies::runner::{Runner, RunnerStart};

/// Session whose stimuli are being made.
pub(super) struct Starting {
    loading: Loading,
    start: SessionStart,
    study: StudyPlan,
    /// The log before the session goes on.
    log: Option<Box<ReadLog>>,
}

impl StudiesPage {
    /// Begins the session whose stimuli are made, and keeps the masking noise playing. Called once a frame.
    pub(super) fn collect_start(&mut self, ctx: &Context) {
        if let Some(loaded) = self.starting.as_ref().and_then(|starting| starting.loading.collect()) {
            let starting = self.starting.take();
            match (starting, loaded) {
                (Some(starting), Ok(stimuli)) => self.begin_session(starting, stimuli, ctx),
                (_, Err(reason)) => self.failure = Some(reason),
                (None, Ok(_)) => {}
            }
        }
        if let Some(masking) = &mut self.masking {
            masking.follow();
        }
    }

    /// Progress of the stimuli of the session that starts, 0 to 1; `None` if none starts.
    pub(super) fn starting(&self) -> Option<f32> {
        self.starting.as_ref().map(|starting| starting.loading.progress().unwrap_or(0.0))
    }

    /// Cancels the session that starts.
    pub(super) fn cancel_start(&mut self) {
        self.starting = None;
    }

    /// Command that starts a session. A session in which a person would read the placeholder of a consent text waits until the
    /// experimenter confirms it.
    pub(super) fn confirmed(&mut self, start: SessionStart) -> Option<Command> {
        let reads_consent = match &start {
            SessionStart::Next => true,
            SessionStart::Resume(log) => self.sessions.needs_consent(log),
            SessionStart::Practice | SessionStart::Simulated(_) => false,
        };
        if reads_consent && self.has_placeholder_consent() {
            self.unconfirmed = Some(start);
            return None;
        }
        Some(Command::Studies(StudiesCommand::Start(start)))
    }

    /// Begins to make the stimuli of a session. A plan without a file is saved first.
    pub(crate) fn start(&mut self, start: SessionStart, project: &Project, ctx: &Context) {
        if self.starting.is_some() || self.runner.is_some() {
            return;
        }
        self.failure = None;
        match self.study_of(start) {
            Ok((study, log, start)) => {
                let loading = Loading::begin(study.clone(), project.clone(), ctx);
                self.starting = Some(Starting { loading, start, study, log });
            }
            Err(reason) => self.failure = Some(reason),
        }
    }

    /// Plan of a session, with the log that it goes on with. An interrupted session of a simulated participant goes on.
    fn study_of(
        &mut self,
        start: SessionStart,
    ) -> Result<(StudyPlan, Option<Box<ReadLog>>, SessionStart), String> {
        let interrupted = self.sessions.interrupted_simulation().cloned();
        let start = match (start, interrupted) {
            (SessionStart::Simulated(_), Some(path)) => SessionStart::Resume(path),
            (start, _) => start,
        };
        if let SessionStart::Resume(path) = &start {
            let log = load_log(path).map_err(|error| one_line(&error))?;
            return Ok((StudyPlan::of_log(&log), Some(Box::new(log)), start));
        }
        let open = self.open.as_mut().ok_or(strings::NO_PLAN)?;
        if open.path.is_none() && start != SessionStart::Practice {
            let typed = self.save_to.trim();
            if typed.is_empty() {
                return Err(strings::NO_PATH.to_owned());
            }
            let path = std::path::absolute(Path::new(typed)).map_err(|error| error.to_string())?;
            open_study::save(&open.study, &path)?;
            open.path = Some(path.clone());
            self.file = Some(Source::Path(path));
        }
        Ok((open.study.clone(), None, start))
    }

    /// Begins a session whose stimuli are made, and shows it over the whole window.
    fn begin_session(&mut self, starting: Starting, stimuli: LoadedStimuli, ctx: &Context) {
        let Starting { start, study, log, .. } = starting;
        let session = match &start {
            SessionStart::Practice => StudySession::practice(&study, 1),
            SessionStart::Resume(path) => StudySession::resume(path),
            SessionStart::Next | SessionStart::Simulated(_) => match self.log_folder() {
                Some(folder) => StudySession::begin(&NewSession {
                    plan: &study,
                    place: LogPlace::Folder(&folder),
                    participant: None,
                    simulation_seed: if let SessionStart::Simulated(seed) = start {
                        Some(seed)
                    } else {
                        None
                    },
                }),
                None => return,
            },
        };
        let session = match session {
            Ok(session) => session,
            Err(error) => {
                self.failure = Some(one_line(&error));
                return;
            }
        };
        let simulation_seed = match (&start, &log) {
            (SessionStart::Simulated(seed), _) => Some(*seed),
            // A person must not answer in the place of a simulated participant.
            (_, Some(log)) if log.header.is_simulated() => Some(log.header.seed()),
            _ => None,
        };
        self.masking = self.masking_output(&study, ctx);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        self.runner = Some(Runner::new(RunnerStart { session, stimuli, log, simulation_seed }, ctx));
    }

    /// The second output with the masking noise, if the plan asks for it and an output is selected.
    fn masking_output(&self, study: &StudyPlan, ctx: &Context) -> Option<MaskingOutput> {
        let noise = study.plan.masking_noise?;
        let id = self.settings.masking_output.clone()?;
        Some(MaskingOutput::open(id, noise, ctx))
    }

    /// Name of the output that plays the masking noise; `None` while none plays it.
    pub(crate) fn masking_name(&self, session: &Session) -> Option<String> {
        let masking = self.masking.as_ref().filter(|masking| masking.plays() && masking.id() != NULL_ID)?;
        let listed = session.outputs().iter().find(|output| output.id == masking.id());
        Some(listed.map_or(masking.id(), |output| output.name.as_str()).to_owned())
    }

    /// The session that runs over the whole window.
    pub(crate) fn runner(&mut self) -> Option<&mut Runner> {
        self.runner.as_mut()
    }

    /// Leaves the session that runs, and lists the sessions again.
    pub(crate) fn leave(&mut self, ctx: &Context) {
        if let Some(problem) = self.masking.as_ref().and_then(MaskingOutput::problem) {
            self.failure = Some(strings::masking_failed(problem));
        }
        (self.runner, self.masking) = (None, None);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(false));
        self.read_sessions(ctx);
    }

    /// Follows the settings of this machine and the folder of files, once a frame. Returns the session of a simulated participant
    /// that the program was started for, once its plan is open and its sessions are listed.
    pub(crate) fn follow(&mut self, settings: &StudySettings, folder: PathBuf) -> Option<Command> {
        if self.settings != *settings {
            self.settings.clone_from(settings);
        }
        self.folder = folder;
        let is_ready = self.open.is_some() && self.runner.is_none() && !self.is_busy();
        let seed = self.simulation_seed.take_if(|_| is_ready)?;
        Some(Command::Studies(StudiesCommand::Start(SessionStart::Simulated(seed))))
    }
}
