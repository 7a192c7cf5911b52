//! Background thread that builds a space, so that the window stays responsive.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use egui::Context;
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_core::space::features::NamedTexture;
use shagreen_core::space::space_build::{SpaceData, SpaceOptions, Step};
use shagreen_core::texture::TextureModel;
use shagreen_studio::space::{self, BuiltSpace};

use crate::strings::build as strings;

/// Input of a build, owned by the worker.
pub(super) struct Order {
    pub(super) textures: Vec<(String, TextureModel)>,
    pub(super) sorts: Arc<Vec<Sort>>,
    pub(super) ratings: Arc<Vec<Rating>>,
    pub(super) votes: Arc<Vec<RelevanceVote>>,
    pub(super) source: LabelSource,
    pub(super) options: SpaceOptions,
}

enum Message {
    Step(Step),
    Done(Result<Box<BuiltSpace>, String>),
}

/// Running build. Dropping it asks the worker to stop. Late results are discarded, because every job has its own
/// channel.
pub(super) struct Job {
    messages: Receiver<Message>,
    is_cancelled: Arc<AtomicBool>,
    step: Step,
    started: Instant,
}

/// End of a build.
pub(super) enum Outcome {
    Built(Box<BuiltSpace>),
    /// Reason for the failure.
    Failed(String),
    /// Stopped on request; a late result is discarded.
    Cancelled,
}

impl Job {
    /// Starts to build. At every step, `ctx` is asked to repaint.
    pub(super) fn start(order: Order, ctx: &Context) -> Self {
        let (sender, messages) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (is_stopped, ctx) = (Arc::clone(&is_cancelled), ctx.clone());
        let step = if order.sorts.is_empty() { Step::Adjectives } else { Step::Sorting };
        std::thread::spawn(move || {
            let progress = Progress { sender, is_cancelled: is_stopped, told: Mutex::default(), ctx };
            let outcome = carry_out(&order, &progress);
            let Progress { sender, ctx, .. } = progress;
            // If the window was closed meanwhile, nobody receives the result.
            let _ = sender.send(Message::Done(outcome.map(Box::new)));
            ctx.request_repaint();
        });
        Self { messages, is_cancelled, step, started: Instant::now() }
    }

    /// Asks the worker to stop. It uses the processor until [`Job::collect`] returns an outcome.
    pub(super) fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the worker was asked to stop.
    pub(super) fn is_stopping(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// Outcome, once the worker has ended.
    pub(super) fn collect(&mut self) -> Option<Outcome> {
        let outcome = loop {
            match self.messages.try_recv() {
                Ok(Message::Step(step)) => self.step = step,
                Ok(Message::Done(Ok(built))) => break Outcome::Built(built),
                Ok(Message::Done(Err(reason))) => break Outcome::Failed(reason),
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => break Outcome::Failed(strings::BROKEN.to_owned()),
            }
        };
        Some(if self.is_stopping() { Outcome::Cancelled } else { outcome })
    }

    pub(super) fn step(&self) -> Step {
        self.step
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// Progress reports of the worker, and its stop flag.
struct Progress {
    sender: Sender<Message>,
    is_cancelled: Arc<AtomicBool>,
    told: Mutex<Option<Step>>,
    ctx: Context,
}

impl Progress {
    /// Reports a step and returns whether to continue. It may be called often: only a new step is sent, so that the
    /// window is not woken needlessly.
    fn at(&self, step: Step) -> bool {
        if self.is_cancelled.load(Ordering::Relaxed) {
            return false;
        }
        let told = self.told.lock().unwrap_or_else(PoisonError::into_inner).replace(step);
        if told == Some(step) {
            return true;
        }
        let is_heard = self.sender.send(Message::Step(step)).is_ok();
        self.ctx.request_repaint();
        is_heard
    }
}

fn carry_out(order: &Order, progress: &Progress) -> Result<BuiltSpace, String> {
    let data = SpaceData {
        textures: order.textures.iter().map(|(name, model)| NamedTexture { name, model }).collect(),
        sorts: order.sorts.to_vec(),
        ratings: order.ratings.to_vec(),
        votes: order.votes.to_vec(),
        source: order.source,
    };
    space::build(&data, &order.options, &|step| progress.at(step)).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::{Job, Message, Outcome, Progress};
    use egui::Context;
    use shagreen_core::space::space_build::Step;
    use std::sync::atomic::AtomicBool;
    use std::sync::mpsc::channel;
    use std::sync::{Arc, Mutex};
    use std::time::Instant;

    /// Job whose worker is the test.
    fn job() -> (Job, Progress) {
        let (sender, messages) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let progress = Progress {
            sender,
            is_cancelled: Arc::clone(&is_cancelled),
            told: Mutex::default(),
            ctx: Context::default(),
        };
        (Job { messages, is_cancelled, step: Step::Sorting, started: Instant::now() }, progress)
    }

    #[test]
    fn a_step_that_is_told_often_is_heard_once() {
        let (mut job, progress) = job();
        for step in [Step::Scaling, Step::Axis(0), Step::Axis(1)] {
            assert!((0..1000).all(|_| progress.at(step)));
            let told: Vec<Message> = job.messages.try_iter().collect();
            assert!(matches!(told[..], [Message::Step(only)] if only == step), "{} messages", told.len());
        }
        assert!(progress.at(Step::Axis(0)) && job.collect().is_none());
        assert_eq!(job.step(), Step::Axis(0));
    }

    /// A cancelled job stops within a step and remains until then. Its late result is discarded.
    #[test]
    fn a_cancelled_job_stops_within_a_step_and_comes_to_nothing() {
        let (mut job, progress) = job();
        assert!(progress.at(Step::Scaling));
        job.cancel();
        assert!(!progress.at(Step::Scaling) && !progress.at(Step::Adjectives));
        assert!(job.is_stopping() && job.collect().is_none());
        assert_eq!(job.step(), Step::Scaling, "nothing moves any more");
        progress.sender.send(Message::Done(Err("stopped".to_owned()))).unwrap();
        assert!(matches!(job.collect(), Some(Outcome::Cancelled)));
    }

    #[test]
    fn a_job_that_nobody_wants_any_more_stops() {
        let (job, progress) = job();
        drop(job);
        assert!(!progress.at(Step::Sorting));
    }

    #[test]
    fn a_worker_that_broke_off_is_said() {
        let (mut job, progress) = job();
        drop(progress);
        assert!(
            matches!(job.collect(), Some(Outcome::Failed(reason)) if reason.contains("stopped unexpectedly"))
        );
    }
}
