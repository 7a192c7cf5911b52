//! Choice of the output, in the devices sheet and in the status bar.

use egui::{ComboBox, Ui};

use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::session::Session;
use crate::strings;

/// Draws the choice of the output; returns the requested command.
pub(crate) fn output_choice_ui(ui: &mut Ui, session: &Session) -> Option<Command> {
    let mut chosen = None;
    let current = session.output_name().unwrap_or(if session.is_opening() {
        strings::OPENING
    } else {
        strings::NO_OUTPUT
    });
    let combo = ComboBox::from_id_salt("output").width(210.0).truncate().selected_text(current);
    let shown = combo.show_list(ui, |ui| {
        for output in session.outputs() {
            let selected = session.output_id() == Some(output.id.as_str());
            if ui.selectable_label(selected, &output.name).on_hover_text(&output.id).clicked() {
                chosen = Some(Command::OpenOutput(output.id.clone()));
            }
        }
    });
    if shown.response.clicked() {
        // Listed again, because a device may have been connected since.
        chosen = Some(Command::ListOutputs);
    }
    shown.response.accessible_name(strings::OUTPUT).on_hover_text(strings::OUTPUT_HELP);
    chosen
}
