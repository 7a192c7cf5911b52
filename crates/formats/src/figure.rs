//! Figures as data: the window and the SVG, PNG and CSV exports all use these types.

mod color_map;
mod labels;
mod png;
mod svg;
mod title;

use crate::named_table::write_table;

pub use crate::figure::color_map::map_color;
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
        let Some(value) = value else { return "\u{2013}".to_owned() };
        let is_count = self.n_counts > 0 && column >= self.columns.len().saturating_sub(self.n_counts);
        let text = format!("{value:.*}", if is_count { 0 } else { self.decimals });
        // Avoids "-0.000".
        match text.strip_prefix('-') {
            Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
            _ => text,
        }
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

/// Header of a chart's CSV.
const CHART_COLUMNS: [&str; 5] = ["series", "label", "x", "y", "source"];

/// Header of a map's CSV.
const MAP_COLUMNS: [&str; 4] = ["x", "y", "value", "source"];

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
            write_table(std::iter::once(CHART_COLUMNS.map(str::to_owned).to_vec()).chain(rows))
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
            let first = MAP_COLUMNS.map(str::to_owned).to_vec();
            write_table(std::iter::once(first).chain(map.cells().map(row)))
        }
    }
}

/// Returns whether bytes are a table written by [`figure_csv`].
pub fn is_figure_csv(bytes: &[u8]) -> bool {
    let first = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let is_one = |columns: &[&str]| first == columns.join(",").as_bytes();
    is_one(&CHART_COLUMNS)
        || is_one(&MAP_COLUMNS)
        || first.starts_with(b"row,") && first.ends_with(b",source")
}

#[cfg(test)]
mod tests {
    use super::{
        Chart, Figure, Map, Mark, Point, Scale, Series, Table, Tone, figure_csv, figure_svg, is_figure_csv,
        page_svg,
    };

    fn chart() -> Chart {
        let series = |name: &str, mark: Mark, tone: Tone| Series {
            name: name.to_owned(),
            mark,
            tone,
            points: vec![Point::named(1.0, 2.0, "a, \"b\""), Point::new(3.0, -4.5)],
        };
        Chart {
            title: "A <figure>".to_owned(),
            x_label: "x".to_owned(),
            y_label: "y".to_owned(),
            is_isotropic: false,
            x_scale: Scale::Linear,
            shown: None,
            source: "simulated raters".to_owned(),
            series: vec![
                series("edges", Mark::Segments, Tone::Faint),
                series("line", Mark::Line, Tone::Second),
                series("dots", Mark::Dots, Tone::Main),
            ],
        }
    }

    fn table() -> Table {
        Table {
            title: "Correlations".to_owned(),
            columns: vec!["one".to_owned(), "two".to_owned()],
            rows: vec![("rough-smooth".to_owned(), vec![Some(-0.756_51), None])],
            decimals: 3,
            n_counts: 0,
            source: "simulated raters".to_owned(),
        }
    }

    #[test]
    fn counts_have_no_decimals() {
        let counted = Table { n_counts: 1, ..table() };
        assert_eq!(counted.shown(0, Some(12.0)), "12.000");
        assert_eq!(counted.shown(1, Some(12.0)), "12");
        assert_eq!(
            (counted.shown(1, None), table().shown(1, Some(12.0))),
            ("\u{2013}".to_owned(), "12.000".to_owned())
        );
        assert_eq!(counted.shown(0, Some(-0.000_1)), "0.000");
    }

    #[test]
    fn a_figure_is_saved_with_all_its_numbers() {
        let csv = String::from_utf8(figure_csv(&Figure::Chart(chart()))).unwrap();
        assert_eq!(csv.lines().next(), Some("series,label,x,y,source"));
        assert!(is_figure_csv(csv.as_bytes()) && !is_figure_csv(b"participant,texture\n"));
        assert_eq!(csv.lines().nth(1), Some("edges,\"a, \"\"b\"\"\",1,2,simulated raters"));
        assert_eq!(csv.lines().count(), 1 + 6);
        let csv = String::from_utf8(figure_csv(&Figure::Table(table()))).unwrap();
        assert_eq!(csv, "row,one,two,source\nrough-smooth,-0.75651,,simulated raters\n");
        assert!(is_figure_csv(csv.as_bytes()));
    }

