use super::{
    ItemCounts, ReproducedItem, ReproducedRow, Reproduction, is_reproduction_csv, is_reproduction_page,
    reproduction_csv, reproduction_index, reproduction_page, reproduction_report, reproduction_text,
};
use crate::figure::{Figure, Table};
use crate::printed_results::{Paper, printed_results};

/// The second table of the authoring paper, with scores beside the first two.
fn item() -> ReproducedItem {
    let printed = printed_results(Paper::S0).unwrap().into_iter().find(|item| item.id == "table-2").unwrap();
    let mut item = ReproducedItem::new(printed, "SIMULATED participants");
    item.set("pair-1", Some(0.96), "");
    item.set("pair-2", Some(0.5), "");
    item.add("mean | of <ours>", "dB", Some(-0.000_1));
    item.add("count", "", Some(1_368_581.0));
    item
}

fn reproduction(item: ReproducedItem) -> Reproduction {
    Reproduction {
        paper: Paper::S0,
        items: vec![item],
        command: "shagreen reproduce S0".to_owned(),
        seed: 1,
        is_full: false,
        seconds: 1.3,
    }
}

#[test]
fn a_difference_beyond_the_tolerance_needs_a_reason() {
    let mut item = item();
    assert_eq!(item.rows[0].difference().map(|d| (d * 1e6).round()), Some(-10_000.0));
    assert_eq!((item.rows[0].is_equal(), item.rows[1].is_equal()), (Some(true), Some(false)));
    // Numbers that are missing need a reason as well; those that the paper does not print need none.
    assert_eq!(item.unexplained(), ["A6-S6", "A10-S10", "A11-S11", "A19-S19", "A25-S25", "average"]);
    item.set("pair-2", Some(0.5), "other surfaces");
    item.explain("not computed");
    assert!(item.unexplained().is_empty());
    assert_eq!((item.rows[0].reason.as_str(), item.rows[1].reason.as_str()), ("", "other surfaces"));
    assert_eq!(item.rows[2].reason, "not computed");
    // What is contradictory in print is no reason.
    let mean = &item.rows[6];
    assert!(mean.remarks().starts_with("not computed; in print: the mean of the six"), "{}", mean.remarks());
    item.set("mean", Some(f64::NAN), "");
    assert_eq!((item.rows[6].ours, item.rows[6].is_explained()), (None, false));
    assert_eq!((item.printed("pair-1"), item.printed("none")), (Some(0.97), None));
}

/// A number that equals the printed one by coincidence keeps the remark on its data; numbers of ours alone have none of it.
#[test]
fn a_remark_on_the_data_stays_on_equal_numbers() {
    let mut item = item();
    item.set("pair-2", Some(0.5), "other surfaces");
    item.explain_all("simulated");
    let reasons: Vec<&str> = item.rows.iter().map(|row| row.reason.as_str()).collect();
    assert_eq!(reasons[..3], ["simulated", "other surfaces", "simulated"]);
    assert_eq!((reasons[7], item.rows[0].is_equal()), ("", Some(true)));
    item.add_remarked("score", "", Some(1.034), "above 1");
    assert_eq!(item.rows.last().map(ReproducedRow::remarks).as_deref(), Some("above 1"));
}

/// The printed 0.2 and ours of 0.178 are not the same number.
#[test]
fn ours_has_one_digit_more_than_printed() {
    let mut item = item();
    item.set("pair-1", Some(0.9684), "");
    assert_eq!(item.rows[0].ours_text(), "0.968");
    let figure = printed_results(Paper::S0).unwrap().into_iter().find(|item| item.id == "figure-8").unwrap();
    let mut figure = ReproducedItem::new(figure, "");
    for (ours, text) in [(36.0, "36"), (35.5, "35.5")] {
        figure.set("pairs", Some(ours), "");
        assert_eq!(figure.rows[0].ours_text(), text);
    }
}

/// The edge of a tolerance belongs to it, although 0.92 - 0.97 is not exact.
#[test]
fn the_edge_of_a_tolerance_is_equal() {
    let mut item = item();
    item.set("pair-1", Some(0.92), "");
    assert_eq!(item.rows[0].is_equal(), Some(true));
    item.set("pair-1", Some(0.9199), "");
    assert_eq!(item.rows[0].is_equal(), Some(false));
    assert_eq!(item.rows[0].tolerance_text(), "0.05");
    item.add("not printed", "", Some(1.0));
    assert_eq!(item.rows.last().unwrap().tolerance_text(), "\u{2013}");
}

#[test]
#[should_panic(expected = "prints no number \"pair-9\"")]
fn a_number_that_is_not_printed_is_noticed() {
    item().set("pair-9", None, "");
}

