//! Each design, from simulated or hand-made answers to its table.

mod published;

use std::sync::Arc;

use proptest::prelude::{prop_assert, proptest};

use super::abx::{RightAnswers, matches};
use super::anchors::position_cells;
use super::discrimination::{discriminability, discriminations};
use super::dissimilarity::{Normalization, dissimilarities};
use super::rating::{rating_cells, ratings};
use super::relevance::votes;
use super::similarity::similarity_cells;
use super::sorting::sorts;
use super::thresholds::{threshold_cells, tracks};
use crate::people::ratings::{RatingTable, relevances};
use crate::people::sorting::similarity;
use crate::people::study::answer::{Answer, Measured, Record, Response};
use crate::people::study::plan::{Comparison, Design, Part, Plan};
use crate::people::study::same_different::{Correction, Counts};
use crate::people::study::simulated::{Observers, World, simulated_study};
use crate::people::study::test_plans::{all_designs, dissimilarity, part, plan_of, rating, textures};
use crate::people::study::trial::{Task, Trial};

/// Records of simulated participants who answer the plan of all designs.
fn simulated(observers: &Observers, n: usize) -> (Plan, World, Vec<Record>) {
    let plan = all_designs();
    let world = World::invented(&plan, 3);
    let records = simulated_study(&Arc::new(plan.clone()), &world, observers, n, 1).unwrap();
    (plan, world, records)
}

/// Record of these answers in part "a".
fn record(participant: &str, answers: Vec<(Task, Response)>) -> Record {
    let answer = |(index, (task, response)): (usize, (Task, Response))| Answer {
        trial: Trial { part: "a".to_owned(), number: index + 1, is_practice: false, seed: 1, task },
        response,
        measured: Measured::default(),
    };
    let answers = answers.into_iter().enumerate().map(answer).collect();
    Record {
        participant: participant.to_owned(),
        number: 1,
        is_simulated: false,
        answers,
        setups: Vec::new(),
    }
}

fn compared(first: &str, second: &str, value: f64) -> (Task, Response) {
    let pair = Comparison::new(first, second);
    (Task::Compare { pair, is_swapped: false }, Response::Magnitude(value))
}

fn part_of<'a>(plan: &'a Plan, id: &str) -> &'a Part {
    plan.part(id).unwrap()
}

