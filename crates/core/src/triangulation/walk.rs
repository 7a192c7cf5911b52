//! The walk to the triangle that holds a point: across the edge that the point is farthest beyond, until there is none.
//!
//! Among Delaunay triangles such a walk meets no triangle twice (H. Edelsbrunner, "An acyclicity theorem for cell
//! complexes in d dimension", 1990), as long as no edge is crossed that the point is not beyond. So where a weight is
//! within its rounding error, the side of the edge is worked out with a bound of the error, as adaptive predicates begin
//! (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, section
//! 4.3), and an edge is crossed only for certain.

use crate::triangulation::shape::{Shape, dot, lowest, sub};
use crate::triangulation::sites::MAX_COORDINATE;
use crate::triangulation::{NONE, Triangulation, Xy};

/// Error of the side of an edge, in shares of the two products whose difference it is: `(3 + 16 ε) ε` with Shewchuk's
/// `ε`, which is half an ulp of one.
const SIDE_ERROR: f64 = 2.0 * f64::EPSILON;

/// How far beyond its ends, in shares of its length, a point is still on the edge that stands for a flat triangle.
const ON_EDGE: f64 = 1e-12;

/// Who walks from point to point: where one point was found, the search for the next begins.
///
/// It remembers the map of the triangle it stands in, so that a point in the same triangle costs no look at anything else.
#[derive(Clone, Debug)]
pub struct Walker<'a> {
    triangulation: &'a Triangulation,
    triangle: usize,
    weighing: Shape,
}

/// What a triangle says of a point.
enum Verdict {
    /// The point is inside or within a rounding error of it, with these weights.
    Inside([f64; 3]),
    /// The point is beyond the edge opposite this corner.
    Beyond(usize),
    /// The triangle is so thin that the point is next to all three lines through its edges, though not next to it.
    Unsure,
}

impl<'a> Walker<'a> {
    pub(super) fn new(triangulation: &'a Triangulation, triangle: usize) -> Self {
        let mut walker = Self { triangulation, triangle, weighing: Shape::unknown() };
        if triangle < triangulation.triangles.len() {
            walker.stop(triangle);
        }
        walker
    }

    /// The triangle where the last walk ended.
    pub fn triangle(&self) -> usize {
        self.triangle
    }

    /// As [`Triangulation::locate`]; cost is that of the triangles crossed since the last point.
    #[inline]
    pub fn locate(&mut self, at: Xy) -> Option<(usize, [f64; 3])> {
        let shares = self.weighing.shares(at);
        if shares.are_inside() {
            return Some((self.triangle, shares.of_corners));
        }
        match shares.surely_beyond() {
            Some(corner) => match self.triangulation.triangles[self.triangle].neighbors[corner] {
                NONE => None,
                next => self.walk(next as usize, at),
            },
            None => self.walk(self.triangle, at),
        }
    }

    fn walk(&mut self, from: usize, at: Xy) -> Option<(usize, [f64; 3])> {
        let (end, weights) = self.triangulation.walk(from, at);
        self.stop(end);
        weights.map(|weights| (end, weights))
    }

    fn stop(&mut self, triangle: usize) {
        let shape = self.triangulation.shape(triangle);
        self.triangle = triangle;
        self.weighing = if shape.is_thick() { shape.weighing() } else { Shape::unknown() };
    }
}

impl Triangulation {
    /// Where the walk to a point ends, and the weights there if that is inside.
    pub(super) fn walk(&self, from: usize, at: Xy) -> (usize, Option<[f64; 3]>) {
        // Farther off, or where there is no such point, numbers overflow.
        if !at.iter().all(|c| c.abs() <= 2.0 * MAX_COORDINATE) {
            return (from, None);
        }
        let mut current = from;
        for _ in 0..self.triangles.len() {
            match self.look(current, at) {
                Verdict::Inside(weights) => return (current, Some(weights)),
                Verdict::Beyond(corner) => match self.triangles[current].neighbors[corner] {
                    NONE => return (current, None),
                    next => current = next as usize,
                },
                Verdict::Unsure => break,
            }
        }
        self.search(at).map_or((current, None), |(triangle, weights)| (triangle, Some(weights)))
    }

    /// Looks at every triangle.
    #[cold]
    fn search(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        (0..self.triangles.len()).find_map(|triangle| match self.look_closely(triangle, at) {
            Verdict::Inside(weights) => Some((triangle, weights)),
            Verdict::Beyond(_) | Verdict::Unsure => None,
        })
    }

    #[inline]
    fn look(&self, triangle: usize, at: Xy) -> Verdict {
        let shape = self.shape(triangle);
        if shape.is_thick() {
            let shares = shape.shares(at);
            if shares.are_inside() {
                return Verdict::Inside(shape.weighing().shares(at).clamped());
            }
            if let Some(corner) = shares.surely_beyond() {
                return Verdict::Beyond(corner);
            }
        }
        self.look_closely(triangle, at)
    }

    #[cold]
    fn look_closely(&self, triangle: usize, at: Xy) -> Verdict {
        let [a, b, c] = self.places(triangle);
        let beyond = [[b, c], [c, a], [a, b]].map(|edge| surely_left(edge, at));
        let corner = lowest(beyond);
        if beyond[corner] < 0.0 {
            return Verdict::Beyond(corner);
        }
        let shape = self.shape(triangle);
        if shape.is_thick() {
            return Verdict::Inside(shape.shares(at).clamped());
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

    #[inline]
    fn shape(&self, triangle: usize) -> Shape {
        Shape::new(self.places(triangle))
    }

    #[inline]
    fn places(&self, triangle: usize) -> [Xy; 3] {
        self.triangles[triangle].corners.map(|corner| self.points[corner as usize])
    }
}

/// Twice the area that an edge makes with a point to the left of it, at most; below zero, the point is to the right for
/// certain.
fn surely_left([from, to]: [Xy; 2], at: Xy) -> f64 {
    let (left, right) = ((from[0] - at[0]) * (to[1] - at[1]), (from[1] - at[1]) * (to[0] - at[0]));
    left - right + SIDE_ERROR * (left.abs() + right.abs())
}
