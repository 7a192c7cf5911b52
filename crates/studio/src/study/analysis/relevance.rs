//! Votes on adjectives: how many find each one relevant.

use serde_json::{Map, Value, json};
use shagreen_core::maths::hypothesis_tests::intervals::{Confidence, wilson_interval};
use shagreen_core::people::ratings::{RELEVANCE_LIMIT, Relevance, RelevanceVote, relevances};
use shagreen_core::people::study::analysis::relevance::votes;
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Part, Plan};
use shagreen_core::words::counted;
use shagreen_formats::figure::{Figure, Table};

use super::Analyzed;
use super::values::interval;

/// Relevance of the adjectives of a part. The votes are also collected for a space.
pub(super) fn analyze(
    plan: &Plan,
    part: &Part,
    records: &[Record],
    collected: &mut Vec<RelevanceVote>,
) -> Analyzed {
    let of_part = votes(plan, part, records);
    let mut analyzed = Analyzed::default();
    match relevances(&of_part) {
        Ok(found) => add(&mut analyzed, &found),
        Err(error) => analyzed.warnings.push(format!("the votes cannot be counted: {error}")),
    }
    collected.extend(of_part);
    analyzed
}

fn add(analyzed: &mut Analyzed, found: &[Relevance]) {
    let n_kept = found.iter().filter(|of| of.kept).count();
    analyzed.findings.push(format!(
        "{} of {} are relevant: at least {:.0} % of the votes choose them.",
        n_kept,
        counted(found.len(), "adjective"),
        100.0 * RELEVANCE_LIMIT
    ));
    let of_adjective = |of: &Relevance| {
        let bounds = wilson_interval(of.n_relevant as u64, of.n_votes as u64, Confidence::NINETY_FIVE);
        let value = json!({
            "votes": of.n_votes,
            "chosen": of.n_relevant,
            "share": of.share,
            "wilson_95": bounds.map(interval),
            "relevant": of.kept,
        });
        (of.adjective.clone(), value)
    };
    let adjectives: Map<String, Value> = found.iter().map(of_adjective).collect();
    analyzed.results.insert("adjectives".to_owned(), Value::Object(adjectives));
    let row = |of: &Relevance| (of.adjective.clone(), vec![Some(100.0 * of.share), Some(of.n_votes as f64)]);
    let table = Table {
        title: "Votes for each adjective".to_owned(),
        columns: ["%", "n"].map(str::to_owned).to_vec(),
        rows: found.iter().map(row).collect(),
        decimals: 0,
        n_counts: 1,
        source: String::new(),
    };
    analyzed.figures.push(("votes".to_owned(), Figure::Table(table)));
}
