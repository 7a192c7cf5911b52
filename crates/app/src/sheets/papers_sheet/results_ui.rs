//! Numbers and figures of a repeated paper.

use egui::{Align, Grid, Label, Layout, RichText, Ui, UiBuilder, vec2};
use shagreen_formats::reproduction_report::{ReproducedItem, Reproduction};

use crate::figure_ui::figure_ui;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::strings::papers as strings;

/// Height of a figure, in points.
const FIGURE_HEIGHT: f32 = 260.0;
/// Width at which the first column of the table is wrapped, and distance between rows, in points.
const QUANTITY_WIDTH: f32 = 240.0;
const ROW_GAP: f32 = 3.0;

/// Draws all tables and figures of a paper.
pub(super) fn results_ui(ui: &mut Ui, of: &Reproduction) {
    let title = format!("{}: {}", of.paper.id(), of.paper.title());
    ui.add(Label::new(RichText::new(title).strong()).wrap());
    for item in &of.items {
        item_ui(ui, item);
    }
}

fn item_ui(ui: &mut Ui, item: &ReproducedItem) {
    let t = tokens(ui.ctx());
    ui.add_space(GROUP_GAP);
    let heading = format!("{}: {}", item.heading, item.title);
    ui.add(Label::new(RichText::new(heading).strong()).wrap());
    ui.add(Label::new(RichText::new(strings::ours(&item.source)).color(t.text_weak)).wrap());
    if !item.rows.is_empty() {
        let grid = Grid::new(format!("numbers of {}", item.id)).num_columns(strings::COLUMNS.len());
        // The last column, with the remarks, takes the rest of the width.
        let grid = grid.max_col_width(ui.available_width()).striped(true).spacing([2.0 * GAP, ROW_GAP]);
        grid.show(ui, |ui| {
            for name in strings::COLUMNS {
                ui.add(Label::new(RichText::new(name).color(t.text_weak)).selectable(false));
            }
            ui.end_row();
            for row in &item.rows {
                ui.scope(|ui| {
                    ui.set_max_width(QUANTITY_WIDTH);
                    ui.add(Label::new(row.quantity()).wrap());
                });
                ui.add(Label::new(row.printed_text()));
                ui.add(Label::new(row.ours_text()));
                ui.add(Label::new(row.tolerance_text()));
                ui.add(Label::new(RichText::new(row.remarks()).color(t.text_weak)).wrap());
                ui.end_row();
            }
        });
    }
    for (name, figure) in &item.figures {
        ui.add_space(GAP);
        let (_, rect) = ui.allocate_space(vec2(ui.available_width(), FIGURE_HEIGHT));
        // Figures have many points; those outside the view are not drawn.
        if ui.is_rect_visible(rect) {
            let builder = UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min));
            figure_ui(&mut ui.new_child(builder), &format!("{} {name}", item.id), figure);
        }
    }
}
