use std::sync::Arc;

use shagreen_core::people::sorting::similarity;
use shagreen_core::people::study::analysis::discrimination::{discriminability, discriminations};
use shagreen_core::people::study::analysis::rating::ratings;
use shagreen_core::people::study::analysis::relevance::votes;
use shagreen_core::people::study::analysis::sorting::sorts;
use shagreen_core::people::study::answer::{Answer, Measured, Motion, Record, Response, SetupFrom};
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::same_different::{Correction, Counts};
use shagreen_core::people::study::setup::{OutputDevice, ScreenScale, Setup};
use shagreen_core::people::study::simulated::{Observers, World, simulated_study};
use shagreen_core::people::study::trial::{Task, Trial};

use super::{COLUMNS, pairs_csv, tidy_csv};
use crate::named_table::NamedTable;
use crate::ratings_csv::{ratings_csv, read_ratings_csv, read_relevance_csv, relevance_csv};
use crate::sorting_csv::{read_sorting_csv, sorting_csv};
use crate::study_plan::{read_study_plan, study_template};

fn plan_of(id: &str) -> Plan {
    read_study_plan(study_template(id).unwrap().text.as_bytes()).unwrap()
}

/// A built-in plan with the answers of simulated participants.
fn simulated(id: &str, n: usize) -> (Plan, Vec<Record>) {
    let plan = plan_of(id);
    let world = World::invented(&plan, 3);
    let records = simulated_study(&Arc::new(plan.clone()), &world, &Observers::usual(), n, 1).unwrap();
    (plan, records)
}

/// Fields of each row by the names of the columns.
fn fields(bytes: &[u8], columns: &[&str]) -> Vec<Vec<String>> {
    let table = NamedTable::read(bytes, "participant", "value").unwrap();
    let columns: Vec<usize> = columns.iter().map(|column| table.need(&[*column]).unwrap()).collect();
    table.rows().map(|row| columns.iter().map(|column| row.at(*column).text().to_owned()).collect()).collect()
}

#[test]
fn every_value_has_a_row() {
    for (id, n_rows) in [
        ("cluster-sorting", 3 * 25),
        ("adjective-relevance", 25 * 25),
        ("bipolar-rating", 27 * 5),
        ("authored-dissimilarity", 4 + 2 * 39),
        ("reconstruction-similarity", 24 + 56),
        ("text-to-texture", (1 + 15) * 5),
        ("abx", 2 + 48),
        ("anchor-rating", 2 + 16),
    ] {
        let (plan, records) = simulated(id, 1);
        let rows = fields(
            &tidy_csv(&plan, &records),
            &["participant", "simulated", "design", "value", "response_s"],
        );
        assert_eq!(rows.len(), n_rows, "{id}");
        for row in rows {
            assert_eq!((row[0].as_str(), row[1].as_str()), ("simulated-01", "1"));
            assert!(
                row[2] == plan.parts[0].design.id() && !row[3].is_empty() && !row[4].is_empty(),
                "{row:?}"
            );
        }
    }
}

#[test]
fn a_row_says_what_was_presented_and_measured() {
    let task = Task::Place { stimulus: "cork".to_owned(), low: "glass".to_owned(), high: "brick".to_owned() };
    let trial = Trial { part: "roughness".to_owned(), number: 3, is_practice: false, seed: 1, task };
    let measured = Measured {
        response_secs: Some(2.5),
        motion: Some(Motion { distance_m: 0.5, mean_speed_mps: 0.125, mean_force_n: 0.75 }),
        touched_m: vec![0.25, 0.125, 0.125],
        latency_secs: Some(0.015_625),
        device: "haptuator, mark ii".to_owned(),
        stimulus_hashes: vec!["ab".to_owned(), "cd".to_owned()],
        n_plays: vec![1, 2, 3],
    };
    let answer = Answer { trial, response: Response::Sliders(vec![42.5]), measured };
    let other = Answer { trial: Trial { part: "gone".to_owned(), ..answer.trial.clone() }, ..answer.clone() };
    let silent = Setup {
        output: None,
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.8 },
        program: "shagreen test".to_owned(),
    };
    let full = Setup {
        output: Some(OutputDevice { id: "usb".to_owned(), name: "USB Audio".to_owned() }),
        actuator: Some("mark-ii".to_owned()),
        masking: Some("Headphones".to_owned()),
        pen: Some("Pen".to_owned()),
        screen: ScreenScale::Measured { pixels_per_mm: 5.0 },
        program: "shagreen test".to_owned(),
    };
    let record = Record {
        participant: "p01".to_owned(),
        number: 1,
        is_simulated: false,
        answers: vec![answer.clone(), other, answer.clone(), answer],
        setups: vec![
            SetupFrom { first_answer: 2, setup: Some(silent) },
            SetupFrom { first_answer: 3, setup: Some(full) },
        ],
    };
    let text = String::from_utf8(tidy_csv(&plan_of("anchor-rating"), &[record])).unwrap();
    let row = "p01,1,0,roughness,anchors,3,0,cork,glass|brick,,,42.5,,2.5,15.625,500,125,0.75,250 125 125,1 2 3,\"haptuator, mark ii\",ab cd";
    let expected = format!(
        "{}\n{row},,,,,,\n{row},no output,none,none,pointer,assumed,shagreen test\n{row},USB Audio,mark-ii,Headphones,Pen,measured,shagreen test\n",
        COLUMNS.join(",")
    );
    assert_eq!(text, expected);
}

