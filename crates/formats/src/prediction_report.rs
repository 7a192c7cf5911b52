//! Predicted against actual attributes of textures: a table of all predictions, and a figure for each attribute.

use shagreen_core::maths::statistics::{correlation, mean};
use shagreen_core::words::counted;

use crate::figure::{Chart, Figure, Mark, Point, Scale, Series, Tone};
use crate::named_table::write_table;

/// Prediction of an attribute of a texture by a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Name of the texture.
    pub texture: String,
    /// Name of the attribute.
    pub attribute: String,
    /// Name of the method.
    pub method: String,
    /// Actual value, 0 to 100.
    pub actual: f64,
    /// Predicted value; a method may leave the range of 0 to 100.
    pub predicted: f64,
    /// Standard deviation that the method states; `None` if it states none.
    pub deviation: Option<f64>,
}

/// Header of the table.
const COLUMNS: [&str; 6] = ["texture", "attribute", "method", "actual", "predicted", "deviation"];

/// Writes predictions as CSV, one on each line; an unknown standard deviation is empty.
pub fn prediction_csv(predictions: &[Prediction]) -> Vec<u8> {
    let row = |of: &Prediction| {
        let numbers = [of.actual, of.predicted].map(|value| format!("{value}"));
        let deviation = of.deviation.map_or_else(String::new, |deviation| format!("{deviation}"));
        [&of.texture, &of.attribute, &of.method]
            .into_iter()
            .cloned()
            .chain(numbers)
            .chain([deviation])
            .collect()
    };
    write_table(std::iter::once(COLUMNS.map(str::to_owned).to_vec()).chain(predictions.iter().map(row)))
}

/// Returns whether bytes are a table written by [`prediction_csv`].
pub fn is_prediction_csv(bytes: &[u8]) -> bool {
    bytes.split(|byte| *byte == b'\n').next() == Some(COLUMNS.join(",").as_bytes())
}

/// What a figure shows of the predictions, and how it describes them.
#[derive(Clone, Copy, Debug)]
pub struct PredictionFigure<'a> {
    /// Name of the attribute.
    pub attribute: &'a str,
    /// Name of the method.
    pub method: &'a str,
    /// What a dot stands for, in the singular, such as "texture".
    pub of: &'a str,
    /// How the predicted textures were kept out of training.
    pub validation: &'a str,
    /// Where the actual values come from.
    pub source: &'a str,
}

