//! What the participant answers with: one file for each kind of answer.

mod choices_ui;
mod grades_ui;
mod number_ui;
mod sliders_ui;
mod sort_ui;
mod text_ui;
mod votes_ui;

use egui::Ui;
use shagreen_core::people::study::trial::Task;

use super::RunnerInput;
use super::actions::Asked;
use super::trial_state::TrialState;

/// Draws the widgets of the answer to a trial.
pub(super) fn task_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState) -> Asked {
    match &state.trial.task {
        Task::Sort { .. } => sort_ui::sort_ui(ui, state),
        Task::Vote { .. } => votes_ui::votes_ui(ui, state),
        Task::Rate { .. } => sliders_ui::ratings_ui(ui, input, state),
        Task::Page { .. } => sliders_ui::page_ui(ui, input, state),
        Task::Place { .. } => sliders_ui::place_ui(ui, input, state),
        Task::Compare { .. } => number_ui::number_ui(ui, state),
        Task::Discriminate { .. } | Task::Detect { .. } | Task::Match { .. } => {
            choices_ui::choices_ui(ui, state)
        }
        Task::Grade { .. } => grades_ui::grade_ui(ui, state),
        Task::Question { .. } => text_ui::question_ui(ui, input, state),
    }
}
