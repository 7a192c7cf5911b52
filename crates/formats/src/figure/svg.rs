//! SVG export of figures, singly or as a page.

use plotters::chart::{ChartBuilder, ChartContext, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::coord::combinators::IntoLogRange as _;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::{Circle, DashedPathElement, EmptyElement, PathElement, Rectangle, Text};
use plotters::prelude::{
    Cartesian2d, DrawingArea, IntoDrawingArea as _, IntoFont as _, RGBColor, SVGBackend, TextStyle,
};
use plotters::style::Color as _;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::figure::color_map::map_color;
use crate::figure::labels::offsets;
use crate::figure::title;
use crate::figure::{Chart, Figure, Map, Mark, Point, Scale, Series, Table, Tone};

/// Size of a single figure, in pixels.
const SIZE: (u32, u32) = (760, 620);
/// Size of a figure on a page, in pixels.
const PANEL: (u32, u32) = (600, 500);
/// Figures per row of a page.
const COLUMNS: usize = 2;
/// Height of the page header, in pixels.
const HEAD: u32 = 100;
/// Distance of a title from the border of its figure, in pixels.
const MARGIN: u32 = 16;
/// Distance between the lines of a title, in pixels.
const TITLE_LINE: u32 = 20;
/// Height of a table row, in pixels.
const ROW: i32 = 24;
/// Length of a dash and of the gap after it, in pixels.
const DASH: (i32, i32) = (6, 4);
/// Colors of a map: finer steps are indistinguishable, and adjacent cells of equal color form one rectangle.
const N_COLORS: u32 = 64;

const INK: RGBColor = RGBColor(0x22, 0x2B, 0x2F);
const FAINT: RGBColor = RGBColor(0xDD, 0xE2, 0xE4);
const WEAK: RGBColor = RGBColor(0x6B, 0x77, 0x7D);

type Page<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Renders a single figure as SVG.
pub fn figure_svg(figure: &Figure) -> String {
    drawn(SIZE, |page| panel(page, figure))
}

/// Renders figures on one page, under a title and a subtitle that states their data source; `"; "` separates its lines.
pub fn page_svg(title: &str, subtitle: &str, figures: &[Figure]) -> String {
    let n_rows = figures.len().div_ceil(COLUMNS);
    let size = (COLUMNS as u32 * PANEL.0, HEAD + n_rows as u32 * PANEL.1);
    drawn(size, |page| {
        let (head, rest) = page.split_vertically(HEAD);
        head.draw_text(title, &text(26.0, INK), (28, 16))?;
        for (line, part) in (0..).zip(subtitle.split("; ")) {
            head.draw_text(part, &text(14.0, WEAK), (28, 52 + 18 * line))?;
        }
        for (area, figure) in rest.split_evenly((n_rows, COLUMNS)).iter().zip(figures) {
            panel(area, figure)?;
        }
        Ok(())
    })
}

fn drawn(size: (u32, u32), draw: impl FnOnce(&Page<'_>) -> Drawn) -> String {
    let mut svg = String::new();
    {
        let page = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let done =
            page.fill(&plotters::style::WHITE).and_then(|()| draw(&page)).and_then(|()| page.present());
        // Writing to a string cannot fail, and every range consists of distinct finite numbers.
        assert!(done.is_ok(), "cannot draw the figure: {done:?}");
    }
    svg
}

fn panel(page: &Page<'_>, figure: &Figure) -> Drawn {
    match figure {
        Figure::Chart(chart) => draw_chart(page, chart, &figure.title()),
        Figure::Table(table) => draw_table(page, table, &figure.title()),
        Figure::Map(map) => draw_map(page, map, &figure.title()),
    }
}

fn text(size: f64, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&color)
}

fn color(tone: Tone) -> RGBColor {
    match tone {
        Tone::Main => RGBColor(0x0B, 0x7A, 0x63),
        Tone::Second => RGBColor(0xC0, 0x4A, 0x1B),
        Tone::Third => RGBColor(0x16, 0x6C, 0xAB),
        Tone::Fourth => RGBColor(0xA3, 0x3C, 0x78),
        Tone::Fifth => RGBColor(0x5E, 0x2A, 0x06),
        Tone::Sixth => RGBColor(0x16, 0x16, 0x8A),
        Tone::Seventh => RGBColor(0x2F, 0x5B, 0xE6),
        Tone::Eighth => RGBColor(0xC4, 0x18, 0x4A),
        Tone::Limit => INK,
        Tone::Faint => RGBColor(0xB4, 0xBE, 0xC2),
    }
}

/// Draws all lines of a title but the last, centered. Returns the area below them, and the last line: its caption.
fn titled<'a>(
    page: &Page<'a>,
    title: &str,
) -> Result<(Page<'a>, String), DrawingAreaErrorKind<std::io::Error>> {
    let width = page.dim_in_pixel().0;
    let mut lines = title::lines(title, f64::from(width.saturating_sub(2 * MARGIN)));
    let caption = lines.pop().unwrap_or_default();
    let style = text(16.0, INK).pos(Pos::new(HPos::Center, VPos::Top));
    let mut down = 0;
    for line in &lines {
        // A caption has this distance from the margin above it.
        let top = MARGIN + 5 + down;
        page.draw_text(line, &style, ((width / 2).cast_signed(), top.cast_signed()))?;
        down += TITLE_LINE;
    }
    Ok((page.split_vertically(down).1, caption))
}

