//! Results about signals, computed on a background thread only for the signals that are currently shown.

use std::sync::Arc;

use egui::Context;

use crate::state::background::{JobPanicked, LatestJob};
use crate::state::bench_signal::BenchSignal;

/// Result of one computation.
struct Answer<T, const N: usize> {
    of: [Arc<BenchSignal>; N],
    value: Result<T, JobPanicked>,
}

/// Last result about `N` signals.
pub(super) struct Known<T, const N: usize> {
    answer: Option<Answer<T, N>>,
    asking: LatestJob<([Arc<BenchSignal>; N], T)>,
    asked: Option<[Arc<BenchSignal>; N]>,
}

impl<T, const N: usize> Default for Known<T, N> {
    fn default() -> Self {
        Self { answer: None, asking: LatestJob::default(), asked: None }
    }
}

impl<T: Send + 'static, const N: usize> Known<T, N> {
    /// Takes over a finished computation, and starts one for these signals if there is none yet.
    pub(super) fn follow(
        &mut self,
        signals: [Arc<BenchSignal>; N],
        ctx: &Context,
        work: impl FnOnce(&[Arc<BenchSignal>; N]) -> T + Send + 'static,
    ) {
        match self.asking.collect(ctx) {
            Some(Ok((of, value))) => self.answer = Some(Answer { of, value: Ok(value) }),
            Some(Err(broken)) => {
                self.answer = self.asked.take().map(|of| Answer { of, value: Err(broken) });
            }
            None => {}
        }
        let is_asked = self.asked.as_ref().is_some_and(|asked| are_same(asked, &signals));
        // One computation at a time: while the user paints, the signals in between are skipped.
        if !is_asked && !self.asking.is_busy() && self.of(&signals).is_none() {
            self.asked = Some(signals.clone());
            self.asking.ask(ctx, move || {
                let value = work(&signals);
                (signals, value)
            });
        }
    }

    /// Discards the result and the computation that is running, because they depend on something that has changed.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }

    /// Result about these signals, once it is computed.
    pub(super) fn of(&self, signals: &[Arc<BenchSignal>; N]) -> Option<Result<&T, JobPanicked>> {
        let answer = self.answer.as_ref().filter(|answer| are_same(&answer.of, signals))?;
        Some(answer.value.as_ref().map_err(|broken| *broken))
    }
}

fn are_same<const N: usize>(a: &[Arc<BenchSignal>; N], b: &[Arc<BenchSignal>; N]) -> bool {
    a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
}

#[cfg(test)]
mod tests {
    use super::Known;
    use crate::state::background::JobPanicked;
    use crate::state::bench_signal::tests::tone;
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    #[test]
    fn what_is_known_is_of_the_signal_that_is_asked_about() {
        let ctx = egui::Context::default();
        let [first, second] = [100.0, 50.0].map(|hz| [Arc::new(tone(hz, 1000.0, 1.0))]);
        let mut known: Known<f64, 1> = Known::default();
        let start = Instant::now();
        let wait = |known: &mut Known<f64, 1>, of: &[Arc<_>; 1]| loop {
            known.follow(of.clone(), &ctx, |[signal]| signal.profile.values()[1]);
            if let Some(value) = known.of(of) {
                return value.copied();
            }
            assert!(start.elapsed() < Duration::from_mins(1), "nothing came");
        };
        let found = wait(&mut known, &first);
        assert_eq!(found, Ok(first[0].profile.values()[1]));
        assert!(known.of(&second).is_none(), "nothing is known of it, whatever is known of another");
        assert_eq!(wait(&mut known, &second), Ok(second[0].profile.values()[1]));
        known.forget();
        assert!(known.of(&second).is_none());
        assert_eq!(wait(&mut known, &second), Ok(second[0].profile.values()[1]), "it is computed again");
    }

    #[test]
    fn a_thread_that_breaks_off_is_not_started_for_ever() {
        let ctx = egui::Context::default();
        let signal = [Arc::new(tone(100.0, 1000.0, 1.0))];
        let mut known: Known<f64, 1> = Known::default();
        let start = Instant::now();
        while known.of(&signal).is_none() {
            known.follow(signal.clone(), &ctx, |_| panic!("as asked for"));
            assert!(start.elapsed() < Duration::from_mins(1), "nothing came");
        }
        assert_eq!(known.of(&signal), Some(Err(JobPanicked)));
        known.follow(signal, &ctx, |_| panic!("it is asked once"));
        assert!(!known.asking.is_busy());
    }
}
