//! Errors of tables of rated pairs.

use crate::named_table::NamedTableError;

/// Why bytes are not rated pairs.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatedPairsError {
    /// Not a table with these columns, or a field is not a number.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// No column has ratings.
    #[error(
        "no column has ratings: name one d_prime, or add the counts n_same, n_different, n_trials_identical and n_different_on_identical, or hits, n_different, false_alarms and n_same; the columns are {found}"
    )]
    NoRatings {
        /// Column names in the file.
        found: String,
    },
    /// Both forms of counts are there, in which `n_same` and `n_different` mean different things.
    #[error(
        "the table has both hits and n_trials_identical, so that n_same and n_different could count answers or trials; remove one form of the counts"
    )]
    TwoForms,
    /// A row has neither d′ nor all counts.
    #[error("line {line} has neither d_prime nor {missing}; fill it in, or remove the line")]
    NoRating {
        /// The line, from one.
        line: u64,
        /// Column of the first missing count, or "counts".
        missing: String,
    },
    /// A count is not a whole number, 0 or more.
    #[error(
        "{column} in line {line} is {found}, but a count is a whole number from 0 to {MOST_COUNT}; correct it"
    )]
    Count {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
        /// The number found.
        found: f64,
    },
    /// There are more answers than trials.
    #[error(
        "line {line} has {answers} \"different\" answers, but only {trials} trials with {kind}; correct the counts"
    )]
    Answers {
        /// The line, from one.
        line: u64,
        /// Number of answers.
        answers: u64,
        /// Number of trials.
        trials: u64,
        /// Kind of the trials.
        kind: &'static str,
    },
    /// One kind of trial is missing, so that there is no d′.
    #[error(
        "line {line} has no trials with {kind}, but d' needs both kinds of trials; add them, state d_prime, or remove the line"
    )]
    NoTrials {
        /// The line, from one.
        line: u64,
        /// Missing kind of trials.
        kind: &'static str,
    },
    /// A number is outside its range.
    #[error("{column} in line {line} is {found}, but it must be {range}; correct it")]
    Range {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
        /// The number found.
        found: f64,
        /// Possible numbers, in words.
        range: &'static str,
    },
    /// A distance is missing.
    #[error(
        "line {line} has no {column}, but a table that states distances states all of them; fill it in, or remove the line"
    )]
    NoDistance {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
    },
}

/// Largest count of answers or trials.
pub(super) const MOST_COUNT: u64 = 1_000_000_000;
