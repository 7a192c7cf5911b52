//! Prompts: words and photos whose position in the space is estimated. Holds the prompt box, the result and earlier
//! prompts.

pub(crate) mod bar_ui;
pub(crate) mod card_ui;
mod job;
mod position_estimate;
mod simulation;
mod words_estimate;

use std::collections::VecDeque;
use std::sync::Arc;

use egui::Context;
use shagreen_core::surfaces::prompt::interpret;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::photo_networks::PhotoNetworks;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;
use shagreen_formats::settings::KeptPrompt;

pub use self::position_estimate::{MaterialEstimate, Origin, PositionEstimate};

use self::job::{Job, Maker, Wanted};
pub(crate) use self::simulation::Simulated;
use self::simulation::Simulation;
pub(crate) use self::words_estimate::WordsEstimate;
use crate::command::prompt::PromptCommand;
use crate::strings::prompt as words;
use shagreen_studio::models::{AddedDiffusion, ModelFolder};

/// Prompt box, the running job and the last result.
pub struct Prompts {
    /// Text in the prompt box.
    pub(crate) text: String,
    /// Whether the diffusion model makes the pictures, instead of the procedural generator.
    pub(crate) by_diffusion: bool,
    added: Option<AddedDiffusion>,
    models: Option<ModelFolder>,
    /// Networks that predict attributes from pictures, if the user has chosen any.
    networks: Option<PhotoNetworks>,
    job: Option<Job>,
    /// Photos that wait for the running job.
    waiting: VecDeque<Wanted>,
    /// Estimates of the last result: first the one that was made, then those with a material that the user has taken. Each
    /// has a picture in memory of its own, so that undo decides which of them is shown.
    guesses: Vec<PositionEstimate>,
    /// Simulation of the texture of the last result.
    simulation: Option<Simulation>,
    /// Texture that was simulated last, and the key of its authored texture.
    simulated: Option<(u32, Arc<TextureEntry>)>,
    /// Revision of the project after the last result was added.
    step: Option<u64>,
}

