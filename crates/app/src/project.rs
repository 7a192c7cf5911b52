//! What the user makes: the part of the program's state that undo brings back.

use std::borrow::Cow;
use std::sync::Arc;

use shagreen_core::authoring::{Blending, Outside, Weights};
use shagreen_core::blend::Mode;
use shagreen_core::space::SpacePoint;
use shagreen_core::space_build::SpaceBuild;
use shagreen_formats::library::TextureEntry;

use crate::drawn_path::DrawnPath;
use crate::libraries::BuiltIn;
use crate::strings;

/// An authored texture in the making.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// Its name.
    pub name: String,
    /// Where it lies in the space.
    pub point: SpacePoint,
    /// How textures become one, with what other modes than the chosen one were asked to do: they are to be compared
    /// without losing that. What is heard is [`Project::heard_blending`].
    pub blending: Blending,
    /// The library that is open instead of the one that the window started with.
    pub library: Option<BuiltIn>,
    /// Textures that joined those of the library, in the order in which they came.
    pub added: Vec<Arc<TextureEntry>>,
    /// The texture that is heard alone instead of the blend, by its place in the list.
    pub solo: Option<usize>,
    /// The space that gives the textures their places and attributes; `None` leaves them as their files have them.
    pub space: Option<UsedSpace>,
    /// Names of the attributes across and up, where they are the axes; `None` takes the places.
    pub axes: Option<[String; 2]>,
    /// The way through the space that the texture can follow along a stroke, where one is drawn.
    pub path: Option<DrawnPath>,
}

/// A space that is in use. It never changes, so two are equal where they are the same one.
#[derive(Clone, Debug)]
pub struct UsedSpace(pub Arc<SpaceBuild>);

impl PartialEq for UsedSpace {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Default for Project {
    fn default() -> Self {
        Self {
            name: "New texture".to_owned(),
            point: SpacePoint { rough_smooth: 50.0, hard_soft: 50.0 },
            blending: Blending::default(),
            library: None,
            added: Vec::new(),
            solo: None,
            space: None,
            axes: None,
            path: None,
        }
    }
}

/// A change of the project: there is no other way to change it.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// The point moves to a place in the square, and the blend there is heard.
    MovePoint(SpacePoint),
    /// Textures become one in another way.
    SetMode(Mode),
    /// The field meets a texture exactly at its own place, or smooths it again.
    Lock {
        /// Its place in the list.
        texture: usize,
        /// Its name.
        name: String,
        /// Whether it is to be met.
        is_locked: bool,
    },
    /// The field ends at the outline of the textures, or goes on.
    SetOutside(Outside),
    /// Other neighbors have a say.
    SetWeights(Weights),
    /// The texture gets a name.
    Rename(String),
    /// Another library is open, or again the one that the window started with. The point stays where it is, between other
    /// neighbors; a space in use, axes, locks and what is heard alone belong to the textures that were there, and end.
    OpenLibrary(Option<BuiltIn>),
    /// Textures join the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// One texture of the list is heard alone, until the point moves.
    Solo(usize),
    /// A space that was built gives the textures their places and attributes.
    UseSpace(Arc<SpaceBuild>),
    /// Two attributes become the axes, across and up; `None` takes the places.
    SetAxes(Option<[String; 2]>),
    /// The path is drawn, changed or taken away.
    ChangePath(PathChange, Option<DrawnPath>),
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

impl PathChange {
    fn label(self) -> &'static str {
        match self {
            Self::Draw => "Draw path",
            Self::AddPoint => "Add path point",
            Self::MovePoint => "Move path point",
            Self::DeletePoint => "Delete path point",
            Self::Length => "Change path length",
            Self::Along => "Change path measure",
            Self::AtEnd => "Change path end",
            Self::Clear => "Clear path",
        }
    }
}

impl Edit {
    /// What the user did, as it follows the word undo.
    pub fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::MovePoint(_) => "Move point",
            Self::SetMode(_) => "Change blend",
            Self::Lock { name, is_locked, .. } => return Cow::Owned(strings::lock(name, *is_locked)),
            Self::SetOutside(Outside::Clamped) => "Stay within the textures",
            Self::SetOutside(Outside::Extrapolated) => "Go beyond the textures",
            Self::SetWeights(Weights::Barycentric) => "Use triangles",
            Self::SetWeights(Weights::Natural) => "Use natural neighbors",
            Self::Rename(_) => "Rename",
            Self::OpenLibrary(library) => library.map_or("Open first library", BuiltIn::edit_label),
            Self::AddTextures(_) => "Add textures",
            Self::Solo(_) => "Hear one texture",
            Self::UseSpace(_) => "Use space",
            Self::SetAxes(_) => "Choose axes",
            Self::ChangePath(change, _) => change.label(),
        })
    }
}

