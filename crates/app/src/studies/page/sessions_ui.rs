//! Right column: the sessions of the study, and the buttons that start, resume and analyze them.

use egui::{Align, Button, Label, Layout, ProgressBar, RichText, Ui, vec2};

use super::log_folder_ui::log_folder_ui;
use super::{Shown, StudiesPage};
use crate::command::Command;
use crate::command::studies::{SessionStart, StudiesCommand};
use crate::look::motion::busy_ui;
use crate::look::primary::primary_button;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::log_folder::new_log_folder;
use crate::studies::sessions::{ListedSession, SessionState};

/// Height of the main button, in points.
const MAIN_HEIGHT: f32 = 36.0;

/// Draws the buttons and the list; returns the requested commands.
pub(super) fn sessions_ui(ui: &mut Ui, page: &mut StudiesPage) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.add(Label::new(RichText::new(strings::SESSIONS).heading()).selectable(false));
    commands.extend(start_ui(ui, page));
    if let Some(failure) = &page.failure {
        ui.add(Label::new(RichText::new(failure).color(t.error)).wrap());
    }
    if let Some(failure) = &page.sessions.failure {
        ui.add(Label::new(RichText::new(failure).color(t.error)).wrap());
    }
    commands.extend(new_folder_ui(ui, page));
    commands.extend(log_folder_ui(ui, page));
    ui.add_space(GROUP_GAP);
    if page.open.is_some() && page.sessions.listed.is_empty() {
        ui.add(Label::new(RichText::new(strings::NO_SESSIONS).color(t.text_weak)).selectable(false));
    }
    let mut resumed = None;
    for session in &page.sessions.listed {
        resumed = session_ui(ui, session).or(resumed);
    }
    if let Some(start) = resumed {
        commands.extend(page.confirmed(start));
    }
    if !page.sessions.listed.is_empty() {
        ui.add_space(GAP);
        analyze_ui(ui, page);
    }
    ui.add_space(2.0 * GROUP_GAP);
    commands
}

/// Draws the button that saves logs in a new folder, where the present one has logs of another plan.
fn new_folder_ui(ui: &mut Ui, page: &StudiesPage) -> Option<Command> {
    let t = tokens(ui.ctx());
    let plan = page.open.as_ref()?.path.as_deref().filter(|_| page.sessions.has_other_plan())?;
    ui.add(Label::new(RichText::new(strings::OTHER_PLAN_HERE).color(t.warning)).wrap());
    let new = ui.button(strings::NEW_FOLDER).on_hover_text(strings::NEW_FOLDER_HELP);
    new.clicked().then(|| Command::Studies(StudiesCommand::ChooseLogFolder(new_log_folder(plan))))
}

/// Draws the question whether participants may read the placeholder of a consent text. `start` is the session that waits.
fn consent_ui(ui: &mut Ui, page: &mut StudiesPage, start: &SessionStart) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    ui.add(Label::new(RichText::new(strings::PLACEHOLDER_QUESTION).color(t.warning)).wrap());
    ui.horizontal(|ui| {
        if ui.button(strings::START_ANYWAY).clicked() {
            asked = Some(Command::Studies(StudiesCommand::Start(start.clone())));
        }
        if asked.is_some() || ui.button(strings::CANCEL).clicked() {
            page.unconfirmed = None;
        }
    });
    asked
}

/// Draws the buttons that start a session, or the progress of the session that starts.
fn start_ui(ui: &mut Ui, page: &mut StudiesPage) -> Option<Command> {
    let t = tokens(ui.ctx());
    if let Some(start) = page.unconfirmed.clone() {
        return consent_ui(ui, page, &start);
    }
    if let Some(progress) = page.starting() {
        ui.add(ProgressBar::new(progress).desired_height(8.0).fill(t.accent));
        ui.horizontal(|ui| {
            ui.add(Label::new(RichText::new(strings::PREPARING).small()).selectable(false));
            if ui.button(strings::CANCEL).clicked() {
                page.cancel_start();
            }
        });
        return None;
    }
    let can_start = page.open.is_some() && page.problems.is_empty();
    let button = primary_button(t, RichText::new(strings::START).strong(), can_start);
    let size = vec2(ui.available_width(), MAIN_HEIGHT);
    let button = ui.add_enabled_ui(can_start, |ui| ui.add_sized(size, button)).inner;
    if button.on_hover_text(strings::START_HELP).clicked() {
        return page.confirmed(SessionStart::Next);
    }
    let has_practice =
        page.open.as_ref().is_some_and(|open| open.study.plan.parts.iter().any(|part| part.n_practice > 0));
    let practice = ui.add_enabled(can_start && has_practice, Button::new(strings::PRACTICE_ONLY));
    if practice.on_hover_text(strings::PRACTICE_ONLY_HELP).clicked() {
        return page.confirmed(SessionStart::Practice);
    }
    None
}

/// Draws a session, with the button that resumes it.
fn session_ui(ui: &mut Ui, session: &ListedSession) -> Option<SessionStart> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    let state = match session.state {
        SessionState::Done => Some((strings::DONE_LOG, t.accent)),
        SessionState::Refused => Some((strings::REFUSED_LOG, t.text_weak)),
        _ => None,
    };
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if session.can_resume() {
                let button =
                    ui.button(strings::RESUME).accessible_name(strings::resume(&session.participant));
                if button.on_hover_text(strings::RESUME_HELP).clicked() {
                    asked = Some(SessionStart::Resume(session.path.clone()));
                }
            } else if let Some((state, color)) = state {
                ui.add(Label::new(RichText::new(state).color(color)).selectable(false));
            }
            let text = RichText::new(strings::answers(session.n_answers)).small().color(t.text_weak);
            ui.add(Label::new(text).selectable(false));
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let name = RichText::new(&session.participant).strong();
                ui.add(Label::new(name).truncate().selectable(false));
            });
        });
    });
    if session.is_simulated {
        let text = RichText::new(strings::SIMULATED_LOG).small().color(t.warning);
        ui.add(Label::new(text).selectable(false));
    }
    if let Some(problem) = &session.problem {
        ui.add(Label::new(RichText::new(problem).small().color(t.warning)).wrap());
    }
    asked
}

/// Draws the button that analyzes the sessions, and the one that shows their results.
fn analyze_ui(ui: &mut Ui, page: &mut StudiesPage) {
    ui.horizontal(|ui| {
        let is_analyzing = page.is_analyzing();
        let analyze = ui.add_enabled(!is_analyzing, Button::new(strings::ANALYZE));
        if analyze.on_hover_text(strings::ANALYZE_HELP).clicked() {
            page.analyze(ui.ctx());
        }
        if is_analyzing {
            busy_ui(ui);
            ui.label(strings::ANALYZING);
        } else if page.results.is_some()
            && page.shown != Shown::Results
            && ui.button(strings::RESULTS).clicked()
        {
            page.shown = Shown::Results;
        }
    });
}
