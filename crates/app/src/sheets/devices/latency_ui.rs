//! Latency from pen to drive signal, measured at every touch.

use egui::{Ui, vec2};
use egui_plot::{HLine, Line, Plot, PlotPoints};
use shagreen_device::status::{STROKE_BUDGET_SECS, TAP_BUDGET_SECS};

use super::{note, warning};
use crate::look::plot::{after_start, fixed, legend_entry_ui, title};
use crate::look::theme::tokens;
use crate::session::{LATENCY_HISTORY_SECS, Session};
use crate::strings::devices as strings;

/// Height of the graph, in points.
const HEIGHT: f32 = 130.0;
/// Highest latency that is drawn, in ms.
const TOP_MS: f64 = 60.0;

pub(super) fn latency_ui(ui: &mut Ui, session: &Session) {
    let t = tokens(ui.ctx());
    title(ui, strings::LATENCY, strings::LATENCY_UNIT);
    let limits = strings::latency_limits(1e3 * STROKE_BUDGET_SECS, 1e3 * TAP_BUDGET_SECS);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 0.0);
        legend_entry_ui(ui, t.accent, strings::LATENCY_OF_STROKES);
        legend_entry_ui(ui, t.text_weak, strings::LATENCY_OF_TAPS);
        legend_entry_ui(ui, t.warning, &limits);
    });
    let history = session.latencies();
    let line = |of: fn(&(f64, f32, f32)) -> (f64, f32)| -> PlotPoints<'static> {
        history.iter().map(of).map(|(secs, latency)| [secs, (1e3 * f64::from(latency)).min(TOP_MS)]).collect()
    };
    let strokes = line(|(secs, stroke, _)| (*secs, *stroke));
    let taps = line(|(secs, _, tap)| (*secs, *tap));
    fixed(Plot::new("latency"), t.line)
        .height(HEIGHT)
        .x_axis_formatter(after_start(-LATENCY_HISTORY_SECS, |secs| format!("{:.0} s", secs + 0.0)))
        .x_grid_spacer(egui_plot::uniform_grid_spacer(|_| [5.0, 5.0, 1.0]))
        .y_axis_formatter(|mark, _| format!("{:.0}", mark.value))
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [20.0, 10.0, 10.0]))
        .show(ui, |plot| {
            plot.set_plot_bounds_x(-LATENCY_HISTORY_SECS..=0.0);
            plot.set_plot_bounds_y(0.0..=TOP_MS);
            for budget_secs in [STROKE_BUDGET_SECS, TAP_BUDGET_SECS] {
                plot.hline(HLine::new("", 1e3 * f64::from(budget_secs)).color(t.warning).width(1.0));
            }
            plot.line(Line::new("", taps).color(t.text_weak).width(1.5));
            plot.line(Line::new("", strokes).color(t.accent).width(2.0));
        });
    let latency = session.status().map(|status| status.latency).unwrap_or_default();
    if latency.n_touches == 0 {
        note(ui, strings::NO_TOUCH);
        return;
    }
    let strokes = strings::strokes(1e3 * latency.stroke_secs, 1e3 * latency.stroke_max_secs);
    let say = |is_late: bool| if is_late { warning } else { note };
    say(latency.is_stroke_late())(ui, &strokes);
    say(latency.is_tap_late())(ui, &strings::taps(1e3 * latency.tap_secs, latency.is_tap_late()));
}
