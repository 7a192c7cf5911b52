//! A trial on the screen: the instructions, the stimuli and the answer on the left, the surface on the right.

use egui::{
    Align, Button, CentralPanel, Frame, Label, Layout, Margin, Panel as Side, RichText, ScrollArea, Ui, vec2,
};
use shagreen_core::people::study::plan::Design;
use shagreen_core::people::study::trial::Task;
use shagreen_device::status::LinkState;

use super::RunnerInput;
use super::actions::{Action, Asked};
use super::line_slider::USUAL_MM;
use super::stage_ui::{StageState, stage_ui};
use super::stimuli_ui::{TARGET, stimuli_ui};
use super::tasks::task_ui;
use super::trial_state::TrialState;
use crate::look::primary::primary_button;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::state::mouse_report::MouseReport;
use crate::strings::studies as strings;

/// Margin around the trial, in points.
const MARGIN: f32 = 14.0;
/// Height of the bar below, in points.
const FOOT: f32 = 64.0;
/// Share of the width that the answer takes, and that of a sort.
const LEFT_SHARE: f32 = 0.52;
const SORT_SHARE: f32 = 0.64;
/// Smallest width of the surface, in points.
const LEAST_SURFACE: f32 = 260.0;
/// Width of what lies beside a line, in points.
const BESIDE_LINE: f32 = 60.0;
const BESIDE_ROW: f32 = 180.0;

/// What stands around a trial.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    /// What the part asks.
    pub(super) instructions: &'a str,
    /// Whether the automatic stroke runs.
    pub(super) is_stroking: bool,
    /// Why the last action had no effect.
    pub(super) problem: Option<&'a str>,
}

/// Draws a trial; returns what is asked for, and the pointer while it strokes.
pub(super) fn trial_ui(
    ui: &mut Ui,
    input: &RunnerInput<'_>,
    stage: &mut StageState,
    state: &TrialState,
    around: Around<'_>,
) -> (Asked, Option<MouseReport>) {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let bar = Frame::new().fill(t.panel).inner_margin(Margin::symmetric(14, 8));
    // The bar below comes last, so that the Tab key goes through the answer first.
    let mut area = ui.available_rect_before_wrap();
    area.max.y -= FOOT;
    let mut mouse = None;
    let builder = egui::UiBuilder::new().max_rect(area).layout(Layout::top_down(Align::Min));
    let mut above = ui.new_child(builder);
    let frame = Frame::new().fill(t.panel).inner_margin(MARGIN);
    CentralPanel::default().frame(frame).show(&mut above, |ui| {
        ui.horizontal_top(|ui| {
            let (width, height) = (ui.available_width(), ui.available_height());
            let left = left_width(input, state, width);
            let top_down = Layout::top_down(Align::Min);
            ui.allocate_ui_with_layout(vec2(left, height), top_down, |ui| {
                ScrollArea::both().id_salt("answer of a trial").auto_shrink(false).show(ui, |ui| {
                    ui.set_max_width(left - GROUP_GAP);
                    asked.merge(answer_ui(ui, input, state, around.instructions));
                });
            });
            ui.allocate_ui_with_layout(ui.available_size(), top_down, |ui| {
                mouse = stage_ui(ui, input, stage, state);
            });
        });
    });
    Side::bottom("foot of a trial").exact_size(FOOT).frame(bar).show(ui, |ui| {
        asked.merge(foot_ui(ui, input, state, around));
    });
    (asked, mouse)
}

/// Longest line with a true length for which a window of this width has room, in points.
pub(crate) fn longest_line(window_width: f32) -> f32 {
    window_width - LEAST_SURFACE - 2.0 * MARGIN - BESIDE_LINE
}

