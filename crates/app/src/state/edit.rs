//! Edits of a project, and their names. The project changes in no other way, so that undo restores it exactly.

mod changes;
mod path_change;

use std::borrow::Cow;
use std::collections::BTreeSet;
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

pub use self::path_change::PathChange;

use self::changes::{
    add_relief, add_textures, author, author_with, change, change_points, join_simulated, open,
    place_texture, remove, remove_texture, restore, set_axes, set_own, use_space,
};
use crate::state::axes_change::AxesChange;
use crate::strings::edits as strings;
use shagreen_studio::height_map::ReliefPlace;

/// Edit of a project. Unless stated otherwise, it applies to the selected authored texture. After an edit that moves points of a
/// texture, all of its points have one coordinate for each axis of the space.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Moves the point to a position in the space and ends solo.
    MovePoint(SpacePoint),
    /// Makes the texture exactly one of the library: moves it there, in the mode Field, with this one as its only pin, with a
    /// neutral shape, and without a path and a picture of its own. Ends solo.
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
    /// Moves the texture to the lexicon entry of a material that its picture shows, or back to the estimate from the picture.
    /// Ends solo.
    TakeMaterial {
        /// Name of the material; `None` for the estimate from the picture.
        material: Option<String>,
        /// Position in the space.
        at: SpacePoint,
        /// The same picture in memory of its own, which identifies the estimate.
        picture: Arc<Picture>,
        /// Notes.
        notes: String,
    },
    /// Adds an authored texture and selects it.
    Author(Box<AuthoredTexture>),
    /// Adds an authored texture with the textures that only it uses, and selects it. Its pins of these follow if the list gives
    /// them other identifiers.
    AuthorWith {
        /// The texture.
        texture: Box<AuthoredTexture>,
        /// Textures to add.
        own: Vec<Arc<TextureEntry>>,
    },
    /// Deletes the authored texture with this key, unless it is the last one.
    Remove(u32),
    /// Selects the authored texture with this key.
    Select(u32),
    /// Keeps a snapshot of the texture.
    KeepSnapshot,
    /// Selects the texture of the snapshot with this index and restores its state, except name, color, notes and tags. A
    /// texture that was deleted comes back with all of these. The points of a snapshot that was taken on other axes keep their
    /// coordinates on axes of the same name, and have the local mean of the textures on the others. Ends solo.
    RestoreSnapshot(usize),
    /// Deletes the snapshot with this index.
    RemoveSnapshot(usize),
    /// Sets the notes of the project.
    SetProjectNotes(String),
    /// Opens another library. The points keep their coordinates on axes of the same name ([`Project::follow_axes`]), and their
    /// pins of textures that belong to them. Chosen axes stay if the textures of the library can be placed on them. The space
    /// in use, other axes, other pins, names and stars of textures, and solo belong to the previous library and are reset.
    OpenLibrary(ProjectLibrary),
    /// Embeds the library in the project.
    KeepLibraryInside(ProjectLibrary),
    /// Adds textures to the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// Adds the texture that was simulated for the authored texture with this key ([`shagreen_studio::felt::join_felt`]).
    JoinSimulated {
        /// Key of the authored texture.
        key: u32,
        /// Simulated texture.
        entry: Arc<TextureEntry>,
        /// Texture that was simulated for it before, to be replaced.
        earlier: Option<Arc<TextureEntry>>,
    },
    /// Adds a texture with a relief from a picture ([`shagreen_studio::height_map::join_relief`]).
    AddRelief {
        /// Texture with the relief.
        entry: Arc<TextureEntry>,
        /// Where it belongs.
        place: ReliefPlace,
    },
    /// Replaces an added texture by the same one with a position.
    PlaceTexture {
        /// Index among the added textures.
        joined: usize,
        /// Name of the texture.
        name: String,
        /// The texture with its position.
        entry: Arc<TextureEntry>,
    },
    /// Deletes an added texture, by its index among them.
    RemoveTexture(usize),
    /// Lets an added texture take part only in the authored textures that pin it, or in all.
    SetOwn {
        /// Index among the added textures.
        joined: usize,
        /// Name of the texture.
        name: String,
        /// Whether it takes part only where it is pinned.
        is_own: bool,
    },
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
    /// Takes positions and attributes of the textures from a built space. Chosen axes stay if the textures can be placed on them;
    /// otherwise, they are reset. The points keep their coordinates on axes of the same name ([`Project::follow_axes`]).
    UseSpace(Arc<PlacedSpace>),
    /// Sets the axes of the space, and moves all authored textures and paths to them. Snapshots stay on theirs.
    SetAxes(Box<AxesChange>),
    /// Sets the keys of the authored textures on the sides A and B of a comparison.
    SetCompared([u32; 2]),
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
            Self::TakeTexture { name: of, .. } => strings::taken(name, of).into(),
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
            Self::TakeMaterial { material, .. } => {
                crate::strings::prompt::took(name, material.as_deref()).into()
            }
            Self::ChangePath(change, _) => change.label().into(),
            Self::Author(texture) | Self::AuthorWith { texture, .. } => {
                strings::authored(&texture.name).into()
            }
            Self::Remove(key) => strings::removed(name_of(project, *key)).into(),
            Self::Select(key) => strings::selected(name_of(project, *key)).into(),
            Self::KeepSnapshot => strings::kept_snapshot(name).into(),
            Self::RestoreSnapshot(index) => {
                strings::restored_snapshot(name_of_snapshot(project, *index)).into()
            }
            Self::RemoveSnapshot(_) => strings::REMOVE_SNAPSHOT.into(),
            Self::SetProjectNotes(_) => strings::CHANGE_NOTES.into(),
            Self::OpenLibrary(library) => {
                strings::opened(&shagreen_studio::library_names::name(library)).into()
            }
            Self::KeepLibraryInside(_) => strings::KEEP_INSIDE.into(),
            Self::AddTextures(_) => strings::ADD_TEXTURES.into(),
            Self::JoinSimulated { entry, .. } => crate::strings::prompt::simulated(&entry.name).into(),
            Self::AddRelief { entry, place: ReliefPlace::InPlaceOf(_) } => {
                strings::relief_of(project.renamed.get(&entry.id).unwrap_or(&entry.name)).into()
            }
            Self::AddRelief { entry, .. } => strings::authored(&entry.name).into(),
            Self::PlaceTexture { name, .. } => strings::placed(name).into(),
            Self::RemoveTexture(joined) => {
                let name = |entry: &Arc<TextureEntry>| {
                    strings::removed_texture(project.renamed.get(&entry.id).unwrap_or(&entry.name))
                };
                project.joined.get(*joined).map_or_else(|| strings::removed_texture(""), name).into()
            }
            Self::SetOwn { name, is_own, .. } => strings::used_where(name, *is_own).into(),
            Self::RenameTexture { name, .. } => strings::renamed_to(name).into(),
            Self::Star { name, is_starred, .. } => strings::starred(name, *is_starred).into(),
            Self::Solo(Some(_)) => strings::HEAR_ALONE.into(),
            Self::Solo(None) => strings::HEAR_BLEND.into(),
            Self::UseSpace(_) => strings::USE_SPACE.into(),
            Self::SetAxes(_) => strings::CHOOSE_AXES.into(),
            Self::SetCompared(_) => strings::CHOOSE_COMPARED.into(),
        }
    }

    /// Whether a drag makes this edit, so that Escape during the drag reverts it.
    pub(crate) fn is_dragged(&self) -> bool {
        matches!(self, Self::MovePoint(_) | Self::SetShape(..) | Self::ChangePath(PathChange::MovePoint, _))
    }
}

