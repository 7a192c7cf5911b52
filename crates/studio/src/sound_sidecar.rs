//! The sidecar of a signal: which sound it is, and how the tip moved.

use shagreen_core::space::LabelSource;
use shagreen_formats::library::Library;
use shagreen_formats::named_point::named_coordinates;
use shagreen_formats::wav::{ParentV1, SidecarV1, TraceV1};

use crate::sound::Sound;

/// Facts about a signal besides its sound.
#[derive(Clone, Debug)]
pub struct SignalFacts<'a> {
    /// Sample rate in Hz.
    pub rate_hz: u32,
    /// Duration in seconds.
    pub seconds: f64,
    /// Whether the end goes on into the beginning.
    pub loops: bool,
    /// Random seed of the noise.
    pub seed: u64,
    /// Name of the file of the stroke, without its folder: a redistributed file must not reveal the names of folders.
    pub stroke: Option<String>,
    /// Motion of the tip.
    pub trace: TraceV1,
    /// Name and version of the program.
    pub created_by: &'a str,
}

/// Returns the sidecar of a signal in m/s². `library` has the textures of the sound.
pub fn sidecar_of_sound(library: &Library, sound: &Sound, facts: SignalFacts<'_>) -> SidecarV1 {
    let parent = |(index, weight): &(usize, f64)| ParentV1::new(library, *index, *weight);
    SidecarV1 {
        texture: sound.texture.clone(),
        at: sound.at_json(),
        at_named: sound.at.map(|at| named_coordinates(library.axis_names(), at)),
        clamped: sound.clamped,
        extrapolated: sound.extrapolated,
        blend: sound.mode.id().to_owned(),
        shape: sound.shape.text(),
        parents: sound.parents.iter().map(parent).collect(),
        library: library.name.clone(),
        label_source: library.label_source().map(|source| LabelSource::id(source).to_owned()),
        loops: facts.loops,
        stroke: facts.stroke,
        trace: facts.trace,
        ..SidecarV1::new(facts.rate_hz, facts.seconds, facts.seed, facts.created_by)
    }
}