#[test]
fn sorts_become_similarities() {
    let (plan, world, records) = simulated(&Observers::usual(), 12);
    let sorts = sorts(&plan, part_of(&plan, "sorting"), &records);
    assert_eq!(sorts.len(), 12 * 2);
    assert!(sorts.iter().all(|sort| sort.placements.len() == 5 && sort.participant.contains("simulated")));
    let of_textures = similarity(&textures(), &sorts).unwrap();
    // The nearest pair of textures is sorted together more often than the farthest.
    let distance = |a: &str, b: &str| -> f64 {
        world.positions[a].iter().zip(&world.positions[b]).map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let mut pairs: Vec<(f64, f64)> = Vec::new();
    for (i, one) in textures().iter().enumerate() {
        for (j, other) in textures().iter().enumerate().skip(i + 1) {
            pairs.push((distance(one, other), of_textures.scores[i][j].unwrap()));
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(pairs[0].1 > pairs[9].1, "{pairs:?}");
}

#[test]
fn repeated_sorts_have_names_of_their_own() {
    let task = || Task::Sort { stimuli: textures(), n_groups: 2 };
    let sort = |groups: [usize; 5]| (task(), Response::Groups(groups.to_vec()));
    let design = Design::Sorting { stimuli: textures(), groups: vec![2] };
    let plan = plan_of(vec![part("a", design)]);
    let records = [record("p1", vec![sort([0, 1, 0, 1, 0]), sort([1, 0, 0, 0, 0])])];
    let sorts = sorts(&plan, &plan.parts[0], &records);
    let names: Vec<&str> = sorts.iter().map(|sort| sort.trial.as_str()).collect();
    assert_eq!(names, ["2 groups", "2 groups, repeat 2"]);
    assert_eq!((sorts[1].placements[0].group.as_str(), sorts[0].n_groups), ("2", Some(2)));
}

#[test]
fn votes_are_counted() {
    let (plan, _, records) = simulated(&Observers::usual(), 6);
    let votes = votes(&plan, part_of(&plan, "relevance"), &records);
    assert_eq!(votes.len(), 6 * 5 * 3);
    let relevances = relevances(&votes).unwrap();
    let share = |word: &str| relevances.iter().find(|of| of.adjective == word).unwrap().share;
    // An adjective and its opposite share one dimension.
    assert!((share("rough") + share("smooth") - 1.0).abs() < 0.35, "{relevances:?}");
}

#[test]
fn ratings_become_a_table_and_cells() {
    let (plan, world, records) = simulated(&Observers::exact(), 3);
    let part = part_of(&plan, "rating");
    let table = RatingTable::new(&ratings(&plan, part, &records)).unwrap();
    assert_eq!((table.participants().len(), table.textures().len(), table.n_missing()), (3, 5, 0));
    let cells = rating_cells(part, &records);
    assert_eq!((cells.len(), cells[0].columns.len(), cells[0].n_values()), (2, 5, 15));
    for (pair, cells) in cells.iter().enumerate() {
        for (stimulus, average) in cells.columns.iter().zip(cells.averages()) {
            let position = world.positions[stimulus][pair];
            assert!((average.mean.unwrap() - position).abs() < 1e-9 && average.half_width.unwrap() < 1e-9);
        }
    }
}

#[test]
fn repeats_are_averaged_and_missing_answers_stay_missing() {
    let rate = |stimulus: &str, values: [f64; 2]| {
        (Task::Rate { stimulus: stimulus.to_owned() }, Response::Sliders(values.to_vec()))
    };
    let plan = plan_of(vec![part("a", rating())]);
    let records = [
        record(
            "p1",
            vec![rate("cork", [10.0, 50.0]), rate("felt", [20.0, 60.0]), rate("cork", [30.0, 70.0])],
        ),
        record("p2", vec![rate("felt", [40.0, 80.0])]),
    ];
    let cells = &rating_cells(&plan.parts[0], &records)[0];
    assert_eq!(cells.values[0], [Some(20.0), Some(20.0), None, None, None]);
    assert_eq!(cells.values[1], [None, Some(40.0), None, None, None]);
    assert_eq!((cells.n_answers[0][0], cells.n_answers_of(0), cells.n_values()), (2, 3, 3));
    assert_eq!(cells.averages()[2].mean, None);
    assert_eq!(ratings(&plan, &plan.parts[0], &records).len(), 6);
}

#[test]
fn practice_and_other_parts_do_not_count() {
    let plan = plan_of(vec![part("a", dissimilarity())]);
    let mut records =
        [record("p1", vec![compared("cork", "cork-authored", 2.0), compared("brick", "denim", 8.0)])];
    let values = |records: &[Record]| {
        let found = dissimilarities(&plan.parts[0], records, Normalization::Maximum).unwrap();
        found.cells.values[0].iter().flatten().copied().collect::<Vec<f64>>()
    };
    assert_eq!(values(&records), [0.25, 1.0]);
    records[0].answers[0].trial.is_practice = true;
    assert_eq!(values(&records), Vec::<f64>::new(), "one answer has no spread");
    records[0].answers[0].trial.is_practice = false;
    records[0].answers[0].trial.part = "b".to_owned();
    assert_eq!(values(&records), Vec::<f64>::new());
}

#[test]
fn every_normalization_removes_the_scale_of_a_participant() {
    let plan = plan_of(vec![part("a", dissimilarity())]);
    let answers = |unit: f64| {
        vec![
            compared("cork", "cork-authored", unit),
            compared("cork", "felt-authored", 4.0 * unit),
            compared("brick", "denim", 9.0 * unit),
            compared("brick", "brick", 0.0),
        ]
    };
    let records = [
        record("p1", answers(1.0)),
        record("p2", answers(70.0)),
        record("p3", vec![compared("cork", "cork-authored", 5.0)]),
    ];
    let found = |normalization| dissimilarities(&plan.parts[0], &records, normalization).unwrap();
    // The geometric mean of 1, 4 and 9 is 36^(1/3).
    let geometric = 36.0_f64.cbrt();
    for (normalization, first) in [
        (Normalization::Range, 1.0 / 9.0),
        (Normalization::Maximum, 1.0 / 9.0),
        (Normalization::GeometricMean, 1.0 / geometric),
    ] {
        let found = found(normalization);
        for row in &found.cells.values[..2] {
            assert!((row[0].unwrap() - first).abs() < 1e-12 && row[5] == Some(0.0), "{row:?}");
        }
        assert_eq!((found.constant.as_slice(), found.references), (&["p3".to_owned()][..], None));
    }
}

#[test]
fn same_different_counts_are_pooled_and_by_participant() {
    let (plan, _, records) = simulated(&Observers::usual(), 4);
    let found = discriminations(part_of(&plan, "same-different"), &records);
    assert_eq!(found.len(), 3);
    for of_pair in &found {
        // Two segments, two repeats, four participants.
        assert_eq!((of_pair.pooled.n_different, of_pair.pooled.n_same), (16, 16));
        assert_eq!(of_pair.by_participant.len(), 4);
        let hits: u64 = of_pair.by_participant.iter().map(|(_, counts)| counts.hits).sum();
        assert_eq!(hits, of_pair.pooled.hits);
    }
    let d = discriminability(
        Counts { hits: 12, n_different: 16, false_alarms: 3, n_same: 16 },
        Correction::LogLinear,
    );
    let d = d.unwrap();
    assert!(d.yes_no < d.independent_observation && d.independent_observation < d.differencing, "{d:?}");
    assert_eq!(discriminability(Counts::default(), Correction::Clipped), None);
}

#[test]
fn thresholds_are_those_of_the_tracks() {
    let (plan, _, records) = simulated(&Observers::usual(), 5);
    let part = part_of(&plan, "staircase");
    let tracks = tracks(part, &records);
    assert_eq!(tracks.len(), 5);
    let cells = threshold_cells(part, &records);
    for (track, row) in tracks.iter().zip(&cells.values) {
        assert_eq!(track.threshold.map(|threshold| threshold.level), row[0]);
        // Practice does not count.
        assert!(track.answers.len() >= track.reversals.len() && track.track == 0);
    }
}

#[test]
fn grades_and_positions_follow_the_distances() {
    let (plan, world, records) = simulated(&Observers::exact(), 2);
    let grades = similarity_cells(part_of(&plan, "similarity"), &records);
    assert_eq!((grades.columns[0].as_str(), grades.n_values()), ("cork|cork-low", 6));
    // A distance of 22.9 points is 46 % of the scale: grade 3 of 1 to 5.
    assert!(grades.values.iter().flatten().all(|value| *value == Some(3.0)), "{grades:?}");
    let places = position_cells(part_of(&plan, "anchors"), &records).unwrap();
    let [low, high] = ["brick", "denim"].map(|id| &world.positions[id]);
    let step = [high[0] - low[0], high[1] - low[1]];
    for (stimulus, value) in places.columns.iter().zip(&places.values[0]) {
        let at = &world.positions[stimulus];
        let along = (at[0] - low[0]) * step[0] + (at[1] - low[1]) * step[1];
        let expected = (100.0 * along / (step[0] * step[0] + step[1] * step[1])).clamp(0.0, 100.0);
        assert!((value.unwrap() - expected).abs() < 1e-9, "{stimulus}");
    }
    assert!(position_cells(part_of(&plan, "rating"), &records).is_none());
}

#[test]
fn right_matches_are_counted_against_chance() {
    let (plan, _, records) = simulated(&Observers::exact(), 3);
    let found = matches(part_of(&plan, "abx"), &records);
    assert_eq!(found.len(), 3);
    for of_pair in &found {
        assert_eq!(of_pair.pooled, RightAnswers { n_right: 12, n_trials: 12 });
        assert_eq!(of_pair.by_participant.len(), 3);
        // All of twelve are right by chance once in 4096 times.
        assert!((of_pair.pooled.p_by_chance() - 0.5_f64.powi(12)).abs() < 1e-12);
        assert_eq!(of_pair.pooled.proportion(), Some(1.0));
    }
    assert_eq!(RightAnswers::default().proportion(), None);
}

proptest! {
    /// Normalized dissimilarities do not depend on the unit that a participant chooses, and the highest is 1.
    #[test]
    fn the_unit_of_a_participant_does_not_matter(
        values in proptest::collection::vec(0.0..100.0_f64, 7), unit in 0.01..100.0_f64,
    ) {
        let plan = plan_of(vec![part("a", dissimilarity())]);
        let comparisons = plan.parts[0].design.comparisons();
        let of_unit = |unit: f64| {
            let answers = comparisons.iter().zip(&values);
            let answers = answers.map(|(pair, value)| compared(&pair.first, &pair.second, unit * value)).collect();
            let found = dissimilarities(&plan.parts[0], &[record("p1", answers)], Normalization::Range).unwrap();
            found.cells.values[0].iter().flatten().copied().collect::<Vec<f64>>()
        };
        let (one, other) = (of_unit(1.0), of_unit(unit));
        prop_assert!(one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-9));
        prop_assert!(one.is_empty() || one.iter().copied().fold(0.0, f64::max) == 1.0);
    }
}
