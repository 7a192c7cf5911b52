//! Sheet of keyboard shortcuts.

use egui::{Color32, Context, Grid, Label, RichText, TextStyle, Ui};

use crate::command::{Command, listed};
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::strings::help as strings;

/// Width of the sheet, in points: it fits into a small window.
const WIDTH: f32 = 860.0;

/// Distances between keys and their description, and between the two columns, in points.
const AFTER_KEYS: f32 = 16.0;
const BETWEEN: f32 = 28.0;

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
        // In two columns and low rows, so that a low window shows them all. The second column is as wide as the first one
        // allows.
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = BETWEEN;
            for (side, part) in all.chunks(all.len().div_ceil(2)).enumerate() {
                let label_width = ui.available_width() - keys_width(ui, part) - AFTER_KEYS;
                let grid = Grid::new(("shortcuts", side))
                    .num_columns(2)
                    .max_col_width(label_width)
                    .min_row_height(0.0)
                    .spacing([AFTER_KEYS, 3.0])
                    .striped(true);
                grid.show(ui, |ui| {
                    for (keys, what) in part {
                        ui.label(RichText::new(keys).monospace().color(t.accent));
                        ui.label(*what);
                        ui.end_row();
                    }
                });
            }
        });
        ui.add_space(GAP);
        if foot_ui(ui, |ui| ui.button(strings::CLOSE).clicked()) {
            asked = Some(Command::CloseSheet);
        }
    });
    asked
}

/// Width of the widest keys, in points.
fn keys_width(ui: &Ui, rows: &[(String, &str)]) -> f32 {
    let font = TextStyle::Monospace.resolve(ui.style());
    let width = |(keys, _): &(String, &str)| {
        ui.painter().layout_no_wrap(keys.clone(), font.clone(), Color32::PLACEHOLDER).size().x
    };
    rows.iter().map(width).fold(0.0, f32::max)
}