/// Returns the figure of an attribute: predicted against actual by one method, with a labeled dot for each texture, the
/// line on which both are equal, and bars of one stated standard deviation. The title states the mean absolute error in
/// points and Pearson's correlation coefficient r.
pub fn prediction_figure(predictions: &[Prediction], figure: &PredictionFigure<'_>) -> Figure {
    let PredictionFigure { attribute, method, of, validation, source } = *figure;
    let shown: Vec<&Prediction> =
        predictions.iter().filter(|dot| dot.attribute == attribute && dot.method == method).collect();
    let actual: Vec<f64> = shown.iter().map(|dot| dot.actual).collect();
    let predicted: Vec<f64> = shown.iter().map(|dot| dot.predicted).collect();
    let errors: Vec<f64> = actual.iter().zip(&predicted).map(|(a, p)| (p - a).abs()).collect();
    let r = correlation(&actual, &predicted).map_or_else(|| "undefined".to_owned(), |r| format!("{r:.2}"));
    let title = format!(
        "{attribute}, predicted by {method} ({validation}): mean absolute error {:.1} points, r {r}, {}",
        mean(&errors),
        counted(shown.len(), of)
    );
    let series = |name: &str, mark: Mark, tone: Tone, points: Vec<Point>| Series {
        name: name.to_owned(),
        mark,
        tone,
        points,
    };
    let bar = |dot: &&Prediction| {
        let ends = dot.deviation.map(|deviation| [dot.predicted - deviation, dot.predicted + deviation]);
        ends.into_iter().flatten().map(|end| Point::new(dot.actual, end)).collect::<Vec<_>>()
    };
    let bars: Vec<Point> = shown.iter().flat_map(bar).collect();
    let identity = vec![Point::new(0.0, 0.0), Point::new(100.0, 100.0)];
    let dots =
        shown.iter().map(|dot| Point::named(dot.actual, dot.predicted, dot.texture.as_str())).collect();
    let mut all = vec![series("predicted = actual", Mark::Line, Tone::Faint, identity)];
    if !bars.is_empty() {
        all.push(series("± 1 standard deviation, as stated", Mark::Segments, Tone::Second, bars));
    }
    all.push(series(&format!("{of}s"), Mark::Dots, Tone::Main, dots));
    Figure::Chart(Chart {
        title,
        x_label: "Actual (0 to 100)".to_owned(),
        y_label: "Predicted (0 to 100)".to_owned(),
        is_isotropic: true,
        x_scale: Scale::Linear,
        shown: None,
        series: all,
        source: source.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::{Prediction, PredictionFigure, is_prediction_csv, prediction_csv, prediction_figure};
    use crate::figure::{Figure, Mark, figure_csv, figure_svg};

    const SHOWN: PredictionFigure<'_> = PredictionFigure {
        attribute: "rough-smooth",
        method: "network",
        of: "texture",
        validation: "leave-one-texture-out",
        source: "human ratings",
    };

    fn predictions() -> Vec<Prediction> {
        let of =
            |texture: &str, method: &str, actual: f64, predicted: f64, deviation: Option<f64>| Prediction {
                texture: texture.to_owned(),
                attribute: "rough-smooth".to_owned(),
                method: method.to_owned(),
                actual,
                predicted,
                deviation,
            };
        vec![
            of("Cork", "network", 10.0, 20.0, Some(4.0)),
            of("Felt, wool", "network", 50.0, 45.5, Some(8.0)),
            of("Glass", "network", 90.0, 84.5, None),
            of("Cork", "mean", 10.0, 70.0, None),
        ]
    }

    #[test]
    fn the_table_has_every_prediction() {
        let csv = prediction_csv(&predictions());
        assert!(is_prediction_csv(&csv) && !is_prediction_csv(b"texture,attribute\n"));
        let text = String::from_utf8(csv).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "texture,attribute,method,actual,predicted,deviation");
        assert_eq!(lines[1], "Cork,rough-smooth,network,10,20,4");
        assert_eq!(lines[2], "\"Felt, wool\",rough-smooth,network,50,45.5,8");
        assert_eq!((lines[3], lines.len()), ("Glass,rough-smooth,network,90,84.5,", 5));
    }

    #[test]
    fn the_figure_has_the_textures_their_deviations_and_the_identity_line() {
        let figure = prediction_figure(&predictions(), &SHOWN);
        // Errors of 10, 4.5 and 5.5.
        let title = "rough-smooth, predicted by network (leave-one-texture-out): mean absolute error 6.7 points, \
            r 0.99, 3 textures (human ratings)";
        assert_eq!(figure.title(), title);
        let Figure::Chart(chart) = &figure else { panic!("a chart") };
        let marks: Vec<(Mark, Vec<(f64, f64)>)> = chart
            .series
            .iter()
            .map(|series| (series.mark, series.points.iter().map(|point| (point.x, point.y)).collect()))
            .collect();
        assert_eq!(marks[0], (Mark::Line, vec![(0.0, 0.0), (100.0, 100.0)]));
        let bars = vec![(10.0, 16.0), (10.0, 24.0), (50.0, 37.5), (50.0, 53.5)];
        assert_eq!(marks[1], (Mark::Segments, bars));
        assert_eq!(marks[2], (Mark::Dots, vec![(10.0, 20.0), (50.0, 45.5), (90.0, 84.5)]));
        let svg = figure_svg(&figure);
        for name in ["Cork", "Felt, wool", "Glass", "predicted = actual"] {
            assert!(svg.contains(name), "{name}");
        }
        assert!(
            String::from_utf8(figure_csv(&figure)).unwrap().contains("textures,Glass,90,84.5,human ratings")
        );
    }

    #[test]
    fn a_figure_without_deviations_has_no_bars() {
        let shown = PredictionFigure { method: "mean", of: "material", ..SHOWN };
        let figure = prediction_figure(&predictions(), &shown);
        let Figure::Chart(chart) = &figure else { panic!("a chart") };
        assert!(chart.series.iter().all(|series| series.mark != Mark::Segments));
        assert!(figure.title().contains("r undefined, 1 material ("), "{}", figure.title());
        assert_eq!(chart.series.last().map(|series| series.name.as_str()), Some("materials"));
        assert!(figure_svg(&figure).ends_with("</svg>\n"));
    }
}
