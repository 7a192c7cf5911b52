//! Interpolation options: mode, weights, pinned textures.

use shagreen_core::space::authoring::{Blending, Outside, Weights};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::library::Library;

use crate::cli::output::Printed;
use crate::cli::words::words;
use shagreen_studio::blend_options::BlendOptions;

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
        let options = BlendOptions {
            mode: self.blend,
            weights: if self.natural { Weights::Natural } else { Weights::default() },
            outside: if self.extrapolate { Outside::Extrapolated } else { Outside::default() },
            pinned: &self.lock,
        };
        options.in_library(library, &Printed)
    }
}
