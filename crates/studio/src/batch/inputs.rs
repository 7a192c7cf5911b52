//! Everything that the files of a job depend on, as a hash.

use shagreen_formats::batch_manifest::BatchOutput;
use shagreen_formats::library::{Library, write_library};
use shagreen_formats::project::sha256_hex;

use super::{BatchPlan, BatchSources, Target, TargetChoice};
use crate::project::find_authored;

/// Version of the jobs: a change of what is written increases it, so that old records count as none.
const JOBS_VERSION: u32 = 2;

/// Returns the hash of a library.
pub(super) fn library_sha256(library: &Library) -> String {
    sha256_hex(&write_library(library))
}

impl BatchPlan {
    /// Text of all inputs of a texture.
    pub(super) fn inputs_of_target(&self, target: &Target) -> String {
        let Target { choice, blend, shape, .. } = target;
        let of_choice = match choice {
            TargetChoice::Texture(id) => texture_inputs(&self.sources, id),
            TargetChoice::Point(point) => format!("{point:?} {}", self.library_sha256),
            TargetChoice::Authored(name) => {
                let project = self.sources.project.as_ref();
                let authored = project.and_then(|project| find_authored(&project.project, name).ok()); // Its job reports it.
                format!("{:?} {}", authored.map(|texture| format!("{texture:?}")), self.library_sha256)
            }
        };
        format!("{of_choice}\n{} {:?}", blend.id(), shape)
    }

    /// Hash of all inputs of a job. `of_target` are those of its texture.
    pub(super) fn inputs(
        &self,
        of_target: &str,
        (output, stroke): (usize, Option<usize>),
        created_by: &str,
    ) -> String {
        // Which other strokes an output has changes no file.
        let stated =
            BatchOutput { strokes: None, stated: Vec::new(), ..self.manifest.outputs[output].clone() };
        let stroke = stroke.map(|stroke| self.sources.strokes[stroke].inputs());
        let actuator = &self.sources.actuators[output];
        let seed = self.manifest.seed;
        sha256_hex(
            format!("{JOBS_VERSION} {created_by} {seed}\n{of_target}\n{stated:?}\n{stroke:?}\n{actuator:?}")
                .as_bytes(),
        )
    }
}

/// Inputs of a texture of the library: the texture, and what its files say about the library.
fn texture_inputs(sources: &BatchSources, id: &str) -> String {
    let library = &sources.library;
    let Some(index) = library.index_of(id) else { return String::new() };
    let entry = library.textures[index].clone();
    let header = Library {
        name: library.name.clone(),
        origin: library.origin.clone(),
        license: library.license.clone(),
        axes: library.axes.clone(),
        textures: vec![entry],
        ..Library::default()
    };
    format!("{} {:?}", library_sha256(&header), library.label_source())
}