fn name_of(project: &Project, key: u32) -> &str {
    project.authored.iter().find(|texture| texture.key == key).map_or("", |texture| &texture.name)
}

/// Present name of the texture of a snapshot, or its name in the snapshot if it was deleted. Empty if there is no such
/// snapshot.
pub(crate) fn name_of_snapshot(project: &Project, index: usize) -> &str {
    let Some(snapshot) = project.snapshots.get(index) else { return "" };
    let own = project.authored.iter().find(|texture| texture.key == snapshot.key);
    &own.unwrap_or(snapshot).name
}

/// Returns the project after an edit. An edit of a texture that does not exist has no effect.
#[must_use]
pub fn edited(project: &Project, edit: Edit) -> Project {
    let mut project = project.clone();
    match edit {
        Edit::MovePoint(point) => {
            project.solo = None;
            change_points(&mut project, |texture| texture.at = point);
        }
        Edit::TakeTexture { id, at, .. } => {
            project.solo = None;
            change(&mut project, |texture| {
                (texture.at, texture.shape) = (at, Shape::default());
                (texture.path, texture.picture) = (None, None);
                texture.blend.mode = Mode::Field;
                // Of two pins at one position, the other one may win.
                texture.blend.locked = BTreeSet::from([id]);
            });
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
        Edit::Remake { at, picture, notes } | Edit::TakeMaterial { at, picture, notes, .. } => {
            project.solo = None;
            change_points(&mut project, |texture| {
                (texture.at, texture.picture, texture.notes) = (at, Some(picture), notes);
            });
        }
        Edit::ChangePath(_, path) => change_points(&mut project, |texture| texture.path = path),
        Edit::Author(texture) => author(&mut project, *texture),
        Edit::AuthorWith { texture, own } => author_with(&mut project, *texture, own),
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
        Edit::AddTextures(entries) => add_textures(&mut project, entries),
        Edit::JoinSimulated { key, entry, earlier } => {
            join_simulated(&mut project, key, entry, earlier.as_ref());
        }
        Edit::AddRelief { entry, place } => add_relief(&mut project, entry, place),
        Edit::PlaceTexture { joined, entry, .. } => place_texture(&mut project, joined, entry),
        Edit::RemoveTexture(index) => remove_texture(&mut project, index),
        Edit::SetOwn { joined, is_own, .. } => set_own(&mut project, joined, is_own),
        Edit::RenameTexture { id, name } => drop(project.renamed.insert(id, begin_of(name, MAX_NAME))),
        Edit::Star { id, is_starred, .. } => {
            if is_starred {
                project.starred.insert(id);
            } else {
                project.starred.remove(&id);
            }
        }
        Edit::Solo(id) => project.solo = id,
        Edit::UseSpace(space) => use_space(&mut project, space),
        Edit::SetAxes(change) => set_axes(&mut project, *change),
        Edit::SetCompared(keys) => project.compared = Some(keys),
    }
    project
}

#[cfg(test)]
mod tests;
