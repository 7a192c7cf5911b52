//! Figures as data: the window and the SVG, PNG and CSV exports all use these types.

mod color_map;
mod compared;
mod labels;
mod png;
mod svg;
mod title;

use crate::named_table::write_table;

pub use crate::figure::color_map::map_color;
pub use crate::figure::compared::compared_line;
pub use crate::figure::png::{PngError, figure_png};
pub use crate::figure::svg::{figure_svg, page_svg};

/// A figure of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Figure {
    /// Points and lines over two axes.
    Chart(Chart),
    /// A table of numbers.
    Table(Table),
    /// A scalar field over two axes, color coded.
    Map(Map),
}

/// Points and lines over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// One-line title.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub x_label: String,
    /// Name and unit of the vertical axis.
    pub y_label: String,
    /// Whether one unit has the same length on both axes.
    pub is_isotropic: bool,
    /// Scale of the horizontal axis; points store unscaled coordinates in either case.
    pub x_scale: Scale,
    /// Range of the axes, horizontal then vertical; `None` fits them to the points.
    pub shown: Option<[(f64, f64); 2]>,
    /// The series, drawn in this order.
    pub series: Vec<Series>,
    /// Source of the data, shown with the figure and saved with every number; may be empty.
    pub source: String,
}

/// The scale of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances for equal differences.
    #[default]
    Linear,
    /// Equal distances for equal ratios; all coordinates are positive.
    Logarithmic,
}

impl Scale {
    /// Position of a coordinate along the axis, in arbitrary units of length.
    pub fn laid_out(self, coordinate: f64) -> f64 {
        match self {
            Self::Linear => coordinate,
            Self::Logarithmic => coordinate.log10(),
        }
    }

    /// Coordinate at a position along the axis; the inverse of [`Scale::laid_out`].
    pub fn coordinate(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Logarithmic => 10.0_f64.powf(place),
        }
    }
}

/// A series of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend and in the file.
    pub name: String,
    /// How the points are drawn.
    pub mark: Mark,
    /// Role that selects the color.
    pub tone: Tone,
    /// The points; all coordinates are finite.
    pub points: Vec<Point>,
}

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A dot per point, with its label next to it.
    Dots,
    /// A line through all points.
    Line,
    /// A dashed line through all points.
    DashedLine,
    /// A line from each point of even index to the next, with the label of the second at its end.
    Segments,
}

/// The role of a series in its figure, which selects its color.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// The main quantity of the figure.
    Main,
    /// The reference that the main quantity is compared with.
    Second,
    /// A third quantity.
    Third,
    /// A fourth quantity.
    Fourth,
    /// A fifth quantity.
    Fifth,
    /// A sixth quantity.
    Sixth,
    /// A seventh quantity.
    Seventh,
    /// An eighth quantity.
    Eighth,
    /// A limit.
    Limit,
    /// An auxiliary line.
    Faint,
}

/// A point of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Horizontal coordinate.
    pub x: f64,
    /// Vertical coordinate.
    pub y: f64,
    /// Label; may be empty.
    pub label: String,
}

/// A table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// One-line title.
    pub title: String,
    /// Column names, without the row-name column.
    pub columns: Vec<String>,
    /// Name and numbers of each row; `None` marks a missing number.
    pub rows: Vec<(String, Vec<Option<f64>>)>,
    /// Number of significant decimals.
    pub decimals: usize,
    /// Number of last columns that are counts, shown without decimals.
    pub n_counts: usize,
    /// Source of the data, see [`Chart::source`].
    pub source: String,
}

/// A scalar field over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// One-line title.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub x_label: String,
    /// Name and unit of the vertical axis.
    pub y_label: String,
    /// Name of the quantity.
    pub value_label: String,
    /// Unit of the quantity.
    pub value_unit: String,
    /// Start of the first column and end of the last.
    pub x: (f64, f64),
    /// Start of the first row and end of the last.
    pub y: (f64, f64),
    /// Values that map to the first and last color.
    pub range: (f64, f64),
    /// Values, row by row from the lowest; all rows have the same length.
    pub rows: Vec<Vec<f64>>,
    /// Source of the data, see [`Chart::source`].
    pub source: String,
}

impl Map {
    /// Returns a value as a fraction of the color range, clamped to 0..1.
    pub fn share(&self, value: f64) -> f64 {
        ((value - self.range.0) / (self.range.1 - self.range.0)).clamp(0.0, 1.0)
    }

    /// Returns `(x, y, value)` for the center of each cell, row by row.
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let middle =
            |(low, high): (f64, f64), i: usize, n: usize| low + (i as f64 + 0.5) * (high - low) / n as f64;
        self.rows.iter().enumerate().flat_map(move |(i, row)| {
            let y = middle(self.y, i, self.rows.len());
            row.iter().enumerate().map(move |(j, value)| (middle(self.x, j, row.len()), y, *value))
        })
    }
}

impl Point {
    /// A point without a label.
    pub fn new(x: f64, y: f64) -> Self {
        Self::named(x, y, "")
    }

    /// A labeled point.
    pub fn named(x: f64, y: f64, label: impl Into<String>) -> Self {
        Self { x, y, label: label.into() }
    }
}

