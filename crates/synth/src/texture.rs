//! Texture model for the callback: nodes over (speed, force) and a triangulation for interpolation.

use crate::contact::Contact;
pub use crate::limits::MAX_ORDER;
use crate::relief::Relief;

/// "No neighbor" in [`Triangle::neighbors`].
pub const NO_NEIGHBOR: u16 = u16::MAX;

/// Model at one measured speed and force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Output level (RMS) in m/s²; zero at zero speed or force.
    pub level_mps2: f32,
    /// Line spectral frequencies in radians (0, π), ascending; the first `order` are used.
    pub lsf: [f32; MAX_ORDER],
}

/// Excitation of a published (HaTT) model at a node, used instead of the node's level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excitation {
    /// Variance of the white noise, in (m/s²)²; zero at a silent node.
    pub variance: f32,
    /// Gain after the noise, dimensionless.
    pub gain: f32,
    /// Line spectral frequencies of the moving average in radians (0, π), ascending; the first `ma_order` are used.
    pub ma_lsf: [f32; MAX_ORDER],
}

/// Three nodes with the affine map from a contact to its barycentric weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Indices of the three nodes.
    pub nodes: [u16; 3],
    /// Index of the triangle across the edge opposite each node, or [`NO_NEIGHBOR`].
    pub neighbors: [u16; 3],
    /// Affine map: the first weight is `m[0] x + m[1] y + m[2]`, the second likewise from `m[3..]`, with
    /// `x = speed / speed_max` and `y = force / force_max`. The third is one minus their sum.
    pub weights: [f32; 6],
    /// Natural logarithm of the power gain at the three nodes, then at the midpoints of the edges opposite each node.
    /// For an AR predictor alone, the power gain is `1 / Π (1 - k²)`. Between these six points the renderer uses their
    /// quadratic interpolant: interpolated LSFs do not have interpolated gains, and an exact gain would need a
    /// step-down recursion at every tick.
    pub ln_gain: [f32; 6],
}

/// Reasons why data do not form a valid texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextureError {
    /// The order is zero or above [`MAX_ORDER`], or there is a moving average without excitations.
    Order,
    /// The rate, or the maximum speed or force, is not a positive finite number.
    Range,
    /// There is no triangle, or there are too many, or one refers to a node or neighbor that does not exist.
    Triangle,
    /// A level, frequency, weight or gain is not finite or is out of range, or frequencies do not ascend within (0, π).
    Number,
    /// The number of excitations is neither zero nor the number of nodes.
    Excitation,
}

/// Data of a prepared texture, borrowed from its owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts<'a> {
    /// Sample rate of the model, in Hz.
    pub rate_hz: f32,
    /// Order of the predictor, the same at every node.
    pub order: usize,
    /// Order of the moving average, the same at every node; zero without one.
    pub ma_order: usize,
    /// Speed at which the texture saturates, in m/s.
    pub speed_max_mps: f32,
    /// Force at which the texture saturates, in N.
    pub force_max_n: f32,
    /// Nodes of the (speed, force) plane.
    pub nodes: &'a [Node],
    /// Excitations of a published (HaTT) model, one per node, interpolated instead of levels; empty otherwise.
    pub excitations: &'a [Excitation],
    /// Triangles over the nodes.
    pub triangles: &'a [Triangle],
    /// Surface relief, if the texture has one.
    pub relief: Option<Relief<'a>>,
}

/// A prepared texture, borrowed by the renderer. [`Texture::new`] checks it once, so that rendering cannot fail.
#[derive(Clone, Copy, Debug)]
pub struct Texture<'a>(Parts<'a>);

