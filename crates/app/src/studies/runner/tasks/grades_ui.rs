//! Grades on a scale from 1, with the meaning of both ends.

use egui::{Label, RichText, Ui};
use shagreen_core::people::study::plan::Design;

use crate::look::theme::{GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::runner::actions::{Action, Asked};
use crate::studies::runner::draft::{Draft, Entry};
use crate::studies::runner::stimuli_ui::target_button;
use crate::studies::runner::trial_state::TrialState;

/// Scale of grades.
#[derive(Clone, Copy)]
pub(super) struct Scale<'a> {
    pub(super) n_points: u32,
    /// Meaning of 1.
    pub(super) low: &'a str,
    /// Meaning of the highest grade.
    pub(super) high: &'a str,
}

impl<'a> Scale<'a> {
    /// Scale of a design with grades; without any, one grade.
    pub(super) fn of(design: &'a Design) -> Self {
        match design {
            Design::Similarity { n_points, low, high, .. } | Design::Likert { n_points, low, high, .. } => {
                Self { n_points: *n_points, low, high }
            }
            _ => Self { n_points: 1, low: "", high: "" },
        }
    }
}

/// Draws the grade of the similarity of two stimuli.
pub(super) fn grade_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let chosen = if let Draft::Grade(grade) = &state.draft { *grade } else { None };
    scale_ui(ui, Scale::of(&state.part.design), (0, strings::GRADE), chosen)
}

/// Draws the buttons of a scale below its ends; `of` is the index of the statement and its name for screen readers.
pub(super) fn scale_ui(
    ui: &mut Ui,
    scale: Scale<'_>,
    (index, name): (usize, &str),
    chosen: Option<u32>,
) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let end = |ui: &mut Ui, grade: u32, meaning: &str| {
        let text = RichText::new(strings::end_of_scale(grade, meaning)).color(t.text_weak);
        ui.add(Label::new(text).wrap().selectable(false));
    };
    end(ui, 1, scale.low);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        for grade in 1..=scale.n_points {
            let is_chosen = chosen == Some(grade);
            let text = RichText::new(grade.to_string()).strong();
            let button = ui.add(target_button(is_chosen, text));
            if button.accessible_name(strings::grade(name, grade)).clicked() {
                asked.ask(Action::Select(index));
                asked.ask(Action::Enter(Entry::Grade(index, grade)));
            }
        }
    });
    end(ui, scale.n_points, scale.high);
    asked
}
