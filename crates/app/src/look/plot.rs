//! Common parts of all plots in the window.

use std::ops::RangeInclusive;

use egui::{Color32, Label, Rangef, RichText, Sense, Ui, vec2};
use egui_plot::{AxisHints, GridMark, Plot};

use crate::look::theme::{GAP, tokens};

/// Draws a heading, and the unit of the plot below it.
pub(crate) fn title(ui: &mut Ui, text: &str, unit: &str) {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
        ui.add(Label::new(RichText::new(unit).small().color(t.text_weak)).selectable(false));
    });
}

/// Draws what a color of a plot means: a dot of the color before the words.
pub(crate) fn legend_entry_ui(ui: &mut Ui, color: Color32, text: &str) {
    let (area, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
    ui.painter().circle_filled(area.center(), 3.5, color);
    let text = RichText::new(text).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false));
    ui.add_space(GAP);
}

/// Distances between labels of the horizontal and of the vertical axis up to which they are hidden and from which they
/// are shown, in points. In between they would be translucent, and hard to read.
pub(crate) const LABEL_SPACINGS: [Rangef; 2] =
    [Rangef { min: 33.0, max: 34.0 }, Rangef { min: 16.0, max: 17.0 }];

/// Horizontal axis whose labels are opaque.
pub(crate) fn x_axis<'a>() -> AxisHints<'a> {
    AxisHints::new_x().label_spacing(LABEL_SPACINGS[0])
}

/// Vertical axis whose labels are opaque.
pub(crate) fn y_axis<'a>() -> AxisHints<'a> {
    AxisHints::new_y().label_spacing(LABEL_SPACINGS[1])
}

/// Writes the numbers of a horizontal axis that begins at `start`, except the one there: the lowest number of the
/// vertical axis is at that corner.
pub(crate) fn after_start(
    start: f64,
    written: impl Fn(f64) -> String,
) -> impl Fn(GridMark, &RangeInclusive<f64>) -> String {
    move |mark, _| if mark.value <= start { String::new() } else { written(mark.value) }
}

/// Plot that the pointer cannot move or zoom, and the Tab key does not reach.
pub(crate) fn fixed(plot: Plot<'_>, grid: Color32) -> Plot<'_> {
    plot.grid_color(grid)
        .sense(Sense::hover())
        .custom_x_axes(vec![x_axis()])
        .custom_y_axes(vec![y_axis()])
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

/// Number on an axis, without rounding errors of its steps.
pub(crate) fn short(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6 + 0.0)
}

/// Round number (1, 2 or 5 times a power of ten) that fits two to five times into `range`.
pub(crate) fn nice_step(range: f64) -> f64 {
    let decade = 10.0_f64.powf((0.5 * range).log10().floor());
    let fitting = [5.0, 2.0, 1.0].into_iter().find(|step| step * decade <= 0.5 * range);
    fitting.unwrap_or(1.0) * decade
}

#[cfg(test)]
mod tests {
    use super::{after_start, nice_step, short};
    use egui_plot::GridMark;

    #[test]
    fn the_corner_of_a_plot_has_one_number() {
        let written = after_start(-10.0, |secs| format!("{secs:.0} s"));
        let at = |value: f64| written(GridMark { value, step_size: 1.0 }, &(-10.0..=0.0));
        assert_eq!([at(-10.0), at(-9.0), at(0.0)], ["", "-9 s", "0 s"]);
    }

    #[test]
    fn marks_are_short() {
        assert_eq!(short(0.300_000_000_000_000_04), "0.3");
        assert_eq!(short(-0.0), "0");
    }

    #[test]
    fn steps_are_round_and_few() {
        for (range, step) in [(110.0, 50.0), (500.0, 200.0), (90.0, 20.0), (22.0, 10.0)] {
            assert!((nice_step(range) - step).abs() < 1e-9, "{range}: {}", nice_step(range));
        }
    }
}
