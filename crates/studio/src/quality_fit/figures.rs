//! Figures of a fitted model.

use shagreen_core::signals::quality::{QualityFit, Term};
use shagreen_formats::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};

use super::FittedModel;

/// Names of the figures, for files.
pub const FIGURE_NAMES: [&str; 2] = ["predicted-d-prime", "weights"];

/// Most pairs whose names the figure shows.
const MOST_LABELS: usize = 60;

/// Returns the figures with their names: predicted against rated d′, and a table of the weights.
pub fn fit_figures(fitted: &FittedModel) -> Vec<(&'static str, Figure)> {
    let figures = [Figure::Chart(predictions(fitted)), Figure::Table(weights(fitted))];
    FIGURE_NAMES.into_iter().zip(figures).collect()
}

fn predictions(fitted: &FittedModel) -> Chart {
    let FittedModel { pairs, fit, .. } = fitted;
    let label = |index: usize| {
        let shows = pairs.rows.len() <= MOST_LABELS;
        if shows { pairs.rows[index].comparison.clone() } else { String::new() }
    };
    let of_fit = pairs.rated.iter().map(|pair| Point::new(pair.d_prime, fit.model.d_prime(&pair.distances)));
    let of_others = pairs.rated.iter().zip(&fit.nested.predicted).enumerate();
    let of_others =
        of_others.map(|(index, (pair, predicted))| Point::named(pair.d_prime, *predicted, label(index)));
    let dots = |name: &str, tone: Tone, points: Vec<Point>| Series {
        name: name.to_owned(),
        mark: Mark::Dots,
        tone,
        points,
    };
    let (of_fit, of_others) = (of_fit.collect::<Vec<_>>(), of_others.collect::<Vec<_>>());
    let ends = of_fit.iter().chain(&of_others).flat_map(|point| [point.x, point.y]);
    let (low, high) = ends.fold((0.0_f64, 1.0_f64), |(low, high), end| (low.min(end), high.max(end)));
    let line = Series {
        name: "predicted as rated".to_owned(),
        mark: Mark::Line,
        tone: Tone::Limit,
        points: vec![Point::new(low, low), Point::new(high, high)],
    };
    Chart {
        title: title(fit),
        x_label: "rated d'".to_owned(),
        y_label: "predicted d'".to_owned(),
        is_isotropic: true,
        x_scale: Scale::Linear,
        shown: None,
        series: vec![
            line,
            dots("model of all pairs", Tone::Faint, of_fit),
            dots("model without the texture", Tone::Main, of_others),
        ],
        source: fitted.source().to_owned(),
    }
}

/// The figure of the fit stands beside that of its validation.
fn title(fit: &QualityFit) -> String {
    let shown = |r_squared: Option<f64>| {
        r_squared.map_or_else(|| "not defined".to_owned(), |value| format!("{value:.2}"))
    };
    format!(
        "Predicted and rated d': nested cross-validation R² {}; R² {} on the pairs of the fit",
        shown(fit.nested.r_squared),
        shown(fit.r_squared)
    )
}

fn weights(fitted: &FittedModel) -> Table {
    let fit = &fitted.fit;
    let row = |(index, term): (usize, &Term)| {
        let [low, high] = range_of_rotations(fit, index);
        let numbers =
            vec![Some(term.weight), fit.standard_errors[index], Some(low), Some(high), Some(term.length)];
        (term.feature.id().to_owned(), numbers)
    };
    Table {
        title: "Weights, and their range without the pairs of two textures".to_owned(),
        columns: ["weight", "standard error", "lowest", "highest", "length"].map(str::to_owned).to_vec(),
        rows: fit.model.terms().iter().enumerate().map(row).collect(),
        decimals: 3,
        n_counts: 0,
        source: fitted.source().to_owned(),
    }
}

/// Lowest and highest weight of a term in the rotations, at the lengths of the model.
pub(super) fn range_of_rotations(fit: &QualityFit, index: usize) -> [f64; 2] {
    let weights =
        fit.rotations.iter().map(|rotation| rotation.model.weights_at_lengths_of(&fit.model)[index]);
    let (low, high) =
        weights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), w| (low.min(w), high.max(w)));
    [low, high]
}
