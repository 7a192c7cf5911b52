//! What people said of the textures: sortings, ratings and votes, read from files in the background.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::panel::is_simulated;
use shagreen_core::ratings::{Rating, RelevanceVote};
use shagreen_core::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::Library;
use shagreen_formats::look_alikes::look_alikes;
use shagreen_formats::ratings_csv::{read_ratings, read_ratings_csv, read_relevance_csv};
use shagreen_formats::sorting_csv::read_sorting_csv;

use crate::background::in_background;
use crate::build::panel_truth::{Simulated, simulate};
use crate::import::source::Source;
use crate::strings::build as strings;

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Textures in groups.
    Sorting,
    /// Textures on adjective pairs.
    Ratings,
    /// Which adjectives are relevant.
    Votes,
}

/// One kind of judgments.
#[derive(Clone, Debug)]
pub struct Slot<T> {
    /// What was read last without an error, and what it is called.
    pub read: Option<(String, Arc<Vec<T>>)>,
    /// What is odd about it, in sentences.
    pub warnings: Vec<String>,
    /// Why the file that was tried last cannot be used: what was read before stays.
    pub failure: Option<String>,
    /// The request that this came of.
    ticket: u64,
}

/// All judgments that a space is made of.
#[derive(Default)]
pub struct Judgments {
    /// Textures in groups.
    pub sorting: Slot<Sort>,
    /// Textures on adjective pairs.
    pub ratings: Slot<Rating>,
    /// Which adjectives are relevant.
    pub votes: Slot<RelevanceVote>,
    reading: Vec<Receiver<(u64, Outcome)>>,
    n_tickets: u64,
    /// Which participants may be one, in sentences.
    alike: Vec<String>,
    /// Goes up whenever something else was read.
    generation: u64,
}

/// What came of reading a file.
struct Outcome {
    name: String,
    content: Content,
}

enum Content {
    Sorting(Imported<Vec<Sort>>),
    Ratings(Imported<Vec<Rating>>),
    Votes(Vec<RelevanceVote>),
    Simulated(Simulated),
    Failed(Kind, String),
}

impl<T> Default for Slot<T> {
    fn default() -> Self {
        Self { read: None, warnings: Vec::new(), failure: None, ticket: 0 }
    }
}

impl<T> Slot<T> {
    /// What was read; empty where nothing was.
    pub fn values(&self) -> &[T] {
        self.read.as_ref().map_or(&[], |(_, values)| values)
    }

    /// What was read, to be passed on.
    pub(super) fn shared(&self) -> Arc<Vec<T>> {
        self.read.as_ref().map_or_else(Arc::default, |(_, values)| Arc::clone(values))
    }

    /// Takes what a request came to, unless a later one was there first; returns whether something else is read now.
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
    /// Reads files in the background, as `kind`, or as what they turn out to be.
    pub fn read(&mut self, sources: Vec<Source>, kind: Option<Kind>, ctx: &Context) {
        for source in sources {
            self.begin(ctx, move || Outcome { name: source.name(), content: content(&source, kind) });
        }
    }

    /// Puts a simulated panel in the place of people, in the background.
    pub fn simulate(&mut self, library: Library, seed: u64, ctx: &Context) {
        self.begin(ctx, move || {
            let content = match simulate(&library, seed) {
                Ok(simulated) => Content::Simulated(simulated),
                Err(reason) => Content::Failed(Kind::Sorting, reason),
            };
            Outcome { name: strings::SIMULATED_PANEL.to_owned(), content }
        });
    }

    fn begin(&mut self, ctx: &Context, work: impl FnOnce() -> Outcome + Send + 'static) {
        self.n_tickets += 1;
        let ticket = self.n_tickets;
        self.reading.push(in_background(ctx.clone(), move || (ticket, work())));
    }

