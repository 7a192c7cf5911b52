//! Points of an authored texture on their way to a space with other axes.

use shagreen_core::space::{LocalMeans, SpacePoint};
use shagreen_formats::project::AuthoredTexture;

/// Moves the points of a texture to other axes. `from` has, for each of these, the index of the same axis before; points keep
/// their coordinates there. On the others, they have the local mean of the textures, which have these `positions` by index.
pub(crate) fn move_to_axes(
    texture: &mut AuthoredTexture,
    from: &[Option<usize>],
    positions: &[Option<SpacePoint>],
) {
    // Fitted once for all points of a path.
    let means = LocalMeans::new(positions, &from.iter().map(Option::is_some).collect::<Vec<bool>>());
    texture.move_points(|at| {
        let known: Vec<Option<f64>> = from.iter().map(|axis| at.get((*axis)?)).collect();
        SpacePoint::of(&means.completed(&known)).unwrap_or_else(|_| at.on(from.len()))
    });
}
