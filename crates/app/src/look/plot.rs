//! Common parts of all plots in the window.

use egui::{Color32, Label, RichText, Ui, vec2};
use egui_plot::Plot;

use crate::look::theme::tokens;

/// Draws a heading, and the unit of the plot below it.
pub(crate) fn title(ui: &mut Ui, text: &str, unit: &str) {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
        ui.add(Label::new(RichText::new(unit).small().color(t.text_weak)).selectable(false));
    });
}

/// Plot that the pointer cannot move or zoom.
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

/// Round number (1, 2 or 5 times a power of ten) that fits two to five times into `range`.
pub(crate) fn nice_step(range: f64) -> f64 {
    let decade = 10.0_f64.powf((0.5 * range).log10().floor());
    let fitting = [5.0, 2.0, 1.0].into_iter().find(|step| step * decade <= 0.5 * range);
    fitting.unwrap_or(1.0) * decade
}

#[cfg(test)]
mod tests {
    use super::nice_step;

    #[test]
    fn steps_are_round_and_few() {
        for (range, step) in [(110.0, 50.0), (500.0, 200.0), (90.0, 20.0), (22.0, 10.0)] {
            assert!((nice_step(range) - step).abs() < 1e-9, "{range}: {}", nice_step(range));
        }
    }
}
