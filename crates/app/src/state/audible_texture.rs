//! The audible texture, in the forms in which it can be exported.

use shagreen_formats::library::TextureEntry;

use crate::state::signal_file::{SignalFile, Sounding};

/// Audible texture, or a signal of the Signals workspace.
#[derive(Debug)]
pub(crate) struct AudibleTexture {
    /// Name of the texture or signal.
    pub(crate) name: String,
    /// Its signal, or the reason why there is none.
    pub(crate) signal: Result<SignalFile, String>,
    /// Its texture model as a library entry, or the reason why there is none.
    pub(crate) entry: Result<TextureEntry, String>,
    /// Whether it is an authored texture with a path.
    pub(crate) has_path: bool,
}

impl AudibleTexture {
    /// Whether the signal follows the path.
    pub(crate) fn plays_path(&self) -> bool {
        self.has_path && self.signal.as_ref().is_ok_and(|signal| matches!(signal.sounding, Sounding::Path(_)))
    }
}
