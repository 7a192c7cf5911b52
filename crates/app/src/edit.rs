//! Changes of a project, with their names: there is no other way to change one, so that undo restores it exactly.

use std::borrow::Cow;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

use shagreen_core::authoring::{Outside, Weights};
use shagreen_core::blend::Mode;
use shagreen_core::drawn_path::DrawnPath;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::Picture;
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

use crate::strings::edits as strings;

/// A change of the project. Where nothing else is said, it is one of the authored texture that is selected.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// It moves to a place in the square, and the blend there is heard.
    MovePoint(SpacePoint),
    /// Textures become one in another way.
    SetMode(Mode),
    /// The field meets a texture exactly at its own place, or smooths it again.
    Lock {
        /// Its identifier.
        id: String,
        /// Its name.
        name: String,
        /// Whether it is to be met.
        is_locked: bool,
    },
    /// The field ends at the outline of the textures, or goes on.
    SetOutside(Outside),
    /// Other neighbors have a say.
    SetWeights(Weights),
    /// It gets a name.
    Rename(String),
    /// It is known by another color.
    SetColor(u8),
    /// Something is noted of it.
    SetNotes(String),
    /// It is found by other words.
    SetTags(Vec<String>),
    /// It has a picture of its own, or again that of its neighbors.
    SetPicture(Option<Arc<Picture>>),
    /// The path is drawn, changed or taken away.
    ChangePath(PathChange, Option<DrawnPath>),
    /// It becomes what words describe: its place, its picture and what is noted of it.
    Remake {
        /// Where it lies.
        at: SpacePoint,
        /// What it looks like.
        picture: Arc<Picture>,
        /// What is noted.
        notes: String,
    },
    /// Another one joins those that are authored, and is selected.
    Author(AuthoredTexture),
    /// The authored texture of this key goes; the last one cannot.
    Remove(u32),
    /// The authored texture of this key is worked on.
    Select(u32),
    /// The state of it is kept, to come back to.
    KeepSnapshot,
    /// It is again as a snapshot has it, by its place among them; its name, color and notes stay.
    RestoreSnapshot(usize),
    /// A snapshot goes, by its place among them.
    RemoveSnapshot(usize),
    /// What is to be remembered of the project.
    SetProjectNotes(String),
    /// Another library is open. Points stay where they are, between other neighbors; a space in use, axes, locks, names and
    /// stars of textures, and what is heard alone belong to the textures that were there, and end.
    OpenLibrary(ProjectLibrary),
    /// The library is from now on a part of the project.
    KeepLibraryInside(ProjectLibrary),
    /// Textures join the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// A texture that joined goes, by its place among those.
    RemoveTexture(usize),
    /// A texture of the list gets another name.
    RenameTexture {
        /// Its identifier.
        id: String,
        /// The name.
        name: String,
    },
    /// A texture of the list is to be found again soon, or no longer.
    Star {
        /// Its identifier.
        id: String,
        /// Its name.
        name: String,
        /// Whether it is.
        is_starred: bool,
    },
    /// One texture of the list is heard alone, until the point moves, by its identifier; or the blend again.
    Solo(Option<String>),
    /// A space that was built gives the textures their places and attributes.
    UseSpace(Arc<PlacedSpace>),
    /// Two attributes become the axes, across and up; `None` takes the places.
    SetAxes(Option<[String; 2]>),
}

/// What was changed of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathChange {
    /// It was drawn anew.
    Draw,
    /// A point came at its end.
    AddPoint,
    /// A point was moved.
    MovePoint,
    /// A point was taken away.
    DeletePoint,
    /// Its length.
    Length,
    /// What is counted along it.
    Along,
    /// What happens at its end.
    AtEnd,
    /// It was taken away.
    Clear,
}

/// What tells edits of one sort from those of others.
pub type EditKind = (Discriminant<Edit>, Option<PathChange>);

impl Edit {
    /// Which sort of edit it is: those of one sort and one gesture are undone together.
    pub fn kind(&self) -> EditKind {
        let change = if let Self::ChangePath(change, _) = self { Some(*change) } else { None };
        (discriminant(self), change)
    }

