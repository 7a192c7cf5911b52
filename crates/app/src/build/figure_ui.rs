//! A figure in the window: the same data that is saved as SVG or CSV.

use egui::{Align, Grid, Label, Layout, RichText, ScrollArea, Ui};
use shagreen_formats::figure::{Figure, Table};

use crate::build::chart_ui::chart_ui;
use crate::map_plot::map_plot;
use crate::theme::{GROUP_GAP, tokens};

/// Draws any figure into the space that there is; `name` tells it from the others.
pub(super) fn figure_ui(ui: &mut Ui, name: &str, figure: &Figure) {
    ui.add(Label::new(RichText::new(figure.title()).strong()).wrap());
    match figure {
        Figure::Chart(chart) => chart_ui(ui, name, &figure.title(), chart),
        Figure::Table(table) => table_ui(ui, name, table),
        Figure::Map(map) => {
            map_plot(ui, name, map);
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
                for value in values {
                    number(ui, RichText::new(table.shown(*value)).monospace());
                }
                ui.end_row();
            }
        });
    });
}
