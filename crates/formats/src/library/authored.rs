//! Adding textures to a library: merging entries, and library entries for paths and reliefs.

use std::sync::Arc;

use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::relief::Relief;
use shagreen_core::texture::{TextureModel, TextureModelError};
use shagreen_core::units::Hertz;

use crate::library::{Library, Provenance, TextureEntry, free_id, id_from_name};

/// SPDX identifier for terms of use that nobody stated.
const UNKNOWN_TERMS: &str = "LicenseRef-unknown";
/// Sample rate of a texture that consists of a relief alone. A relief is rendered up to half of it, and higher
/// frequencies are not perceived.
const RELIEF_RATE: Hertz = Hertz(2000.0);

/// The terms of use of the data from which a relief was made.
#[derive(Clone, Copy, Debug)]
pub struct ReliefSource<'a> {
    /// Stated terms of use; empty if nobody stated any.
    pub terms: &'a [String],
    /// Whether the data must not be redistributed.
    pub is_restricted: bool,
}

impl Library {
    /// Appends textures. An entry whose identifier is taken gets a new one, because it may have been made for another
    /// library. An entry whose position has another number of coordinates than this library has axes loses it.
    pub fn join(&mut self, entries: &[Arc<TextureEntry>]) {
        let n_axes = self.axis_names().len();
        for entry in entries {
            let mut entry = TextureEntry::clone(entry);
            entry.id = free_id(&entry.id, |id| self.index_of(id).is_some());
            entry.place = entry.place.filter(|place| place.at.n_axes() == n_axes);
            self.textures.push(entry);
        }
    }

    /// Returns the library entry of a path through the space, interpolated from the textures at the indices `of`. Its
    /// identifier is unused in this library. The entry carries the terms of use of all these textures, and is
    /// restricted if one of them is. `n_extrapolated` keys of the path are extrapolated.
    pub fn entry_of_path(
        &self,
        name: &str,
        path: TexturePath,
        of: &[usize],
        n_extrapolated: usize,
    ) -> TextureEntry {
        let guessed = match n_extrapolated {
            0 => String::new(),
            n => format!(
                " {n} of its {} textures are extrapolated, beyond all measurements.",
                path.keys().len()
            ),
        };
        let first = path.keys()[0].model.clone();
        let entry = self.entry_interpolated_from(name, first, of);
        TextureEntry {
            origin: format!(
                "Authored as a path through the space of \"{}\"{}.{guessed}",
                self.name,
                self.position_sources(of)
            ),
            path: Some(path),
            ..entry
        }
    }

    /// Returns the library entry of a model that was interpolated at a point of the space, from the textures at the
    /// indices `of`. Identifier, terms and restriction are those of [`Library::entry_of_path`]. It has no position,
    /// because nobody rated it.
    pub fn entry_of_point(
        &self,
        name: &str,
        at: SpacePoint,
        model: TextureModel,
        of: &[usize],
    ) -> TextureEntry {
        TextureEntry {
            origin: format!(
                "Authored at {at} in the space of \"{}\"{}.",
                self.name,
                self.position_sources(of)
            ),
            ..self.entry_interpolated_from(name, model, of)
        }
    }

    /// An entry with an unused identifier, and with the terms of use of all textures that contributed.
    fn entry_interpolated_from(&self, name: &str, model: TextureModel, of: &[usize]) -> TextureEntry {
        let owed = || of.iter().filter_map(|index| self.textures.get(*index));
        let is_restricted = owed().any(|texture| texture.provenance == Provenance::Restricted);
        let id = free_id(&id_from_name(name), |id| self.index_of(id).is_some());
        TextureEntry {
            license: all_terms(&owed().map(|texture| self.license_of(texture)).collect::<Vec<_>>()),
            provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
            ..TextureEntry::new(id, name, model)
        }
    }

