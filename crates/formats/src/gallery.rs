//! Example projects built into the program.

use std::io;
use std::path::Path;

use crate::project::{Project, ProjectError, read_project};

/// A built-in example project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GalleryProject {
    /// Identifier on the command line.
    pub id: &'static str,
    /// Name to show.
    pub title: &'static str,
    bytes: &'static [u8],
}

/// All example projects, in the order of the list.
pub const GALLERY: [GalleryProject; 12] = [
    entry("ways-to-blend", "Ways to blend", include_bytes!("../../../assets/gallery/ways-to-blend.shagreen")),
    entry("journeys", "Journeys", include_bytes!("../../../assets/gallery/journeys.shagreen")),
    entry("couch-fabrics", "Couch fabrics", include_bytes!("../../../assets/gallery/couch-fabrics.shagreen")),
    entry("wooden-desk", "Wooden desk", include_bytes!("../../../assets/gallery/wooden-desk.shagreen")),
    entry("phone-back", "Phone back", include_bytes!("../../../assets/gallery/phone-back.shagreen")),
    entry("tool-handles", "Tool handles", include_bytes!("../../../assets/gallery/tool-handles.shagreen")),
    entry("car-interior", "Car interior", include_bytes!("../../../assets/gallery/car-interior.shagreen")),
    entry("paper-mill", "Paper mill", include_bytes!("../../../assets/gallery/paper-mill.shagreen")),
    entry("bathroom", "Bathroom", include_bytes!("../../../assets/gallery/bathroom.shagreen")),
    entry("kitchen", "Kitchen", include_bytes!("../../../assets/gallery/kitchen.shagreen")),
    entry("sportswear", "Sportswear", include_bytes!("../../../assets/gallery/sportswear.shagreen")),
    entry("garden", "Garden", include_bytes!("../../../assets/gallery/garden.shagreen")),
];

const fn entry(id: &'static str, title: &'static str, bytes: &'static [u8]) -> GalleryProject {
    GalleryProject { id, title, bytes }
}

impl GalleryProject {
    /// Reads the project.
    ///
    /// # Errors
    /// Fails only if the embedded file is damaged, which a test excludes.
    pub fn read(&self) -> Result<Project, ProjectError> {
        // Gallery projects use a built-in library, so they read no other file.
        let nothing = |_: &Path| Err(io::ErrorKind::NotFound.into());
        read_project(self.bytes, Path::new(""), &nothing).map(|imported| imported.value)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::path::Path;

    use super::GALLERY;
    use crate::project::{ProjectLibrary, write_project};
    use shagreen_core::space::Space;
    use shagreen_core::space::authoring::Outside;

    /// Every project equals what the program writes, uses a built-in library, and authors inside the convex hull unless
    /// it requests extrapolation.
    #[test]
    fn the_committed_files_are_sound() {
        let mut names = HashSet::new();
        for each in GALLERY {
            let project = each.read().unwrap();
            assert_eq!(
                String::from_utf8(write_project(&project, Path::new(""), "Shagreen")).unwrap(),
                String::from_utf8(each.bytes.to_vec()).unwrap(),
                "{}",
                each.id
            );
            assert!(matches!(project.library, ProjectLibrary::BuiltIn(_)) && !project.notes.is_empty());
            let library = project.library.read().unwrap();
            let space = Space::new(&library.positions()).unwrap();
            assert!(project.authored.len() >= 3, "{}", each.id);
            for texture in &project.authored {
                assert!(names.insert((each.id, texture.name.clone())), "{} twice", texture.name);
                assert!(texture.blend.locked.iter().all(|id| library.index_of(id).is_some()));
                let is_beyond = texture.blend.outside == Outside::Extrapolated;
                let is_outside =
                    space.locate(texture.at).unwrap().clamped && space.hull_distance(texture.at) > 2.0;
                assert_eq!(is_outside, is_beyond, "{} in {}", texture.name, each.id);
                assert!(texture.path.as_ref().is_none_or(|path| path.route().is_some()), "{}", texture.name);
            }
        }
        assert!(names.len() >= 48, "{}", names.len());
    }
}
