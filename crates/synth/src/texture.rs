//! Texture model for the callback: nodes over (speed, force) and a triangulation for interpolation, with the layers
//! that depend on the tip's position and direction.

mod check;
mod spot;

use crate::contact::Contact;
use crate::direction::Direction;
use crate::height_map::HeightMap;
pub use crate::limits::{MAX_MA_ORDER, MAX_ORDER};
use crate::lsf::ar_from_lsf;
use crate::power_gain::ln_power_gain;
use crate::relief::{Passage, Relief};
use crate::stick_slip::Friction;
use crate::texture::spot::Spot;

/// "No neighbor" in [`Triangle::neighbors`].
pub const NO_NEIGHBOR: u16 = u16::MAX;

/// Largest number of nodes of a plane: their indices have 16 bits.
pub const MAX_NODES: usize = 1 << 16;

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
    pub ma_lsf: [f32; MAX_MA_ORDER],
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
    /// The order is zero or above [`MAX_ORDER`], that of the moving average is above [`MAX_MA_ORDER`], or there is a
    /// moving average without excitations.
    Order,
    /// The rate, or the maximum speed or force, is not a positive finite number.
    Range,
    /// There is no triangle, or there are too many, or more nodes than [`MAX_NODES`], or a triangle refers to a node or
    /// neighbor that does not exist.
    Triangle,
    /// A level, frequency, weight or gain is not finite or is out of range, or frequencies do not ascend within (0, π).
    Number,
    /// The number of excitations is neither zero nor the number of nodes.
    Excitation,
    /// A published texture, which has excitations, has a grain along the lay.
    Along,
    /// The rotation is not finite, or a parameter of the friction is negative or not finite.
    Layer,
}

