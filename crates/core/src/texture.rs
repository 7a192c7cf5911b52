//! A texture: what a surface does to a tip at every speed and force.

use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Highest order of a predictor that can be rendered.
pub const MAX_ORDER: usize = shagreen_synth::texture::MAX_ORDER;

/// Most nodes of a texture: with its boundary, twice as many triangles still have 16-bit numbers in the renderer.
pub const MAX_NODES: usize = 20_000;

/// The stochastic vibration at one speed and force, as an autoregressive process.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainNode {
    /// Speed at which it was measured.
    pub speed: MetersPerSecond,
    /// Normal force at which it was measured.
    pub force: Newtons,
    /// Line spectral frequencies in radians (0, π), ascending.
    pub lsf: Vec<f64>,
    /// Output level: root mean square acceleration in m/s².
    pub level_mps2: f64,
}

/// A texture model: grain over (speed, force), and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureModel {
    rate: Hertz,
    nodes: Vec<GrainNode>,
    friction: Option<f64>,
}

/// Why numbers do not make a texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureModelError {
    /// The rate is outside 200 to 4000 Hz.
    #[error("a model rate must lie between 200 and 4000 Hz, got {rate_hz}")]
    Rate {
        /// The rate given.
        rate_hz: f64,
    },
    /// More nodes than a renderer can tell apart.
    #[error("a texture may have up to {max} measured speeds and forces, got {n}", max = MAX_NODES)]
    TooMany {
        /// The number given.
        n: usize,
    },
    /// There are no nodes.
    #[error("a texture needs at least one measured speed and force, got none")]
    Empty,
    /// Nodes differ in order, or the order cannot be rendered.
    #[error("node {index} has {order} line spectral frequencies; every node needs the same number, 1 to {max}", max = MAX_ORDER)]
    Order {
        /// Index of the node.
        index: usize,
        /// Its order.
        order: usize,
    },
    /// Frequencies are not ascending within (0, π).
    #[error("line spectral frequencies of node {index} do not ascend within 0 to pi")]
    Frequencies {
        /// Index of the node.
        index: usize,
    },
    /// A speed, force, level or friction is not a finite, non-negative number, or speed or force is zero.
    #[error("{what} of node {index} is {value}; it must be a positive number")]
    Value {
        /// What is wrong.
        what: &'static str,
        /// Index of the node.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The friction coefficient is not a finite, non-negative number.
    #[error("the friction coefficient is {value}; it must not be negative")]
    Friction {
        /// The value given.
        value: f64,
    },
}

impl TextureModel {
    /// A texture from its measured nodes; silent and saturated boundaries are added where it is rendered, not here.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub fn new(rate: Hertz, nodes: Vec<GrainNode>, friction: Option<f64>) -> Result<Self, TextureModelError> {
        if !(200.0..=4000.0).contains(&rate.0) {
            return Err(TextureModelError::Rate { rate_hz: rate.0 });
        }
        if nodes.len() > MAX_NODES {
            return Err(TextureModelError::TooMany { n: nodes.len() });
        }
        let Some(first) = nodes.first() else { return Err(TextureModelError::Empty) };
        let order = first.lsf.len();
        for (index, node) in nodes.iter().enumerate() {
            if node.lsf.len() != order || order == 0 || order > MAX_ORDER {
                return Err(TextureModelError::Order { index, order: node.lsf.len() });
            }
            let inside = |w: &f64| *w > 0.0 && *w < std::f64::consts::PI;
            if !node.lsf.iter().all(inside) || !node.lsf.windows(2).all(|w| w[0] < w[1]) {
                return Err(TextureModelError::Frequencies { index });
            }
            let values = [("speed", node.speed.0), ("force", node.force.0)];
            for (what, value) in values {
                if !(value.is_finite() && value > 0.0) {
                    return Err(TextureModelError::Value { what, index, value });
                }
            }
            if !(node.level_mps2.is_finite() && node.level_mps2 >= 0.0) {
                return Err(TextureModelError::Value { what: "level", index, value: node.level_mps2 });
            }
        }
        if let Some(value) = friction.filter(|f| !(f.is_finite() && *f >= 0.0)) {
            return Err(TextureModelError::Friction { value });
        }
        Ok(Self { rate, nodes, friction })
    }

    /// Samples a second of the model.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// Order of the predictor, the same at every node.
    pub fn order(&self) -> usize {
        self.nodes[0].lsf.len()
    }

    /// The measured nodes, at least one.
    pub fn nodes(&self) -> &[GrainNode] {
        &self.nodes
    }

    /// Kinetic friction coefficient, where it is known.
    pub fn friction(&self) -> Option<f64> {
        self.friction
    }

    /// The highest speed measured: above it the texture stays as it is there.
    pub fn speed_max(&self) -> MetersPerSecond {
        MetersPerSecond(self.nodes.iter().map(|n| n.speed.0).fold(0.0, f64::max))
    }

    /// The highest force measured: above it the texture stays as it is there.
    pub fn force_max(&self) -> Newtons {
        Newtons(self.nodes.iter().map(|n| n.force.0).fold(0.0, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::{GrainNode, TextureModel, TextureModelError};
    use crate::units::{Hertz, MetersPerSecond, Newtons};

    fn node(speed: f64, lsf: &[f64]) -> GrainNode {
        GrainNode { speed: MetersPerSecond(speed), force: Newtons(1.0), lsf: lsf.to_vec(), level_mps2: 1.0 }
    }

    #[test]
    fn bad_numbers_are_named() {
        let make =
            |rate: f64, nodes: Vec<GrainNode>| TextureModel::new(Hertz(rate), nodes, None).unwrap_err();
        assert_eq!(make(1000.0, vec![]), TextureModelError::Empty);
        assert_eq!(make(100.0, vec![node(0.1, &[1.0])]), TextureModelError::Rate { rate_hz: 100.0 });
        let many = vec![node(0.1, &[1.0]); 20_001];
        assert_eq!(make(1000.0, many), TextureModelError::TooMany { n: 20_001 });
        let orders = vec![node(0.1, &[1.0]), node(0.2, &[1.0, 2.0])];
        assert_eq!(make(1000.0, orders), TextureModelError::Order { index: 1, order: 2 });
        assert_eq!(make(1000.0, vec![node(0.1, &[2.0, 1.0])]), TextureModelError::Frequencies { index: 0 });
        assert_eq!(make(1000.0, vec![node(0.1, &[f64::NAN])]), TextureModelError::Frequencies { index: 0 });
        let zero = TextureModelError::Value { what: "speed", index: 0, value: 0.0 };
        assert_eq!(make(1000.0, vec![node(0.0, &[1.0])]), zero);
    }
}
