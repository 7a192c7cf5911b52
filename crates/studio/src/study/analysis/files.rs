//! Files of a report: JSON, a page of figures, the answers, the tables from which a space is built.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_formats::figure::{Figure, page_svg};
use shagreen_formats::ratings_csv::{ratings_csv, relevance_csv};
use shagreen_formats::sorting_csv::sorting_csv;

use super::{FORMAT, StudyReport, limits};
use crate::figure_files::figure_files;
use crate::file::read_file;
use crate::replace::has_format;
use shagreen_formats::bounded_file::FileKind;

/// File of the report; a folder with it may be written again.
const REPORT: &str = "report.json";
/// Most rows and columns of a table on the page of figures.
const ON_PAGE: [usize; 2] = [17, 6];

/// The files of a report in a folder, with their contents: `report.json`, `report.svg`, `answers.csv`, each figure as SVG and
/// CSV, and `sorting.csv`, `ratings.csv`, `votes.csv` and `pairs.csv` if there are such answers.
pub fn report_files(report: &StudyReport, folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut json = serde_json::to_vec_pretty(&report.json).unwrap_or_default();
    json.push(b'\n');
    let mut files = vec![
        (folder.join(REPORT), json),
        (folder.join("report.svg"), page(report).into_bytes()),
        (folder.join("answers.csv"), report.answers_csv.clone()),
    ];
    let judgments = &report.judgments;
    let tables = [
        ("sorting.csv", judgments.sorts.is_empty(), sorting_csv(&judgments.sorts)),
        ("ratings.csv", judgments.ratings.is_empty(), ratings_csv(&judgments.ratings)),
        ("votes.csv", judgments.votes.is_empty(), relevance_csv(&judgments.votes)),
    ];
    let filled = tables.into_iter().filter(|(_, is_empty, _)| !is_empty);
    files.extend(filled.map(|(name, _, bytes)| (folder.join(name), bytes)));
    files.extend(report.pairs_csv.iter().map(|bytes| (folder.join("pairs.csv"), bytes.clone())));
    let figures = report.parts.iter().flat_map(|part| &part.figures);
    files.extend(figures.flat_map(|(name, figure)| figure_files(folder, name, figure)));
    files
}

/// Checks that the files of a report may be written: into a folder without files of these names, or in the place of a report of
/// a study.
///
/// # Errors
/// A file of another kind would be replaced, or a log of the study.
pub fn check_report_files(folder: &Path, files: &[(PathBuf, Vec<u8>)]) -> anyhow::Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!(
            "a report is written into a folder, but this is a file; choose another folder: {}",
            folder.display()
        );
    }
    let is_report = |path: &Path| {
        path.is_file() && read_file(path, FileKind::Document).is_ok_and(|bytes| has_format(&bytes, FORMAT))
    };
    if is_report(&folder.join(REPORT)) {
        return Ok(());
    }
    if let Some((present, _)) = files.iter().find(|(path, _)| path.exists()) {
        bail!(
            "the report would replace a file that is not part of one; choose another folder: {}",
            present.display()
        );
    }
    Ok(())
}

/// What limits the answers, and all charts and small tables, on one page; the other tables have files of their own.
fn page(report: &StudyReport) -> String {
    let figures = report.parts.iter().flat_map(|part| &part.figures).map(|(_, figure)| figure);
    let figures = figures.filter(|figure| fits_on_page(figure)).map(|of| Figure::clone(of));
    let shown: Vec<Figure> = limits::figure(&report.limited).into_iter().chain(figures).collect();
    page_svg(&report.plan.name, &report.who(), &shown)
}

fn fits_on_page(figure: &Figure) -> bool {
    match figure {
        Figure::Table(table) => table.rows.len() <= ON_PAGE[0] && table.columns.len() <= ON_PAGE[1],
        Figure::Chart(_) | Figure::Map(_) => true,
    }
}
