//! Figures as data: what is drawn in the window and what is saved as SVG or CSV is one and the same.

mod labels;
mod svg;

use crate::named_table::write_table;

pub use crate::figure::svg::{figure_svg, page_svg};

/// A figure of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Figure {
    /// Points and lines over two axes.
    Chart(Chart),
    /// Numbers by row and column.
    Table(Table),
}

/// Points and lines over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows, in a line.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub x_label: String,
    /// Name and unit of the vertical axis.
    pub y_label: String,
    /// Whether a unit is as long on both axes.
    pub is_isotropic: bool,
    /// What is drawn, the last on top.
    pub series: Vec<Series>,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend and in the file.
    pub name: String,
    /// How they are drawn.
    pub mark: Mark,
    /// In which color.
    pub tone: Tone,
    /// The points, of finite coordinates.
    pub points: Vec<Point>,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A dot each, with its label beside it.
    Dots,
    /// A line through all.
    Line,
    /// A line from each point of even index to the next, whose label stands at its end.
    Segments,
}

/// The part that a series plays, which decides its color.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// What the figure is about.
    Main,
    /// What it is compared with.
    Second,
    /// A third thing.
    Third,
    /// What only helps reading.
    Faint,
}

/// A point of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Horizontal coordinate.
    pub x: f64,
    /// Vertical coordinate.
    pub y: f64,
    /// What it is; empty where that needs no saying.
    pub label: String,
}

/// Numbers by row and column.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What it shows, in a line.
    pub title: String,
    /// Names of the columns after the first.
    pub columns: Vec<String>,
    /// Name of each row, and its numbers; `None` where there is none.
    pub rows: Vec<(String, Vec<Option<f64>>)>,
    /// Decimals that mean something.
    pub decimals: usize,
}

impl Point {
    /// A point without a label.
    pub fn new(x: f64, y: f64) -> Self {
        Self::named(x, y, "")
    }

    /// A point that says what it is.
    pub fn named(x: f64, y: f64, label: impl Into<String>) -> Self {
        Self { x, y, label: label.into() }
    }
}

impl Figure {
    /// What it shows, in a line.
    pub fn title(&self) -> &str {
        match self {
            Self::Chart(chart) => &chart.title,
            Self::Table(table) => &table.title,
        }
    }
}

impl Table {
    /// A number as it is shown.
    pub fn shown(&self, value: Option<f64>) -> String {
        value.map_or_else(|| "\u{2013}".to_owned(), |value| format!("{value:.*}", self.decimals))
    }
}

impl Chart {
    /// Lowest and highest coordinate of all points, horizontal then vertical, with some room around; 0 to 1 where there
    /// are none.
    pub fn bounds(&self) -> [(f64, f64); 2] {
        let of = |coordinate: fn(&Point) -> f64| {
            let points = self.series.iter().flat_map(|series| &series.points).map(coordinate);
            let (low, high) =
                points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            if low > high {
                return (0.0, 1.0);
            }
            let room = if high > low { 0.06 * (high - low) } else { 0.5 };
            (low - room, high + room)
        };
        [of(|p| p.x), of(|p| p.y)]
    }
}

/// The first line of a chart's table.
const CHART_COLUMNS: [&str; 4] = ["series", "label", "x", "y"];

/// The numbers of a figure as CSV: of a chart one point a line, of a table its own rows.
pub fn figure_csv(figure: &Figure) -> Vec<u8> {
    match figure {
        Figure::Chart(chart) => {
            let rows = chart.series.iter().flat_map(|series| {
                series.points.iter().map(|Point { x, y, label }| {
                    vec![series.name.clone(), label.clone(), format!("{x}"), format!("{y}")]
                })
            });
            write_table(std::iter::once(CHART_COLUMNS.map(str::to_owned).to_vec()).chain(rows))
        }
        Figure::Table(table) => {
            let first = std::iter::once(String::new()).chain(table.columns.iter().cloned());
            let rows = table.rows.iter().map(|(name, values)| {
                let shown = values.iter().map(|v| v.map_or_else(String::new, |value| format!("{value}")));
                std::iter::once(name.clone()).chain(shown).collect()
            });
            write_table(std::iter::once(first.collect()).chain(rows))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Chart, Figure, Mark, Point, Series, Table, Tone, figure_csv, figure_svg, page_svg};

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
        }
    }

    #[test]
    fn a_figure_is_saved_with_all_its_numbers() {
        let csv = String::from_utf8(figure_csv(&Figure::Chart(chart()))).unwrap();
        assert_eq!(csv.lines().next(), Some("series,label,x,y"));
        assert_eq!(csv.lines().nth(1), Some("edges,\"a, \"\"b\"\"\",1,2"));
        assert_eq!(csv.lines().count(), 1 + 6);
        let csv = String::from_utf8(figure_csv(&Figure::Table(table()))).unwrap();
        assert_eq!(csv, ",one,two\nrough-smooth,-0.75651,\n");
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
}
