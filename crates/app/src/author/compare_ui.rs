//! Buttons of an A/B comparison.

use egui::{Button, Checkbox, Label, RichText, Ui, vec2};

use crate::command::Command;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::compare::{CompareCommand, Side};
use crate::strings::compare as words;

/// Draws the buttons; returns the requested commands.
pub(crate) fn compare_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let compare = panel.compare;
    let mut asked = Vec::new();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.spacing_mut().button_padding.x = 6.0;
        let help = if compare.is_possible() { words::HELP } else { words::NEEDS_TWO };
        ui.add(Label::new(words::HEADING).selectable(false)).on_hover_text(help);
        for side in Side::ALL {
            let button =
                Button::selectable(compare.heard() == Some(side), side.letter()).min_size(vec2(22.0, 0.0));
            let response = ui.add_enabled(compare.is_possible(), button);
            let response = response.accessible_name(words::hear(side.letter()));
            let on = panel.project.authored.iter().find(|texture| compare.side_of(texture.key) == Some(side));
            let help = on.map_or(help.to_owned(), |texture| words::is_on(side.letter(), &texture.name));
            let response = response.on_hover_text(&help).on_disabled_hover_text(&help);
            if response.clicked() {
                asked.push(CompareCommand::Hear(side));
            }
        }
        let mut is_blind = compare.is_blind();
        let blind = ui.add_enabled(compare.is_possible(), Checkbox::new(&mut is_blind, words::BLIND));
        let blind = blind.on_hover_text(words::BLIND_HELP).on_disabled_hover_text(words::NEEDS_TWO);
        if blind.changed() {
            asked.push(CompareCommand::SetBlind(is_blind));
        }
    });
    let (n_answers, n_right) = compare.answers();
    if compare.heard() == Some(Side::X) {
        ui.horizontal(|ui| {
            for side in [Side::A, Side::B] {
                if ui.button(words::x_is(side.letter())).clicked() {
                    asked.push(CompareCommand::Answer(side));
                }
            }
        });
    }
    if n_answers > 0 {
        let result =
            RichText::new(words::right(n_right, n_answers, compare.chance())).small().color(t.text_weak);
        ui.add(Label::new(result).selectable(false)).on_hover_text(words::RESULT_HELP);
    }
    asked.into_iter().map(Command::Compare).collect()
}
