//! Batches: textures rendered along strokes to files of any export format, in parallel, and resumable.
//!
//! [`plan`] finds the textures of a manifest, and [`BatchPlan::run`] makes their files. A finished job has a record
//! ([`shagreen_formats::batch_record`]) with the hash of everything that its files depend on, so that the next run leaves it out.
//! Files do not depend on the number of threads, on the part of the batch that a run makes, or on earlier runs.

mod choices;
mod folder;
mod inputs;
mod job;
mod motion;
mod outcome;
mod rates;
mod run;

use std::collections::BTreeMap;

use shagreen_core::actuator::Actuator;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Authoring;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::acf::AcfV1;
use shagreen_formats::batch_manifest::{BatchManifest, BatchOutput};
use shagreen_formats::library::Library;
use shagreen_formats::project::Project;

use crate::export::{ExportFormat, SignalFormat};

pub use self::choices::{add_problem, plan};
pub use self::folder::MARK;
pub use self::motion::LoadedStroke;
pub use self::outcome::{BatchOptions, BatchOutcome, JobOutcome, JobState};

/// What the names in a manifest stand for.
pub struct BatchSources {
    /// Textures to choose from. In a project, those that take no part in new textures have no position.
    pub library: Library,
    /// The project, if the textures are those of one.
    pub project: Option<BatchProject>,
    /// The strokes of the manifest, in its order.
    pub strokes: Vec<LoadedStroke>,
    /// Actuator of each output of the manifest, in its order.
    pub actuators: Vec<Option<Actuator>>,
}

/// A project whose textures are rendered.
pub struct BatchProject {
    /// The project.
    pub project: Project,
    /// Its textures on its axes, all with their positions.
    pub placed: Library,
}

/// All jobs of a batch: each texture along each stroke for each output.
pub struct BatchPlan {
    manifest: BatchManifest,
    sources: BatchSources,
    /// Authoring spaces of the library, by the identifier of the mode.
    spaces: BTreeMap<&'static str, Authoring>,
    outputs: Vec<PlannedOutput>,
    targets: Vec<Target>,
    /// Hash of the library, for textures that depend on several of its textures.
    library_sha256: String,
}

/// An output with its format.
struct PlannedOutput {
    format: OutputFormat,
    /// Indices of its strokes; none for texture models.
    strokes: Vec<usize>,
    acf: Option<AcfV1>,
}

#[derive(Clone, Copy)]
enum OutputFormat {
    Signal(&'static dyn SignalFormat),
    Model(&'static dyn ExportFormat),
}

/// A texture of the batch.
struct Target {
    /// Name of the texture, if it has none yet.
    name: String,
    /// First part of the names of its files.
    stem: String,
    choice: TargetChoice,
    blend: Mode,
    /// `None` keeps the shape of an authored texture.
    shape: Option<Shape>,
}

enum TargetChoice {
    /// Texture of the library, by its identifier.
    Texture(String),
    /// Authored texture of the project, by its name or number.
    Authored(String),
    Point(SpacePoint),
}

impl BatchPlan {
    /// Number of textures.
    pub fn n_textures(&self) -> usize {
        self.targets.len()
    }

    /// Outputs whose signals each have a scale of their own, by their identifiers: differences between the levels of the textures
    /// are not kept. None if the batch has a single signal for each output.
    pub fn scaled_apart(&self) -> Vec<&str> {
        let is_apart = |(planned, output): (&PlannedOutput, &BatchOutput)| {
            let OutputFormat::Signal(format) = planned.format else { return false };
            let is_scaled = !format.stores_samples() || output.encoding.is_scaled();
            is_scaled && output.full_scale_mps2.is_none() && self.n_textures() * planned.strokes.len() > 1
        };
        let outputs = self.outputs.iter().zip(&self.manifest.outputs);
        outputs.filter(|both| is_apart(*both)).map(|(_, output)| output.id.as_str()).collect()
    }

    /// Number of jobs of each texture.
    fn n_jobs_each(&self) -> usize {
        let of = |output: &PlannedOutput| match output.format {
            OutputFormat::Signal(_) => output.strokes.len(),
            OutputFormat::Model(_) => 1,
        };
        self.outputs.iter().map(of).sum()
    }
}

#[cfg(test)]
mod tests;
