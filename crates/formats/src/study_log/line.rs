//! Events as lines of a log.

use serde::{Deserialize, Serialize};
use shagreen_core::people::study::answer::{Answer, Event, Measured, Motion, Response};
use shagreen_core::people::study::setup::Setup;
use shagreen_core::people::study::trial::{Side, Trial};

use super::TimedEvent;
use super::setup_line::SetupV1;
use super::task_line::{SideV1, TaskV1};

#[derive(Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub(super) enum LineV1 {
    Setup(Box<SetupV1>),
    Consent { unix_s: f64 },
    Refuse { unix_s: f64 },
    Rest { unix_s: f64 },
    Answer(Box<AnswerV1>),
    Resume { unix_s: f64 },
    End { unix_s: f64 },
}

#[derive(Serialize, Deserialize)]
pub(super) struct AnswerV1 {
    unix_s: f64,
    part: String,
    trial: usize,
    practice: bool,
    /// Seed of the noise in the stimuli.
    seed: u64,
    task: TaskV1,
    response: ResponseV1,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    response_s: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    latency_ms: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    motion: Option<MotionV1>,
    /// Distance over each stimulus.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    touched_mm: Vec<f64>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    device: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    stimulus_hashes: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    plays: Vec<u32>,
}

#[derive(Serialize, Deserialize)]
struct MotionV1 {
    distance_mm: f64,
    mean_speed_mm_per_s: f64,
    mean_force_n: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum ResponseV1 {
    Groups(Vec<usize>),
    Votes(Vec<bool>),
    Sliders(Vec<f64>),
    Magnitude(f64),
    IsDifferent(bool),
    Side(SideV1),
    Grade(u32),
    Grades { prompt: String, grades: Vec<u32> },
}

impl From<&TimedEvent> for LineV1 {
    fn from(timed: &TimedEvent) -> Self {
        let unix_s = timed.unix_secs;
        match &timed.event {
            Event::SetUp(setup) => Self::Setup(Box::new(SetupV1::of(setup, unix_s))),
            Event::Consented => Self::Consent { unix_s },
            Event::Refused => Self::Refuse { unix_s },
            Event::Rested => Self::Rest { unix_s },
            Event::Answered(answer) => Self::Answer(Box::new(AnswerV1::of(answer, unix_s))),
            Event::Resumed => Self::Resume { unix_s },
            Event::Ended => Self::End { unix_s },
        }
    }
}

impl From<LineV1> for TimedEvent {
    fn from(line: LineV1) -> Self {
        let (unix_secs, event) = match line {
            LineV1::Setup(setup) => (setup.unix_s, Event::SetUp(Box::new(Setup::from(*setup)))),
            LineV1::Consent { unix_s } => (unix_s, Event::Consented),
            LineV1::Refuse { unix_s } => (unix_s, Event::Refused),
            LineV1::Rest { unix_s } => (unix_s, Event::Rested),
            LineV1::Answer(answer) => (answer.unix_s, Event::Answered(Box::new(Answer::from(*answer)))),
            LineV1::Resume { unix_s } => (unix_s, Event::Resumed),
            LineV1::End { unix_s } => (unix_s, Event::Ended),
        };
        Self { unix_secs, event }
    }
}

impl AnswerV1 {
    fn of(answer: &Answer, unix_s: f64) -> Self {
        let Answer { trial, response, measured } = answer;
        Self {
            unix_s,
            part: trial.part.clone(),
            trial: trial.number,
            practice: trial.is_practice,
            seed: trial.seed,
            task: TaskV1::from(&trial.task),
            response: ResponseV1::from(response),
            response_s: measured.response_secs,
            latency_ms: measured.latency_secs.map(|secs| 1e3 * secs),
            motion: measured.motion.map(|motion| MotionV1 {
                distance_mm: 1e3 * motion.distance_m,
                mean_speed_mm_per_s: 1e3 * motion.mean_speed_mps,
                mean_force_n: motion.mean_force_n,
            }),
            touched_mm: measured.touched_m.iter().map(|meters| 1e3 * meters).collect(),
            device: measured.device.clone(),
            stimulus_hashes: measured.stimulus_hashes.clone(),
            plays: measured.n_plays.clone(),
        }
    }
}

impl From<AnswerV1> for Answer {
    fn from(line: AnswerV1) -> Self {
        let trial = Trial {
            part: line.part,
            number: line.trial,
            is_practice: line.practice,
            seed: line.seed,
            task: line.task.into(),
        };
        let measured = Measured {
            response_secs: line.response_s,
            motion: line.motion.map(|motion| Motion {
                distance_m: motion.distance_mm / 1e3,
                mean_speed_mps: motion.mean_speed_mm_per_s / 1e3,
                mean_force_n: motion.mean_force_n,
            }),
            touched_m: line.touched_mm.iter().map(|mm| mm / 1e3).collect(),
            latency_secs: line.latency_ms.map(|ms| ms / 1e3),
            device: line.device,
            stimulus_hashes: line.stimulus_hashes,
            n_plays: line.plays,
        };
        Self { trial, response: line.response.into(), measured }
    }
}

impl From<&Response> for ResponseV1 {
    fn from(response: &Response) -> Self {
        match response {
            Response::Groups(groups) => Self::Groups(groups.clone()),
            Response::Votes(votes) => Self::Votes(votes.clone()),
            Response::Sliders(values) => Self::Sliders(values.clone()),
            Response::Magnitude(value) => Self::Magnitude(*value),
            Response::IsDifferent(is_different) => Self::IsDifferent(*is_different),
            Response::Side(side) => Self::Side((*side).into()),
            Response::Grade(grade) => Self::Grade(*grade),
            Response::Grades { prompt, grades } => {
                Self::Grades { prompt: prompt.clone(), grades: grades.clone() }
            }
        }
    }
}

impl From<ResponseV1> for Response {
    fn from(line: ResponseV1) -> Self {
        match line {
            ResponseV1::Groups(groups) => Self::Groups(groups),
            ResponseV1::Votes(votes) => Self::Votes(votes),
            ResponseV1::Sliders(values) => Self::Sliders(values),
            ResponseV1::Magnitude(value) => Self::Magnitude(value),
            ResponseV1::IsDifferent(is_different) => Self::IsDifferent(is_different),
            ResponseV1::Side(side) => Self::Side(Side::from(side)),
            ResponseV1::Grade(grade) => Self::Grade(grade),
            ResponseV1::Grades { prompt, grades } => Self::Grades { prompt, grades },
        }
    }
}
