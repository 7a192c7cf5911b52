//! Nodes that make a texture fade to silence below its lowest measured speeds and forces.
//!
//! The published boundary ([`crate::texture::boundary`]) is silent along both axes. If no node was measured near the
//! origin, the Delaunay triangulation joins silent nodes of the two axes. The texture is then exactly silent along such an
//! edge, and everywhere between it and the origin.
//!
//! A node on each of these edges removes the silence. It lies on the straight line from the origin to the nearest measured
//! node, at the share `s` of that way, and has its spectrum and `s` times its level (at most the whole). Towards the
//! lowest corner of a regular grid, at speed `v₀` and force `f₀`, the level is then that of the corner times
//! `min(v / v₀, f / f₀)`. Textures without such an edge, such as those measured near the origin, do not change.

use std::collections::BTreeSet;

use crate::maths::triangulation::{Triangulation, Xy};
use crate::texture::MIN_NODE_DISTANCE;
use crate::texture::plane::values::Values;

/// Returns the nodes that remove the silent edges of `points`, whose first `n_measured` are the measured nodes; the others
/// are the boundary, and whose triangles are given. Coordinates are relative to the highest speed and force.
///
/// A node that would lie closer than [`MIN_NODE_DISTANCE`] to an axis or to another node is omitted.
pub(super) fn fading(
    points: &[(Xy, Values)],
    n_measured: usize,
    triangulation: &Triangulation,
) -> Vec<(Xy, Values)> {
    let measured = &points[..n_measured.min(points.len())];
    let mut nodes: Vec<(Xy, Values)> = Vec::new();
    for (on_speed, on_force) in silent_edges(triangulation, points) {
        let ends = [points[on_speed].0[0], points[on_force].0[1]];
        let Some((to, values)) = nearest(measured, ends.map(|end| 0.5 * end)) else { continue };
        let share = 1.0 / (to[0] / ends[0] + to[1] / ends[1]);
        let at = to.map(|coordinate| share * coordinate);
        let level_mps2 = share.min(1.0) * values.level_mps2();
        let is_far = |other: &Xy| (0..2).any(|axis| (at[axis] - other[axis]).abs() >= MIN_NODE_DISTANCE);
        let is_apart = at.iter().all(|coordinate| *coordinate >= MIN_NODE_DISTANCE)
            && points.iter().chain(&nodes).all(|(other, _)| is_far(other));
        if level_mps2 > 0.0 && is_apart {
            nodes.push((at, Values::measured(values.lsf.clone(), level_mps2)));
        }
    }
    nodes
}

/// Edges from the axis of zero force to the axis of zero speed, in the order of their ends.
fn silent_edges(triangulation: &Triangulation, points: &[(Xy, Values)]) -> BTreeSet<(usize, usize)> {
    let is_on_speed = |index: usize| points[index].0[1] == 0.0 && points[index].0[0] > 0.0;
    let is_on_force = |index: usize| points[index].0[0] == 0.0 && points[index].0[1] > 0.0;
    let edges = triangulation.triangles().flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
    // Each edge inside is met in both directions.
    edges.flat_map(|(a, b)| [(a, b), (b, a)]).filter(|(a, b)| is_on_speed(*a) && is_on_force(*b)).collect()
}

/// Measured node nearest to a position.
fn nearest(measured: &[(Xy, Values)], to: Xy) -> Option<&(Xy, Values)> {
    let distance = |(at, _): &&(Xy, Values)| (at[0] - to[0]).hypot(at[1] - to[1]);
    measured.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
