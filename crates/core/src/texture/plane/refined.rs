//! Triangle refinement for an accurate level: edges are bisected where the renderer's quadratic misses the filter's
//! power gain.
//!
//! A new vertex has the mean values of the two ends of its edge, so the interpolated values at any contact are
//! unchanged. Only the quadratic through corners and midpoints, which gives the power gain, becomes more accurate. For
//! a radial basis, a new vertex has the values of the basis, and edges are bisected until the triangles approximate it
//! closely enough.
//!
//! Bisecting an edge splits the triangles on both sides, so that no corner lies on another triangle's edge. The result
//! is still the lower hull of a lifted surface, so that walks from triangle to triangle still end (H. Edelsbrunner, "An
//! acyclicity theorem for cell complexes in d dimension", 1990).

use std::collections::{BTreeMap, VecDeque};

use crate::maths::triangulation::{Triangulation, Xy};
use crate::texture::plane::radial::RadialGrain;
use crate::texture::plane::values::Values;

/// Error of the logarithmic power gain above which an edge is bisected: 0.04 dB of level. This is less than half of the
/// guaranteed accuracy, because only a few points of a triangle are checked.
const TOLERANCE: f64 = 0.04 / (10.0 * std::f64::consts::LOG10_E);
/// Minimum height of a triangle to be bisected, relative to the highest speed and force. In flatter triangles, point
/// location in `f32` would fail.
const FLATTEST: f64 = 2.5e-3;
/// Maximum mean number of triangles into which an initial triangle is divided; it bounds the preparation time of
/// irregular textures.
const MOST_EACH: usize = 8;
/// Maximum number of triangles for a radial basis, if [`MOST_EACH`] allows fewer: about 0.1 s of computation.
const MOST_FOR_BASIS: usize = 4000;
/// Maximum number of triangles in total: the renderer uses 16-bit indices.
const MOST: usize = 60_000;

/// Barycentric coordinates of the test points inside a triangle: the centroid, and halfway from it to the corners.
const INSIDE: [[f64; 3]; 4] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// Triangle corner.
#[derive(Clone, Debug)]
pub(super) struct Vertex {
    /// Position, relative to the highest speed and force.
    pub(super) at: Xy,
    /// Values at this position.
    pub(super) values: Values,
}

/// Triangles over vertices, with the logarithmic power gain at the points that the renderer needs.
#[derive(Debug)]
pub(super) struct Refined<'a> {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[usize; 3]>,
    ln_gains: Vec<f64>,
    edges: BTreeMap<(usize, usize), Edge>,
    radial: Option<&'a RadialGrain>,
}

#[derive(Debug)]
struct Edge {
    /// Triangles on both sides.
    sides: [Option<usize>; 2],
    /// Logarithmic power gain at the midpoint.
    middle: f64,
    /// Largest error along the edge, relative to the tolerance.
    error: f64,
}

