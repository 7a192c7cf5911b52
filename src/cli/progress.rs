//! Progress of long work on standard error: one line that is updated in place on a terminal, otherwise lines of a log.
//!
//! Work that is over within [`FIRST`] writes nothing to a log, so that quick commands stay silent in scripts.

use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::output::note;
use crate::cli::terminal_line::keep_intact;

/// Time from the beginning of the work to the first line of a log.
const FIRST: Duration = Duration::from_millis(300);
/// Shortest time between two lines of a log.
const NEXT: Duration = Duration::from_secs(5);
/// Time between two redraws on a terminal.
const REDRAW: Duration = Duration::from_millis(100);

/// Progress of one task, until it is dropped. Only one exists at a time.
pub(crate) struct Progress {
    bar: ProgressBar,
    log: Option<Log>,
}

impl Progress {
    /// Shows `task` in percent of `n` steps.
    pub(crate) fn new(task: &'static str, n: usize) -> Self {
        Self::styled("{msg} {bar:30} {percent} % {elapsed}", task, Some(n))
    }

    /// Shows `task` of hours, with the estimated time left.
    pub(crate) fn of_hours(task: &'static str, n: usize) -> Self {
        Self::styled("{msg} {bar:30} {percent} % {elapsed}, about {eta} left", task, Some(n))
    }

    /// Shows `task` with the elapsed time; its number of steps is unknown.
    pub(crate) fn endless(task: &'static str) -> Self {
        Self::styled("{spinner} {msg} {elapsed}", task, None)
    }

    fn styled(template: &str, task: &'static str, n: Option<usize>) -> Self {
        let bar = ProgressBar::with_draw_target(n.map(|n| n as u64), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(task);
        let log = if bar.is_hidden() {
            Log::start(task, bar.clone())
        } else {
            bar.enable_steady_tick(REDRAW);
            keep_intact(&bar);
            None
        };
        Self { bar, log }
    }

    /// Removes `n` steps that need not be done, so that they do not affect the estimated time.
    pub(crate) fn leave_out(&self, n: usize) {
        self.bar.dec_length(n as u64);
    }

    /// Counts one more step as done.
    pub(crate) fn step(&self) {
        self.steps(1);
    }

    /// Counts `n` more steps as done.
    pub(crate) fn steps(&self, n: usize) {
        self.bar.inc(n as u64);
    }

    /// Sets the rendered or played time in seconds; a task of time has [`in_ms`] steps.
    pub(crate) fn set_secs(&self, secs: f64) {
        self.bar.set_position(in_ms(secs) as u64);
    }

    /// Ends the progress, as dropping it does.
    pub(crate) fn finish(self) {
        drop(self);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.log = None;
        self.bar.finish_and_clear();
    }
}

/// Converts seconds to whole milliseconds.
pub(crate) fn in_ms(secs: f64) -> usize {
    (1e3 * secs) as usize
}

/// Thread that writes the lines of a log until this is dropped.
struct Log {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Log {
    fn start(task: &'static str, bar: ProgressBar) -> Option<Self> {
        let (stop, stopped) = mpsc::channel::<()>();
        let write = move || {
            let mut wait = FIRST;
            let mut is_first = true;
            while stopped.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                if is_first {
                    note(&format!("{task}: started"));
                } else {
                    note(&log_line(task, bar.position(), bar.length(), bar.elapsed()));
                }
                is_first = false;
                wait = interval(bar.elapsed());
            }
        };
        // The work does not depend on its log.
        let thread = std::thread::Builder::new().name("progress".into()).spawn(write).ok()?;
        Some(Self { stop: Some(stop), thread: Some(thread) })
    }
}

impl Drop for Log {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // A panic of the thread has been printed already.
        }
    }
}

/// Time to the next line of a log: longer after hours, which would otherwise fill it.
fn interval(elapsed: Duration) -> Duration {
    NEXT.max(elapsed / 20)
}

fn log_line(task: &str, done: u64, n: Option<u64>, elapsed: Duration) -> String {
    let secs = elapsed.as_secs();
    match n.filter(|n| *n > 0) {
        Some(n) => format!("{task}: {} % after {secs} s", (100 * done.min(n)) / n),
        None => format!("{task}: {secs} s so far"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, NEXT, Progress, interval, log_line};

    #[test]
    fn lines_of_a_log_state_how_far_the_work_is() {
        let at = Duration::from_millis(5300);
        assert_eq!(log_line("simulating materials", 2, Some(25), at), "simulating materials: 8 % after 5 s");
        assert_eq!(log_line("rendering", 30, Some(25), at), "rendering: 100 % after 5 s");
        assert_eq!(log_line("downloading", 0, None, at), "downloading: 5 s so far");
        assert_eq!(log_line("predicting", 0, Some(0), at), "predicting: 5 s so far");
    }

    #[test]
    fn lines_of_a_log_become_rarer() {
        assert_eq!(interval(Duration::ZERO), NEXT);
        assert_eq!(interval(Duration::from_mins(1)), NEXT);
        assert_eq!(interval(Duration::from_hours(10)), Duration::from_mins(30));
    }

    #[test]
    fn the_end_of_quick_work_is_not_delayed() {
        let begun = std::time::Instant::now();
        for _ in 0..20 {
            Progress::new("working", 3).finish();
        }
        assert!(begun.elapsed() < Duration::from_secs(4), "{:?}", begun.elapsed());
    }
}