    /// What the user does to `project` by it, as it follows the word undo.
    pub fn label(&self, project: &Project) -> Cow<'static, str> {
        let name = &project.texture().name;
        match self {
            Self::MovePoint(_) => strings::moved(name).into(),
            Self::SetMode(_) => strings::CHANGE_BLEND.into(),
            Self::Lock { name, is_locked, .. } => crate::strings::lock(name, *is_locked).into(),
            Self::SetOutside(Outside::Clamped) => strings::STAY_WITHIN.into(),
            Self::SetOutside(Outside::Extrapolated) => strings::GO_BEYOND.into(),
            Self::SetWeights(Weights::Barycentric) => strings::USE_TRIANGLES.into(),
            Self::SetWeights(Weights::Natural) => strings::USE_NATURAL.into(),
            Self::Rename(_) => strings::renamed(name).into(),
            Self::SetColor(_) => strings::colored(name).into(),
            Self::SetNotes(_) => strings::noted(name).into(),
            Self::SetTags(_) => strings::tagged(name).into(),
            Self::SetPicture(Some(_)) => strings::pictured(name).into(),
            Self::SetPicture(None) => strings::unpictured(name).into(),
            Self::Remake { .. } => crate::strings::prompt::remade(name).into(),
            Self::ChangePath(change, _) => change.label().into(),
            Self::Author(texture) => strings::authored(&texture.name).into(),
            Self::Remove(key) => strings::removed(name_of(project, *key)).into(),
            Self::Select(key) => strings::selected(name_of(project, *key)).into(),
            Self::KeepSnapshot => strings::kept_snapshot(name).into(),
            Self::RestoreSnapshot(_) => strings::restored_snapshot(name).into(),
            Self::RemoveSnapshot(_) => strings::REMOVE_SNAPSHOT.into(),
            Self::SetProjectNotes(_) => strings::CHANGE_NOTES.into(),
            Self::OpenLibrary(library) => strings::opened(&crate::libraries::name(library)).into(),
            Self::KeepLibraryInside(_) => strings::KEEP_INSIDE.into(),
            Self::AddTextures(_) => strings::ADD_TEXTURES.into(),
            Self::RemoveTexture(joined) => {
                let name = |entry: &Arc<TextureEntry>| {
                    strings::removed(project.renamed.get(&entry.id).unwrap_or(&entry.name))
                };
                project.joined.get(*joined).map_or_else(|| strings::removed(""), name).into()
            }
            Self::RenameTexture { name, .. } => strings::renamed_to(name).into(),
            Self::Star { name, is_starred, .. } => strings::starred(name, *is_starred).into(),
            Self::Solo(Some(_)) => strings::HEAR_ALONE.into(),
            Self::Solo(None) => strings::HEAR_BLEND.into(),
            Self::UseSpace(_) => strings::USE_SPACE.into(),
            Self::SetAxes(_) => strings::CHOOSE_AXES.into(),
        }
    }
}

impl PathChange {
    fn label(self) -> &'static str {
        match self {
            Self::Draw => strings::DRAW_PATH,
            Self::AddPoint => strings::ADD_PATH_POINT,
            Self::MovePoint => strings::MOVE_PATH_POINT,
            Self::DeletePoint => strings::DELETE_PATH_POINT,
            Self::Length => strings::CHANGE_PATH_LENGTH,
            Self::Along => strings::CHANGE_PATH_MEASURE,
            Self::AtEnd => strings::CHANGE_PATH_END,
            Self::Clear => strings::CLEAR_PATH,
        }
    }
}

fn name_of(project: &Project, key: u32) -> &str {
    project.authored.iter().find(|texture| texture.key == key).map_or("", |texture| &texture.name)
}

/// The project after an edit; one that has no meaning (a texture that is not there) leaves it as it is.
#[must_use]
pub fn edited(project: &Project, edit: Edit) -> Project {
    let mut project = project.clone();
    match edit {
        Edit::MovePoint(point) => {
            project.solo = None;
            change(&mut project, |texture| texture.at = point);
        }
        Edit::SetMode(mode) => change(&mut project, |texture| texture.blend.mode = mode),
        Edit::Lock { id, is_locked, .. } => change(&mut project, |texture| {
            if is_locked {
                texture.blend.locked.insert(id);
            } else {
                texture.blend.locked.remove(&id);
            }
        }),
        Edit::SetOutside(outside) => change(&mut project, |texture| texture.blend.outside = outside),
        Edit::SetWeights(weights) => change(&mut project, |texture| texture.blend.weights = weights),
        Edit::Rename(name) => change(&mut project, |texture| texture.name = name),
        Edit::SetColor(color) => change(&mut project, |texture| texture.color = color),
        Edit::SetNotes(notes) => change(&mut project, |texture| texture.notes = notes),
        Edit::SetTags(tags) => change(&mut project, |texture| texture.tags = tags),
        Edit::SetPicture(picture) => change(&mut project, |texture| texture.picture = picture),
        Edit::Remake { at, picture, notes } => {
            project.solo = None;
            change(&mut project, |texture| {
                (texture.at, texture.picture, texture.notes) = (at, Some(picture), notes);
            });
        }
        Edit::ChangePath(_, path) => change(&mut project, |texture| texture.path = path),
        Edit::Author(texture) => {
            let texture = AuthoredTexture { key: project.free_key(), ..texture };
            project.authored.insert(project.selected + 1, Arc::new(texture));
            (project.selected, project.solo) = (project.selected + 1, None);
        }
        Edit::Remove(key) => remove(&mut project, key),
        Edit::Select(key) => {
            if let Some(index) = project.authored.iter().position(|texture| texture.key == key) {
                (project.selected, project.solo) = (index, None);
            }
        }
        Edit::KeepSnapshot => project.snapshots.push(Arc::clone(&project.authored[project.selected])),
        Edit::RestoreSnapshot(index) => restore(&mut project, index),
        Edit::RemoveSnapshot(index) => {
            if index < project.snapshots.len() {
                project.snapshots.remove(index);
            }
        }
        Edit::SetProjectNotes(notes) => project.notes = notes,
        Edit::OpenLibrary(library) => open(&mut project, library),
        Edit::KeepLibraryInside(library) => project.library = library,
        Edit::AddTextures(entries) => project.joined.extend(entries),
        Edit::RemoveTexture(index) => {
            if index < project.joined.len() {
                project.joined.remove(index);
                project.solo = None;
            }
        }
        Edit::RenameTexture { id, name } => drop(project.renamed.insert(id, name)),
        Edit::Star { id, is_starred, .. } => {
            if is_starred {
                project.starred.insert(id);
            } else {
                project.starred.remove(&id);
            }
        }
        Edit::Solo(id) => project.solo = id,
        Edit::UseSpace(space) => (project.space, project.axes) = (Some(space), None),
        Edit::SetAxes(axes) => project.axes = axes,
    }
    project
}

