//! One quantity that participants judged under several conditions: means with confidence intervals, and their comparison.

use serde_json::{Value, json};
use shagreen_core::people::ratings::Average;
use shagreen_core::people::study::analysis::Cells;
use shagreen_formats::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};

use super::comparison::ConditionComparison;

/// A quantity under conditions.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Name of the quantity.
    pub name: String,
    /// Unit or range of its values, in words.
    pub unit: String,
    /// Values: participants × conditions.
    pub cells: Cells,
    /// Mean over the participants under each condition, with its 95 % confidence interval; without one if all values are equal.
    pub averages: Vec<Average>,
    /// Tests of whether the conditions differ, or why there are none.
    pub comparison: Result<ConditionComparison, String>,
}

/// Decimals of means in tables.
const DECIMALS: usize = 2;

impl Measure {
    /// Means and tests of these cells.
    pub fn of(name: impl Into<String>, unit: impl Into<String>, cells: Cells) -> Self {
        let comparison = ConditionComparison::of(&cells).map_err(|error| error.to_string());
        let averages = cells.averages().into_iter().map(with_estimated_interval).collect();
        Self { name: name.into(), unit: unit.into(), averages, cells, comparison }
    }

    /// Whether the conditions differ, in one sentence that begins with the name.
    pub(super) fn finding(&self) -> String {
        match &self.comparison {
            Ok(comparison) => format!("{}: {}", self.name, comparison.sentence()),
            Err(reason) => format!("{}: there is no comparison, because {reason}.", self.name),
        }
    }

    /// Means and tests as JSON.
    pub(super) fn json(&self) -> Value {
        let condition = |(name, average): (&String, &Average)| {
            json!({
                "condition": name,
                "n": average.n_raters,
                "mean": average.mean,
                "standard_error": average.standard_error,
                "half_width_95": average.half_width,
            })
        };
        json!({
            "name": self.name,
            "unit": self.unit,
            "n_values": self.cells.n_values(),
            "means": self.cells.columns.iter().zip(&self.averages).map(condition).collect::<Vec<_>>(),
            "comparison": self.comparison.as_ref().ok().map(|comparison| comparison.json(&self.cells.columns)),
            "why_no_comparison": self.comparison.as_ref().err(),
        })
    }

    /// Table and chart of the means, named after the quantity.
    pub(super) fn figures(&self) -> Vec<(String, Figure)> {
        vec![
            (format!("{} table", self.name), Figure::Table(self.table())),
            (format!("{} means", self.name), Figure::Chart(self.chart())),
        ]
    }

    fn table(&self) -> Table {
        let row = |(name, average): (&String, &Average)| {
            (name.clone(), vec![average.mean, average.half_width, Some(average.n_raters as f64)])
        };
        Table {
            title: format!("{}: mean, and half width of the 95 % confidence interval", self.name),
            columns: ["mean", "±", "n"].map(str::to_owned).to_vec(),
            rows: self.cells.columns.iter().zip(&self.averages).map(row).collect(),
            decimals: DECIMALS,
            n_counts: 1,
            source: String::new(),
        }
    }

    /// A dot for each condition in its order, with its confidence interval as a line.
    fn chart(&self) -> Chart {
        let (mut dots, mut intervals) = (Vec::new(), Vec::new());
        for (index, (name, average)) in self.cells.columns.iter().zip(&self.averages).enumerate() {
            let Some(mean) = average.mean else { continue };
            let x = (index + 1) as f64;
            dots.push(Point::named(x, mean, name));
            if let Some(half_width) = average.half_width {
                intervals.extend([Point::new(x, mean - half_width), Point::new(x, mean + half_width)]);
            }
        }
        let series = |name: &str, mark, tone, points| Series { name: name.to_owned(), mark, tone, points };
        Chart {
            title: self.name.clone(),
            x_label: "condition, in the order of the plan".to_owned(),
            y_label: format!("mean ({})", self.unit),
            is_isotropic: false,
            x_scale: Scale::Linear,
            shown: None,
            series: vec![
                series("95 % confidence interval", Mark::Segments, Tone::Faint, intervals),
                series("mean", Mark::Dots, Tone::Main, dots),
            ],
            source: String::new(),
        }
    }
}

/// The average, without its interval if this has no width.
///
/// Student's t takes the spread of the population from that of the values. If they are all equal, as grades at an end of their
/// scale often are, an interval of no width would state a certainty that nobody measured.
fn with_estimated_interval(average: Average) -> Average {
    match average.half_width {
        Some(half_width) if half_width > 0.0 => average,
        _ => Average { standard_error: None, half_width: None, ..average },
    }
}
