//! Textures that join a library, and what was authored in its space as an entry of its own.

use std::sync::Arc;

use shagreen_core::relief::Relief;
use shagreen_core::space::LabelSource;
use shagreen_core::texture::{TextureModel, TextureModelError};
use shagreen_core::texture_path::TexturePath;
use shagreen_core::units::Hertz;

use crate::library::{Library, Provenance, TextureEntry, free_id, id_from_name};

/// What stands for terms that nobody stated, in the form of the SPDX.
const UNKNOWN_TERMS: &str = "LicenseRef-unknown";
/// Samples a second of a texture that is a relief alone: a relief is played up to half of them, and more is not felt.
const RELIEF_RATE: Hertz = Hertz(2000.0);

/// What a relief was made of.
#[derive(Clone, Copy, Debug)]
pub struct ReliefSource<'a> {
    /// The terms of that; empty where nobody stated any.
    pub terms: &'a [String],
    /// Whether it may not be passed on.
    pub is_restricted: bool,
}

impl Library {
    /// Adds textures. One whose identifier is taken gets another: it may have been made for a library that has none of this
    /// name.
    pub fn join(&mut self, entries: &[Arc<TextureEntry>]) {
        for entry in entries {
            let mut entry = TextureEntry::clone(entry);
            entry.id = free_id(&entry.id, |id| self.index_of(id).is_some());
            self.textures.push(entry);
        }
    }

    /// The entry of a path through the space of the textures at these indices, with an identifier that is free in this
    /// library. It owes something to each of them: it has the terms of all, and may not be passed on where one may not.
    /// So many of its keys are extrapolated.
    pub fn entry_of_path(
        &self,
        name: &str,
        path: TexturePath,
        of: &[usize],
        n_extrapolated: usize,
    ) -> TextureEntry {
        let owed = || of.iter().filter_map(|index| self.textures.get(*index));
        let is_restricted = owed().any(|texture| texture.provenance == Provenance::Restricted);
        let mut sources: Vec<&str> = Vec::new();
        for source in owed().filter_map(TextureEntry::label_source).map(LabelSource::label) {
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        let places = match &sources[..] {
            [] => String::new(),
            some => format!(", whose places come from {}", some.join(" and ")),
        };
        let guessed = match n_extrapolated {
            0 => String::new(),
            n => format!(
                " {n} of its {} textures are extrapolated: nothing was measured there.",
                path.keys().len()
            ),
        };
        let first = path.keys()[0].model.clone();
        let id = free_id(&id_from_name(name), |id| self.index_of(id).is_some());
        TextureEntry {
            license: all_terms(&owed().map(|texture| self.license_of(texture)).collect::<Vec<_>>()),
            origin: format!("Authored as a path through the space of \"{}\"{places}.{guessed}", self.name),
            provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
            path: Some(path),
            ..TextureEntry::new(id, name, first)
        }
    }

    /// The entry of a relief, felt over the texture at an index or alone, with an identifier that is free in this library and the
    /// terms of both. It has no place: it was not felt where the other texture lies.
    ///
    /// # Errors
    /// [`TextureModelError`], which no relief has.
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
                origin: "A relief from the workspace Signals.".to_owned(),
                provenance: if source.is_restricted { Provenance::Restricted } else { Provenance::Free },
                ..TextureEntry::new(id, name, TextureModel::of_relief(relief, RELIEF_RATE)?)
            });
        };
        let is_restricted = source.is_restricted || texture.provenance == Provenance::Restricted;
        terms.insert(0, self.license_of(texture));
        Ok(TextureEntry {
            license: all_terms(&terms),
            origin: format!("A relief from the workspace Signals, over \"{}\".", texture.name),
            provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
            picture: texture.picture.clone(),
            ..TextureEntry::new(id, name, texture.model.clone().with_relief(Some(relief)))
        })
    }
}

/// Terms that have to be kept together, as an SPDX expression; those that nobody stated are named as unknown.
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
    // AND binds tighter than OR.
    let part = |license: &&str| {
        if license.contains(" OR ") { format!("({license})") } else { (*license).to_owned() }
    };
    distinct.iter().map(part).collect::<Vec<_>>().join(" AND ")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Library, Provenance, ReliefSource};
    use crate::starter::starter_library;
    use shagreen_core::profile::Profile;
    use shagreen_core::relief::Relief;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::texture_path::{Along, AtEnd, Key, Stop, TexturePath};
    use shagreen_core::units::Newtons;

    fn path(library: &Library) -> TexturePath {
        let key = |i: usize| Key {
            stop: Stop { at: SpacePoint { rough_smooth: 1.0, hard_soft: 2.0 }, along: i as f64 },
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
        // What has no say is owed nothing.
        assert_eq!(library.entry_of_path("Way", path(&library), &[0, 1], 0).provenance, Provenance::Free);
    }
}
