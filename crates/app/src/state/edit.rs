//! Edits of a project, and their names. The project changes in no other way, so that undo restores it exactly.

use std::borrow::Cow;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::{Shape, ShapeControl};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::Picture;
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_formats::text_limits::{MAX_NAME, MAX_NOTES, begin_of};

use crate::strings::edits as strings;
use shagreen_studio::felt::join_felt;

/// Edit of a project. Unless stated otherwise, it applies to the selected authored texture.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Moves the point to a position in the space and ends solo.
    MovePoint(SpacePoint),
    /// Moves the point onto a texture of the library and solos the texture until the point moves again.
    TakeTexture {
        /// Id of the texture.
        id: String,
        /// Name of the texture.
        name: String,
        /// Its position.
        at: SpacePoint,
    },
    /// Sets the interpolation mode.
    SetMode(Mode),
    /// Pins or unpins a texture. The field passes through pinned textures.
    Lock {
        /// Id of the texture.
        id: String,
        /// Name of the texture.
        name: String,
        /// Whether the texture is pinned.
        is_locked: bool,
    },
    /// Sets the behavior outside the convex hull.
    SetOutside(Outside),
    /// Sets the weighting of the textures.
    SetWeights(Weights),
    /// Sets a control of the shape and ends solo.
    SetShape(ShapeControl, f64),
    /// Makes the shape neutral and ends solo.
    ResetShape,
    /// Renames the texture.
    Rename(String),
    /// Sets the color, as an index of the palette.
    SetColor(u8),
    /// Sets the notes.
    SetNotes(String),
    /// Sets the tags.
    SetTags(Vec<String>),
    /// Sets the picture; `None` shows the blended picture of the contributing textures.
    SetPicture(Option<Arc<Picture>>),
    /// Draws, changes or deletes the path.
    ChangePath(PathChange, Option<UserPath>),
    /// Replaces position, picture and notes by those generated from a prompt.
    Remake {
        /// Position in the space.
        at: SpacePoint,
        /// Generated picture.
        picture: Arc<Picture>,
        /// Generated notes.
        notes: String,
    },
    /// Adds an authored texture and selects it.
    Author(AuthoredTexture),
    /// Deletes the authored texture with this key, unless it is the last one.
    Remove(u32),
    /// Selects the authored texture with this key.
    Select(u32),
    /// Keeps a snapshot of the texture.
    KeepSnapshot,
    /// Restores the snapshot with this index, except name, color, notes and tags.
    RestoreSnapshot(usize),
    /// Deletes the snapshot with this index.
    RemoveSnapshot(usize),
    /// Sets the notes of the project.
    SetProjectNotes(String),
    /// Opens another library. The points keep their positions. The space in use, axes, pins, names and stars of
    /// textures, and solo belong to the previous library and are reset.
    OpenLibrary(ProjectLibrary),
    /// Embeds the library in the project.
    KeepLibraryInside(ProjectLibrary),
    /// Adds textures to the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// Adds the texture that was simulated for the authored texture with this key ([`join_felt`]).
    JoinSimulated {
        /// Key of the authored texture.
        key: u32,
        /// Simulated texture.
        entry: Arc<TextureEntry>,
        /// Texture that was simulated for it before, to be replaced.
        earlier: Option<Arc<TextureEntry>>,
    },
    /// Deletes an added texture, by its index among them.
    RemoveTexture(usize),
    /// Renames a texture of the list.
    RenameTexture {
        /// Id of the texture.
        id: String,
        /// New name.
        name: String,
    },
    /// Stars or unstars a texture of the list.
    Star {
        /// Id of the texture.
        id: String,
        /// Name of the texture.
        name: String,
        /// Whether the texture is starred.
        is_starred: bool,
    },
    /// Solos the texture with this id until the point moves, or ends solo.
    Solo(Option<String>),
    /// Takes positions and attributes of the textures from a built space, and resets the axes.
    UseSpace(Arc<PlacedSpace>),
    /// Sets the attributes of the x axis and the y axis; `None` uses the positions.
    SetAxes(Option<[String; 2]>),
}

/// Kind of change of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathChange {
    /// New path.
    Draw,
    /// Point added at the end.
    AddPoint,
    /// Point moved.
    MovePoint,
    /// Point deleted.
    DeletePoint,
    /// Length changed.
    Length,
    /// Distance or time selected as the measure of the path.
    Along,
    /// Behavior at the end changed.
    AtEnd,
    /// Path deleted.
    Clear,
}

/// Kind of an edit.
pub type EditKind = (Discriminant<Edit>, Option<PathChange>, Option<ShapeControl>);

impl Edit {
    /// Kind of the edit. Consecutive edits of one kind and one gesture are undone together.
    pub fn kind(&self) -> EditKind {
        let change = if let Self::ChangePath(change, _) = self { Some(*change) } else { None };
        let control = if let Self::SetShape(control, _) = self { Some(*control) } else { None };
        (discriminant(self), change, control)
    }

