//! Lines of a log after the first one: events, copies of the first line, and what is damaged.

use std::collections::BTreeSet;

use shagreen_core::people::study::answer::{Answer, Event, check};
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::schedule::is_trial_of;

use super::line::LineV1;
use super::read_log::{LineProblem, ReadLog};
use super::{LogHeader, TimedEvent};
use crate::parser_words::plain;

/// Longest line of an event, in bytes. The longest sorts have some 100 kB.
const MAX_LINE_BYTES: usize = 1 << 20;

/// Number of damaged lines that are listed.
const MOST_PROBLEMS: usize = 1000;

/// First bytes of a header.
const HEADER_BEGIN: &[u8] = b"{\"format\":\"shagreen-study-log\"";

/// Lines of a log after the first one, with their indices.
pub(super) struct Lines<'a> {
    events: Vec<(usize, TimedEvent)>,
    /// Lines with a header: copies of the first one.
    headers: Vec<(usize, &'a [u8])>,
    problems: Vec<LineProblem>,
    is_torn: bool,
}

/// Lines with their indices.
pub(super) fn lines_of(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    bytes.split(|byte| *byte == b'\n').enumerate()
}

/// The header in a line, which may follow damaged bytes; `None` if there is none.
pub(super) fn header_in(line: &[u8]) -> Option<&[u8]> {
    let begin = line.windows(HEADER_BEGIN.len()).rposition(|window| window == HEADER_BEGIN)?;
    line.get(begin..)
}

/// The message of the parser without its line, which is that of the log.
pub(super) fn reason_of(error: &serde_json::Error) -> String {
    let message = error.to_string();
    plain(message.rsplit_once(" at line ").map_or(message.as_str(), |(words, _)| words))
}

impl<'a> Lines<'a> {
    /// Reads all lines but the first, for a session of this plan.
    pub(super) fn of(bytes: &'a [u8], plan: &Plan) -> Self {
        let mut lines =
            Self { events: Vec::new(), headers: Vec::new(), problems: Vec::new(), is_torn: false };
        let n_pieces = lines_of(bytes).count();
        for (index, line) in lines_of(bytes).skip(1) {
            let line = line.trim_ascii();
            if line.is_empty() {
                continue;
            }
            if let Some(header) = header_in(line) {
                lines.headers.push((index, header));
                continue;
            }
            match event_of(line, plan) {
                Ok(timed) => lines.events.push((index, timed)),
                // Whole lines have a line break, which leaves an empty piece at the end.
                Err(_) if index + 1 == n_pieces => {
                    lines.is_torn = true;
                    lines.add_problem(
                        index,
                        "it is torn: the program ended while it was written, and its event is lost",
                    );
                }
                Err(reason) => lines.add_problem(index, &format!("it is skipped: {reason}")),
            }
        }
        lines
    }

    /// Takes the lines with a header.
    pub(super) fn take_headers(&mut self) -> Vec<(usize, &'a [u8])> {
        std::mem::take(&mut self.headers)
    }

    /// All answers, also those that do not count.
    pub(super) fn answers(&self) -> impl Iterator<Item = &Answer> {
        self.events.iter().filter_map(|(_, timed)| {
            if let Event::Answered(answer) = &timed.event { Some(&**answer) } else { None }
        })
    }

    /// Time of the first event, in s since 1970; 0 without events.
    pub(super) fn begin_secs(&self) -> f64 {
        self.events.first().map_or(0.0, |(_, timed)| timed.unix_secs)
    }

    /// Adds a problem of a line by its index, unless there are too many to list.
    pub(super) fn add_problem(&mut self, index: usize, text: &str) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(LineProblem { line: index + 1, text: text.to_owned() });
        }
    }

    /// The log of this participant: without answers to trials of somebody else, and without second answers.
    pub(super) fn into_log(mut self, header: LogHeader, plan: Plan) -> ReadLog {
        let is_theirs = |answer: &Answer| is_trial_of(&plan, header.number(), &answer.trial);
        // If none fits, the number or the plan is another one. Who replays the answers reports that.
        let has_theirs = self.answers().any(is_theirs);
        let mut answered = BTreeSet::new();
        let mut events = Vec::with_capacity(self.events.len());
        for (index, timed) in std::mem::take(&mut self.events) {
            if let Event::Answered(answer) = &timed.event {
                let (part, number) = (answer.trial.part.clone(), answer.trial.number);
                let why = if has_theirs && !is_theirs(answer) {
                    Some("is skipped: it has another seed than the plan gives this participant")
                } else if answered.insert((part.clone(), number)) {
                    None
                } else {
                    Some("is answered before; the first answer counts")
                };
                if let Some(why) = why {
                    self.add_problem(index, &format!("part \"{part}\", trial {number} {why}"));
                    continue;
                }
            }
            events.push(timed);
        }
        self.problems.sort_by_key(|problem| problem.line);
        ReadLog { header, plan, events, problems: self.problems, is_torn: self.is_torn }
    }
}

/// The event of a line, or what is wrong with it.
fn event_of(line: &[u8], plan: &Plan) -> Result<TimedEvent, String> {
    if line.len() > MAX_LINE_BYTES {
        return Err(format!("it has more than {MAX_LINE_BYTES} bytes"));
    }
    let wire: LineV1 = serde_json::from_slice(line).map_err(|error| reason_of(&error))?;
    let timed = TimedEvent::from(wire);
    if let Event::Answered(answer) = &timed.event {
        let Some(part) = plan.part(&answer.trial.part) else {
            return Err(format!("the plan has no part \"{}\"", answer.trial.part));
        };
        check(&answer.response, &answer.trial.task, &part.design).map_err(|error| error.to_string())?;
        if let Some(shown) =
            answer.trial.task.shown().iter().find(|shown| plan.stimulus(&shown.stimulus).is_none())
        {
            return Err(format!("the plan has no stimulus \"{}\"", shown.stimulus));
        }
    }
    Ok(timed)
}