impl<'a> Refined<'a> {
    /// Refines the triangles over `vertices` until the level is accurate to [`TOLERANCE`] and the triangles approximate
    /// the radial basis, within the limits on their number and height.
    pub(super) fn new(
        vertices: Vec<Vertex>,
        triangulation: &Triangulation,
        radial: Option<&'a RadialGrain>,
    ) -> Self {
        let ln_gains = vertices.iter().map(|v| v.values.ln_gain()).collect();
        let triangles = triangulation.triangles().collect();
        let mut refined = Self { vertices, triangles, ln_gains, edges: BTreeMap::new(), radial };
        for triangle in 0..refined.triangles.len() {
            refined.join(triangle);
        }
        let least = if radial.is_some() { MOST_FOR_BASIS } else { 0 };
        let most = (MOST_EACH * refined.triangles.len()).max(least).min(MOST);
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

    /// Logarithmic power gain at the corners of a triangle, then at the midpoints of the opposite edges.
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

    /// Edge of a triangle to bisect: the one with the largest error, if the error exceeds the tolerance anywhere in the
    /// triangle.
    fn edge_to_halve(&self, triangle: usize) -> Option<(usize, usize)> {
        let [a, b, c] = self.triangles[triangle];
        let sides = [sorted(b, c), sorted(c, a), sorted(a, b)];
        let worst_edge = sides.iter().map(|side| self.edges[side].error).fold(0.0, f64::max);
        if worst_edge <= 1.0 && INSIDE.iter().all(|at| self.error_at(triangle, *at) <= 1.0) {
            return None;
        }
        let is_divisible = |side: &(usize, usize)| {
            self.edges[side].sides.into_iter().flatten().all(|triangle| self.height(triangle) >= FLATTEST)
        };
        let by_error =
            |x: &(usize, usize), y: &(usize, usize)| self.edges[x].error.total_cmp(&self.edges[y].error);
        sides.into_iter().filter(is_divisible).max_by(by_error)
    }

    /// Smallest height of a triangle.
    fn height(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.triangles[triangle].map(|v| self.vertices[v].at);
        let length = |[ax, ay]: Xy, [bx, by]: Xy| (ax - bx).hypot(ay - by);
        let double_area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        double_area / length(a, b).max(length(b, c)).max(length(c, a))
    }

    /// Error inside a triangle, relative to the tolerance.
    fn error_at(&self, triangle: usize, [u, v, w]: [f64; 3]) -> f64 {
        let corners = self.triangles[triangle];
        let (at, values) = self.mean(&[(corners[0], u), (corners[1], v), (corners[2], w)]);
        let [a, b, c, opposite_a, opposite_b, opposite_c] = self.ln_gains(triangle);
        let corners = u * (2.0 * u - 1.0) * a + v * (2.0 * v - 1.0) * b + w * (2.0 * w - 1.0) * c;
        let middles = v * w * opposite_a + w * u * opposite_b + u * v * opposite_c;
        self.error(at, &values, corners + 4.0 * middles)
    }

    /// Error relative to the tolerance, if the triangles have `values` and the renderer uses `ln_gain` at this
    /// position.
    fn error(&self, at: Xy, values: &Values, ln_gain: f64) -> f64 {
        let of_gain = (ln_gain - values.ln_gain()).abs() / TOLERANCE;
        self.radial.map_or(of_gain, |radial| of_gain.max(radial.error(at, values)))
    }

    /// Position between vertices, and the interpolated values there.
    fn mean(&self, parts: &[(usize, f64)]) -> (Xy, Values) {
        let at = [0, 1].map(|axis| parts.iter().map(|(v, w)| w * self.vertices[*v].at[axis]).sum());
        let values: Vec<_> = parts.iter().map(|(v, w)| (&self.vertices[*v].values, *w)).collect();
        (at, Values::mean(&values))
    }

    /// Inserts a new vertex at the midpoint of an edge; returns the changed triangles.
    fn halve(&mut self, a: usize, b: usize) -> Vec<usize> {
        let Some(edge) = self.edges.remove(&(a, b)) else { return Vec::new() };
        let middle = self.vertices.len();
        let (at, mean) = self.mean(&[(a, 0.5), (b, 0.5)]);
        let (values, ln_gain) = match self.radial {
            Some(radial) => {
                let values = radial.at(at);
                let ln_gain = values.ln_gain();
                (values, ln_gain)
            }
            None => (mean, edge.middle),
        };
        self.vertices.push(Vertex { at, values });
        self.ln_gains.push(ln_gain);
        let mut changed = Vec::new();
        for triangle in edge.sides.into_iter().flatten() {
            let corners = self.triangles[triangle];
            let with = |old: usize| corners.map(|corner| if corner == old { middle } else { corner });
            let new = self.triangles.len();
            // The half at a keeps its index; the half at b is new, on the edge from b to the opposite corner.
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

    /// Registers a triangle at its three edges.
    fn join(&mut self, triangle: usize) {
        let [a, b, c] = self.triangles[triangle];
        for (a, b) in [sorted(b, c), sorted(c, a), sorted(a, b)] {
            if !self.edges.contains_key(&(a, b)) {
                let at = |w: f64| self.mean(&[(a, 1.0 - w), (b, w)]);
                let (place, values) = at(0.5);
                let (first, second, middle) = (self.ln_gains[a], self.ln_gains[b], values.ln_gain());
                // Quadratic through both ends and the midpoint, at one quarter of the edge from the near end.
                let quadratic = |near: f64, far: f64| 0.375 * near + 0.75 * middle - 0.125 * far;
                let error = [(0.25, first, second), (0.75, second, first)]
                    .map(|(w, near, far)| {
                        let (place, values) = at(w);
                        self.error(place, &values, quadratic(near, far))
                    })
                    .into_iter()
                    .fold(self.error(place, &values, middle), f64::max);
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

/// Edge key: both ends, the smaller index first.
fn sorted(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}
