//! What the device says about itself, from its own threads to the handle: counters, and the error that ends it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rtrb::{Consumer, Producer, RingBuffer};

use crate::error::DeviceError;
use crate::status::{LinkState, Status};

/// A device that has not asked for samples for this long is stalled, and if it reports errors meanwhile, lost; seconds.
pub const STALL_SECS: f64 = 1.0;
/// The same for a device that has just been opened and has not asked yet: some take seconds to wake; seconds.
pub const START_SECS: f64 = 5.0;

/// Counters that every end sees; nothing waits for them.
#[derive(Debug)]
pub(crate) struct Shared {
    opened: Instant,
    /// Microseconds from `opened` to the last call of the callback, plus one; zero before the first.
    last_callback: AtomicU64,
    /// Microseconds from `opened` to when the last block will have been heard, as far as the device says.
    heard: AtomicU64,
    underruns: AtomicU64,
    backend_errors: AtomicU64,
    lost: AtomicBool,
}

impl Shared {
    /// The callback was called.
    pub(crate) fn note_callback(&self, now: Instant) {
        let micros = now.saturating_duration_since(self.opened).as_micros() as u64;
        self.last_callback.store(micros + 1, Ordering::Relaxed);
    }

    /// What the callback is about to hand over will have been heard by then.
    pub(crate) fn note_heard_by(&self, time: Instant) {
        let micros = time.saturating_duration_since(self.opened).as_micros() as u64;
        self.heard.fetch_max(micros, Ordering::Relaxed);
    }

    /// When all that has been handed over will have been heard, as far as the device says.
    pub(crate) fn heard_by(&self) -> Instant {
        self.opened + Duration::from_micros(self.heard.load(Ordering::Relaxed))
    }

    pub(crate) fn note_underrun(&self) {
        self.underruns.fetch_add(1, Ordering::Relaxed);
    }

    /// The device says that it ran out of samples so many times more.
    pub(crate) fn note_underruns(&self, n: u64) {
        self.underruns.fetch_add(n, Ordering::Relaxed);
    }

    /// The device says that it went on after so many more errors.
    pub(crate) fn note_errors(&self, n: u64) {
        self.backend_errors.fetch_add(n, Ordering::Relaxed);
    }

    pub(crate) fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Relaxed)
    }

    fn last_callback(&self) -> Option<Duration> {
        self.last_callback.load(Ordering::Relaxed).checked_sub(1).map(Duration::from_micros)
    }

    /// Whether the callback has not been called for too long.
    fn is_silent(&self, now: Instant) -> bool {
        let since_opened = now.saturating_duration_since(self.opened);
        let (since, limit_secs) = match self.last_callback() {
            Some(last) => (since_opened.saturating_sub(last), STALL_SECS),
            None => (since_opened, START_SECS),
        };
        since.as_secs_f64() > limit_secs
    }
}

/// The device's end.
#[derive(Debug)]
pub(crate) struct Reporter {
    pub(crate) shared: Arc<Shared>,
    losses: Producer<DeviceError>,
}

impl Reporter {
    /// The device is gone: silence from here on. Only the first such report is told.
    pub(crate) fn lose(&mut self, error: DeviceError) {
        if !self.shared.lost.swap(true, Ordering::Relaxed) {
            self.losses.push(error).ok(); // Full of the loss that came first, which is the one to tell.
        }
    }

    /// The device ran out of samples.
    pub(crate) fn note_underrun(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        self.shared.note_underrun();
        self.lose_if_silent(now, error);
    }

    /// The device reported an error that it may go on after.
    pub(crate) fn note_error(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        self.shared.backend_errors.fetch_add(1, Ordering::Relaxed);
        self.lose_if_silent(now, error);
    }

    /// Some devices report thousands of errors when they start and then play perfectly, so errors are a loss only
    /// where nothing has been played for [`STALL_SECS`]: then they are told as `error`.
    fn lose_if_silent(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        if self.shared.is_silent(now) {
            self.lose(error());
        }
    }
}

/// The handle's end.
#[derive(Debug)]
pub(crate) struct Monitor {
    shared: Arc<Shared>,
    losses: Consumer<DeviceError>,
    loss: Option<DeviceError>,
}

