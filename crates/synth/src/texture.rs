//! A texture as the callback sees it: nodes over (speed, force) and a triangulation to interpolate between them.

use crate::contact::Contact;
use crate::relief::Relief;

/// Highest order of a predictor.
pub const MAX_ORDER: usize = 32;

/// "No neighbor" in [`Triangle::neighbors`].
pub const NO_NEIGHBOR: u16 = u16::MAX;

/// What was measured at one speed and force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Output level, the root mean square in m/s²; zero at zero speed or force.
    pub level_mps2: f32,
    /// Line spectral frequencies in radians (0, π), ascending; the first `order` count.
    pub lsf: [f32; MAX_ORDER],
}

/// What drives the predictor of a published texture at a node, in place of the node's level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excitation {
    /// Variance of the white noise, in (m/s²)²; zero where the node is silent.
    pub variance: f32,
    /// Gain after it, without a unit.
    pub gain: f32,
    /// Line spectral frequencies of the moving average in radians (0, π), ascending; the first `ma_order` count.
    pub ma_lsf: [f32; MAX_ORDER],
}

/// Three nodes and the affine map from a contact to its weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Indices of the three nodes.
    pub nodes: [u16; 3],
    /// Neighbor across the edge opposite each node, or [`NO_NEIGHBOR`].
    pub neighbors: [u16; 3],
    /// First weight `= m[0] x + m[1] y + m[2]`, second likewise from `m[3..]`, with `x = speed / speed_max` and
    /// `y = force / force_max`; the third is what is left of one.
    pub weights: [f32; 6],
    /// ln of the power gain, that of the predictor alone being `1 / Π (1 - k²)`, at the three nodes, then at the middles
    /// of the edges opposite each node. The gain between is the quadratic through these six: interpolated frequencies do not have
    /// interpolated gains, and an exact gain would cost a step-down recursion at every tick.
    pub ln_gain: [f32; 6],
}

/// Why slices do not make a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextureError {
    /// The order is zero or above [`MAX_ORDER`], or there is a moving average without excitations.
    Order,
    /// The rate, or the largest speed or force, is not a positive finite number.
    Range,
    /// There is no triangle, or one names a node or neighbor that does not exist.
    Triangle,
    /// A level, frequency, weight or gain is not finite, or frequencies do not ascend within (0, π).
    Number,
    /// There are excitations, but not one for each node.
    Excitation,
}

/// What a prepared texture is made of, as its owner lends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts<'a> {
    /// Samples a second of the model, in Hz.
    pub rate_hz: f32,
    /// Order of the predictor, the same at every node.
    pub order: usize,
    /// Order of the moving average, the same at every node; zero where there is none.
    pub ma_order: usize,
    /// Speed at which the texture saturates, in m/s.
    pub speed_max_mps: f32,
    /// Force at which the texture saturates, in N.
    pub force_max_n: f32,
    /// Nodes of the plane.
    pub nodes: &'a [Node],
    /// For a published texture one for each node: excitations are interpolated instead of levels. Else none.
    pub excitations: &'a [Excitation],
    /// Triangles over the nodes.
    pub triangles: &'a [Triangle],
    /// What lies at each place, where anything does.
    pub relief: Option<Relief<'a>>,
}

/// A prepared texture, lent to the renderer. Checked once by [`Texture::new`], so that everything after is total.
#[derive(Clone, Copy, Debug)]
pub struct Texture<'a>(Parts<'a>);

/// The model at one contact.
#[derive(Clone, Copy, Debug)]
pub struct Evaluated {
    /// Line spectral frequencies in radians; the first `order` count.
    pub lsf: [f32; MAX_ORDER],
    /// Line spectral frequencies of the moving average in radians; the first `ma_order` count.
    pub ma_lsf: [f32; MAX_ORDER],
    /// Order of the moving average; zero where there is none.
    pub ma_order: usize,
    /// Output level, the root mean square in m/s².
    pub level_mps2: f32,
    /// Standard deviation of the excitation that gives this level, in m/s².
    pub sigma_mps2: f32,
}

impl<'a> Texture<'a> {
    /// A texture over checked slices.
    ///
    /// # Errors
    /// [`TextureError`] names the first rule that a slice breaks.
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

    /// A texture over slices that [`Texture::new`] has accepted before: free, for an owner who lends them at every tick.
    /// Slices that would not have been accepted are silent or not finite, never out of bounds.
    pub fn checked_before(parts: Parts<'a>) -> Self {
        let (order, ma_order) = (parts.order.min(MAX_ORDER), parts.ma_order.min(MAX_ORDER));
        Self(Parts { order, ma_order, ..parts })
    }

    /// Samples a second of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.0.rate_hz
    }

    /// Order of the predictor, the same at every node.
    pub fn order(&self) -> usize {
        self.0.order
    }

    /// What lies at each place, where anything does.
    pub fn relief(&self) -> Option<Relief<'a>> {
        self.0.relief
    }

    /// The model at `contact`, clamped to the measured range.
    ///
    /// `hint` is the triangle of the last call and becomes that of this one: a hand moves little in a tick, so the
    /// walk is a step or two. It never takes more steps than there are triangles.
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
            // A published texture may sound on its axes, but in the air nothing sounds. The filters stay as they are, so
            // that the last tick before the air has them too.
            if x <= 0.0 || y <= 0.0 {
                at.sigma_mps2 = 0.0;
            }
            at.level_mps2 = at.sigma_mps2 * libm::expf(0.5 * ln_gain);
        }
        at
    }

    /// The moving average and the excitation of a published texture: variance and gain each linear in the triangle.
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

    /// The triangle that holds a normalized contact, and its three weights, each at least zero, that sum to one.
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
        // A contact a rounding error outside: all three weights are clamped and sum to one again.
        let clamped = weights.map(|w| w.max(0.0));
        let sum = clamped[0] + clamped[1] + clamped[2];
        Some((triangle, if sum > 0.0 { clamped.map(|w| w / sum) } else { [1.0, 0.0, 0.0] }))
    }
}

/// Whether frequencies ascend within (0, π); none do.
fn ascends(lsf: &[f32]) -> bool {
    lsf.first().is_none_or(|low| *low > 0.0)
        && lsf.last().is_none_or(|high| *high < core::f32::consts::PI)
        && lsf.windows(2).all(|w| w[0] < w[1])
}

#[cfg(test)]
pub(crate) mod tests;