/// Width of the left column, in points: lines of a true length are as long as they are.
fn left_width(input: &RunnerInput<'_>, state: &TrialState, width: f32) -> f32 {
    let needed = match &state.part.design {
        Design::Rating { slider_mm, .. } => *slider_mm as f32 * input.points_per_mm + BESIDE_LINE,
        Design::Mushra { .. } | Design::Anchors { .. } => USUAL_MM * input.points_per_mm + BESIDE_ROW,
        _ => 0.0,
    };
    let share = if matches!(state.trial.task, Task::Sort { .. }) { SORT_SHARE } else { LEFT_SHARE };
    (share * width).max(needed).min((width - LEAST_SURFACE).max(0.5 * width))
}

/// Draws the instructions, the stimuli and the answer.
fn answer_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState, instructions: &str) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    if !instructions.trim().is_empty() {
        ui.add(Label::new(RichText::new(instructions.trim()).color(t.text_weak)).wrap());
        ui.add_space(GROUP_GAP);
    }
    // Tiles and rows of these designs have the stimuli.
    let has_own = matches!(state.trial.task, Task::Sort { .. } | Task::Page { .. } | Task::Place { .. });
    if !has_own {
        asked.merge(stimuli_ui(ui, state));
        ui.add_space(GROUP_GAP);
    }
    asked.merge(task_ui(ui, input, state));
    asked
}

/// Draws the button of the automatic stroke, what is missing, and the button that answers.
fn foot_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState, around: Around<'_>) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    ui.horizontal_centered(|ui| {
        if !state.presenter.is_passive() {
            let name = if around.is_stroking { strings::STROKE_STOP } else { strings::STROKE_START };
            let button = Button::new(name).selected(around.is_stroking).min_size(vec2(TARGET, TARGET));
            if ui.add(button).on_hover_text(strings::STROKE_HELP).clicked() {
                asked.ask(Action::ToggleStroke);
            }
        }
        ui.add_space(GAP);
        // The answer stands at the right edge; the text between fills the rest.
        let answer_width = if state.draft.is_single_choice() { 0.0 } else { 160.0 };
        let size = vec2((ui.available_width() - answer_width - GAP).max(0.0), ui.available_height());
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(size);
            let (text, color) = match around.problem {
                Some(problem) => (problem.to_owned(), t.error),
                None => (missing(input, state), t.text_weak),
            };
            ui.add(Label::new(RichText::new(text).color(color)).wrap());
        });
        if !state.draft.is_single_choice() {
            let can_answer = state.response().is_some();
            let text = RichText::new(strings::NEXT).strong();
            let button = if can_answer { primary_button(t, text, true) } else { Button::new(text) };
            let button = button.min_size(vec2(150.0, TARGET));
            if ui.add_enabled(can_answer, button).on_hover_text(strings::NEXT_HELP).clicked() {
                asked.ask(Action::Answer);
            }
        }
    });
    asked
}

/// What the participant has to do before the answer; empty if nothing is missing.
fn missing(input: &RunnerInput<'_>, state: &TrialState) -> String {
    let labels = |indices: Vec<usize>| -> Vec<&str> {
        let shown = indices.into_iter().filter_map(|index| state.shown.get(index));
        shown.map(|shown| shown.label.as_str()).filter(|label| !label.is_empty()).collect()
    };
    let untouched = state.untouched();
    if !untouched.is_empty() {
        // Without an output, nobody knows where the tip is.
        let is_closed = input.session.status().is_none_or(|status| status.state == LinkState::Lost);
        return if is_closed {
            strings::NOTHING_FELT.to_owned()
        } else if state.is_detection() {
            strings::TOUCH_BOTH.to_owned()
        } else {
            strings::touch_first(&labels(untouched))
        };
    }
    let not_started = state.presenter.not_started();
    let is_free = !state.presenter.is_timed(state.now_secs());
    if !not_started.is_empty() && is_free {
        return strings::feel_first(&labels(not_started));
    }
    if !state.can_answer() {
        return String::new();
    }
    strings::keys_of(&state.trial.task).to_owned()
}
