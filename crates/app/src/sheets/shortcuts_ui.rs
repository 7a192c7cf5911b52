//! Sheet of keyboard shortcuts.

use egui::{Context, Grid, Label, RichText};

use crate::command::{Command, listed};
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, tokens};
use crate::strings::help as strings;

/// Width of the sheet, in points: it fits into a small window.
const WIDTH: f32 = 860.0;

/// Width at which a description is wrapped, in points.
const LABEL_WIDTH: f32 = 270.0;

/// Draws the sheet; returns the requested command.
pub(crate) fn shortcuts_ui(ctx: &Context) -> Option<Command> {
    let t = tokens(ctx);
    let mut asked = None;
    sheet(ctx, "shortcuts", |ui| {
        ui.set_width(WIDTH);
        ui.add(Label::new(RichText::new(strings::SHORTCUTS).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let keys_of = |command: Command| {
            let entry = command.entry()?;
            Some((ctx.format_shortcut(&entry.shortcut?), entry.label))
        };
        let commands = listed().filter_map(keys_of);
        let more = strings::MORE_KEYS.into_iter().map(|(keys, what)| (keys.to_owned(), what));
        let all: Vec<(String, &str)> = commands.chain(more).collect();
        // In two columns and low rows, so that a low window shows them all.
        ui.columns(2, |columns| {
            for (side, part) in all.chunks(all.len().div_ceil(2)).enumerate() {
                let grid = Grid::new(("shortcuts", side))
                    .num_columns(2)
                    .max_col_width(LABEL_WIDTH)
                    .min_row_height(0.0)
                    .spacing([16.0, 3.0])
                    .striped(true);
                grid.show(&mut columns[side], |ui| {
                    for (keys, what) in part {
                        ui.label(RichText::new(keys).monospace().color(t.accent));
                        ui.label(*what);
                        ui.end_row();
                    }
                });
            }
        });
        ui.add_space(GAP);
        if ui.button(strings::CLOSE).clicked() {
            asked = Some(Command::CloseSheet);
        }
    });
    asked
}
