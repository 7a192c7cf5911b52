//! Field for the path of a file to write, with the button for the dialog of the system and recent folders.

use std::path::{Path, PathBuf};

use egui::{Context, Id, Key, TextEdit, Ui};

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::look::text_selection::select_chars;
use crate::sheets::folders_ui::{FOLDERS_WIDTH, folders_ui};

/// Texts of the field, and the usual ending of the file's name.
#[derive(Clone, Copy)]
pub(crate) struct PathTexts<'a> {
    /// Title of the dialog of the system.
    pub(crate) title: &'a str,
    /// Accessible name of the field.
    pub(crate) name: &'a str,
    pub(crate) hint: &'a str,
    /// Empty for the path of a folder.
    pub(crate) ending: &'a str,
}

/// What the user did with the field in one frame.
#[derive(Clone, Copy, Default)]
pub(crate) struct PathInput {
    /// The path was changed.
    pub(crate) is_changed: bool,
    /// The path was confirmed with Enter.
    pub(crate) is_entered: bool,
    /// The path comes from the dialog of the system, which asks before it gives the name of an existing file.
    pub(crate) is_chosen: bool,
}

/// State of the field.
pub(crate) struct PathField {
    text: String,
    is_focused: bool,
    browse: Browse,
    folders: Vec<PathBuf>,
}

impl PathField {
    pub(crate) fn new(text: String) -> Self {
        Self { text, is_focused: false, browse: Browse::default(), folders: Vec::new() }
    }

    /// Offers folders that were used last.
    pub(crate) fn offer(&mut self, folders: Vec<PathBuf>) {
        self.folders = folders;
    }

    /// Typed path, without spaces around it.
    pub(crate) fn text(&self) -> &str {
        self.text.trim()
    }

    pub(crate) fn set(&mut self, path: &Path) {
        self.text = path.display().to_string();
    }

    /// Requests the keyboard focus in the next frame; a disabled field has lost it.
    pub(crate) fn refocus(&mut self) {
        self.is_focused = false;
    }

    /// Draws the field and its button. A disabled one does not change.
    pub(crate) fn show(&mut self, ui: &mut Ui, texts: PathTexts<'_>, is_enabled: bool) -> PathInput {
        let mut input = PathInput::default();
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.text).hint_text(texts.hint);
            let folders_width = if self.folders.is_empty() { 0.0 } else { FOLDERS_WIDTH };
            let field = field.desired_width(ui.available_width() - BROWSE_WIDTH - folders_width);
            let field = ui.add_enabled(is_enabled, field).accessible_name(texts.name);
            let present = completed(self.text(), texts.ending);
            let name = present.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let is_folder = texts.ending.is_empty();
            let asked = Asked {
                title: texts.title,
                kind: texts.title,
                endings: &[texts.ending],
                folder: if is_folder { Some(&*present) } else { present.parent() },
                name: Some(&name),
                is_folder,
                ..Asked::default()
            };
            let chosen = ui.add_enabled_ui(is_enabled, |ui| self.browse.show(ui, texts.name, &asked)).inner;
            if let Some(chosen) = chosen.into_iter().next().filter(|_| is_enabled) {
                self.set(&chosen);
                input.is_chosen = true;
            }
            let recent = ui.add_enabled_ui(is_enabled, |ui| folders_ui(ui, &self.folders)).inner;
            let is_moved = recent.is_some();
            if let Some(folder) = recent {
                self.set(&if is_folder { folder } else { folder.join(&name) });
                self.is_focused = false;
            }
            input.is_changed = field.changed() || input.is_chosen || is_moved;
            input.is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            if is_enabled && !std::mem::replace(&mut self.is_focused, true) {
                field.request_focus();
                select_name(ui.ctx(), field.id, &self.text);
            }
        });
        self.browse.missing_ui(ui);
        input
    }
}

/// Absolute path to write to. `~/` is replaced by the home folder, and a missing file name ending is added.
pub(crate) fn completed(path: &str, ending: &str) -> PathBuf {
    let path = match path.strip_prefix("~/").zip(std::env::home_dir()) {
        Some((rest, home)) => home.join(rest),
        None => PathBuf::from(path),
    };
    let path = if path.extension().is_none() && !path.is_dir() { path.with_extension(ending) } else { path };
    std::path::absolute(&path).unwrap_or(path)
}

/// Selects the file name in the path field, so that typing another name replaces it.
fn select_name(ctx: &Context, field: Id, path: &str) {
    let is_parting = |c: char| c == '/' || c == std::path::MAIN_SEPARATOR;
    let begin = path.rfind(is_parting).map_or(0, |at| path[..=at].chars().count());
    let length = Path::new(path).file_stem().map_or(0, |stem| stem.to_string_lossy().chars().count());
    select_chars(ctx, field, begin..begin + length);
}

#[cfg(test)]
mod tests {
    use super::completed;

    #[test]
    fn a_path_is_completed() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| completed(&folder.path().join(name).display().to_string(), "json");
        assert_eq!(of("mine"), folder.path().join("mine.json"));
        assert_eq!(of("mine.txt"), folder.path().join("mine.txt"));
        assert_eq!(of(""), folder.path().join(""), "a folder stays one, and is refused");
        assert!(completed("mine", "json").is_absolute());
        let at_home = completed("~/mine", "json");
        assert!(
            at_home.is_absolute()
                && at_home.ends_with("mine.json")
                && !at_home.display().to_string().contains('~')
        );
    }
}
