//! Prompts: words and photos whose position in the space is estimated. Holds the prompt box, the result and earlier
//! prompts.

pub(crate) mod bar_ui;
pub(crate) mod card_ui;
mod job;
mod position_estimate;

use std::collections::VecDeque;
use std::sync::Arc;

use egui::Context;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;
use shagreen_formats::settings::KeptPrompt;

pub use self::position_estimate::{Origin, PositionEstimate};

use self::job::{Job, Maker, Wanted};
use crate::command::prompt::PromptCommand;
use crate::state::source::Source;
use shagreen_studio::models::{AddedDiffusion, ModelFolder};

/// Prompt box, the running job and the last result.
pub struct Prompts {
    /// Text in the prompt box.
    pub(crate) text: String,
    /// Whether the diffusion model makes the pictures, instead of the procedural generator.
    pub(crate) by_diffusion: bool,
    added: Option<AddedDiffusion>,
    models: Option<ModelFolder>,
    job: Option<Job>,
    /// Photos that wait for the running job.
    waiting: VecDeque<Source>,
    guess: Option<PositionEstimate>,
}

/// Result of a finished job.
#[derive(Debug)]
pub(crate) struct Arrived {
    pub(crate) guess: PositionEstimate,
    /// Key of the authored texture to replace, and its picture at that time. `None` makes a new texture.
    pub(crate) replaces: Option<(u32, Arc<Picture>)>,
    /// Names of the axes that the estimate refers to.
    pub(crate) axes: [String; 2],
}

impl Prompts {
    /// Empty prompt box; `models` is the folder of pretrained networks, if there is one.
    pub(crate) fn new(models: Option<ModelFolder>) -> Self {
        // A damaged file is ignored here: the command line reports and repairs it.
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

    /// Estimate made for an authored texture, if the texture still has the picture made with it. Its key is not enough:
    /// keys recur after undo, and in other projects.
    pub fn guess_of(&self, texture: &AuthoredTexture) -> Option<&PositionEstimate> {
        self.guess
            .as_ref()
            .filter(|guess| guess.key.is_some_and(|key| has_still(texture, key, &guess.picture)))
    }

    /// Discards the jobs and the result, which belong to a project that is no longer open.
    pub(crate) fn forget(&mut self) {
        (self.job, self.guess) = (None, None);
        self.waiting.clear();
    }

    /// Whether a job is running.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// Number of photos that wait for the running job.
    pub(crate) fn n_waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Progress of the running job, 0 to 1, if it reports any.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().and_then(Job::progress)
    }

    /// Diffusion model installed on this machine.
    pub(crate) fn added(&self) -> Option<&AddedDiffusion> {
        self.added.as_ref()
    }

    /// The diffusion model, if it is chosen to make pictures.
    fn chosen_diffusion(&self) -> Option<&AddedDiffusion> {
        self.added().filter(|_| self.by_diffusion)
    }

    /// Executes a prompt command. Words replace the running job; photos wait for it to finish. `poles` are the labels
    /// at both ends of each axis. Returns the prompt to be remembered.
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

    /// Starts with the first waiting photo if no job is running.
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

    /// Result of the job once it has finished, or why it failed.
    pub(crate) fn collect(&mut self) -> Option<Result<Arrived, String>> {
        let done = self.job.as_mut()?.collect()?;
        self.job = None;
        Some(done)
    }

    /// Keeps the estimate for the authored texture with this key.
    pub(crate) fn keep(&mut self, guess: PositionEstimate, key: u32) {
        self.guess = Some(PositionEstimate { key: Some(key), ..guess });
    }
}

/// Whether a texture has this key and still the very same picture.
pub(crate) fn has_still(texture: &AuthoredTexture, key: u32, picture: &Arc<Picture>) -> bool {
    texture.key == key && texture.picture.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture))
}

/// Names of the axes, made from the labels at both ends of each.
pub(crate) fn axis_names(poles: &[[String; 2]; 2]) -> [String; 2] {
    poles.clone().map(|ends| ends.join("-"))
}
