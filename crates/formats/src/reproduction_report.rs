//! Results of the procedure of a paper beside the printed ones: a table for each table and figure of the paper, as CSV, JSON,
//! text and a page in Markdown.

mod counts;
mod markdown;

use serde_json::{Value, json};

use crate::figure::{Figure, shown_number};
use crate::named_table::write_table;
use crate::printed_results::{Paper, PrintedItem, PrintedValue};

pub use crate::reproduction_report::counts::{ItemCounts, counts_in_report};
pub use crate::reproduction_report::markdown::{is_reproduction_page, reproduction_index, reproduction_page};

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-reproduction-report";
/// Version of the report.
const VERSION: &str = "1.0";

/// Decimals of a number that the paper does not print.
const N_DECIMALS: usize = 3;

/// A number of ours, beside the printed one if there is one.
#[derive(Clone, Debug, PartialEq)]
pub struct ReproducedRow {
    /// What the number is.
    pub name: String,
    /// Unit of the number; empty for none.
    pub unit: String,
    /// The printed number; `None` if the paper prints none.
    pub printed: Option<PrintedValue>,
    /// Our number; `None` if there is none.
    pub ours: Option<f64>,
    /// Why ours differs from the printed one or is missing; may be empty.
    pub reason: String,
}

/// A table or figure of a paper, beside ours.
#[derive(Clone, Debug, PartialEq)]
pub struct ReproducedItem {
    /// Identifier, unique in its paper.
    pub id: String,
    /// Name in the paper, and where it stands there.
    pub heading: String,
    /// What it shows.
    pub title: String,
    /// Where our numbers come from: data, and raters, participants or signals. Simulated ones are called so.
    pub source: String,
    /// Commands of the program that compute parts of it alone.
    pub commands: Vec<String>,
    /// The numbers.
    pub rows: Vec<ReproducedRow>,
    /// Our figures, each under a name that is unique in the item and serves for files.
    pub figures: Vec<(String, Figure)>,
    /// Time of computing, in s.
    pub seconds: f64,
}

/// The repeated procedure of a paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// The paper.
    pub paper: Paper,
    /// Its tables and figures.
    pub items: Vec<ReproducedItem>,
    /// The command that repeats it.
    pub command: String,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Whether all networks were trained.
    pub is_full: bool,
    /// Time of computing, in s.
    pub seconds: f64,
}

impl ReproducedRow {
    /// Our number minus the printed one; `None` if one is missing.
    pub fn difference(&self) -> Option<f64> {
        Some(self.ours? - self.printed.as_ref()?.value())
    }

    /// Whether the difference does not exceed the tolerance; `None` if one number is missing.
    pub fn is_equal(&self) -> Option<bool> {
        let tolerance = self.printed.as_ref()?.tolerance;
        // Differences of printed decimals are not exact.
        Some(self.difference()?.abs() <= tolerance + 1e-9)
    }

    /// Whether nothing is left to explain: the numbers are equal, the paper prints none, or there is a reason.
    pub fn is_explained(&self) -> bool {
        self.printed.is_none() || self.is_equal() == Some(true) || !self.reason.is_empty()
    }

    fn n_decimals(&self) -> usize {
        let is_whole = self.ours.is_some_and(|ours| ours.fract() == 0.0);
        match self.printed.as_ref().map(PrintedValue::n_decimals) {
            // Counts have no decimals.
            None | Some(0) if is_whole => 0,
            None => N_DECIMALS,
            // Rounded like the printed number, ours could hide a difference.
            Some(n_printed) => n_printed + 1,
        }
    }

    /// What the number is, with its unit.
    pub fn quantity(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{}, {}", self.name, self.unit) }
    }

    /// The printed number with its digits, or an en dash.
    pub fn printed_text(&self) -> &str {
        self.printed.as_ref().map_or("\u{2013}", |printed| printed.printed.as_str())
    }

    /// Our number with one decimal more than the printed one, or an en dash. A count has none.
    pub fn ours_text(&self) -> String {
        shown_number(self.ours, self.n_decimals())
    }

    /// The difference with its sign, or an en dash.
    fn difference_text(&self) -> String {
        let text = shown_number(self.difference(), self.n_decimals());
        if self.difference().is_some_and(|difference| difference > 0.0) { format!("+{text}") } else { text }
    }

    /// The difference up to which the numbers count as equal, or an en dash.
    pub fn tolerance_text(&self) -> String {
        self.printed.as_ref().map_or_else(|| "\u{2013}".to_owned(), |printed| printed.tolerance.to_string())
    }

