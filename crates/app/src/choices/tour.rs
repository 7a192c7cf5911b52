//! Steps of the tour.

/// Step of the tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Point and space.
    Drag,
    /// Pad.
    Stroke,
    /// Column with sliders and contributing textures.
    Blend,
    /// File menu.
    Keep,
}
