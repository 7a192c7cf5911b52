//! Commands about the networks that predict attributes from photos.

use shagreen_formats::photo_networks::PhotoNetworks;

/// Command about networks.
#[derive(Clone, Debug)]
pub enum NetworksCommand {
    /// Opens the sheet that chooses them.
    Open,
    /// Predicts from the next photo on with these networks, whose files were read without an error.
    Use(PhotoNetworks),
}