/// Grain for strokes along the lay of a texture, over the same speeds and forces and of the same order as the grain
/// across the lay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<'a> {
    /// Nodes of the (speed, force) plane.
    pub nodes: &'a [Node],
    /// Triangles over the nodes.
    pub triangles: &'a [Triangle],
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
    /// Nodes of the (speed, force) plane, for strokes across the lay, which is the texture's y axis.
    pub nodes: &'a [Node],
    /// Excitations of a published (HaTT) model, one per node, interpolated instead of levels; empty otherwise.
    pub excitations: &'a [Excitation],
    /// Triangles over the nodes.
    pub triangles: &'a [Triangle],
    /// Grain for strokes along the lay; `None` for a texture that is the same in all directions.
    pub along: Option<Along<'a>>,
    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    pub turn_rad: f32,
    /// Surface relief along the texture's x axis, if the texture has one.
    pub relief: Option<Relief<'a>>,
    /// Height map in the texture's axes, if the texture has one.
    pub height_map: Option<HeightMap<'a>>,
    /// Friction that makes a tip stick and slip, if the texture has it.
    pub friction: Option<Friction>,
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
    pub ma_lsf: [f32; MAX_MA_ORDER],
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
        check::parts(&parts)?;
        Ok(Self(parts))
    }

    /// A texture over data that [`Texture::new`] has accepted before. It costs nothing, for an owner who lends the data
    /// at every tick. Invalid data give zero or non-finite output and never an out-of-bounds access.
    pub fn checked_before(parts: Parts<'a>) -> Self {
        let (order, ma_order) = (parts.order.min(MAX_ORDER), parts.ma_order.min(MAX_MA_ORDER));
        Self(Parts { order, ma_order, ..parts })
    }

    /// Data of the texture.
    pub fn parts(&self) -> Parts<'a> {
        self.0
    }

    /// Sample rate of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.0.rate_hz
    }

    /// Order of the predictor, the same at every node.
    pub fn order(&self) -> usize {
        self.0.order
    }

    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    pub fn turn_rad(&self) -> f32 {
        self.0.turn_rad
    }

    /// Surface relief along the texture's x axis, if the texture has one.
    pub fn relief(&self) -> Option<Relief<'a>> {
        self.0.relief
    }

    /// Height map in the texture's axes, if the texture has one.
    pub fn height_map(&self) -> Option<HeightMap<'a>> {
        self.0.height_map
    }

    /// Whether the texture depends on the tip's position.
    pub fn has_surface(&self) -> bool {
        self.0.relief.is_some() || self.0.height_map.is_some()
    }

    /// Friction that makes a tip stick and slip, if the texture has it.
    pub fn friction(&self) -> Option<Friction> {
        self.0.friction
    }

    /// Returns a passage over the pad in the texture's axes.
    #[must_use]
    pub fn passage(&self, on_pad: &Passage) -> Passage {
        let turn_rad = self.0.turn_rad;
        if turn_rad == 0.0 { *on_pad } else { on_pad.turned((libm::cosf(turn_rad), libm::sinf(turn_rad))) }
    }

    /// Returns the model at `contact`, clamped to the measured range, for a stroke in this direction on the pad.
    ///
    /// Between the grains across and along the lay, the line spectral frequencies and the squared level are linear in
    /// [`Direction::share_along`]. The grains drive one filter by one excitation.
    ///
    /// `hints` are the indices of the triangles of the previous call, across and along the lay, and are updated. A
    /// contact moves little in a tick, so a walk usually takes one or two steps. It never takes more steps than there
    /// are triangles. A texture with a grain along the lay costs two walks and the power gain of the mixed filter, about
    /// as much as [`ar_from_lsf`] and `order²` multiply-adds.
    pub fn evaluate(&self, contact: Contact, direction: Direction, hints: &mut [u16; 2]) -> Evaluated {
        let contact = contact.sanitized();
        let x = (contact.speed_mps / self.0.speed_max_mps).min(1.0);
        let y = (contact.force_n / self.0.force_max_n).min(1.0);
        let (lsf, ma_lsf) = ([0.0; MAX_ORDER], [0.0; MAX_MA_ORDER]);
        let mut at = Evaluated { lsf, ma_lsf, ma_order: 0, level_mps2: 0.0, sigma_mps2: 0.0 };
        let [across_hint, along_hint] = hints;
        let Some(spot) = Spot::of(self.0.nodes, self.0.triangles, [x, y], across_hint) else { return at };
        spot.write_lsf(&mut at.lsf[..self.0.order]);
        let ln_gain = spot.ln_gain();
        if self.0.excitations.is_empty() {
            at.level_mps2 = spot.level_mps2();
            at.sigma_mps2 = at.level_mps2 * libm::expf(-0.5 * ln_gain);
            if let Some(along) = self.0.along
                && let Some(spot) = Spot::of(along.nodes, along.triangles, [x, y], along_hint)
            {
                self.mix_along(&spot, direction.share_along(self.0.turn_rad), ln_gain, &mut at);
            }
        } else {
            self.excite(&spot, &mut at);
            // A published model may have nonzero variance on the axes, but a lifted or resting tip must be silent. The
            // filters are kept, so that the last tick before the lift still has them.
            if x <= 0.0 || y <= 0.0 {
                at.sigma_mps2 = 0.0;
            }
            at.level_mps2 = at.sigma_mps2 * libm::expf(0.5 * ln_gain);
        }
        at
    }

    /// Mixes the grain along the lay into `at`, the grain across it with the logarithmic power gain `ln_gain`.
    fn mix_along(&self, along: &Spot<'_>, share: f32, ln_gain: f32, at: &mut Evaluated) {
        let order = self.0.order;
        let mut lsf = [0.0; MAX_ORDER];
        along.write_lsf(&mut lsf[..order]);
        for (mixed, along) in at.lsf[..order].iter_mut().zip(lsf) {
            *mixed += share * (along - *mixed);
        }
        let (across_mps2, along_mps2) = (at.level_mps2, along.level_mps2());
        at.level_mps2 =
            libm::sqrtf((1.0 - share) * across_mps2 * across_mps2 + share * along_mps2 * along_mps2);
        let mut ar = [0.0; MAX_ORDER];
        ar_from_lsf(&at.lsf[..order], &mut ar[..order]);
        // The gains of the two grains do not give that of the mixed filter. Only a filter that is not stable in `f32` has
        // none.
        let mixed_gain = ln_power_gain(&ar[..order]);
        let ln_gain = mixed_gain.unwrap_or(ln_gain + share * (along.ln_gain() - ln_gain));
        at.sigma_mps2 = at.level_mps2 * libm::expf(-0.5 * ln_gain);
    }

    /// Interpolates the moving average and the excitation of a published model. Variance and gain are each linear
    /// within the triangle.
    fn excite(&self, spot: &Spot<'_>, at: &mut Evaluated) {
        let [u, v, w] = spot.weights;
        let indices = spot.triangle.nodes.map(usize::from);
        let [Some(a), Some(b), Some(c)] = indices.map(|n| self.0.excitations.get(n)) else { return };
        at.ma_order = self.0.ma_order;
        for (i, out) in at.ma_lsf[..at.ma_order].iter_mut().enumerate() {
            *out = u * a.ma_lsf[i] + v * b.ma_lsf[i] + w * c.ma_lsf[i];
        }
        let variance = u * a.variance + v * b.variance + w * c.variance;
        at.sigma_mps2 = (u * a.gain + v * b.gain + w * c.gain) * libm::sqrtf(variance.max(0.0));
    }
}

#[cfg(test)]
pub(crate) mod tests;
