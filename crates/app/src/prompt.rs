//! Words and photos that find their place in the space: the prompt box, what came of it, and the earlier ones.

pub(crate) mod bar_ui;
pub(crate) mod card_ui;
mod guess;
mod job;

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
    /// Find the place of a photo, as a texture of its own.
    Look(Source),
    /// Stop making.
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
        Self { text: String::new(), by_diffusion: false, added, models, job: None, guess: None }
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
    }

    /// Whether something is being made.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// How much of it is done, 0..1, where that can be told.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().and_then(Job::progress)
    }

    /// The diffusion model of this machine.
    pub(crate) fn added(&self) -> Option<&AddedDiffusion> {
        self.added.as_ref()
    }

    /// Begins what was asked for, in place of what is being made; returns what is to be remembered of it. Axes are those of
    /// the space, each by its two ends.
    pub(crate) fn carry_out(
        &mut self,
        command: PromptCommand,
        poles: &[[String; 2]; 2],
        ctx: &Context,
    ) -> Option<KeptPrompt> {
        let (wanted, replaces) = match command {
            PromptCommand::Make { prompt, seed } => (Wanted::Words { prompt, seed }, None),
            PromptCommand::Another => {
                let guess = self.guess.as_ref()?;
                let Origin::Words { prompt, seed } = &guess.origin else { return None };
                (Wanted::Words { prompt: prompt.clone(), seed: seed.wrapping_add(1) }, guess.replaced())
            }
            PromptCommand::Look(source) => (Wanted::Photo(source), None),
            PromptCommand::Stop => {
                self.job = None;
                return None;
            }
            PromptCommand::Dismiss => {
                self.guess = None;
                return None;
            }
        };
        let kept = match &wanted {
            Wanted::Words { prompt, seed } if !prompt.trim().is_empty() => {
                Some(KeptPrompt { prompt: prompt.clone(), seed: *seed })
            }
            Wanted::Words { .. } | Wanted::Photo(_) => None,
        };
        let diffusion = self.added.clone().filter(|_| self.by_diffusion);
        let maker = Maker { models: self.models.clone(), diffusion };
        let axes = axis_names(poles);
        self.job = Some(Job::begin(wanted, replaces, maker, axes, ctx));
        kept
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
