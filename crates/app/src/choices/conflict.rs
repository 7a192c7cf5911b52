//! Differences between an open project and its changed file.

/// Part of a project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// Authored texture with this name.
    Texture(String),
    /// Library, added textures and their names.
    Library,
    /// Space and axes.
    Space,
    /// Project notes.
    Notes,
    /// Snapshots.
    Snapshots,
    /// Stars, the order of the list, and fields of other versions.
    Other,
}

/// How a part was changed since the project was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Only in this window.
    Here,
    /// Only in the file.
    There,
    /// In both, differently.
    Both,
    /// Added in this window.
    AddedHere,
    /// Added in the file.
    AddedThere,
    /// Deleted in this window.
    RemovedHere,
    /// Deleted in the file.
    RemovedThere,
}
