//! What all plots of the window have in common.

use egui::{Color32, Label, RichText, Ui, vec2};
use egui_plot::Plot;

use crate::theme::tokens;

/// A heading and the unit of what stands below it.
pub(crate) fn title(ui: &mut Ui, text: &str, unit: &str) {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
        ui.add(Label::new(RichText::new(unit).small().color(t.text_weak)).selectable(false));
    });
}

/// A plot that is looked at, not moved.
pub(crate) fn fixed(plot: Plot<'_>, grid: Color32) -> Plot<'_> {
    plot.grid_color(grid)
        .show_crosshair(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .allow_axis_zoom_drag(false)
        .show_background(true)
        .set_margin_fraction(vec2(0.0, 0.05))
}
