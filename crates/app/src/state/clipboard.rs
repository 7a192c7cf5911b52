//! Authored textures that are copied from one project and pasted into another.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{Library, Place, TextureEntry, free_name};
use shagreen_formats::project::clipboard::CopiedTexture;
use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project};

use crate::strings::clipboard as strings;

/// Offset of a copy from its original along each axis, in axis units (0 to 100).
const BESIDE: f64 = 4.0;
/// Distance below which two authored textures hide each other on the canvas, in axis units.
const SAME_PLACE: f64 = 1e-6;

/// Position of a copy of a texture at `at`, offset on the canvas by some points and inside the space.
pub fn beside(at: SpacePoint) -> SpacePoint {
    // Added to each coordinate, or subtracted if the sum would exceed 100.
    let step = |x: f64| if x + BESIDE <= 100.0 { x + BESIDE } else { x - BESIDE };
    at.on_canvas_at(SpacePoint::plane(step(at.x()), step(at.y())))
}

/// An authored texture of a project with the names of what it refers to, and the pinned textures that were added to the
/// project. `library` is the list of the project, and `axes` are the words at the ends of its axes.
pub fn copied(
    texture: &AuthoredTexture,
    project: &Project,
    library: &Library,
    axes: &[[String; 2]],
) -> CopiedTexture {
    let named = |id: &String| {
        let index = library.index_of(id)?;
        Some((id.clone(), library.textures[index].name.clone()))
    };
    let pinned: BTreeMap<String, String> = texture.blend.locked.iter().filter_map(named).collect();
    // An added texture has the name that the list shows.
    let travels = |entry: &Arc<TextureEntry>| {
        let name = pinned.get(&entry.id)?.clone();
        Some(TextureEntry { name, ..TextureEntry::clone(entry) })
    };
    CopiedTexture {
        texture: texture.clone(),
        library: library.name.clone(),
        axes: axes.to_vec(),
        textures: project.joined.iter().filter_map(travels).collect(),
        pinned,
    }
}

/// A texture to add to a project, and warnings about what differs from the project that it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The texture.
    pub texture: AuthoredTexture,
    /// Textures that it pins and that the project lacks, to be added with it.
    pub own: Vec<Arc<TextureEntry>>,
    /// Warnings of the user.
    pub warnings: Vec<String>,
}

/// Fits a copied texture into a project with this library and these axes: its name becomes unique, it does not cover
/// another authored texture, and pins of textures that neither the library nor the copy has are removed. Between spaces with other
/// axes, at least one of them with more or fewer than two, its points keep the coordinates on axes of the same words, and
/// `complete` gives them the others.
pub fn pasted(
    copied: CopiedTexture,
    project: &Project,
    library: &Library,
    axes: &[[String; 2]],
    complete: impl Fn(&[Option<f64>]) -> SpacePoint,
) -> Pasted {
    let mut warnings = Vec::new();
    if copied.library != library.name || copied.axes != *axes {
        warnings.push(strings::from_another_space(&copied.library, &copied.axes));
    }
    let CopiedTexture { mut texture, pinned, textures, axes: before, .. } = copied;
    if before != *axes && (before.len(), axes.len()) != (2, 2) {
        let told = |at: SpacePoint| -> Vec<Option<f64>> {
            let coordinate = |ends: &[String; 2]| at.get(before.iter().position(|known| known == ends)?);
            axes.iter().map(coordinate).collect()
        };
        texture.at = complete(&told(texture.at));
        for point in texture.path.iter_mut().flat_map(|path| &mut path.points) {
            *point = complete(&told(*point));
        }
    }
    let is_lacking = |entry: &TextureEntry| !is_listed(entry, library);
    let own: Vec<TextureEntry> = textures.into_iter().filter(is_lacking).collect();
    let is_known = |id: &String| own.iter().any(|entry| entry.id == *id) || library.index_of(id).is_some();
    let (locked, missing): (BTreeSet<String>, BTreeSet<String>) =
        texture.blend.locked.iter().cloned().partition(is_known);
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
    let own = own.into_iter().map(|entry| Arc::new(with_own_place(entry, library))).collect();
    Pasted { texture: AuthoredTexture { name, at, blend, ..texture }, own, warnings }
}

/// Whether the library has this very texture: an identifier alone may be that of another one.
fn is_listed(entry: &TextureEntry, library: &Library) -> bool {
    let listed = library.index_of(&entry.id).and_then(|index| library.textures.get(index));
    listed.is_some_and(|listed| listed.model == entry.model && listed.picture == entry.picture)
}

/// A texture without its position if another one of the library lies there: two at one position form no space.
fn with_own_place(entry: TextureEntry, library: &Library) -> TextureEntry {
    let mut places = library.textures.iter().filter_map(TextureEntry::at);
    let is_taken = |place: &Place| places.any(|other| other.distance(place.at) < SAME_PLACE);
    let is_taken = entry.place.as_ref().is_some_and(is_taken);
    if is_taken { TextureEntry { place: None, ..entry } } else { entry }
}

