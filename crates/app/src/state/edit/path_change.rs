//! Kinds of changes of a path.

use crate::strings::edits as strings;

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

impl PathChange {
    /// Name of the edit.
    pub(super) fn label(self) -> &'static str {
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
