//! Pages in Markdown: one of each paper, and an index of them.

use std::fmt::Write as _;

use crate::printed_results::Paper;
use crate::reproduction_report::{ItemCounts, ReproducedItem, ReproducedRow, Reproduction, page_file};

/// First line of every page, which identifies it. Viewers do not show it.
const MARK: &str = "<!-- Written by `shagreen reproduce`. -->\n";

/// Returns whether bytes are a page written by [`reproduction_page`] or [`reproduction_index`].
pub fn is_reproduction_page(bytes: &[u8]) -> bool {
    bytes.starts_with(MARK.as_bytes())
}

/// Returns the page of a paper: all tables with the printed numbers and ours, and all figures.
pub fn reproduction_page(of: &Reproduction) -> String {
    let networks = if of.is_full { "all networks trained" } else { "without long training" };
    let mut page = format!(
        "{MARK}# {}: {}\n\nPrinted results of the paper beside ours. Command: `{}`; seed {}; {networks}; {:.1} s.\n\
         Differences beyond the tolerance have a reason. [All papers](index.md)\n",
        of.paper.id(),
        escaped(of.paper.title()),
        of.command,
        of.seed,
        of.seconds
    );
    for item in &of.items {
        section(&mut page, of, item);
    }
    page
}

/// Writing to a string cannot fail, so the results are not checked here and below.
fn section(page: &mut String, of: &Reproduction, item: &ReproducedItem) {
    let _ = writeln!(page, "\n## {}: {}\n", escaped(&item.heading), escaped(&item.title));
    let _ = writeln!(page, "Ours: {}; {:.1} s.", escaped(&item.source), item.seconds);
    for command in &item.commands {
        let _ = writeln!(page, "Alone: `{command}`.");
    }
    if !item.rows.is_empty() {
        page.push_str("\n| quantity | printed | ours | difference | equal up to | remarks |\n");
        page.push_str("|---|--:|--:|--:|--:|---|\n");
        for of_row in &item.rows {
            row(page, of_row);
        }
    }
    for ((_, figure), name) in item.figures.iter().zip(of.figure_names(item)) {
        let _ = writeln!(page, "\n![{}]({name}.svg)", escaped(&figure.title()));
    }
}

fn row(page: &mut String, row: &ReproducedRow) {
    let _ = writeln!(
        page,
        "| {} | {} | {} | {} | {} | {} |",
        escaped(&row.quantity()),
        row.printed_text(),
        row.ours_text(),
        row.difference_text(),
        row.tolerance_text(),
        escaped(&row.remarks())
    );
}

/// Returns the index: every paper with a link to its page if it was reproduced now or earlier, and otherwise with the command
/// that reproduces it. `earlier` returns the counts of a paper whose page lies in the folder already, none of them if they are
/// unknown, and `None` without a page.
pub fn reproduction_index(
    now: &[Reproduction],
    earlier: impl Fn(Paper) -> Option<Vec<ItemCounts>>,
) -> String {
    let mut page = format!(
        "{MARK}# The papers reproduced\n\nEvery page shows the printed results of a paper beside ours, and says why they differ.\n"
    );
    for paper in Paper::ALL {
        let title = format!("{}: {}", paper.id(), escaped(paper.title()));
        let file = page_file(paper);
        let of_now = now.iter().find(|of| of.paper == paper);
        let counts = match of_now {
            Some(of) => Some(of.items.iter().map(ItemCounts::of).collect()),
            None => earlier(paper),
        };
        match counts {
            Some(counts) => {
                let _ = writeln!(page, "\n## [{title}]({file})");
                if !counts.is_empty() {
                    page.push('\n');
                }
                for of in &counts {
                    let _ =
                        writeln!(page, "- {}: {}. {}", escaped(&of.heading), escaped(&of.title), summary(of));
                }
            }
            None => {
                let _ = writeln!(
                    page,
                    "\n## {title}\n\nNot yet reproduced: `shagreen reproduce {}`.",
                    paper.id()
                );
            }
        }
    }
    page
}

/// How many printed numbers are equal to ours.
fn summary(of: &ItemCounts) -> String {
    let ItemCounts { n_printed, n_equal, n_missing, .. } = of;
    match n_printed {
        0 => "Without printed numbers.".to_owned(),
        n => format!("Equal: {n_equal} of {n}; without a number of ours: {n_missing}."),
    }
}

/// Text without characters that have a meaning in Markdown tables and HTML, on one line.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '|' | '*' | '_' | '[' | ']' | '`' | '\\' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '<' => escaped.push_str("&lt;"),
            '&' => escaped.push_str("&amp;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
