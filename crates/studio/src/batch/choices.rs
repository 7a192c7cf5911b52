//! From a manifest to its textures, and the problems that only these show.

use std::collections::BTreeMap;
use std::path::Path;

use shagreen_core::actuator::{Actuator, Drive};
use shagreen_core::space::authoring::{Authoring, Blending};
use shagreen_core::space::texture_path::{Route, Stop, TexturePath};
use shagreen_core::texture::blend::Mode;
use shagreen_core::words::near;
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::acf::acf;
use shagreen_formats::batch_manifest::{
    BatchChoice, BatchManifest, BatchOutput, BatchPath, BatchSource, BatchTexture,
};
use shagreen_formats::library::{Library, TextureEntry};

use super::folder::RECORDS;
use super::inputs::library_sha256;
use super::{BatchPlan, BatchSources, LoadedStroke, OutputFormat, PlannedOutput, Target, TargetChoice};
use crate::authoring::authoring;
use crate::export::{format, listed, paths_in, signal_format};
use crate::near_names::unknown_texture;
use crate::points::{point_name, point_of};
use crate::project::find_authored;
use crate::render::SEAM_SECS;
use crate::report::Reporter;

/// Longest loop in s: its seam is rendered twice.
const MOST_LOOP_SECS: f64 = MAX_TRACK_SECS - SEAM_SECS;
/// Largest number of jobs: more would not fit the memory with their results.
const MOST_JOBS: usize = 1_000_000;

/// Finds the textures, formats and strokes of a manifest. `found` are problems that were found before, which come first. Of their
/// keys, no further problem is reported: it could be a consequence. If a key of [`BatchSource::KEYS`] is among them, the textures
/// are not looked for.
///
/// # Errors
/// All problems, also those that were found before, each a key of the manifest and what is wrong
/// ([`shagreen_formats::batch_manifest::batch_problems`]).
pub fn plan(
    manifest: BatchManifest,
    sources: BatchSources,
    (found, created_by): (Vec<(String, String)>, &str),
    reporter: &dyn Reporter,
) -> Result<BatchPlan, Vec<(String, String)>> {
    let sha256 = library_sha256(&sources.library);
    let mut finder = Finder { sources, spaces: BTreeMap::new(), found, problems: Vec::new(), reporter };
    let outputs: Vec<PlannedOutput> = manifest
        .outputs
        .iter()
        .enumerate()
        .filter_map(|(index, output)| finder.output(index, output, &manifest, created_by))
        .collect();
    let mut named: Vec<(String, Target)> = Vec::new();
    // Paths become textures of the library, which must not be part of "all".
    let ids: Vec<String> = finder.sources.library.textures.iter().map(|texture| texture.id.clone()).collect();
    if !BatchSource::KEYS.into_iter().any(|key| finder.was_found(key)) {
        for (index, texture) in manifest.textures.iter().enumerate() {
            named.extend(finder.targets(index, texture, &ids));
        }
    }
    let stems = paths_in(Path::new(""), named.iter().map(|(name, _)| name), "");
    let targets: Vec<Target> = named
        .into_iter()
        .zip(stems)
        .map(|((name, target), stem)| Target { name, stem: stem.display().to_string(), ..target })
        .collect();
    let Finder { sources, spaces, found: mut problems, problems: further, .. } = finder;
    problems.extend(further);
    let plan = BatchPlan { manifest, sources, spaces, outputs, targets, library_sha256: sha256 };
    for (key, text) in plan.rate_problems() {
        add_problem(&mut problems, key, text);
    }
    let n_jobs = plan.n_textures().saturating_mul(plan.n_jobs_each());
    if problems.is_empty() && n_jobs == 0 {
        problems.push((
            "output".to_owned(),
            "the batch writes no file; add textures, strokes and outputs".to_owned(),
        ));
    }
    if n_jobs > MOST_JOBS {
        let text = format!(
            "these are {n_jobs} jobs, but a batch has at most {MOST_JOBS}; divide it into several manifests"
        );
        problems.push(("texture".to_owned(), text));
    }
    if problems.is_empty() { Ok(plan) } else { Err(problems) }
}

/// Adds a problem, unless one of the same key is known, of which this one could be a consequence.
pub fn add_problem(problems: &mut Vec<(String, String)>, key: String, text: String) {
    if !problems.iter().any(|(known, _)| *known == key) {
        problems.push((key, text));
    }
}

