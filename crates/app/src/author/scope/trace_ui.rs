//! Figure of the scope, which the pointer reads and measures.

use egui::{
    Color32, FontId, Label, Pos2, Rangef, Rect, Response, RichText, Role, Sense, Shape, Stroke, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
use egui_plot::{
    GridInput, GridMark, Line, LineStyle, Plot, PlotPoint, PlotPoints, PlotTransform, uniform_grid_spacer,
};
use shagreen_formats::figure::{Chart, Figure, Scale, Series, Tone};

use crate::choices::scope::View;
use crate::look::map_plot::map_plot;
use crate::look::plot::{after_start, fixed, nice_step, x_axis};
use crate::look::theme::{Tokens, tokens, tone_color};
use crate::look::together::together_ui;
use crate::strings::scope as words;

/// Minimum length of a drag that measures, in points.
const LEAST_DRAG: f32 = 4.0;
/// Frequencies labeled on the frequency axis, in Hz.
const MARKED_HZ: [f64; 6] = [10.0, 20.0, 50.0, 100.0, 200.0, 400.0];

/// Measured range on the horizontal axis, in the unit of that axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    /// Start of the drag.
    pub from: f64,
    /// Current position or end of the drag.
    pub to: f64,
}

/// Draws a figure into the available space; the pointer reads and measures it.
pub(super) fn trace_ui(ui: &mut Ui, view: View, side: usize, figure: &Figure, span: &mut Option<Span>) {
    let name = format!("scope {side} {view:?}");
    let (area, transform, scale) = match figure {
        Figure::Chart(chart) => {
            let (area, transform) = chart_plot(ui, &name, view, chart);
            (area, transform, chart.x_scale)
        }
        Figure::Map(map) => {
            let shown = map_plot(ui, &name, map);
            (shown.response.rect, shown.transform, Scale::Linear)
        }
        Figure::Table(_) => return,
    };
    let axis = Axis { transform, scale };
    let response = ui.interact(area, ui.scope_id().with(&name), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, words::view(view)));
    measure(ui, &response, &axis, span);
    let painter = ui.painter_at(area);
    let t = tokens(ui.ctx());
    if let Some(Span { from, to }) = *span {
        let (left, right) = (axis.on_screen(from), axis.on_screen(to));
        let band = Rect::from_x_y_ranges(Rangef::new(left.min(right), left.max(right)), area.y_range());
        painter.rect_filled(band, 0.0, t.accent.gamma_multiply(0.18));
        for x in [left, right] {
            painter.vline(x, area.y_range(), Stroke::new(1.0, t.accent));
        }
    }
    if let Some(at) = response.hover_pos().filter(|_| !response.dragged()) {
        painter.vline(at.x, area.y_range(), Stroke::new(1.0, t.text_weak.gamma_multiply(0.6)));
        read_ui(ui, view, figure, &axis, at, area);
    }
}

/// Horizontal axis of a plot on the screen.
struct Axis {
    transform: PlotTransform,
    scale: Scale,
}

impl Axis {
    fn on_screen(&self, x: f64) -> f32 {
        self.transform.position_from_point(&PlotPoint::new(self.scale.laid_out(x), 0.0)).x
    }

    fn value_at(&self, pos: Pos2) -> f64 {
        self.scale.coordinate(self.transform.value_from_position(pos).x)
    }
}

/// A drag measures a range; a click removes the measurement.
fn measure(ui: &Ui, response: &Response, axis: &Axis, span: &mut Option<Span>) {
    if response.clicked() {
        *span = None;
    }
    let origin = ui.input(|i| i.pointer.press_origin()).filter(|_| response.dragged());
    if let (Some(from), Some(to)) = (origin, response.interact_pointer_pos())
        && (to.x - from.x).abs() >= LEAST_DRAG
    {
        *span = Some(Span { from: axis.value_at(from), to: axis.value_at(to) });
    }
}

