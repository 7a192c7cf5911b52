//! A triangle in one cache line: the weights of its corners as an affine map, and its neighbors.

use crate::triangulation::Xy;

/// The neighbor across an edge of the hull.
pub(super) const NONE: u32 = u32::MAX;

/// A weight as far below zero as this is taken for a rounding error, so that points on the hull are inside.
const INSIDE: f64 = -1e-12;

/// A weight below this is negative whatever rounding does, in a triangle that [`Record::new`] finds thick enough.
pub(super) const SURELY_OUTSIDE: f64 = -1e-4;

/// Sine of the angle opposite a triangle's longest edge below which too few digits of its area are right. As points in
/// such a triangle are taken to lie on that edge, which moves them by this share of its length at most, the two errors
/// are alike: sqrt(2^-53).
const FLAT: f64 = 1e-8;

/// A triangle, for the walk.
///
/// Weights are worked out from the corner opposite the longest edge. In a triangle with one short edge that corner is at
/// the short edge, and the weights that lose digits are those of two corners that are next to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Record {
    origin: Xy,
    /// Gradients of the weights of the first two corners, along x and along y.
    along_x: [f64; 2],
    along_y: [f64; 2],
    /// Neighbor across the edge opposite each corner.
    pub(super) neighbors: [u32; 3],
    /// Lowest weight that is taken for inside; more than any where the weights say nothing.
    inside: f32,
}

impl Record {
    /// A triangle, counter-clockwise, with the corner opposite its longest edge last.
    pub(super) fn new([a, b, c]: [Xy; 3], neighbors: [u32; 3]) -> Self {
        let [from_c_to_a, from_c_to_b, along] = [sub(a, c), sub(b, c), sub(b, a)];
        let double_area = from_c_to_a[0] * from_c_to_b[1] - from_c_to_a[1] * from_c_to_b[0];
        let [to_a, to_b, longest] = [from_c_to_a, from_c_to_b, along].map(|v| dot(v, v).sqrt());
        let is_flat = double_area <= FLAT * to_a * to_b;
        // Rounding changes a weight by less than 16 ulp times the longest edge over the lowest height.
        let error = 16.0 * f64::EPSILON * longest * to_a.max(to_b);
        if is_flat || error >= -SURELY_OUTSIDE * double_area {
            let none = [0.0; 2];
            return Self { origin: c, along_x: none, along_y: none, neighbors, inside: f32::INFINITY };
        }
        let along_x = [from_c_to_b[1], -from_c_to_a[1]].map(|g| g / double_area);
        let along_y = [-from_c_to_b[0], from_c_to_a[0]].map(|g| g / double_area);
        Self { origin: c, along_x, along_y, neighbors, inside: INSIDE as f32 }
    }

    /// Weights of the corners at a point; negative outside the triangle.
    #[inline]
    pub(super) fn weights(&self, at: Xy) -> [f64; 3] {
        let [x, y] = sub(at, self.origin);
        let [u, v] = [0, 1].map(|corner| self.along_x[corner] * x + self.along_y[corner] * y);
        [u, v, 1.0 - u - v]
    }

    /// Whether a point with this lowest weight is in the triangle.
    #[inline]
    pub(super) fn holds(&self, lowest: f64) -> bool {
        lowest >= f64::from(self.inside)
    }

    /// Whether the triangle is too thin for its weights to say anything.
    pub(super) fn is_degenerate(&self) -> bool {
        self.inside > 0.0
    }
}

/// The index of the corner opposite the longest edge.
pub(super) fn opposite_longest([a, b, c]: [Xy; 3]) -> usize {
    let length = |p: Xy, q: Xy| dot(sub(p, q), sub(p, q));
    let [opposite_a, opposite_b, opposite_c] = [length(b, c), length(c, a), length(a, b)];
    if opposite_c >= opposite_a && opposite_c >= opposite_b {
        2
    } else {
        usize::from(opposite_b >= opposite_a)
    }
}

#[inline]
pub(super) fn sub(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline]
pub(super) fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
