//! Draws a chart of a figure: points, lines and labels, in the colors of the theme.

use egui::{
    Color32, FontId, Label, Pos2, Rangef, Rect, RichText, Role, Sense, Shape, Stroke, StrokeKind, TextStyle,
    TextWrapMode, Ui, Vec2, WidgetInfo, WidgetText, pos2, vec2,
};
use egui_plot::{
    GridInput, GridMark, Line, LineStyle, Plot, PlotPoint, PlotPoints, PlotTransform, Points,
    uniform_grid_spacer,
};
use shagreen_formats::figure::{Chart, Mark, Point, Scale, Series, Tone};

use crate::look::label_places::{Placed, Wish, label_places, remembered_places};
use crate::look::plot::{LABEL_SPACINGS, after_start, fixed, nice_step, short, x_axis, y_axis};
use crate::look::theme::{GAP, Tokens, tokens, tone_color};

/// Radius of a dot in points.
const DOT: f32 = 3.5;
/// Length of a dash, in points.
const DASH: f32 = 5.0;
/// Maximum distance between the pointer and a dot that it reads, in points.
const REACH: f32 = 9.0;

/// Height of the horizontal axis with its label, in points.
const HORIZONTAL_AXIS: f32 = 34.0;
/// Length of a line in the legend, and its distance from the name, in points.
const LEGEND_LINE: f32 = 16.0;
const LEGEND_GAP: f32 = 5.0;

/// Draws the chart into the available space. `name` is its id, `title` its accessible name.
pub(crate) fn chart_ui(ui: &mut Ui, name: &str, title: &str, chart: &Chart) {
    let t = tokens(ui.ctx());
    legend_ui(ui, chart, t);
    let [x, y] = chart.bounds();
    // Numbers are as close together as is legible.
    let mut across = x_axis().label(RichText::new(&chart.x_label).small());
    let scale = chart.x_scale;
    if let Some(highest) = highest_whole(chart) {
        across = across.label_spacing(whole_spacing(ui, highest));
    }
    // With equal scales on both axes, the plot begins somewhere before the bounds.
    let start = if chart.is_isotropic { f64::NEG_INFINITY } else { scale.laid_out(x.0) };
    let across = across.formatter(after_start(start, move |value| match scale {
        Scale::Logarithmic => format!("{}", round_to_digits(scale.coordinate(value))),
        Scale::Linear => short(value),
    }));
    // In a low plot, a long label would reach beyond it.
    let height = ui.available_height() - HORIZONTAL_AXIS;
    let label = WidgetText::from(RichText::new(&chart.y_label).small());
    let label = label.into_galley(ui, Some(TextWrapMode::Truncate), height, TextStyle::Small);
    let up = y_axis().label(label).formatter(|mark, _| short(mark.value));
    let mut plot = fixed(Plot::new(name.to_owned()), t.line)
        .custom_x_axes(vec![across])
        .custom_y_axes(vec![up])
        .grid_spacing(Rangef::new(10.0, 70.0))
        .height(ui.available_height());
    if chart.is_isotropic {
        plot = plot.data_aspect(1.0);
    } else if y.1 > y.0 {
        // At least five numbers, and not many more in a high window.
        let step = nice_step(0.4 * (y.1 - y.0));
        plot = plot.y_grid_spacer(uniform_grid_spacer(move |_| [5.0 * step, step, step]));
    }
    if scale == Scale::Logarithmic {
        plot = plot.x_grid_spacer(move |_: GridInput| {
            round_numbers(x).map(|x| GridMark { value: scale.laid_out(x), step_size: 0.3 }).collect()
        });
    }
    let laid_out = [(scale.laid_out(x.0), scale.laid_out(x.1)), y];
    let shown = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(scale.laid_out(x.0)..=scale.laid_out(x.1));
        plot.set_plot_bounds_y(y.0..=y.1);
        for series in &chart.series {
            let color = tone_color(t, series.tone);
            let points: Vec<[f64; 2]> = series.points.iter().map(|p| [scale.laid_out(p.x), p.y]).collect();
            match series.mark {
                Mark::Dots => {
                    plot.points(
                        Points::new("", PlotPoints::from(points)).color(color).radius(radius(series)),
                    );
                }
                // Each piece is a separate line: the joins of a line that turns back on itself would be wider than the
                // line.
                Mark::Line => {
                    for ends in thinned(&points, laid_out).windows(2) {
                        plot.line(piece(ends, 2.0, color));
                    }
                }
                Mark::DashedLine => {
                    let line = Line::new("", PlotPoints::from(thinned(&points, laid_out)));
                    let line = line.style(LineStyle::Dashed { length: DASH }).allow_hover(false);
                    plot.line(line.color(color).width(2.0));
                }
                Mark::Segments => {
                    let width = if series.tone == Tone::Faint { 1.0 } else { 2.0 };
                    for ends in points.as_chunks::<2>().0 {
                        plot.line(piece(ends, width, color));
                    }
                }
            }
        }
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, title));
    names_ui(ui, chart, shown.response.rect, &shown.transform, t);
    let near = shown.response.hover_pos().and_then(|at| nearest(chart, &shown.transform, at));
    if let Some(point) = near {
        let at = on_screen(chart, &shown.transform, point);
        pointed_ui(ui, point, at, shown.response.rect, t);
    }
}