/// Model interpolated at one contact.
#[derive(Clone, Copy, Debug)]
pub struct Evaluated {
    /// Line spectral frequencies in radians; the first `order` are used.
    pub lsf: [f32; MAX_ORDER],
    /// Line spectral frequencies of the moving average in radians; the first `ma_order` are used.
    pub ma_lsf: [f32; MAX_ORDER],
    /// Order of the moving average; zero without one.
    pub ma_order: usize,
    /// Output level (RMS) in m/s².
    pub level_mps2: f32,
    /// Standard deviation of the excitation that gives this level, in m/s².
    pub sigma_mps2: f32,
}

impl<'a> Texture<'a> {
    /// A texture over data that this function validates.
    ///
    /// # Errors
    /// [`TextureError`] names the first violated rule.
    pub fn new(parts: Parts<'a>) -> Result<Self, TextureError> {
        let Parts {
            rate_hz, order, ma_order, speed_max_mps, force_max_n, nodes, excitations, triangles, ..
        } = parts;
        let positive = |x: f32| x.is_finite() && x > 0.0;
        let is_published = !excitations.is_empty();
        if order == 0 || order > MAX_ORDER || ma_order > MAX_ORDER || (ma_order > 0 && !is_published) {
            return Err(TextureError::Order);
        }
        if !(positive(rate_hz) && positive(speed_max_mps) && positive(force_max_n)) {
            return Err(TextureError::Range);
        }
        let node_is_good = |node: &Node| {
            node.level_mps2.is_finite() && node.level_mps2 >= 0.0 && ascends(&node.lsf[..order])
        };
        if !nodes.iter().all(node_is_good) {
            return Err(TextureError::Number);
        }
        if is_published && excitations.len() != nodes.len() {
            return Err(TextureError::Excitation);
        }
        let excitation_is_good = |excitation: &Excitation| {
            let Excitation { variance, gain, ma_lsf } = excitation;
            [variance, gain].iter().all(|x| x.is_finite() && **x >= 0.0) && ascends(&ma_lsf[..ma_order])
        };
        if !excitations.iter().all(excitation_is_good) {
            return Err(TextureError::Number);
        }
        let n_triangles = triangles.len();
        if n_triangles == 0 || n_triangles >= usize::from(NO_NEIGHBOR) {
            return Err(TextureError::Triangle);
        }
        for triangle in triangles {
            let neighbor_is_good = |&t: &u16| t == NO_NEIGHBOR || usize::from(t) < n_triangles;
            if !triangle.nodes.iter().all(|&n| usize::from(n) < nodes.len())
                || !triangle.neighbors.iter().all(neighbor_is_good)
            {
                return Err(TextureError::Triangle);
            }
            if !triangle.weights.iter().chain(&triangle.ln_gain).all(|x| x.is_finite()) {
                return Err(TextureError::Number);
            }
        }
        Ok(Self(parts))
    }

    /// A texture over data that [`Texture::new`] has accepted before. It costs nothing, for an owner who lends the data
    /// at every tick. Invalid data give zero or non-finite output and never an out-of-bounds access.
    pub fn checked_before(parts: Parts<'a>) -> Self {
        let (order, ma_order) = (parts.order.min(MAX_ORDER), parts.ma_order.min(MAX_ORDER));
        Self(Parts { order, ma_order, ..parts })
    }