/// Result of a finished job.
#[derive(Debug)]
pub(crate) struct Arrived {
    pub(crate) guess: PositionEstimate,
    /// Key of the authored texture to replace, and its picture at that time. `None` makes a new texture.
    pub(crate) replaces: Option<(u32, Arc<Picture>)>,
    /// Names of the axes that the estimate refers to.
    pub(crate) axes: Vec<String>,
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
            networks: None,
            job: None,
            waiting: VecDeque::new(),
            guesses: Vec::new(),
            simulation: None,
            simulated: None,
            step: None,
        }
    }

    /// Predicts attributes from pictures with these networks, from the next job on; `None` selects the usual ones.
    pub(crate) fn use_networks(&mut self, networks: Option<PhotoNetworks>) {
        self.networks = networks;
    }

    /// Estimate made for an authored texture, if the texture still has the picture made with it. Its key is not enough:
    /// keys recur after undo, and in other projects.
    pub fn guess_of(&self, texture: &AuthoredTexture) -> Option<&PositionEstimate> {
        let is_of =
            |guess: &&PositionEstimate| guess.key.is_some_and(|key| has_still(texture, key, &guess.picture));
        self.guesses.iter().find(is_of)
    }

    /// Estimate of an authored texture with the lexicon entry of this material, completed, or again the one from the picture.
    /// `None` if the texture has no estimate, or the lexicon no entry.
    pub(crate) fn take_material(
        &mut self,
        texture: &AuthoredTexture,
        material: Option<&str>,
        completed: impl FnOnce(PositionEstimate) -> PositionEstimate,
    ) -> Option<PositionEstimate> {
        let present = self.guess_of(texture)?;
        if let Some(before) = self.guesses.iter().find(|guess| guess.taken.as_deref() == material) {
            return Some(before.clone());
        }
        let taken = completed(present.with_material(material?)?);
        self.guesses.push(taken.clone());
        Some(taken)
    }

    /// Words in the prompt box, if they are about touch.
    pub(crate) fn described(&self) -> Option<String> {
        let lexicon = built_in_lexicon().ok()?; // A prompt reports a damaged lexicon.
        let text = self.text.trim();
        interpret(text, lexicon).is_about_touch().then(|| text.to_owned())
    }

    /// Discards the jobs and the result, which belong to a project that is no longer open.
    pub(crate) fn forget(&mut self) {
        (self.job, self.simulation, self.simulated, self.step) = (None, None, None, None);
        self.guesses.clear();
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

    /// Executes a prompt command, except the one that takes a material: that is an edit. Words replace the running job;
    /// photos wait for it to finish. `texture` is the selected one, `axes` are the names of the axes of the space. Returns the
    /// prompt to be remembered.
    pub(crate) fn carry_out(
        &mut self,
        command: PromptCommand,
        texture: &AuthoredTexture,
        axes: &[String],
        ctx: &Context,
    ) -> Option<KeptPrompt> {
        let (prompt, seed, replaces) = match command {
            PromptCommand::Make { prompt, seed } => (prompt, seed, None),
            PromptCommand::Another => {
                let guess = self.guess_of(texture)?;
                let Origin::Words { prompt, seed } = &guess.origin else { return None };
                (prompt.clone(), seed.wrapping_add(1), guess.replaced())
            }
            PromptCommand::Look(sources) => {
                let photos = sources.into_iter().map(|source| Wanted::Photo { source, prompt: None });
                self.waiting.extend(photos);
                self.look_at_next(axes, ctx);
                return None;
            }
            PromptCommand::LookWith { photo, prompt } => {
                self.waiting.push_back(Wanted::Photo { source: photo, prompt: Some(prompt) });
                self.look_at_next(axes, ctx);
                return None;
            }
            PromptCommand::TakeMaterial(_) => return None,
            PromptCommand::Stop => {
                self.job = None;
                self.waiting.clear();
                return None;
            }
            PromptCommand::StopSimulation => {
                self.simulation = None;
                return None;
            }
            PromptCommand::Dismiss => {
                self.guesses.clear();
                return None;
            }
        };
        let is_empty = prompt.trim().is_empty();
        let kept = (!is_empty).then(|| KeptPrompt {
            prompt: prompt.clone(),
            seed,
            by_diffusion: self.chosen_diffusion().is_some(),
        });
        self.begin(Wanted::Words { prompt, seed }, replaces, axes, ctx);
        kept
    }

    /// Starts with the first waiting photo if no job is running.
    pub(crate) fn look_at_next(&mut self, axes: &[String], ctx: &Context) {
        if self.job.is_none()
            && let Some(photo) = self.waiting.pop_front()
        {
            self.begin(photo, None, axes, ctx);
        }
    }

    fn begin(
        &mut self,
        wanted: Wanted,
        replaces: Option<(u32, Arc<Picture>)>,
        axes: &[String],
        ctx: &Context,
    ) {
        let maker = Maker {
            models: self.models.clone(),
            networks: self.networks.clone(),
            diffusion: self.chosen_diffusion().cloned(),
        };
        self.job = Some(Job::begin(wanted, replaces, maker, axes.to_vec(), ctx));
    }

    /// Result of the job once it has finished, or why it failed.
    pub(crate) fn collect(&mut self) -> Option<Result<Arrived, String>> {
        let done = self.job.as_mut()?.collect()?;
        self.job = None;
        Some(done)
    }

    /// Keeps the estimate for the authored texture with this key, and begins to simulate its texture if the surface is
    /// known, instead of one that is being simulated.
    pub(crate) fn keep(&mut self, guess: PositionEstimate, key: u32, ctx: &Context) {
        if let Some(surface) = guess.surface.clone() {
            self.simulation = Some(Simulation::begin(surface, key, Arc::clone(&guess.picture), ctx));
        }
        self.guesses = vec![PositionEstimate { key: Some(key), ..guess }];
    }

    /// Notes the revision of the project after the result was added.
    pub(crate) fn note_step(&mut self, revision: u64) {
        self.step = Some(revision);
    }

    /// Whether a project of this revision has not changed since the result was added.
    pub(crate) fn is_at_step(&self, revision: u64) -> bool {
        self.step == Some(revision)
    }

    /// Whether a texture is being simulated.
    pub fn is_simulating(&self) -> bool {
        self.simulation.is_some()
    }

    /// Progress of the simulation, 0 to 1, if one runs.
    pub(crate) fn simulated_share(&self) -> Option<f32> {
        self.simulation.as_ref().map(Simulation::progress)
    }

    /// Result of the simulation once it has finished, or why it failed.
    pub(crate) fn collect_simulated(&mut self) -> Option<Result<Simulated, String>> {
        let done = self.simulation.as_mut()?.collect()?;
        self.simulation = None;
        Some(done)
    }

    /// Texture that was simulated for the authored texture with this key, if it was the last one.
    pub(crate) fn simulated_for(&self, key: u32) -> Option<&Arc<TextureEntry>> {
        self.simulated.as_ref().filter(|(of, _)| *of == key).map(|(_, entry)| entry)
    }

    /// Keeps the texture that was simulated for the authored texture with this key, and notes it in the estimate.
    pub(crate) fn note_simulated(&mut self, key: u32, entry: Arc<TextureEntry>) {
        self.simulated = Some((key, entry));
        for guess in self.guesses.iter_mut().filter(|guess| guess.key == Some(key)) {
            guess.said.push(words::SIMULATED.to_owned());
        }
    }
}

/// Whether a texture has this key and still the very same picture.
pub(crate) fn has_still(texture: &AuthoredTexture, key: u32, picture: &Arc<Picture>) -> bool {
    texture.key == key && texture.picture.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture))
}
