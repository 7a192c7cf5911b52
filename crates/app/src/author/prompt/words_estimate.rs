//! Estimates from words that belong to no project, such as those of participants of a study.

use egui::Context;

use super::job::{Job, Maker, Wanted};
use super::{Arrived, PositionEstimate, Prompts};

/// Running estimate of the position of a text; dropping it stops it.
pub(crate) struct WordsEstimate(Job);

impl WordsEstimate {
    /// The estimate once it is made, or why it cannot be made.
    pub(crate) fn collect(&mut self) -> Option<Result<PositionEstimate, String>> {
        Some(self.0.collect()?.map(|Arrived { guess, .. }| guess))
    }
}

impl Prompts {
    /// Begins to estimate the position of a text on these axes, by the networks of the window and the procedural generator.
    pub(crate) fn estimate(
        &self,
        prompt: String,
        seed: u64,
        axes: &[String],
        ctx: &Context,
    ) -> WordsEstimate {
        let maker = Maker { models: self.models.clone(), networks: self.networks.clone(), diffusion: None };
        WordsEstimate(Job::begin(Wanted::Words { prompt, seed }, None, maker, axes.to_vec(), ctx))
    }
}
