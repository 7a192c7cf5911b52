//! Words and photos that find their place in the space: the prompt box, what came of it, and the earlier ones.

pub(crate) mod bar_ui;
pub(crate) mod card_ui;
mod guess;
mod job;

use std::collections::VecDeque;
use std::sync::Arc;

use egui::Context;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;
use shagreen_formats::settings::KeptPrompt;

pub use self::guess::{Guess, Origin};

use self::job::{Job, Maker, Wanted};
use crate::import::source::Source;
use crate::models::{AddedDiffusion, ModelFolder};

/// What can be asked about prompts.
#[derive(Clone, Debug)]
pub enum PromptCommand {
    /// Make what the words describe, as a texture of its own.
    Make {
        /// The words.
        prompt: String,
        /// Of what is drawn.
        seed: u64,
    },
    /// Make another piece of what was made last, in its place.
    Another,
    /// Find the places of photos, each as a texture of its own, once what is being made is done.
    Look(Vec<Source>),
    /// Stop making, and forget photos that wait.
    Stop,
    /// What was guessed is no longer of interest.
    Dismiss,
}

/// The prompt box and what came of it.
pub struct Prompts {
    /// What is being written.
    pub(crate) text: String,
    /// Whether the diffusion model is to make pictures.
    pub(crate) by_diffusion: bool,
    added: Option<AddedDiffusion>,
    models: Option<ModelFolder>,
    job: Option<Job>,
    /// Photos that wait for it.
    waiting: VecDeque<Source>,
    guess: Option<Guess>,
}

/// What is done with what came of a prompt.
#[derive(Debug)]
pub(crate) struct Arrived {
    /// The guess.
    pub(crate) guess: Guess,
    /// The authored texture that it replaces, with its picture then; `None` makes one.
    pub(crate) replaces: Option<(u32, Arc<Picture>)>,
    /// The axes that it was made for.
    pub(crate) axes: [String; 2],
}

impl Prompts {
    /// Nothing has been said yet; `models` is where networks of others are, if they are anywhere.
    pub(crate) fn new(models: Option<ModelFolder>) -> Self {
        // A file that is damaged is told where it is used: by the command line, which also mends it.
        let added = models.as_ref().and_then(|models| models.added_diffusion().ok().flatten());
        Self {
            text: String::new(),
            by_diffusion: false,
            added,
            models,
            job: None,
            waiting: VecDeque::new(),
            guess: None,
        }
    }

    /// What was guessed of an authored texture, as long as it has the picture that was made for it: keys come back after
    /// undo, and in other projects.
    pub fn guess_of(&self, texture: &AuthoredTexture) -> Option<&Guess> {
        self.guess
            .as_ref()
            .filter(|guess| guess.key.is_some_and(|key| has_still(texture, key, &guess.picture)))
    }

    /// Another project is open: what was being made was for the one before.
    pub(crate) fn forget(&mut self) {
        (self.job, self.guess) = (None, None);
        self.waiting.clear();
    }

    /// Whether something is being made.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// How many photos wait for it.
    pub(crate) fn n_waiting(&self) -> usize {
        self.waiting.len()
    }

    /// How much of it is done, 0..1, where that can be told.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().and_then(Job::progress)
    }

    /// The diffusion model of this machine.
    pub(crate) fn added(&self) -> Option<&AddedDiffusion> {
        self.added.as_ref()
    }

    /// The diffusion model, where it is to make pictures.
    fn chosen_diffusion(&self) -> Option<&AddedDiffusion> {
        self.added().filter(|_| self.by_diffusion)
    }

    /// Begins what was asked for, words in place of what is being made, photos after it; returns what is to be remembered of
    /// it. Axes are those of the space, each by its two ends.
    pub(crate) fn carry_out(
        &mut self,
        command: PromptCommand,
        poles: &[[String; 2]; 2],
        ctx: &Context,
    ) -> Option<KeptPrompt> {
        let (prompt, seed, replaces) = match command {
            PromptCommand::Make { prompt, seed } => (prompt, seed, None),
            PromptCommand::Another => {
                let guess = self.guess.as_ref()?;
                let Origin::Words { prompt, seed } = &guess.origin else { return None };
                (prompt.clone(), seed.wrapping_add(1), guess.replaced())
            }
            PromptCommand::Look(sources) => {
                self.waiting.extend(sources);
                self.look_at_next(poles, ctx);
                return None;
            }
            PromptCommand::Stop => {
                self.job = None;
                self.waiting.clear();
                return None;
            }
            PromptCommand::Dismiss => {
                self.guess = None;
                return None;
            }
        };
        let is_empty = prompt.trim().is_empty();
        let kept = (!is_empty).then(|| KeptPrompt {
            prompt: prompt.clone(),
            seed,
            by_diffusion: self.chosen_diffusion().is_some(),
        });
        self.begin(Wanted::Words { prompt, seed }, replaces, poles, ctx);
        kept
    }

    /// Begins with the first photo that waits, if nothing is being made.
    pub(crate) fn look_at_next(&mut self, poles: &[[String; 2]; 2], ctx: &Context) {
        if self.job.is_none()
            && let Some(photo) = self.waiting.pop_front()
        {
            self.begin(Wanted::Photo(photo), None, poles, ctx);
        }
    }

    fn begin(
        &mut self,
        wanted: Wanted,
        replaces: Option<(u32, Arc<Picture>)>,
        poles: &[[String; 2]; 2],
        ctx: &Context,
    ) {
        let maker = Maker { models: self.models.clone(), diffusion: self.chosen_diffusion().cloned() };
        self.job = Some(Job::begin(wanted, replaces, maker, axis_names(poles), ctx));
    }

    /// What came of what was asked for, once it is done, or why nothing did.
    pub(crate) fn collect(&mut self) -> Option<Result<Arrived, String>> {
        let done = self.job.as_mut()?.collect()?;
        self.job = None;
        Some(done)
    }

    /// The guess belongs to the authored texture of this key.
    pub(crate) fn keep(&mut self, guess: Guess, key: u32) {
        self.guess = Some(Guess { key: Some(key), ..guess });
    }
}

/// Whether a texture has this key and still this very picture.
pub(crate) fn has_still(texture: &AuthoredTexture, key: u32, picture: &Arc<Picture>) -> bool {
    texture.key == key && texture.picture.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture))
}

/// Names of axes of which each has two ends.
pub(crate) fn axis_names(poles: &[[String; 2]; 2]) -> [String; 2] {
    poles.clone().map(|ends| ends.join("-"))
}
