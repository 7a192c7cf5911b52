use std::collections::{BTreeMap, BTreeSet};

use super::{is_trial_of, part_order, participant_of, trials};
use crate::people::study::order::Order;
use crate::people::study::plan::{Comparison, Design, Part, Plan};
use crate::people::study::test_plans::{all_designs, coded_pairs, dissimilarity, likert, part, plan_of};
use crate::people::study::trial::{Side, Task, Trial};

/// Trials of the only part of a plan.
fn trials_of(plan: &Plan, participant: usize) -> Vec<Trial> {
    trials(plan, &plan.parts[0], participant)
}

#[test]
fn every_part_has_all_its_trials() {
    let plan = all_designs();
    for part in &plan.parts {
        let all = trials(&plan, part, 3);
        let expected = part.design.n_trials().map_or(0, |n| part.n_practice + n * part.n_repeats);
        assert_eq!(all.len(), expected, "{}", part.id);
        assert!(all.iter().all(|trial| trial.task.fits(&part.design) && trial.part == part.id));
        assert!(all.iter().enumerate().all(|(index, trial)| trial.number == index + 1));
        assert_eq!(
            all.iter().filter(|trial| trial.is_practice).count().min(expected),
            part.n_practice.min(expected)
        );
        let seeds: BTreeSet<u64> = all.iter().map(|trial| trial.seed).collect();
        assert!(seeds.len() == all.len() && seeds.iter().all(|seed| i64::try_from(*seed).is_ok()));
    }
}

#[test]
fn the_same_participant_meets_the_same_trials() {
    let plan = all_designs();
    for part in &plan.parts {
        assert_eq!(trials(&plan, part, 2), trials(&plan, part, 2));
    }
    assert_ne!(trials(&plan, &plan.parts[3], 2), trials(&plan, &plan.parts[3], 4));
    let other = Plan { seed: 8, ..plan.clone() };
    assert_ne!(trials(&plan, &plan.parts[3], 2), trials(&other, &other.parts[3], 2));
}

#[test]
fn trials_tell_whose_they_are() {
    let plan = all_designs();
    let of = |participant: usize| -> Vec<Trial> {
        plan.parts.iter().flat_map(|part| trials(&plan, part, participant).into_iter().step_by(3)).collect()
    };
    let whose = |plan: &Plan, trials: &[Trial]| participant_of(plan, &trials.iter().collect::<Vec<_>>());
    for participant in [1, 2, 417] {
        assert_eq!(whose(&plan, &of(participant)), Some(participant));
    }
    // A damaged trial does not matter, but trials of two participants are of no one, as are those of another plan.
    let mut damaged = of(3);
    damaged[0].seed += 1;
    assert_eq!(whose(&plan, &damaged), Some(3));
    assert!(!is_trial_of(&plan, 3, &damaged[0]) && is_trial_of(&plan, 3, &damaged[1]));
    assert_eq!(whose(&plan, &[of(1), of(2)].concat()), None);
    assert_eq!(whose(&Plan { seed: 8, ..plan.clone() }, &of(1)), None);
    assert_eq!(whose(&plan, &[]), None);
}

/// As published, each pair is presented twice; here, once in each order.
#[test]
fn repeats_of_a_pair_change_its_order() {
    let plan = plan_of(vec![Part { n_repeats: 2, ..part("a", dissimilarity()) }]);
    let mut orders: BTreeMap<Comparison, Vec<bool>> = BTreeMap::new();
    for trial in trials_of(&plan, 1) {
        let Task::Compare { pair, is_swapped } = trial.task else { panic!("another task") };
        orders.entry(pair).or_default().push(is_swapped);
    }
    assert_eq!(orders.len(), 7);
    assert!(orders.values().all(|orders| orders.len() == 2 && orders[0] != orders[1]), "{orders:?}");
}

