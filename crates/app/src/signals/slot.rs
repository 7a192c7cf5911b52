//! One of the two places for signals: what lies there, where it came from, and what is being made for it.

use std::sync::Arc;

use egui::Context;
use shagreen_formats::imported::Imported;

use super::analysis::{OfOne, of_one};
use super::bench_signal::BenchSignal;
use super::reading::{BenchFile, Terms};
use crate::background::Newest;
use crate::import::source::Source;

/// Which place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The signal as it should be.
    A,
    /// What is compared with it, made of it, or painted.
    B,
}

impl Slot {
    /// Both, in their order.
    pub const ALL: [Self; 2] = [Self::A, Self::B];

    /// Where it is in a list of both.
    pub(super) fn index(self) -> usize {
        match self {
            Self::A => 0,
            Self::B => 1,
        }
    }

    /// Its letter.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// What a worker came to.
pub(super) struct Made {
    /// The file that it was read from, if it was.
    file: Option<Arc<BenchFile>>,
    signal: Result<Imported<BenchSignal>, String>,
}

/// A place and what lies there.
#[derive(Default)]
pub(super) struct Place {
    /// What is written in the field for a path.
    pub(super) path: String,
    /// What the file does not say of itself.
    pub(super) terms: Terms,
    file: Option<Arc<BenchFile>>,
    signal: Option<Arc<BenchSignal>>,
    /// What is odd about it, in sentences.
    pub(super) warnings: Vec<String>,
    /// Why what was tried last came to nothing: what was there stays.
    pub(super) failure: Option<String>,
    making: Newest<Made>,
    known: Option<(Arc<BenchSignal>, Arc<OfOne>)>,
    asking: Newest<(Arc<BenchSignal>, OfOne)>,
}

impl Place {
    /// The signal that lies there.
    pub(super) fn signal(&self) -> Option<&Arc<BenchSignal>> {
        self.signal.as_ref()
    }

    /// The file that it was read from.
    pub(super) fn file(&self) -> Option<&BenchFile> {
        self.file.as_deref()
    }

    /// What is known of the signal, or of the one that it was a moment ago.
    pub(super) fn known(&self) -> Option<&OfOne> {
        self.known.as_ref().map(|(_, of)| &**of)
    }

    /// Whether something is being made for this place.
    pub(super) fn is_making(&self) -> bool {
        self.making.is_busy()
    }

    /// Whether what is known is of the signal as it is.
    pub(super) fn is_known(&self) -> bool {
        self.known.as_ref().zip(self.signal.as_ref()).is_some_and(|((of, _), now)| Arc::ptr_eq(of, now))
    }

    /// Puts a signal there at once.
    pub(super) fn put(&mut self, signal: Arc<BenchSignal>) {
        (self.signal, self.failure) = (Some(signal), None);
        self.warnings.clear();
    }

    /// Nothing lies there any more.
    pub(super) fn clear(&mut self) {
        *self = Self { terms: self.terms, ..Self::default() };
    }

    /// Reads a file in the background.
    pub(super) fn read(&mut self, source: Source, ctx: &Context) {
        let terms = self.terms;
        self.making.ask(ctx, move || match BenchFile::read(&source) {
            Ok(file) => {
                let signal = file.signal(&terms).map_err(|reason| format!("{}: {reason}", file.name));
                Made { file: Some(Arc::new(file)), signal }
            }
            Err(reason) => Made { file: None, signal: Err(format!("{}: {reason}", source.name())) },
        });
    }

    /// Makes the signal of the file once more, on the terms as they are now.
    pub(super) fn read_again(&mut self, ctx: &Context) {
        let (Some(file), terms) = (self.file.clone(), self.terms) else { return };
        self.making.ask(ctx, move || {
            let signal = file.signal(&terms).map_err(|reason| format!("{}: {reason}", file.name));
            Made { file: Some(file), signal }
        });
    }

    /// Has a signal made in the background.
    pub(super) fn make(
        &mut self,
        ctx: &Context,
        work: impl FnOnce() -> Result<BenchSignal, String> + Send + 'static,
    ) {
        self.making.ask(ctx, move || {
            let signal = work().map(|value| Imported { value, warnings: Vec::new() });
            Made { file: None, signal }
        });
    }

    /// Takes in what workers came to; returns whether another signal lies there.
    pub(super) fn collect(&mut self, ctx: &Context) -> bool {
        let mut is_new = false;
        if let Some(Made { file, signal }) = self.making.collect(ctx) {
            match signal {
                Ok(Imported { value, warnings }) => {
                    self.put(Arc::new(value));
                    (self.file, self.warnings) = (file, warnings);
                    is_new = true;
                }
                Err(reason) => {
                    self.failure = Some(reason);
                    // What it needs can be said, and it is tried again.
                    if self.signal.is_none() {
                        self.file = file;
                    }
                }
            }
        }
        if let Some((signal, of)) = self.asking.collect(ctx) {
            self.known = Some((signal, Arc::new(of)));
        }
        if let Some(signal) = &self.signal
            && !self.is_known()
            && !self.asking.is_busy()
        {
            let signal = Arc::clone(signal);
            self.asking.ask(ctx, move || {
                let of = of_one(&signal);
                (signal, of)
            });
        }
        is_new
    }
}
