//! Choice of the folder of the logs.

use std::path::{Path, PathBuf};

use egui::{Label, RichText, TextEdit, Ui};
use shagreen_studio::study::logs::usual_log_folder;

use super::StudiesPage;
use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::command::Command;
use crate::command::studies::StudiesCommand;
use crate::look::theme::tokens;
use crate::strings::studies as strings;

/// State of the field.
#[derive(Default)]
pub(super) struct LogFolderField {
    /// Path while it is typed.
    typed: Option<String>,
    browse: Browse,
}

/// Draws the field with the folder and the button for the dialog of the system; returns the requested command.
pub(super) fn log_folder_ui(ui: &mut Ui, page: &mut StudiesPage) -> Option<Command> {
    let present = shown_folder(page)?;
    let t = tokens(ui.ctx());
    let mut chosen = None;
    let LogFolderField { typed, browse } = &mut page.log_folder_field;
    ui.add(Label::new(RichText::new(strings::LOGS).small().color(t.text_weak)).selectable(false));
    ui.horizontal(|ui| {
        let path = present.display().to_string();
        let mut text = typed.take().unwrap_or_else(|| path.clone());
        let field = TextEdit::singleline(&mut text).desired_width(ui.available_width() - BROWSE_WIDTH);
        let field = ui.add(field).accessible_name(strings::LOGS).on_hover_text(strings::logs_help(&path));
        let asked =
            Asked { title: strings::LOGS, folder: Some(&present), is_folder: true, ..Asked::default() };
        chosen = browse.show(ui, strings::LOGS, &asked).into_iter().next();
        let is_new = !text.trim().is_empty() && text.trim() != path;
        if chosen.is_none() && field.lost_focus() && is_new {
            chosen = Some(PathBuf::from(text.trim()));
        } else if field.has_focus() {
            *typed = Some(text);
        }
    });
    browse.missing_ui(ui);
    chosen.map(|folder| Command::Studies(StudiesCommand::ChooseLogFolder(folder)))
}

/// Folder in which logs are saved, also that of a plan which is not saved yet; `None` without a plan.
fn shown_folder(page: &StudiesPage) -> Option<PathBuf> {
    page.open.as_ref()?;
    page.log_folder().or_else(|| page.logs.clone()).or_else(|| {
        let plan = page.save_to.trim();
        (!plan.is_empty()).then(|| usual_log_folder(Path::new(plan)))
    })
}
