//! Triangles small enough for the level: where the quadratic of the callback misses the gain of the predictor, edges
//! are halved.
//!
//! A new vertex has the mean of its edge's two, so the grain at any contact stays the same; only the quadratic through
//! corners and middles comes nearer to the gain. Halving an edge splits the triangles on both its sides: no corner ever
//! lies on another triangle's edge. Placing a vertex on a Delaunay triangulation like that leaves one that is the lower
//! hull of a lifted surface, so that walks from triangle to triangle still end (H. Edelsbrunner, "An acyclicity theorem
//! for cell complexes in d dimension", 1990).

use std::collections::{BTreeMap, VecDeque};

use crate::ar::power_gain;
use crate::lsf::ar_from_lsf;
use crate::triangulation::{Triangulation, Xy};

/// Error of ln gain at which an edge is halved: 0.04 dB of level, less than half of what is promised, since only a few points of
/// a triangle are looked at.
const TOLERANCE: f64 = 0.04 / (10.0 * std::f64::consts::LOG10_E);
/// Triangles flatter than this, in shares of the highest speed and force, are not halved: `f32` would no longer tell
/// the insides of what comes of them apart.
const FLATTEST: f64 = 2.5e-3;
/// Most triangles that one becomes on average, so that preparing a wild texture takes a bounded time.
const MOST_EACH: usize = 8;
/// Most triangles in all: their numbers have 16 bits in the renderer.
const MOST: usize = 60_000;
/// Highest ln gain, for predictors that rounding makes unstable: what such a model sounds like is silence.
const HIGHEST_LN_GAIN: f64 = 60.0;

/// Where the quadratic is looked at inside a triangle: in its middle, and half-way from there to the corners.
const INSIDE: [[f64; 3]; 4] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// A corner of triangles.
#[derive(Clone, Debug)]
pub(super) struct Vertex {
    /// Place, in shares of the highest speed and force.
    pub(super) at: Xy,
    /// Line spectral frequencies.
    pub(super) lsf: Vec<f64>,
    /// Level.
    pub(super) level_mps2: f64,
}

/// Triangles over vertices, with ln of the predictor's power gain where the callback needs it.
#[derive(Debug)]
pub(super) struct Refined {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[usize; 3]>,
    ln_gains: Vec<f64>,
    edges: BTreeMap<(usize, usize), Edge>,
}

#[derive(Debug)]
struct Edge {
    /// The triangles on its sides.
    sides: [Option<usize>; 2],
    /// ln gain at its middle.
    middle: f64,
    /// Largest error of the quadratic along it.
    error: f64,
}

impl Refined {
    /// The triangles over `vertices`, halved until the level is right to [`TOLERANCE`], as far as the limits allow.
    pub(super) fn new(vertices: Vec<Vertex>, triangulation: &Triangulation) -> Self {
        let ln_gains = vertices.iter().map(|v| ln_gain(&v.lsf)).collect();
        let triangles = triangulation.triangles().to_vec();
        let mut refined = Self { vertices, triangles, ln_gains, edges: BTreeMap::new() };
        for triangle in 0..refined.triangles.len() {
            refined.join(triangle);
        }
        let most = (MOST_EACH * refined.triangles.len()).min(MOST);
        let mut unchecked: VecDeque<usize> = (0..refined.triangles.len()).collect();
        while let Some(triangle) = unchecked.pop_front() {
            if refined.triangles.len() + 2 > most {
                break;
            }
            if let Some((a, b)) = refined.edge_to_halve(triangle) {
                unchecked.extend(refined.halve(a, b));
            }
        }
        refined
    }

    /// ln gain at the corners of a triangle, then at the middles of the edges opposite each.
    pub(super) fn ln_gains(&self, triangle: usize) -> [f64; 6] {
        let [a, b, c] = self.triangles[triangle];
        let middle = |a: usize, b: usize| self.edges[&sorted(a, b)].middle;
        let [at_a, at_b, at_c] = [a, b, c].map(|v| self.ln_gains[v]);
        [at_a, at_b, at_c, middle(b, c), middle(c, a), middle(a, b)]
    }

    /// Neighbor of a triangle across the edge opposite each corner.
    pub(super) fn neighbors(&self, triangle: usize) -> [Option<usize>; 3] {
        let [a, b, c] = self.triangles[triangle];
        let across = |a: usize, b: usize| {
            self.edges[&sorted(a, b)].sides.into_iter().flatten().find(|side| *side != triangle)
        };
        [across(b, c), across(c, a), across(a, b)]
    }

