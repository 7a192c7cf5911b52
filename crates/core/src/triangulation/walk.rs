//! The walk to the triangle that holds a point: across the edge that the point is farthest beyond, until there is none.
//!
//! Among Delaunay triangles such a walk meets no triangle twice (H. Edelsbrunner, "An acyclicity theorem for cell
//! complexes in d dimension", 1990), as long as no edge is crossed that the point is not beyond. So where a weight is
//! within its rounding error, the side of the edge is worked out with a bound of the error, as adaptive predicates begin
//! (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, section
//! 4.3), and an edge is crossed only for certain.

use crate::triangulation::record::{NONE, SURELY_OUTSIDE, dot, sub};
use crate::triangulation::{Triangulation, Xy};

/// Error of the side of an edge, in shares of the two products whose difference it is: `(3 + 16 ε) ε` with Shewchuk's
/// `ε`, which is half an ulp of one.
const SIDE_ERROR: f64 = 2.0 * f64::EPSILON;

/// What a triangle looked at closely says of a point.
enum Verdict {
    /// The point is inside or within a rounding error of it, with these weights.
    Inside([f64; 3]),
    /// The point is beyond the edge opposite this corner.
    Beyond(usize),
    /// The triangle is so thin that the point is next to all three lines through its edges, though not next to it.
    Unsure,
}

impl Triangulation {
    /// The triangle that holds `at`, and the weights of its corners; `None` outside the hull. `from` is a triangle.
    #[inline]
    pub(super) fn walk(&self, at: Xy, hint: &mut usize) -> Option<(usize, [f64; 3])> {
        let mut current = *hint;
        for _ in 0..self.records.len() {
            let record = &self.records[current];
            let weights = record.weights(at);
            let least = smaller(smaller(weights[0], weights[1]), weights[2]);
            if record.holds(least) {
                *hint = current;
                return Some((current, if least >= 0.0 { weights } else { clamped(weights) }));
            }
            let corner = if least < SURELY_OUTSIDE {
                lowest(weights)
            } else {
                match self.look_closely(current, at) {
                    Verdict::Inside(weights) => {
                        *hint = current;
                        return Some((current, weights));
                    }
                    Verdict::Beyond(corner) => corner,
                    Verdict::Unsure => break,
                }
            };
            match record.neighbors[corner] {
                NONE => {
                    *hint = current;
                    return None;
                }
                next => current = next as usize,
            }
        }
        self.search(at)
    }

    /// Looks at every triangle.
    #[cold]
    fn search(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        (0..self.records.len()).find_map(|triangle| match self.look_closely(triangle, at) {
            Verdict::Inside(weights) => Some((triangle, weights)),
            Verdict::Beyond(_) | Verdict::Unsure => None,
        })
    }

    #[cold]
    fn look_closely(&self, triangle: usize, at: Xy) -> Verdict {
        let [a, b, c] = self.corners[triangle].map(|corner| self.points[corner as usize]);
        if let Some(corner) = [[b, c], [c, a], [a, b]].into_iter().position(|edge| is_beyond(edge, at)) {
            return Verdict::Beyond(corner);
        }
        let record = &self.records[triangle];
        if !record.is_degenerate() {
            return Verdict::Inside(clamped(record.weights(at)));
        }
        // On the longest edge, up to the height of the third corner over it.
        let along = sub(b, a);
        let share = dot(sub(at, a), along) / dot(along, along);
        if !(-1e-12..=1.0 + 1e-12).contains(&share) {
            return Verdict::Unsure;
        }
        let share = share.clamp(0.0, 1.0);
        Verdict::Inside([1.0 - share, share, 0.0])
    }
}

/// Whether a point is to the right of an edge for certain.
fn is_beyond([from, to]: [Xy; 2], at: Xy) -> bool {
    let (left, right) = ((from[0] - at[0]) * (to[1] - at[1]), (from[1] - at[1]) * (to[0] - at[0]));
    left - right < -SIDE_ERROR * (left.abs() + right.abs())
}

/// The smaller of two numbers, by one instruction, as no weight is not a number.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The index of the lowest weight.
#[inline]
fn lowest([u, v, w]: [f64; 3]) -> usize {
    let (of_two, least) = if v < u { (1, v) } else { (0, u) };
    if w < least { 2 } else { of_two }
}

/// Weights without what rounding took below zero; they sum to one.
fn clamped(weights: [f64; 3]) -> [f64; 3] {
    let weights = weights.map(|w| w.max(0.0));
    let sum = weights[0] + weights[1] + weights[2];
    weights.map(|w| w / sum)
}