impl Figure {
    /// Returns the title, with the data source in parentheses.
    pub fn title(&self) -> String {
        let (title, source) = match self {
            Self::Chart(chart) => (&chart.title, &chart.source),
            Self::Table(table) => (&table.title, &table.source),
            Self::Map(map) => (&map.title, &map.source),
        };
        if source.is_empty() { title.clone() } else { format!("{title} ({source})") }
    }

    /// Sets the data source.
    pub fn set_source(&mut self, source: &str) {
        match self {
            Self::Chart(chart) => source.clone_into(&mut chart.source),
            Self::Table(table) => source.clone_into(&mut table.source),
            Self::Map(map) => source.clone_into(&mut map.source),
        }
    }
}

impl Table {
    /// Formats a number of a column with [`Table::decimals`] decimals, or without if the column has counts; a missing number is
    /// an en dash.
    pub fn shown(&self, column: usize, value: Option<f64>) -> String {
        let is_count = self.n_counts > 0 && column >= self.columns.len().saturating_sub(self.n_counts);
        shown_number(value, if is_count { 0 } else { self.decimals })
    }
}

/// Formats a number with this number of decimals, never as a negative zero; a missing number is an en dash.
pub(crate) fn shown_number(value: Option<f64>, n_decimals: usize) -> String {
    let Some(value) = value else { return "\u{2013}".to_owned() };
    let text = format!("{value:.n_decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        _ => text,
    }
}

impl Chart {
    /// Returns the axis ranges, horizontal then vertical: [`Chart::shown`], or the extent of all points plus a margin.
    /// A chart without points spans 0 to 1.
    pub fn bounds(&self) -> [(f64, f64); 2] {
        if let Some(shown) = self.shown {
            return shown;
        }
        let of = |coordinate: &dyn Fn(&Point) -> f64| {
            let points = self.series.iter().flat_map(|series| &series.points).map(coordinate);
            let (low, high) =
                points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            if low > high {
                return (0.0, 1.0);
            }
            let room = if high > low { 0.06 * (high - low) } else { 0.5 };
            (low - room, high + room)
        };
        let (low, high) = of(&|p| self.x_scale.laid_out(p.x));
        [(self.x_scale.coordinate(low), self.x_scale.coordinate(high)), of(&|p| p.y)]
    }
}

/// Headers of charts and maps without the names of the axes, as they were written before; such files may be replaced.
const BARE_COLUMNS: [&str; 2] = ["series,label,x,y,source", "x,y,value,source"];

/// Header of a chart's CSV: the names and units of both axes.
fn chart_columns(chart: &Chart) -> Vec<String> {
    let axes = [format!("x: {}", chart.x_label), format!("y: {}", chart.y_label)];
    let first = ["series", "label"].map(str::to_owned).into_iter();
    first.chain(axes).chain(["source".to_owned()]).collect()
}

/// Header of a map's CSV: the names and units of both axes and of the values.
fn map_columns(map: &Map) -> Vec<String> {
    let unit = if map.value_unit.is_empty() { String::new() } else { format!(" in {}", map.value_unit) };
    let value = format!("value: {}{unit}", map.value_label);
    vec![format!("x: {}", map.x_label), format!("y: {}", map.y_label), value, "source".to_owned()]
}

/// Writes the numbers of a figure as CSV: one point per line for a chart, one row per line for a table, one cell per
/// line for a map.
pub fn figure_csv(figure: &Figure) -> Vec<u8> {
    match figure {
        Figure::Chart(chart) => {
            let rows = chart.series.iter().flat_map(|series| {
                series.points.iter().map(|Point { x, y, label }| {
                    let source = chart.source.clone();
                    vec![series.name.clone(), label.clone(), format!("{x}"), format!("{y}"), source]
                })
            });
            write_table(std::iter::once(chart_columns(chart)).chain(rows))
        }
        Figure::Table(table) => {
            let first = std::iter::once("row".to_owned()).chain(table.columns.iter().cloned());
            let first = first.chain(["source".to_owned()]);
            let rows = table.rows.iter().map(|(name, values)| {
                let shown = values.iter().map(|v| v.map_or_else(String::new, |value| format!("{value}")));
                std::iter::once(name.clone()).chain(shown).chain([table.source.clone()]).collect()
            });
            write_table(std::iter::once(first.collect()).chain(rows))
        }
        Figure::Map(map) => {
            let row = |(x, y, value): (f64, f64, f64)| {
                vec![format!("{x}"), format!("{y}"), format!("{value}"), map.source.clone()]
            };
            write_table(std::iter::once(map_columns(map)).chain(map.cells().map(row)))
        }
    }
}

/// Returns whether bytes are a table written by [`figure_csv`].
pub fn is_figure_csv(bytes: &[u8]) -> bool {
    let first = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    // A name with a comma is in quotation marks.
    let begins: [&[u8]; 5] = [b"row,", b"series,label,x: ", b"series,label,\"x: ", b"x: ", b"\"x: "];
    BARE_COLUMNS.iter().any(|columns| first == columns.as_bytes())
        || begins.iter().any(|begin| first.starts_with(begin)) && first.ends_with(b",source")
}

#[cfg(test)]
mod tests;
