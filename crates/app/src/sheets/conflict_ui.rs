//! Question before saving over a project file that was changed by another window or program.

use egui::{Context, Grid, Label, RichText, ScrollArea};

use crate::command::{Command, FileCommand};
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::state::conflict::Conflict;
use crate::strings::conflict as strings;
use crate::strings::document::{CANCEL, SAVE_AS};

/// Height of the list of differences, in points.
const LIST_HEIGHT: f32 = 220.0;

/// Draws the question over the window; returns the requested commands.
pub(crate) fn conflict_ui(ctx: &Context, conflict: &Conflict, project: &str) -> Vec<Command> {
    let t = tokens(ctx);
    let mut commands = Vec::new();
    sheet(ctx, "conflict", |ui| {
        ui.set_width(520.0);
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        ui.add(Label::new(strings::changed_since(project)).wrap());
        ui.add_space(GAP);
        let differences = conflict.differences.as_deref();
        if differences.is_none_or(<[_]>::is_empty) {
            ui.label(if differences.is_none() { strings::NO_PROJECT } else { strings::NO_DIFFERENCE });
        } else {
            ScrollArea::vertical().max_height(LIST_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
                Grid::new("differences").num_columns(2).striped(true).show(ui, |ui| {
                    for difference in differences.unwrap_or_default() {
                        ui.label(strings::part(&difference.part));
                        ui.label(RichText::new(strings::change(difference.change)).color(t.text_weak));
                        ui.end_row();
                    }
                });
            });
        }
        ui.add_space(GAP);
        foot_ui(ui, |ui| {
            let save_as = primary_ui(ui, SAVE_AS, true);
            if ui.memory(|memory| memory.focused().is_none()) {
                save_as.request_focus();
            }
            if save_as.on_hover_text(strings::SAVE_AS_HELP).clicked() {
                commands.push(Command::File(FileCommand::SaveAs));
            }
            let reload = ui.button(strings::RELOAD).on_hover_text(strings::RELOAD_HELP);
            if reload.clicked() {
                commands.push(Command::File(FileCommand::Reload));
            }
            let overwrite = ui.button(strings::OVERWRITE).on_hover_text(strings::OVERWRITE_HELP);
            if overwrite.clicked() {
                commands.push(Command::File(FileCommand::Overwrite));
            }
            if ui.button(CANCEL).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
    });
    commands
}
