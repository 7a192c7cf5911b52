//! Check list of adjectives that describe a stimulus.

use egui::{Checkbox, Ui, vec2};
use shagreen_core::people::study::plan::Design;

use crate::look::theme::GAP;
use crate::studies::runner::actions::{Action, Asked, Field};
use crate::studies::runner::draft::{Draft, Entry};
use crate::studies::runner::stimuli_ui::TARGET;
use crate::studies::runner::trial_state::TrialState;

/// Width of an adjective, in points.
const WIDTH: f32 = 170.0;

/// Draws the adjectives in columns. The first one has the keyboard focus at the beginning, and arrows move it.
pub(super) fn votes_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let (Draft::Votes(votes), Design::Relevance { adjectives, .. }) = (&state.draft, &state.part.design)
    else {
        return asked;
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
        for (index, (adjective, vote)) in adjectives.iter().zip(votes).enumerate() {
            let mut is_chosen = *vote;
            let size = vec2(WIDTH, TARGET);
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            let check = ui.allocate_ui_with_layout(size, layout, |ui| {
                ui.set_min_size(size);
                ui.add(Checkbox::new(&mut is_chosen, adjective.as_str()))
            });
            let check = check.inner;
            asked.fields.push((check.id, Field::Check));
            if index == 0 && state.is_first_frame() {
                check.request_focus();
            }
            if is_chosen != *vote {
                asked.ask(Action::Enter(Entry::Vote(index, is_chosen)));
            }
        }
    });
    asked
}
