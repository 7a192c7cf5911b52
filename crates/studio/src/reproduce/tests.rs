use super::{Extent, ReproduceOptions, reproduce};
use crate::report::Warnings;
use shagreen_formats::figure::Figure;
use shagreen_formats::printed_results::{Paper, printed_results};
use shagreen_formats::reproduction_report::{ReproducedRow, Reproduction};

fn options() -> ReproduceOptions<'static> {
    ReproduceOptions {
        library: None,
        judgments: None,
        backbone: None,
        is_full: false,
        extent: Extent::small(),
        seed: 1,
        command: "test".to_owned(),
    }
}

/// So little that it takes seconds. The numbers mean nothing, but all tables and figures are there.
fn small(paper: Paper) -> Reproduction {
    reproduce(paper, &options(), &mut |_| true, &Warnings::default()).unwrap()
}

/// Every printed number stands in exactly one table, and every difference beyond its tolerance has a reason.
fn check(of: &Reproduction) {
    let rows = || of.items.iter().flat_map(|item| &item.rows);
    for printed in printed_results(of.paper).unwrap() {
        let item: Vec<_> = of.items.iter().filter(|item| item.id == printed.id).collect();
        assert_eq!(item.len(), 1, "{}", printed.id);
        for value in &printed.values {
            let is_shown = |row: &&ReproducedRow| row.printed.as_ref() == Some(value);
            assert_eq!(item[0].rows.iter().filter(is_shown).count(), 1, "{}: {}", printed.id, value.id);
        }
    }
    let n_printed: usize = printed_results(of.paper).unwrap().iter().map(|item| item.values.len()).sum();
    assert_eq!(rows().filter(|row| row.printed.is_some()).count(), n_printed);
    for item in &of.items {
        assert!(item.unexplained().is_empty(), "{}: {:?}", item.id, item.unexplained());
        assert!(!item.source.is_empty(), "{}", item.id);
        for (name, figure) in &item.figures {
            assert!(figure.title().contains('('), "{} {name}: the figure states no source", item.id);
        }
    }
}

/// Sources and figures of an item that simulated participants judged say so.
fn is_called_simulated(of: &Reproduction, ids: &[&str]) {
    for id in ids {
        let item = of.items.iter().find(|item| item.id == *id).unwrap();
        assert!(item.source.to_lowercase().contains("simulated"), "{id}: {}", item.source);
        for (name, figure) in &item.figures {
            assert!(figure.title().to_lowercase().contains("simulated"), "{id} {name}: {}", figure.title());
        }
    }
}

/// The rows of Table I and its figure show the same correlations, and say that their signs are arbitrary.
fn the_correlations_have_one_sign(of: &Reproduction) {
    let table = of.items.iter().find(|item| item.id == "table-1").unwrap();
    let [(_, Figure::Table(figure))] = &table.figures[..] else { panic!("a table of correlations") };
    for (pair, values) in &figure.rows {
        for (dimension, shown) in (1..=2).zip(values) {
            let name = format!("{pair}, dimension {dimension}");
            let row = table.rows.iter().find(|row| row.name == name).unwrap();
            assert_eq!(row.ours, *shown, "{name}");
            assert!(row.reason.starts_with("signs, order and rotation"), "{row:?}");
        }
    }
}

#[test]
fn the_authoring_paper_has_all_tables_and_figures() {
    let of = small(Paper::S0);
    check(&of);
    let simulated =
        ["figure-4", "figure-5", "table-1", "selection", "figure-6", "figure-7", "figure-8", "table-2"];
    is_called_simulated(&of, &simulated);
    the_correlations_have_one_sign(&of);
    let row =
        of.items.iter().flat_map(|item| &item.rows).find(|row| row.name.starts_with("authored textures"));
    assert!(row.unwrap().reason.contains("unlike the rows above"), "{row:?}");
    assert!(of.items.iter().any(|item| item.id == "figure-8" && item.figures.len() == 2));
    // A reason does not come by itself.
    let mut table = of.items.iter().find(|item| item.id == "table-1").unwrap().clone();
    let row = table.rows.iter_mut().find(|row| row.printed.is_some()).unwrap();
    (row.ours, row.reason) = (Some(-9.0), String::new());
    assert_eq!(table.unexplained().len(), 1);
}

