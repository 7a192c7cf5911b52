//! Figures of reproductions.

use shagreen_formats::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone, compared_line};
use shagreen_formats::prediction_report::{Prediction, PredictionFigure, prediction_figure};

use crate::method_predictions::MethodPredictions;

/// A series of points.
pub(super) fn series(name: impl Into<String>, mark: Mark, tone: Tone, points: Vec<Point>) -> Series {
    Series { name: name.into(), mark, tone, points }
}

/// A line through points with these coordinates; values that are not finite are left out.
pub(super) fn line(
    name: impl Into<String>,
    tone: Tone,
    points: impl IntoIterator<Item = (f64, f64)>,
) -> Series {
    let finite = points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite());
    series(name, Mark::Line, tone, finite.map(|(x, y)| Point::new(x, y)).collect())
}

/// As [`line`], for the line with this index among lines that are compared.
pub(super) fn compared(
    name: impl Into<String>,
    index: usize,
    points: impl IntoIterator<Item = (f64, f64)>,
) -> Series {
    let (mark, tone) = compared_line(index);
    Series { mark, ..line(name, tone, points) }
}

/// A chart that fits its points. `source` is what the numbers come from.
pub(super) fn chart(
    title: impl Into<String>,
    [x_label, y_label]: [&str; 2],
    x_scale: Scale,
    series: Vec<Series>,
    source: &str,
) -> Figure {
    Figure::Chart(Chart {
        title: title.into(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        is_isotropic: false,
        x_scale,
        shown: None,
        series,
        source: source.to_owned(),
    })
}

/// A table of numbers with two decimals. `source` is what the numbers come from.
pub(super) fn table(
    title: impl Into<String>,
    columns: Vec<String>,
    rows: Vec<(String, Vec<Option<f64>>)>,
    source: &str,
) -> Figure {
    Figure::Table(Table {
        title: title.into(),
        columns,
        rows,
        decimals: 2,
        n_counts: 0,
        source: source.to_owned(),
    })
}

/// A chart of actual and predicted values of the attribute with this index, for textures that were left out one at a time.
/// `actual` are textures × attributes, and `source` is what they come from.
pub(super) fn attribute_chart(
    (index, attribute): (usize, &str),
    textures: &[&str],
    actual: &[Vec<f64>],
    found: &MethodPredictions,
    source: &str,
) -> Figure {
    let rows = textures.iter().zip(actual).zip(&found.predicted);
    let prediction = |((texture, actual), predicted): ((&&str, &Vec<f64>), &Vec<f64>)| Prediction {
        texture: (*texture).to_owned(),
        attribute: attribute.to_owned(),
        method: found.name.clone(),
        actual: actual[index],
        predicted: predicted[index],
        deviation: None,
    };
    let predictions: Vec<Prediction> = rows.map(prediction).collect();
    let shown = PredictionFigure {
        attribute,
        method: &found.name,
        of: "texture",
        validation: "leave-one-texture-out",
        source,
    };
    prediction_figure(&predictions, &shown)
}
