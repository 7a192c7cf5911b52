//! Figures and structures of the published studies.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::{compared, part_of, record};
use crate::maths::statistics::mean;
use crate::people::study::analysis::discrimination::discriminations;
use crate::people::study::analysis::dissimilarity::{
    Normalization, References, dissimilarities, normalized_realism, realism_scores,
};
use crate::people::study::analysis::likert::grades;
use crate::people::study::analysis::mushra::{page_ratings, rejected};
use crate::people::study::analysis::similarity::similarity_cells;
use crate::people::study::answer::Response;
use crate::people::study::order::Order;
use crate::people::study::plan::{Comparison, Design, Part, Plan, Variant};
use crate::people::study::simulated::{Observers, World, simulated_study};
use crate::people::study::test_plans::{all_designs, likert, part, plan_of, stimulus};
use crate::people::study::trial::Task;

/// Dissimilarities of figure 8 of the authoring paper, from its references (0.025 and 0.045 for identical stimuli, 0.99 for
/// the most different ones) and table II; the table has two decimals.
const DISSIMILARITIES: [f64; 6] = [0.064, 0.140, 0.102, 0.092, 0.035, 0.159];
/// Normalized realism scores of table II.
const TABLE: [f64; 6] = [0.97, 0.89, 0.93, 0.94, 1.00, 0.87];
const REFERENCES: References = References { lowest: 0.035, highest: 0.99 };

#[test]
fn table_2_of_the_authoring_paper() {
    let scores = DISSIMILARITIES.map(|dissimilarity| normalized_realism(dissimilarity, REFERENCES));
    for (score, printed) in scores.iter().zip(TABLE) {
        // Half a unit of the last printed digit, and half a unit of the dissimilarities.
        assert!((score - printed).abs() < 0.0056, "{score}, not {printed}");
    }
    assert!((REFERENCES.lowest - 0.5 * (0.025 + 0.045)).abs() < 1e-12);
    // The paper states a mean of 0.94; its table and these scores have 0.933.
    assert!((mean(&scores) - 0.933).abs() < 0.0005, "{}", mean(&scores));
    assert!((mean(&TABLE) - 0.9333).abs() < 0.0001 && (mean(&TABLE) - 0.94).abs() > 0.005);
}

/// The table from answers: one participant whose normalized answers are the dissimilarities.
#[test]
fn table_2_from_answers() {
    let names = ["s2", "s6", "s10", "s11", "s19", "s25"];
    let pairs: Vec<Comparison> =
        names.iter().map(|name| Comparison::new(*name, format!("{name}-authored"))).collect();
    let design = Design::Dissimilarity { pairs, reference: Some(Comparison::new("s7", "s13")) };
    let mut plan = plan_of(vec![part("a", design)]);
    plan.stimuli = names
        .iter()
        .flat_map(|name| {
            [stimulus(name, Variant::Original), stimulus(&format!("{name}-authored"), Variant::Authored)]
        })
        .chain(["s7", "s13"].map(|name| stimulus(name, Variant::Original)))
        .collect();
    // The scale of the participant's own: 500 times the published one.
    let unit = |value: f64| 500.0 * value;
    let mut answers: Vec<_> = names
        .iter()
        .zip(DISSIMILARITIES)
        .map(|(name, value)| compared(name, &format!("{name}-authored"), unit(value)))
        .collect();
    answers.extend([
        compared("s7", "s13", unit(0.99)),
        compared("s7", "s7", unit(0.025)),
        compared("s13", "s13", unit(0.045)),
    ]);
    let found = dissimilarities(&plan.parts[0], &[record("p1", answers)], Normalization::Maximum).unwrap();
    let references = found.references.unwrap();
    assert!((references.lowest - 0.035 / 0.99).abs() < 1e-12 && (references.highest - 1.0).abs() < 1e-12);
    let scores = realism_scores(&plan, &found);
    assert_eq!(scores.len(), 6);
    for ((pair, score), printed) in scores.iter().zip(TABLE) {
        assert!((score - printed).abs() < 0.0056, "{}: {score}, not {printed}", pair.name());
    }
}

/// Eleven participants, five prompts, three conditions, five statements: 75 ratings each, 165 values after averaging.
#[test]
fn the_questionnaire_has_75_ratings_a_person_and_165_values() {
    let plan = Arc::new(plan_of(vec![Part { order: Order::LatinSquare, ..part("a", likert()) }]));
    let mut world = World::invented(&plan, 3);
    for (id, share) in [("txt-t", 0.37), ("txt-ti", 0.59), ("txt-tis", 0.79)] {
        world.conditions.insert(id.to_owned(), share);
    }
    let records = simulated_study(&plan, &world, &Observers::usual(), 11, 2).unwrap();
    let found = grades(&plan.parts[0], &records);
    assert_eq!(found.iter().map(|of| of.cells.n_values()).sum::<usize>(), 165);
    for row in 0..11 {
        assert_eq!(found.iter().map(|of| of.cells.n_answers_of(row)).sum::<usize>(), 75);
        assert_eq!(found.iter().map(|of| of.cells.values[row].iter().flatten().count()).sum::<usize>(), 15);
    }
    for of in &found {
        let means: Vec<f64> = of.cells.averages().iter().filter_map(|average| average.mean).collect();
        assert!(means[0] < means[1] && means[1] < means[2], "{}: {means:?}", of.statement);
    }
}

