//! Commands about reliefs from pictures.

use std::sync::Arc;

use shagreen_studio::height_map::PictureRelief;

use crate::state::source::Source;

/// Texture that gets a relief.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReliefOf {
    /// Texture of the list with this id.
    Listed(String),
    /// Authored texture with this key.
    Authored(u32),
}

/// Command about reliefs. Without a texture, it applies to the audible one: the texture of the list that plays alone, or else
/// the selected authored texture.
#[derive(Clone, Debug)]
pub enum ReliefCommand {
    /// Asks whether a picture finds its point or becomes the relief of a texture.
    AskWhatFor(Option<ReliefOf>, Source),
    /// Opens the sheet for the relief of a texture, with a picture if there is one.
    Begin(Option<ReliefOf>, Option<Source>),
    /// Gives the texture of the open sheet this relief.
    Apply(Arc<PictureRelief>),
}
