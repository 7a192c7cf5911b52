//! Judgments of the textures: sorting data, ratings and relevance votes, read from files in the background.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::Library;
use shagreen_formats::places_csv::Scale;
use shagreen_formats::similar_names::look_alikes;

use crate::state::background::in_background;
use crate::state::source::Source;
use crate::strings::build as strings;
use shagreen_studio::judgments::{
    JudgmentKind, JudgmentTable, SimulatedJudgments, kind_of, read_judgments, rescaled, simulate, source_of,
};
use shagreen_studio::study::analysis::StudyJudgments;

/// Judgments of one kind.
#[derive(Clone, Debug)]
pub struct Slot<T> {
    /// Name and values of the last file that was read without an error.
    pub read: Option<(String, Arc<Vec<T>>)>,
    /// Warnings about these values, in sentences.
    pub warnings: Vec<String>,
    /// Why the last file cannot be used. The values read before it are kept.
    pub failure: Option<String>,
    /// Number of the request that led to this state.
    ticket: u64,
}

/// All judgments from which a space is built.
#[derive(Default)]
pub struct Judgments {
    /// Sorting of textures into groups.
    pub sorting: Slot<Sort>,
    /// Ratings of textures on adjective pairs.
    pub ratings: Slot<Rating>,
    /// Votes on which adjectives are relevant.
    pub votes: Slot<RelevanceVote>,
    reading: Vec<Receiver<(u64, Outcome)>>,
    n_tickets: u64,
    /// Warnings about participants that may be the same person, in sentences.
    alike: Vec<String>,
    /// Whether there are judgments, and none of them is by a simulated rater.
    are_people: bool,
    /// Increases whenever other data is read.
    generation: u64,
}

/// Result of reading a file.
struct Outcome {
    name: String,
    content: Content,
}

enum Content {
    Table(JudgmentTable),
    Simulated(SimulatedJudgments),
    Failed(JudgmentKind, String),
}

impl<T> Default for Slot<T> {
    fn default() -> Self {
        Self { read: None, warnings: Vec::new(), failure: None, ticket: 0 }
    }
}

impl<T> Slot<T> {
    /// Values that come from no file; without any, an empty slot.
    fn of(name: &str, values: Vec<T>, ticket: u64) -> Self {
        let read = (!values.is_empty()).then(|| (name.to_owned(), Arc::new(values)));
        Self { read, ticket, ..Self::default() }
    }

    /// Values that were read; empty if there are none.
    pub fn values(&self) -> &[T] {
        self.read.as_ref().map_or(&[], |(_, values)| values)
    }

    /// The same values, shared.
    pub(super) fn shared(&self) -> Arc<Vec<T>> {
        self.read.as_ref().map_or_else(Arc::default, |(_, values)| Arc::clone(values))
    }

    /// Takes over the result of a request, unless a later request finished first. Returns whether the values have
    /// changed.
    fn take(&mut self, ticket: u64, name: &str, values: Result<Imported<Vec<T>>, String>) -> bool {
        if ticket < self.ticket {
            return false;
        }
        self.ticket = ticket;
        match values {
            Ok(Imported { value, warnings }) => {
                (self.read, self.failure) = (Some((name.to_owned(), Arc::new(value))), None);
                self.warnings = warnings;
            }
            Err(reason) => self.failure = Some(format!("{name}: {reason}")),
        }
        self.failure.is_none()
    }
}

impl Judgments {
    /// Reads files in the background, as `kind` or as the kind detected from their names and columns.
    pub fn read(&mut self, sources: Vec<Source>, kind: Option<JudgmentKind>, ctx: &Context) {
        for source in sources {
            self.begin(ctx, move || Outcome { name: source.name(), content: content(&source, kind) });
        }
    }

