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

impl Job {
    /// Starts to build; `ctx` is asked to repaint at every step.
    pub(super) fn start(order: Order, ctx: &Context) -> Self {
        let (sender, messages) = channel();
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (is_stopped, ctx) = (Arc::clone(&is_cancelled), ctx.clone());
        std::thread::spawn(move || {
            let outcome = carry_out(&order, &sender, &is_stopped, &ctx);
            // Nobody listens any more where it was cancelled.
            let _ = sender.send(Message::Done(outcome.map(Box::new)));
            ctx.request_repaint();
        });
        Self { messages, is_cancelled, step: Step::Sorting, started: Instant::now() }
    }

    /// What came of it, once it is done.
    pub(super) fn collect(&mut self) -> Option<Result<Built, String>> {
        loop {
            match self.messages.try_recv() {
                Ok(Message::Step(step)) => self.step = step,
                Ok(Message::Done(outcome)) => return Some(outcome.map(|built| *built)),
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => return Some(Err(strings::BROKEN.to_owned())),
            }
        }
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

fn carry_out(
    order: &Order,
    sender: &Sender<Message>,
    is_stopped: &AtomicBool,
    ctx: &Context,
) -> Result<Built, String> {
    let data = SpaceData {
        textures: order.textures.iter().map(|(name, model)| NamedTexture { name, model }).collect(),
        sorts: order.sorts.to_vec(),
        ratings: order.ratings.to_vec(),
        votes: order.votes.to_vec(),
        source: order.source,
    };
    let mut on_step = |step: Step| {
        let is_heard = sender.send(Message::Step(step)).is_ok();
        ctx.request_repaint();
        is_heard && !is_stopped.load(Ordering::Relaxed)
    };
    let build = build_space(&data, &order.options, &mut on_step).map_err(|error| error.to_string())?;
    let figures = space_figures(&build).into_iter();
    Ok(Built {
        verdict: verdict(&build),
        figures: figures.map(|(name, figure)| (name, Arc::new(figure))).collect(),
        build: Arc::new(build),
    })
}