/// Highest number on the horizontal axis if all points are at whole numbers from zero upwards.
fn highest_whole(chart: &Chart) -> Option<f64> {
    let xs = || chart.series.iter().flat_map(|series| &series.points).map(|point| point.x);
    let is_whole = chart.x_scale == Scale::Linear && xs().all(|x| x >= 0.0 && x.fract() == 0.0);
    xs().reduce(f64::max).filter(|_| is_whole)
}

/// Distance of the numbers from which they are shown: short ones may be closer together than long ones.
fn whole_spacing(ui: &Ui, highest: f64) -> Rangef {
    const BETWEEN: f32 = 8.0;
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(format!("{highest:.0}"), font, Color32::PLACEHOLDER);
    let least = (galley.size().x + BETWEEN).min(LABEL_SPACINGS[0].min);
    Rangef::new(least, least + 1.0)
}

/// Numbers on a logarithmic axis: 1, 2 and 5 of each decade.
fn round_numbers((low, high): (f64, f64)) -> impl Iterator<Item = f64> {
    debug_assert!(low > 0.0, "ratios are above zero");
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let of = |decade: i32| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f64.powi(decade));
    decades.flat_map(of).filter(move |x| (low..=high).contains(x))
}

/// Rounds a number to three significant digits, to remove rounding errors of the logarithm.
fn round_to_digits(x: f64) -> f64 {
    let unit = 10.0_f64.powf(x.log10().floor() - 2.0);
    // Rounded again as decimal text, because a tenth is not exact in binary.
    let rounded = (x / unit).round() * unit;
    format!("{rounded:.6}").parse().unwrap_or(rounded)
}

fn piece(ends: &[[f64; 2]], width: f32, color: Color32) -> Line<'static> {
    Line::new("", PlotPoints::from(ends.to_vec())).color(color).width(width).allow_hover(false)
}

/// Radius of a dot: smaller for auxiliary series.
fn radius(series: &Series) -> f32 {
    if series.tone == Tone::Faint { 0.65 * DOT } else { DOT }
}

/// Draws the legend in rows above the plot, where it covers nothing. Lines labeled at their ends are left out.
fn legend_ui(ui: &mut Ui, chart: &Chart, t: &Tokens) {
    let is_named = |series: &&Series| {
        let has_labels = series.points.iter().any(|point| !point.label.is_empty());
        series.mark == Mark::Segments && (has_labels || is_single_line(series))
    };
    ui.horizontal_wrapped(|ui| {
        // A line and its dots share one entry.
        let mut before = "";
        for series in chart.series.iter().filter(|series| !is_named(series)) {
            if std::mem::replace(&mut before, &series.name) == series.name {
                continue;
            }
            let color = tone_color(t, series.tone);
            let text = WidgetText::from(RichText::new(&series.name).small().color(t.text_weak));
            let text = text.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Small);
            // Rows in a row are not wrapped by themselves.
            let is_first = ui.next_widget_position().x <= ui.max_rect().left();
            if !is_first && ui.available_size_before_wrap().x < LEGEND_LINE + LEGEND_GAP + text.size().x {
                ui.end_row();
            }
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = LEGEND_GAP;
                let (area, _) = ui.allocate_exact_size(vec2(LEGEND_LINE, 14.0), Sense::hover());
                match series.mark {
                    Mark::Dots => {
                        ui.painter().circle_filled(area.center(), radius(series), color);
                    }
                    Mark::Line | Mark::Segments => {
                        ui.painter().hline(area.x_range(), area.center().y, Stroke::new(2.0, color));
                    }
                    Mark::DashedLine => {
                        let ends = [area.left_center(), area.right_center()];
                        ui.painter().extend(Shape::dashed_line(&ends, Stroke::new(2.0, color), DASH, GAP));
                    }
                }
                ui.add(Label::new(text).selectable(false));
            });
            ui.add_space(GAP);
        }
    });
}