    /// Replaces the judgments by those of a simulated panel, in the background.
    pub fn simulate(&mut self, library: Library, seed: u64, ctx: &Context) {
        self.begin(ctx, move || {
            let content = match simulate(&library, seed) {
                Ok(simulated) => Content::Simulated(simulated),
                Err(reason) => Content::Failed(JudgmentKind::Sorting, reason),
            };
            Outcome { name: strings::SIMULATED_PANEL.to_owned(), content }
        });
    }

    /// Replaces all judgments by those of a study with this name. Kinds of judgments that the study does not have become empty.
    pub(super) fn take_study(&mut self, name: &str, judgments: StudyJudgments) {
        self.n_tickets += 1;
        let ticket = self.n_tickets;
        let StudyJudgments { sorts, ratings, votes } = judgments;
        self.sorting = Slot::of(name, sorts, ticket);
        self.ratings = Slot::of(name, ratings, ticket);
        self.votes = Slot::of(name, votes, ticket);
        self.changed();
    }

    fn begin(&mut self, ctx: &Context, work: impl FnOnce() -> Outcome + Send + 'static) {
        self.n_tickets += 1;
        let ticket = self.n_tickets;
        self.reading.push(in_background(ctx.clone(), move || (ticket, work())));
    }

    /// Takes over the files that have been read.
    pub fn collect(&mut self) {
        let mut arrived = Vec::new();
        self.reading.retain(|receiver| match receiver.try_recv() {
            Ok(outcome) => {
                arrived.push(outcome);
                false
            }
            Err(error) => error == TryRecvError::Empty,
        });
        for (ticket, Outcome { name, content }) in arrived {
            let is_new = match content {
                Content::Table(JudgmentTable::Sorting(sorts)) => self.sorting.take(ticket, &name, Ok(sorts)),
                Content::Table(JudgmentTable::Ratings(ratings)) => {
                    self.ratings.take(ticket, &name, Ok(ratings))
                }
                Content::Table(JudgmentTable::Votes(votes)) => {
                    self.votes.take(ticket, &name, Ok(sound(votes)))
                }
                Content::Simulated(SimulatedJudgments { sorts, ratings }) => {
                    self.votes = Slot { ticket: ticket.max(self.votes.ticket), ..Slot::default() };
                    let has_sorts = self.sorting.take(ticket, &name, Ok(sound(sorts)));
                    self.ratings.take(ticket, &name, Ok(sound(ratings))) || has_sorts
                }
                Content::Failed(JudgmentKind::Sorting, reason) => {
                    self.sorting.take(ticket, &name, Err(reason))
                }
                Content::Failed(JudgmentKind::Ratings, reason) => {
                    self.ratings.take(ticket, &name, Err(reason))
                }
                Content::Failed(JudgmentKind::Votes, reason) => self.votes.take(ticket, &name, Err(reason)),
            };
            if is_new {
                self.changed();
            }
        }
    }

    fn changed(&mut self) {
        self.generation += 1;
        let names = self.sorting.values().iter().map(|sort| sort.participant.as_str());
        let names = names.chain(self.ratings.values().iter().map(|rating| rating.participant.as_str()));
        let names: BTreeSet<&str> =
            names.chain(self.votes.values().iter().map(|v| v.participant.as_str())).collect();
        let names: Vec<&str> = names.into_iter().collect();
        self.alike = look_alikes(&names, strings::PARTICIPANTS);
        self.are_people = !names.is_empty() && self.source() == LabelSource::HumanRatings;
    }

    /// Warnings about participants that may be the same person, written in several ways; in sentences.
    pub fn alike(&self) -> &[String] {
        &self.alike
    }

    /// Whether the participants are assumed to be people: there are some, and none has the name of a simulated rater.
    pub fn are_people(&self) -> bool {
        self.are_people
    }

