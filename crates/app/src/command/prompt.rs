//! Commands about prompts.

use crate::state::source::Source;

/// Command about prompts and photos.
#[derive(Clone, Debug)]
pub enum PromptCommand {
    /// Generates a new authored texture from a prompt.
    Make {
        /// Description of the surface.
        prompt: String,
        /// Random seed of the generator.
        seed: u64,
    },
    /// Generates the last texture again with the next seed and replaces it.
    Another,
    /// Predicts a position for each photo and adds it as an authored texture, after the present job.
    Look(Vec<Source>),
    /// As `Look`, for one photo and a description of what it shows.
    LookWith {
        /// The photo.
        photo: Source,
        /// Description of the surface.
        prompt: String,
    },
    /// Moves the selected texture to the lexicon entry of this material, which its picture is likely to show; `None` moves it
    /// back to the estimate from the picture.
    TakeMaterial(Option<String>),
    /// Stops the present job and discards waiting photos.
    Stop,
    /// Stops the simulation of the last generated texture.
    StopSimulation,
    /// Closes the card of the last prediction.
    Dismiss,
}