/// Three segments, six repeats and eight participants give 144 trials of each kind for each pair; 180 trials for each
/// texture and participant.
#[test]
fn same_different_has_144_trials_of_each_kind() {
    let versions = [1.75, 2.15, 2.45, 2.75, 3.15];
    let id = |kbps: f64| format!("steel-{kbps}");
    let pairs = versions.map(|kbps| Comparison::new("steel", id(kbps))).to_vec();
    let mut plan =
        plan_of(vec![Part { n_repeats: 6, ..part("a", Design::SameDifferent { pairs, n_segments: 3 }) }]);
    plan.stimuli = [stimulus("steel", Variant::Original)]
        .into_iter()
        .chain(versions.map(|kbps| stimulus(&id(kbps), Variant::Coded { kbps })))
        .collect();
    let plan = Arc::new(plan);
    let world = World::invented(&plan, 3);
    let records = simulated_study(&plan, &world, &Observers::usual(), 8, 1).unwrap();
    assert!(records.iter().all(|record| record.answers.len() == 180));
    for of_pair in discriminations(&plan.parts[0], &records) {
        assert_eq!((of_pair.pooled.n_different, of_pair.pooled.n_same), (144, 144));
    }
}

/// Four textures and seven windows: 24 trials of practice, then 56 with each of 28 pairs twice.
#[test]
fn reconstructions_have_24_trials_of_practice_and_56_that_count() {
    let windows = [20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2];
    let textures = ["a", "b", "c", "d"];
    let all = || textures.into_iter().flat_map(move |texture| windows.map(|window_mm| (texture, window_mm)));
    let id = |(texture, window_mm): (&str, f64)| format!("{texture}-{window_mm}");
    let design = Design::Similarity {
        pairs: all().map(|of| Comparison::new(of.0, id(of))).collect(),
        n_points: 5,
        low: "very similar".to_owned(),
        high: "very different".to_owned(),
    };
    let plan = plan_of(vec![Part { n_repeats: 2, n_practice: 24, ..part("a", design) }]);
    let originals = textures.map(|texture| stimulus(texture, Variant::Original));
    let versions = all().map(|of| stimulus(&id(of), Variant::Reconstructed { window_mm: of.1 }));
    let plan = Arc::new(Plan { stimuli: originals.into_iter().chain(versions).collect(), ..plan });
    let world = World::invented(&plan, 3);
    let records = simulated_study(&plan, &world, &Observers::usual(), 3, 1).unwrap();
    assert!(records.iter().all(|record| record.answers.len() == 24 + 56));
    let cells = similarity_cells(&plan.parts[0], &records);
    assert_eq!((cells.columns.len(), cells.n_values()), (28, 84));
    assert!(cells.n_answers.iter().flatten().all(|n| *n == 2));
    let practiced: BTreeSet<String> = records[0]
        .answers
        .iter()
        .filter(|answer| answer.trial.is_practice)
        .map(|answer| format!("{:?}", answer.trial.task))
        .collect();
    assert_eq!(practiced.len(), 24, "no practice trial comes twice");
    // Wider windows are graded as more different.
    let of_window = |wanted: f64| {
        let columns =
            cells.columns.iter().enumerate().filter(|(_, name)| name.ends_with(&format!("-{wanted}")));
        mean(&columns.flat_map(|(column, _)| cells.column(column)).collect::<Vec<_>>())
    };
    assert!(of_window(20.0) > of_window(0.2) + 1.0, "{} {}", of_window(20.0), of_window(0.2));
}

/// The rule of ITU-R BS.1534-3.
#[test]
fn who_misses_the_hidden_reference_is_named() {
    let plan = all_designs();
    let part = Part { id: "a".to_owned(), ..part_of(&plan, "mushra").clone() };
    let page = |reference: &str, of_reference: f64| {
        let stimuli = vec![format!("{reference}-low"), reference.to_owned(), format!("{reference}-high")];
        let task = Task::Page { reference: reference.to_owned(), stimuli };
        (task, Response::Sliders(vec![20.0, of_reference, 70.0]))
    };
    let records = [
        record("p1", vec![page("cork", 100.0), page("felt", 90.0)]),
        record("p2", vec![page("cork", 89.0), page("felt", 100.0)]),
    ];
    let found = rejected(&part, &records);
    assert_eq!(
        (found.len(), found[0].participant.as_str(), found[0].n_missed, found[0].n_pages),
        (1, "p2", 1, 2)
    );
    let all = page_ratings(&part, &records, &[]);
    assert_eq!(all[0].cells.columns, ["cork", "cork-high", "cork-low"]);
    assert_eq!(all[0].cells.values[1], [Some(89.0), Some(70.0), Some(20.0)]);
    let kept = page_ratings(&part, &records, &found);
    assert_eq!(kept[1].cells.participants, ["p1"]);
    assert_eq!(kept[1].cells.averages()[0].mean, Some(90.0));
    assert!(rejected(&part, &records[..1]).is_empty());
}
