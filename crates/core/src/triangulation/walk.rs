//! The walk to the triangle that holds a point: across the edge that the point is farthest beyond, until there is none.
//!
//! Among Delaunay triangles such a walk meets no triangle twice (H. Edelsbrunner, "An acyclicity theorem for cell
//! complexes in d dimension", 1990), as long as no edge is crossed that the point is not beyond. So where a weight is
//! within its rounding error, the side of the edge is worked out with a bound of the error, as adaptive predicates begin
//! (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, section
//! 4.3), and an edge is crossed only for certain.

use crate::triangulation::shape::{NONE, SURELY_OUTSIDE, dot, lowest, sub};
use crate::triangulation::sites::MAX_COORDINATE;
use crate::triangulation::{Triangulation, Xy};

/// Error of the side of an edge, in shares of the two products whose difference it is: `(3 + 16 ε) ε` with Shewchuk's
/// `ε`, which is half an ulp of one.
const SIDE_ERROR: f64 = 2.0 * f64::EPSILON;

/// How far beyond its ends, in shares of its length, a point is still on the edge that stands for a flat triangle.
const ON_EDGE: f64 = 1e-12;

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
    /// The triangle that holds `at` with the weights of its corners, which are at least zero and sum to one; `None`
    /// outside the hull or where there are no triangles.
    ///
    /// A walk from a triangle near the point: a few steps, however many triangles there are.
    pub fn locate(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        self.locate_near(at, &mut self.grid.near(at))
    }

    /// As [`Triangulation::locate`], by a walk from the triangle `hint`: cost is that of the triangles crossed. The hint
    /// becomes the triangle where the walk ends, even outside the hull: the one to begin with for a point close by. Any
    /// number will do for the first point.
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
        // A drag stays outside for as long as it stays inside.
        if least < SURELY_OUTSIDE && shape.neighbors[corner] == NONE {
            return None;
        }
        self.walk(at, hint, (corner, least))
    }

    /// The rest of the walk from the triangle `hint`, which has this lowest weight below zero.
    fn walk(&self, at: Xy, hint: &mut usize, mut out: (usize, f64)) -> Option<(usize, [f64; 3])> {
        let mut triangle = *hint;
        for _ in 0..self.shapes.len() {
            let (corner, least) = out;
            // The lowest may be no number.
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

    /// As [`Triangulation::locate_near`], where a triangle cannot be left or its weights do not say enough.
    #[cold]
    fn locate_closely(&self, at: Xy, hint: &mut usize) -> Option<(usize, [f64; 3])> {
        // Farther off, or where there is no such point, numbers overflow.
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
        // On the longest edge, up to the height of the third corner over it.
        let along = sub(b, a);
        let share = dot(sub(at, a), along) / dot(along, along);
        if !(-ON_EDGE..=1.0 + ON_EDGE).contains(&share) {
            return Verdict::Unsure;
        }
        let share = share.clamp(0.0, 1.0);
        Verdict::Inside([1.0 - share, share, 0.0])
    }
}

/// Weights without what rounding took below zero; they sum to one.
///
/// What a corner has too little is taken from the nearest other one, which moves the point that they say the least: of two
/// corners next to each other, the weights may be far off, but not their sum.
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

/// The most that twice the area can be that an edge makes with a point to the left of it: below zero, the point is to the
/// right for certain.
fn most_left([from, to]: [Xy; 2], at: Xy) -> f64 {
    let (left, right) = ((from[0] - at[0]) * (to[1] - at[1]), (from[1] - at[1]) * (to[0] - at[0]));
    left - right + SIDE_ERROR * (left.abs() + right.abs())
}
