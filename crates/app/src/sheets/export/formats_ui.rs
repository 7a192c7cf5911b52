//! List of the formats, and what is to be known about the selected one.

use egui::{Button, Color32, Label, RichText, TextStyle, Ui};
use shagreen_studio::export::{self, FormatInfo, signal_format};

use crate::look::theme::Tokens;
use crate::sheets::export::ExportSheet;
use crate::state::audible_texture::AudibleTexture;
use crate::strings::export as strings;

/// Number of lines of the text about the selected format.
const HELP_LINES: f32 = 2.0;

impl ExportSheet {
    /// Draws the list of formats; returns whether another one was chosen.
    pub(super) fn formats_ui(&mut self, ui: &mut Ui, t: &Tokens) -> bool {
        let before = self.format;
        ui.horizontal_wrapped(|ui| {
            for format in export::listed() {
                let problem = self.problem(format);
                let text = strings::format(format.name, format.ending);
                let button = Button::selectable(self.format == format, text);
                let button = ui.add_enabled(problem.is_none(), button).on_hover_text(format.help);
                let button = button.on_disabled_hover_text(problem.map_or("", String::as_str));
                if button.accessible_name(format.name).clicked() {
                    self.format = format;
                }
            }
        });
        ui.vertical(|ui| {
            // Room for the longest of them, so that nothing below moves.
            ui.set_min_height(HELP_LINES * ui.text_style_height(&TextStyle::Small));
            ui.add(small(self.format.help, t.text_weak));
        });
        let AudibleTexture { signal, entry, .. } = &*self.audible;
        let of_entry = entry.as_ref().err().filter(|reason| signal.as_ref().err() != Some(*reason));
        for problem in signal.as_ref().err().into_iter().chain(of_entry) {
            ui.add(small(problem, t.warning));
        }
        if self.format == before {
            return false;
        }
        self.follow_format(before);
        true
    }

    /// Why the audible texture cannot be exported in a format.
    fn problem(&self, format: FormatInfo) -> Option<&String> {
        let AudibleTexture { signal, entry, .. } = &*self.audible;
        if signal_format(format.id).is_some() { signal.as_ref().err() } else { entry.as_ref().err() }
    }
}

/// Small text that wraps.
fn small(text: &str, color: Color32) -> Label {
    Label::new(RichText::new(text).small().color(color)).wrap().selectable(false)
}