    /// The reason, and what is contradictory in print; may be empty.
    pub fn remarks(&self) -> String {
        let note = self.printed.as_ref().map_or("", |printed| printed.note.as_str());
        let in_print = if note.is_empty() { String::new() } else { format!("in print: {note}") };
        let parts = [self.reason.clone(), in_print];
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
    }
}

impl ReproducedItem {
    /// An item with all printed numbers and none of ours.
    pub fn new(printed: PrintedItem, source: impl Into<String>) -> Self {
        let row = |value: PrintedValue| ReproducedRow {
            name: value.name.clone(),
            unit: value.unit.clone(),
            printed: Some(value),
            ours: None,
            reason: String::new(),
        };
        Self {
            heading: format!("{} ({})", printed.name, printed.place),
            id: printed.id,
            title: printed.title,
            source: source.into(),
            commands: Vec::new(),
            rows: printed.values.into_iter().map(row).collect(),
            figures: Vec::new(),
            seconds: 0.0,
        }
    }

    /// Sets our number beside the printed one with this identifier. A number that is not finite counts as missing.
    ///
    /// # Panics
    /// If the item prints no number with this identifier.
    pub fn set(&mut self, id: &str, ours: Option<f64>, reason: &str) {
        let of_id = |row: &&mut ReproducedRow| row.printed.as_ref().is_some_and(|printed| printed.id == id);
        let row = self.rows.iter_mut().find(of_id);
        assert!(row.is_some(), "{} prints no number \"{id}\"", self.heading);
        if let Some(row) = row {
            row.ours = ours.filter(|ours| ours.is_finite());
            reason.clone_into(&mut row.reason);
        }
    }

    /// The printed number with this identifier.
    pub fn printed(&self, id: &str) -> Option<f64> {
        let values = self.rows.iter().filter_map(|row| row.printed.as_ref());
        values.filter(|printed| printed.id == id).map(PrintedValue::value).next()
    }

    /// Adds a number of ours that the paper does not print.
    pub fn add(&mut self, name: impl Into<String>, unit: &str, ours: Option<f64>) {
        self.add_remarked(name, unit, ours, "");
    }

    /// Adds a number of ours that the paper does not print, with a remark, which may be empty.
    pub fn add_remarked(&mut self, name: impl Into<String>, unit: &str, ours: Option<f64>, remark: &str) {
        let ours = ours.filter(|ours| ours.is_finite());
        let (unit, reason) = (unit.to_owned(), remark.to_owned());
        self.rows.push(ReproducedRow { name: name.into(), unit, printed: None, ours, reason });
    }

    /// Gives all numbers that need a reason and have none this one.
    pub fn explain(&mut self, reason: &str) {
        for row in self.rows.iter_mut().filter(|row| !row.is_explained()) {
            reason.clone_into(&mut row.reason);
        }
    }

    /// Gives all printed numbers that have no reason this one, also those that equal ours: if they come from other data or from
    /// simulated participants, being equal is a coincidence.
    pub fn explain_all(&mut self, reason: &str) {
        for row in self.rows.iter_mut().filter(|row| row.printed.is_some() && row.reason.is_empty()) {
            reason.clone_into(&mut row.reason);
        }
    }

    /// Names of the numbers that differ without a reason.
    pub fn unexplained(&self) -> Vec<&str> {
        self.rows.iter().filter(|row| !row.is_explained()).map(|row| row.name.as_str()).collect()
    }
}

impl Reproduction {
    /// First part of the names of an item's files.
    fn stem(&self, item: &ReproducedItem) -> String {
        format!("{}-{}", self.paper.id(), item.id)
    }

    /// Name of the table of an item's numbers; `None` without numbers.
    pub fn table_file(&self, item: &ReproducedItem) -> Option<String> {
        (!item.rows.is_empty()).then(|| format!("{}.csv", self.stem(item)))
    }

    /// Names of an item's figures without their endings, in order.
    pub fn figure_names(&self, item: &ReproducedItem) -> Vec<String> {
        item.figures.iter().map(|(name, _)| format!("{}-{name}", self.stem(item))).collect()
    }

    /// Name of the page.
    pub fn page_file(&self) -> String {
        page_file(self.paper)
    }

