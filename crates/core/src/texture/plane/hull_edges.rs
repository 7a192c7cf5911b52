//! Nodes on the edges of the measured range, which keep the silent boundary out of it.
//!
//! The published boundary ([`crate::texture::boundary`]) is silent along both axes. Where the lowest measured nodes lie
//! farther from each other than from an axis, the Delaunay triangulation joins silent nodes to nodes behind them. The
//! level then falls between two measured nodes: by 8 dB between 120 and 180 mm/s at 0.15 N for a usual grid of nodes.
//!
//! So an edge of the measured range that is no edge of the triangulation is bisected if the level is too low on it, until
//! none is. The new nodes have the mean values of the two ends.

use std::collections::{BTreeMap, BTreeSet};

use crate::maths::triangulation::{Triangulation, Xy};
use crate::texture::MIN_NODE_DISTANCE;
use crate::texture::plane::values::Values;

/// Distance from an edge of the convex hull, relative to the highest speed and force, up to which a node lies on the edge
/// of the measured range. The edge then passes through the node.
const ON_EDGE: f64 = 0.05;
/// Length below which an edge is not bisected, relative to the highest speed and force.
const SHORTEST: f64 = 0.02;
/// Level relative to the linear interpolation along an edge, below which the edge is bisected: 0.45 dB.
const LOWEST_LEVEL: f64 = 0.95;
/// Positions along an edge at which levels are compared.
const COMPARED_AT: [f64; 3] = [0.25, 0.5, 0.75];

/// Edges of the measured range, and the parts into which they were bisected.
pub(super) struct HullEdges {
    edges: Vec<[usize; 2]>,
}

impl HullEdges {
    /// Edges of the range of the first `n_measured` points.
    pub(super) fn new(points: &[(Xy, Values)], n_measured: usize) -> Self {
        let places: Vec<Xy> = points.iter().take(n_measured).map(|(at, _)| *at).collect();
        // Relative coordinates are finite and at most 1, so that they can always be triangulated.
        let hull = Triangulation::in_order(&places).unwrap_or_default();
        let on_hull: BTreeSet<usize> = hull.outline().iter().flatten().copied().collect();
        let edges = hull.outline().iter().flat_map(|edge| through_near_nodes(*edge, &places, &on_hull));
        Self { edges: edges.collect() }
    }

    /// Bisects the edges that are missing from the triangles over `points` and on which the level is too low. Returns the
    /// new nodes, which follow `points`; empty if no such edge is long enough.
    ///
    /// A node that would lie closer than [`MIN_NODE_DISTANCE`] to an axis or to another node is omitted.
    pub(super) fn bisect(
        &mut self,
        points: &[(Xy, Values)],
        triangulation: &Triangulation,
    ) -> Vec<(Xy, Values)> {
        let present: BTreeSet<(usize, usize)> = triangulation
            .triangles()
            .flat_map(|[a, b, c]| [sorted(a, b), sorted(b, c), sorted(c, a)])
            .collect();
        let levels_mps2: Vec<f64> = points.iter().map(|(_, values)| values.level_mps2()).collect();
        let mut nodes: Vec<(Xy, Values)> = Vec::new();
        let mut parts = Vec::new();
        for [a, b] in std::mem::take(&mut self.edges) {
            let is_missing = !present.contains(&sorted(a, b));
            let ends = [points[a].0, points[b].0];
            let at = between(ends, 0.5);
            let is_far = |other: &Xy| (0..2).any(|axis| (at[axis] - other[axis]).abs() >= MIN_NODE_DISTANCE);
            let is_apart = || {
                at.iter().all(|coordinate| *coordinate >= MIN_NODE_DISTANCE)
                    && points.iter().chain(&nodes).all(|(other, _)| is_far(other))
            };
            let is_low = || is_too_low(ends, [levels_mps2[a], levels_mps2[b]], triangulation, &levels_mps2);
            if is_missing && length(ends) >= SHORTEST && is_low() && is_apart() {
                let middle = points.len() + nodes.len();
                nodes.push((at, Values::mean(&[(&points[a].1, 0.5), (&points[b].1, 0.5)])));
                parts.extend([[a, middle], [middle, b]]);
            } else {
                parts.push([a, b]);
            }
        }
        self.edges = parts;
        nodes
    }
}

/// Edge of the convex hull, led through the nodes inside the hull that lie within [`ON_EDGE`] of it.
fn through_near_nodes([a, b]: [usize; 2], places: &[Xy], on_hull: &BTreeSet<usize>) -> Vec<[usize; 2]> {
    let ends = [places[a], places[b]];
    let along = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
    let length = length(ends);
    // By position along the edge; of nodes at the same position, one is enough.
    let mut near: BTreeMap<u64, usize> = BTreeMap::new();
    for (index, at) in places.iter().enumerate().filter(|(index, _)| !on_hull.contains(index)) {
        let off = [at[0] - ends[0][0], at[1] - ends[0][1]];
        let share = (off[0] * along[0] + off[1] * along[1]) / (length * length);
        let distance = (along[0] * off[1] - along[1] * off[0]).abs() / length;
        if share > 0.0 && share < 1.0 && distance <= ON_EDGE {
            // Positive numbers have the order of their bits.
            near.insert(share.to_bits(), index);
        }
    }
    let chain: Vec<usize> = [a].into_iter().chain(near.into_values()).chain([b]).collect();
    chain.windows(2).map(|ends| [ends[0], ends[1]]).collect()
}

/// Returns whether the level in the triangles is below [`LOWEST_LEVEL`] of the linear interpolation between two ends.
fn is_too_low(
    ends: [Xy; 2],
    end_levels_mps2: [f64; 2],
    triangulation: &Triangulation,
    levels_mps2: &[f64],
) -> bool {
    COMPARED_AT.into_iter().any(|share| {
        let linear = (1.0 - share) * end_levels_mps2[0] + share * end_levels_mps2[1];
        triangulation.locate(between(ends, share)).is_some_and(|(triangle, weights)| {
            let corners = triangulation.corners(triangle);
            let level: f64 =
                corners.iter().zip(weights).map(|(corner, weight)| weight * levels_mps2[*corner]).sum();
            level < LOWEST_LEVEL * linear
        })
    })
}

/// Point at a share of the way from the first end to the second.
fn between([from, to]: [Xy; 2], share: f64) -> Xy {
    [0, 1].map(|axis| (1.0 - share) * from[axis] + share * to[axis])
}

fn length([from, to]: [Xy; 2]) -> f64 {
    (to[0] - from[0]).hypot(to[1] - from[1])
}

/// Key of an edge: both ends, the smaller index first.
fn sorted(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}
