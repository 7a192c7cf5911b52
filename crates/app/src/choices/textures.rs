//! Regions of the space that filter the list of textures.

/// Half of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Below the middle.
    Low,
    /// From the middle up.
    High,
}

/// Region of the space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Region {
    /// No filter: the whole space, and textures without a position.
    #[default]
    Anywhere,
    /// A quarter, given by a half of the x axis and a half of the y axis.
    Quarter([End; 2]),
    /// Vicinity of the authored point.
    NearPoint,
    /// Only textures without a position.
    NotPlaced,
}
