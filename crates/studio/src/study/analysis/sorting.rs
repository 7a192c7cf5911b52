//! Cluster sorting: similarities of all pairs of textures.

use serde_json::{Map, json};
use shagreen_core::people::sorting::{Finding, Similarity, Sort, similarity};
use shagreen_core::people::study::analysis::sorting::sorts;
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Design, Part, Plan};
use shagreen_core::words::counted;
use shagreen_formats::figure::{Figure, Map as FigureMap, Table};

use super::Analyzed;

/// Similarities of a part. The sorts are also collected for a space.
pub(super) fn analyze(plan: &Plan, part: &Part, records: &[Record], collected: &mut Vec<Sort>) -> Analyzed {
    let Design::Sorting { stimuli, .. } = &part.design else { return Analyzed::default() };
    let of_part = sorts(plan, part, records);
    // Trials of several parts need names of their own.
    let has_more = plan.parts.iter().filter(|of| matches!(of.design, Design::Sorting { .. })).count() > 1;
    collected.extend(of_part.iter().cloned().map(|sort| Sort {
        trial: if has_more { format!("{}, {}", part.id, sort.trial) } else { sort.trial.clone() },
        ..sort
    }));
    let textures: Vec<String> = stimuli.iter().map(|id| plan.texture_name(id).to_owned()).collect();
    let mut analyzed = Analyzed::default();
    analyzed.results.insert("sorts".to_owned(), json!(of_part.len()));
    match similarity(&textures, &of_part) {
        Ok(found) => add(&mut analyzed, &found, of_part.len()),
        Err(error) => {
            analyzed.results.insert("why_no_similarity".to_owned(), json!(error.to_string()));
            analyzed.warnings.push(format!("there are no similarities: {error}"));
        }
    }
    analyzed
}

fn add(analyzed: &mut Analyzed, found: &Similarity, n_sorts: usize) {
    let n_pairs = found.textures.len() * (found.textures.len() - 1) / 2;
    let mut sentence =
        format!("{} give the similarities of {}.", counted(n_sorts, "sort"), counted(n_pairs, "pair"));
    if let Some((first, second, score)) = most_similar(found) {
        let most = format!(" The most similar two are {first} and {second} ({score:.0} of 100).");
        sentence.push_str(&most);
    }
    analyzed.findings.push(sentence);
    analyzed.warnings.extend(found.findings.iter().map(Finding::to_string));
    let agreements: Map<String, serde_json::Value> =
        found.agreements.iter().map(|fit| (fit.participant.clone(), json!(fit.correlation))).collect();
    let results = [
        ("textures", json!(found.textures)),
        ("similarity", json!(found.scores)),
        ("n_participants_of_pairs", json!(found.n_participants)),
        ("correlation_with_others", json!(agreements)),
        ("irregularities", json!(found.findings.iter().map(Finding::to_string).collect::<Vec<_>>())),
    ];
    analyzed.results.extend(results.map(|(name, value)| (name.to_owned(), value)));
    analyzed.figures.push(("similarity table".to_owned(), Figure::Table(table(found))));
    analyzed.figures.extend(map(found).map(|map| ("similarity map".to_owned(), Figure::Map(map))));
}

fn most_similar(found: &Similarity) -> Option<(&str, &str, f64)> {
    let n = found.textures.len();
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let scored = pairs.filter_map(|(i, j)| Some((i, j, found.scores[i][j]?)));
    let (i, j, score) = scored.max_by(|a, b| a.2.total_cmp(&b.2))?;
    Some((found.textures[i].as_str(), found.textures[j].as_str(), score))
}

fn table(found: &Similarity) -> Table {
    Table {
        title: "Similarity, 0 to 100".to_owned(),
        columns: found.textures.clone(),
        rows: found.textures.iter().cloned().zip(found.scores.iter().cloned()).collect(),
        decimals: 0,
        n_counts: 0,
        source: String::new(),
    }
}

/// Colors of all similarities; `None` if one is unknown.
fn map(found: &Similarity) -> Option<FigureMap> {
    let rows =
        found.scores.iter().map(|row| row.iter().copied().collect()).collect::<Option<Vec<Vec<f64>>>>()?;
    let end = found.textures.len() as f64 + 0.5;
    Some(FigureMap {
        title: "Similarity of the textures".to_owned(),
        x_label: "texture, in the order of the plan".to_owned(),
        y_label: "texture, in the order of the plan".to_owned(),
        value_label: "similarity".to_owned(),
        value_unit: "0 to 100".to_owned(),
        x: (0.5, end),
        y: (0.5, end),
        range: (0.0, 100.0),
        rows,
        source: String::new(),
    })
}
