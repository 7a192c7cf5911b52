//! Position of a contact in the triangles of a (speed, force) plane, and the values interpolated there.

use super::{NO_NEIGHBOR, Node, Triangle};

/// Triangle that holds a contact, with its nodes and their barycentric weights, each at least zero and with sum one.
pub(super) struct Spot<'a> {
    pub(super) triangle: &'a Triangle,
    nodes: [&'a Node; 3],
    pub(super) weights: [f32; 3],
}

impl<'a> Spot<'a> {
    /// Finds a normalized speed and force, starting at the triangle with index `hint`, which is updated. `None` if the
    /// slices, which were never checked, do not hold it.
    pub(super) fn of(
        nodes: &'a [Node],
        triangles: &'a [Triangle],
        at: [f32; 2],
        hint: &mut u16,
    ) -> Option<Self> {
        let (triangle, weights) = locate(triangles, at, hint)?;
        let [Some(a), Some(b), Some(c)] = triangle.nodes.map(|n| nodes.get(usize::from(n))) else {
            return None;
        };
        Some(Self { triangle, nodes: [a, b, c], weights })
    }

    /// Writes the line spectral frequencies in rad; at most as many as a node has.
    pub(super) fn write_lsf(&self, lsf: &mut [f32]) {
        let ([a, b, c], [u, v, w]) = (self.nodes, self.weights);
        for (i, out) in lsf.iter_mut().enumerate() {
            *out = u * a.lsf[i] + v * b.lsf[i] + w * c.lsf[i];
        }
    }

    /// Level (RMS) in m/s².
    pub(super) fn level_mps2(&self) -> f32 {
        let ([a, b, c], [u, v, w]) = (self.nodes, self.weights);
        (u * a.level_mps2 + v * b.level_mps2 + w * c.level_mps2).max(0.0)
    }

    /// Natural logarithm of the filter's power gain, by the quadratic of [`Triangle::ln_gain`].
    pub(super) fn ln_gain(&self) -> f32 {
        let (g, [u, v, w]) = (&self.triangle.ln_gain, self.weights);
        u * (2.0 * u - 1.0) * g[0]
            + v * (2.0 * v - 1.0) * g[1]
            + w * (2.0 * w - 1.0) * g[2]
            + 4.0 * (v * w * g[3] + w * u * g[4] + u * v * g[5])
    }
}

/// Returns the triangle of a normalized contact and its three barycentric weights, each at least zero, with sum one.
fn locate<'a>(
    triangles: &'a [Triangle],
    [x, y]: [f32; 2],
    hint: &mut u16,
) -> Option<(&'a Triangle, [f32; 3])> {
    let mut triangle = triangles.get(usize::from(*hint)).or_else(|| {
        *hint = 0;
        triangles.first()
    })?;
    let mut weights = [0.0; 3];
    for _ in 0..=triangles.len() {
        let m = &triangle.weights;
        let u = m[0] * x + m[1] * y + m[2];
        let v = m[3] * x + m[4] * y + m[5];
        weights = [u, v, 1.0 - u - v];
        let mut lowest = 0;
        for i in 1..3 {
            if weights[i] < weights[lowest] {
                lowest = i;
            }
        }
        let next = triangle.neighbors[lowest];
        if weights[lowest] >= -1e-6 || next == NO_NEIGHBOR {
            break;
        }
        triangle = triangles.get(usize::from(next))?;
        *hint = next;
    }
    // A contact may lie outside by a rounding error: the weights are clamped and normalized to sum one.
    let clamped = weights.map(|w| w.max(0.0));
    let sum = clamped[0] + clamped[1] + clamped[2];
    Some((triangle, if sum > 0.0 { clamped.map(|w| w / sum) } else { [1.0, 0.0, 0.0] }))
}