    #[test]
    fn a_figure_is_drawn_and_names_what_it_draws() {
        let svg = figure_svg(&Figure::Chart(chart()));
        assert!(svg.contains("A &lt;figure&gt;") && svg.contains("a, &quot;b&quot;"), "{svg}");
        assert!(svg.matches("<circle").count() >= 2);
        let svg = figure_svg(&Figure::Table(table()));
        assert!(svg.contains("-0.757") && svg.contains("rough-smooth"), "{svg}");
        let page = page_svg("A page", "what it is", &[Figure::Chart(chart()), Figure::Table(table())]);
        assert!(page.contains("A page") && page.contains("-0.757") && page.contains("A &lt;figure&gt;"));
    }

    /// Every line of text of a page stands in its own figure: no title reaches the next one.
    #[test]
    fn long_titles_stand_on_several_lines() {
        let long = "rough–smooth: nested cross-validation r 0.68, p = 0.007; r 0.86 with features selected on all textures";
        let figures = [
            Figure::Chart(Chart { title: long.to_owned(), ..chart() }),
            Figure::Table(Table { title: long.to_owned(), ..table() }),
        ];
        let page = page_svg("A page", "what it is", &figures);
        let texts: Vec<&str> = page
            .split("</text>")
            .filter_map(|part| part.rsplit_once('>').map(|(_, text)| text.trim()))
            .collect();
        assert!(!texts.iter().any(|text| text.contains(long)), "{texts:?}");
        for part in ["rough–smooth: nested cross-validation", "features selected on all textures"] {
            assert_eq!(texts.iter().filter(|text| text.contains(part)).count(), 2, "{part}: {texts:?}");
        }
        assert!(texts.iter().all(|text| text.chars().count() <= 65), "{texts:?}");
    }

    #[test]
    fn a_figure_of_nothing_is_drawn_too() {
        let empty = Chart { series: Vec::new(), ..chart() };
        assert_eq!(empty.bounds(), [(0.0, 1.0); 2]);
        assert!(figure_svg(&Figure::Chart(empty)).ends_with("</svg>\n"));
        let point = Series { points: vec![Point::new(2.0, 2.0)], ..chart().series[0].clone() };
        let one = Chart { series: vec![point], ..chart() };
        assert_eq!(one.bounds(), [(1.5, 2.5); 2]);
        assert!(figure_svg(&Figure::Chart(one)).ends_with("</svg>\n"));
        assert!(figure_svg(&Figure::Table(Table { rows: Vec::new(), ..table() })).ends_with("</svg>\n"));
    }

    #[test]
    fn a_logarithmic_axis_gives_decades_the_same_room() {
        let dots = Series {
            name: String::new(),
            mark: Mark::Dots,
            tone: Tone::Main,
            points: [10.0, 100.0, 1000.0].map(|x| Point::new(x, 1.0)).to_vec(),
        };
        let chart = Chart {
            x_scale: Scale::Logarithmic,
            shown: Some([(5.0, 2000.0), (0.0, 2.0)]),
            series: vec![dots],
            ..chart()
        };
        assert_eq!(chart.bounds()[0], (5.0, 2000.0));
        let svg = figure_svg(&Figure::Chart(chart));
        let circles = svg.split("<circle cx=\"").skip(1);
        let at: Vec<f64> = circles.map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect();
        assert_eq!(at.len(), 3, "{svg}");
        assert!((at[1] - at[0] - (at[2] - at[1])).abs() <= 1.0, "{at:?}");
    }

    #[test]
    fn a_map_is_drawn_and_saved_cell_by_cell() {
        let map = Map {
            title: "Spectrogram".to_owned(),
            x_label: "time in s".to_owned(),
            y_label: "frequency in Hz".to_owned(),
            value_label: "density".to_owned(),
            value_unit: "dB".to_owned(),
            x: (-2.0, 0.0),
            y: (0.0, 100.0),
            range: (-60.0, 0.0),
            rows: vec![vec![-60.0, -60.0, 0.0, -30.0], vec![-90.0, 10.0, -30.0, -30.0]],
            source: String::new(),
        };
        assert_eq!((map.share(-90.0), map.share(-30.0), map.share(10.0)), (0.0, 0.5, 1.0));
        let figure = Figure::Map(map);
        let csv = String::from_utf8(figure_csv(&figure)).unwrap();
        assert!(is_figure_csv(csv.as_bytes()));
        assert_eq!(csv.lines().nth(1), Some("-1.75,25,-60,"));
        assert_eq!(csv.lines().last(), Some("-0.25,75,-30,"));
        let svg = figure_svg(&figure);
        assert!(svg.contains("Spectrogram") && svg.contains("density"), "{svg}");
        // The values below and above the range take its end colors.
        assert!(svg.contains("#00224E") && svg.contains("#FEE838"), "{svg}");
    }
}
