//! Interpolation options: mode, weights, pinned textures.

use anyhow::{Context as _, bail};
use shagreen_core::space::authoring::{Blending, Outside, Weights};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::library::Library;

use crate::cli::output;
use crate::cli::words::words;
use shagreen_studio::near_names::unknown_texture;

/// Options of the interpolation.
#[derive(clap::Args)]
pub(crate) struct BlendArgs {
    /// Interpolation mode. field: one texture from a smooth field over all textures. parametric: one texture with the
    /// mean spectral envelope and level of the surrounding textures. The other modes mix the signals of three textures.
    /// shared: all driven by the same noise. power: independent noise, level corrected to the mean. paper: as published
    /// by Hassan, Abdulali and Jeon (2020). A space with more than two axes needs field.
    #[arg(long, value_name = "MODE", value_parser = words(Mode::ALL, Mode::id), default_value = Mode::default().id())]
    blend: Mode,
    /// Use natural-neighbor (Sibson) weights instead of barycentric weights; only with --blend parametric.
    #[arg(long)]
    natural: bool,
    /// Extrapolate the field outside the convex hull of the textures, up to a limit, instead of using the nearest point
    /// of the hull; only with --blend field.
    #[arg(long)]
    extrapolate: bool,
    /// Pin this texture: the field passes through it exactly instead of smoothing it; only with --blend field. Can be
    /// given several times.
    #[arg(long, value_name = "ID")]
    lock: Vec<String>,
}

impl BlendArgs {
    /// Whether the arguments pin the texture with this identifier.
    pub(crate) fn pins(&self, id: &str) -> bool {
        self.lock.iter().any(|locked| locked == id)
    }

    /// Returns the interpolation options that the arguments specify.
    pub(crate) fn blending(&self, library: &Library) -> anyhow::Result<Blending> {
        let index = |id: &String| {
            let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
            if library.textures[index].place.is_none() {
                bail!(
                    "\"{id}\" has no position in the space and cannot be pinned; assign one with `shagreen space place`"
                );
            }
            Ok(index)
        };
        let blending = Blending {
            mode: self.blend,
            weights: if self.natural { Weights::Natural } else { Weights::default() },
            outside: if self.extrapolate { Outside::Extrapolated } else { Outside::default() },
            locked: self.lock.iter().map(index).collect::<anyhow::Result<_>>()?,
        };
        blending.check_in(library.axis_names().len())?;
        warn_of_hidden_locks(library, &blending.locked);
        Ok(blending)
    }
}

/// Warns of pinned textures that share a position: the field passes only through the first.
fn warn_of_hidden_locks(library: &Library, locked: &[usize]) {
    for (i, later) in locked.iter().enumerate() {
        let at = library.textures[*later].at();
        let first =
            locked[..i].iter().find(|first| **first != *later && library.textures[**first].at() == at);
        if let Some(first) = first {
            let [first, later] = [first, later].map(|texture| library.textures[*texture].id.as_str());
            output::warn(&format!(
                "\"{first}\" and \"{later}\" have the same position: the field passes only through \"{first}\"; pin only one of them"
            ));
        }
    }
}
