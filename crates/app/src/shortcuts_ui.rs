//! The sheet of shortcuts.

use egui::{Context, Grid, Label, RichText, ScrollArea};

use crate::command::{Command, WITH_KEYS};
use crate::sheet_frame::{is_left, sheet};
use crate::strings::help as strings;
use crate::theme::{GAP, tokens};

/// What of the window's height the list of keys leaves to its heading, its button and the edges, in points.
const AROUND: f32 = 150.0;

/// Draws the sheet over the window and returns what the user asked of it.
pub(crate) fn shortcuts_ui(ctx: &Context) -> Option<Command> {
    let t = tokens(ctx);
    let mut asked = None;
    sheet(ctx, "shortcuts", |ui| {
        ui.set_width(430.0);
        ui.add(Label::new(RichText::new(strings::SHORTCUTS).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let height = ctx.content_rect().height() - AROUND;
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
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
        });
        ui.add_space(GAP);
        if ui.button(strings::CLOSE).clicked() {
            asked = Some(Command::CloseSheet);
        }
    });
    if is_left(ctx) {
        asked = Some(Command::CloseSheet);
    }
    asked
}
