//! Problems of the designs.

use std::collections::BTreeSet;

use crate::people::study::plan::problems::{Checks, texts};
use crate::people::study::plan::{Comparison, Design, MushraPage, Prompts, Varied};
use crate::people::study::staircase::{LaterFactor, StaircaseRule};

/// Grades of a scale, from the fewest to the most.
const POINTS: (u32, u32) = (2, 11);
/// Length of a slider in mm, from the shortest to the longest.
const SLIDER_MM: (f64, f64) = (20.0, 500.0);
/// Largest factor of a staircase.
const LARGEST_FACTOR: f64 = 100.0;
/// Lowest and highest level of a staircase.
const LEVELS: (f64, f64) = (1e-4, 1e4);
/// Highest number of trials and reversals of a staircase.
const MOST_TRIALS: usize = 10_000;
/// Highest number of stimuli that a participant rates on one page.
const MOST_ON_A_PAGE: usize = 26;

pub(super) fn check_design(design: &Design, checks: &mut Checks<'_>) {
    match design {
        Design::Sorting { stimuli, groups } => {
            checks.check_stimuli(stimuli, 3);
            checks.check_length("groups", groups.len(), "number of groups");
            let distinct: BTreeSet<usize> = groups.iter().copied().collect();
            if distinct.len() < groups.len() {
                checks.add("groups", "a number is listed twice; for several sorts of each, use `repeats`");
            }
            for n in distinct {
                checks.count("groups", n, 2, stimuli.len().max(2));
            }
        }
        Design::Relevance { stimuli, adjectives } => {
            checks.check_stimuli(stimuli, 1);
            checks.check_words("adjectives", &texts(adjectives), "adjective");
        }
        Design::Rating { stimuli, pairs, slider_mm } => {
            checks.check_stimuli(stimuli, 1);
            let names: Vec<String> = pairs.iter().map(|pair| pair.name().to_lowercase()).collect();
            checks.check_words("scales", &texts(&names), "adjective pair");
            checks.within("slider_mm", *slider_mm, SLIDER_MM.0, SLIDER_MM.1);
        }
        Design::Dissimilarity { reference, .. } => {
            check_comparisons(&design.comparisons(), checks);
            if let Some(reference) = reference {
                check_unlike("reference", std::slice::from_ref(reference), checks);
            }
        }
        Design::SameDifferent { pairs, n_segments } => {
            check_unlike_pairs(pairs, checks);
            checks.count("segments", *n_segments, 1, 100);
        }
        Design::Staircase { varied, rule, feedback_reversals } => {
            if let Varied::Level { stimulus } = varied {
                checks.check_known("stimulus", &[stimulus.as_str()]);
            }
            checks.count("feedback_reversals", *feedback_reversals, 0, MOST_TRIALS);
            check_rule(rule, checks);
        }
        Design::Similarity { pairs, n_points, low, high } => {
            check_unlike_pairs(pairs, checks);
            check_scale(*n_points, low, high, checks);
        }
        Design::Likert { conditions, statements, prompts, n_points, low, high } => {
            let ids: Vec<&str> = conditions.iter().map(|condition| condition.id.as_str()).collect();
            checks.check_words("conditions", &ids, "condition");
            let ids: Vec<&str> = statements.iter().map(|statement| statement.id.as_str()).collect();
            checks.check_words("statements", &ids, "statement");
            if statements.iter().any(|statement| statement.text.trim().is_empty()) {
                checks
                    .add("statements", "a statement has no text; write the sentence that participants rate");
            }
            match prompts {
                Prompts::Own(n) => checks.count("own_prompts", *n, 1, 1000),
                Prompts::Given(prompts) => checks.check_words("prompts", &texts(prompts), "prompt"),
            }
            check_scale(*n_points, low, high, checks);
        }
        Design::Abx { pairs } => check_unlike_pairs(pairs, checks),
        Design::Mushra { pages } => check_pages(pages, checks),
        Design::Anchors { stimuli, low, high } => {
            checks.check_stimuli(stimuli, 1);
            checks.check_known("low_anchor", &[low.as_str()]);
            checks.check_known("high_anchor", &[high.as_str()]);
            if low == high {
                checks.add("high_anchor", "both anchors are the same stimulus; choose two that differ");
            }
        }
    }
}

