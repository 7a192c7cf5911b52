//! Status of a device, shared by its threads with the handle: counters, and the error that ends the connection.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rtrb::{Consumer, Producer, RingBuffer};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::status::{LinkState, Status};

/// Time without a callback, in seconds, after which a device counts as stalled. If the device then reports an error, it
/// counts as lost.
pub const STALL_SECS: f64 = 1.0;
/// The same limit, in seconds, for a newly opened device before its first callback; some take seconds to start.
pub const START_SECS: f64 = 5.0;

/// Message when another process has taken the output over.
const TAKEN_OVER: &str = "the output was taken over by another Shagreen; open it again to take it back";

/// Counters that all threads share without waiting.
#[derive(Debug)]
pub(crate) struct Shared {
    opened: Instant,
    /// Microseconds from `opened` to the last callback, plus one; zero before the first.
    last_callback: AtomicU64,
    /// Microseconds from `opened` to the estimated end of playback of the last block, from the device's stated latency.
    heard: AtomicU64,
    underruns: AtomicU64,
    backend_errors: AtomicU64,
    lost: AtomicBool,
    /// Whether the device was given up to another process.
    given_up: AtomicBool,
}

impl Shared {
    /// Records a callback.
    pub(crate) fn note_callback(&self, now: Instant) {
        let micros = now.saturating_duration_since(self.opened).as_micros() as u64;
        self.last_callback.store(micros + 1, Ordering::Relaxed);
    }

    /// Records when the block that the callback is about to return will have been played.
    pub(crate) fn note_heard_by(&self, time: Instant) {
        let micros = time.saturating_duration_since(self.opened).as_micros() as u64;
        self.heard.fetch_max(micros, Ordering::Relaxed);
    }

    /// Time at which all returned blocks will have been played, from the device's stated latency.
    pub(crate) fn heard_by(&self) -> Instant {
        self.opened + Duration::from_micros(self.heard.load(Ordering::Relaxed))
    }

    pub(crate) fn note_underrun(&self) {
        self.underruns.fetch_add(1, Ordering::Relaxed);
    }

    /// Adds underruns that the device reports.
    pub(crate) fn note_underruns(&self, n: u64) {
        self.underruns.fetch_add(n, Ordering::Relaxed);
    }

    /// Adds errors after which the device continued.
    pub(crate) fn note_errors(&self, n: u64) {
        self.backend_errors.fetch_add(n, Ordering::Relaxed);
    }

    /// Marks the device as lost to another process; it is silent from now on.
    pub(crate) fn give_up(&self) {
        self.given_up.store(true, Ordering::Relaxed);
        self.lost.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Relaxed)
    }

    fn last_callback(&self) -> Option<Duration> {
        self.last_callback.load(Ordering::Relaxed).checked_sub(1).map(Duration::from_micros)
    }

    /// Whether the last callback is too long ago.
    fn is_silent(&self, now: Instant) -> bool {
        let since_opened = now.saturating_duration_since(self.opened);
        let (since, limit_secs) = match self.last_callback() {
            Some(last) => (since_opened.saturating_sub(last), STALL_SECS),
            None => (since_opened, START_SECS),
        };
        since.as_secs_f64() > limit_secs
    }
}

/// The device's side of the link.
#[derive(Debug)]
pub(crate) struct Reporter {
    pub(crate) shared: Arc<Shared>,
    losses: Producer<DeviceError>,
}

impl Reporter {
    /// Marks the device as lost; it is silent from now on. Only the first such error is kept.
    pub(crate) fn lose(&mut self, error: DeviceError) {
        if !self.shared.lost.swap(true, Ordering::Relaxed) {
            self.losses.push(error).ok(); // Full: it holds the first loss, which is reported.
        }
    }

    /// Records an underrun.
    pub(crate) fn note_underrun(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        self.shared.note_underrun();
        self.lose_if_silent(now, error);
    }

    /// Records an error after which the device may continue.
    pub(crate) fn note_error(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        self.shared.backend_errors.fetch_add(1, Ordering::Relaxed);
        self.lose_if_silent(now, error);
    }

    /// Marks the device as lost with `error` if there was no callback for [`STALL_SECS`]. Errors alone are not a loss:
    /// some devices report thousands when they start and then play correctly.
    fn lose_if_silent(&mut self, now: Instant, error: impl FnOnce() -> DeviceError) {
        if self.shared.is_silent(now) {
            self.lose(error());
        }
    }
}

/// The handle's side of the link.
#[derive(Debug)]
pub(crate) struct Monitor {
    shared: Arc<Shared>,
    losses: Consumer<DeviceError>,
    loss: Option<DeviceError>,
}

impl Monitor {
    /// Fills in the fields of `status` that describe the device.
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
            self.loss = self.losses.pop().ok(); // Empty: the device is not lost.
            if self.loss.is_none() && self.shared.given_up.load(Ordering::Relaxed) {
                self.loss = Some(DeviceError::new(DeviceErrorKind::Claimed, TAKEN_OVER));
            }
        }
        self.loss.as_ref()
    }
}

/// Returns both sides of the link to a device that is opened now.
pub(crate) fn link() -> (Reporter, Monitor) {
    let shared = Arc::new(Shared {
        opened: Instant::now(),
        last_callback: AtomicU64::new(0),
        heard: AtomicU64::new(0),
        underruns: AtomicU64::new(0),
        backend_errors: AtomicU64::new(0),
        lost: AtomicBool::new(false),
        given_up: AtomicBool::new(false),
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