    /// Names of an item's files: the table of its numbers, then its figures.
    fn files(&self, item: &ReproducedItem) -> Vec<String> {
        let figures = self.figure_names(item).into_iter();
        self.table_file(item).into_iter().chain(figures.map(|name| format!("{name}.svg"))).collect()
    }
}

/// Name of the page of a paper.
pub fn page_file(paper: Paper) -> String {
    format!("{}.md", paper.id())
}

/// Header of the table of an item.
const COLUMNS: [&str; 8] =
    ["quantity", "unit", "printed", "ours", "difference", "tolerance", "remarks", "source"];

/// Writes the numbers of an item as CSV, one on each line; a missing number is empty.
pub fn reproduction_csv(item: &ReproducedItem) -> Vec<u8> {
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value}"));
    let row = |row: &ReproducedRow| {
        let printed = row.printed.as_ref();
        vec![
            row.name.clone(),
            row.unit.clone(),
            printed.map_or_else(String::new, |printed| printed.printed.clone()),
            number(row.ours),
            number(row.difference()),
            number(printed.map(|printed| printed.tolerance)),
            row.remarks(),
            item.source.clone(),
        ]
    };
    write_table(std::iter::once(COLUMNS.map(str::to_owned).to_vec()).chain(item.rows.iter().map(row)))
}

/// Returns whether bytes are a table written by [`reproduction_csv`].
pub fn is_reproduction_csv(bytes: &[u8]) -> bool {
    bytes.split(|byte| *byte == b'\n').next() == Some(COLUMNS.join(",").as_bytes())
}

/// Returns the report of several papers as one JSON object. `has_files` states whether the files were written.
pub fn reproduction_report(all: &[Reproduction], has_files: bool) -> Value {
    let items: Vec<Value> = all.iter().flat_map(|of| items_json(of, has_files)).collect();
    let papers: Vec<Value> = all.iter().map(paper_json).collect();
    json!({"format": FORMAT, "version": VERSION, "papers": papers, "items": items})
}

fn paper_json(of: &Reproduction) -> Value {
    let item = |item: &ReproducedItem| {
        json!({
            "id": item.id,
            "heading": item.heading,
            "title": item.title,
            "source": item.source,
            "commands": item.commands,
            "seconds": item.seconds,
        })
    };
    json!({
        "paper": of.paper.id(),
        "title": of.paper.title(),
        "command": of.command,
        "seed": of.seed,
        "full": of.is_full,
        "seconds": of.seconds,
        "tables_and_figures": of.items.iter().map(item).collect::<Vec<_>>(),
    })
}

/// One object for each number; an item without numbers has one without them.
fn items_json(of: &Reproduction, has_files: bool) -> Vec<Value> {
    let of_item = |item: &ReproducedItem| -> Vec<Value> {
        let files = if has_files { of.files(item) } else { Vec::new() };
        let row = |name: &str, row: Option<&ReproducedRow>| {
            let printed = row.and_then(|row| row.printed.as_ref());
            json!({
                "paper": of.paper.id(),
                "item": item.id,
                "name": name,
                "unit": row.map(|row| row.unit.as_str()),
                "printed": printed.map(PrintedValue::value),
                "ours": row.and_then(|row| row.ours),
                "difference": row.and_then(ReproducedRow::difference),
                "tolerance": printed.map(|printed| printed.tolerance),
                "equal": row.and_then(ReproducedRow::is_equal),
                "reason": row.map(ReproducedRow::remarks),
                "source": item.source,
                "files": files,
            })
        };
        if item.rows.is_empty() {
            return vec![row(&item.heading, None)];
        }
        let named = |of_row: &ReproducedRow| row(&format!("{}: {}", item.heading, of_row.name), Some(of_row));
        item.rows.iter().map(named).collect()
    };
    of.items.iter().flat_map(of_item).collect()
}

/// Returns the numbers of a paper as lines of text for a terminal.
pub fn reproduction_text(of: &Reproduction) -> String {
    let mut lines = vec![format!("{}: {}", of.paper.id(), of.paper.title())];
    for item in &of.items {
        lines.push(String::new());
        lines.push(format!("{}: {}", item.heading, item.title));
        lines.push(format!("  ours: {}", item.source));
        for row in &item.rows {
            let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
            let remarks = row.remarks();
            let remarks = if remarks.is_empty() { remarks } else { format!("  ({remarks})") };
            lines.push(format!(
                "  {}: printed {}, ours {}{unit}{remarks}",
                row.name,
                row.printed_text(),
                row.ours_text()
            ));
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests;
