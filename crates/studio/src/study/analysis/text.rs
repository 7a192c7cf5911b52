//! A report as text, for a terminal.

use shagreen_core::words::counted;
use shagreen_formats::figure::{Figure, Table};

use super::{PartReport, StudyReport};

/// Widest name of a row, in characters.
const MAX_NAME: usize = 40;
/// Most columns of a table; wider ones are in files only.
const MAX_COLUMNS: usize = 6;
/// Width of a column, in characters.
const COLUMN: usize = 14;

/// Sentences and tables of a report.
pub fn report_text(report: &StudyReport) -> String {
    let mut lines = vec![format!("{}: {}", report.plan.name, report.who())];
    for part in &report.parts {
        lines.push(String::new());
        lines.extend(part_lines(part));
    }
    lines.join("\n")
}

fn part_lines(part: &PartReport) -> Vec<String> {
    let mut lines =
        vec![format!("{} ({}, {}): {}", part.id, part.design, counted(part.n_answers, "answer"), part.title)];
    lines.extend(part.findings.iter().cloned());
    for (_, figure) in &part.figures {
        if let Figure::Table(table) = &**figure
            && table.columns.len() <= MAX_COLUMNS
        {
            lines.extend(table_lines(table));
        }
    }
    lines
}

fn table_lines(table: &Table) -> Vec<String> {
    let longest = table.rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let width = longest.min(MAX_NAME);
    let line = |name: &str, cells: Vec<String>| {
        let cells: Vec<String> = cells.into_iter().map(|cell| format!("{cell:>COLUMN$}")).collect();
        format!("  {name:width$}{}", cells.concat())
    };
    let mut lines = vec![format!("  {}", table.title), line("", table.columns.clone())];
    let shown = |values: &[Option<f64>]| {
        values.iter().enumerate().map(|(column, value)| table.shown(column, *value)).collect()
    };
    lines.extend(table.rows.iter().map(|(name, values)| line(name, shown(values))));
    lines
}
