//! Number for the dissimilarity of two stimuli, on a scale of the participant's own.

use egui::{Id, Label, Margin, RichText, TextEdit, Ui};

use crate::look::theme::{GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::runner::actions::{Action, Asked, Field};
use crate::studies::runner::draft::{Draft, Entry, number_of};
use crate::studies::runner::trial_state::TrialState;

/// Width of the field, in points.
const WIDTH: f32 = 200.0;
/// Longest number, in characters.
const MOST_CHARACTERS: usize = 20;

/// Draws the field of the number.
pub(super) fn number_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let Draft::Number(number) = &state.draft else { return asked };
    ui.add(Label::new(RichText::new(strings::NUMBER_HELP).color(t.text_weak)).wrap());
    ui.add_space(GAP);
    let mut text = number.clone();
    let id = Id::unique("number of a study");
    let field = TextEdit::singleline(&mut text).id(id).char_limit(MOST_CHARACTERS).desired_width(WIDTH);
    let field = ui.add(field.margin(Margin::same(10))).accessible_name(strings::NUMBER);
    asked.fields.push((id, Field::Number));
    if field.changed() {
        // Letters start the stimuli.
        text.retain(|c| c.is_ascii_digit() || c == '.' || c == ',');
        asked.ask(Action::Enter(Entry::Number(text)));
    }
    // The number can be typed at once.
    if state.is_first_frame() {
        field.request_focus();
    }
    if !number.is_empty() && number_of(number).is_none() {
        ui.add(Label::new(RichText::new(strings::NO_NUMBER).color(t.error)).wrap());
    }
    asked
}