/// Checks that pairs exist, are known, and are listed once in either order.
fn check_comparisons(pairs: &[Comparison], checks: &mut Checks<'_>) {
    checks.check_length("pairs", pairs.len(), "pair");
    let ids: Vec<&str> = pairs.iter().flat_map(|pair| [pair.first.as_str(), pair.second.as_str()]).collect();
    checks.check_known("pairs", &ids);
    let mut seen = BTreeSet::new();
    for Comparison { first, second } in pairs {
        if !seen.insert((first.min(second), first.max(second))) {
            checks.add("pairs", format!("{first} and {second} are compared twice; use `repeats` instead"));
        }
    }
}

fn check_unlike_pairs(pairs: &[Comparison], checks: &mut Checks<'_>) {
    check_comparisons(pairs, checks);
    check_unlike("pairs", pairs, checks);
}

fn check_unlike(key: &str, pairs: &[Comparison], checks: &mut Checks<'_>) {
    for Comparison { first, .. } in pairs.iter().filter(|pair| pair.first == pair.second) {
        checks.add(key, format!("{first} is paired with itself; name two stimuli"));
    }
}

fn check_scale(n_points: u32, low: &str, high: &str, checks: &mut Checks<'_>) {
    if !(POINTS.0..=POINTS.1).contains(&n_points) {
        checks.add("points", format!("{n_points} is out of range; choose {} to {}", POINTS.0, POINTS.1));
    }
    for (key, text) in [("low", low), ("high", high)] {
        if text.trim().is_empty() {
            checks.add(key, "the end of the scale has no name; say what the grade means");
        }
    }
}

fn check_rule(rule: &StaircaseRule, checks: &mut Checks<'_>) {
    checks.within("lowest", rule.lowest, LEVELS.0, LEVELS.1);
    checks.within("highest", rule.highest, LEVELS.0, LEVELS.1);
    if !(rule.lowest..=rule.highest).contains(&rule.start) {
        let text = format!("{} is not between `lowest` and `highest`; correct one of the three", rule.start);
        checks.add("start", text);
    }
    checks.count("down", rule.n_down as usize, 1, 10);
    let later = match rule.later {
        LaterFactor::Harmonic => None,
        LaterFactor::Constant(factor) => Some(("later_factor", factor)),
    };
    for (key, factor) in rule.first_factors.iter().map(|factor| ("factors", *factor)).chain(later) {
        if !(factor > 1.0 && factor <= LARGEST_FACTOR) {
            checks.add(
                key,
                format!("{factor} is out of range; choose a factor above 1, up to {LARGEST_FACTOR}"),
            );
        }
    }
    checks.count("factors", rule.first_factors.len(), 0, 100);
    checks.count("reversals", rule.n_reversals, 1, MOST_TRIALS);
    checks.count("averaged", rule.n_averaged, 1, rule.n_reversals.max(1));
    checks.count("max_trials", rule.max_trials, 1, MOST_TRIALS);
}

fn check_pages(pages: &[MushraPage], checks: &mut Checks<'_>) {
    checks.check_length("pages", pages.len(), "page");
    let mut references = BTreeSet::new();
    for MushraPage { reference, tested, anchors } in pages {
        let rated: Vec<&str> =
            [reference].into_iter().chain(tested).chain(anchors).map(String::as_str).collect();
        checks.check_known("pages", &rated);
        if tested.is_empty() {
            checks.add("pages", format!("the page of {reference} has nothing to rate; add tested versions"));
        }
        let mut seen = BTreeSet::new();
        if let Some(twice) = rated.iter().find(|id| !seen.insert(**id)) {
            checks
                .add("pages", format!("{twice} is twice on the page of {reference}; remove one of the two"));
        }
        if rated.len() > MOST_ON_A_PAGE {
            let text = format!("the page of {reference} has more than {MOST_ON_A_PAGE} stimuli; split it");
            checks.add("pages", text);
        }
        if !references.insert(reference) {
            checks.add("pages", format!("{reference} has two pages; put all its versions on one"));
        }
    }
}
