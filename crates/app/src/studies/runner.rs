//! Runner of a study: what a participant sees and does, over the whole window.
//!
//! Input: a [`StudySession`], its stimuli, and once a frame what is on the screen. Output: strokes on the surface, and what is
//! audible. Participants see blind labels only, and nothing of the authoring. Every answer is on the disk before the next
//! trial; if it cannot be saved, the runner stays where it is and says why.

mod actions;
mod draft;
mod keys;
mod line_slider;
pub(crate) mod loaded_stimuli;
mod motion_meter;
mod presenter;
mod screens_ui;
mod setup;
mod simulated;
mod stage_ui;
mod steps;
mod stimuli_ui;
mod tasks;
mod text_texture;
mod trial_state;
mod trial_ui;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use egui::{Context, Id, Ui};
use shagreen_core::people::study::answer::{Event, Response};
use shagreen_core::people::study::setup::ScreenScale;
use shagreen_core::people::study::trial::{Task, Trial};
use shagreen_core::units::Hertz;
use shagreen_device::controls::Input;
use shagreen_device::hand::{Hand, Path};
use shagreen_device::touch::Touch;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::study_log::ReadLog;
use shagreen_studio::study::session::StudySession;
use shagreen_studio::study::stimuli::SIGNAL_CONTACT;

use self::actions::{Action, Field};
use self::loaded_stimuli::LoadedStimuli;
use self::setup::setup;
use self::simulated::Simulated;
use self::stage_ui::StageState;
use self::text_texture::TextTexture;
use self::trial_state::TrialState;
pub(crate) use self::trial_ui::longest_line;

use crate::author::prompt::Prompts;
use crate::session::{PresentedTexture, Session};
use crate::state::mouse_report::MouseReport;

/// Length of the automatic stroke, in m: the stroke of a presentation of 0.8 s at the speed of the signals.
const STROKE_EXTENT_M: f32 = 0.08;

/// A session on the screen.
pub(crate) struct Runner {
    session: StudySession,
    stimuli: LoadedStimuli,
    screen: Screen,
    /// Part whose instructions were read last, and whether the participant knows that its practice is over.
    read: Option<(String, bool)>,
    /// Texts of questions by part, number of the text and whether it is for practice.
    texts: BTreeMap<(String, usize, bool), String>,
    /// Sample rate of the stimuli of the next trial, if there are any.
    rate: Option<Hertz>,
    /// The last event, if it is not saved.
    unsaved: Option<Unsaved>,
    /// Why the last action had no effect.
    problem: Option<String>,
    is_asked_to_leave: bool,
    has_left: bool,
    /// Whether the participant lets the automatic stroke run.
    is_stroking: bool,
    stage: StageState,
    /// Widgets of the last frame that take values.
    fields: Vec<(Id, Field)>,
    simulated: Option<Simulated>,
}

/// Event that is not saved yet.
struct Unsaved {
    /// Why it is not saved.
    reason: String,
    /// Whether it states the devices only, so that the screen stays as it is when it is saved.
    is_setup: bool,
}

/// What is on the screen.
enum Screen {
    Consent,
    Instructions,
    PracticeOver,
    Break,
    Trial(Box<TrialState>),
    /// After an answer: whether it was right, if the participant is to learn it.
    Pause {
        until: Instant,
        is_right: Option<bool>,
    },
    Done,
    /// After the participant did not agree to the consent text.
    Refused,
    /// A stimulus cannot be made.
    Broken(String),
}

/// What the runner needs to know in a frame.
#[derive(Clone, Copy)]
pub(crate) struct RunnerInput<'a> {
    pub(crate) project: &'a Project,
    pub(crate) session: &'a Session,
    pub(crate) prompts: &'a Prompts,
    /// Measured scale of the screen, in points per millimeter.
    pub(crate) points_per_mm: f32,
    /// The same for the log, and whether it is measured.
    pub(crate) screen: ScreenScale,
    /// Name of the output that plays the masking noise.
    pub(crate) masking: Option<&'a str>,
}

