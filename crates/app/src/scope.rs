//! What is played: the waveform, and its spectrum beside the spectra of the parents and of the blend.

use egui::{Label, Rangef, RichText, Ui};
use egui_plot::{AxisHints, Legend, Line, Plot, PlotPoints};

use crate::panel::Panel;
use crate::session::BAND_HZ;
use crate::strings;
use crate::theme::{GAP, tokens};

/// Lowest density that is drawn, in dB re 1 (m/s²)²/Hz.
const FLOOR_DB: f64 = -70.0;
/// Highest density that is drawn.
const TOP_DB: f64 = 5.0;
/// From one line of the grid to the next, in dB: far enough that every number can be read.
const STEP_DB: f64 = 20.0;

/// Draws both plots side by side.
pub fn scope_ui(ui: &mut Ui, panel: &Panel<'_>) {
    let width = ui.available_width();
    let height = ui.available_height();
    if panel.session.is_hidden() {
        let words = RichText::new(strings::compare::HIDDEN).color(tokens(ui.ctx()).text_weak);
        ui.centered_and_justified(|ui| ui.add(Label::new(words).selectable(false)));
        return;
    }
    ui.horizontal(|ui| {
        let left = egui::vec2(width * 0.42 - GAP, height);
        ui.allocate_ui_with_layout(left, egui::Layout::top_down(egui::Align::Min), |ui| waveform(ui, panel));
        let right = egui::vec2(width * 0.58, height);
        ui.allocate_ui_with_layout(right, egui::Layout::top_down(egui::Align::Min), |ui| spectrum(ui, panel));
    });
}

/// A heading and the unit of what stands below it.
pub(crate) fn title(ui: &mut Ui, text: &str, unit: &str) {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
        ui.add(Label::new(RichText::new(unit).small().color(t.text_weak)).selectable(false));
    });
}

fn waveform(ui: &mut Ui, panel: &Panel<'_>) {
    let t = tokens(ui.ctx());
    title(ui, strings::WAVEFORM, strings::WAVEFORM_UNIT);
    let scope = panel.session.scope();
    let (rate_hz, samples) = scope.newest(0.25);
    let n = samples.len() as f64;
    let points: PlotPoints<'_> =
        samples.iter().enumerate().map(|(i, y)| [(i as f64 - n) / rate_hz * 1e3, *y]).collect();
    let range = scope.range();
    fixed(Plot::new("waveform"), t.line)
        .x_axis_formatter(|mark, _| format!("{:.0} ms", mark.value))
        .y_axis_formatter(|mark, _| format!("{}", mark.value + 0.0))
        .y_grid_spacer(egui_plot::uniform_grid_spacer(move |_| [range, 0.5 * range, 0.5 * range]))
        .show(ui, |plot| {
            plot.set_plot_bounds_x(-250.0..=0.0);
            plot.set_plot_bounds_y(-range..=range);
            plot.line(Line::new(strings::WAVEFORM, points).color(t.accent).width(1.2));
        });
}

fn spectrum(ui: &mut Ui, panel: &Panel<'_>) {
    let t = tokens(ui.ctx());
    title(ui, strings::SPECTRUM, strings::SPECTRUM_UNIT);
    let spectra = panel.session.spectra();
    // Parents carry their colors everywhere in the window, so the legend names only what is not theirs.
    let line = |name: &str, points: PlotPoints<'static>| Line::new(name.to_owned(), points);
    let to_points = |pairs: &mut dyn Iterator<Item = (f64, f64)>| -> PlotPoints<'static> {
        let in_band = pairs.filter(|(f, _)| (BAND_HZ.0..=BAND_HZ.1).contains(f));
        in_band.map(|(f, p)| [f.log10(), (10.0 * p.max(1e-12).log10()).max(FLOOR_DB - 10.0)]).collect()
    };
    let modeled =
        |density: &[f64]| to_points(&mut spectra.frequencies.iter().zip(density).map(|(f, p)| (f.0, *p)));
    let live = to_points(&mut panel.session.scope().density().iter().map(|(f, p)| (f.0, *p)));
    let marks = |_: egui_plot::GridInput| {
        [10.0_f64, 20.0, 50.0, 100.0, 200.0, 400.0]
            .map(|f| egui_plot::GridMark { value: f.log10(), step_size: 0.3 })
            .to_vec()
    };
    // In a small window the numbers stand as close as they can be read.
    let across = AxisHints::new_x().label_spacing(Rangef::new(34.0, 44.0));
    let across = across.formatter(|mark, _| format!("{:.0} Hz", 10.0_f64.powf(mark.value)));
    fixed(Plot::new("spectrum"), t.line)
        .legend(Legend::default().position(egui_plot::Corner::LeftTop).background_alpha(0.6))
        .x_grid_spacer(marks)
        .custom_x_axes(vec![across])
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [2.0 * STEP_DB, STEP_DB, STEP_DB]))
        .show(ui, |plot| {
            plot.set_plot_bounds_x((0.93 * BAND_HZ.0).log10()..=(1.12 * BAND_HZ.1).log10());
            plot.set_plot_bounds_y(FLOOR_DB..=TOP_DB);
            plot.line(line(strings::LIVE_LINE, live).color(t.text_weak.gamma_multiply(0.6)).width(1.0));
            for (density, color) in spectra.parents.iter().zip(t.parents) {
                plot.line(line("", modeled(density)).color(color).width(1.2));
            }
            plot.line(line(strings::BLEND_LINE, modeled(&spectra.blend)).color(t.accent).width(2.5));
        });
}

/// A plot that is looked at, not moved.
pub(crate) fn fixed(plot: Plot<'_>, grid: egui::Color32) -> Plot<'_> {
    plot.grid_color(grid)
        .show_crosshair(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .allow_axis_zoom_drag(false)
        .show_background(true)
        .set_margin_fraction(egui::vec2(0.0, 0.05))
}
