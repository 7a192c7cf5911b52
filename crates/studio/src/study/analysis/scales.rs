//! Designs with grades and ratings: adjective pairs, similarities, questionnaires, positions between two anchors.

use serde_json::{Map, Value, json};
use shagreen_core::people::ratings::{AdjectivePair, Rating};
use shagreen_core::people::study::analysis::Cells;
use shagreen_core::people::study::analysis::anchors::position_cells;
use shagreen_core::people::study::analysis::likert::{StatementGrades, grades};
use shagreen_core::people::study::analysis::rating::{rating_cells, ratings as ratings_of};
use shagreen_core::people::study::analysis::similarity::similarity_cells;
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Design, Part, Plan};
use shagreen_core::words::counted;

use super::{Analyzed, Measure};

/// Unit of sliders.
const POINTS: &str = "0 to 100";

/// Ratings on adjective pairs. They are also collected for a space.
pub(super) fn ratings(plan: &Plan, part: &Part, records: &[Record], collected: &mut Vec<Rating>) -> Analyzed {
    collected.extend(ratings_of(plan, part, records));
    let Design::Rating { pairs, .. } = &part.design else { return Analyzed::default() };
    let named = pairs.iter().map(AdjectivePair::name).zip(rating_cells(part, records));
    measured(&named.map(|(name, cells)| Measure::of(name, POINTS, cells)).collect::<Vec<_>>())
}

/// Grades of the similarity of pairs.
pub(super) fn similarities(part: &Part, records: &[Record]) -> Analyzed {
    let Design::Similarity { n_points, low, high, .. } = &part.design else { return Analyzed::default() };
    let unit = format!("1 = {low}, {n_points} = {high}");
    measured(&[Measure::of("similarity", unit, similarity_cells(part, records))])
}

/// Positions between two anchors.
pub(super) fn positions(part: &Part, records: &[Record]) -> Analyzed {
    let (Design::Anchors { low, high, .. }, Some(cells)) = (&part.design, position_cells(part, records))
    else {
        return Analyzed::default();
    };
    let mut analyzed = measured(&[Measure::of("position", format!("0 = {low}, 100 = {high}"), cells)]);
    analyzed.results.insert("anchors".to_owned(), json!([low, high]));
    analyzed
}

/// Grades of statements under conditions, and their mean over the statements.
pub(super) fn questionnaire(part: &Part, records: &[Record]) -> Analyzed {
    let Design::Likert { conditions, statements: asked, prompts, n_points, low, high } = &part.design else {
        return Analyzed::default();
    };
    let unit = format!("1 = {low}, {n_points} = {high}");
    let statements = grades(part, records);
    let n_grades: usize = statements.iter().map(|of| n_answers(&of.cells)).sum();
    let by_participant = grades_by_participant(&statements);
    let n_values: usize = statements.iter().map(|of| of.cells.n_values()).sum();
    let together = mean_over_statements(&statements);
    let measures = statements.into_iter().map(|of| Measure::of(of.statement, unit.as_str(), of.cells));
    let all = together.map(|cells| Measure::of("all statements", unit.as_str(), cells));
    let mut analyzed = measured(&measures.chain(all).collect::<Vec<_>>());
    let n_means_each = conditions.len() * asked.len();
    let n_grades_each = n_means_each * prompts.n_texts() * part.n_repeats;
    let repeats = if part.n_repeats == 1 { String::new() } else { format!(" × {} repeats", part.n_repeats) };
    analyzed.findings.insert(
        0,
        format!(
            "{n_grades} grades: {n_grades_each} of each participant with all answers ({} × {} × {}{repeats}). Averaged over the texts, they are {n_values} means: {n_means_each} of each participant. These are tested.",
            counted(prompts.n_texts(), "text"),
            counted(conditions.len(), "condition"),
            counted(asked.len(), "statement"),
        ),
    );
    let results = [
        ("n_grades", n_grades),
        ("n_grades_of_a_participant", n_grades_each),
        ("n_means_over_prompts", n_values),
        ("n_means_of_a_participant", n_means_each),
    ];
    analyzed.results.extend(results.map(|(name, n)| (name.to_owned(), json!(n))));
    analyzed.results.insert("n_grades_by_participant".to_owned(), by_participant);
    analyzed
}

/// Number of grades of each participant.
fn grades_by_participant(statements: &[StatementGrades]) -> Value {
    let participants = statements.first().map_or(&[][..], |of| of.cells.participants.as_slice());
    let n_of = |row: usize| statements.iter().map(|of| of.cells.n_answers_of(row)).sum::<usize>();
    let counts = participants.iter().enumerate().map(|(row, name)| (name.clone(), json!(n_of(row))));
    counts.collect::<Map<String, Value>>().into()
}

fn n_answers(cells: &Cells) -> usize {
    (0..cells.participants.len()).map(|row| cells.n_answers_of(row)).sum()
}

/// Mean of each participant under each condition over all statements; a cell is missing if one of them is. `None` for a single
/// statement.
fn mean_over_statements(statements: &[StatementGrades]) -> Option<Cells> {
    let [first, _, ..] = statements else { return None };
    let n_statements = statements.len() as f64;
    let mean_of = |row: usize, column: usize| {
        let all: Option<f64> = statements.iter().map(|of| of.cells.values[row][column]).sum();
        all.map(|sum| sum / n_statements)
    };
    let n_of = |row: usize, column: usize| -> usize {
        statements.iter().map(|of| of.cells.n_answers[row][column]).sum()
    };
    let (rows, columns) = (0..first.cells.participants.len(), 0..first.cells.columns.len());
    Some(Cells {
        participants: first.cells.participants.clone(),
        columns: first.cells.columns.clone(),
        values: rows
            .clone()
            .map(|row| columns.clone().map(|column| mean_of(row, column)).collect())
            .collect(),
        n_answers: rows.map(|row| columns.clone().map(|column| n_of(row, column)).collect()).collect(),
    })
}

/// Results of quantities that were judged under conditions.
pub(super) fn measured(measures: &[Measure]) -> Analyzed {
    let measures_json: Map<String, Value> =
        measures.iter().map(|measure| (measure.name.clone(), measure.json())).collect();
    let mut results = Map::new();
    results.insert("measures".to_owned(), Value::Object(measures_json));
    Analyzed {
        findings: measures.iter().map(Measure::finding).collect(),
        warnings: Vec::new(),
        figures: measures.iter().flat_map(Measure::figures).collect(),
        results,
    }
}
