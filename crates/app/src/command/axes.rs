//! Commands about the axes of the space.

/// Command about axes.
#[derive(Clone, Debug)]
pub enum AxesCommand {
    /// Opens the sheet that chooses the axes.
    Open,
    /// Chooses the axes with these names, one to six different ones, in this order.
    Use(Vec<String>),
    /// Swaps the two axes of the canvas.
    Swap,
    /// Moves the point to the local mean of the textures on the axis with this index.
    Reset(usize),
}
