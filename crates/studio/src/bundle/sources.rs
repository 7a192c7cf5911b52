//! The sources of the textures of a bundle: terms of use, origin, and what authored textures are made of.

use std::collections::BTreeMap;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Authoring;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::bundle::BundledTextureV1;
use shagreen_formats::library::{Library, Provenance};
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::authoring::authoring;
use crate::project::textures_on_axes;
use crate::report::{Reporter, Warnings};
use crate::sound::Sound;

/// The textures of a library.
pub(super) fn listed_textures(library: &Library) -> Vec<BundledTextureV1> {
    let listed = |index: usize| {
        let entry = library.with_terms(&library.textures[index]);
        BundledTextureV1 {
            id: entry.id,
            name: entry.name,
            licence: entry.license,
            origin: entry.origin,
            restricted: entry.provenance == Provenance::Restricted,
            authored: false,
            parents: Vec::new(),
        }
    };
    (0..library.textures.len()).map(listed).collect()
}

/// The authored textures of a project with the textures that they are made of. `list` are the textures of the project.
pub(super) fn authored_textures(
    project: &Project,
    list: &Library,
    reporter: &dyn Reporter,
) -> Vec<BundledTextureV1> {
    let placed = textures_on_axes(project);
    let placed = placed.as_ref().unwrap_or(list);
    let mut spaces = Spaces::default();
    let source = |authored: &AuthoredTexture| {
        let parents = spaces.parents(project, placed, authored).unwrap_or_else(|error| {
            reporter.warn(&format!(
                "what the authored texture \"{}\" is made of cannot be found, so that all textures are stated: {error:#}",
                authored.name
            ));
            (0..placed.textures.len()).collect()
        });
        texture_of(placed, authored, &parents)
    };
    project.authored.iter().map(|authored| &**authored).map(source).collect()
}

fn texture_of(library: &Library, authored: &AuthoredTexture, parents: &[usize]) -> BundledTextureV1 {
    let (mut licence, mut origin, mut restricted) = (String::new(), String::new(), false);
    if let Some(first) = parents.first() {
        // Terms and origin do not depend on the model.
        let model = library.textures[*first].model.clone();
        let at = authored.at.on(library.axis_names().len());
        let entry = library.entry_of_point(&authored.name, at, model, parents);
        (licence, origin, restricted) =
            (entry.license, entry.origin, entry.provenance == Provenance::Restricted);
    }
    BundledTextureV1 {
        id: authored.key.to_string(),
        name: authored.name.clone(),
        licence,
        origin,
        restricted,
        authored: true,
        parents: parents.iter().map(|index| library.textures[*index].id.clone()).collect(),
    }
}

/// Authoring spaces by their interpolation mode and the textures that take no part: most authored textures share one.
#[derive(Default)]
struct Spaces(BTreeMap<(&'static str, Vec<usize>), (Library, Authoring)>);

impl Spaces {
    /// Returns the textures that an authored texture is made of, at its position and along its path, by ascending index.
    fn parents(
        &mut self,
        project: &Project,
        placed: &Library,
        authored: &AuthoredTexture,
    ) -> anyhow::Result<Vec<usize>> {
        // Their warnings are about the sound, which is not made here.
        let reporter = Warnings::default();
        let mode = authored.blend.mode_in_space(placed.axis_names().len());
        let is_pinned = |id: &str| authored.blend.is_locked(id);
        let key = (mode.id(), project.left_out(&placed.textures, is_pinned));
        if !self.0.contains_key(&key) {
            let library = project.with_places_of(placed, is_pinned);
            let space = authoring(&library, mode, &reporter)?;
            self.0.insert(key.clone(), (library, space));
        }
        let (library, space) = &self.0[&key];
        let along = authored.path.iter().flat_map(|path| &path.points);
        let mut points: Vec<SpacePoint> = along.copied().chain([authored.at]).collect();
        points.dedup();
        let mut parents: Vec<usize> = Vec::new();
        for at in points {
            let there = AuthoredTexture { at, path: None, ..authored.clone() };
            let sound = Sound::of_authored_in(space, library, &there, &Shape::default(), &reporter)?;
            parents.extend(sound.parents.iter().map(|(texture, _)| *texture));
        }
        parents.sort_unstable();
        parents.dedup();
        Ok(parents)
    }
}