/// The published experiment: n segments × repeats × 2 trials for each pair.
#[test]
fn same_and_different_trials_are_as_many() {
    let design = Design::SameDifferent { pairs: coded_pairs(), n_segments: 3 };
    let plan = plan_of(vec![Part { n_repeats: 6, ..part("a", design) }]);
    let all = trials_of(&plan, 1);
    assert_eq!(all.len(), 3 * 3 * 6 * 2);
    let is_different = |trial: &&Trial| matches!(trial.task, Task::Discriminate { is_different: true, .. });
    assert_eq!(all.iter().filter(is_different).count(), 54);
}

#[test]
fn four_repeats_of_abx_have_every_order_with_every_answer() {
    let plan = plan_of(vec![Part { n_repeats: 4, ..part("a", Design::Abx { pairs: coded_pairs() }) }]);
    let mut seen: BTreeMap<Comparison, BTreeSet<(bool, bool)>> = BTreeMap::new();
    for trial in trials_of(&plan, 5) {
        let Task::Match { pair, is_swapped, x } = trial.task else { panic!("another task") };
        seen.entry(pair).or_default().insert((is_swapped, x == Side::Second));
    }
    assert!(seen.len() == 3 && seen.values().all(|cases| cases.len() == 4), "{seen:?}");
}

/// Conditions stay with their prompt, and over six participants each condition is equally often first.
#[test]
fn conditions_are_balanced_within_each_prompt() {
    let plan = plan_of(vec![Part { order: Order::LatinSquare, ..part("a", likert()) }]);
    let mut first: BTreeMap<(usize, String), usize> = BTreeMap::new();
    for participant in 1..=6 {
        let all = trials_of(&plan, participant);
        assert_eq!(all.len(), 15);
        for (index, trials) in all.chunks(3).enumerate() {
            let mut conditions = BTreeSet::new();
            for (position, trial) in trials.iter().enumerate() {
                let Task::Question { prompt, condition } = &trial.task else { panic!("another task") };
                assert_eq!(*prompt, index);
                conditions.insert(condition.clone());
                if position == 0 {
                    *first.entry((index, condition.clone())).or_default() += 1;
                }
            }
            assert_eq!(conditions.len(), 3);
        }
    }
    assert!(first.len() == 15 && first.values().all(|n| *n == 2), "{first:?}");
}

/// Names of the pairs of ABX trials.
fn matched_pairs(trials: &[Trial]) -> BTreeSet<String> {
    let name = |trial: &Trial| match &trial.task {
        Task::Match { pair, .. } => pair.name(),
        _ => String::new(),
    };
    trials.iter().map(name).collect()
}

#[test]
fn blocks_finish_a_repeat_before_the_next() {
    let design = Design::Abx { pairs: coded_pairs() };
    for order in [Order::Listed, Order::ShuffledBlocks, Order::LatinSquare] {
        let plan = plan_of(vec![Part { n_repeats: 4, order, ..part("a", design.clone()) }]);
        for block in trials_of(&plan, 2).chunks(3) {
            assert_eq!(matched_pairs(block).len(), 3);
        }
    }
}

#[test]
fn practice_comes_first_and_repeats_only_what_it_must() {
    let plan = plan_of(vec![Part { n_practice: 5, ..part("a", Design::Abx { pairs: coded_pairs() }) }]);
    let all = trials_of(&plan, 1);
    assert_eq!(all.len(), 8);
    assert!(all[..5].iter().all(|trial| trial.is_practice) && !all[5].is_practice);
    assert_eq!(matched_pairs(&all[..3]).len(), 3);
}

#[test]
fn parts_are_ordered_as_the_plan_says() {
    let mut plan = all_designs();
    assert_eq!(part_order(&plan, 9), (0..11).collect::<Vec<_>>());
    plan.part_order = Order::LatinSquare;
    let first: BTreeSet<usize> = (1..=11).map(|participant| part_order(&plan, participant)[0]).collect();
    assert_eq!(first.len(), 11);
    plan.part_order = Order::Shuffled;
    let mut order = part_order(&plan, 1);
    assert!(order != part_order(&plan, 2) || order != part_order(&plan, 3));
    order.sort_unstable();
    assert_eq!(order, (0..11).collect::<Vec<_>>());
}
