//! The model of d': its name, buttons that choose another one, and its origin.

use egui::{Button, Label, RichText, Ui};

use super::model_choice::ModelChoice;
use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::theme::tokens;
use crate::strings::differences as strings;

/// Draws the name of the model and its buttons, in a row; returns the requested commands.
pub(super) fn model_ui(ui: &mut Ui, choice: &ModelChoice) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let text = RichText::new(strings::MODEL).color(t.text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(strings::MODEL_HELP);
    let open = ui.button(strings::OPEN_MODEL).accessible_name(strings::OPEN_MODEL_NAME);
    if open.on_hover_text(strings::OPEN_MODEL_HELP).clicked() {
        commands.push(Command::Signals(SignalsCommand::AskWhichModel));
    }
    // After a refused file, the button also makes the settings forget it.
    let can_return = choice.own().is_some() || choice.failure().is_some();
    let built_in = ui.add_enabled(can_return, Button::new(strings::BUILT_IN));
    let built_in = built_in.accessible_name(strings::BUILT_IN_NAME);
    if built_in.on_hover_text(strings::BUILT_IN_HELP).on_disabled_hover_text(strings::BUILT_IN_HELP).clicked()
    {
        commands.push(Command::Signals(SignalsCommand::UseBuiltInModel));
    }
    if let Some(model) = choice.own() {
        let name = Label::new(&model.name).truncate().selectable(false);
        ui.add(name.show_tooltip_when_elided(false)).on_hover_text(&model.name);
    }
    commands
}

/// Draws the origin of an opened model, and doubts about it. If the last file was refused, also why.
pub(super) fn origin_ui(ui: &mut Ui, choice: &ModelChoice) {
    let t = tokens(ui.ctx());
    let origin = choice.own().map(|model| strings::origin(&model.name, &model.origin()));
    let doubt = choice.own().and_then(|model| model.doubt());
    let failure = choice.failure().map(str::to_owned);
    for (line, color) in [(origin, t.text_weak), (doubt, t.warning), (failure, t.error)] {
        if let Some(line) = line {
            ui.add(Label::new(RichText::new(line).small().color(color)).wrap());
        }
    }
}
