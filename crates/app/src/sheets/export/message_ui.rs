//! What an export would do, or has done.

use std::path::{Path, PathBuf};

use egui::{Color32, Label, RichText, ScrollArea, Ui};
use shagreen_core::units::Contact;
use shagreen_studio::export;

use crate::look::theme::{Tokens, tokens};
use crate::panel::Panel;
use crate::sheets::export::job::Saved;
use crate::sheets::export::{ExportSheet, State, height_of};
use crate::sheets::path_field::completed;
use crate::state::signal_file::Sounding;
use crate::strings::{export as strings, import, signal};

/// Number of lines of the message above the buttons.
const MESSAGE_LINES: f32 = 2.0;
/// Largest number of files whose names are listed.
const MOST_NAMED: usize = 4;

impl ExportSheet {
    /// Draws the message in a fixed height. The names of all files are in its tooltip.
    pub(super) fn message_ui(&self, ui: &mut Ui, panel: &Panel<'_>) {
        let (text, color) = self.message(tokens(ui.ctx()), panel);
        let height = height_of(ui, MESSAGE_LINES);
        let area = ScrollArea::vertical().id_salt("message").max_height(height).min_scrolled_height(height);
        area.auto_shrink(false).show(ui, |ui| {
            let label = ui.add(Label::new(RichText::new(text).color(color)).wrap());
            if self.is_all && matches!(self.state, State::Asking) {
                label.on_hover_text(self.file_names(panel).join("\n"));
            }
        });
    }

    /// What would happen, or has happened.
    fn message(&self, t: &Tokens, panel: &Panel<'_>) -> (String, Color32) {
        match &self.state {
            State::Asking => (self.to_save(panel), t.text_weak),
            State::Exists(paths) => (strings::exists(&listed(&names_of(paths)), paths.len()), t.warning),
            State::Saving(..) => (import::SAVING.to_owned(), t.text_weak),
            State::Saved(Saved { paths, .. }) => {
                let shown = |path: Option<&Path>| path.unwrap_or(Path::new("")).display().to_string();
                let first = paths.first().map(PathBuf::as_path);
                let text = if self.is_all {
                    strings::saved_all(paths.len(), &shown(first.and_then(Path::parent)))
                } else {
                    import::saved(&shown(first))
                };
                (text, t.accent)
            }
            State::Failed(reason) => (reason.clone(), t.error),
        }
    }

    fn to_save(&self, panel: &Panel<'_>) -> String {
        if self.is_all {
            let names = self.file_names(panel);
            let text = strings::all_to_save(&listed(&names), names.len(), self.format.name);
            let folder = self.folder().unwrap_or_else(|| completed(self.path.text(), ""));
            let is_new = !folder.exists();
            return if is_new { text + strings::NEW_FOLDER } else { text };
        }
        let (Ok(file), Some(format)) = (&self.audible.signal, self.signal_format()) else {
            return strings::texture_to_save(&self.audible.name, self.format.name);
        };
        let what = match &file.sounding {
            Sounding::Bench(of) => signal::bench_to_save(&of.name, of.seconds()),
            Sounding::Mix(..) | Sounding::Path(_) => {
                let Contact { speed, force } = file.contact;
                let steady = (!self.options.follows_stroke).then_some((speed.mm_per_s(), force.0));
                signal::to_save(file.seconds(&self.options), steady)
            }
        };
        signal::saved_as(&what, format.name(), format.stores_samples())
    }

    /// Names of the files of all authored textures.
    fn file_names(&self, panel: &Panel<'_>) -> Vec<String> {
        let names = panel.project.authored.iter().map(|texture| texture.name.as_str());
        let paths = export::paths_in(Path::new(""), names, self.format.ending);
        paths.iter().map(|path| path.display().to_string()).collect()
    }
}

/// File names of paths.
fn names_of(paths: &[PathBuf]) -> Vec<String> {
    let names = paths.iter().map(|path| path.file_name().unwrap_or(path.as_os_str()));
    names.map(|name| name.to_string_lossy().into_owned()).collect()
}

/// The first names, and the number of the others.
fn listed(names: &[String]) -> String {
    let mut listed = names.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > MOST_NAMED {
        listed += &strings::and_more(names.len() - MOST_NAMED);
    }
    listed
}
