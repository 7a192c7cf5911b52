//! The thread that builds a space, so that the window never waits.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

use egui::Context;
use shagreen_core::features::NamedTexture;
use shagreen_core::ratings::{Rating, RelevanceVote};
use shagreen_core::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_core::space_build::{SpaceBuild, SpaceData, SpaceOptions, Step, build_space, verdict};
use shagreen_core::texture::TextureModel;
use shagreen_formats::figure::Figure;
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::space_report::space_figures;

use crate::strings::build as strings;

/// What a space is made of, owned.
pub(super) struct Order {
    pub(super) textures: Vec<(String, TextureModel)>,
    pub(super) sorts: Arc<Vec<Sort>>,
    pub(super) ratings: Arc<Vec<Rating>>,
    pub(super) votes: Arc<Vec<RelevanceVote>>,
    pub(super) source: LabelSource,
    pub(super) options: SpaceOptions,
}

/// A space that was built, and how it is shown.
#[derive(Clone, Debug)]
pub struct Built {
    /// The space.
    pub build: Arc<SpaceBuild>,
    /// What it gives textures.
    pub placed: Arc<PlacedSpace>,
    /// Its figures, each under a short name that serves for files.
    pub figures: Vec<(&'static str, Arc<Figure>)>,
    /// How far it can be believed, in sentences.
    pub verdict: Vec<String>,
}

enum Message {
    Step(Step),
    Done(Result<Box<Built>, String>),
}

/// A space in the making. Dropping it asks it to stop; what it still comes to reaches nobody, since every job has a
/// channel of its own.
pub(super) struct Job {
    messages: Receiver<Message>,
    is_cancelled: Arc<AtomicBool>,
    step: Step,
    started: Instant,
}

/// What a job has come to.
pub(super) enum Outcome {
    /// A space.
    Built(Box<Built>),
    /// Nothing, and why.
    Failed(String),
    /// Nothing, as was asked for: whatever it still came to is dropped.
    Cancelled,
}

impl Job {
    /// Starts to build; `ctx` is asked to repaint at every step.
    pub(super) fn start(order: Order, ctx: &Context) -> Self {
        let (sender, messages) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (is_stopped, ctx) = (Arc::clone(&is_cancelled), ctx.clone());
        std::thread::spawn(move || {
            let mut progress = Progress { sender, is_cancelled: is_stopped, told: None, ctx };
            let outcome = carry_out(&order, &mut progress);
            let Progress { sender, ctx, .. } = progress;
            // The window may have closed meanwhile: then nobody listens any more.
            let _ = sender.send(Message::Done(outcome.map(Box::new)));
            ctx.request_repaint();
        });
        Self { messages, is_cancelled, step: Step::Sorting, started: Instant::now() }
    }

    /// Asks it to stop. It is gone once [`Job::collect`] says so: until then it still holds the processor.
    pub(super) fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked to stop.
    pub(super) fn is_stopping(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// What came of it, once it is done.
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

    /// The step that it is at.
    pub(super) fn step(&self) -> Step {
        self.step
    }

    /// How long it has been at it.
    pub(super) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// What the worker tells, and whether it goes on.
struct Progress {
    sender: Sender<Message>,
    is_cancelled: Arc<AtomicBool>,
    told: Option<Step>,
    ctx: Context,
}

impl Progress {
    /// Hears of a step, as often as it likes, and returns whether to go on: only another step than the last is told, so
    /// that the window is not woken for nothing.
    fn at(&mut self, step: Step) -> bool {
        if self.is_cancelled.load(Ordering::Relaxed) {
            return false;
        }
        if self.told.replace(step) == Some(step) {
            return true;
        }
        let is_heard = self.sender.send(Message::Step(step)).is_ok();
        self.ctx.request_repaint();
        is_heard
    }
}

fn carry_out(order: &Order, progress: &mut Progress) -> Result<Built, String> {
    let data = SpaceData {
        textures: order.textures.iter().map(|(name, model)| NamedTexture { name, model }).collect(),
        sorts: order.sorts.to_vec(),
        ratings: order.ratings.to_vec(),
        votes: order.votes.to_vec(),
        source: order.source,
    };
    let build = build_space(&data, &order.options, &mut |step| progress.at(step))
        .map_err(|error| error.to_string())?;
    let figures = space_figures(&build).into_iter();
    Ok(Built {
        verdict: verdict(&build),
        figures: figures.map(|(name, figure)| (name, Arc::new(figure))).collect(),
        placed: Arc::new(PlacedSpace::of(&build)),
        build: Arc::new(build),
    })
}

#[cfg(test)]
mod tests {
    use super::{Job, Message, Outcome, Progress};
    use egui::Context;
    use shagreen_core::space_build::Step;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;
    use std::sync::mpsc::channel;
    use std::time::Instant;

    /// A job whose worker is the test.
    fn job() -> (Job, Progress) {
        let (sender, messages) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let progress =
            Progress { sender, is_cancelled: Arc::clone(&is_cancelled), told: None, ctx: Context::default() };
        (Job { messages, is_cancelled, step: Step::Sorting, started: Instant::now() }, progress)
    }

    #[test]
    fn a_step_that_is_told_often_is_heard_once() {
        let (mut job, mut progress) = job();
        for step in [Step::Scaling, Step::Axis(0), Step::Axis(1)] {
            assert!((0..1000).all(|_| progress.at(step)));
            let told: Vec<Message> = job.messages.try_iter().collect();
            assert!(matches!(told[..], [Message::Step(only)] if only == step), "{} messages", told.len());
        }
        assert!(progress.at(Step::Axis(0)) && job.collect().is_none());
        assert_eq!(job.step(), Step::Axis(0));
    }

    /// It is asked to stop within a step, is still there until it has, and what is late is dropped.
    #[test]
    fn a_cancelled_job_stops_within_a_step_and_comes_to_nothing() {
        let (mut job, mut progress) = job();
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
        let (job, mut progress) = job();
        drop(job);
        assert!(!progress.at(Step::Sorting));
    }

    #[test]
    fn a_worker_that_broke_off_is_said() {
        let (mut job, progress) = job();
        drop(progress);
        assert!(matches!(job.collect(), Some(Outcome::Failed(reason)) if reason.contains("broke off")));
    }
}
