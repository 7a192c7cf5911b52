//! Lines between two ends: adjective pairs, rows beside a reference, and the line between two anchors.

use egui::{Align, Label, Layout, RichText, Ui, vec2};
use shagreen_core::people::study::plan::Design;

use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::runner::RunnerInput;
use crate::studies::runner::actions::{Action, Asked, Field};
use crate::studies::runner::draft::{Draft, Entry};
use crate::studies::runner::line_slider::{HEIGHT, USUAL_MM, line_slider};
use crate::studies::runner::stimuli_ui::stimulus_button;
use crate::studies::runner::trial_state::TrialState;

/// Draws a line for each adjective pair, in the true length of the plan.
pub(super) fn ratings_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let Design::Rating { pairs, slider_mm, .. } = &state.part.design else { return asked };
    let length = *slider_mm as f32 * input.points_per_mm;
    for (index, pair) in pairs.iter().enumerate() {
        ends_ui(ui, [&pair.low, &pair.high], length);
        asked.merge(slider_ui(ui, state, index, &strings::between(&pair.low, &pair.high), length));
        ui.add_space(GAP);
    }
    asked
}

/// Draws a row for each stimulus beside the reference: its button and its line.
pub(super) fn page_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let length = USUAL_MM * input.points_per_mm;
    // The reference comes first.
    asked.merge(stimulus_button(ui, state, 0));
    ui.add_space(GROUP_GAP);
    let n_rows = state.shown.len().saturating_sub(1);
    for index in 0..n_rows {
        ui.horizontal(|ui| {
            asked.merge(stimulus_button(ui, state, index + 1));
            ui.vertical(|ui| {
                if index == 0 {
                    ends_ui(ui, [strings::BAD, strings::EXCELLENT], length);
                }
                let name = strings::quality(&state.shown[index + 1].label);
                asked.merge(slider_ui(ui, state, index, &name, length));
            });
        });
        ui.add_space(GAP);
    }
    asked
}

/// Draws the line between two anchors, with the button of each at its end, and that of the stimulus above.
pub(super) fn place_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let length = USUAL_MM * input.points_per_mm;
    asked.merge(stimulus_button(ui, state, 2));
    ui.add_space(GROUP_GAP);
    ui.horizontal(|ui| {
        asked.merge(stimulus_button(ui, state, 0));
        asked.merge(slider_ui(ui, state, 0, strings::PLACE, length));
        asked.merge(stimulus_button(ui, state, 1));
    });
    asked
}

/// Draws the words at both ends of a line.
fn ends_ui(ui: &mut Ui, [low, high]: [&str; 2], length: f32) {
    let t = tokens(ui.ctx());
    let word = |text: &str| Label::new(RichText::new(text).color(t.text)).selectable(false);
    let size = vec2(length + 20.0, ui.text_style_height(&egui::TextStyle::Body));
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.add(word(low));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.add(word(high)));
    });
}

/// Draws a line of this length in points. The first one has the keyboard focus at the beginning.
fn slider_ui(ui: &mut Ui, state: &TrialState, index: usize, name: &str, length: f32) -> Asked {
    let mut asked = Asked::default();
    let value =
        if let Draft::Sliders(values) = &state.draft { values.get(index).copied().flatten() } else { None };
    let size = vec2(length + 20.0, HEIGHT);
    let shown = ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
        line_slider(ui, name, value, length)
    });
    let (response, moved) = shown.inner;
    asked.fields.push((response.id, Field::Slider));
    if index == 0 && state.is_first_frame() {
        response.request_focus();
    }
    if let Some(value) = moved {
        asked.ask(Action::Enter(Entry::Slider(index, value)));
    }
    asked
}
