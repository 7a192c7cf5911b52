//! The XML of the Penn Haptic Texture Toolkit.

use shagreen_formats::hatt::{lost_in_hatt, write_hatt};
use shagreen_formats::library::TextureEntry;

use super::ExportFormat;

/// The element that every model file contains.
const MODEL_SET: &[u8] = b"<modelSet";

pub(super) struct Hatt;

impl ExportFormat for Hatt {
    fn id(&self) -> &'static str {
        "hatt"
    }

    fn name(&self) -> &'static str {
        "HaTT model (XML)"
    }

    fn ending(&self) -> &'static str {
        "xml"
    }

    fn help(&self) -> &'static str {
        "Texture model for the renderer of the Penn Haptic Texture Toolkit"
    }

    fn lost(&self, texture: &TextureEntry) -> Vec<String> {
        lost_in_hatt(texture)
    }

    fn bytes(&self, texture: &TextureEntry, created_by: &str) -> anyhow::Result<Vec<u8>> {
        Ok(write_hatt(texture, created_by)?)
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        bytes.windows(MODEL_SET.len()).any(|window| window == MODEL_SET)
    }
}
