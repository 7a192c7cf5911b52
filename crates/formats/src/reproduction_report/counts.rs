//! How many printed numbers of a table or figure are equal to ours, of a reproduction now or from its report.

use serde_json::Value;

use crate::printed_results::Paper;
use crate::reproduction_report::{FORMAT, ReproducedItem, ReproducedRow};

/// Counts of the printed numbers of a table or figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ItemCounts {
    /// Name in the paper, and where it stands there.
    pub heading: String,
    /// What it shows.
    pub title: String,
    /// Number of printed numbers.
    pub n_printed: usize,
    /// Those that ours do not differ from by more than the tolerance.
    pub n_equal: usize,
    /// Those without a number of ours.
    pub n_missing: usize,
}

impl ItemCounts {
    /// Counts of an item.
    pub(super) fn of(item: &ReproducedItem) -> Self {
        let printed = || item.rows.iter().filter(|row| row.printed.is_some());
        let n = |is: fn(&ReproducedRow) -> bool| printed().filter(|row| is(row)).count();
        Self {
            heading: item.heading.clone(),
            title: item.title.clone(),
            n_printed: printed().count(),
            n_equal: n(|row| row.is_equal() == Some(true)),
            n_missing: n(|row| row.ours.is_none()),
        }
    }
}

/// Returns the counts of all tables and figures of a paper from a report as JSON, in their order; `None` if it is no such report
/// or does not contain the paper.
pub fn counts_in_report(report: &Value, paper: Paper) -> Option<Vec<ItemCounts>> {
    if report.get("format")?.as_str()? != FORMAT {
        return None;
    }
    let is_of_paper = |of: &&Value| of.get("paper").and_then(Value::as_str) == Some(paper.id());
    let tables = report.get("papers")?.as_array()?.iter().find(is_of_paper)?;
    let numbers: Vec<&Value> = report.get("items")?.as_array()?.iter().filter(is_of_paper).collect();
    let counts = |table: &Value| {
        let id = table.get("id")?;
        let is_printed = |of: &&&Value| of.get("item") == Some(id) && !is_null(of, "printed");
        let n = |is: fn(&Value) -> bool| numbers.iter().filter(is_printed).filter(|of| is(of)).count();
        Some(ItemCounts {
            heading: table.get("heading")?.as_str()?.to_owned(),
            title: table.get("title")?.as_str()?.to_owned(),
            n_printed: n(|_| true),
            n_equal: n(|of| of.get("equal").and_then(Value::as_bool) == Some(true)),
            n_missing: n(|of| is_null(of, "ours")),
        })
    };
    tables.get("tables_and_figures")?.as_array()?.iter().map(counts).collect()
}

/// Whether an object has no value under this name.
fn is_null(of: &Value, name: &str) -> bool {
    of.get(name).is_none_or(Value::is_null)
}

#[cfg(test)]
mod tests {
    use super::{ItemCounts, counts_in_report};
    use crate::printed_results::{Paper, printed_results};
    use crate::reproduction_report::{ReproducedItem, Reproduction, reproduction_report};
    use serde_json::json;

    #[test]
    fn a_report_has_the_counts_of_its_reproduction() {
        let printed = printed_results(Paper::S0).unwrap();
        let mut items: Vec<ReproducedItem> =
            printed.into_iter().map(|item| ReproducedItem::new(item, "nothing")).collect();
        let scores = items.iter_mut().find(|item| item.id == "table-2").unwrap();
        scores.set("pair-1", Some(0.96), "");
        scores.set("pair-2", Some(0.5), "");
        scores.add("ours alone", "", None);
        let counts: Vec<ItemCounts> = items.iter().map(ItemCounts::of).collect();
        let of_scores = counts.iter().find(|of| of.heading.starts_with("Table II (")).unwrap();
        assert_eq!((of_scores.n_printed, of_scores.n_equal, of_scores.n_missing), (7, 1, 5));
        let of = Reproduction {
            paper: Paper::S0,
            items,
            command: String::new(),
            seed: 1,
            is_full: false,
            seconds: 0.0,
        };
        let report = reproduction_report(&[of], true);
        assert_eq!(counts_in_report(&report, Paper::S0), Some(counts));
        // Reports of other papers and other files have none.
        assert_eq!(counts_in_report(&report, Paper::S1), None);
        assert_eq!(counts_in_report(&json!({"format": "mine"}), Paper::S0), None);
        assert_eq!(counts_in_report(&json!([]), Paper::S0), None);
    }
}
