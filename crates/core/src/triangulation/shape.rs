//! A triangle in one cache line: the weights of its corners as an affine map, and its neighbors.

use crate::triangulation::Xy;

/// The neighbor across an edge of the hull.
pub(super) const NONE: u32 = u32::MAX;

/// A weight below this is negative whatever rounding does. [`Shape::new`] sees to it.
pub(super) const SURELY_OUTSIDE: f64 = -1e-4;

/// Sine of the angle opposite a triangle's longest edge below which too few digits of its area are right. As points in
/// such a triangle are taken to lie on that edge, which moves them by this share of its length at most, the two errors
/// are alike: sqrt(2^-53).
const FLAT: f64 = 1e-8;

/// Rounding changes a weight by less than this times the longest edge over the lowest height. With the sum of the squares
/// of the two shorter edges in place of the product of the two longest, which is at most √2 times as much.
const WEIGHT_ERROR: f64 = 23.0 * f64::EPSILON;

/// A triangle, for walks.
///
/// Weights are worked out from the corner opposite the longest edge. In a triangle with one short edge that corner is at
/// the short edge, and the weights that lose digits are those of two corners that are next to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Shape {
    origin: Xy,
    /// How the weights of the first two corners grow along x, and along y.
    along_x: [f64; 2],
    along_y: [f64; 2],
    /// Neighbor across the edge opposite each corner, or [`NONE`].
    pub(super) neighbors: [u32; 3],
    /// Whether its weights say anything.
    pub(super) is_thick: bool,
}

impl Shape {
    /// A triangle, counter-clockwise, with the corner opposite its longest edge last.
    ///
    /// In one that is too thin the weights say of any point in reach that it is neither inside nor surely outside.
    pub(super) fn new([a, b, c]: [Xy; 3], neighbors: [u32; 3]) -> Self {
        let ([ax, ay], [bx, by]) = (sub(a, c), sub(b, c));
        let double_area = ax * by - ay * bx;
        let [to_a, to_b] = [ax * ax + ay * ay, bx * bx + by * by];
        let is_sharp = double_area > 0.0 && double_area * double_area > FLAT * FLAT * to_a * to_b;
        if is_sharp && WEIGHT_ERROR * (to_a + to_b) < -SURELY_OUTSIDE * double_area {
            let unit = 1.0 / double_area;
            let (along_x, along_y) = ([unit * by, -unit * ay], [-unit * bx, unit * ax]);
            return Self { origin: c, along_x, along_y, neighbors, is_thick: true };
        }
        let (far, weight) = (1e40, 1e-8);
        Self {
            origin: [far, 0.0],
            along_x: [weight / far, 0.0],
            along_y: [0.0; 2],
            neighbors,
            is_thick: false,
        }
    }

    /// Weights of the corners at a point; negative outside the triangle.
    #[inline]
    pub(super) fn weights(&self, at: Xy) -> [f64; 3] {
        let [x, y] = sub(at, self.origin);
        let [u, v] = [0, 1].map(|corner| self.along_x[corner] * x + self.along_y[corner] * y);
        [u, v, 1.0 - u - v]
    }
}

/// The index of the lowest number and the number, without a branch that could not be foreseen. If the last is no number,
/// as a weight is if one before it is none, there is no lowest.
#[inline]
pub(super) fn lowest([u, v, w]: [f64; 3]) -> (usize, f64) {
    let of_two = smaller(u, v);
    let is_last = usize::from(w < of_two);
    ((usize::from(v < u) & (1 - is_last)) | (2 * is_last), smaller(w, of_two))
}

/// The smaller of two numbers by one instruction; the first, if one is no number.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The index of the corner opposite the longest edge.
pub(super) fn opposite_longest([a, b, c]: [Xy; 3]) -> usize {
    let squared = |p: Xy, q: Xy| -dot(sub(p, q), sub(p, q));
    lowest([squared(b, c), squared(c, a), squared(a, b)]).0
}

#[inline]
pub(super) fn sub(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline]
pub(super) fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
