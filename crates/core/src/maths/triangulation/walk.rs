//! Point location by walking: repeatedly cross the edge that the point is farthest beyond.
//!
//! In a Delaunay triangulation such a walk visits no triangle twice (H. Edelsbrunner, "An acyclicity theorem for cell
//! complexes in d dimension", 1990), provided that each crossed edge really separates the triangle from the point. So
//! where a weight is within its rounding error, an orientation test with an error bound decides, like the first stage
//! of adaptive predicates (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates", 1997, section 4.3). Such an edge is crossed only if the sign is certain.

use crate::maths::triangulation::shape::{NONE, SURELY_OUTSIDE, dot, lowest, sub};
use crate::maths::triangulation::sites::MAX_COORDINATE;
use crate::maths::triangulation::{Triangulation, Xy};

/// Relative error of the orientation test, as a multiple of the magnitudes of its two products: `(3 + 16 ε) ε` with
/// Shewchuk's `ε`, half an ulp of one.
const SIDE_ERROR: f64 = 2.0 * f64::EPSILON;

/// Tolerance beyond the ends of the edge that represents a flat triangle, relative to its length.
const ON_EDGE: f64 = 1e-12;

/// Result of the exact test of a point against a triangle.
enum Verdict {
    /// The point is inside, or within rounding error of it, with these weights.
    Inside([f64; 3]),
    /// The point is beyond the edge opposite this corner.
    Beyond(usize),
    /// The triangle is thin, and the point is near all three edge lines but not near the triangle.
    Unsure,
}

impl Triangulation {
    /// Finds the triangle that contains `at`, with the weights of its corners; the weights are at least zero and sum to
    /// one. Returns `None` outside the convex hull or if there are no triangles.
    ///
    /// The walk starts at a triangle near the point, so it takes few steps for any number of triangles.
    pub fn locate(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        self.locate_near(at, &mut self.grid.near(at))
    }

    /// Finds the triangle like [`Triangulation::locate`], by a walk from the triangle `hint`. The cost is the number of
    /// triangles crossed.
    ///
    /// The hint is set to the last triangle of the walk, even outside the hull; use it for the next nearby point. Any
    /// number is valid as the first hint.
    #[inline]
    pub fn locate_near(&self, at: Xy, hint: &mut usize) -> Option<(usize, [f64; 3])> {
        let shape = self.shapes.get(*hint).or_else(|| {
            *hint = 0;
            self.shapes.first()
        })?;
        let weights = shape.weights(at);
        let (corner, least) = lowest(weights);
        if least >= 0.0 {
            return Some((*hint, weights));
        }
        // While a slider is dragged, consecutive points tend to stay inside or outside.
        if least < SURELY_OUTSIDE && shape.neighbors[corner] == NONE {
            return None;
        }
        self.walk(at, hint, (corner, least))
    }

    /// Continues the walk from the triangle `hint`, whose lowest weight `out` is negative.
    fn walk(&self, at: Xy, hint: &mut usize, mut out: (usize, f64)) -> Option<(usize, [f64; 3])> {
        let mut triangle = *hint;
        for _ in 0..self.shapes.len() {
            let (corner, least) = out;
            // The lowest weight can be NaN.
            if least >= SURELY_OUTSIDE || least.is_nan() {
                break;
            }
            match self.shapes[triangle].neighbors[corner] {
                NONE => {
                    *hint = triangle;
                    return None;
                }
                next => triangle = next as usize,
            }
            let weights = self.shapes[triangle].weights(at);
            out = lowest(weights);
            if out.1 >= 0.0 {
                *hint = triangle;
                return Some((triangle, weights));
            }
        }
        *hint = triangle;
        self.locate_closely(at, hint)
    }

    /// Finds the triangle with error-bounded tests, for walks that do not end or weights that are not accurate enough.
    #[cold]
    fn locate_closely(&self, at: Xy, hint: &mut usize) -> Option<(usize, [f64; 3])> {
        // Larger coordinates overflow; NaN fails this test too.
        if !at.iter().all(|c| c.abs() <= 2.0 * MAX_COORDINATE) {
            return None;
        }
        for _ in 0..self.shapes.len() {
            match self.look(*hint, at) {
                Verdict::Inside(weights) => return Some((*hint, weights)),
                Verdict::Beyond(corner) => match self.shapes[*hint].neighbors[corner] {
                    NONE => return None,
                    next => *hint = next as usize,
                },
                Verdict::Unsure => break,
            }
        }
        let found = (0..self.shapes.len()).find_map(|triangle| match self.look(triangle, at) {
            Verdict::Inside(weights) => Some((triangle, weights)),
            Verdict::Beyond(_) | Verdict::Unsure => None,
        });
        *hint = found.map_or(*hint, |(triangle, _)| triangle);
        found
    }

    fn look(&self, triangle: usize, at: Xy) -> Verdict {
        let shape = &self.shapes[triangle];
        let weights = shape.weights(at);
        let (corner, least) = lowest(weights);
        if least < SURELY_OUTSIDE {
            return Verdict::Beyond(corner);
        }
        let [a, b, c] = self.corners(triangle).map(|corner| self.points[corner]);
        let (corner, most) = lowest([[b, c], [c, a], [a, b]].map(|edge| most_left(edge, at)));
        if most < 0.0 {
            return Verdict::Beyond(corner);
        }
        if shape.is_thick {
            return Verdict::Inside(clamped(weights, [a, b, c]));
        }
        // On the longest edge, within the height of the third corner above it.
        let along = sub(b, a);
        let share = dot(sub(at, a), along) / dot(along, along);
        if !(-ON_EDGE..=1.0 + ON_EDGE).contains(&share) {
            return Verdict::Unsure;
        }
        let share = share.clamp(0.0, 1.0);
        Verdict::Inside([1.0 - share, share, 0.0])
    }
}

/// Sets negative weights to zero and returns weights that sum to one.
///
/// The deficit of a corner is taken from its nearest other corner, which moves the represented point the least. For two
/// nearby corners the single weights can be inaccurate, but their sum is accurate.
fn clamped(mut weights: [f64; 3], corners: [Xy; 3]) -> [f64; 3] {
    for corner in [0, 1, 2, 0, 1, 2] {
        if weights[corner] < 0.0 {
            let [left, right] = [(corner + 1) % 3, (corner + 2) % 3];
            let squared = |other: usize| {
                let along = sub(corners[other], corners[corner]);
                dot(along, along)
            };
            let giver = if squared(left) <= squared(right) { left } else { right };
            weights[giver] += weights[corner];
            weights[corner] = 0.0;
        }
    }
    let weights = weights.map(|w| w.max(0.0));
    let sum = weights[0] + weights[1] + weights[2];
    weights.map(|w| w / sum)
}

/// Upper bound of twice the signed area of the triangle formed by an edge and a point. If it is negative, the point is
/// certainly to the right of the edge.
fn most_left([from, to]: [Xy; 2], at: Xy) -> f64 {
    let (left, right) = ((from[0] - at[0]) * (to[1] - at[1]), (from[1] - at[1]) * (to[0] - at[0]));
    left - right + SIDE_ERROR * (left.abs() + right.abs())
}