    /// Sample rate of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.0.rate_hz
    }

    /// Order of the predictor, the same at every node.
    pub fn order(&self) -> usize {
        self.0.order
    }

    /// Surface relief, if the texture has one.
    pub fn relief(&self) -> Option<Relief<'a>> {
        self.0.relief
    }

    /// Returns the model at `contact`, clamped to the measured range.
    ///
    /// `hint` is the index of the triangle of the previous call and is updated. A contact moves little in a tick, so
    /// the walk usually takes one or two steps. It never takes more steps than there are triangles.
    pub fn evaluate(&self, contact: Contact, hint: &mut u16) -> Evaluated {
        let contact = contact.sanitized();
        let x = (contact.speed_mps / self.0.speed_max_mps).min(1.0);
        let y = (contact.force_n / self.0.force_max_n).min(1.0);
        let none = [0.0; MAX_ORDER];
        let mut at = Evaluated { lsf: none, ma_lsf: none, ma_order: 0, level_mps2: 0.0, sigma_mps2: 0.0 };
        let Some((triangle, weights)) = self.locate(x, y, hint) else { return at };
        let [u, v, w] = weights;
        let [Some(a), Some(b), Some(c)] = triangle.nodes.map(|n| self.0.nodes.get(usize::from(n))) else {
            return at;
        };
        for (i, out) in at.lsf[..self.0.order].iter_mut().enumerate() {
            *out = u * a.lsf[i] + v * b.lsf[i] + w * c.lsf[i];
        }
        let g = &triangle.ln_gain;
        let ln_gain = u * (2.0 * u - 1.0) * g[0]
            + v * (2.0 * v - 1.0) * g[1]
            + w * (2.0 * w - 1.0) * g[2]
            + 4.0 * (v * w * g[3] + w * u * g[4] + u * v * g[5]);
        if self.0.excitations.is_empty() {
            at.level_mps2 = (u * a.level_mps2 + v * b.level_mps2 + w * c.level_mps2).max(0.0);
            at.sigma_mps2 = at.level_mps2 * libm::expf(-0.5 * ln_gain);
        } else {
            self.excite(triangle, weights, &mut at);
            // A published model may have nonzero variance on the axes, but a lifted or resting tip must be silent. The
            // filters are kept, so that the last tick before the lift still has them.
            if x <= 0.0 || y <= 0.0 {
                at.sigma_mps2 = 0.0;
            }
            at.level_mps2 = at.sigma_mps2 * libm::expf(0.5 * ln_gain);
        }
        at
    }

    /// Interpolates the moving average and the excitation of a published model. Variance and gain are each linear
    /// within the triangle.
    fn excite(&self, triangle: &Triangle, [u, v, w]: [f32; 3], at: &mut Evaluated) {
        let [Some(a), Some(b), Some(c)] = triangle.nodes.map(|n| self.0.excitations.get(usize::from(n)))
        else {
            return;
        };
        at.ma_order = self.0.ma_order;
        for (i, out) in at.ma_lsf[..at.ma_order].iter_mut().enumerate() {
            *out = u * a.ma_lsf[i] + v * b.ma_lsf[i] + w * c.ma_lsf[i];
        }
        let variance = u * a.variance + v * b.variance + w * c.variance;
        at.sigma_mps2 = (u * a.gain + v * b.gain + w * c.gain) * libm::sqrtf(variance.max(0.0));
    }

    /// Returns the triangle of a normalized contact and its three barycentric weights, each at least zero, with sum
    /// one.
    fn locate(&self, x: f32, y: f32, hint: &mut u16) -> Option<(&Triangle, [f32; 3])> {
        let mut triangle = self.0.triangles.get(usize::from(*hint)).or_else(|| {
            *hint = 0;
            self.0.triangles.first()
        })?;
        let mut weights = [0.0; 3];
        for _ in 0..=self.0.triangles.len() {
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
            triangle = self.0.triangles.get(usize::from(next))?;
            *hint = next;
        }
        // A contact may lie outside by a rounding error: the weights are clamped and normalized to sum one.
        let clamped = weights.map(|w| w.max(0.0));
        let sum = clamped[0] + clamped[1] + clamped[2];
        Some((triangle, if sum > 0.0 { clamped.map(|w| w / sum) } else { [1.0, 0.0, 0.0] }))
    }
}

/// Whether frequencies ascend within (0, π); true for an empty slice.
fn ascends(lsf: &[f32]) -> bool {
    lsf.first().is_none_or(|low| *low > 0.0)
        && lsf.last().is_none_or(|high| *high < core::f32::consts::PI)
        && lsf.windows(2).all(|w| w[0] < w[1])
}

#[cfg(test)]
pub(crate) mod tests;