/// Names of textures; an identifier where the name is unknown.
fn names_of(ids: BTreeSet<String>, names: &BTreeMap<String, String>) -> Vec<String> {
    ids.into_iter().map(|id| names.get(&id).cloned().unwrap_or(id)).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{beside, copied, pasted};
    use crate::state::edit::{Edit, edited};
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::library::Library;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

    fn axes() -> [[String; 2]; 2] {
        [["rough", "smooth"], ["hard", "soft"]].map(|ends| ends.map(str::to_owned))
    }

    /// The same axes stay, so that nothing is completed.
    fn whole(told: &[Option<f64>]) -> SpacePoint {
        panic!("{told:?}")
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
            let copy = copied(&pinned("cork"), &project, &library, &axes());
            let outcome = pasted(copy, &project, &library, &axes(), whole);
            assert_eq!((outcome.warnings, outcome.own), (Vec::new(), Vec::new()));
            let at = 50.0 + 4.0 * n;
            assert_eq!(outcome.texture.at, SpacePoint::plane(at, at));
            assert_eq!(outcome.texture.name, name);
            assert!(outcome.texture.blend.locked.contains("cork"));
            project = edited(&project, Edit::Author(Box::new(outcome.texture)));
        }
        let corner = SpacePoint::plane(100.0, 98.0);
        assert_eq!(beside(corner), SpacePoint::plane(96.0, 94.0));
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
        let copy = copied(&texture, &project, &source, &axes());
        let outcome = pasted(copy, &project, &library, &axes(), whole);
        assert_eq!(outcome.texture.blend.locked.iter().collect::<Vec<_>>(), ["glass"]);
        let [space, pins] = &outcome.warnings[..] else { panic!("{:?}", outcome.warnings) };
        assert!(space.contains("library Woods, axes rough to smooth and hard to soft"), "{space}");
        assert!(pins.ends_with("lacks them: Elm"), "{pins}");
    }

    /// A texture of one project, such as a generated one, goes with the authored texture that pins it, unless it is there.
    #[test]
    fn a_pinned_texture_that_was_added_travels_with_the_copy() {
        let (project, library) = starter();
        let mut own = library.textures[0].clone();
        "ribs".clone_into(&mut own.id);
        (own.place, own.picture) = (None, None);
        let join = Edit::JoinSimulated { key: 1, entry: Arc::new(own.clone()), earlier: None };
        let source = edited(&project, join);
        let list = source.textures_on(library.clone());
        let copy = copied(source.texture(), &source, &list, &axes());
        assert_eq!(copy.textures, [own.clone()]);
        // A texture of the same identifier is another one.
        let mut other = own.clone();
        other.picture = library.textures[1].picture.clone();
        let target = edited(&project, Edit::AddTextures(vec![Arc::new(other)]));
        let outcome = pasted(copy.clone(), &target, &target.textures_on(library.clone()), &axes(), whole);
        assert_eq!(outcome.warnings, Vec::<String>::new());
        let after =
            edited(&target, Edit::AuthorWith { texture: Box::new(outcome.texture), own: outcome.own });
        assert_eq!(after.joined[1].id, "ribs-2");
        assert!(after.own.contains("ribs-2") && !after.own.contains("ribs"));
        assert_eq!(after.texture().blend.locked.iter().collect::<Vec<_>>(), ["ribs-2"]);
        // In its own project there is nothing to add.
        assert_eq!(pasted(copy, &source, &list, &axes(), whole).own, Vec::new());
    }
    #[test]
    fn a_texture_goes_to_a_space_with_other_axes() {
        let (project, library) = starter();
        let mut texture = AuthoredTexture::new(1, "Felt");
        texture.at = SpacePoint::plane(20.0, 30.0);
        let copy = copied(&texture, &project, &library, &axes());
        let further = [["hard", "soft"], ["dull", "bright"], ["rough", "smooth"]];
        let further = further.map(|ends| ends.map(str::to_owned));
        let complete = |told: &[Option<f64>]| {
            assert_eq!(told, [Some(30.0), None, Some(20.0)]);
            SpacePoint::of(&[30.0, 44.0, 20.0]).unwrap()
        };
        let outcome = pasted(copy, &project, &library, &further, complete);
        assert_eq!(outcome.texture.at.coordinates(), [30.0, 44.0, 20.0]);
        assert_eq!(outcome.warnings.len(), 1, "{:?}", outcome.warnings);
        let corner = SpacePoint::of(&[100.0, 10.0, 55.0]).unwrap();
        assert_eq!(beside(corner).coordinates(), [96.0, 14.0, 55.0]);
    }
}
