//! Triangle that fits one cache line: barycentric weights as an affine map, and the neighbors.

use crate::maths::triangulation::Xy;

/// Marks an edge of the convex hull, which has no neighbor.
pub(super) const NONE: u32 = u32::MAX;

/// Weights below this limit are negative regardless of rounding error; [`Shape::new`] ensures it.
pub(super) const SURELY_OUTSIDE: f64 = -1e-4;

/// Sine of the angle opposite the longest edge, below which too few digits of the area are correct. Points in such a
/// triangle are treated as lying on that edge, which moves them by at most this fraction of its length. The two errors
/// are equal at sqrt(2^-53).
const FLAT: f64 = 1e-8;

/// Bound of a weight's rounding error: this constant times the longest edge divided by the smallest height. The code
/// uses the sum of the squares of the two shorter edges. The product of the two longest edges is at most √2 times as
/// large.
const WEIGHT_ERROR: f64 = 23.0 * f64::EPSILON;

/// Triangle for point location by walking.
///
/// Weights are computed relative to the corner opposite the longest edge. In a triangle with one short edge this corner
/// lies at the short edge. The weights that lose digits then belong to two nearby corners.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Shape {
    origin: Xy,
    /// Gradients of the weights of the first two corners, along x and along y.
    along_x: [f64; 2],
    along_y: [f64; 2],
    /// Neighbor across the edge opposite each corner, or [`NONE`].
    pub(super) neighbors: [u32; 3],
    /// Whether the triangle is thick enough for meaningful weights.
    pub(super) is_thick: bool,
}

impl Shape {
    /// Triangle with counter-clockwise corners; the last corner is opposite the longest edge.
    ///
    /// A triangle that is too thin gets placeholder weights: for any allowed point they are neither inside nor surely
    /// outside.
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

    /// Barycentric weights of the corners at a point; some are negative outside the triangle.
    #[inline]
    pub(super) fn weights(&self, at: Xy) -> [f64; 3] {
        let [x, y] = sub(at, self.origin);
        let [u, v] = [0, 1].map(|corner| self.along_x[corner] * x + self.along_y[corner] * y);
        [u, v, 1.0 - u - v]
    }
}

/// Index and value of the lowest number, computed without an unpredictable branch. If the last number is NaN, the
/// result is not meaningful; the last weight is NaN whenever an earlier one is.
#[inline]
pub(super) fn lowest([u, v, w]: [f64; 3]) -> (usize, f64) {
    let of_two = smaller(u, v);
    let is_last = usize::from(w < of_two);
    ((usize::from(v < u) & (1 - is_last)) | (2 * is_last), smaller(w, of_two))
}

/// Smaller of two numbers in one instruction; `a` if either is NaN.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// Index of the corner opposite the longest edge.
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
