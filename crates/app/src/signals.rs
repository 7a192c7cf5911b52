//! The Signals workspace: two signals side by side, their predicted perceptual difference, compression and editing.

pub mod analysis;
mod cached_analysis;
pub mod editor;
mod editor_ui;
mod features_ui;
mod figures;
mod maps;
mod model_choice;
mod model_ui;
mod number_ui;
pub mod page;
mod playing;
pub(crate) mod reading;
mod slot;
mod slot_ui;
mod spatial_ui;

use shagreen_core::signals::codec::bitrate::Bitrate;

/// Settings for making signal B from A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ResynthesisSettings {
    /// Bit rate of the codec.
    pub(crate) rate: Bitrate,
    /// Griffin-Lim iterations that refine a signal made from a spectrogram.
    pub(crate) n_steps: usize,
}