/// Draws the labels of points where they cover nothing: first at the ends of lines, then at dots.
fn names_ui(ui: &Ui, chart: &Chart, area: Rect, transform: &PlotTransform, t: &Tokens) {
    let painter = ui.painter_at(area);
    let (mut dots, mut named) = (Vec::new(), Vec::new());
    for series in &chart.series {
        let at = |point: &Point| on_screen(chart, transform, point);
        for (i, point) in series.points.iter().enumerate() {
            // A label at the end of a line continues in the direction of the line.
            let beyond = match series.mark {
                Mark::Segments => series.points.get(i ^ 1).map_or(Vec2::ZERO, |other| at(point) - at(other)),
                Mark::Dots | Mark::Line | Mark::DashedLine => Vec2::ZERO,
            };
            if !point.label.is_empty() {
                named.push((dots.len(), series, point.label.as_str(), beyond));
            } else if is_single_line(series) && i == 1 {
                named.push((dots.len(), series, series.name.as_str(), vec2(0.0, -1.0)));
            } else if series.mark != Mark::Dots || series.tone == Tone::Faint {
                // Labels may cover auxiliary points, and lines have no dots to keep free.
                continue;
            }
            dots.push(at(point));
        }
    }
    named.sort_by_key(|(_, series, ..)| series.mark == Mark::Dots);
    let (mut wishes, mut galleys) = (Vec::new(), Vec::new());
    for (dot, series, label, side) in named {
        let is_end = series.mark != Mark::Dots;
        let (size, color) = match (is_end, series.tone) {
            (true, Tone::Faint) => (11.0, t.text_weak),
            (true, tone) => (13.0, tone_color(t, tone)),
            (false, _) => (11.0, t.text),
        };
        let galley = painter.layout_no_wrap(label.to_owned(), FontId::proportional(size), color);
        wishes.push(Wish { dot, size: galley.size(), side, is_needed: is_end, may_lead: !is_end });
        galleys.push((galley, color));
    }
    let places = remembered_places(ui, "names in a figure", &dots, DOT, &wishes, &[], area);
    for ((galley, color), place) in galleys.into_iter().zip(places.iter()) {
        let Some(Placed { area, leader }) = *place else { continue };
        if let Some(line) = leader {
            painter.line_segment(line, Stroke::new(1.0, t.text_weak.gamma_multiply(0.8)));
        }
        painter.rect_filled(area.expand2(vec2(2.0, -1.0)), 3.0, t.background.gamma_multiply(0.7));
        painter.galley(area.min, galley, color);
    }
}

/// Whether a series is one line without labels at its ends. Its name is then drawn at its second end.
fn is_single_line(series: &Series) -> bool {
    series.mark == Mark::Segments
        && series.points.len() == 2
        && series.points.iter().all(|p| p.label.is_empty())
}

/// Points of a line without those within a thousandth of the plot of the previous one. The difference is invisible.
fn thinned(points: &[[f64; 2]], [x, y]: [(f64, f64); 2]) -> Vec<[f64; 2]> {
    let share = |a: f64, b: f64, (low, high): (f64, f64)| (a - b).abs() / (high - low);
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for point in points {
        let is_there = |last: &[f64; 2]| share(last[0], point[0], x).max(share(last[1], point[1], y)) < 1e-3;
        if !kept.last().is_some_and(is_there) {
            kept.push(*point);
        }
    }
    kept
}

