//! Matching trials (ABX): right answers against guessing.

use serde_json::{Map, Value, json};
use shagreen_core::maths::hypothesis_tests::holm::holm;
use shagreen_core::maths::hypothesis_tests::intervals::{
    Confidence, clopper_pearson_interval, wilson_interval,
};
use shagreen_core::people::study::analysis::abx::{Matches, RightAnswers, matches};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::Part;
use shagreen_core::words::counted;
use shagreen_formats::figure::{Figure, Table};

use super::Analyzed;
use super::comparison::SIGNIFICANT;
use super::values::interval;

/// Right answers to each pair of a part.
pub(super) fn analyze(part: &Part, records: &[Record]) -> Analyzed {
    let pairs = matches(part, records);
    let by_chance: Vec<f64> = pairs.iter().map(|of| of.pooled.p_by_chance()).collect();
    let adjusted = holm(&by_chance);
    let n_told = adjusted.iter().filter(|p| **p < SIGNIFICANT).count();
    let finding = format!(
        "{n_told} of {} are distinguished (more right answers than by guessing, p < {SIGNIFICANT}, one-sided, adjusted by Holm for the number of pairs).",
        counted(pairs.len(), "pair")
    );
    let by_name: Map<String, Value> =
        pairs.iter().zip(&adjusted).map(|(of, p)| (of.pair.name(), json_of(of, *p))).collect();
    let mut results = Map::new();
    results.insert("pairs".to_owned(), Value::Object(by_name));
    let figures = vec![("right answers".to_owned(), Figure::Table(table(&pairs, &adjusted)))];
    Analyzed { findings: vec![finding], warnings: Vec::new(), figures, results }
}

fn json_of(of: &Matches, adjusted: f64) -> Value {
    let RightAnswers { n_right, n_trials } = of.pooled;
    let wilson = wilson_interval(n_right, n_trials, Confidence::NINETY_FIVE);
    let exact = clopper_pearson_interval(n_right, n_trials, Confidence::NINETY_FIVE);
    let person = |(name, answers): &(String, RightAnswers)| {
        let value = json!({"right": answers.n_right, "trials": answers.n_trials, "p": answers.p_by_chance()});
        (name.clone(), value)
    };
    json!({
        "right": n_right,
        "trials": n_trials,
        "proportion": of.pooled.proportion(),
        "wilson_95": wilson.map(interval),
        "clopper_pearson_95": exact.map(interval),
        "p": of.pooled.p_by_chance(),
        "p_holm": adjusted,
        "participants": of.by_participant.iter().map(person).collect::<Map<String, Value>>(),
    })
}

fn table(pairs: &[Matches], adjusted: &[f64]) -> Table {
    let row = |(of, p): (&Matches, &f64)| {
        let RightAnswers { n_right, n_trials } = of.pooled;
        let bounds = wilson_interval(n_right, n_trials, Confidence::NINETY_FIVE);
        let numbers = vec![
            of.pooled.proportion(),
            bounds.map(|bounds| bounds.low),
            bounds.map(|bounds| bounds.high),
            Some(*p),
            Some(n_trials as f64),
        ];
        (of.pair.name(), numbers)
    };
    Table {
        title: "Proportion of right answers, with its 95 % interval (Wilson)".to_owned(),
        columns: ["right", "low", "high", "p", "n"].map(str::to_owned).to_vec(),
        rows: pairs.iter().zip(adjusted).map(row).collect(),
        decimals: 3,
        n_counts: 1,
        source: String::new(),
    }
}
