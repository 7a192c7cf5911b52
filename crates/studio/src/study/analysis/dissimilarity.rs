//! Magnitude estimates of dissimilarities, and the normalized realism score of authored textures.

use serde_json::{Map, Value, json};
use shagreen_core::maths::hypothesis_tests::bootstrap::bootstrap_interval;
use shagreen_core::maths::hypothesis_tests::intervals::{Confidence, Interval};
use shagreen_core::maths::statistics::mean;
use shagreen_core::people::study::analysis::Cells;
use shagreen_core::people::study::analysis::dissimilarity::{
    Dissimilarity, Normalization, dissimilarities, realism_scores, references_of,
};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Comparison, Part, Plan};
use shagreen_formats::figure::{Figure, Table};

use super::scales::measured;
use super::values::interval;
use super::{Analyzed, Measure};

/// Normalizations with their names; the first one is that of the published study.
const NORMALIZATIONS: [(Normalization, &str); 3] = [
    (Normalization::Range, "range"),
    (Normalization::Maximum, "maximum"),
    (Normalization::GeometricMean, "geometric-mean"),
];

/// Number of samples of the bootstrap.
const N_DRAWS: usize = 2000;

/// Normalized dissimilarities and realism scores of a part.
pub(super) fn analyze(plan: &Plan, part: &Part, records: &[Record]) -> Analyzed {
    let Some(found) = dissimilarities(part, records, Normalization::Range) else {
        return Analyzed::default();
    };
    let mut analyzed = measured(&[Measure::of("normalized dissimilarity", "0 to 1", found.cells.clone())]);
    analyzed.warnings.extend(found.constant.iter().map(|participant| {
        format!("{participant} gave the same number to all pairs, so these answers cannot be normalized and are left out")
    }));
    let references = found.references.map(|of| json!({"lowest": of.lowest, "highest": of.highest}));
    analyzed.results.insert("references".to_owned(), json!(references));
    let scores = realism_scores(plan, &found);
    let Some(average) = mean_score(&scores) else { return analyzed };
    let bounds = score_interval(plan, &found);
    analyzed.findings.insert(0, sentence(average, bounds, scores.len()));
    let by_pair: Map<String, Value> =
        scores.iter().map(|(pair, score)| (pair.name(), json!(score))).collect();
    let means: Map<String, Value> = NORMALIZATIONS
        .iter()
        .filter_map(|(normalization, name)| {
            let found = dissimilarities(part, records, *normalization)?;
            Some(((*name).to_owned(), json!(mean_score(&realism_scores(plan, &found)))))
        })
        .collect();
    let results = [
        ("nrs", Value::Object(by_pair)),
        ("nrs_mean", json!(average)),
        ("nrs_mean_interval_95", json!(bounds.map(interval))),
        ("nrs_mean_by_normalization", Value::Object(means)),
        ("normalization", json!(NORMALIZATIONS[0].1)),
    ];
    analyzed.results.extend(results.map(|(name, value)| (name.to_owned(), value)));
    analyzed.figures.insert(0, ("realism scores".to_owned(), Figure::Table(table(&scores, average))));
    analyzed
}

fn mean_score(scores: &[(Comparison, f64)]) -> Option<f64> {
    let values: Vec<f64> = scores.iter().map(|(_, score)| *score).collect();
    (!values.is_empty()).then(|| mean(&values))
}

fn sentence(average: f64, bounds: Option<Interval>, n: usize) -> String {
    let interval = bounds.map_or_else(String::new, |Interval { low, high }| {
        format!(", 95 % interval {low:.3} to {high:.3} (bootstrap over participants)")
    });
    format!("Normalized realism score: mean {average:.3} over {n} pairs{interval}.")
}

/// Interval of the mean score, from samples of the participants.
fn score_interval(plan: &Plan, found: &Dissimilarity) -> Option<Interval> {
    let rows: Vec<f64> = (0..found.cells.participants.len()).map(|row| row as f64).collect();
    if rows.len() < 2 {
        return None;
    }
    let of_sample = |sample: &[f64]| {
        let cells = rows_of(&found.cells, sample);
        let references = references_of(&cells);
        let comparisons = found.comparisons.clone();
        let drawn = Dissimilarity { comparisons, cells, references, constant: Vec::new() };
        mean_score(&realism_scores(plan, &drawn)).unwrap_or(f64::NAN)
    };
    bootstrap_interval(&rows, of_sample, Confidence::NINETY_FIVE, N_DRAWS, plan.seed)
}

/// The rows with these indices.
fn rows_of(cells: &Cells, indices: &[f64]) -> Cells {
    let rows = || indices.iter().map(|index| *index as usize);
    Cells {
        participants: rows().map(|row| cells.participants[row].clone()).collect(),
        columns: cells.columns.clone(),
        values: rows().map(|row| cells.values[row].clone()).collect(),
        n_answers: rows().map(|row| cells.n_answers[row].clone()).collect(),
    }
}

fn table(scores: &[(Comparison, f64)], average: f64) -> Table {
    let row = |(pair, score): &(Comparison, f64)| (pair.name(), vec![Some(*score)]);
    Table {
        title: "Normalized realism score".to_owned(),
        columns: vec!["score".to_owned()],
        rows: scores.iter().map(row).chain([("mean".to_owned(), vec![Some(average)])]).collect(),
        decimals: 3,
        n_counts: 0,
        source: String::new(),
    }
}
