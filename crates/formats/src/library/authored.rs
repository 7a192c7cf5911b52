//! A texture that was authored in the space of a library, as an entry of its own.

use shagreen_core::texture_path::TexturePath;

use crate::library::{Library, Provenance, TextureEntry, free_id, id_from_name};

impl Library {
    /// The entry of a path through the space of this library, with an identifier that is free in it. It owes something to
    /// every texture that has a place: it has the terms of all of them, and may not be passed on where one of them may not.
    pub fn entry_of_path(&self, name: &str, path: TexturePath) -> TextureEntry {
        let placed = || self.textures.iter().filter(|texture| texture.place.is_some());
        let mut licenses: Vec<&str> = Vec::new();
        for license in placed().map(|texture| self.license_of(texture)).filter(|license| !license.is_empty())
        {
            if !licenses.contains(&license) {
                licenses.push(license);
            }
        }
        let is_restricted = placed().any(|texture| texture.provenance == Provenance::Restricted);
        let first = path.keys()[0].model.clone();
        let id = free_id(&id_from_name(name), |id| self.index_of(id).is_some());
        TextureEntry {
            license: licenses.join(" AND "),
            origin: format!("Authored as a path through the space of \"{}\".", self.name),
            provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
            path: Some(path),
            ..TextureEntry::new(id, name, first)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Library, Provenance};
    use crate::starter::starter_library;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::texture_path::{Along, AtEnd, Key, Stop, TexturePath};

    fn path(library: &Library) -> TexturePath {
        let key = |i: usize| Key {
            stop: Stop { at: SpacePoint { rough_smooth: 1.0, hard_soft: 2.0 }, along: i as f64 },
            is_stop: true,
            model: library.textures[i].model.clone(),
        };
        TexturePath::new(Along::Time, AtEnd::Hold, vec![key(0), key(1)]).unwrap()
    }

    #[test]
    fn a_path_has_the_terms_of_all_that_it_is_made_of() {
        let mut library = starter_library().unwrap();
        let free = library.entry_of_path("Cork", path(&library));
        assert_eq!((free.license.as_str(), free.provenance), (library.license.as_str(), Provenance::Free));
        assert!(library.index_of("cork").is_some() && library.index_of(&free.id).is_none(), "{}", free.id);
        assert_eq!(free.model, library.textures[0].model);
        "CC-BY-4.0".clone_into(&mut library.textures[3].license);
        library.textures[3].provenance = Provenance::Restricted;
        let bound = library.entry_of_path("Way", path(&library));
        assert!(bound.license.contains(" AND CC-BY-4.0"), "{}", bound.license);
        assert_eq!((bound.id.as_str(), bound.provenance), ("way", Provenance::Restricted));
        // What has no place has no say.
        library.textures[3].place = None;
        assert_eq!(library.entry_of_path("Way", path(&library)).provenance, Provenance::Free);
    }
}
