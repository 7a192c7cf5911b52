//! Recording over time: acceleration, speed and force on one time axis.

use egui::{Color32, Ui};
use egui_plot::{FilledArea, GridMark, Line, Plot, PlotPoints, PlotUi, Span};

use crate::look::plot::{after_start, fixed, short, title};
use crate::look::theme::{Tokens, tokens};
use crate::sheets::import::trace::Trace;
use crate::strings::import as strings;

/// Width of the numbers beside the plots, in points: equal for all, so that the time axes are aligned.
const MARKS_WIDTH: f32 = 44.0;

/// Draws the three traces within `height` points. The segment from `chosen[0]` to `chosen[1]` (in s) is highlighted.
pub(super) fn trace_plot(ui: &mut Ui, trace: &Trace, chosen: Option<[f64; 2]>, height: f32) {
    let t = tokens(ui.ctx());
    let titles = 3.0 * 28.0;
    let unit = (height - titles - 20.0).max(90.0) / 4.0;
    let excluded = if trace.excluded.is_empty() { "" } else { strings::EXCLUDED };
    title(ui, strings::ACCELERATION, &format!("{}   {excluded}", strings::ACCELERATION_UNIT));
    let xs: Vec<f64> = trace.acceleration.iter().map(|a| a[0]).collect();
    let lows: Vec<f64> = trace.acceleration.iter().map(|a| a[1]).collect();
    let highs: Vec<f64> = trace.acceleration.iter().map(|a| a[2]).collect();
    let range = highs.iter().chain(&lows).map(|a| a.abs()).fold(1e-3, f64::max) * 1.05;
    row(ui, strings::ACCELERATION, trace, chosen, [-range, range], 2.0 * unit, |plot| {
        let fill = FilledArea::new("", &xs, &lows, &highs).fill_color(t.accent.gamma_multiply(0.55));
        plot.add(fill.stroke(egui::Stroke::new(1.0, t.accent)).allow_hover(false));
    });
    for (name, unit_name, values, color, axis) in [
        (strings::SPEED, strings::SPEED_UNIT, &trace.speed_mm_per_s, t.parents[1], 0.0),
        (strings::FORCE, strings::FORCE_UNIT, &trace.force_n, t.parents[0], 20.0),
    ] {
        title(ui, name, unit_name);
        let highest = values.iter().map(|v| v[1]).fold(1e-3, f64::max) * 1.1;
        let lowest = values.iter().map(|v| v[1]).fold(0.0, f64::min) * 1.1;
        row(ui, name, trace, chosen, [lowest, highest], unit + axis, |plot| {
            plot.line(
                Line::new("", PlotPoints::from(values.clone())).color(color).width(1.4).allow_hover(false),
            );
        });
    }
}

/// Draws one trace; only the last one, the force, has numbers on its time axis.
fn row<'a>(
    ui: &mut Ui,
    name: &str,
    trace: &'a Trace,
    chosen: Option<[f64; 2]>,
    range: [f64; 2],
    height: f32,
    draw: impl FnOnce(&mut PlotUi<'a>) + 'a,
) {
    let t: &'static Tokens = tokens(ui.ctx());
    let mark = nice(range[1]);
    let marks = [-mark, 0.0, mark].map(|value| GridMark { value, step_size: mark });
    let plot = fixed(Plot::new(name.to_owned()), t.line)
        .height(height)
        .show_axes([name == strings::FORCE, true])
        .y_axis_min_width(MARKS_WIDTH)
        .y_grid_spacer(move |_| marks.iter().copied().filter(|m| m.value >= range[0]).collect())
        .x_axis_formatter(after_start(0.0, |secs| format!("{} s", short(secs))))
        .y_axis_formatter(|mark, _| short(mark.value))
        .show(ui, move |plot| {
            plot.set_plot_bounds_x(0.0..=trace.seconds.max(1e-3));
            plot.set_plot_bounds_y(range[0]..=range[1]);
            for [from, to] in &trace.excluded {
                shade(plot, [*from, *to], t.warning.gamma_multiply(0.22));
            }
            if let Some(chosen) = chosen {
                shade(plot, chosen, t.text.gamma_multiply(0.16));
            }
            draw(plot);
        });
    plot.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
}

fn shade(plot: &mut PlotUi<'_>, range: [f64; 2], color: Color32) {
    plot.span(Span::new("", range[0]..=range[1]).fill(color));
}

/// Largest integer multiple of a power of ten that is at most `highest`, so that one number states the height of a
/// plot.
fn nice(highest: f64) -> f64 {
    let power = 10.0_f64.powf(highest.log10().floor());
    (highest / power * (1.0 + 1e-12)).floor() * power
}

#[cfg(test)]
mod tests {
    use super::nice;

    #[test]
    fn marks_are_at_round_numbers() {
        for (highest, expected) in [(9.7, 9.0), (3.0, 3.0), (1.9, 1.0), (210.0, 200.0), (0.045, 0.04)] {
            assert!((nice(highest) - expected).abs() < 1e-12, "{highest}: {}", nice(highest));
        }
    }
}
