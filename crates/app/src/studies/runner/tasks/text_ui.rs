//! Questionnaire about a texture that is made from a text.

use egui::{Button, Id, Label, Margin, RichText, TextEdit, Ui, vec2};
use shagreen_core::people::study::plan::{Design, ShownControls};

use crate::look::motion::busy_ui;
use crate::look::theme::{GAP, GROUP_GAP, RADIUS, tokens};
use crate::strings::studies as strings;
use crate::studies::runner::RunnerInput;
use crate::studies::runner::actions::{Action, Asked, Field};
use crate::studies::runner::draft::Draft;
use crate::studies::runner::line_slider::line_slider;
use crate::studies::runner::stimuli_ui::TARGET;
use crate::studies::runner::tasks::grades_ui::{Scale, scale_ui};
use crate::studies::runner::text_texture::TextTexture;
use crate::studies::runner::trial_state::TrialState;

/// Longest text, in characters.
const MOST_CHARACTERS: usize = 200;
/// Length of the sliders of the attributes, in points.
const SLIDER: f32 = 320.0;

/// Draws the field of the text; once its texture is made, the statements.
pub(super) fn question_ui(ui: &mut Ui, input: &RunnerInput<'_>, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let Some(texture) = &state.text else { return asked };
    if texture.is_writing() {
        asked.merge(writing_ui(ui, texture, state.is_first_frame()));
        return asked;
    }
    ui.add(Label::new(RichText::new(strings::quoted(texture.text())).strong()).wrap());
    ui.add_space(GAP);
    if texture.is_making() {
        ui.horizontal(|ui| {
            busy_ui(ui);
            ui.label(strings::MAKING);
        });
        return asked;
    }
    if texture.shown() == ShownControls::PictureAndSliders {
        asked.merge(attributes_ui(ui, input, texture));
        ui.add_space(GROUP_GAP);
    }
    asked.merge(statements_ui(ui, state));
    asked
}

/// Draws the field in which the participant describes a texture.
fn writing_ui(ui: &mut Ui, texture: &TextTexture, is_first_frame: bool) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    ui.label(strings::DESCRIBE_HELP);
    let mut text = texture.text().to_owned();
    let id = Id::unique("text of a study");
    let field = TextEdit::singleline(&mut text).id(id).char_limit(MOST_CHARACTERS);
    let field = field.desired_width(ui.available_width()).margin(Margin::same(10));
    let field = ui.add(field).accessible_name(strings::TEXT);
    asked.fields.push((id, Field::Text));
    if is_first_frame {
        field.request_focus();
    }
    let is_empty = text.trim().is_empty();
    if field.changed() {
        asked.ask(Action::Write(text));
    }
    ui.add_space(GAP);
    let button = Button::new(strings::DESCRIBE).min_size(vec2(TARGET, TARGET));
    if ui.add_enabled(!is_empty, button).clicked() {
        asked.ask(Action::Describe);
    }
    if let Some(failure) = texture.failure() {
        ui.add(Label::new(RichText::new(failure).color(t.error)).wrap());
    }
    asked
}

/// Draws the sliders that move the texture along the first two axes of the space.
fn attributes_ui(ui: &mut Ui, input: &RunnerInput<'_>, texture: &TextTexture) -> Asked {
    let mut asked = Asked::default();
    let Some(at) = texture.at() else { return asked };
    for (axis, [low, high]) in input.session.poles().iter().enumerate().take(2) {
        let value = at.get(axis);
        let name = strings::between(low, high);
        ui.label(&name);
        let (response, moved) = line_slider(ui, &name, value, SLIDER);
        asked.fields.push((response.id, Field::Slider));
        if let Some(value) = moved {
            asked.ask(Action::Move(axis, value));
        }
    }
    asked
}

/// Draws each statement with its scale; the keyboard grades the selected one.
fn statements_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let (Draft::Grades(grades), Design::Likert { statements, .. }) = (&state.draft, &state.part.design)
    else {
        return asked;
    };
    for (index, (statement, grade)) in statements.iter().zip(grades).enumerate() {
        let is_selected = index == state.selected;
        let frame = egui::Frame::new().corner_radius(RADIUS).inner_margin(GAP);
        let frame = if is_selected { frame.fill(t.raised) } else { frame };
        frame.show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.add(Label::new(RichText::new(&statement.text).strong()).wrap());
            let scale = Scale::of(&state.part.design);
            asked.merge(scale_ui(ui, scale, (index, &statement.text), *grade));
        });
        ui.add_space(GAP);
    }
    asked
}