impl Project {
    /// The blending without what its mode cannot do: it always passes [`Blending::check`].
    pub fn heard_blending(&self) -> Blending {
        let mode = self.blending.mode;
        match mode {
            Mode::Field => Blending { weights: Weights::default(), ..self.blending.clone() },
            Mode::Parametric => Blending { weights: self.blending.weights, ..mode.into() },
            Mode::Shared | Mode::Power | Mode::Paper => mode.into(),
        }
    }

    /// Whether textures can be locked in the chosen mode.
    pub fn can_lock(&self) -> bool {
        self.blending.mode == Mode::Field
    }

    /// Whether the field meets a texture exactly at its own place.
    pub fn is_locked(&self, texture: usize) -> bool {
        self.can_lock() && self.blending.locked.contains(&texture)
    }

    /// The project after an edit.
    #[must_use]
    pub fn edited(&self, edit: Edit) -> Self {
        let mut project = self.clone();
        match edit {
            Edit::MovePoint(point) => (project.point, project.solo) = (point, None),
            Edit::SetMode(mode) => project.blending.mode = mode,
            Edit::Lock { texture, is_locked, .. } => {
                project.blending.locked.retain(|locked| *locked != texture);
                if is_locked {
                    project.blending.locked.push(texture);
                    project.blending.locked.sort_unstable();
                }
            }
            Edit::SetOutside(outside) => project.blending.outside = outside,
            Edit::SetWeights(weights) => project.blending.weights = weights,
            Edit::Rename(name) => project.name = name,
            Edit::OpenLibrary(library) => {
                project.library = library;
                (project.space, project.axes, project.solo) = (None, None, None);
                project.blending.locked.clear();
            }
            Edit::AddTextures(entries) => project.added.extend(entries),
            Edit::Solo(texture) => project.solo = Some(texture),
            Edit::UseSpace(build) => (project.space, project.axes) = (Some(UsedSpace(build)), None),
            Edit::SetAxes(axes) => project.axes = axes,
            Edit::ChangePath(_, path) => project.path = path,
        }
        project
    }
}

#[cfg(test)]
mod tests {
    use super::{Edit, Project};
    use shagreen_core::authoring::{Blending, Outside, Weights};
    use shagreen_core::blend::Mode;

    fn lock(texture: usize, is_locked: bool) -> Edit {
        Edit::Lock { texture, name: "Oak".to_owned(), is_locked }
    }

    /// What the field was asked to do is kept while other modes are tried, and never asked of them.
    #[test]
    fn what_is_heard_is_what_the_mode_can_do() {
        let asked = [lock(3, true), lock(1, true), Edit::SetOutside(Outside::Extrapolated)];
        let asked = asked.into_iter().chain([Edit::SetWeights(Weights::Natural)]);
        let project = asked.fold(Project::default(), |project, edit| project.edited(edit));
        assert!(project.blending.check().is_err(), "the control");
        for mode in Mode::ALL {
            let heard = project.edited(Edit::SetMode(mode)).heard_blending();
            assert_eq!((heard.check(), heard.mode), (Ok(()), mode));
            assert_eq!(heard.weights == Weights::Natural, mode == Mode::Parametric);
        }
        let back = project.edited(Edit::SetMode(Mode::Paper)).edited(Edit::SetMode(Mode::Field));
        let expected = Blending { locked: vec![1, 3], outside: Outside::Extrapolated, ..Mode::Field.into() };
        assert_eq!(back.heard_blending(), expected);
        assert!(back.is_locked(3) && !back.edited(Edit::SetMode(Mode::Shared)).is_locked(3));
    }

    #[test]
    fn a_lock_is_named_and_ends_with_its_library() {
        assert_eq!(lock(3, true).label(), "Lock Oak");
        assert_eq!(lock(3, false).label(), "Unlock Oak");
        let project = Project::default().edited(lock(3, true)).edited(lock(3, true));
        assert_eq!(project.blending.locked, [3]);
        assert_eq!(project.edited(lock(3, false)), Project::default());
        assert!(project.edited(Edit::OpenLibrary(None)).blending.locked.is_empty());
    }
}