fn on_screen(chart: &Chart, transform: &PlotTransform, point: &Point) -> Pos2 {
    let pos = transform.position_from_point(&PlotPoint::new(chart.x_scale.laid_out(point.x), point.y));
    pos2(pos.x, pos.y)
}

/// The point under the pointer: one with a label, or a dot.
fn nearest<'a>(chart: &'a Chart, transform: &PlotTransform, at: Pos2) -> Option<&'a Point> {
    let dots = chart.series.iter().flat_map(|series| {
        let is_dot = series.mark == Mark::Dots;
        series.points.iter().filter(move |point| is_dot || !point.label.is_empty())
    });
    let by_distance = dots.map(|point| (on_screen(chart, transform, point).distance(at), point));
    let (distance, point) = by_distance.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (distance < REACH).then_some(point)
}

/// Draws the label and coordinates of the point under the pointer, on top of everything.
fn pointed_ui(ui: &Ui, point: &Point, at: Pos2, area: Rect, t: &Tokens) {
    let painter = ui.painter_at(area);
    let numbers = format!("{:.2}, {:.2}", point.x, point.y);
    let text = if point.label.is_empty() { numbers } else { format!("{}\n{numbers}", point.label) };
    let galley = painter.layout_no_wrap(text, FontId::proportional(12.0), t.text);
    let wish = Wish {
        dot: 0,
        size: galley.size() + vec2(8.0, 4.0),
        side: vec2(1.0, 0.0),
        is_needed: true,
        may_lead: false,
    };
    let Some(Placed { area: frame, .. }) = label_places(&[at], DOT, &[wish], &[], area)[0] else { return };
    painter.circle_stroke(at, DOT + 2.0, Stroke::new(1.5, t.text));
    painter.rect(frame, 3.0, t.raised, Stroke::new(1.0, t.line), StrokeKind::Inside);
    painter.galley(frame.min + vec2(4.0, 2.0), galley, t.text);
}

#[cfg(test)]
mod tests {
    use super::{highest_whole, round_numbers, round_to_digits, thinned};
    use shagreen_formats::figure::{Chart, Mark, Point, Scale, Series, Tone};

    /// Numbers of dimensions may be close together, values between them may not.
    #[test]
    fn an_axis_of_whole_numbers_is_known() {
        let chart = |xs: &[f64], x_scale: Scale| {
            let points = xs.iter().map(|x| Point::new(*x, 0.0)).collect();
            let series = Series { name: String::new(), mark: Mark::Line, tone: Tone::Main, points };
            Chart {
                title: String::new(),
                x_label: String::new(),
                y_label: String::new(),
                is_isotropic: false,
                x_scale,
                shown: None,
                series: vec![series],
                source: String::new(),
            }
        };
        assert_eq!(highest_whole(&chart(&[1.0, 2.0, 10.0], Scale::Linear)), Some(10.0));
        assert_eq!(highest_whole(&chart(&[1.0, 2.5], Scale::Linear)), None);
        assert_eq!(highest_whole(&chart(&[-1.0, 2.0], Scale::Linear)), None);
        assert_eq!(highest_whole(&chart(&[1.0, 10.0], Scale::Logarithmic)), None);
        assert_eq!(highest_whole(&chart(&[], Scale::Linear)), None);
    }

    #[test]
    fn an_axis_of_ratios_has_round_numbers() {
        let numbers: Vec<f64> = round_numbers((0.15, 27.0)).collect();
        assert_eq!(numbers.len(), 7);
        let shown: Vec<String> =
            numbers.iter().map(|x| format!("{}", round_to_digits(10.0_f64.powf(x.log10())))).collect();
        assert_eq!(shown, ["0.2", "0.5", "1", "2", "5", "10", "20"]);
    }

    #[test]
    fn a_line_keeps_its_ends_and_loses_what_cannot_be_seen() {
        let points = [[0.0, 0.0], [0.0, 1e-6], [0.5, 0.5], [0.5, 0.500_2], [0.5, 0.6], [1.0, 1.0]];
        let bounds = [(0.0, 1.0), (0.0, 1.0)];
        assert_eq!(thinned(&points, bounds), [[0.0, 0.0], [0.5, 0.5], [0.5, 0.6], [1.0, 1.0]]);
        assert_eq!(thinned(&[], bounds), Vec::<[f64; 2]>::new());
    }
}