    /// Takes in what has been read.
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
                Content::Sorting(sorts) => self.sorting.take(ticket, &name, Ok(sorts)),
                Content::Ratings(ratings) => self.ratings.take(ticket, &name, Ok(ratings)),
                Content::Votes(votes) => self.votes.take(ticket, &name, Ok(sound(votes))),
                Content::Simulated(Simulated { sorts, ratings }) => {
                    self.votes = Slot { ticket: ticket.max(self.votes.ticket), ..Slot::default() };
                    let has_sorts = self.sorting.take(ticket, &name, Ok(sound(sorts)));
                    self.ratings.take(ticket, &name, Ok(sound(ratings))) || has_sorts
                }
                Content::Failed(Kind::Sorting, reason) => self.sorting.take(ticket, &name, Err(reason)),
                Content::Failed(Kind::Ratings, reason) => self.ratings.take(ticket, &name, Err(reason)),
                Content::Failed(Kind::Votes, reason) => self.votes.take(ticket, &name, Err(reason)),
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
        self.alike = look_alikes(&names.into_iter().collect::<Vec<_>>(), strings::PARTICIPANTS);
    }

    /// Which participants may be one, written in several ways, in sentences.
    pub fn alike(&self) -> &[String] {
        &self.alike
    }

    /// Takes judgments of one kind away.
    pub fn clear(&mut self, kind: Kind) {
        self.n_tickets += 1;
        let ticket = self.n_tickets;
        match kind {
            Kind::Sorting => self.sorting = Slot { ticket, ..Slot::default() },
            Kind::Ratings => self.ratings = Slot { ticket, ..Slot::default() },
            Kind::Votes => self.votes = Slot { ticket, ..Slot::default() },
        }
        self.changed();
    }

    /// Whether files are being read.
    pub fn is_reading(&self) -> bool {
        !self.reading.is_empty()
    }

    /// Goes up whenever something else was read.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Who judged: whatever rests on simulated participants, in part only, says so.
    pub fn source(&self) -> LabelSource {
        let sorters = self.sorting.values().iter().map(|sort| &sort.participant);
        let raters = self.ratings.values().iter().map(|rating| &rating.participant);
        if sorters.chain(raters).any(|name| is_simulated(name)) {
            LabelSource::SimulatedRaters
        } else {
            LabelSource::HumanRatings
        }
    }
}

fn sound<T>(value: T) -> Imported<T> {
    Imported { value, warnings: Vec::new() }
}

fn content(source: &Source, kind: Option<Kind>) -> Content {
    let bytes = match source.bytes() {
        Ok(bytes) => bytes,
        Err(reason) => return Content::Failed(kind.unwrap_or(Kind::Sorting), reason),
    };
    match kind.unwrap_or_else(|| kind_of(&source.name(), &bytes)) {
        Kind::Sorting => read_sorting_csv(&bytes)
            .map(|table| Content::Sorting(Imported { value: table.sorts, warnings: table.warnings }))
            .map_err(|error| (Kind::Sorting, error.to_string())),
        Kind::Ratings => {
            read_ratings(&bytes).map(Content::Ratings).map_err(|error| (Kind::Ratings, error.to_string()))
        }
        Kind::Votes => {
            read_relevance_csv(&bytes).map(Content::Votes).map_err(|error| (Kind::Votes, error.to_string()))
        }
    }
    .unwrap_or_else(|(kind, reason)| Content::Failed(kind, reason))
}

/// What a file holds, by its columns. Almost any table may be a sorting with a column for each texture, votes with a
/// column for each adjective too, so that a name that says what it is goes first.
fn kind_of(name: &str, bytes: &[u8]) -> Kind {
    let name = name.to_lowercase();
    if ["vote", "relevan"].iter().any(|word| name.contains(word)) {
        Kind::Votes
    } else if read_ratings_csv(bytes).is_ok() || name.contains("rating") {
        Kind::Ratings
    } else if read_sorting_csv(bytes).is_ok() {
        Kind::Sorting
    } else if read_relevance_csv(bytes).is_ok() {
        Kind::Votes
    } else {
        Kind::Sorting
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Slot, kind_of, sound};

    #[test]
    fn a_file_is_known_by_its_columns() {
        let check = |name: &str, text: &str, expected: Kind| {
            assert_eq!(kind_of(name, text.as_bytes()), expected, "{text}");
        };
        check("a.csv", "participant,trial,groups,texture,group\np,1,3,cork,a\n", Kind::Sorting);
        check("a.csv", "participant,trial,cork,felt\np,1,a,b\n", Kind::Sorting);
        check("a.csv", "participant,texture,rough-smooth\np,cork,41\n", Kind::Ratings);
        check("a.csv", "participant,texture,adjective,value\np,cork,rough-smooth,41\n", Kind::Ratings);
        check("a.csv", "participant,adjective,relevant\np,rough,1\np,warm,0\n", Kind::Votes);
        check("votes.csv", "participant,rough,warm\np,1,0\n", Kind::Votes);
        check("ratings.csv", "participant,texture\np,cork\n", Kind::Ratings);
        check("a.csv", "nothing of it\n", Kind::Sorting);
    }

    /// The file that was asked for last counts, whichever is read first; one that fails leaves what was there.
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
