//! Export of a texture to the format of another program.

use std::sync::Arc;

use shagreen_formats::library::{Provenance, TextureEntry};
use shagreen_studio::export::ExportFormat;

use crate::state::document::CREATED_BY;

/// Texture to be exported.
#[derive(Clone)]
pub struct TextureFile {
    /// The texture.
    pub entry: Arc<TextureEntry>,
    /// File format.
    pub format: &'static dyn ExportFormat,
}

impl TextureFile {
    /// Properties of the texture that the format cannot hold.
    pub(crate) fn lost(&self) -> Vec<String> {
        self.format.lost(&self.entry)
    }

    /// Name of the texture, if it may not be redistributed.
    pub(crate) fn restricted(&self) -> Option<&str> {
        (self.entry.provenance == Provenance::Restricted).then_some(self.entry.name.as_str())
    }

    pub(crate) fn bytes(&self) -> Result<Vec<u8>, String> {
        self.format.bytes(&self.entry, CREATED_BY).map_err(|error| format!("{error:#}"))
    }

    /// Whether a file with these bytes is of the same format.
    pub(crate) fn is_like(&self, bytes: &[u8]) -> bool {
        self.format.is_like(bytes)
    }
}
