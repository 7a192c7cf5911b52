//! Draws a figure in the window, from the same data that is saved as SVG or CSV.

use std::sync::Arc;

use egui::{Align, Grid, Label, Layout, RichText, ScrollArea, Ui};
use shagreen_formats::figure::{Figure, Table};

use crate::command::Command;
use crate::look::chart_ui::chart_ui;
use crate::look::map_plot::{color_key_ui, labeled_map_plot};
use crate::look::theme::{GROUP_GAP, tokens};
use crate::state::figure_file::{FigureFile, FigureFormat};
use crate::strings::build as strings;

/// Draws a figure into the available space; `name` is its id.
pub(crate) fn figure_ui(ui: &mut Ui, name: &str, figure: &Figure) {
    ui.add(Label::new(RichText::new(figure.title()).strong()).wrap());
    content_ui(ui, name, figure);
}

/// Draws a figure below a row with its title and save menu; returns the requested command.
pub(crate) fn framed_figure_ui(ui: &mut Ui, name: &str, figure: &Arc<Figure>, stem: &str) -> Option<Command> {
    let asked = figure_head_ui(ui, figure, stem);
    content_ui(ui, name, figure);
    asked
}

/// Draws the title of a figure and the menu that saves it; the file names begin with `stem`.
pub(crate) fn figure_head_ui(ui: &mut Ui, figure: &Arc<Figure>, stem: &str) -> Option<Command> {
    let title = figure.title();
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let menu = ui.menu_button(strings::SAVE, |ui| {
                for format in FigureFormat::ALL {
                    if ui.button(format.word()).clicked() {
                        asked = Some(format);
                    }
                }
            });
            menu.response.accessible_name(strings::save(&title));
            if let Figure::Map(map) = &**figure {
                color_key_ui(ui, map);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let label = Label::new(RichText::new(&title).strong()).truncate().selectable(false);
                ui.add(label).on_hover_text(&title);
            });
        });
    });
    asked.map(|format| {
        Command::SaveFigure(FigureFile { stem: stem.to_owned(), figure: Arc::clone(figure), format })
    })
}

fn content_ui(ui: &mut Ui, name: &str, figure: &Figure) {
    match figure {
        Figure::Chart(chart) => chart_ui(ui, name, &figure.title(), chart),
        Figure::Table(table) => table_ui(ui, name, table),
        Figure::Map(map) => {
            labeled_map_plot(ui, name, map);
        }
    }
}

fn table_ui(ui: &mut Ui, name: &str, table: &Table) {
    let t = tokens(ui.ctx());
    ui.add_space(GROUP_GAP);
    ScrollArea::both().id_salt(name).auto_shrink(false).show(ui, |ui| {
        let grid = Grid::new(name).striped(true).spacing([24.0, GROUP_GAP]).min_col_width(56.0);
        grid.show(ui, |ui| {
            let number = |ui: &mut Ui, text: RichText| {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.add(Label::new(text).extend());
                });
            };
            ui.label("");
            for column in &table.columns {
                number(ui, RichText::new(column).color(t.text_weak));
            }
            ui.end_row();
            for (row, values) in &table.rows {
                ui.add(Label::new(row).extend());
                for (column, value) in values.iter().enumerate() {
                    number(ui, RichText::new(table.shown(column, *value)).monospace());
                }
                ui.end_row();
            }
        });
    });
}
