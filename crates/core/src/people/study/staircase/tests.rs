use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

use super::{LaterFactor, Staircase, StaircaseRule};
use crate::maths::rng::Random;
use crate::maths::statistics::{mean, standard_deviation};

/// Probability of a right answer of an observer between two alternatives: a Weibull function with the scale 1.
fn weibull(level: f64, slope: f64) -> f64 {
    1.0 - 0.5 * (-level.powf(slope)).exp()
}

/// Limits that no simulated observer reaches.
fn unlimited(rule: StaircaseRule) -> StaircaseRule {
    StaircaseRule { lowest: 1e-6, highest: 1e3, max_trials: 100_000, ..rule }
}

fn run(rule: &StaircaseRule, slope: f64, random: &mut Random) -> Staircase {
    let mut staircase = Staircase::new(rule.clone());
    while !staircase.is_over() {
        let is_right = random.uniform() < weibull(staircase.level(), slope);
        assert!(staircase.answer(staircase.level(), is_right));
    }
    staircase
}

/// Mean threshold of many observers, and its standard error.
fn mean_threshold(rule: &StaircaseRule, slope: f64, n: usize, seed: u64) -> (f64, f64) {
    let mut random = Random::new(seed);
    let thresholds: Vec<f64> =
        (0..n).map(|_| run(rule, slope, &mut random).threshold().unwrap().level).collect();
    (mean(&thresholds), standard_deviation(&thresholds) / (n as f64).sqrt())
}

#[test]
fn the_factors_are_those_of_the_paper() {
    let rule = StaircaseRule::gap_detection();
    let factors: Vec<f64> = (1..=6).map(|reversal| rule.factor(reversal)).collect();
    assert_eq!(factors, [16.0, 8.0, 4.0, 2.0, 1.2, 1.0 + 1.0 / 6.0]);
    assert!((rule.target() - 0.840_896_415_253_714_5).abs() < 1e-15);
    let constant = StaircaseRule { later: LaterFactor::Constant(1.1), ..rule };
    assert_eq!((constant.factor(4), constant.factor(99)), (2.0, 1.1));
}

/// The levels of a short procedure, followed by hand.
#[test]
fn levels_follow_the_answers() {
    let mut staircase = Staircase::new(unlimited(StaircaseRule::gap_detection()));
    let mut levels = Vec::new();
    for is_right in
        [true, true, true, true, false, true, true, true, true, false, true, true, true, true, true]
    {
        levels.push(staircase.level());
        staircase.answer(staircase.level(), is_right);
    }
    // Down by 16, up by 16 at reversal 1, down by 8 at reversal 2, up by 4 at reversal 3, down by 2 at reversal 4.
    let expected = [6.0, 6.0, 6.0, 6.0, 0.375, 6.0, 6.0, 6.0, 6.0, 0.75, 3.0, 3.0, 3.0, 3.0, 1.5];
    assert_eq!(levels, expected);
    assert_eq!(staircase.reversals(), [0.375, 6.0, 0.75, 3.0]);
    assert_eq!((staircase.n_answers(), staircase.is_over(), staircase.threshold()), (15, false, None));
}

/// The gate of the rule: the level to which it converges has 84.1 % right answers.
#[test]
fn the_published_rule_converges_to_84_percent() {
    let rule = unlimited(StaircaseRule::gap_detection());
    for slope in [2.0, 3.5] {
        let (level, standard_error) = mean_threshold(&rule, slope, 2000, 5);
        // Four standard errors, and the bias of the mean of six reversals: 0.35 percentage points in 3,000 staircases of a
        // separate implementation.
        let error = weibull(level + 4.0 * standard_error, slope) - weibull(level, slope);
        let off = weibull(level, slope) - rule.target();
        assert!(off.abs() < 0.0035 + error && error < 0.01, "slope {slope}: {off}, {error}");
    }
    // Reversals further on are nearer to the target, since the steps shrink.
    let longer = StaircaseRule { n_reversals: 60, max_trials: 1000, ..rule };
    let (level, standard_error) = mean_threshold(&longer, 2.0, 1000, 6);
    let off = weibull(level, 2.0) - longer.target();
    assert!(off.abs() < 0.001 + standard_error, "{off}");
}

/// Negative control: another rule converges elsewhere, which the test above would notice.
#[test]
fn three_down_converges_elsewhere() {
    let rule = unlimited(StaircaseRule { n_down: 3, ..StaircaseRule::gap_detection() });
    let (level, _) = mean_threshold(&rule, 2.0, 1000, 7);
    assert!((weibull(level, 2.0) - 0.841).abs() > 0.03, "{level}");
    assert!((weibull(level, 2.0) - rule.target()).abs() < 0.015, "{level}");
}

#[test]
fn an_observer_who_feels_nothing_ends_at_the_limit() {
    let mut staircase = Staircase::new(StaircaseRule::gap_detection());
    while !staircase.is_over() {
        staircase.answer(staircase.level(), false);
    }
    assert_eq!((staircase.n_answers(), staircase.level(), staircase.threshold()), (200, 6.0, None));
    let mut staircase = Staircase::new(StaircaseRule::gap_detection());
    while !staircase.is_over() {
        staircase.answer(staircase.level(), true);
    }
    assert_eq!((staircase.level(), staircase.reversals().len()), (0.05, 0));
}

#[test]
fn a_missing_answer_is_found_by_the_next_level() {
    let rule = unlimited(StaircaseRule::gap_detection());
    let mut whole = Staircase::new(rule.clone());
    let mut damaged = Staircase::new(rule);
    for (trial, is_right) in [true, true, true, true, false, true, true].into_iter().enumerate() {
        let level = whole.level();
        whole.answer(level, is_right);
        // The wrong answer is lost; the rise of the level after it tells.
        if trial != 4 {
            assert_eq!(damaged.answer(level, is_right), trial != 5, "trial {trial}");
        }
    }
    assert_eq!(damaged.reversals(), whole.reversals());
    assert_eq!(damaged.level(), whole.level());
}

proptest! {
    /// Levels stay within the limits, reversals alternate, and the same answers give the same state.
    #[test]
    fn any_answers_keep_the_rule(answers in proptest::collection::vec(proptest::bool::ANY, 0..300), n_down in 1_u32..6) {
        let rule = StaircaseRule { n_down, ..StaircaseRule::gap_detection() };
        let mut staircase = Staircase::new(rule.clone());
        let mut levels = Vec::new();
        for is_right in &answers {
            if staircase.is_over() {
                break;
            }
            levels.push((staircase.level(), *is_right));
            prop_assert!(staircase.answer(staircase.level(), *is_right));
            prop_assert!((rule.lowest..=rule.highest).contains(&staircase.level()));
        }
        let mut again = Staircase::new(rule.clone());
        for (level, is_right) in levels {
            again.answer(level, is_right);
        }
        prop_assert_eq!(&again, &staircase);
        prop_assert!(staircase.reversals().len() <= rule.n_reversals);
        if let Some(threshold) = staircase.threshold() {
            prop_assert!((rule.lowest..=rule.highest).contains(&threshold.level));
        }
    }
}
