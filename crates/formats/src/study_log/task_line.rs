//! Tasks in the lines of a log.

use serde::{Deserialize, Serialize};
use shagreen_core::people::study::plan::Comparison;
use shagreen_core::people::study::trial::{Side, Task};

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SideV1 {
    First,
    Second,
}

#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum TaskV1 {
    Sort { stimuli: Vec<String>, groups: usize },
    Vote { stimulus: String },
    Rate { stimulus: String },
    Compare { pair: [String; 2], swapped: bool },
    Discriminate { pair: [String; 2], different: bool, segment: usize },
    Detect { track: usize, level: f64, target: SideV1, feedback: bool },
    Grade { pair: [String; 2], swapped: bool },
    Question { prompt: usize, condition: String },
    Match { pair: [String; 2], swapped: bool, x: SideV1 },
    Page { reference: String, stimuli: Vec<String> },
    Place { stimulus: String, low: String, high: String },
}

impl From<Side> for SideV1 {
    fn from(side: Side) -> Self {
        match side {
            Side::First => Self::First,
            Side::Second => Self::Second,
        }
    }
}

impl From<SideV1> for Side {
    fn from(side: SideV1) -> Self {
        match side {
            SideV1::First => Self::First,
            SideV1::Second => Self::Second,
        }
    }
}

fn names(pair: &Comparison) -> [String; 2] {
    [pair.first.clone(), pair.second.clone()]
}

fn comparison([first, second]: [String; 2]) -> Comparison {
    Comparison { first, second }
}

impl From<&Task> for TaskV1 {
    fn from(task: &Task) -> Self {
        match task {
            Task::Sort { stimuli, n_groups } => Self::Sort { stimuli: stimuli.clone(), groups: *n_groups },
            Task::Vote { stimulus } => Self::Vote { stimulus: stimulus.clone() },
            Task::Rate { stimulus } => Self::Rate { stimulus: stimulus.clone() },
            Task::Compare { pair, is_swapped } => Self::Compare { pair: names(pair), swapped: *is_swapped },
            Task::Discriminate { pair, is_different, segment } => {
                Self::Discriminate { pair: names(pair), different: *is_different, segment: *segment }
            }
            Task::Detect { track, level, target, has_feedback } => Self::Detect {
                track: *track,
                level: *level,
                target: (*target).into(),
                feedback: *has_feedback,
            },
            Task::Grade { pair, is_swapped } => Self::Grade { pair: names(pair), swapped: *is_swapped },
            Task::Question { prompt, condition } => {
                Self::Question { prompt: *prompt, condition: condition.clone() }
            }
            Task::Match { pair, is_swapped, x } => {
                Self::Match { pair: names(pair), swapped: *is_swapped, x: (*x).into() }
            }
            Task::Page { reference, stimuli } => {
                Self::Page { reference: reference.clone(), stimuli: stimuli.clone() }
            }
            Task::Place { stimulus, low, high } => {
                Self::Place { stimulus: stimulus.clone(), low: low.clone(), high: high.clone() }
            }
        }
    }
}

impl From<TaskV1> for Task {
    fn from(line: TaskV1) -> Self {
        match line {
            TaskV1::Sort { stimuli, groups } => Self::Sort { stimuli, n_groups: groups },
            TaskV1::Vote { stimulus } => Self::Vote { stimulus },
            TaskV1::Rate { stimulus } => Self::Rate { stimulus },
            TaskV1::Compare { pair, swapped } => {
                Self::Compare { pair: comparison(pair), is_swapped: swapped }
            }
            TaskV1::Discriminate { pair, different, segment } => {
                Self::Discriminate { pair: comparison(pair), is_different: different, segment }
            }
            TaskV1::Detect { track, level, target, feedback } => {
                Self::Detect { track, level, target: target.into(), has_feedback: feedback }
            }
            TaskV1::Grade { pair, swapped } => Self::Grade { pair: comparison(pair), is_swapped: swapped },
            TaskV1::Question { prompt, condition } => Self::Question { prompt, condition },
            TaskV1::Match { pair, swapped, x } => {
                Self::Match { pair: comparison(pair), is_swapped: swapped, x: x.into() }
            }
            TaskV1::Page { reference, stimuli } => Self::Page { reference, stimuli },
            TaskV1::Place { stimulus, low, high } => Self::Place { stimulus, low, high },
        }
    }
}
