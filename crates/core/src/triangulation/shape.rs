//! The shape of a triangle: what is needed for the weights of its corners, and whether they can be trusted.

use crate::triangulation::Xy;

/// A weight below this is negative whatever rounding does, where [`Shape::is_thick`].
pub(super) const SURELY_OUTSIDE: f64 = -1e-4;

/// Sine of the angle opposite a triangle's longest edge below which too few digits of its area are right. As points in
/// such a triangle are taken to lie on that edge, which moves them by this share of its length at most, the two errors
/// are alike: sqrt(2^-53).
const FLAT: f64 = 1e-8;

/// Rounding changes a weight by less than this times the longest edge over the lowest height. With the sum of the squares
/// of two edges in place of the product of the two longest, which is at most √2 times as much.
const WEIGHT_ERROR: f64 = 23.0 * f64::EPSILON;

/// An affine map from the plane to the shares of a whole that belong to the corners of a triangle.
///
/// It starts from the corner opposite the longest edge. In a triangle with one short edge that corner is at the short
/// edge, and what loses digits are the shares of two corners that are next to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    origin: Xy,
    /// How the shares of the first two corners grow along x, and along y.
    along_x: [f64; 2],
    along_y: [f64; 2],
    /// What the three shares sum to.
    whole: f64,
}

impl Shape {
    /// The shape of a triangle, counter-clockwise, with the corner opposite its longest edge last. The whole is twice its
    /// area.
    #[inline]
    pub(super) fn new([a, b, c]: [Xy; 3]) -> Self {
        let ([ax, ay], [bx, by]) = (sub(a, c), sub(b, c));
        Self { origin: c, along_x: [by, -ay], along_y: [-bx, ax], whole: ax * by - ay * bx }
    }

    /// A map that says of every point in reach that its weights lie between surely outside and inside.
    pub(super) fn unknown() -> Self {
        let (far, share) = (1e40, 1e-8);
        Self { origin: [far, 0.0], along_x: [share / far, 0.0], along_y: [0.0; 2], whole: 1.0 }
    }

    /// The same shares of a whole of one: weights.
    #[inline]
    pub(super) fn weighing(&self) -> Self {
        let unit = 1.0 / self.whole;
        let [along_x, along_y] = [self.along_x, self.along_y].map(|along| along.map(|c| c * unit));
        Self { origin: self.origin, along_x, along_y, whole: 1.0 }
    }

    /// Whether the signs of shares can be trusted where they are surely outside, and digits of weights are left.
    #[inline]
    pub(super) fn is_thick(&self) -> bool {
        let ([ay, by], [ax, bx]) = (self.along_x, self.along_y);
        let [to_a, to_b] = [ax * ax + ay * ay, bx * bx + by * by];
        let is_sharp = self.whole * self.whole > FLAT * FLAT * to_a * to_b;
        self.whole > 0.0 && is_sharp && WEIGHT_ERROR * (to_a + to_b) < -SURELY_OUTSIDE * self.whole
    }

    /// What belongs to each corner at a point; negative beyond the edge opposite it.
    #[inline]
    pub(super) fn shares(&self, at: Xy) -> Shares {
        let [x, y] = sub(at, self.origin);
        let [u, v] = [0, 1].map(|corner| self.along_x[corner] * x + self.along_y[corner] * y);
        Shares { of_corners: [u, v, self.whole - u - v], whole: self.whole }
    }
}

/// What belongs to each corner at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shares {
    pub(super) of_corners: [f64; 3],
    whole: f64,
}

impl Shares {
    /// Whether the point is inside.
    #[inline]
    pub(super) fn are_inside(&self) -> bool {
        self.least() >= 0.0
    }

    /// The corner whose opposite edge the point is beyond, if rounding does not matter.
    #[inline]
    pub(super) fn surely_beyond(&self) -> Option<usize> {
        (self.least() < SURELY_OUTSIDE * self.whole).then(|| lowest(self.of_corners))
    }

    /// The weights, without what rounding took below zero; they sum to one.
    pub(super) fn clamped(&self) -> [f64; 3] {
        let shares = self.of_corners.map(|share| share.max(0.0));
        let sum = shares[0] + shares[1] + shares[2];
        shares.map(|share| share / sum)
    }

    #[inline]
    fn least(&self) -> f64 {
        let [u, v, w] = self.of_corners;
        smaller(smaller(u, v), w)
    }
}

/// The index of the lowest number, without a branch that could not be foreseen.
#[inline]
pub(super) fn lowest([u, v, w]: [f64; 3]) -> usize {
    let is_last = usize::from(w < smaller(u, v));
    (usize::from(v < u) & (1 - is_last)) | (2 * is_last)
}

/// The smaller of two numbers by one instruction, as it need not look for what is no number.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The index of the corner opposite the longest edge.
pub(super) fn opposite_longest([a, b, c]: [Xy; 3]) -> usize {
    let squared = |p: Xy, q: Xy| -dot(sub(p, q), sub(p, q));
    lowest([squared(b, c), squared(c, a), squared(a, b)])
}

#[inline]
pub(super) fn sub(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline]
pub(super) fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