/// Changes the authored texture that is selected.
fn change(project: &mut Project, change: impl FnOnce(&mut AuthoredTexture)) {
    change(Arc::make_mut(&mut project.authored[project.selected]));
}

fn remove(project: &mut Project, key: u32) {
    let Some(index) = project.authored.iter().position(|texture| texture.key == key) else { return };
    if project.authored.len() > 1 {
        project.authored.remove(index);
        if index < project.selected || project.selected == project.authored.len() {
            project.selected -= 1;
        }
        project.solo = None;
    }
}

fn restore(project: &mut Project, index: usize) {
    let Some(snapshot) = project.snapshots.get(index).cloned() else { return };
    project.solo = None;
    change(project, |texture| {
        texture.at = snapshot.at;
        texture.blend.clone_from(&snapshot.blend);
        texture.path.clone_from(&snapshot.path);
        texture.picture.clone_from(&snapshot.picture);
    });
}

/// Ends what belongs to the textures of the library that was open.
fn open(project: &mut Project, library: ProjectLibrary) {
    if library == project.library {
        return;
    }
    project.library = library;
    (project.space, project.axes, project.solo) = (None, None, None);
    project.renamed.clear();
    project.starred.clear();
    for texture in &mut project.authored {
        if !texture.blend.locked.is_empty() {
            Arc::make_mut(texture).blend.locked.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Edit, edited};
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

    fn project() -> Project {
        Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy")
    }

    fn lock(id: &str, is_locked: bool) -> Edit {
        Edit::Lock { id: id.to_owned(), name: "Oak".to_owned(), is_locked }
    }

    fn after(project: &Project, edits: impl IntoIterator<Item = Edit>) -> Project {
        edits.into_iter().fold(project.clone(), |project, edit| edited(&project, edit))
    }

    #[test]
    fn edits_are_named() {
        let at = SpacePoint { rough_smooth: 1.0, hard_soft: 2.0 };
        assert_eq!(Edit::MovePoint(at).label(&project()), "Move Oak copy");
        assert_eq!(lock("oak", true).label(&project()), "Lock Oak");
        assert_eq!(lock("oak", false).label(&project()), "Unlock Oak");
        assert_eq!(Edit::Remove(1).label(&project()), "Delete Oak copy");
    }

    #[test]
    fn a_lock_ends_with_its_library() {
        let project = project();
        let locked = after(&project, [lock("oak", true), lock("oak", true)]);
        assert_eq!(locked.texture().blend.locked.len(), 1);
        assert_eq!(after(&locked, [lock("oak", false)]), project);
        let opened = after(&locked, [Edit::OpenLibrary(ProjectLibrary::BuiltIn(BuiltIn::Simulated))]);
        assert!(opened.texture().blend.locked.is_empty());
        let same = after(&locked, [Edit::OpenLibrary(locked.library.clone())]);
        assert_eq!(same, locked, "opening what is open changes nothing");
    }

    #[test]
    fn authored_textures_come_and_go() {
        let one = project();
        let two = after(&one, [Edit::Author(AuthoredTexture::new(0, "Felt"))]);
        assert_eq!((two.authored.len(), two.texture().name.as_str(), two.texture().key), (2, "Felt", 2));
        let first = after(&two, [Edit::Select(1)]);
        assert_eq!(first.texture().name, "Oak copy");
        let left = after(&two, [Edit::Remove(2)]);
        assert_eq!(left, one);
        assert_eq!(after(&left, [Edit::Remove(1)]), left, "the last one stays");
        let gone = after(&first, [Edit::Remove(1)]);
        assert_eq!((gone.selected, gone.texture().key), (0, 2));
    }

    #[test]
    fn a_snapshot_brings_a_state_back_but_not_its_name() {
        let at = SpacePoint { rough_smooth: 1.0, hard_soft: 2.0 };
        let kept = after(&project(), [Edit::KeepSnapshot]);
        let moved =
            after(&kept, [Edit::MovePoint(at), Edit::Rename("New".to_owned()), Edit::RestoreSnapshot(0)]);
        assert_eq!((moved.texture().at, moved.texture().name.as_str()), (project().texture().at, "New"));
        assert_eq!(after(&kept, [Edit::RemoveSnapshot(0)]), project());
        assert_eq!(after(&kept, [Edit::RestoreSnapshot(9), Edit::RemoveSnapshot(9)]), kept);
    }
}
