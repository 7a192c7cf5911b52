//! Command palette: a list of commands with search.

use egui::{Button, Context, Id, Key, Modifiers, RichText, ScrollArea, TextEdit, Ui};
use shagreen_studio::export::{self, FormatInfo, WAV};

use crate::command::{Command, FileCommand, listed};
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, SCROLL_BAR_ROOM, tokens};
use crate::strings::help as strings;

/// Width of the sheet, in points.
const WIDTH: f32 = 460.0;
/// Height of the list, in points.
const LIST_HEIGHT: f32 = 300.0;

#[derive(Default)]
pub(crate) struct PaletteSheet {
    query: String,
    /// Index of the selected command among the matches.
    selected: usize,
    /// Whether an arrow key has selected a command. *Enter* runs nothing before that or a query: letters typed while the
    /// palette opened can be lost.
    is_selected_by_key: bool,
    is_focused: bool,
}

/// Command with its label and keyboard shortcut.
struct Row {
    command: Command,
    label: String,
    keys: String,
}

impl PaletteSheet {
    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        // Before the field, which would lose its focus by *Enter*.
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let [is_down, is_up, is_enter] = [Key::ArrowDown, Key::ArrowUp, Key::Enter].map(pressed);
        let (mut chosen, mut rows) = (None, Vec::new());
        sheet(ctx, "palette", |ui| {
            ui.set_width(WIDTH);
            let id = Id::unique("palette query");
            let field = TextEdit::singleline(&mut self.query)
                .hint_text(strings::FIND_COMMAND)
                .desired_width(f32::INFINITY)
                .id(id);
            // Before the field is drawn, so that it takes the letters of its first frame.
            if !self.is_focused {
                ui.memory_mut(|memory| memory.request_focus(id));
            }
            let field = ui.add(field).accessible_name(strings::FIND_COMMAND);
            // In the frame in which its size is measured, the field cannot have the focus.
            self.is_focused |= field.enabled() && field.has_focus();
            if field.changed() {
                self.selected = 0;
            }
            // After the field: fast typing brings the last letters and *Enter* in one frame.
            rows = matching(all(ui.ctx()), &self.query);
            self.step(rows.len(), is_down, is_up);
            if is_enter && (self.is_selected_by_key || !self.query.trim().is_empty()) {
                chosen = Some(self.selected);
            }
            ui.add_space(GAP);
            chosen = chosen.or(list_ui(ui, &rows, self.selected));
        });
        let mut commands = Vec::new();
        if let Some(row) = chosen.and_then(|index| rows.into_iter().nth(index)) {
            // The palette closes first, because the command may open another sheet.
            commands.extend([Command::CloseSheet, row.command]);
        }
        commands
    }

    /// Moves the selection among `n` matches.
    fn step(&mut self, n: usize, is_down: bool, is_up: bool) {
        self.selected = self.selected.min(n.saturating_sub(1));
        if n > 0 && (is_down || is_up) {
            self.selected = (self.selected + if is_down { 1 } else { n - 1 }) % n;
            self.is_selected_by_key = true;
        }
    }
}

/// Draws the list and returns the index of the row that was clicked.
fn list_ui(ui: &mut Ui, rows: &[Row], selected: usize) -> Option<usize> {
    let t = tokens(ui.ctx());
    let mut clicked = None;
    ScrollArea::vertical()
        .min_scrolled_height(LIST_HEIGHT)
        .max_height(LIST_HEIGHT)
        // A height that followed the matches would move the field while one types.
        .auto_shrink(false)
        .show(ui, |ui| {
            if rows.is_empty() {
                ui.label(RichText::new(strings::NO_COMMAND).color(t.text_weak));
            }
            for (index, row) in rows.iter().enumerate() {
                let keys_color = if index == selected { t.on_chosen } else { t.text_weak };
                let keys = RichText::new(&row.keys).color(keys_color);
                let button = Button::selectable(index == selected, &row.label).shortcut_text(keys);
                let button = button.min_size(egui::vec2(ui.available_width() - SCROLL_BAR_ROOM, 0.0));
                let response = ui.add(button).accessible_name(&row.label);
                if index == selected {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    clicked = Some(index);
                }
            }
        });
    clicked
}

/// All listed commands except the palette itself, then one command for each export format.
fn all(ctx: &Context) -> Vec<Row> {
    let others = listed().filter(|command| !matches!(command, Command::OpenPalette));
    let row = |command: Command| {
        let entry = command.entry()?;
        let keys = command.shortcut_text(ctx);
        Some(Row { command, label: entry.label.to_owned(), keys })
    };
    let export = |format: FormatInfo| Row {
        command: Command::File(FileCommand::Export(format.id)),
        label: strings::export_as(format.name),
        keys: String::new(),
    };
    // WAV has an entry in the menu of files, which is listed with the others.
    let formats = export::listed().filter(|format| *format != WAV);
    others.filter_map(row).chain(formats.map(export)).collect()
}

/// Rows that contain every word of the query; those that begin with it come first.
fn matching(mut rows: Vec<Row>, query: &str) -> Vec<Row> {
    let query = query.to_lowercase();
    let words: Vec<&str> = query.split_whitespace().collect();
    rows.retain(|row| {
        let label = row.label.to_lowercase();
        words.iter().all(|word| label.contains(word))
    });
    rows.sort_by_key(|row| !row.label.to_lowercase().starts_with(query.trim()));
    rows
}

#[cfg(test)]
mod tests {
    use super::{Command, Row, all, listed, matching};

    #[test]
    fn every_listed_command_has_words_and_no_two_share_keys() {
        let mut shortcuts = Vec::new();
        let mut labels = Vec::new();
        for command in listed() {
            let entry = command.entry().expect("a listed command has words");
            shortcuts.extend(entry.shortcut.map(|keys| format!("{keys:?}")));
            labels.push(entry.label);
        }
        for list in [&mut shortcuts, &mut labels.iter().map(|label| (*label).to_owned()).collect()] {
            let n = list.len();
            list.sort();
            list.dedup();
            assert_eq!(list.len(), n, "{list:?}");
        }
        assert!(Command::CloseSheet.entry().is_none());
    }

    #[test]
    fn commands_are_found_by_any_of_their_words() {
        let found = |query: &str| -> Vec<String> {
            let rows: Vec<Row> = matching(all(&egui::Context::default()), query);
            rows.into_iter().map(|row| row.label).collect()
        };
        assert!(found("").len() > 25);
        assert_eq!(found("WORKSPACE build"), ["Show the Build workspace"]);
        assert_eq!(found("save")[0], "Save the project", "what begins with it comes first");
        assert!(found("hatt").iter().any(|label| label.contains("HaTT")), "export formats are listed");
        assert!(found("fly to the moon").is_empty());
    }
}