    /// The edge of a triangle to halve: the one where the quadratic is worst, if it is bad anywhere in the triangle.
    fn edge_to_halve(&self, triangle: usize) -> Option<(usize, usize)> {
        let [a, b, c] = self.triangles[triangle];
        let sides = [sorted(b, c), sorted(c, a), sorted(a, b)];
        let worst_edge = sides.iter().map(|side| self.edges[side].error).fold(0.0, f64::max);
        if worst_edge <= TOLERANCE && INSIDE.iter().all(|at| self.error_at(triangle, *at) <= TOLERANCE) {
            return None;
        }
        let is_divisible = |side: &(usize, usize)| {
            self.edges[side].sides.into_iter().flatten().all(|triangle| self.height(triangle) >= FLATTEST)
        };
        let by_error =
            |x: &(usize, usize), y: &(usize, usize)| self.edges[x].error.total_cmp(&self.edges[y].error);
        sides.into_iter().filter(is_divisible).max_by(by_error)
    }

    /// The smallest height of a triangle.
    fn height(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.triangles[triangle].map(|v| self.vertices[v].at);
        let length = |[ax, ay]: Xy, [bx, by]: Xy| (ax - bx).hypot(ay - by);
        let double_area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        double_area / length(a, b).max(length(b, c)).max(length(c, a))
    }

    /// Error of the quadratic inside a triangle.
    fn error_at(&self, triangle: usize, [u, v, w]: [f64; 3]) -> f64 {
        let [a, b, c] = self.triangles[triangle];
        let exact = ln_gain(&self.mean_lsf(&[(a, u), (b, v), (c, w)]));
        let [a, b, c, opposite_a, opposite_b, opposite_c] = self.ln_gains(triangle);
        let corners = u * (2.0 * u - 1.0) * a + v * (2.0 * v - 1.0) * b + w * (2.0 * w - 1.0) * c;
        let middles = v * w * opposite_a + w * u * opposite_b + u * v * opposite_c;
        (corners + 4.0 * middles - exact).abs()
    }

    fn mean_lsf(&self, parts: &[(usize, f64)]) -> Vec<f64> {
        let order = self.vertices[parts[0].0].lsf.len();
        (0..order).map(|i| parts.iter().map(|(v, w)| w * self.vertices[*v].lsf[i]).sum()).collect()
    }

    /// Puts a new vertex in the middle of an edge; gives the triangles that have changed.
    fn halve(&mut self, a: usize, b: usize) -> Vec<usize> {
        let Some(edge) = self.edges.remove(&(a, b)) else { return Vec::new() };
        let (first, second) = (&self.vertices[a], &self.vertices[b]);
        let middle = self.vertices.len();
        self.vertices.push(Vertex {
            at: [0, 1].map(|axis| 0.5 * (first.at[axis] + second.at[axis])),
            lsf: self.mean_lsf(&[(a, 0.5), (b, 0.5)]),
            level_mps2: 0.5 * (first.level_mps2 + second.level_mps2),
        });
        self.ln_gains.push(edge.middle);
        let mut changed = Vec::new();
        for triangle in edge.sides.into_iter().flatten() {
            let corners = self.triangles[triangle];
            let with = |old: usize| corners.map(|corner| if corner == old { middle } else { corner });
            let new = self.triangles.len();
            // The half at a keeps its number; the half at b is new, on the edge from b to the corner opposite.
            self.triangles[triangle] = with(b);
            self.triangles.push(with(a));
            if let Some(opposite) = corners.into_iter().find(|c| *c != a && *c != b)
                && let Some(kept) = self.edges.get_mut(&sorted(b, opposite))
            {
                kept.sides = kept.sides.map(|side| if side == Some(triangle) { Some(new) } else { side });
            }
            changed.extend([triangle, new]);
        }
        for triangle in &changed {
            self.join(*triangle);
        }
        changed
    }

    /// Enters a triangle at its three edges.
    fn join(&mut self, triangle: usize) {
        let [a, b, c] = self.triangles[triangle];
        for (a, b) in [sorted(b, c), sorted(c, a), sorted(a, b)] {
            if !self.edges.contains_key(&(a, b)) {
                let at = |w: f64| ln_gain(&self.mean_lsf(&[(a, 1.0 - w), (b, w)]));
                let (first, second, middle) = (self.ln_gains[a], self.ln_gains[b], at(0.5));
                // The quadratic through both ends and the middle, at a quarter of the way from the near end.
                let quadratic = |near: f64, far: f64| 0.375 * near + 0.75 * middle - 0.125 * far;
                let error = (quadratic(first, second) - at(0.25)).abs();
                let error = error.max((quadratic(second, first) - at(0.75)).abs());
                self.edges.insert((a, b), Edge { sides: [None; 2], middle, error });
            }
            if let Some(edge) = self.edges.get_mut(&(a, b))
                && !edge.sides.contains(&Some(triangle))
                && let Some(free) = edge.sides.iter_mut().find(|side| side.is_none())
            {
                *free = Some(triangle);
            }
        }
    }
}

/// An edge by its ends, whichever comes first.
fn sorted(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

fn ln_gain(lsf: &[f64]) -> f64 {
    power_gain(&ar_from_lsf(lsf)).ln().min(HIGHEST_LN_GAIN)
}