#[test]
fn the_paper_on_texts_has_all_tables_and_says_what_was_not_trained() {
    let of = small(Paper::S1);
    check(&of);
    is_called_simulated(&of, &["figure-4", "table-1"]);
    let table = of.items.iter().find(|item| item.id == "table-1").unwrap();
    let of_method = |name: &str| {
        let rows = table.rows.iter().filter(|row| row.printed.is_some() && row.name.starts_with(name));
        rows.collect::<Vec<_>>()
    };
    for rival in ["Visual-CNN", "VisionNet", "1D-CNN"] {
        let rows = of_method(rival);
        assert!(rows.len() == 4 && rows.iter().all(|row| row.ours.is_none()), "{rival}");
        assert!(rows.iter().all(|row| row.reason.starts_with("not trained; --full")), "{rival}");
    }
    for row in of_method("AttributeNet") {
        assert!(row.ours.is_some() && row.reason.contains("in the paper, features by ResNet-50"), "{row:?}");
    }
    for name in ["ratings of a participant", "averages over the texts, of all eleven participants"] {
        let row = of.items.iter().flat_map(|item| &item.rows).find(|row| row.name == name).unwrap();
        assert_eq!(row.is_equal(), Some(true), "{row:?}");
    }
}

#[test]
fn the_paper_on_strokes_has_all_tables_and_the_sizes_of_its_network() {
    let of = small(Paper::S2);
    check(&of);
    is_called_simulated(&of, &["figure-5"]);
    let sizes = of.items.iter().find(|item| item.id == "sizes").unwrap();
    let equal = |row: &&ReproducedRow| row.is_equal() == Some(true);
    assert_eq!(sizes.rows.iter().filter(equal).count(), 4, "{sizes:?}");
    let table = of.items.iter().find(|item| item.id == "table-3").unwrap();
    let n_ours = table.rows.iter().filter(|row| row.printed.is_some() && row.ours.is_some()).count();
    assert_eq!(n_ours, 5, "only linear regression needs no training");
}

#[test]
fn the_paper_on_quality_has_all_tables_and_the_numbers_of_its_design() {
    let of = small(Paper::S3);
    check(&of);
    is_called_simulated(&of, &["trials", "figure-2", "figure-4", "selections"]);
    for id in ["rates", "trials"] {
        let item = of.items.iter().find(|item| item.id == id).unwrap();
        assert!(item.rows.iter().all(|row| row.is_equal() == Some(true)), "{item:?}");
    }
    let figure = of.items.iter().find(|item| item.id == "figure-4").unwrap();
    assert_eq!(figure.figures.len(), 5 + 1, "each texture, and the fits of all of them");
    // An improvement over nothing is no number.
    let rows = of.items.iter().flat_map(|item| &item.rows);
    let shares = rows.filter(|row| row.printed.is_some() && row.name.starts_with("R²"));
    assert!(shares.filter_map(|row| row.ours).all(|ours| (0.0..=1.0).contains(&ours)));
}

#[test]
fn the_paper_on_spectrograms_has_all_figures_and_the_same_seed_gives_the_same_numbers() {
    let of = small(Paper::S4);
    check(&of);
    is_called_simulated(&of, &["figure-2"]);
    let numbers = |of: &Reproduction| {
        let rows = of.items.iter().flat_map(|item| &item.rows);
        rows.map(|row| (row.name.clone(), row.ours)).collect::<Vec<_>>()
    };
    assert_eq!(numbers(&of), numbers(&small(Paper::S4)));
    for name in ["pairs of a texture and a reconstruction", "trials of a participant", "trials of practice"] {
        let row = of.items.iter().flat_map(|item| &item.rows).find(|row| row.name == name).unwrap();
        assert_eq!(row.is_equal(), Some(true), "{row:?}");
    }
    // As `shagreen spatial analyse B.csv --window 20 --window 2` says.
    let rows = || of.items.iter().flat_map(|item| &item.rows);
    for (window, r) in [("20", 0.08), ("2", 0.98)] {
        let name = format!("correlation of texture B and its reconstruction, window of {window} mm");
        let ours = rows().find(|row| row.name == name).and_then(|row| row.ours).unwrap();
        assert!((ours - r).abs() < 0.006, "{name}: {ours}");
    }
    let rating = of.items.iter().flat_map(|item| &item.rows).find(|row| row.name.starts_with("rating"));
    assert_eq!(rating.unwrap().ours, None, "only people can rate");
}

#[test]
fn the_work_can_be_ended() {
    let error = reproduce(Paper::S4, &options(), &mut |_| false, &Warnings::default()).unwrap_err();
    assert!(error.to_string().contains("was ended"), "{error}");
}
