//! Question about a picture: whether it finds its point, or becomes the relief of a texture.

use egui::{Button, Context, Label, RichText, Ui, vec2};
use shagreen_core::surfaces::prompt::title;

use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::state::source::Source;
use crate::strings::relief as strings;

/// Width of the sheet, in points.
const WIDTH: f32 = 420.0;
/// Most characters of the prompt on a button.
const LONGEST_WORDS: usize = 40;

pub(crate) struct ReliefChoice {
    picture: Source,
    of: ReliefOf,
    /// Name of the texture.
    name: String,
    /// Words in the prompt box, if they are about touch.
    prompt: Option<String>,
    is_focused: bool,
}

impl ReliefChoice {
    /// Question about a picture; `name` is that of the texture that would get the relief, `prompt` a description of the
    /// surface.
    pub(crate) fn new(picture: Source, of: ReliefOf, name: String, prompt: Option<String>) -> Self {
        Self { picture, of, name, prompt, is_focused: false }
    }

    /// Draws the question; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        sheet(ctx, "use of a picture", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        })
        .inner
    }

    fn content_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        ui.add(Label::new(RichText::new(strings::ASK_TITLE).heading().strong()).selectable(false));
        ui.add(Label::new(RichText::new(self.picture.name()).color(t.text_weak)).truncate());
        ui.add_space(GAP);
        let find = ui.add(wide(ui, strings::FIND_POINT)).on_hover_text(strings::FIND_POINT_HELP);
        if !std::mem::replace(&mut self.is_focused, true) {
            find.request_focus();
        }
        if find.clicked() {
            let look = Command::Prompt(PromptCommand::Look(vec![self.picture.clone()]));
            commands.extend([Command::CloseSheet, look]);
        }
        if let Some(prompt) = &self.prompt {
            let words = title(prompt, LONGEST_WORDS).unwrap_or_default();
            let find_with = strings::find_point_with(&words);
            let find = ui.add(wide(ui, &find_with).truncate()).accessible_name(&find_with);
            if find.on_hover_text(strings::FIND_POINT_WITH_HELP).clicked() {
                let (photo, prompt) = (self.picture.clone(), prompt.clone());
                let look = Command::Prompt(PromptCommand::LookWith { photo, prompt });
                commands.extend([Command::CloseSheet, look]);
            }
        }
        let use_it = strings::use_as_relief(&self.name);
        let relief = ui.add(wide(ui, &use_it).truncate()).accessible_name(&use_it);
        if relief.on_hover_text(strings::RELIEF_HELP).clicked() {
            let begin = ReliefCommand::Begin(Some(self.of.clone()), Some(self.picture.clone()));
            commands.push(Command::Relief(begin));
        }
        ui.add_space(GAP);
        if foot_ui(ui, |ui| ui.button(strings::CANCEL).clicked()) {
            commands.push(Command::CloseSheet);
        }
        commands
    }
}

/// Button over the width of the sheet.
fn wide<'a>(ui: &Ui, text: &'a str) -> Button<'a> {
    Button::new(text).min_size(vec2(ui.available_width(), 0.0))
}