impl Monitor {
    /// Fills in what the device says about itself.
    pub(crate) fn complete(&self, status: &mut Status, now: Instant) {
        status.underruns = self.shared.underruns.load(Ordering::Relaxed);
        status.backend_errors = self.shared.backend_errors.load(Ordering::Relaxed);
        status.state = if self.shared.is_lost() {
            LinkState::Lost
        } else if self.shared.is_silent(now) {
            LinkState::Stalled
        } else if self.shared.last_callback().is_none() {
            LinkState::Starting
        } else {
            LinkState::Running
        };
    }

    pub(crate) fn loss(&mut self) -> Option<&DeviceError> {
        if self.loss.is_none() {
            self.loss = self.losses.pop().ok(); // Empty: nothing is lost.
        }
        self.loss.as_ref()
    }
}

/// The two ends of a device opened now.
pub(crate) fn link() -> (Reporter, Monitor) {
    let shared = Arc::new(Shared {
        opened: Instant::now(),
        last_callback: AtomicU64::new(0),
        heard: AtomicU64::new(0),
        underruns: AtomicU64::new(0),
        backend_errors: AtomicU64::new(0),
        lost: AtomicBool::new(false),
    });
    let (producer, consumer) = RingBuffer::new(1);
    (
        Reporter { shared: Arc::clone(&shared), losses: producer },
        Monitor { shared, losses: consumer, loss: None },
    )
}

#[cfg(test)]
mod tests {
    use super::{Duration, Monitor, link};
    use crate::error::{DeviceError, DeviceErrorKind};
    use crate::status::{LinkState, Status};
    use std::time::Instant;

    fn error(text: &str) -> DeviceError {
        DeviceError::new(DeviceErrorKind::Lost, text)
    }

    fn state(monitor: &Monitor, now: Instant) -> LinkState {
        let mut status = Status::default();
        monitor.complete(&mut status, now);
        status.state
    }

    #[test]
    fn starts_runs_stalls_and_comes_back() {
        let (reporter, monitor) = link();
        let opened = reporter.shared.opened;
        let after = |secs| opened + Duration::from_secs_f64(secs);
        assert_eq!(state(&monitor, after(0.5)), LinkState::Starting);
        assert_eq!(state(&monitor, after(1.5)), LinkState::Starting);
        assert_eq!(state(&monitor, after(5.5)), LinkState::Stalled);
        reporter.shared.note_callback(after(6.0));
        assert_eq!(state(&monitor, after(6.5)), LinkState::Running);
        assert_eq!(state(&monitor, after(7.5)), LinkState::Stalled);
        reporter.shared.note_callback(after(8.0));
        assert_eq!(state(&monitor, after(8.1)), LinkState::Running);
    }

    #[test]
    fn a_burst_of_errors_is_forgiven_while_samples_are_asked_for() {
        let (mut reporter, mut monitor) = link();
        let opened = reporter.shared.opened;
        for i in 0..3000 {
            reporter.note_error(opened + Duration::from_micros(i), || error("burst"));
        }
        assert!(monitor.loss().is_none());
        reporter.shared.note_callback(opened + Duration::from_secs(9));
        reporter.note_error(opened + Duration::from_secs(9), || error("one more"));
        assert!(monitor.loss().is_none());
        let mut status = Status::default();
        monitor.complete(&mut status, opened + Duration::from_secs(9));
        assert_eq!((status.backend_errors, status.state), (3001, LinkState::Running));
    }

    #[test]
    fn errors_without_samples_are_a_loss_and_the_first_is_told() {
        let (mut reporter, mut monitor) = link();
        let called = reporter.shared.opened + Duration::from_secs(2);
        reporter.shared.note_callback(called);
        let late = called + Duration::from_secs(2);
        reporter.note_error(called, || error("too soon"));
        reporter.note_underrun(late, || error("first"));
        reporter.lose(error("second"));
        reporter.shared.note_callback(late);
        assert_eq!(state(&monitor, late), LinkState::Lost);
        assert_eq!(monitor.loss().unwrap().message(), "first");
        assert_eq!(monitor.loss().unwrap().message(), "first");
    }
}
