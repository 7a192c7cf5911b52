//! What the user makes: the part of the program's state that undo brings back.

use std::sync::Arc;

use shagreen_core::blend::Mode;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::TextureEntry;

/// An authored texture in the making.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// Its name.
    pub name: String,
    /// Where it lies in the space.
    pub point: SpacePoint,
    /// How its parents are mixed.
    pub mode: Mode,
    /// Textures that joined those of the library, in the order in which they came.
    pub added: Vec<Arc<TextureEntry>>,
    /// The texture that is heard alone instead of the blend, by its place in the list.
    pub solo: Option<usize>,
}

impl Default for Project {
    fn default() -> Self {
        Self {
            name: "New texture".to_owned(),
            point: SpacePoint { rough_smooth: 50.0, hard_soft: 50.0 },
            mode: Mode::default(),
            added: Vec::new(),
            solo: None,
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
    /// Textures join the list.
    AddTextures(Vec<Arc<TextureEntry>>),
    /// One texture of the list is heard alone, until the point moves.
    Solo(usize),
}

impl Edit {
    /// What the user did, as it follows the word undo.
    pub fn label(&self) -> &'static str {
        match self {
            Self::MovePoint(_) => "Move point",
            Self::SetMode(_) => "Change blend",
            Self::Rename(_) => "Rename",
            Self::AddTextures(_) => "Add textures",
            Self::Solo(_) => "Hear one texture",
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
            Edit::AddTextures(entries) => project.added.extend(entries),
            Edit::Solo(texture) => project.solo = Some(texture),
        }
        project
    }
}