    /// Ratings, converted to 0..100 from a scale with these ends.
    ///
    /// # Errors
    /// The ends are no scale, or a rating is not on it, in one sentence.
    pub(super) fn ratings_on(&self, [low, high]: [f64; 2]) -> Result<Arc<Vec<Rating>>, String> {
        let scale = Scale::new(low, high).map_err(|error| error.to_string())?;
        if scale == Scale::OF_SPACE {
            return Ok(self.ratings.shared());
        }
        let converted = self.ratings.values().iter().map(|rating| rescaled(rating.clone(), scale));
        converted.collect::<Result<Vec<_>, _>>().map(Arc::new)
    }

    /// Removes the judgments of one kind.
    pub fn clear(&mut self, kind: JudgmentKind) {
        self.n_tickets += 1;
        let ticket = self.n_tickets;
        match kind {
            JudgmentKind::Sorting => self.sorting = Slot { ticket, ..Slot::default() },
            JudgmentKind::Ratings => self.ratings = Slot { ticket, ..Slot::default() },
            JudgmentKind::Votes => self.votes = Slot { ticket, ..Slot::default() },
        }
        self.changed();
    }

    /// Whether files are being read.
    pub fn is_reading(&self) -> bool {
        !self.reading.is_empty()
    }

    /// Number that increases whenever other data is read.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Source of the judgments. It is simulated raters as soon as any participant is simulated.
    pub fn source(&self) -> LabelSource {
        let sorters = self.sorting.values().iter().map(|sort| sort.participant.as_str());
        let raters = self.ratings.values().iter().map(|rating| rating.participant.as_str());
        source_of(sorters.chain(raters))
    }
}

fn sound<T>(value: T) -> Imported<T> {
    Imported { value, warnings: Vec::new() }
}

fn content(source: &Source, kind: Option<JudgmentKind>) -> Content {
    let bytes = match source.bytes() {
        Ok(bytes) => bytes,
        Err(reason) => return Content::Failed(kind.unwrap_or(JudgmentKind::Sorting), reason),
    };
    let kind = kind.unwrap_or_else(|| kind_of(&source.name(), &bytes));
    match read_judgments(kind, &bytes) {
        Ok(table) => Content::Table(table),
        Err(reason) => Content::Failed(kind, reason),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use shagreen_core::people::ratings::Rating;

    use super::{Judgments, Slot, sound};

    #[test]
    fn ratings_are_converted_from_the_stated_scale() {
        let rating = |value: f64| Rating {
            participant: "p1".to_owned(),
            texture: "cork".to_owned(),
            pair: "rough-smooth".parse().unwrap(),
            value: Some(value),
        };
        let mut judgments = Judgments::default();
        judgments.ratings.take(1, "r.csv", Ok(sound(vec![rating(1.0), rating(7.0)])));
        let values = |scale: [f64; 2]| {
            judgments.ratings_on(scale).map(|all| all.iter().map(|r| r.value.unwrap()).collect::<Vec<_>>())
        };
        assert_eq!(values([1.0, 7.0]), Ok(vec![0.0, 100.0]));
        assert_eq!(values([0.0, 100.0]), Ok(vec![1.0, 7.0]));
        assert!(Arc::ptr_eq(&judgments.ratings_on([0.0, 100.0]).unwrap(), &judgments.ratings.shared()));
        assert!(values([1.0, 6.0]).is_err_and(|reason| reason.contains("p1 rated cork 7")));
        assert!(values([7.0, 1.0]).is_err_and(|reason| reason.contains("low end")));
    }

    /// The file requested last counts, whichever is read first. A file that fails leaves the previous values.
    #[test]
    fn what_came_late_or_failed_changes_nothing() {
        let mut slot: Slot<u8> = Slot::default();
        assert!(slot.take(2, "second.csv", Ok(sound(vec![2]))));
        assert!(!slot.take(1, "first.csv", Ok(sound(vec![1]))));
        assert!(!slot.take(3, "third.csv", Err("it is empty".to_owned())));
        assert_eq!(slot.values(), [2]);
        assert_eq!(slot.failure.as_deref(), Some("third.csv: it is empty"));
    }
}
