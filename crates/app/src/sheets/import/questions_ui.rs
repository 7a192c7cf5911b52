//! Controls for information that a file does not contain. Guesses are marked as such, and answers can be changed.

use egui::{Align, ComboBox, Key, Label, Layout, RichText, TextEdit, Ui, vec2};
use shagreen_formats::recording::{Ask, Question};

use crate::look::theme::{GAP, RADIUS, tokens};
use crate::sheets::import::recording_state::RecordingState;
use crate::strings::import as strings;

/// Width of an answer control, in points.
const ANSWER_WIDTH: f32 = 128.0;
/// Width of the mark beside it, in points.
const MARK_WIDTH: f32 = 62.0;

/// Answer given in this frame.
pub(super) struct Answer {
    pub(super) question: Question,
    pub(super) text: String,
}

/// Draws the questions of a recording, including those already answered; returns a new answer.
pub(super) fn questions_ui(ui: &mut Ui, state: &RecordingState) -> Option<Answer> {
    let answered = state.answered.iter().map(|(question, answer)| (question, Some(answer.as_str())));
    let is_answered = |q: &&Question| state.answered.iter().any(|(other, _)| other.what == q.what);
    let open = state.outcome.questions.iter().filter(|q| !is_answered(q)).map(|question| (question, None));
    // In a fixed order, so that an answer does not move the other questions.
    let mut all: Vec<(&Question, Option<&str>)> = answered.chain(open).collect();
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
        for (question, answer) in &all {
            if let Some(text) = question_ui(ui, question, *answer) {
                given = Some(Answer { question: (*question).clone(), text });
            }
        }
        if let Some(error) = &state.answer_error {
            ui.add(Label::new(RichText::new(error).color(t.error)).wrap());
        }
    });
    given
}

/// Draws one question: the sentence on the left, its answer and the source of the answer on the right.
fn question_ui(ui: &mut Ui, question: &Question, answer: Option<&str>) -> Option<String> {
    let width = ui.available_width();
    let height = ui.spacing().interact_size.y;
    let answers_width = ANSWER_WIDTH + if takes_constant(question) { ANSWER_WIDTH + GAP } else { 0.0 };
    let text_width = (width - answers_width - MARK_WIDTH - 2.0 * GAP).max(ANSWER_WIDTH);
    ui.horizontal(|ui| {
        let in_column = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(vec2(text_width, height), in_column, |ui| {
            ui.set_min_size(vec2(text_width, height));
            ui.add(Label::new(sentence(&question.text)).wrap().selectable(false));
        });
        let given = control_ui(ui, question, answer);
        mark_ui(ui, question, answer);
        given
    })
    .inner
}

/// Whether a number with its unit is also accepted as an answer.
fn takes_constant(question: &Question) -> bool {
    matches!(question.what, Ask::Speed | Ask::Force) && !question.choices.is_empty()
}

/// Text with a capital first letter.
pub(super) fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Draws a choice, a field, or both if a constant is accepted; returns a new answer.
fn control_ui(ui: &mut Ui, question: &Question, answer: Option<&str>) -> Option<String> {
    let mut given = None;
    let name = strings::answer_of(question.what.key());
    {
        if !question.choices.is_empty() {
            let current = answer.or(question.guess.as_deref());
            let shown = current.map_or(strings::CHOOSE.to_owned(), strings::answer);
            let combo = ComboBox::from_id_salt(("answer", question.what.key()))
                .width(ANSWER_WIDTH)
                .truncate()
                .selected_text(shown);
            let combo = combo.show_ui(ui, |ui| {
                for choice in &question.choices {
                    let is_current = current == Some(choice.as_str());
                    if ui.selectable_label(is_current, strings::answer(choice)).clicked() {
                        given = Some(choice.clone());
                    }
                }
            });
            combo.response.accessible_name(&name);
        }
        let hint = match question.what {
            Ask::Speed => strings::SPEED_HINT,
            Ask::Force => strings::FORCE_HINT,
            _ if question.choices.is_empty() => strings::NUMBER_HINT,
            _ => return given,
        };
        let id = ui.scope_id().with(("typed", question.what.key()));
        let said = answer.filter(|answer| !question.choices.iter().any(|choice| choice == answer));
        let said = said.or(question.guess.as_deref().filter(|_| question.choices.is_empty()));
        let mut text = ui.data(|d| d.get_temp::<String>(id)).unwrap_or_else(|| said.unwrap_or("").to_owned());
        let field = ui.add(TextEdit::singleline(&mut text).hint_text(hint).desired_width(ANSWER_WIDTH - 8.0));
        let field = field.accessible_name(strings::typed(&name));
        let is_entered = field.lost_focus()
            && (ui.input(|i| i.key_pressed(Key::Enter)) || !text.trim().is_empty())
            && said != Some(text.trim());
        ui.data_mut(|d| d.insert_temp(id, text.clone()));
        if is_entered && !text.trim().is_empty() {
            given = Some(text.trim().to_owned());
        }
    }
    given
}

/// Draws whether the displayed answer is a guess, given by the user, or missing.
fn mark_ui(ui: &mut Ui, question: &Question, answer: Option<&str>) {
    let t = tokens(ui.ctx());
    let (text, color, help) = match (answer, &question.guess) {
        (Some(_), _) => (strings::ANSWERED, t.accent, ""),
        (None, Some(_)) => (strings::GUESS, t.warning, strings::GUESS_HELP),
        (None, None) => (strings::NEEDED, t.error, ""),
    };
    let label = ui.add(Label::new(RichText::new(text).small().color(color)).selectable(false));
    if !help.is_empty() {
        label.on_hover_text(help);
    }
}