/// The pooled answers of each pair, with what was done to the processed stimulus.
#[test]
fn discriminated_pairs_are_a_table_of_counts_and_d_prime() {
    let (plan, records) = simulated("same-different", 3);
    let csv = pairs_csv(&plan, &records).unwrap();
    let table = NamedTable::read(&csv, "reference", "processed").unwrap();
    let column = |name: &str| table.need(&[name]).unwrap();
    let rows: Vec<Vec<String>> = table
        .rows()
        .map(|row| {
            [
                "part",
                "reference",
                "processed",
                "reference_source",
                "variant",
                "kbps",
                "participants",
                "simulated",
            ]
            .map(|name| row.at(column(name)).text().to_owned())
            .to_vec()
        })
        .collect();
    // Five textures at five bit rates.
    assert_eq!(rows.len(), 25);
    assert_eq!(rows[0], ["steel", "steel", "steel-3.15", "polished-metal", "coded", "3.15", "3", "1"]);
    for (row, of) in table.rows().zip(plan.parts.iter().flat_map(|part| discriminations(part, &records))) {
        let number = |name: &str| row.at(column(name)).text().parse::<f64>().unwrap();
        let Counts { hits, n_different, false_alarms, n_same } = of.pooled;
        let counts = ["hits", "n_different", "false_alarms", "n_same"].map(|name| number(name) as u64);
        assert_eq!(counts, [hits, n_different, false_alarms, n_same]);
        let models = discriminability(of.pooled, Correction::LogLinear).unwrap();
        let expected = [models.yes_no, models.differencing, models.independent_observation];
        assert_eq!(["dprime", "dprime_differencing", "dprime_independent_observation"].map(number), expected);
        let rates = of.pooled.rates(Correction::LogLinear).unwrap();
        assert_eq!(["hit_rate", "false_alarm_rate"].map(number), [rates.hit, rates.false_alarm]);
    }
    let (plan, records) = simulated("abx", 2);
    assert_eq!(pairs_csv(&plan, &records), None, "no part asks for same or different");
}

/// A pair without answers has a row, but no rates.
#[test]
fn a_pair_without_answers_has_no_d_prime() {
    let (plan, _) = simulated("same-different", 1);
    let text = String::from_utf8(pairs_csv(&plan, &[]).unwrap()).unwrap();
    let first = text.lines().nth(1).unwrap();
    assert!(first.ends_with(",0,0,0,0,0,,,,,,"), "{first}");
}

#[test]
fn right_answers_are_marked_where_there_are_any() {
    let (plan, records) = simulated("gap-detection", 1);
    let rows = fields(&tidy_csv(&plan, &records), &["presented", "value", "right", "practice"]);
    assert!(rows.iter().all(|row| ["0", "1"].contains(&row[2].as_str())));
    assert!(
        rows.iter()
            .all(|row| row[0].parse::<f64>().is_ok() && ["first", "second"].contains(&row[1].as_str()))
    );
    assert_eq!(rows.iter().filter(|row| row[3] == "1").count(), 3);
    let (plan, records) = simulated("mushra", 1);
    let rows = fields(&tidy_csv(&plan, &records), &["presented", "right"]);
    // Three pages, each twice, and one of practice.
    assert_eq!(rows.iter().filter(|row| row[0] == "hidden reference").count(), 7);
    assert!(rows.iter().all(|row| row[1].is_empty()));
}

/// The tables from which a space is built are written and read by the formats that exist already.
#[test]
fn a_study_becomes_the_tables_of_a_space() {
    let (plan, records) = simulated("cluster-sorting", 4);
    let of_study = sorts(&plan, &plan.parts[0], &records);
    let table = read_sorting_csv(&sorting_csv(&of_study)).unwrap();
    assert_eq!((table.sorts.len(), table.textures.len()), (12, 25));
    assert_eq!(table.sorts, of_study);
    assert!(similarity(&table.textures, &table.sorts).is_ok());
    let (plan, records) = simulated("bipolar-rating", 4);
    let of_study = ratings(&plan, &plan.parts[0], &records);
    assert_eq!(of_study.len(), 4 * 25 * 5);
    assert_eq!(read_ratings_csv(&ratings_csv(&of_study)), Ok(of_study));
    let (plan, records) = simulated("adjective-relevance", 2);
    let of_study = votes(&plan, &plan.parts[0], &records);
    assert_eq!(of_study.len(), 2 * 25 * 25);
    assert_eq!(read_relevance_csv(&relevance_csv(&of_study)), Ok(of_study));
}
