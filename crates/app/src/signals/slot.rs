//! One of the two slots for signals: its signal, the file of that signal, and the background job for the slot.

use std::sync::Arc;

use egui::Context;
use shagreen_core::signals::spatial_spectrogram::ProfileFidelity;
use shagreen_formats::imported::Imported;
use shagreen_studio::quality_model::ChosenModel;

use super::analysis::{ByRate, by_rate, by_window};
use super::cached_analysis::Known;
use super::reading::{BenchFile, Terms};
use crate::choices::signals::Slot;
use crate::state::background::{JobPanicked, LatestJob};
use crate::state::bench_signal::BenchSignal;
use crate::state::source::Source;
use crate::strings::signals as strings;

impl Slot {
    /// Both slots, in their order.
    pub const ALL: [Self; 2] = [Self::A, Self::B];

    pub(super) fn index(self) -> usize {
        match self {
            Self::A => 0,
            Self::B => 1,
        }
    }

    /// Letter of the slot.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// Result of a worker.
pub(super) struct Made {
    /// File that the signal was read from, if any.
    file: Option<Arc<BenchFile>>,
    signal: Result<Imported<BenchSignal>, String>,
}

/// Slot and its signal.
#[derive(Default)]
pub(super) struct Place {
    /// Text in the path field.
    pub(super) path: String,
    /// Information that the file does not contain.
    pub(super) terms: Terms,
    file: Option<Arc<BenchFile>>,
    signal: Option<Arc<BenchSignal>>,
    /// Warnings about the signal, in sentences.
    pub(super) warnings: Vec<String>,
    /// Why the last request failed. The previous signal is kept.
    pub(super) failure: Option<String>,
    making: LatestJob<Made>,
    /// Whether a new file is being read.
    is_reading: bool,
    by_window: Known<Vec<ProfileFidelity>, 1>,
    by_rate: Known<ByRate, 1>,
}

impl Place {
    pub(super) fn signal(&self) -> Option<&Arc<BenchSignal>> {
        self.signal.as_ref()
    }

    /// File that the signal was read from.
    pub(super) fn file(&self) -> Option<&BenchFile> {
        self.file.as_deref()
    }

    /// Fidelity of the spatial spectrogram for each window length, once computed.
    pub(super) fn by_window(&self) -> Option<&[ProfileFidelity]> {
        self.by_window.of(&[Arc::clone(self.signal.as_ref()?)])?.ok().map(Vec::as_slice)
    }

    /// Fidelity of the signal at each bit rate of the codec, once computed.
    pub(super) fn by_rate(&self) -> Option<&ByRate> {
        self.by_rate.of(&[Arc::clone(self.signal.as_ref()?)])?.ok()
    }

    /// Whether a signal is being made for this slot.
    pub(super) fn is_making(&self) -> bool {
        self.making.is_busy()
    }

    /// Puts a signal into the slot at once. A job that is still running for the slot is discarded, and so is its file.
    pub(super) fn put(&mut self, signal: Arc<BenchSignal>) {
        (self.signal, self.failure, self.file) = (Some(signal), None, None);
        self.warnings.clear();
        (self.making, self.is_reading) = (LatestJob::default(), false);
    }

    /// Empties the slot.
    pub(super) fn clear(&mut self) {
        *self = Self { terms: self.terms, ..Self::default() };
    }

    /// Reads a file in the background.
    pub(super) fn read(&mut self, source: Source, ctx: &Context) {
        let terms = self.terms;
        self.is_reading = true;
        self.making.ask(ctx, move || match BenchFile::read(&source) {
            Ok(file) => {
                let signal = file.signal(&terms).map_err(|reason| format!("{}: {reason}", file.name));
                Made { file: Some(Arc::new(file)), signal }
            }
            Err(reason) => Made { file: None, signal: Err(format!("{}: {reason}", source.name())) },
        });
    }

