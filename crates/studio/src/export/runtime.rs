//! Runtime tables for the C interface of the renderer.

use shagreen_formats::library::TextureEntry;
use shagreen_formats::runtime_table::{is_runtime_table, lost_in_runtime_table, write_runtime_table};

use super::ExportFormat;

pub(super) struct Runtime;

impl ExportFormat for Runtime {
    fn id(&self) -> &'static str {
        "runtime"
    }

    fn name(&self) -> &'static str {
        "Runtime table"
    }

    fn ending(&self) -> &'static str {
        "shgt"
    }

    fn help(&self) -> &'static str {
        "Texture for programs in C, C++ and C#, and for firmware, that render it with Shagreen's runtime"
    }

    fn lost(&self, texture: &TextureEntry) -> Vec<String> {
        lost_in_runtime_table(texture)
    }

    fn bytes(&self, texture: &TextureEntry, created_by: &str) -> anyhow::Result<Vec<u8>> {
        Ok(write_runtime_table(texture, created_by)?)
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        is_runtime_table(bytes)
    }
}
