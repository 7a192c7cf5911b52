//! Buttons of the stimuli with their blind labels, and what plays.

use egui::{Atom, Button, Label, RichText, Ui, vec2};

use super::actions::{Action, Asked};
use super::presenter::Presenter;
use super::trial_state::TrialState;
use crate::look::theme::tokens;
use crate::strings::studies as strings;

/// Smallest width and height of anything that a finger touches, in points.
pub(super) const TARGET: f32 = 44.0;

/// Draws a button for each stimulus, or for those that start by themselves what plays and a button that repeats them.
pub(super) fn stimuli_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    ui.horizontal_wrapped(|ui| {
        if state.shown.len() > 1 && !state.presenter.is_passive() {
            for index in 0..state.shown.len() {
                asked.merge(stimulus_button(ui, state, index));
            }
            return;
        }
        if state.presenter.is_passive() {
            for (index, shown) in state.shown.iter().enumerate() {
                playing_ui(ui, &shown.label, state.presenter.playing() == Some(index));
            }
        }
        let can_repeat = state.presenter.can_repeat();
        if can_repeat || state.presenter.is_passive() {
            let button = Button::new(strings::REPEAT).min_size(vec2(TARGET, TARGET));
            let button = ui.add_enabled(can_repeat, button).on_hover_text(strings::REPEAT_HELP);
            if button.clicked() {
                asked.ask(Action::Repeat);
            }
        }
    });
    asked
}

/// A button of at least the size of a target, with its text in the middle.
pub(super) fn target_button(is_selected: bool, text: RichText) -> Button<'static> {
    let button = Button::selectable(is_selected, (Atom::grow(), text, Atom::grow())).gap(0.0);
    button.frame_when_inactive(true).min_size(vec2(TARGET, TARGET))
}

/// Draws the button of a stimulus, which starts and stops it.
pub(super) fn stimulus_button(ui: &mut Ui, state: &TrialState, index: usize) -> Asked {
    let mut asked = Asked::default();
    let Some(shown) = state.shown.get(index) else { return asked };
    let is_playing = state.presenter.playing() == Some(index);
    let text = RichText::new(&shown.label).strong();
    let button = target_button(is_playing, text);
    let is_usable = is_playing || state.presenter.can_start(index, state.now_secs());
    let button = ui.add_enabled(is_usable, button);
    let button = button.accessible_name(strings::play(&shown.label));
    // It plays from the press on, so that it can be held while the other hand strokes. The release of this press stops nothing.
    let id = button.id.with("started by this press");
    let is_started: bool = ui.data(|data| data.get_temp(id)).unwrap_or(false);
    if button.is_pointer_button_down_on() && !is_playing && !is_started && is_usable {
        ui.data_mut(|data| data.insert_temp(id, true));
        asked.ask(Action::Play(index));
    } else if !button.is_pointer_button_down_on() {
        ui.data_mut(|data| data.remove::<bool>(id));
        if button.clicked() && !is_started {
            asked.ask(Action::Play(index));
        }
    }
    button.on_hover_text(play_help(&state.presenter, index));
    asked
}

/// What a click on the button of a stimulus does, and how often it still can.
pub(super) fn play_help(presenter: &Presenter, index: usize) -> String {
    presenter.n_plays_left(index).map_or(strings::PLAY_HELP.to_owned(), strings::plays_left)
}

/// Draws the label of a stimulus that starts by itself, marked while it plays.
fn playing_ui(ui: &mut Ui, label: &str, is_playing: bool) {
    let t = tokens(ui.ctx());
    let color = if is_playing { t.accent } else { t.text_weak };
    let text = if is_playing { strings::playing(label) } else { label.to_owned() };
    let size = vec2(2.0 * TARGET, TARGET);
    ui.add_sized(size, Label::new(RichText::new(text).strong().color(color)).selectable(false));
}