fn chart_plot(ui: &mut Ui, name: &str, view: View, chart: &Chart) -> (Rect, PlotTransform) {
    let t = tokens(ui.ctx());
    let [x, y] = chart.bounds();
    let scale = chart.x_scale;
    if chart.series.len() > 1 {
        legend_ui(ui, view, chart, t);
    }
    let written = move |value: f64| match view {
        View::Waveform => format!("{value:.0} ms"),
        View::Spectrum => words::frequency_mark(scale.coordinate(value), MARKED_HZ[0]),
        View::Spectrogram | View::Level | View::Contact => format!("{value:.0} s"),
    };
    let across = x_axis().formatter(after_start(scale.laid_out(x.0), written));
    // Step between grid lines: large enough that every number is legible.
    let step = match view {
        View::Waveform => 0.5 * y.1,
        View::Spectrum | View::Level => 20.0,
        View::Spectrogram | View::Contact => nice_step(y.1),
    };
    let mut plot = fixed(Plot::new(name.to_owned()), t.line)
        .custom_x_axes(vec![across])
        .y_axis_formatter(|mark, _| format!("{}", mark.value + 0.0))
        .y_grid_spacer(uniform_grid_spacer(move |_| [2.0 * step, step, step]))
        .height(ui.available_height());
    if scale == Scale::Logarithmic {
        plot = plot.x_grid_spacer(|_: GridInput| {
            MARKED_HZ.map(|hz| GridMark { value: hz.log10(), step_size: 0.3 }).to_vec()
        });
    }
    let shown = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(scale.laid_out(x.0)..=scale.laid_out(x.1));
        plot.set_plot_bounds_y(y.0..=y.1);
        for series in &chart.series {
            let points: PlotPoints<'_> =
                series.points.iter().map(|point| [scale.laid_out(point.x), point.y]).collect();
            let (width, style) = match series.tone {
                Tone::Faint => (1.0, LineStyle::Solid),
                Tone::Limit => (1.2, LineStyle::dashed_loose()),
                Tone::Main if view == View::Spectrum => (2.5, LineStyle::Solid),
                _ => (1.3, LineStyle::Solid),
            };
            let line = Line::new("", points).allow_hover(false).width(width).style(style);
            plot.line(line.color(tone_color(t, series.tone)));
        }
    });
    (shown.response.rect, shown.transform)
}

/// Area of a line in the legend, in points.
const LEGEND_LINE: Vec2 = vec2(12.0, 14.0);

/// Draws the legend in a row above the plot, where it covers no line.
fn legend_ui(ui: &mut Ui, view: View, chart: &Chart, t: &Tokens) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = LEGEND_LINE.y;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(9.0, 1.0);
            for series in chart.series.iter().filter(|series| is_in_legend(view, series)) {
                together_ui(ui, &series.name, |ui| entry_ui(ui, series, t));
            }
        });
    });
}

/// Draws an entry of the legend.
fn entry_ui(ui: &mut Ui, series: &Series, t: &Tokens) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let (area, _) = ui.allocate_exact_size(LEGEND_LINE, Sense::hover());
    let stroke = Stroke::new(2.0, tone_color(t, series.tone));
    let ends = [area.left_center(), area.right_center()];
    if series.tone == Tone::Limit {
        ui.painter().extend(Shape::dashed_line(&ends, stroke, 5.0, 2.0));
    } else {
        ui.painter().line_segment(ends, stroke);
    }
    let text = RichText::new(&series.name).small().color(t.text_weak);
    ui.add(Label::new(text).selectable(false));
}

/// Whether the legend has a series. Contributing textures need none: their colors are the same throughout the window.
fn is_in_legend(view: View, series: &Series) -> bool {
    view != View::Spectrum || !matches!(series.tone, Tone::Second | Tone::Third | Tone::Fourth)
}

/// Draws a box beside the pointer with its position on the axis and the value of each line there.
fn read_ui(ui: &Ui, view: View, figure: &Figure, axis: &Axis, at: Pos2, area: Rect) {
    let t = tokens(ui.ctx());
    let x = axis.value_at(at);
    let mut lines: Vec<(String, Color32)> = Vec::new();
    match figure {
        Figure::Chart(chart) => {
            lines.push((format!("{x:.1} {}", words::x_unit(view)), t.text_weak));
            for series in &chart.series {
                let nearest = series.points.iter().min_by(|a, b| (a.x - x).abs().total_cmp(&(b.x - x).abs()));
                lines.extend(
                    nearest.map(|point| (words::value(&series.name, point.y), tone_color(t, series.tone))),
                );
            }
        }
        Figure::Map(map) => {
            let y = axis.transform.value_from_position(at).y;
            lines.push((words::place(x, y), t.text_weak));
            let share = |v: f64, (low, high): (f64, f64)| ((v - low) / (high - low)).clamp(0.0, 1.0);
            let row = (share(y, map.y) * map.rows.len() as f64) as usize;
            let value =
                map.rows.get(row).and_then(|row| row.get((share(x, map.x) * row.len() as f64) as usize));
            lines.extend(value.map(|value| (words::value(words::DENSITY, *value), t.text)));
        }
        Figure::Table(_) => {}
    }
    let painter = ui.painter_at(area);
    let font = FontId::proportional(11.0);
    let galleys: Vec<_> =
        lines.into_iter().map(|(text, color)| painter.layout_no_wrap(text, font.clone(), color)).collect();
    let width = galleys.iter().map(|galley| galley.size().x).fold(0.0, f32::max) + 12.0;
    let height = galleys.iter().map(|galley| galley.size().y).sum::<f32>() + 8.0;
    // On the side with enough room.
    let left = if at.x + 10.0 + width < area.right() { at.x + 10.0 } else { at.x - 10.0 - width };
    let back = Rect::from_min_size(pos2(left, area.top() + 6.0), vec2(width, height));
    painter.rect_filled(back, 3.0, t.raised.gamma_multiply(0.92));
    let mut y = back.top() + 4.0;
    for galley in galleys {
        let line_height = galley.size().y;
        painter.galley(pos2(left + 6.0, y), galley, t.text);
        y += line_height;
    }
}
