//! Two alternatives, of which one is the whole answer: same or different, left or right, A or B.

use egui::{Button, RichText, Ui, vec2};
use shagreen_core::people::study::trial::{Side, Task};

use crate::strings::studies as strings;
use crate::studies::runner::actions::{Action, Asked};
use crate::studies::runner::draft::Entry;
use crate::studies::runner::trial_state::TrialState;

/// Size of the button of an alternative, in points.
const SIZE: [f32; 2] = [180.0, 64.0];

/// Draws both alternatives, with their keys.
pub(super) fn choices_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let sides = |names: [&'static str; 2]| {
        [(names[0], Entry::Side(Side::First)), (names[1], Entry::Side(Side::Second))]
    };
    let alternatives = match &state.trial.task {
        Task::Detect { .. } => sides([strings::LEFT, strings::RIGHT]),
        Task::Match { .. } => sides([strings::X_IS_A, strings::X_IS_B]),
        _ => [(strings::SAME, Entry::IsDifferent(false)), (strings::DIFFERENT, Entry::IsDifferent(true))],
    };
    ui.horizontal(|ui| {
        for (number, (name, entry)) in (1..).zip(alternatives) {
            let text = RichText::new(strings::with_key(name, number)).strong();
            let button = Button::new(text).min_size(vec2(SIZE[0], SIZE[1]));
            let button = ui.add_enabled(state.can_answer(), button).accessible_name(name);
            if button.clicked() {
                asked.ask(Action::Enter(entry));
            }
        }
    });
    asked
}
