//! Added textures that only the authored textures that pin them use.

use std::sync::Arc;

use serde_json::Value;

use crate::library::v1::TextureV1;
use crate::library::write::texture;
use crate::library::{Library, TextureEntry};
use crate::project::{BlendChoice, Project, ProjectError, coordinates};

/// Name of the mark among the fields of an added texture.
const FIELD: &str = "own";

/// Added textures that take part only in the authored textures that pin them, as ascending indices of the list of a project
/// ([`Project::textures_on`]).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnTextures(Vec<usize>);

impl OwnTextures {
    /// Whether the texture with this index of the list is one of them.
    pub fn contains(&self, texture: usize) -> bool {
        self.0.binary_search(&texture).is_ok()
    }

    /// Indices of the textures that take no part in the interpolation of an authored texture: those that it does not pin.
    /// `textures` is the list of the project, and `is_pinned` states whether the authored texture pins the texture with this
    /// identifier of the list.
    pub fn left_out(&self, textures: &[TextureEntry], is_pinned: impl Fn(&str) -> bool) -> Vec<usize> {
        let is_left_out = |texture: &usize| textures.get(*texture).is_some_and(|entry| !is_pinned(&entry.id));
        self.0.iter().copied().filter(is_left_out).collect()
    }
}

impl Project {
    /// Returns whether the added texture with this index takes part only in the authored textures that pin it.
    pub fn is_own(&self, joined: usize) -> bool {
        self.joined.get(joined).is_some_and(|entry| self.own.contains(&entry.id))
    }

    /// The added textures that take part only in the authored textures that pin them, in a list of `n_listed` textures.
    pub fn own_textures(&self, n_listed: usize) -> OwnTextures {
        let n_of_library = n_listed.saturating_sub(self.joined.len());
        let own = (0..self.joined.len()).filter(|joined| self.is_own(*joined));
        OwnTextures(own.map(|joined| n_of_library + joined).collect())
    }

    /// As [`OwnTextures::left_out`], for the list `textures` of this project.
    pub fn left_out(&self, textures: &[TextureEntry], is_pinned: impl Fn(&str) -> bool) -> Vec<usize> {
        self.own_textures(textures.len()).left_out(textures, is_pinned)
    }

    /// Returns the list of the project ([`Project::textures_on`]) for one authored texture: textures that take no part
    /// ([`Project::left_out`]) have no position.
    pub fn with_places_of(&self, textures: &Library, is_pinned: impl Fn(&str) -> bool) -> Library {
        let mut library = textures.clone();
        for index in self.left_out(&textures.textures, is_pinned) {
            if let Some(entry) = library.textures.get_mut(index) {
                entry.place = None;
            }
        }
        library
    }

    /// Interpolation options for a new authored texture: those of the selected one, without pins of textures that belong to
    /// it.
    pub fn blend_of_new(&self) -> BlendChoice {
        let mut blend = self.texture().blend.clone();
        blend.locked.retain(|id| !self.own.contains(id));
        blend
    }

    /// Number of authored textures that can change when the texture with this identifier of the list begins or ceases to
    /// take part in all of them: those that do not pin it.
    pub fn n_without_pin(&self, id: &str) -> usize {
        self.authored.iter().filter(|texture| !texture.blend.locked.contains(id)).count()
    }
}

/// Takes the mark out of an added texture.
pub(super) fn read(wire: &mut TextureV1) -> Result<bool, ProjectError> {
    match wire.unknown.remove(FIELD) {
        None => Ok(false),
        Some(Value::Bool(is_own)) => Ok(is_own),
        Some(_) => Err(ProjectError::Damaged {
            reason: format!("`{FIELD}` of the added texture \"{}\" is neither true nor false", wire.id),
        }),
    }
}

/// The added textures, with their marks and coordinates.
pub(super) fn write(project: &Project) -> Vec<TextureV1> {
    let marked = |(joined, entry): (usize, &Arc<TextureEntry>)| {
        let mut wire = texture(entry);
        wire.unknown.remove(FIELD);
        if project.is_own(joined) {
            wire.unknown.insert(FIELD.to_owned(), Value::Bool(true));
        }
        coordinates::write(&project.coordinates, &mut wire);
        wire
    };
    project.joined.iter().enumerate().map(marked).collect()
}

/// Whether a project needs a version with marks.
pub(super) fn is_needed(project: &Project) -> bool {
    (0..project.joined.len()).any(|joined| project.is_own(joined))
}
