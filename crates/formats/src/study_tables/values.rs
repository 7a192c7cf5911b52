//! Rows of one answer: one for each value of its response.

use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::people::study::answer::Response;
use shagreen_core::people::study::plan::{Comparison, Design, Prompts};
use shagreen_core::people::study::trial::{Side, Task};

/// Fields that differ between the values of one answer.
#[derive(Clone, Default)]
pub(super) struct Row {
    pub(super) stimulus: String,
    pub(super) other_stimulus: String,
    pub(super) item: String,
    pub(super) presented: String,
    pub(super) value: String,
}

/// Rows of a response to a task of a part with this design; none if they do not belong together.
pub(super) fn rows(design: &Design, task: &Task, response: &Response) -> Vec<Row> {
    match (task, response) {
        (Task::Sort { stimuli, n_groups }, Response::Groups(groups)) => {
            let row = |(stimulus, group): (&String, &usize)| Row {
                stimulus: stimulus.clone(),
                presented: n_groups.to_string(),
                value: (group + 1).to_string(),
                ..Row::default()
            };
            stimuli.iter().zip(groups).map(row).collect()
        }
        (Task::Vote { stimulus }, Response::Votes(votes)) => {
            let values = votes.iter().map(|vote| u8::from(*vote).to_string());
            with_items(&Row { stimulus: stimulus.clone(), ..Row::default() }, &items(design), values)
        }
        (Task::Rate { stimulus }, Response::Sliders(values)) => {
            let values = values.iter().map(ToString::to_string);
            with_items(&Row { stimulus: stimulus.clone(), ..Row::default() }, &items(design), values)
        }
        (Task::Question { prompt, condition }, Response::Grades { prompt: text, grades }) => {
            let prompt = match design {
                Design::Likert { prompts: Prompts::Given(_), .. } => text.clone(),
                _ => format!("{}: {text}", prompt + 1),
            };
            let row = Row { stimulus: prompt, presented: condition.clone(), ..Row::default() };
            with_items(&row, &items(design), grades.iter().map(ToString::to_string))
        }
        (Task::Page { reference, stimuli }, Response::Sliders(values)) => {
            let row = |(stimulus, value): (&String, &f64)| Row {
                stimulus: stimulus.clone(),
                other_stimulus: reference.clone(),
                presented: if stimulus == reference { "hidden reference".to_owned() } else { String::new() },
                value: value.to_string(),
                ..Row::default()
            };
            stimuli.iter().zip(values).map(row).collect()
        }
        _ => single(task, response).into_iter().collect(),
    }
}

/// Row of a response with one value.
fn single(task: &Task, response: &Response) -> Option<Row> {
    let of_pair = |pair: &Comparison, presented: &str, value: String| Row {
        stimulus: pair.first.clone(),
        other_stimulus: pair.second.clone(),
        presented: presented.to_owned(),
        value,
        ..Row::default()
    };
    let order = |is_swapped: bool| if is_swapped { "swapped" } else { "in order" };
    Some(match (task, response) {
        (Task::Compare { pair, is_swapped }, Response::Magnitude(value)) => {
            of_pair(pair, order(*is_swapped), value.to_string())
        }
        (Task::Grade { pair, is_swapped }, Response::Grade(grade)) => {
            of_pair(pair, order(*is_swapped), grade.to_string())
        }
        (Task::Discriminate { pair, is_different, segment }, Response::IsDifferent(answered)) => Row {
            item: format!("segment {}", segment + 1),
            ..of_pair(pair, if *is_different { "different" } else { "same" }, u8::from(*answered).to_string())
        },
        (Task::Match { pair, is_swapped, .. }, Response::Side(side)) => {
            of_pair(pair, order(*is_swapped), side_word(*side).to_owned())
        }
        (Task::Detect { track, level, .. }, Response::Side(side)) => Row {
            item: format!("track {}", track + 1),
            presented: level.to_string(),
            value: side_word(*side).to_owned(),
            ..Row::default()
        },
        (Task::Place { stimulus, low, high }, Response::Sliders(values)) => Row {
            stimulus: stimulus.clone(),
            other_stimulus: format!("{low}|{high}"),
            value: values.first()?.to_string(),
            ..Row::default()
        },
        _ => return None,
    })
}

fn with_items(row: &Row, items: &[String], values: impl Iterator<Item = String>) -> Vec<Row> {
    items.iter().zip(values).map(|(item, value)| Row { item: item.clone(), value, ..row.clone() }).collect()
}

/// What each value of a response belongs to.
fn items(design: &Design) -> Vec<String> {
    match design {
        Design::Relevance { adjectives, .. } => adjectives.clone(),
        Design::Rating { pairs, .. } => pairs.iter().map(AdjectivePair::name).collect(),
        Design::Likert { statements, .. } => {
            statements.iter().map(|statement| statement.id.clone()).collect()
        }
        _ => Vec::new(),
    }
}

fn side_word(side: Side) -> &'static str {
    match side {
        Side::First => "first",
        Side::Second => "second",
    }
}
