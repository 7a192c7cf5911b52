//! Background jobs.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Runs a job on its own thread. Its result is available from the next frame on.
pub(crate) fn in_background<T: Send + 'static>(
    ctx: egui::Context,
    work: impl FnOnce() -> T + Send + 'static,
) -> Receiver<T> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        // If the window has closed in the meantime, nobody receives the result.
        let _ = sender.send(work());
        ctx.request_repaint();
    });
    receiver
}

/// The job panicked and has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct JobPanicked;

/// Background jobs of which only the newest counts. One job runs at a time, and a newer one replaces a waiting one.
pub(crate) struct LatestJob<T> {
    running: Option<Receiver<T>>,
    waiting: Option<Box<dyn FnOnce() -> T + Send>>,
}

impl<T> Default for LatestJob<T> {
    fn default() -> Self {
        Self { running: None, waiting: None }
    }
}

impl<T: Send + 'static> LatestJob<T> {
    /// Starts a job, or queues it while another one runs.
    pub(crate) fn ask(&mut self, ctx: &egui::Context, work: impl FnOnce() -> T + Send + 'static) {
        if self.running.is_some() {
            self.waiting = Some(Box::new(work));
        } else {
            self.running = Some(in_background(ctx.clone(), work));
        }
    }

    /// Result of the newest job, when it is done.
    pub(crate) fn collect(&mut self, ctx: &egui::Context) -> Option<Result<T, JobPanicked>> {
        let done = match self.running.as_ref()?.try_recv() {
            Ok(done) => Ok(done),
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(JobPanicked),
        };
        self.running = None;
        if let Some(work) = self.waiting.take() {
            self.running = Some(in_background(ctx.clone(), work));
            return None;
        }
        Some(done)
    }

    /// Whether a job is running.
    pub(crate) fn is_busy(&self) -> bool {
        self.running.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::{JobPanicked, LatestJob};
    use std::sync::mpsc::channel;
    use std::time::{Duration, Instant};

    fn wait<T: Send + 'static>(newest: &mut LatestJob<T>, ctx: &egui::Context) -> T {
        let begun = Instant::now();
        loop {
            if let Some(done) = newest.collect(ctx) {
                return done.expect("it does not break off");
            }
            assert!(begun.elapsed() < Duration::from_mins(1), "nothing came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn only_the_newest_work_counts() {
        let (ctx, mut newest) = (egui::Context::default(), LatestJob::default());
        let (go, held) = channel::<()>();
        newest.ask(&ctx, move || {
            let _ = held.recv();
            0
        });
        for i in 1..10 {
            newest.ask(&ctx, move || i);
        }
        assert!(newest.is_busy() && newest.collect(&ctx).is_none());
        go.send(()).unwrap();
        assert_eq!(wait(&mut newest, &ctx), 9);
        assert!(!newest.is_busy());
    }

    #[test]
    fn after_work_that_broke_off_there_is_other_work() {
        let (ctx, mut newest) = (egui::Context::default(), LatestJob::<u8>::default());
        newest.ask(&ctx, || panic!("as asked for"));
        let outcome = loop {
            if let Some(outcome) = newest.collect(&ctx) {
                break outcome;
            }
        };
        assert_eq!(outcome, Err(JobPanicked));
        newest.ask(&ctx, || 7);
        assert_eq!(wait(&mut newest, &ctx), 7);
    }
}
