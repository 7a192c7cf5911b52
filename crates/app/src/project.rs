//! What the user makes: the part of the program's state that undo brings back.

use shagreen_core::blend::Mode;
use shagreen_core::space::SpacePoint;

/// An authored texture in the making.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// Its name.
    pub name: String,
    /// Where it lies in the space.
    pub point: SpacePoint,
    /// How its parents are mixed.
    pub mode: Mode,
}

impl Default for Project {
    fn default() -> Self {
        Self {
            name: "New texture".to_owned(),
            point: SpacePoint { rough_smooth: 50.0, hard_soft: 50.0 },
            mode: Mode::default(),
        }
    }
}

/// A change of the project: there is no other way to change it.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// The point moves to a place in the square.
    MovePoint(SpacePoint),
    /// The parents are mixed in another way.
    SetMode(Mode),
    /// The texture gets a name.
    Rename(String),
}

impl Edit {
    /// What the user did, as it follows the word undo.
    pub fn label(&self) -> &'static str {
        match self {
            Self::MovePoint(_) => "Move point",
            Self::SetMode(_) => "Change blend",
            Self::Rename(_) => "Rename",
        }
    }
}

impl Project {
    /// The project after an edit.
    #[must_use]
    pub fn edited(&self, edit: Edit) -> Self {
        let mut project = self.clone();
        match edit {
            Edit::MovePoint(point) => project.point = point,
            Edit::SetMode(mode) => project.mode = mode,
            Edit::Rename(name) => project.name = name,
        }
        project
    }
}
