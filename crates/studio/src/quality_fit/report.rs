//! Report of a fitted model: a JSON object for scripts, and its sentences for people.

use serde_json::{Map, Value, json};
use shagreen_core::signals::quality::{Feature, PAPER_PAIRS, RatedPair, Rotation, Term};
use shagreen_core::words::counted;
use shagreen_formats::rated_pairs_csv::RatedRow;
use shagreen_formats::thresholds::ThresholdKind;

use super::FittedModel;
use super::figures::range_of_rotations;
use crate::quality_model::predicts_nothing;

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-quality-fit-report";

const VERSION: &str = "1.0";

/// Returns the complete report as one JSON object.
pub fn fit_report(fitted: &FittedModel) -> Value {
    let FittedModel { pairs, fit, .. } = fitted;
    let by_feature = |value: &dyn Fn(usize, &Term) -> Value| -> Map<String, Value> {
        let terms = fit.model.terms().iter().enumerate();
        terms.map(|(index, term)| (term.feature.id().to_owned(), value(index, term))).collect()
    };
    let dropped = |(feature, squared_error): &(Feature, f64)| -> Value {
        json!({"feature": feature.id(), "squared_error": squared_error})
    };
    let of_rows = pairs.rows.iter().zip(&pairs.rated).zip(&fit.nested.predicted);
    let without = pairs.textures.iter().zip(&fit.nested.kept);
    json!({
        "format": FORMAT,
        "version": VERSION,
        "table": {"file": pairs.table, "sha256": pairs.sha256},
        "simulated": pairs.is_simulated(),
        "n": pairs.rated.len(),
        "n_textures": pairs.textures.len(),
        "threshold": pairs.threshold.map(ThresholdKind::id),
        "candidates": names(&fitted.candidates),
        "tolerance": fitted.tolerance,
        "dropped": fit.elimination.dropped.iter().map(dropped).collect::<Vec<_>>(),
        "kept": names(&fit.elimination.kept),
        "weights": by_feature(&|_, term| json!(term.weight)),
        "standard_errors": by_feature(&|index, _| json!(fit.standard_errors[index])),
        "lengths": by_feature(&|_, term| json!(term.length)),
        "lengths_of_pairs": PAPER_PAIRS,
        "weights_of_rotations": by_feature(&|index, _| json!(range_of_rotations(fit, index))),
        "r2": fit.r_squared,
        "adjusted_r2": fit.adjusted_r_squared,
        "r2_of_all_features": fit.r_squared_of_all,
        "nested_r2": fit.nested.r_squared,
        "validation": "nested: features are selected and weights are fitted without the texture whose pairs are predicted",
        "verdict": verdict(fit.nested.r_squared),
        "predicts_nothing": predicts_nothing(fit.nested.r_squared),
        "kept_without": without
            .map(|(texture, kept)| json!({"texture": texture, "kept": names(kept)}))
            .collect::<Vec<_>>(),
        "rotations": fit.rotations.iter().map(|of| rotation(fitted, of)).collect::<Vec<_>>(),
        "pairs": of_rows.map(|((row, rated), nested)| pair(fitted, row, rated, *nested)).collect::<Vec<_>>(),
    })
}

fn rotation(fitted: &FittedModel, rotation: &Rotation) -> Value {
    let model = &fitted.fit.model;
    let features = model.terms().iter().map(|term| term.feature.id().to_owned());
    let weights = rotation.model.weights_at_lengths_of(model).into_iter().map(Value::from);
    json!({
        "left_out": rotation.left_out.map(|texture| fitted.pairs.textures[texture].as_str()),
        "weights": features.zip(weights).collect::<Map<String, Value>>(),
        "squared_error": rotation.squared_error,
        "squared_error_left_out": rotation.squared_error_left_out,
    })
}

fn pair(fitted: &FittedModel, row: &RatedRow, rated: &RatedPair, nested: f64) -> Value {
    let distance = |feature: &Feature| (feature.id().to_owned(), json!(rated.distances.by(*feature)));
    json!({
        "line": row.line,
        "reference": row.reference,
        "comparison": row.comparison,
        "texture": row.texture,
        "dprime": rated.d_prime,
        "weight": rated.weight,
        "predicted": fitted.fit.model.d_prime(&rated.distances),
        "nested_predicted": nested,
        "distances": fitted.pairs.features.iter().map(distance).collect::<Map<String, Value>>(),
    })
}

/// What the nested cross-validation says about the model, in one sentence.
pub fn verdict(nested_r_squared: Option<f64>) -> String {
    match nested_r_squared {
        None => "All ratings are equal, so that nothing can be said about the model.".to_owned(),
        Some(r_squared) if predicts_nothing(nested_r_squared) => format!(
            "The model predicts nothing about textures that it was not fitted to: its nested R² is {r_squared:.2}, and that of always stating the mean d' is 0. Do not use it."
        ),
        Some(r_squared) => format!(
            "In the pairs of textures that it was not fitted to, the model explains {:.0} % of the variance of d'.",
            100.0 * r_squared
        ),
    }
}

/// Returns the report as text.
pub fn fit_text(fitted: &FittedModel) -> String {
    let FittedModel { pairs, fit, .. } = fitted;
    let shown = |value: Option<f64>, decimals: usize| {
        value.map_or_else(|| "\u{2013}".to_owned(), |value| format!("{value:.decimals$}"))
    };
    let mut lines = vec![
        format!(
            "{} of {} from {}, {}",
            counted(pairs.rated.len(), "pair"),
            counted(pairs.textures.len(), "texture"),
            pairs.table,
            fitted.source()
        ),
        format!("{:20} {:>10} {:>16} {:>26}", "", "weight", "standard error", "without two textures"),
    ];
    for (index, term) in fit.model.terms().iter().enumerate() {
        let range = range_of_rotations(fit, index).map(|weight| format!("{weight:.2}")).join(" to ");
        lines.push(format!(
            "{:20} {:>10.2} {:>16} {range:>26}",
            term.feature.id().replace('_', " "),
            term.weight,
            shown(fit.standard_errors[index], 2)
        ));
    }
    let dropped: Vec<&str> = fit.elimination.dropped.iter().map(|(feature, _)| feature.id()).collect();
    if !dropped.is_empty() {
        lines.push(format!("eliminated, in this order: {}", dropped.join(", ")));
    }
    lines.push(format!(
        "R²: {} in nested cross-validation; {} on the pairs of the fit (adjusted {}), {} with all features",
        shown(fit.nested.r_squared, 2),
        shown(fit.r_squared, 2),
        shown(fit.adjusted_r_squared, 2),
        shown(fit.r_squared_of_all, 2)
    ));
    lines.push(verdict(fit.nested.r_squared));
    if pairs.is_simulated() {
        lines
            .push("Simulated participants rated the pairs: the weights say nothing about people.".to_owned());
    }
    lines.join("\n")
}

fn names(features: &[Feature]) -> Vec<&'static str> {
    features.iter().map(|feature| feature.id()).collect()
}
