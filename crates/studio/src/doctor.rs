//! What works on this machine, and what to do about what does not: facts about the machine become lines.
//!
//! The rules here are pure. The command line gathers the [`Facts`].

mod facts;
mod files;
mod hands;
mod sound;
mod window;

use shagreen_device::pen_backend::Access;

pub use self::facts::{DisplayFact, DisplayFacts, Facts, FolderFact, NetworkFacts};
pub use self::window::{KNOWN_LIBRARIES, KnownLibrary, NeededBy};

/// State of a part of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It works.
    Works,
    /// It works with a limitation.
    Limited,
    /// It does not work.
    Fails,
    /// It is not there, and nothing needs it.
    Absent,
    /// The system does not say.
    Unknown,
}

/// A line of the report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Part of the machine, for people and for scripts.
    pub topic: &'static str,
    /// Its state.
    pub state: State,
    /// What was seen.
    pub seen: String,
    /// What to do; `None` if nothing is necessary.
    pub remedy: Option<String>,
}

impl State {
    /// All states.
    pub const ALL: [Self; 5] = [Self::Works, Self::Limited, Self::Fails, Self::Absent, Self::Unknown];

    /// Word for the state, for people and for scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Works => "works",
            Self::Limited => "limited",
            Self::Fails => "fails",
            Self::Absent => "absent",
            Self::Unknown => "unknown",
        }
    }
}

impl Line {
    /// A line without a remedy.
    fn new(topic: &'static str, state: State, seen: impl Into<String>) -> Self {
        Self { topic, state, seen: seen.into(), remedy: None }
    }

    /// This line with a remedy.
    fn with(self, remedy: impl Into<String>) -> Self {
        Self { remedy: Some(remedy.into()), ..self }
    }
}

/// Returns the lines for these facts, in a fixed order of topics. Every line that is not fine has a remedy.
pub fn lines(facts: &Facts) -> Vec<Line> {
    let parts = [sound::lines, hands::lines, window::lines, files::lines];
    parts.iter().flat_map(|part| part(facts)).collect()
}

/// Names of what may not be opened.
fn denied<'a, T>(all: &'a [(T, Access)], name: impl Fn(&'a T) -> &'a str) -> Vec<&'a str> {
    all.iter().filter(|(_, access)| !access.may_open()).map(|(one, _)| name(one)).collect()
}

#[cfg(test)]
mod tests;