fn draw_chart(page: &Page<'_>, chart: &Chart, title: &str) -> Drawn {
    let (page, caption) = titled(page, title)?;
    let page = &page;
    let [mut x, mut y] = chart.bounds();
    let (width, height) = page.dim_in_pixel();
    let inner =
        (f64::from(width.saturating_sub(96)).max(1.0), f64::from(height.saturating_sub(104)).max(1.0));
    if chart.is_isotropic {
        let unit = ((x.1 - x.0) / inner.0).max((y.1 - y.0) / inner.1);
        let widened = |(low, high): (f64, f64), length: f64| {
            let middle = 0.5 * (low + high);
            (middle - 0.5 * length, middle + 0.5 * length)
        };
        (x, y) = (widened(x, unit * inner.0), widened(y, unit * inner.1));
    }
    let mut builder = ChartBuilder::on(page);
    builder.margin(MARGIN).caption(caption, text(16.0, INK)).x_label_area_size(42).y_label_area_size(52);
    match chart.x_scale {
        Scale::Linear => draw_series(page, builder.build_cartesian_2d(x.0..x.1, y.0..y.1)?, chart),
        Scale::Logarithmic => {
            draw_series(page, builder.build_cartesian_2d((x.0..x.1).log_scale(), y.0..y.1)?, chart)
        }
    }
}

