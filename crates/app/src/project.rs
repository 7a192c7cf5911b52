//! What the user makes: the part of the program's state that undo brings back.

use std::sync::Arc;

use shagreen_core::blend::Mode;
use shagreen_core::space::SpacePoint;
use shagreen_core::space_build::SpaceBuild;
use shagreen_formats::library::TextureEntry;

use crate::libraries::BuiltIn;

/// An authored texture in the making.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// Its name.
    pub name: String,
    /// Where it lies in the space.
    pub point: SpacePoint,
    /// How its parents are mixed.
    pub mode: Mode,
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
            mode: Mode::default(),
            library: None,
            added: Vec::new(),
            solo: None,
            space: None,
            axes: None,
        }
    }
}

/// A change of the project: there is no other way to change it.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// The point moves to a place in the square, and the blend there is heard.
    MovePoint(SpacePoint),
    /// The parents are mixed in another way.
    SetMode(Mode),
    /// The texture gets a name.
    Rename(String),
    /// Another library is open, or again the one that the window started with. The point stays where it is, between other
    /// neighbors; a space in use, axes and what is heard alone belong to the textures that were there, and end.
    OpenLibrary(Option<BuiltIn>),
    /// Textures join the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// One texture of the list is heard alone, until the point moves.
    Solo(usize),
    /// A space that was built gives the textures their places and attributes.
    UseSpace(Arc<SpaceBuild>),
    /// Two attributes become the axes, across and up; `None` takes the places.
    SetAxes(Option<[String; 2]>),
}

impl Edit {
    /// What the user did, as it follows the word undo.
    pub fn label(&self) -> &'static str {
        match self {
            Self::MovePoint(_) => "Move point",
            Self::SetMode(_) => "Change blend",
            Self::Rename(_) => "Rename",
            Self::OpenLibrary(library) => library.map_or("Open first library", BuiltIn::edit_label),
            Self::AddTextures(_) => "Add textures",
            Self::Solo(_) => "Hear one texture",
            Self::UseSpace(_) => "Use space",
            Self::SetAxes(_) => "Choose axes",
        }
    }
}

impl Project {
    /// The project after an edit.
    #[must_use]
    pub fn edited(&self, edit: Edit) -> Self {
        let mut project = self.clone();
        match edit {
            Edit::MovePoint(point) => (project.point, project.solo) = (point, None),
            Edit::SetMode(mode) => project.mode = mode,
            Edit::Rename(name) => project.name = name,
            Edit::OpenLibrary(library) => {
                project.library = library;
                (project.space, project.axes, project.solo) = (None, None, None);
            }
            Edit::AddTextures(entries) => project.added.extend(entries),
            Edit::Solo(texture) => project.solo = Some(texture),
            Edit::UseSpace(build) => (project.space, project.axes) = (Some(UsedSpace(build)), None),
            Edit::SetAxes(axes) => project.axes = axes,
        }
        project
    }
}