struct Finder<'a> {
    sources: BatchSources,
    spaces: BTreeMap<&'static str, Authoring>,
    /// Problems that were found before.
    found: Vec<(String, String)>,
    problems: Vec<(String, String)>,
    reporter: &'a dyn Reporter,
}

impl Finder<'_> {
    fn problem(&mut self, key: String, text: String) {
        if !self.was_found(&key) {
            self.problems.push((key, text));
        }
    }

    /// Whether a problem of this key was found before.
    fn was_found(&self, key: &str) -> bool {
        self.found.iter().any(|(known, _)| known == key)
    }

    fn output(
        &mut self,
        index: usize,
        output: &BatchOutput,
        manifest: &BatchManifest,
        created_by: &str,
    ) -> Option<PlannedOutput> {
        let key = |name: &str| format!("output[{}].{name}", index + 1);
        if output.id == RECORDS {
            self.problem(key("id"), format!("\"{RECORDS}\" is the folder of the records; choose another id"));
        }
        if let Some(format) = signal_format(&output.format) {
            let strokes: Vec<usize> = (0..manifest.strokes.len())
                .filter(|stroke| {
                    let id = &manifest.strokes[*stroke].id;
                    output.strokes.as_ref().is_none_or(|wanted| wanted.contains(id))
                })
                .collect();
            if output.loops {
                self.check_loop(&strokes, manifest, &key("loop"));
            }
            let is_consequence = self.was_found("stroke") || self.was_found(&key("strokes"));
            if strokes.is_empty() && !is_consequence {
                self.problem(key("format"), "signals need a stroke; add a [[stroke]]".to_owned());
            }
            let actuator = self.sources.actuators.get(index).and_then(Option::as_ref);
            let made =
                actuator.map(|actuator: &Actuator| acf(actuator, Drive::ASSUMED, created_by)).transpose();
            let acf = match made {
                Ok(acf) => acf,
                Err(error) => {
                    self.problem(key("actuator"), error.to_string());
                    None
                }
            };
            return Some(PlannedOutput { format: OutputFormat::Signal(format), strokes, acf });
        }
        if let Some(format) = format(&output.format) {
            let of_signals =
                output.stated.iter().filter(|key| **key != "actuator" || !format.describes_actuator());
            for name in of_signals {
                self.problem(key(name), format!("{} holds no signal; remove the key", format.name()));
            }
            return Some(PlannedOutput {
                format: OutputFormat::Model(format),
                strokes: Vec::new(),
                acf: None,
            });
        }
        let ids: Vec<&str> = listed().map(|format| format.id).collect();
        let near = near(ids.iter().copied(), &output.format);
        let advice = if near.is_empty() {
            format!("choose one of {}", ids.join(", "))
        } else {
            format!("did you mean {}?", near.join(", "))
        };
        self.problem(key("format"), format!("there is no format \"{}\"; {advice}", output.format));
        None
    }

    /// Checks that a loop has only steady strokes, each not too long.
    fn check_loop(&mut self, strokes: &[usize], manifest: &BatchManifest, key: &str) {
        for stroke in strokes {
            let id = &manifest.strokes[*stroke].id;
            match self.sources.strokes.get(*stroke) {
                Some(LoadedStroke::Recorded { .. }) => self.problem(
                    key.to_owned(),
                    format!(
                        "the stroke \"{id}\" is recorded and cannot be a loop; select steady strokes with `strokes`, or remove the key"
                    ),
                ),
                Some(LoadedStroke::Steady { seconds, .. }) if *seconds > MOST_LOOP_SECS => self.problem(
                    key.to_owned(),
                    format!("a loop lasts at most {MOST_LOOP_SECS} s; make the stroke \"{id}\" shorter"),
                ),
                Some(LoadedStroke::Steady { .. }) | None => {}
            }
        }
    }

    /// Textures that a table chooses, with their names. `ids` are those of the library.
    fn targets(&mut self, index: usize, texture: &BatchTexture, ids: &[String]) -> Vec<(String, Target)> {
        let BatchTexture { choice, blend, shape } = texture;
        let key = |name: &str| format!("texture[{}].{name}", index + 1);
        let target = |choice| Target {
            name: String::new(),
            stem: String::new(),
            choice,
            blend: *blend,
            shape: *shape,
        };
        let of_id = |id: &String| (id.clone(), target(TargetChoice::Texture(id.clone())));
        match choice {
            BatchChoice::All => ids.iter().map(of_id).collect(),
            BatchChoice::Ids(wanted) => {
                for id in wanted.iter().filter(|id| !ids.contains(id)) {
                    let text = unknown_texture(&self.sources.library, id);
                    self.problem(key("ids"), text);
                }
                wanted.iter().map(of_id).collect()
            }
            BatchChoice::Authored(names) => {
                let n_before = self.problems.len();
                for name in names {
                    self.check_authored(name, key("authored"));
                }
                if self.problems.len() > n_before {
                    return Vec::new();
                }
                names
                    .iter()
                    .map(|name| (name.clone(), target(TargetChoice::Authored(name.clone()))))
                    .collect()
            }
            BatchChoice::Points(points) => {
                self.space(*blend, key("blend"));
                let mut found = Vec::with_capacity(points.len());
                for coordinates in points {
                    match point_of(coordinates, &self.sources.library) {
                        Ok(point) => {
                            found.push((point_name(coordinates), target(TargetChoice::Point(point))));
                        }
                        Err(error) => self.problem(key("at"), error.to_string()),
                    }
                }
                found
            }
            BatchChoice::Path(path) => match self.path_entry(path, *blend, &key("path")) {
                Some(entry) => {
                    let named = (path.name.clone(), target(TargetChoice::Texture(entry.id.clone())));
                    self.sources.library.textures.push(entry);
                    vec![named]
                }
                None => Vec::new(),
            },
        }
    }

    /// Checks that the project has an authored texture, and makes its authoring space.
    fn check_authored(&mut self, name: &str, key: String) {
        // A manifest without a project has been refused by its reader.
        let Some(project) = &self.sources.project else { return };
        let found = find_authored(&project.project, name);
        let n_axes = self.sources.library.axis_names().len();
        match found.map(|authored| authored.blend.mode_in_space(n_axes)) {
            Ok(mode) => self.space(mode, key),
            Err(error) => self.problem(key, error.to_string()),
        }
    }

    /// Makes the authoring space of a mode, once.
    fn space(&mut self, mode: Mode, key: String) {
        let library = &self.sources.library;
        if self.spaces.contains_key(mode.id()) {
            return;
        }
        let supported =
            Blending::from(mode).check_in(library.axis_names().len()).map_err(anyhow::Error::from);
        match supported.and_then(|()| authoring(library, mode, self.reporter)) {
            Ok(space) => {
                self.spaces.insert(mode.id(), space);
            }
            Err(error) => self.problem(key, format!("{error:#}")),
        }
    }

    /// A texture of the library that follows a path.
    fn path_entry(&mut self, path: &BatchPath, mode: Mode, key: &str) -> Option<TextureEntry> {
        self.space(mode, key.to_owned());
        let library: &Library = &self.sources.library;
        let made = self.spaces.get(mode.id()).map(|space| path_on(space, library, path, mode))?;
        match made {
            Ok(path_of_textures) => {
                let space = self.spaces.get(mode.id())?;
                let of: Vec<usize> = space.space().sites().iter().map(|(texture, _)| *texture).collect();
                // Points outside the hull are moved to it, so that nothing is extrapolated.
                Some(library.entry_of_path(&path.name, path_of_textures, &of, 0))
            }
            Err(error) => {
                self.problem(key.to_owned(), format!("{error:#}"));
                None
            }
        }
    }
}

/// Returns the textures of a path whose points have equal distances along the stroke.
fn path_on(
    space: &Authoring,
    library: &Library,
    path: &BatchPath,
    mode: Mode,
) -> anyhow::Result<TexturePath> {
    let n_parts = path.points.len().saturating_sub(1).max(1) as f64;
    let stop = |(index, coordinates): (usize, &Vec<f64>)| {
        let along = path.length * index as f64 / n_parts;
        Ok(Stop { at: point_of(coordinates, library)?, along })
    };
    let stops = path.points.iter().enumerate().map(stop).collect::<anyhow::Result<Vec<Stop>>>()?;
    let route = Route::new(path.along, path.at_end, stops)?;
    Ok(TexturePath::of_route(space, &route, &Blending::from(mode))?)
}