/// Draws the series, labels and legend of a chart.
fn draw_series<'a, X: Ranged<ValueType = f64> + ValueFormatter<f64>>(
    page: &Page<'_>,
    mut context: ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, RangedCoordf64>>,
    chart: &Chart,
) -> Drawn {
    let (width, height) = page.dim_in_pixel();
    context
        .configure_mesh()
        .light_line_style(plotters::style::WHITE)
        .bold_line_style(FAINT)
        .axis_style(WEAK)
        .label_style(text(12.0, INK))
        .x_desc(&chart.x_label)
        .y_desc(&chart.y_label)
        .x_labels(6)
        .y_labels(6)
        .draw()?;
    for series in &chart.series {
        let tone = color(series.tone);
        let points: Vec<(f64, f64)> = series.points.iter().map(|p| (p.x, p.y)).collect();
        match series.mark {
            Mark::Line => {
                let line = PathElement::new(points, tone.stroke_width(2));
                context
                    .draw_series([line])?
                    .label(&series.name)
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 14, y)], tone.stroke_width(2)));
            }
            Mark::DashedLine => {
                let dashed = DashedPathElement::new(points, DASH.0, DASH.1, tone.stroke_width(2));
                context.draw_series([dashed])?.label(&series.name).legend(move |(x, y)| {
                    DashedPathElement::new([(x, y), (x + 14, y)], DASH.0, DASH.1, tone.stroke_width(2))
                });
            }
            Mark::Segments => {
                let width = if series.tone == Tone::Faint { 1 } else { 2 };
                let ends = points.as_chunks::<2>().0.iter();
                let lines = ends.map(|pair| PathElement::new(pair.to_vec(), tone.stroke_width(width)));
                context
                    .draw_series(lines)?
                    .label(&series.name)
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 14, y)], tone.stroke_width(width)));
            }
            Mark::Dots => {
                let dots = points.iter().map(|point| Circle::new(*point, 4, tone.filled()));
                context
                    .draw_series(dots)?
                    .label(&series.name)
                    .legend(move |(x, y)| Circle::new((x + 7, y), 4, tone.filled()));
            }
        }
    }
    let (left, top) = page.get_base_pixel();
    let pixel = |point: &Point| {
        let (x, y) = context.backend_coord(&(point.x, point.y));
        (f64::from(x - left), f64::from(y - top))
    };
    let all = || chart.series.iter().flat_map(|s| s.points.iter().map(move |point| (s, point)));
    let labeled: Vec<(&Series, &Point)> = all().filter(|(_, point)| !point.label.is_empty()).collect();
    let words: Vec<(&str, (f64, f64))> =
        labeled.iter().map(|(_, point)| (point.label.as_str(), pixel(point))).collect();
    let dots: Vec<(f64, f64)> =
        all().filter(|(s, _)| s.mark == Mark::Dots).map(|(_, point)| pixel(point)).collect();
    let offsets = offsets(&words, &dots, (f64::from(width), f64::from(height)));
    let corner = free_corner(&dots, (f64::from(width), f64::from(height)));
    context.draw_series(labeled.iter().zip(offsets).map(|((series, point), offset)| {
        let tone = if series.mark == Mark::Dots { WEAK } else { color(series.tone) };
        EmptyElement::at((point.x, point.y)) + Text::new(point.label.clone(), offset, text(11.0, tone))
    }))?;
    if chart.series.len() > 1 {
        context
            .configure_series_labels()
            .position(corner)
            .background_style(plotters::style::WHITE.mix(0.8))
            .border_style(FAINT)
            .label_font(text(12.0, INK))
            .draw()?;
    }
    Ok(())
}

/// Draws a map: a rectangle per run of cells of equal color, and a color scale at the right.
fn draw_map(page: &Page<'_>, map: &Map, title: &str) -> Drawn {
    let (page, key) = page.split_horizontally(page.dim_in_pixel().0.saturating_sub(96));
    let (page, caption) = titled(&page, title)?;
    let mut context = ChartBuilder::on(&page)
        .margin(MARGIN)
        .caption(caption, text(16.0, INK))
        .x_label_area_size(42)
        .y_label_area_size(52)
        .build_cartesian_2d(map.x.0..map.x.1, map.y.0..map.y.1)?;
    context
        .configure_mesh()
        .disable_mesh()
        .axis_style(WEAK)
        .label_style(text(12.0, INK))
        .x_desc(&map.x_label)
        .y_desc(&map.y_label)
        .x_labels(6)
        .y_labels(6)
        .draw()?;
    let at = |(low, high): (f64, f64), i: usize, n: usize| low + (high - low) * i as f64 / n as f64;
    for (i, row) in map.rows.iter().enumerate() {
        let (bottom, top) = (at(map.y, i, map.rows.len()), at(map.y, i + 1, map.rows.len()));
        let shades: Vec<u32> = row.iter().map(|value| shade(map.share(*value))).collect();
        let mut begin = 0;
        for run in shades.chunk_by(|a, b| a == b) {
            let end = begin + run.len();
            let corners = [(at(map.x, begin, row.len()), top), (at(map.x, end, row.len()), bottom)];
            context.draw_series([Rectangle::new(corners, shade_color(run[0]).filled())])?;
            begin = end;
        }
    }
    let (top, height) = (60, key.dim_in_pixel().1.cast_signed() - 160);
    for step in 0..N_COLORS {
        let edge = |step: u32| top + height - (height * step.cast_signed()) / N_COLORS.cast_signed();
        let corners = [(8, edge(step + 1)), (26, edge(step))];
        key.draw(&Rectangle::new(corners, shade_color(step).filled()))?;
    }
    for (value, y) in [(map.range.1, top), (map.range.0, top + height - 12)] {
        key.draw_text(&format!("{value}"), &text(12.0, INK), (32, y))?;
    }
    for (line, part) in (0..).zip([&map.value_label, &map.value_unit]) {
        key.draw_text(part, &text(12.0, WEAK), (8, top + height + 8 + 16 * line))?;
    }
    Ok(())
}