    /// Makes the signal from its file again, with the present information. Does nothing while another file is being
    /// read.
    pub(super) fn read_again(&mut self, ctx: &Context) {
        if self.is_reading {
            return;
        }
        let (Some(file), terms) = (self.file.clone(), self.terms) else { return };
        self.making.ask(ctx, move || {
            let signal = file.signal(&terms).map_err(|reason| format!("{}: {reason}", file.name));
            Made { file: Some(file), signal }
        });
    }

    /// Makes a signal in the background.
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

    /// Takes over the result of the worker; returns whether the slot has a new signal.
    pub(super) fn collect(&mut self, ctx: &Context) -> bool {
        let Some(outcome) = self.making.collect(ctx) else { return false };
        self.is_reading = false;
        let broken = |JobPanicked| Made { file: None, signal: Err(strings::BROKE_OFF.to_owned()) };
        let Made { file, signal } = outcome.unwrap_or_else(broken);
        match signal {
            Ok(Imported { value, warnings }) => {
                self.put(Arc::new(value));
                (self.file, self.warnings) = (file, warnings);
                true
            }
            Err(reason) => {
                self.failure = Some(reason);
                // The user can add the missing information and try again.
                if self.signal.is_none() {
                    self.file = file;
                }
                false
            }
        }
    }

    /// Requests the fidelity for each window length.
    pub(super) fn ask_for_windows(&mut self, ctx: &Context) {
        if let Some(signal) = &self.signal {
            self.by_window.follow([Arc::clone(signal)], ctx, |[signal]| by_window(signal));
        }
    }

    /// Requests the fidelity at each bit rate of the codec. `model` predicts d'; `None` is the built-in one.
    pub(super) fn ask_for_rates(&mut self, model: Option<&Arc<ChosenModel>>, ctx: &Context) {
        if let Some(signal) = &self.signal {
            let model = model.cloned();
            self.by_rate.follow([Arc::clone(signal)], ctx, move |[signal]| by_rate(signal, model.as_deref()));
        }
    }

    /// Discards what the model of d' has predicted.
    pub(super) fn forget_rates(&mut self) {
        self.by_rate.forget();
    }
}

#[cfg(test)]
mod tests {
    use super::Place;
    use crate::state::bench_signal::tests::tone;
    use crate::state::source::Source;
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    fn wait(place: &mut Place, ctx: &egui::Context) {
        let start = Instant::now();
        while place.is_making() {
            place.collect(ctx);
            assert!(start.elapsed() < Duration::from_mins(1), "nothing came");
        }
    }

    #[test]
    fn what_is_put_there_stays_whatever_was_on_its_way() {
        let (ctx, mut place) = (egui::Context::default(), Place::default());
        let [late, now] = [50.0, 100.0].map(|hz| tone(hz, 1000.0, 1.0));
        place.make(&ctx, move || {
            std::thread::sleep(Duration::from_millis(20));
            Ok(late)
        });
        let now = Arc::new(now);
        place.put(Arc::clone(&now));
        assert!(!place.is_making());
        std::thread::sleep(Duration::from_millis(60));
        assert!(!place.collect(&ctx) && Arc::ptr_eq(place.signal().unwrap(), &now));
    }

    #[test]
    fn a_copy_over_a_file_is_no_file_any_more() {
        let (ctx, mut place) = (egui::Context::default(), Place::default());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "0,1\n1,2\n2,1\n3,2\n").unwrap();
        place.read(Source::Path(path), &ctx);
        wait(&mut place, &ctx);
        assert!(place.file().is_some() && place.signal().is_some());
        place.put(Arc::new(tone(50.0, 1000.0, 1.0)));
        assert!(place.file().is_none());
        place.read_again(&ctx);
        assert!(!place.is_making(), "nothing is read over it");
    }

    #[test]
    fn work_that_breaks_off_is_said() {
        let (ctx, mut place) = (egui::Context::default(), Place::default());
        place.make(&ctx, || panic!("as asked for"));
        wait(&mut place, &ctx);
        assert!(place.failure.is_some());
    }
}
