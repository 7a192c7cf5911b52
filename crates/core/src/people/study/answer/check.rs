//! Whether a response can answer a task.

use crate::people::study::answer::Response;
use crate::people::study::plan::Design;
use crate::people::study::trial::Task;

/// Why a response cannot answer a task.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// The response is of another kind than the task, or the task of another design than the part.
    #[error("the response does not belong to this question; answer the question of the trial")]
    Kind,
    /// The number of values differs from what is asked.
    #[error("{given} values are given, but {needed} are needed; answer everything that is asked")]
    Count {
        /// Number of values in the response.
        given: usize,
        /// Number of values that are needed.
        needed: usize,
    },
    /// A value is outside its scale.
    #[error("value {number} is {value}; it must be from {low} to {high}")]
    OutOfRange {
        /// Number of the value, from 1.
        number: usize,
        /// The value.
        value: f64,
        /// Lowest possible value.
        low: f64,
        /// Highest possible value.
        high: f64,
    },
    /// A group of a sort is empty.
    #[error("group {group} is empty; put at least one texture into each of the {n_groups} groups")]
    EmptyGroup {
        /// Number of the group, from 1.
        group: usize,
        /// Number of groups to make.
        n_groups: usize,
    },
}

/// Checks that a response answers a task of a part with this design.
///
/// # Errors
/// See [`ResponseError`].
pub fn check(response: &Response, task: &Task, design: &Design) -> Result<(), ResponseError> {
    if !task.fits(design) {
        return Err(ResponseError::Kind);
    }
    match (response, task) {
        (Response::Groups(groups), Task::Sort { stimuli, n_groups }) => {
            count(groups.len(), stimuli.len())?;
            in_range(groups.iter().map(|group| *group as f64), 0.0, *n_groups as f64 - 1.0)?;
            match (0..*n_groups).find(|group| !groups.contains(group)) {
                Some(empty) => Err(ResponseError::EmptyGroup { group: empty + 1, n_groups: *n_groups }),
                None => Ok(()),
            }
        }
        (Response::Votes(votes), Task::Vote { .. }) => count(votes.len(), n_values(design)),
        (Response::Sliders(values), Task::Rate { .. } | Task::Place { .. }) => {
            count(values.len(), n_values(design))?;
            in_range(values.iter().copied(), 0.0, 100.0)
        }
        (Response::Sliders(values), Task::Page { stimuli, .. }) => {
            count(values.len(), stimuli.len())?;
            in_range(values.iter().copied(), 0.0, 100.0)
        }
        (Response::Magnitude(value), Task::Compare { .. }) => in_range([*value], 0.0, f64::MAX),
        (Response::IsDifferent(_), Task::Discriminate { .. })
        | (Response::Side(_), Task::Detect { .. } | Task::Match { .. }) => Ok(()),
        (Response::Grade(grade), Task::Grade { .. }) => {
            in_range([f64::from(*grade)], 1.0, f64::from(n_points(design)))
        }
        (Response::Grades { grades, .. }, Task::Question { .. }) => {
            count(grades.len(), n_values(design))?;
            in_range(grades.iter().map(|grade| f64::from(*grade)), 1.0, f64::from(n_points(design)))
        }
        _ => Err(ResponseError::Kind),
    }
}

/// Number of values that a trial of a design asks for.
fn n_values(design: &Design) -> usize {
    match design {
        Design::Relevance { adjectives, .. } => adjectives.len(),
        Design::Rating { pairs, .. } => pairs.len(),
        Design::Likert { statements, .. } => statements.len(),
        _ => 1,
    }
}

fn n_points(design: &Design) -> u32 {
    match design {
        Design::Similarity { n_points, .. } | Design::Likert { n_points, .. } => *n_points,
        _ => 1,
    }
}

fn count(given: usize, needed: usize) -> Result<(), ResponseError> {
    if given == needed { Ok(()) } else { Err(ResponseError::Count { given, needed }) }
}

fn in_range(values: impl IntoIterator<Item = f64>, low: f64, high: f64) -> Result<(), ResponseError> {
    let mut outside = values.into_iter().enumerate().filter(|(_, value)| !(low..=high).contains(value));
    match outside.next() {
        Some((index, value)) => Err(ResponseError::OutOfRange { number: index + 1, value, low, high }),
        None => Ok(()),
    }
}
