//! Authored textures that are copied from one project and pasted into another.

use std::collections::{BTreeMap, BTreeSet};

use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{Library, free_name};
use shagreen_formats::project::clipboard::CopiedTexture;
use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project};

use crate::strings::clipboard as strings;

/// Offset of a copy from its original along each axis, in axis units (0 to 100).
const BESIDE: f64 = 4.0;
/// Distance below which two authored textures hide each other on the canvas, in axis units.
const SAME_PLACE: f64 = 1e-6;

/// Position of a copy of a texture at `at`, offset by some points and inside the space.
pub fn beside(at: SpacePoint) -> SpacePoint {
    // Added to each coordinate, or subtracted if the sum would exceed 100.
    let step = |x: f64| if x + BESIDE <= 100.0 { x + BESIDE } else { x - BESIDE };
    SpacePoint { rough_smooth: step(at.rough_smooth), hard_soft: step(at.hard_soft) }
}

/// An authored texture with the names of what it refers to. `axes` are the words at the ends of both axes.
pub fn copied(texture: &AuthoredTexture, library: &Library, axes: &[[String; 2]; 2]) -> CopiedTexture {
    let named = |id: &String| {
        let index = library.index_of(id)?;
        Some((id.clone(), library.textures[index].name.clone()))
    };
    CopiedTexture {
        texture: texture.clone(),
        library: library.name.clone(),
        axes: axes.clone(),
        pinned: texture.blend.locked.iter().filter_map(named).collect(),
    }
}

/// A texture to add to a project, and warnings about what differs from the project that it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The texture.
    pub texture: AuthoredTexture,
    /// Warnings of the user.
    pub warnings: Vec<String>,
}

/// Fits a copied texture into a project with this library and these axes: its name becomes unique, it does not cover
/// another authored texture, and pins of textures that the library lacks are removed.
pub fn pasted(
    copied: CopiedTexture,
    project: &Project,
    library: &Library,
    axes: &[[String; 2]; 2],
) -> Pasted {
    let mut warnings = Vec::new();
    if copied.library != library.name || copied.axes != *axes {
        warnings.push(strings::from_another_space(&copied.library, &copied.axes));
    }
    let CopiedTexture { texture, pinned, .. } = copied;
    let (locked, missing): (BTreeSet<String>, BTreeSet<String>) =
        texture.blend.locked.iter().cloned().partition(|id| library.index_of(id).is_some());
    if !missing.is_empty() {
        warnings.push(strings::not_pinned(&names_of(missing, &pinned)));
    }
    let others = &project.authored;
    let name = free_name(&texture.name, |name| others.iter().any(|other| other.name == name));
    let is_taken = |at: SpacePoint| others.iter().any(|other| other.at.distance(at) < SAME_PLACE);
    let mut at = texture.at;
    // After as many steps as there are textures, one of the positions is free, or they alternate in a corner.
    for _ in 0..others.len() {
        if is_taken(at) {
            at = beside(at);
        }
    }
    let blend = BlendChoice { locked, ..texture.blend };
    Pasted { texture: AuthoredTexture { name, at, blend, ..texture }, warnings }
}

/// Names of textures; an identifier where the name is unknown.
fn names_of(ids: BTreeSet<String>, names: &BTreeMap<String, String>) -> Vec<String> {
    ids.into_iter().map(|id| names.get(&id).cloned().unwrap_or(id)).collect()
}

#[cfg(test)]
mod tests {
    use super::{beside, copied, pasted};
    use crate::state::edit::{Edit, edited};
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::library::Library;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

    fn axes() -> [[String; 2]; 2] {
        [["rough", "smooth"], ["hard", "soft"]].map(|ends| ends.map(str::to_owned))
    }

    fn starter() -> (Project, Library) {
        let library = BuiltIn::Starter.read().unwrap();
        (Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Felt"), library)
    }

    fn pinned(id: &str) -> AuthoredTexture {
        let mut texture = AuthoredTexture::new(1, "Felt");
        texture.blend.locked.insert(id.to_owned());
        texture
    }

    #[test]
    fn a_texture_of_the_same_project_is_pasted_beside_under_a_name_of_its_own() {
        let (mut project, library) = starter();
        for (n, name) in [(1.0, "Felt 2"), (2.0, "Felt 3")] {
            let outcome = pasted(copied(&pinned("cork"), &library, &axes()), &project, &library, &axes());
            assert_eq!(outcome.warnings, Vec::<String>::new());
            let at = 50.0 + 4.0 * n;
            assert_eq!(outcome.texture.at, SpacePoint { rough_smooth: at, hard_soft: at });
            assert_eq!(outcome.texture.name, name);
            assert!(outcome.texture.blend.locked.contains("cork"));
            project = edited(&project, Edit::Author(outcome.texture));
        }
        let corner = SpacePoint { rough_smooth: 100.0, hard_soft: 98.0 };
        assert_eq!(beside(corner), SpacePoint { rough_smooth: 96.0, hard_soft: 94.0 });
    }

    #[test]
    fn what_another_library_lacks_is_named() {
        let (project, library) = starter();
        let mut source = library.clone();
        "Woods".clone_into(&mut source.name);
        let cork = source.index_of("cork").unwrap();
        "elm".clone_into(&mut source.textures[cork].id);
        "Elm".clone_into(&mut source.textures[cork].name);
        let mut texture = pinned("elm");
        texture.blend.locked.insert("glass".to_owned());
        let outcome = pasted(copied(&texture, &source, &axes()), &project, &library, &axes());
        assert_eq!(outcome.texture.blend.locked.iter().collect::<Vec<_>>(), ["glass"]);
        let [space, pins] = &outcome.warnings[..] else { panic!("{:?}", outcome.warnings) };
        assert!(space.contains("library Woods, axes rough to smooth and hard to soft"), "{space}");
        assert!(pins.ends_with("lacks them: Elm"), "{pins}");
    }
}
