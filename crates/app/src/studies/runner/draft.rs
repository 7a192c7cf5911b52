//! Answer to a trial while the participant makes it.

use shagreen_core::people::study::answer::Response;
use shagreen_core::people::study::plan::Design;
use shagreen_core::people::study::trial::{Side, Task};

/// Value that a participant enters.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Entry {
    /// Puts a stimulus, by its index, into a group, or takes it out again.
    Group(usize, Option<usize>),
    /// Chooses an adjective, by its index, or does not.
    Vote(usize, bool),
    /// Moves a slider, by its index, to a position from 0 to 100.
    Slider(usize, f64),
    /// Writes a number.
    Number(String),
    /// Says whether the stimuli differ.
    IsDifferent(bool),
    /// Chooses an alternative.
    Side(Side),
    /// Grades a statement, by its index, from 1.
    Grade(usize, u32),
}

/// Values entered so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Draft {
    /// Group of each stimulus, and the number of groups.
    Groups(Vec<Option<usize>>, usize),
    /// Whether each adjective is chosen.
    Votes(Vec<bool>),
    /// Position of each slider.
    Sliders(Vec<Option<f64>>),
    /// Number as it is written.
    Number(String),
    IsDifferent(Option<bool>),
    Side(Option<Side>),
    Grade(Option<u32>),
    /// Grade of each statement.
    Grades(Vec<Option<u32>>),
}

impl Draft {
    /// Draft without values, for a task of a part with this design.
    pub(super) fn new(task: &Task, design: &Design) -> Self {
        match (task, design) {
            (Task::Sort { stimuli, n_groups }, _) => Self::Groups(vec![None; stimuli.len()], *n_groups),
            (Task::Vote { .. }, Design::Relevance { adjectives, .. }) => {
                Self::Votes(vec![false; adjectives.len()])
            }
            (Task::Rate { .. }, Design::Rating { pairs, .. }) => Self::Sliders(vec![None; pairs.len()]),
            (Task::Page { stimuli, .. }, _) => Self::Sliders(vec![None; stimuli.len()]),
            (Task::Compare { .. }, _) => Self::Number(String::new()),
            (Task::Discriminate { .. }, _) => Self::IsDifferent(None),
            (Task::Detect { .. } | Task::Match { .. }, _) => Self::Side(None),
            (Task::Grade { .. }, _) => Self::Grade(None),
            (Task::Question { .. }, Design::Likert { statements, .. }) => {
                Self::Grades(vec![None; statements.len()])
            }
            // A task without the lists of its part would not pass the check of its answer either.
            (Task::Place { .. } | Task::Vote { .. } | Task::Rate { .. } | Task::Question { .. }, _) => {
                Self::Sliders(vec![None])
            }
        }
    }

    /// Takes a value; one that does not belong to the task changes nothing.
    pub(super) fn enter(&mut self, entry: Entry) {
        match (self, entry) {
            (Self::Groups(groups, n_groups), Entry::Group(index, group)) => {
                if let Some(of) = groups.get_mut(index) {
                    *of = group.filter(|group| group < n_groups);
                }
            }
            (Self::Votes(votes), Entry::Vote(index, is_chosen)) => {
                if let Some(vote) = votes.get_mut(index) {
                    *vote = is_chosen;
                }
            }
            (Self::Sliders(sliders), Entry::Slider(index, value)) => {
                if let Some(slider) = sliders.get_mut(index) {
                    *slider = Some(value.clamp(0.0, 100.0));
                }
            }
            (Self::Number(number), Entry::Number(text)) => *number = text,
            (Self::IsDifferent(of), Entry::IsDifferent(is_different)) => *of = Some(is_different),
            (Self::Side(of), Entry::Side(side)) => *of = Some(side),
            (Self::Grade(of), Entry::Grade(_, grade)) => *of = Some(grade),
            (Self::Grades(grades), Entry::Grade(index, grade)) => {
                if let Some(of) = grades.get_mut(index) {
                    *of = Some(grade);
                }
            }
            _ => {}
        }
    }

    /// Whether one value is the whole answer, so that a participant needs no further step.
    pub(super) fn is_single_choice(&self) -> bool {
        matches!(self, Self::IsDifferent(_) | Self::Side(_))
    }

    /// The response, once all values are there; `text` is that of a question.
    pub(super) fn response(&self, text: &str) -> Option<Response> {
        match self {
            Self::Groups(groups, n_groups) => {
                let all: Vec<usize> = groups.iter().copied().collect::<Option<_>>()?;
                let has_all = (0..*n_groups).all(|group| all.contains(&group));
                has_all.then_some(Response::Groups(all))
            }
            Self::Votes(votes) => Some(Response::Votes(votes.clone())),
            Self::Sliders(sliders) => sliders.iter().copied().collect::<Option<_>>().map(Response::Sliders),
            Self::Number(text) => number_of(text).map(Response::Magnitude),
            Self::IsDifferent(is_different) => is_different.map(Response::IsDifferent),
            Self::Side(side) => side.map(Response::Side),
            Self::Grade(grade) => grade.map(Response::Grade),
            Self::Grades(grades) => {
                let grades: Vec<u32> = grades.iter().copied().collect::<Option<_>>()?;
                Some(Response::Grades { prompt: text.to_owned(), grades })
            }
        }
    }
}

/// Number that a participant has written, with a decimal point or comma; `None` if it is none or negative.
pub(super) fn number_of(text: &str) -> Option<f64> {
    let number: f64 = text.trim().replace(',', ".").parse().ok()?; // Half a number is not an error yet.
    (number.is_finite() && number >= 0.0).then_some(number)
}

/// Values that a participant enters to give a response, in the order of the screen.
pub(super) fn entries_of(response: &Response) -> Vec<Entry> {
    match response {
        Response::Groups(groups) => {
            groups.iter().enumerate().map(|(index, group)| Entry::Group(index, Some(*group))).collect()
        }
        Response::Votes(votes) => {
            votes.iter().enumerate().map(|(index, is_chosen)| Entry::Vote(index, *is_chosen)).collect()
        }
        Response::Sliders(values) => {
            values.iter().enumerate().map(|(index, value)| Entry::Slider(index, *value)).collect()
        }
        Response::Magnitude(value) => vec![Entry::Number(value.to_string())],
        Response::IsDifferent(is_different) => vec![Entry::IsDifferent(*is_different)],
        Response::Side(side) => vec![Entry::Side(*side)],
        Response::Grade(grade) => vec![Entry::Grade(0, *grade)],
        Response::Grades { grades, .. } => {
            grades.iter().enumerate().map(|(index, grade)| Entry::Grade(index, *grade)).collect()
        }
    }
}

#[cfg(test)]
mod tests;