    /// Where the positions of the textures at these indices come from, as a clause; empty if none has a position.
    fn position_sources(&self, of: &[usize]) -> String {
        let mut sources: Vec<&str> = Vec::new();
        let labeled = of.iter().filter_map(|index| self.textures.get(*index)?.label_source());
        for source in labeled.map(LabelSource::label) {
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        match &sources[..] {
            [] => String::new(),
            some => format!(", with positions from {}", some.join(" and ")),
        }
    }

    /// Returns the library entry of a relief, alone or added to the texture at the index `over`. Its identifier is
    /// unused in this library, and it carries the terms of use of both. It has no position, because the position of the
    /// other texture does not describe it.
    ///
    /// # Errors
    /// [`TextureModelError`], which a valid relief never causes.
    pub fn entry_of_relief(
        &self,
        name: &str,
        relief: Arc<Relief>,
        over: Option<usize>,
        source: &ReliefSource<'_>,
    ) -> Result<TextureEntry, TextureModelError> {
        let id = free_id(&id_from_name(name), |id| self.index_of(id).is_some());
        let mut terms: Vec<&str> = source.terms.iter().map(String::as_str).collect();
        if terms.is_empty() {
            terms.push(UNKNOWN_TERMS);
        }
        let Some(texture) = over.and_then(|index| self.textures.get(index)) else {
            return Ok(TextureEntry {
                license: all_terms(&terms),
                origin: "A relief from the Signals workspace.".to_owned(),
                provenance: if source.is_restricted { Provenance::Restricted } else { Provenance::Free },
                ..TextureEntry::new(id, name, TextureModel::of_relief(relief, RELIEF_RATE)?)
            });
        };
        let is_restricted = source.is_restricted || texture.provenance == Provenance::Restricted;
        terms.insert(0, self.license_of(texture));
        Ok(TextureEntry {
            license: all_terms(&terms),
            origin: format!("A relief from the Signals workspace, over \"{}\".", texture.name),
            provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
            picture: texture.picture.clone(),
            ..TextureEntry::new(id, name, texture.model.clone().with_relief(Some(relief)))
        })
    }
}

/// Combines terms of use that all apply, as an SPDX expression; unstated ones become an explicit unknown.
fn all_terms(licenses: &[&str]) -> String {
    let mut distinct: Vec<&str> = Vec::new();
    for license in licenses.iter().map(|l| if l.is_empty() { UNKNOWN_TERMS } else { l }) {
        if !distinct.contains(&license) {
            distinct.push(license);
        }
    }
    if distinct.len() < 2 {
        return distinct.concat();
    }
    // In SPDX expressions, AND binds tighter than OR.
    let part = |license: &&str| {
        if license.contains(" OR ") { format!("({license})") } else { (*license).to_owned() }
    };
    distinct.iter().map(part).collect::<Vec<_>>().join(" AND ")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Library, Provenance, ReliefSource};
    use crate::library::Place;
    use crate::starter::starter_library;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::texture_path::{Along, AtEnd, Key, Stop, TexturePath};
    use shagreen_core::texture::profile::Profile;
    use shagreen_core::texture::relief::Relief;
    use shagreen_core::units::Newtons;

    fn path(library: &Library) -> TexturePath {
        let key = |i: usize| Key {
            stop: Stop { at: SpacePoint::plane(1.0, 2.0), along: i as f64 },
            is_stop: true,
            model: library.textures[i].model.clone(),
        };
        TexturePath::new(Along::Time, AtEnd::Hold, vec![key(0), key(1)]).unwrap()
    }

    #[test]
    fn a_relief_is_felt_alone_or_over_a_texture_with_its_terms() {
        let library = starter_library().unwrap();
        let profile = Profile::new(1e-4, vec![0.0, 1.0, -1.0, 0.5]).unwrap();
        let relief = Arc::new(Relief::new(profile, Newtons(1.0)).unwrap());
        let source = |is_restricted| ReliefSource { terms: &[], is_restricted };
        let alone = library.entry_of_relief("Cork", Arc::clone(&relief), None, &source(false)).unwrap();
        assert_eq!((alone.model.relief(), alone.model.tap()), (Some(&relief), None));
        assert!(library.index_of(&alone.id).is_none() && alone.place.is_none());
        assert_eq!((alone.license.as_str(), alone.provenance), ("LicenseRef-unknown", Provenance::Free));
        let over = library.entry_of_relief("Bumps", Arc::clone(&relief), Some(3), &source(true)).unwrap();
        let bare = &library.textures[3];
        assert_eq!(over.model, bare.model.clone().with_relief(Some(Arc::clone(&relief))));
        let stated = ["CC-BY-4.0".to_owned()];
        let source = ReliefSource { terms: &stated, is_restricted: false };
        assert_eq!(library.entry_of_relief("Weave", relief, None, &source).unwrap().license, "CC-BY-4.0");
        assert!(over.origin.contains(&bare.name) && over.place.is_none());
        assert_eq!(over.license, "(MIT OR Apache-2.0) AND LicenseRef-unknown");
        assert_eq!(over.provenance, Provenance::Restricted);
    }

    #[test]
    fn a_joined_texture_keeps_a_position_on_as_many_axes() {
        let starter = starter_library().unwrap();
        let mut library = starter.clone();
        let mut deep = starter.textures[1].clone();
        let place = deep.place.unwrap();
        deep.place = Some(Place { at: place.at.on(3), ..place });
        library.join(&[Arc::new(starter.textures[0].clone()), Arc::new(deep)]);
        let joined = &library.textures[starter.textures.len()..];
        assert_eq!((joined[0].place, joined[1].place), (starter.textures[0].place, None));
    }

    #[test]
    fn a_path_has_the_terms_of_all_that_it_is_made_of() {
        let mut library = starter_library().unwrap();
        let free = library.entry_of_path("Cork", path(&library), &[0, 1, 3], 0);
        assert_eq!((free.license.as_str(), free.provenance), (library.license.as_str(), Provenance::Free));
        assert!(library.index_of("cork").is_some() && library.index_of(&free.id).is_none(), "{}", free.id);
        assert_eq!(free.model, library.textures[0].model);
        "CC-BY-4.0".clone_into(&mut library.textures[3].license);
        library.textures[3].provenance = Provenance::Restricted;
        let bound = library.entry_of_path("Way", path(&library), &[0, 1, 3], 2);
        assert!(bound.origin.contains("2 of its"), "{}", bound.origin);
        assert_eq!(bound.license, "(MIT OR Apache-2.0) AND CC-BY-4.0");
        assert!(bound.origin.contains("from physical labels"), "{}", bound.origin);
        assert_eq!((bound.id.as_str(), bound.provenance), ("way", Provenance::Restricted));
        // A texture without weight in the path imposes no terms.
        assert_eq!(library.entry_of_path("Way", path(&library), &[0, 1], 0).provenance, Provenance::Free);
    }
}
