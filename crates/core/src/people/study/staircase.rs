//! Adaptive staircases: the level of a trial follows from the answers before it, and gathers at the threshold.
//!
//! The level falls after `n` right answers in a row and rises after each wrong one ("one up, n down"). Where both happen
//! equally often, the probability of a right answer is `0.5^(1/n)`: 84.1 % for four (Levitt 1971). A change of direction is a
//! reversal. The threshold is the mean level of the last reversals.
//!
//! The step rule is that of the paper on spatial spectrograms: a change of the level multiplies or divides it by 16, 8, 4
//! and 2 up to the first four reversals, and then by `1 + 1/R`. The paper names R "the reversal number" without more.
//! Here it is the number of the reversal that the change makes or comes before.

use crate::maths::statistics::{mean, standard_deviation};

/// When levels change, by how much, and when the staircase ends.
#[derive(Clone, Debug, PartialEq)]
pub struct StaircaseRule {
    /// Level of the first trial, above 0, in the unit of what varies.
    pub start: f64,
    /// Lowest level.
    pub lowest: f64,
    /// Highest level.
    pub highest: f64,
    /// Number of right answers in a row after which the level falls, 1 or more.
    pub n_down: u32,
    /// Factors of the changes at reversals 1, 2, …, above 1.
    pub first_factors: Vec<f64>,
    /// Factors of the changes at later reversals.
    pub later: LaterFactor,
    /// Number of reversals after which the staircase ends.
    pub n_reversals: usize,
    /// Number of last reversals that are averaged.
    pub n_averaged: usize,
    /// Number of trials after which the staircase ends in any case.
    pub max_trials: usize,
}

/// Factor of a change of the level after the first reversals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LaterFactor {
    /// `1 + 1/R` at reversal R.
    Harmonic,
    /// The same factor, above 1.
    Constant(f64),
}

impl StaircaseRule {
    /// Rule of the published gap detection: from 6 mm, four down, the factors of the paper, the last six reversals. The paper
    /// does not state the limits of the width, nor when the procedure ended: these are ours. With 16 reversals, the mean
    /// threshold of observers is at 84 % within one percentage point.
    pub fn gap_detection() -> Self {
        Self {
            start: 6.0,
            lowest: 0.05,
            highest: 6.0,
            n_down: 4,
            first_factors: vec![16.0, 8.0, 4.0, 2.0],
            later: LaterFactor::Harmonic,
            n_reversals: 16,
            n_averaged: 6,
            max_trials: 200,
        }
    }

    /// Factor of a change of the level at a reversal or on the way to it; `reversal` counts from 1.
    pub fn factor(&self, reversal: usize) -> f64 {
        let first = reversal.checked_sub(1).and_then(|index| self.first_factors.get(index));
        match (first, self.later) {
            (Some(factor), _) => *factor,
            (None, LaterFactor::Harmonic) => 1.0 + 1.0 / reversal.max(1) as f64,
            (None, LaterFactor::Constant(factor)) => factor,
        }
    }

    /// Probability of a right answer at the level to which the staircase converges, 0.5 to 1.
    pub fn target(&self) -> f64 {
        0.5_f64.powf(1.0 / f64::from(self.n_down))
    }
}

/// Direction of a change of the level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Direction {
    Up,
    Down,
}

/// State of a staircase after some answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Staircase {
    rule: StaircaseRule,
    level: f64,
    /// Right answers at this level since the last change.
    n_right: u32,
    direction: Option<Direction>,
    /// Level of each reversal.
    reversals: Vec<f64>,
    n_answers: usize,
}

/// Threshold from the last reversals of a staircase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// Arithmetic mean of their levels, as published.
    pub level: f64,
    /// Standard deviation of their levels.
    pub deviation: f64,
    /// Whether the staircase reached the number of reversals of its rule; otherwise it ended early or goes on.
    pub is_complete: bool,
}

/// Relative difference of two levels that counts as rounding.
const ROUNDING: f64 = 1e-9;

impl Staircase {
    /// Staircase before its first answer.
    ///
    /// # Panics
    /// If the lowest level of the rule exceeds the highest; [`crate::people::study::plan::problems()`] finds such rules.
    pub fn new(rule: StaircaseRule) -> Self {
        assert!(rule.lowest <= rule.highest, "a rule was not checked");
        let level = rule.start.clamp(rule.lowest, rule.highest);
        Self { rule, level, n_right: 0, direction: None, reversals: Vec::new(), n_answers: 0 }
    }

    /// Level of the next trial.
    pub fn level(&self) -> f64 {
        self.level
    }

    /// Levels of the reversals so far.
    pub fn reversals(&self) -> &[f64] {
        &self.reversals
    }

    /// Number of answers so far.
    pub fn n_answers(&self) -> usize {
        self.n_answers
    }

    /// Whether the rule asks for no further trial.
    pub fn is_over(&self) -> bool {
        self.reversals.len() >= self.rule.n_reversals || self.n_answers >= self.rule.max_trials
    }

    /// Takes the answer to a trial at the level `presented`, and returns whether this was the expected level.
    ///
    /// Another level means that an answer before it is missing, for example because its line of a log is damaged. The
    /// staircase goes on from the presented level. Its direction shows whether the missing answer made a reversal.
    pub fn answer(&mut self, presented: f64, is_right: bool) -> bool {
        let is_expected = (presented - self.level).abs() <= ROUNDING * self.level;
        if !is_expected {
            self.go_on_from(presented);
        }
        self.n_answers += 1;
        if !is_right {
            self.change(Direction::Up);
        } else if self.n_right + 1 < self.rule.n_down {
            self.n_right += 1;
        } else {
            self.change(Direction::Down);
        }
        is_expected
    }

    /// Mean level of the last reversals; `None` if there are too few.
    pub fn threshold(&self) -> Option<Threshold> {
        let n_skipped = self.reversals.len().checked_sub(self.rule.n_averaged)?;
        let last = &self.reversals[n_skipped..];
        Some(Threshold {
            level: mean(last),
            deviation: standard_deviation(last),
            is_complete: self.reversals.len() >= self.rule.n_reversals,
        })
    }

    fn change(&mut self, direction: Direction) {
        let is_reversal = self.turn(direction);
        let factor = self.rule.factor(self.reversals.len() + usize::from(!is_reversal));
        let level = match direction {
            Direction::Up => self.level * factor,
            Direction::Down => self.level / factor,
        };
        self.level = level.clamp(self.rule.lowest, self.rule.highest);
    }

    fn go_on_from(&mut self, presented: f64) {
        self.turn(if presented > self.level { Direction::Up } else { Direction::Down });
        self.level = presented;
    }

    /// Takes a direction, and returns whether this is a reversal.
    fn turn(&mut self, direction: Direction) -> bool {
        self.n_right = 0;
        let before = self.direction.replace(direction);
        let is_reversal = before.is_some_and(|before| before != direction);
        if is_reversal {
            self.reversals.push(self.level);
        }
        is_reversal
    }
}

#[cfg(test)]
mod tests;
