//! What the files of an export cannot store, computed in the background, and warnings about written files.

use std::path::PathBuf;

use egui::{Context, Label, RichText, ScrollArea, Ui};
use shagreen_formats::library::Provenance;
use shagreen_formats::wav_encoding::Level;
use shagreen_studio::export::FormatInfo;

use crate::look::theme::{GAP, Tokens};
use crate::panel::Panel;
use crate::sheets::export::{ExportSheet, State, height_of};
use crate::state::background::JobPanicked;
use crate::state::signal_file::SignalOptions;
use crate::strings::{export as strings, import};

/// Number of lines in the list of what is not stored.
const LOST_LINES: f32 = 5.0;

/// What a summary depends on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Choice {
    format: FormatInfo,
    is_all: bool,
    follows_stroke: bool,
    level: Level,
    shares_scale: bool,
}

impl ExportSheet {
    /// Draws what the files cannot store, and a warning about textures that must not be redistributed, in a fixed height:
    /// the list comes later and has any length, and nothing else must move then. Warnings about written files come first.
    pub(super) fn lost_ui(&self, ui: &mut Ui, t: &Tokens) {
        let height = height_of(ui, LOST_LINES);
        let warnings: &[String] = if let State::Saved(saved) = &self.state { &saved.warnings } else { &[] };
        // Another area with warnings, so that its top is visible even if the list was scrolled.
        let area = ScrollArea::vertical().id_salt(("lost", warnings.is_empty()));
        let area = area.max_height(height).min_scrolled_height(height);
        area.auto_shrink(false).show(ui, |ui| {
            // Leaves room for the scroll bar.
            ui.set_max_width(ui.available_width() - 2.0 * GAP);
            let label = |text: &str, color| Label::new(RichText::new(text).color(color)).wrap();
            for warning in warnings {
                ui.add(label(&strings::warning(warning), t.warning));
            }
            match &self.summary {
                None => {
                    ui.add(label(strings::CHECKING, t.text_weak));
                }
                Some(Err(reason)) => {
                    ui.add(label(reason, t.error));
                }
                Some(Ok(summary)) => {
                    let restricted: Vec<&str> = summary.restricted.iter().map(String::as_str).collect();
                    if let Some(warning) = Provenance::warning(&restricted) {
                        ui.add(label(&warning, t.warning));
                    }
                    let heading = if summary.lost.is_empty() { strings::NOTHING_LOST } else { strings::LOST };
                    ui.add(label(heading, t.text_weak));
                    for property in &summary.lost {
                        ui.add(label(&strings::lost(property), t.text_weak));
                    }
                }
            }
        });
    }

    /// Takes in a summary, and asks for another one when the choices have changed.
    pub(super) fn follow_summary(&mut self, ctx: &Context, panel: &Panel<'_>) {
        let SignalOptions { follows_stroke, shares_scale, encoding, .. } = &self.options;
        let choice = Choice {
            format: self.format,
            is_all: self.is_all,
            follows_stroke: *follows_stroke,
            level: encoding.level,
            shares_scale: *shares_scale,
        };
        if self.summarized != Some(choice) {
            (self.summarized, self.summary) = (Some(choice), None);
            let job = self.job(panel, PathBuf::new());
            self.summaries.ask(ctx, move || job?.summary());
        }
        if let Some(done) = self.summaries.collect(ctx) {
            self.summary = Some(done.unwrap_or_else(|JobPanicked| Err(import::SAVE_BROKEN.to_owned())));
        }
    }
}
