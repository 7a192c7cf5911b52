//! The sheet of shortcuts.

use egui::{Context, Grid, Key, Label, Modal, Modifiers, RichText};

use crate::command::{Command, WITH_KEYS};
use crate::strings::help as strings;
use crate::theme::{GAP, tokens};

/// Draws the sheet over the window and returns what the user asked of it.
pub(crate) fn shortcuts_ui(ctx: &Context) -> Option<Command> {
    let t = tokens(ctx);
    let frame = egui::Frame::popup(&ctx.global_style()).fill(t.panel).inner_margin(14.0);
    let mut asked = None;
    Modal::new(egui::Id::unique("shortcuts")).frame(frame).show(ctx, |ui| {
        ui.set_width(430.0);
        ui.add(Label::new(RichText::new(strings::SHORTCUTS).heading().strong()).selectable(false));
        ui.add_space(GAP);
        Grid::new("shortcuts").num_columns(2).spacing([24.0, 3.0]).striped(true).show(ui, |ui| {
            let keys_of =
                |command: Command| Some((ctx.format_shortcut(&command.shortcut()?), command.label()?));
            let commands = WITH_KEYS.into_iter().filter_map(keys_of);
            let more = strings::MORE_KEYS.into_iter().map(|(keys, what)| (keys.to_owned(), what));
            for (keys, what) in commands.chain(more) {
                ui.label(RichText::new(keys).monospace().color(t.accent));
                ui.label(what);
                ui.end_row();
            }
        });
        ui.add_space(GAP);
        if ui.button(strings::CLOSE).clicked() {
            asked = Some(Command::CloseSheet);
        }
    });
    if ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
        asked = Some(Command::CloseSheet);
    }
    asked
}