/// What plays.
#[derive(Clone, Debug)]
pub(crate) enum RunnerAudible<'a> {
    /// Nothing, before stimuli of this sample rate.
    Nothing(Option<Hertz>),
    Stimulus(&'a Arc<PresentedTexture>),
    /// Texture made from a text.
    Authored(&'a Arc<AuthoredTexture>),
}

/// Session to run: with what its log says, if it goes on.
pub(crate) struct RunnerStart {
    pub(crate) session: StudySession,
    pub(crate) stimuli: LoadedStimuli,
    /// The log before the session goes on.
    pub(crate) log: Option<Box<ReadLog>>,
    /// Seed of the simulated participant who answers instead of a person.
    pub(crate) simulation_seed: Option<u64>,
}

impl Runner {
    /// Runner at the next step of a session.
    pub(crate) fn new(start: RunnerStart, ctx: &Context) -> Self {
        let RunnerStart { session, stimuli, log, simulation_seed } = start;
        let events = log.map_or_else(Vec::new, |log| log.events());
        let answers = || {
            events
                .iter()
                .filter_map(|event| if let Event::Answered(answer) = event { Some(answer) } else { None })
        };
        let text = |trial: &Trial, response: &Response| match (&trial.task, response) {
            (Task::Question { prompt, .. }, Response::Grades { prompt: text, .. }) => {
                Some(((trial.part.clone(), *prompt, trial.is_practice), text.clone()))
            }
            _ => None,
        };
        let texts = answers().filter_map(|answer| text(&answer.trial, &answer.response)).collect();
        let simulated = simulation_seed.map(|seed| {
            let answered = answers().map(|answer| answer.trial.clone()).collect();
            Simulated::begin(Arc::clone(session.plan()), session.number(), seed, answered, ctx.clone())
        });
        let mut runner = Self {
            session,
            stimuli,
            screen: Screen::Done,
            read: None,
            texts,
            rate: None,
            unsaved: None,
            problem: None,
            is_asked_to_leave: false,
            has_left: false,
            is_stroking: false,
            stage: StageState::default(),
            fields: Vec::new(),
            simulated,
        };
        runner.go_on();
        runner
    }

    /// The session.
    pub(crate) fn session(&self) -> &StudySession {
        &self.session
    }

    /// Whether the participant or the experimenter has left the study.
    pub(crate) fn has_left(&self) -> bool {
        self.has_left
    }

    /// Asks whether to leave the study, unless it is over.
    pub(crate) fn ask_to_leave(&mut self) {
        if matches!(self.screen, Screen::Done | Screen::Refused) {
            self.has_left = true;
        } else {
            self.is_asked_to_leave = true;
        }
    }

    /// Draws the runner over the whole window, and carries out what the participant does. Returns the pointer while it
    /// strokes the surface.
    pub(crate) fn show(&mut self, ui: &mut Ui, input: &RunnerInput<'_>) -> Option<MouseReport> {
        let ctx = ui.ctx().clone();
        self.follow(input, &ctx);
        let mut actions = self.pressed(&ctx);
        let (asked, mouse) = self.screen_ui(ui, input);
        actions.extend(asked.actions);
        self.fields = asked.fields;
        actions.extend(self.simulated_action(&ctx));
        for action in actions {
            self.carry_out(action, input, &ctx);
        }
        if self.is_timed() {
            ctx.request_repaint();
        }
        mouse
    }

    /// What plays, with the tip at this place.
    pub(crate) fn audible(&self, touch: Touch) -> RunnerAudible<'_> {
        let nothing = RunnerAudible::Nothing(self.rate);
        let Some(state) = self.trial() else { return nothing };
        if let Some(authored) = state.text.as_ref().and_then(TextTexture::authored) {
            return RunnerAudible::Authored(authored);
        }
        state.audible(touch).map_or(nothing, RunnerAudible::Stimulus)
    }

    /// The automatic stroke: during presentations that follow each other by themselves, and where the participant lets it run.
    pub(crate) fn stroke(&self) -> Option<Input> {
        let state = self.trial()?;
        let is_wanted =
            if state.presenter.is_passive() { state.presenter.playing().is_some() } else { self.is_stroking };
        is_wanted.then(|| Input::Hand(stroke()))
    }

    /// The trial that the participant can work on.
    fn trial(&self) -> Option<&TrialState> {
        let is_hidden = self.is_asked_to_leave || self.unsaved.is_some();
        match &self.screen {
            Screen::Trial(state) if !is_hidden => Some(state),
            _ => None,
        }
    }

    /// Follows time, tip and background jobs, once a frame.
    fn follow(&mut self, input: &RunnerInput<'_>, ctx: &Context) {
        let now = Instant::now();
        self.follow_setup(input);
        let is_hidden = self.is_asked_to_leave || self.unsaved.is_some();
        match &mut self.screen {
            Screen::Trial(state) if !is_hidden => {
                state.follow(input.session.touch(), now);
                if let Some(text) = &mut state.text {
                    text.follow(input.project, input.session);
                }
                self.describe_known(input, ctx);
            }
            Screen::Pause { until, .. } if now >= *until && !is_hidden => self.go_on(),
            _ => {}
        }
    }

    /// States the devices in the log when they change.
    fn follow_setup(&mut self, input: &RunnerInput<'_>) {
        let is_over = matches!(self.screen, Screen::Done | Screen::Refused);
        if !is_over && let Err(error) = self.session.set_up(&setup(input)) {
            self.unsaved = Some(Unsaved { reason: error.to_string(), is_setup: true });
        }
    }

    /// Whether the screen changes by itself.
    fn is_timed(&self) -> bool {
        match &self.screen {
            Screen::Trial(state) => state.presenter.is_timed(state.now_secs()),
            Screen::Pause { .. } => true,
            _ => false,
        }
    }

    /// What the simulated participant does in this frame, if there is one.
    fn simulated_action(&mut self, ctx: &Context) -> Option<Action> {
        let is_stopped = self.is_asked_to_leave || self.unsaved.is_some();
        let simulated = self.simulated.as_mut().filter(|_| !is_stopped)?;
        let action = match &self.screen {
            Screen::Consent | Screen::Instructions | Screen::PracticeOver | Screen::Break => {
                Some(Action::GoOn)
            }
            Screen::Trial(state) => simulated.act(state, self.is_stroking),
            Screen::Pause { .. } | Screen::Done | Screen::Refused | Screen::Broken(_) => None,
        };
        if action.is_some() {
            ctx.request_repaint();
        }
        if let Some(failure) = simulated.failure() {
            self.problem = Some(failure.to_owned());
        }
        action
    }
}

/// The automatic stroke of a study: at the speed and force of the signals.
fn stroke() -> Hand {
    Hand {
        path: Path::Line,
        speed_mps: SIGNAL_CONTACT.speed.0 as f32,
        force_n: SIGNAL_CONTACT.force.0 as f32,
        extent_m: STROKE_EXTENT_M,
    }
}
