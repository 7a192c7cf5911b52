//! A log that was read, with what is wrong with it.

use shagreen_core::people::study::answer::{Event, Record};
use shagreen_core::people::study::plan::Plan;

use super::{LogHeader, TimedEvent};

/// A log, and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLog {
    /// The first line.
    pub header: LogHeader,
    /// The plan in the header.
    pub plan: Plan,
    /// Events of all whole lines, in their order. If a trial is answered twice, only the first answer is among them.
    pub events: Vec<TimedEvent>,
    /// Lines that were skipped or need a look, in their order, the first thousand.
    pub problems: Vec<LineProblem>,
    /// Whether the last line is torn: the program ended while it was written, and its event is lost.
    pub is_torn: bool,
}

/// A line that was skipped, or that needs a look.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineProblem {
    /// Number of the line, from one.
    pub line: usize,
    /// What is wrong with it, and what became of it.
    pub text: String,
}

impl std::fmt::Display for LineProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {}", self.line, self.text)
    }
}

impl ReadLog {
    /// The events without their times.
    pub fn events(&self) -> Vec<Event> {
        self.events.iter().map(|timed| timed.event.clone()).collect()
    }

    /// Answers of the participant, for the analysis.
    pub fn record(&self) -> Record {
        let header = &self.header;
        Record::of(header.participant().to_owned(), header.number(), header.is_simulated(), &self.events())
    }

    /// Whether the participant did not agree to the consent text.
    pub fn has_refused(&self) -> bool {
        self.events.iter().any(|timed| timed.event == Event::Refused)
    }
}
