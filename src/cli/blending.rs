//! How a point becomes a texture: modes, weights, locks.

use anyhow::{Context as _, bail};
use shagreen_core::authoring::{Blending, Outside, Weights};
use shagreen_core::blend::Mode;
use shagreen_formats::library::Library;

use crate::cli::near_names::unknown_texture;
use crate::cli::output;
use crate::cli::words::words;

/// How a point becomes a texture.
#[derive(clap::Args)]
pub(crate) struct BlendArgs {
    /// How the textures around a point become one: field is a smooth field over all of them, parametric the mean of those
    /// around; shared, power and paper mix their signals (one excitation; independent, at the mean of the levels; as
    /// published).
    #[arg(long, value_name = "MODE", value_parser = words(Mode::ALL, Mode::id), default_value = Mode::default().id())]
    blend: Mode,
    /// Take natural-neighbor weights instead of those of the triangle; with --blend parametric.
    #[arg(long)]
    natural: bool,
    /// Outside the textures, go on as far as the field supports instead of taking the nearest point among them.
    #[arg(long)]
    extrapolate: bool,
    /// Meet this texture exactly at its own place, where the field would smooth it; may be given several times.
    #[arg(long, value_name = "ID")]
    lock: Vec<String>,
}

impl BlendArgs {
    /// What the arguments ask for.
    pub(crate) fn blending(&self, library: &Library) -> anyhow::Result<Blending> {
        let index = |id: &String| {
            let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
            if library.textures[index].place.is_none() {
                bail!("\"{id}\" has no place in the space, so there is nothing to lock; place it first");
            }
            Ok(index)
        };
        let blending = Blending {
            mode: self.blend,
            weights: if self.natural { Weights::Natural } else { Weights::default() },
            outside: if self.extrapolate { Outside::Extrapolated } else { Outside::default() },
            locked: self.lock.iter().map(index).collect::<anyhow::Result<_>>()?,
        };
        blending.check()?;
        warn_of_hidden_locks(library, &blending.locked);
        Ok(blending)
    }
}

/// Of locked textures at one place only the first is met.
fn warn_of_hidden_locks(library: &Library, locked: &[usize]) {
    for (i, later) in locked.iter().enumerate() {
        let at = library.textures[*later].at();
        let first =
            locked[..i].iter().find(|first| **first != *later && library.textures[**first].at() == at);
        if let Some(first) = first {
            let [first, later] = [first, later].map(|texture| library.textures[*texture].id.as_str());
            output::warn(&format!(
                "\"{first}\" and \"{later}\" lie at one place: only \"{first}\" is met there"
            ));
        }
    }
}