    /// Name of the edit on `project`, as it follows the words "Undo" and "Redo".
    pub fn label(&self, project: &Project) -> Cow<'static, str> {
        let name = &project.texture().name;
        match self {
            Self::MovePoint(_) => strings::moved(name).into(),
            Self::TakeTexture { name, .. } => strings::taken(name).into(),
            Self::SetMode(_) => strings::CHANGE_BLEND.into(),
            Self::Lock { name, is_locked, .. } => crate::strings::lock(name, *is_locked).into(),
            Self::SetOutside(Outside::Clamped) => strings::STAY_WITHIN.into(),
            Self::SetOutside(Outside::Extrapolated) => strings::GO_BEYOND.into(),
            Self::SetWeights(Weights::Barycentric) => strings::USE_TRIANGLES.into(),
            Self::SetWeights(Weights::Natural) => strings::USE_NATURAL.into(),
            Self::SetShape(control, _) => strings::shaped(name, *control).into(),
            Self::ResetShape => strings::unshaped(name).into(),
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
            Self::OpenLibrary(library) => {
                strings::opened(&shagreen_studio::library_names::name(library)).into()
            }
            Self::KeepLibraryInside(_) => strings::KEEP_INSIDE.into(),
            Self::AddTextures(_) => strings::ADD_TEXTURES.into(),
            Self::JoinSimulated { entry, .. } => crate::strings::prompt::simulated(&entry.name).into(),
            Self::RemoveTexture(joined) => {
                let name = |entry: &Arc<TextureEntry>| {
                    strings::removed_texture(project.renamed.get(&entry.id).unwrap_or(&entry.name))
                };
                project.joined.get(*joined).map_or_else(|| strings::removed_texture(""), name).into()
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

/// Returns the project after an edit. An edit of a texture that does not exist has no effect.
#[must_use]
pub fn edited(project: &Project, edit: Edit) -> Project {
    let mut project = project.clone();
    match edit {
        Edit::MovePoint(point) => {
            project.solo = None;
            change(&mut project, |texture| texture.at = point);
        }
        Edit::TakeTexture { id, at, .. } => {
            project.solo = Some(id);
            change(&mut project, |texture| texture.at = at);
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
        Edit::SetShape(control, value) => {
            project.solo = None;
            change(&mut project, |texture| texture.shape = texture.shape.with(control, value));
        }
        Edit::ResetShape => {
            project.solo = None;
            change(&mut project, |texture| texture.shape = Shape::default());
        }
        Edit::Rename(name) => change(&mut project, |texture| texture.name = begin_of(name, MAX_NAME)),
        Edit::SetColor(color) => change(&mut project, |texture| texture.color = color),
        Edit::SetNotes(notes) => change(&mut project, |texture| texture.notes = begin_of(notes, MAX_NOTES)),
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
        Edit::SetProjectNotes(notes) => project.notes = begin_of(notes, MAX_NOTES),
        Edit::OpenLibrary(library) => open(&mut project, library),
        Edit::KeepLibraryInside(library) => project.library = library,
        Edit::AddTextures(entries) => project.joined.extend(entries),
        Edit::JoinSimulated { key, entry, earlier } => join_felt(&mut project, key, entry, earlier.as_ref()),
        Edit::RemoveTexture(index) => {
            if index < project.joined.len() {
                project.joined.remove(index);
                project.solo = None;
            }
        }
        Edit::RenameTexture { id, name } => drop(project.renamed.insert(id, begin_of(name, MAX_NAME))),
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

/// Changes the selected authored texture.
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
        texture.shape = snapshot.shape;
        texture.path.clone_from(&snapshot.path);
        texture.picture.clone_from(&snapshot.picture);
    });
}

/// Opens a library and resets what belongs to the textures of the previous one.
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
    use shagreen_core::texture::shape::{Shape, ShapeControl};
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
        assert_eq!(lock("oak", true).label(&project()), "Pin Oak");
        assert_eq!(lock("oak", false).label(&project()), "Unpin Oak");
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
    fn a_shape_is_limited_to_its_ranges_and_reset_at_once() {
        let project = after(&project(), [Edit::Solo(Some("oak".to_owned()))]);
        let edits = [Edit::SetShape(ShapeControl::Grain, 2.0), Edit::SetShape(ShapeControl::Level, 99.0)];
        let shaped = after(&project, edits);
        let expected = Shape { grain: 2.0, level_db: 12.0, ..Shape::default() };
        assert_eq!((shaped.texture().shape, &shaped.solo), (expected, &None));
        assert_eq!(Edit::SetShape(ShapeControl::Grain, 2.0).label(&project), "Change grain size of Oak copy");
        assert_eq!(Edit::ResetShape.label(&project), "Reset shape of Oak copy");
        let kinds = [ShapeControl::Grain, ShapeControl::Level].map(|of| Edit::SetShape(of, 1.0).kind());
        assert_ne!(kinds[0], kinds[1], "two controls are two steps");
        let kept = after(&shaped, [Edit::KeepSnapshot, Edit::ResetShape]);
        assert!(kept.texture().shape.is_neutral());
        assert_eq!(after(&kept, [Edit::RestoreSnapshot(0)]).texture().shape, expected);
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
