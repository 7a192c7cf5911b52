//! Plot of power spectral densities (PSD): a segment and its model, or a model at several speeds.

use egui::{Color32, Ui};
use egui_plot::{Corner, GridMark, Legend, Line, Plot, PlotPoints};
use shagreen_core::units::Hertz;

use crate::look::plot::fixed;
use crate::look::theme::tokens;
use crate::strings::import as strings;

/// Displayed range of levels below the highest, in dB.
const RANGE_DB: f64 = 60.0;

/// Numbers on the frequency axis, in Hz.
const MARKS_HZ: [f64; 9] = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];

pub(crate) struct SpectrumLine<'a> {
    /// Name in the legend, which is shown for several lines.
    pub(crate) name: &'a str,
    /// PSD in (m/s²)²/Hz at each frequency of the plot.
    pub(crate) density: &'a [f64],
    pub(crate) color: Color32,
    /// Width in points.
    pub(crate) width: f32,
}

/// Draws PSDs in (m/s²)²/Hz at `frequencies`: that of the model, and the measured one if there is one. `model_name` is
/// the name of the model in the legend.
pub(crate) fn spectrum_plot(
    ui: &mut Ui,
    frequencies: &[Hertz],
    measured: Option<&[f64]>,
    (model_name, model): (&str, &[f64]),
    height: f32,
) {
    let t = tokens(ui.ctx());
    let measured = measured.map(|density| SpectrumLine {
        name: strings::MEASURED_LINE,
        density,
        color: t.text_weak,
        width: 1.2,
    });
    let model = SpectrumLine { name: model_name, density: model, color: t.accent, width: 2.2 };
    let lines: Vec<SpectrumLine<'_>> = measured.into_iter().chain([model]).collect();
    spectra_plot(ui, &strings::spectrum_of(model_name), frequencies, &lines, height);
}

/// Draws PSDs over each other, the last one on top; `name` is the accessible name. Draws nothing if the frequencies
/// span no range.
pub(crate) fn spectra_plot(
    ui: &mut Ui,
    name: &str,
    frequencies: &[Hertz],
    lines: &[SpectrumLine<'_>],
    height: f32,
) {
    let t = tokens(ui.ctx());
    let to_db = |density: f64| 10.0 * density.max(1e-20).log10();
    let drawn = |density: &[f64]| -> Vec<[f64; 2]> {
        let pairs = frequencies.iter().zip(density).filter(|(f, p)| f.0 > 0.0 && p.is_finite());
        pairs.map(|(f, p)| [f.0.log10(), to_db(*p)]).collect()
    };
    let points: Vec<Vec<[f64; 2]>> = lines.iter().map(|line| drawn(line.density)).collect();
    let all = || points.iter().flatten();
    let top = all().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let top = if top.is_finite() { (top / 10.0).ceil() * 10.0 } else { 0.0 };
    let low = all().map(|p| p[0]).fold(f64::INFINITY, f64::min).max(MARKS_HZ[0].log10());
    let high = all().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
    if low >= high {
        return;
    }
    let marks: Vec<GridMark> = MARKS_HZ
        .iter()
        .map(|f| GridMark { value: f.log10(), step_size: 0.3 })
        .filter(|mark| (low..=high).contains(&mark.value))
        .collect();
    let mut plot = fixed(Plot::new(name.to_owned()), t.line)
        .height(height)
        .x_grid_spacer(move |_| marks.clone())
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [100.0, 20.0, 20.0]))
        .x_axis_formatter(|mark, _| format!("{:.0} Hz", 10.0_f64.powf(mark.value)))
        .y_axis_formatter(|mark, _| format!("{:.0}", mark.value + 0.0));
    if lines.len() > 1 {
        plot = plot.legend(Legend::default().position(Corner::LeftBottom).background_alpha(0.6));
    }
    let plot = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(low..=high + 0.02);
        plot.set_plot_bounds_y(top - RANGE_DB..=top + 3.0);
        for (line, points) in lines.iter().zip(points) {
            plot.line(Line::new(line.name, PlotPoints::from(points)).color(line.color).width(line.width));
        }
    });
    plot.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
}
