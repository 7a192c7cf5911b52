//! About sheet: version and licenses of the program, and the paths of the files that it keeps.

use std::path::{Path, PathBuf};

use egui::{Align, Context, Grid, Label, Layout, RichText, Ui, vec2};
use shagreen_studio::about::{LICENSE, NAME, PARTS, VERSION, repository};

use crate::command::Command;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::state::files::StoragePaths;
use crate::strings::{about as strings, help};

/// Width of the sheet, in points.
const WIDTH: f32 = 700.0;
/// Width of the names of files, in points.
const NAME_WIDTH: f32 = 110.0;
/// Minimum height of a row of the licenses, in points: the sheet fits into a small window.
const ROW_HEIGHT: f32 = 18.0;
/// Width at which a column of the licenses is wrapped, in points.
const COLUMN_WIDTH: f32 = 290.0;

pub(crate) struct AboutSheet {
    /// Names of what is stored, and where; `None` if it is not stored.
    places: [(&'static str, Option<PathBuf>); 3],
}

impl AboutSheet {
    /// Sheet of a program that keeps its files at these paths.
    pub(crate) fn new(keeping: &StoragePaths) -> Self {
        Self {
            places: [
                (strings::SETTINGS, keeping.settings.clone()),
                (strings::UNSAVED, keeping.recovery.clone()),
                (strings::NETWORKS, keeping.models.clone()),
            ],
        }
    }

    /// Draws the sheet; returns the requested command.
    pub(crate) fn show(&self, ctx: &Context) -> Option<Command> {
        let shown = sheet(ctx, "about", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        });
        shown.inner.then_some(Command::CloseSheet)
    }

    /// Draws the content; returns whether the user closes the sheet.
    fn content_ui(&self, ui: &mut Ui) -> bool {
        let t = tokens(ui.ctx());
        ui.add(Label::new(RichText::new(NAME).heading().strong()).selectable(false));
        ui.add(Label::new(strings::version(VERSION)).selectable(false));
        ui.add(Label::new(strings::license(LICENSE)).selectable(false));
        if let Some(address) = repository() {
            ui.hyperlink(address);
        }
        heading_ui(ui, strings::PARTS);
        let grid = Grid::new("licenses").num_columns(3).max_col_width(COLUMN_WIDTH);
        grid.min_row_height(ROW_HEIGHT).spacing([16.0, 3.0]).show(ui, |ui| {
            for part in PARTS {
                ui.add(Label::new(part.name).selectable(false));
                ui.add(Label::new(RichText::new(part.purpose).color(t.text_weak)).selectable(false));
                ui.add(Label::new(part.license).selectable(false));
                ui.end_row();
            }
        });
        heading_ui(ui, strings::FILES);
        for (name, path) in &self.places {
            place_ui(ui, name, path.as_deref());
        }
        row_ui(ui, strings::LOG, |ui| weak_ui(ui, strings::NO_LOG));
        ui.add_space(GROUP_GAP);
        foot_ui(ui, |ui| ui.button(help::CLOSE).clicked())
    }
}

fn heading_ui(ui: &mut Ui, text: &str) {
    ui.add_space(GROUP_GAP);
    ui.add(Label::new(RichText::new(text).strong()).selectable(false));
}

fn weak_ui(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false));
}

/// Draws a name, and `content` beside it.
fn row_ui(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAME_WIDTH);
            ui.add(Label::new(name).selectable(false));
        });
        content(ui);
    });
}

/// Draws a path with the button that copies it.
fn place_ui(ui: &mut Ui, name: &str, path: Option<&Path>) {
    row_ui(ui, name, |ui| {
        let Some(path) = path else {
            weak_ui(ui, strings::NOT_STORED);
            return;
        };
        let text = path.display().to_string();
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button(strings::COPY).accessible_name(strings::copy_path_of(name)).clicked() {
                ui.ctx().copy_text(text.clone());
            }
            ui.add_space(GAP);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(Label::new(&text).truncate().selectable(false)).on_hover_text(&text);
            });
        });
    });
}