#[test]
fn the_table_and_the_page_have_every_number() {
    let mut item = item();
    item.set("pair-2", Some(0.5), "other surfaces");
    let table = Table {
        title: "Scores".to_owned(),
        columns: vec!["score".to_owned()],
        rows: vec![("one".to_owned(), vec![Some(1.0)])],
        decimals: 2,
        n_counts: 0,
        source: String::new(),
    };
    item.figures.push(("scores".to_owned(), Figure::Table(table)));
    let csv = String::from_utf8(reproduction_csv(&item)).unwrap();
    assert!(is_reproduction_csv(csv.as_bytes()) && !is_reproduction_csv(b"quantity,unit\n"));
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 1 + 7 + 2);
    assert!(lines[2].starts_with("A6-S6,,0.89,0.5,-0.39"), "{}", lines[2]);
    assert!(lines[2].ends_with("0.05,other surfaces,SIMULATED participants"), "{}", lines[2]);
    assert!(lines[8].starts_with("mean | of <ours>,dB,,-0.0001,,,,"), "{}", lines[8]);

    let of = reproduction(item);
    let page = reproduction_page(&of);
    assert!(is_reproduction_page(page.as_bytes()) && !is_reproduction_page(b"# S0"));
    for words in [
        "| A6-S6 | 0.89 | 0.500 | -0.390 | 0.05 | other surfaces |",
        "| A2-S2 | 0.97 | 0.960 | -0.010 | 0.05 |  |",
        "| A19-S19 | 1.00 | \u{2013} | \u{2013} | 0.05 |",
        "| mean \\| of &lt;ours>, dB | \u{2013} | 0.000 |",
        "| count | \u{2013} | 1368581 |",
        "](S0-table-2-scores.svg)",
        "`shagreen reproduce S0`; seed 1; without long training; 1.3 s",
    ] {
        assert!(page.contains(words), "{words}\n{page}");
    }
    let text = reproduction_text(&of);
    assert!(text.contains("  A6-S6: printed 0.89, ours 0.500  (other surfaces)"), "{text}");
    assert!(text.contains("ours: SIMULATED participants"));
    assert_eq!(of.figure_names(&of.items[0]), ["S0-table-2-scores"]);
    assert_eq!(of.table_file(&of.items[0]).as_deref(), Some("S0-table-2.csv"));
}

#[test]
fn the_report_has_one_object_for_each_number() {
    let mut figure =
        printed_results(Paper::S0).unwrap().into_iter().find(|item| item.id == "figure-6").unwrap();
    figure.values.clear();
    let mut of = reproduction(item());
    of.items.push(ReproducedItem::new(figure, "starter library"));
    let report = reproduction_report(&[of], true);
    let items = report["items"].as_array().unwrap();
    assert_eq!(items.len(), 9 + 1);
    assert_eq!(items[1]["name"], "Table II (section VII-D): A6-S6");
    assert_eq!(
        (&items[1]["printed"], &items[1]["ours"], &items[1]["equal"]),
        (&0.89.into(), &0.5.into(), &false.into())
    );
    assert_eq!(items[1]["files"][0], "S0-table-2.csv");
    assert!(items[3]["ours"].is_null() && items[8]["printed"].is_null() && items[9]["reason"].is_null());
    assert_eq!((&report["papers"][0]["paper"], &report["papers"][0]["seed"]), (&"S0".into(), &1.into()));
    let without = reproduction_report(&[reproduction(item())], false);
    assert_eq!(without["items"][0]["files"].as_array().unwrap().len(), 0);
}

#[test]
fn the_index_leads_to_the_pages_that_exist() {
    let counts = ItemCounts {
        heading: "Table 9 (section 1)".to_owned(),
        title: "Rates".to_owned(),
        n_printed: 3,
        n_equal: 2,
        n_missing: 1,
    };
    let earlier = |paper: Paper| match paper {
        Paper::S3 => Some(vec![counts.clone()]),
        Paper::S4 => Some(Vec::new()),
        _ => None,
    };
    let index = reproduction_index(&[reproduction(item())], earlier);
    assert!(index.contains("](S4.md)\n"), "a page without a report: {index}");
    assert!(index.contains("- Table 9 (section 1): Rates. Equal: 2 of 3; without a number of ours: 1."));
    assert!(is_reproduction_page(index.as_bytes()));
    assert!(index.contains("](S0.md)") && index.contains("](S3.md)") && !index.contains("](S1.md)"));
    assert!(index.contains("Equal: 1 of 7; without a number of ours: 5."), "{index}");
    assert!(index.contains("`shagreen reproduce S1`"));
}
