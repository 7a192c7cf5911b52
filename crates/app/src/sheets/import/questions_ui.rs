//! Controls for information that a file does not contain. Guesses are marked as such, answers can be changed, and one that
//! cannot be used says why.

use std::collections::BTreeMap;

use egui::{Align, ComboBox, Label, Layout, RichText, TextEdit, Ui, vec2};
use shagreen_formats::recording::{Ask, Question};

use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, RADIUS, tokens};
use crate::sheets::import::recording_state::RecordingState;
use crate::strings::import as strings;
use crate::strings::sentence;

/// Largest width of the text of a question, in points: in a wide sheet, its answer stays beside it.
const MOST_TEXT_WIDTH: f32 = 560.0;
/// Width of an answer control, in points.
const ANSWER_WIDTH: f32 = 128.0;
/// Width of the mark beside it, in points.
const MARK_WIDTH: f32 = 62.0;

/// State of an answer.
#[derive(Clone, Copy)]
enum Given<'a> {
    /// There is none yet.
    Missing,
    /// The answer.
    Answer(&'a str),
    /// It cannot be used, for this reason.
    Wrong(&'a str),
}

/// Typed texts by the key of their question.
type Typed = BTreeMap<&'static str, String>;

/// Answer given in this frame.
pub(super) struct Answer {
    pub(super) question: Question,
    pub(super) text: String,
}

/// Draws the questions of a recording, including those already answered; returns a new answer.
pub(super) fn questions_ui(ui: &mut Ui, state: &mut RecordingState) -> Option<Answer> {
    let RecordingState { answered, wrong, outcome, typed, .. } = state;
    let wrong = wrong.iter().map(|wrong| (&wrong.question, Given::Wrong(&wrong.reason)));
    let answered = answered.iter().map(|(question, answer)| (question, Given::Answer(answer)));
    // In a fixed order, so that an answer does not move the other questions.
    let mut all: Vec<(&Question, Given<'_>)> = answered.chain(wrong).collect();
    for question in &outcome.questions {
        if all.iter().all(|(other, _)| other.what != question.what) {
            all.push((question, Given::Missing));
        }
    }
    all.sort_by_key(|(question, _)| question.what.key());
    if all.is_empty() {
        return None;
    }
    let t = tokens(ui.ctx());
    let mut given = None;
    let frame = egui::Frame::new().fill(t.raised).corner_radius(RADIUS).inner_margin(10.0);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.add(Label::new(RichText::new(strings::ASKS).strong()).selectable(false));
        for (question, state) in &all {
            if let Some(text) = question_ui(ui, question, *state, typed) {
                given = Some(Answer { question: (*question).clone(), text });
            }
        }
    });
    given
}

/// Draws one question: the sentence on the left, its answer and the source of the answer on the right. Below it, why the
/// last answer cannot be used.
fn question_ui(ui: &mut Ui, question: &Question, state: Given<'_>, typed: &mut Typed) -> Option<String> {
    let width = ui.available_width();
    let height = ui.spacing().interact_size.y;
    let answers_width = if is_wide(question) { 2.0 * ANSWER_WIDTH + GAP } else { ANSWER_WIDTH };
    let room = width - answers_width - MARK_WIDTH - 2.0 * GAP;
    let text_width = room.clamp(ANSWER_WIDTH, MOST_TEXT_WIDTH);
    let row = ui.horizontal(|ui| {
        let in_column = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(vec2(text_width, height), in_column, |ui| {
            ui.set_min_size(vec2(text_width, height));
            ui.add(Label::new(sentence(&question.text)).wrap().selectable(false));
        });
        let given = control_ui(ui, question, state, typed);
        mark_ui(ui, question, state);
        given
    });
    if let Given::Wrong(reason) = state {
        let text = RichText::new(sentence(reason)).color(tokens(ui.ctx()).error);
        ui.add(Label::new(text).wrap());
    }
    row.inner
}

/// Whether the answer needs twice the width: a choice beside a field, or a list of channels.
fn is_wide(question: &Question) -> bool {
    let takes_constant = matches!(question.what, Ask::Speed | Ask::Force) && !question.choices.is_empty();
    takes_constant || question.what == Ask::Channels
}

/// Draws a choice, a field, or both if a constant is accepted; returns a new answer.
fn control_ui(ui: &mut Ui, question: &Question, state: Given<'_>, typed: &mut Typed) -> Option<String> {
    let mut given = None;
    let name = strings::answer_of(question.what.key());
    let answer = if let Given::Answer(answer) = state { Some(answer) } else { None };
    if !question.choices.is_empty() {
        let current = answer.or(question.guess.as_deref());
        let shown = current.map_or(strings::CHOOSE.to_owned(), strings::answer);
        let combo = ComboBox::from_id_salt(("answer", question.what.key()))
            .width(ANSWER_WIDTH)
            .truncate()
            .selected_text(shown);
        let combo = combo.show_list(ui, |ui| {
            for choice in &question.choices {
                let is_current = current == Some(choice.as_str());
                if ui.selectable_label(is_current, strings::answer(choice)).clicked() {
                    given = Some(choice.clone());
                }
            }
        });
        combo.response.accessible_name(&name);
    }
    let (hint, width) = match question.what {
        Ask::Speed => (strings::SPEED_HINT, ANSWER_WIDTH),
        Ask::Force => (strings::FORCE_HINT, ANSWER_WIDTH),
        Ask::Channels => (strings::CHANNELS_HINT, 2.0 * ANSWER_WIDTH + GAP),
        _ if question.choices.is_empty() => (strings::NUMBER_HINT, ANSWER_WIDTH),
        _ => return given,
    };
    let said = answer.filter(|answer| !question.choices.iter().any(|choice| choice == answer));
    let said = said.or(question.guess.as_deref().filter(|_| question.choices.is_empty()));
    let key = question.what.key();
    let mut text = typed.get(key).cloned().unwrap_or_else(|| said.unwrap_or("").to_owned());
    // An id of its own: a message that appears or goes above it must not move the keyboard focus to another field.
    let field = TextEdit::singleline(&mut text).id_salt(("typed answer", key)).hint_text(hint);
    let field = ui.add(field.desired_width(width - 8.0));
    let field = field.accessible_name(strings::typed(&name));
    if field.changed() {
        typed.insert(key, text.clone());
    }
    let text = text.trim();
    if field.lost_focus() && !text.is_empty() && said != Some(text) {
        given = Some(text.to_owned());
    }
    given
}

/// Draws whether the displayed answer is a guess, given by the user, unusable, or missing.
fn mark_ui(ui: &mut Ui, question: &Question, state: Given<'_>) {
    let t = tokens(ui.ctx());
    let (text, color, help) = match (state, &question.guess) {
        (Given::Answer(_), _) => (strings::ANSWERED, t.accent, ""),
        (Given::Wrong(_), _) => (strings::WRONG, t.error, ""),
        (Given::Missing, Some(_)) => (strings::GUESS, t.warning, strings::GUESS_HELP),
        (Given::Missing, None) => (strings::NEEDED, t.error, ""),
    };
    let label = ui.add(Label::new(RichText::new(text).small().color(color)).selectable(false));
    if !help.is_empty() {
        label.on_hover_text(help);
    }
}