/// Index of the map color for a fraction of the range.
fn shade(share: f64) -> u32 {
    (share * f64::from(N_COLORS - 1)).round() as u32
}

fn shade_color(shade: u32) -> RGBColor {
    let [red, green, blue] = map_color(shade as f32 / (N_COLORS - 1) as f32);
    RGBColor(red, green, blue)
}

/// Returns the corner with the fewest points, for the legend.
fn free_corner(points: &[(f64, f64)], (width, height): (f64, f64)) -> SeriesLabelPosition {
    let n_near = |right: bool, bottom: bool| {
        let near = |x: f64, length: f64, far: bool| if far { x > 0.62 * length } else { x < 0.42 * length };
        points.iter().filter(|(x, y)| near(*x, width, right) && near(*y, height, bottom)).count()
    };
    let corners = [
        (n_near(true, false), SeriesLabelPosition::UpperRight),
        (n_near(false, false), SeriesLabelPosition::UpperLeft),
        (n_near(true, true), SeriesLabelPosition::LowerRight),
        (n_near(false, true), SeriesLabelPosition::LowerLeft),
    ];
    corners.into_iter().min_by_key(|(n, _)| *n).map_or(SeriesLabelPosition::UpperRight, |(_, corner)| corner)
}

fn draw_table(page: &Page<'_>, table: &Table, title: &str) -> Drawn {
    let width = page.dim_in_pixel().0.cast_signed();
    let lines = title::lines(title, f64::from(width - 56));
    for (top, line) in (16..).step_by(TITLE_LINE as usize).zip(&lines) {
        page.draw_text(line, &text(16.0, INK), (28, top))?;
    }
    let (_, page) = page.split_vertically(TITLE_LINE * lines.len().saturating_sub(1) as u32);
    let n_columns = i32::try_from(table.columns.len().max(1)).unwrap_or(i32::MAX);
    let first = (width / 3).min(220);
    let step = ((width - first - 56) / n_columns).clamp(24, 120);
    let rights = || (1..).map(|column| 28 + first + step * column);
    let at_right = |size: f64, tone: RGBColor| text(size, tone).pos(Pos::new(HPos::Right, VPos::Top));
    for (right, name) in rights().zip(&table.columns) {
        // A column name is split at hyphens, so the two poles of an attribute stand on two lines.
        for (line, pole) in (0..).zip(name.split_inclusive('-')) {
            page.draw_text(pole, &at_right(12.0, WEAK), (right, 44 + 14 * line))?;
        }
    }
    for (row, (name, values)) in (1..).zip(&table.rows) {
        let top = 60 + ROW * row;
        page.draw_text(name, &text(13.0, INK), (28, top))?;
        for (column, (right, value)) in rights().zip(values).enumerate() {
            page.draw_text(&table.shown(column, *value), &at_right(13.0, INK), (right, top))?;
        }
    }
    Ok(())
}
