//! A texture: what a surface does to a tip at every speed and force.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

use crate::tap::Tap;
use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Highest order of a predictor that can be rendered.
pub const MAX_ORDER: usize = shagreen_synth::texture::MAX_ORDER;

/// Most nodes of a texture: with its boundary, twice as many triangles still have 16-bit numbers in the renderer.
pub const MAX_NODES: usize = 20_000;

/// Speeds that a node may have, in m/s: wide enough for any hand, and usable numbers in the renderer's `f32`.
pub const SPEEDS_MPS: RangeInclusive<f64> = 1e-6..=100.0;

/// Forces that a node may have, in N.
pub const FORCES_N: RangeInclusive<f64> = 1e-6..=1e4;

/// Levels that a node may have, in m/s².
pub const LEVELS_MPS2: RangeInclusive<f64> = 0.0..=1e6;

/// Smallest distance between neighboring line spectral frequencies, and from 0 and π, in radians: 40 times the spacing
/// of `f32` near π, so that they are still apart in the renderer.
pub const MIN_LSF_GAP: f64 = 1e-5;

/// Smallest distance of nodes from each other, and from zero speed and force, as a share of the highest speed and
/// force: the triangles between are flatter the nearer nodes are, and `f32` must still tell their insides apart.
pub const MIN_NODE_DISTANCE: f64 = 1e-4;

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

/// How grain is interpolated between the speeds and forces that were measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in the Delaunay triangles of the measured nodes; levels are interpolated as levels.
    #[default]
    Barycentric,
    /// A linear radial basis function through all nodes, over line spectral frequencies and the logarithm of the level.
    RadialBasis,
    /// As the published renderer of the Penn Haptic Texture Toolkit does it: nodes that include the boundary, frequencies,
    /// variance and gain each linear in the triangles.
    Published,
}

/// A texture model: grain over (speed, force), and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureModel {
    rate: Hertz,
    nodes: Vec<GrainNode>,
    friction: Option<f64>,
    interpolation: Interpolation,
    tap: Option<Tap>,
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
    /// Frequencies are not ascending within (0, π) by at least [`MIN_LSF_GAP`].
    #[error("line spectral frequencies of node {index} do not ascend within 0 to pi by at least {gap} rad each", gap = MIN_LSF_GAP)]
    Frequencies {
        /// Index of the node.
        index: usize,
    },
    /// A speed, force or level is not a number from the lowest to the highest that can be rendered.
    #[error("{what} of node {index} is {value}; it must lie between {low} and {high}")]
    Value {
        /// What is wrong, with its unit.
        what: &'static str,
        /// Index of the node.
        index: usize,
        /// Its value.
        value: f64,
        /// Lowest that is possible beside the other nodes.
        low: f64,
        /// Highest that is possible.
        high: f64,
    },
    /// Two nodes are at the same speed and force, or nearer than [`MIN_NODE_DISTANCE`].
    #[error("nodes {first} and {second} are at the same speed and force, to within {share} of the highest; keep one of them", share = MIN_NODE_DISTANCE)]
    SamePlace {
        /// Index of the one.
        first: usize,
        /// Index of the other.
        second: usize,
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
            if !are_apart(&node.lsf) {
                return Err(TextureModelError::Frequencies { index });
            }
            check_range("speed in m/s", index, node.speed.0, &SPEEDS_MPS)?;
            check_range("force in N", index, node.force.0, &FORCES_N)?;
            check_range("level in m/s²", index, node.level_mps2, &LEVELS_MPS2)?;
        }
        check_places(&nodes)?;
        if let Some(value) = friction.filter(|f| !(f.is_finite() && *f >= 0.0)) {
            return Err(TextureModelError::Friction { value });
        }
        Ok(Self { rate, nodes, friction, interpolation: Interpolation::default(), tap: None })
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

    /// How grain is interpolated between nodes.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The transient of a landing, where it was measured.
    pub fn tap(&self) -> Option<Tap> {
        self.tap
    }

    /// The same texture with a landing.
    #[must_use]
    pub fn with_tap(mut self, tap: Option<Tap>) -> Self {
        self.tap = tap;
        self
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

fn are_apart(lsf: &[f64]) -> bool {
    // Not written as a comparison of gaps with a bound: what is not a number must be refused.
    let ends = [0.0, PI];
    let above = ends[..1].iter().chain(lsf).zip(lsf.iter().chain(&ends[1..]));
    above.into_iter().all(|(low, high)| high - low >= MIN_LSF_GAP)
}

fn check_range(
    what: &'static str,
    index: usize,
    value: f64,
    range: &RangeInclusive<f64>,
) -> Result<(), TextureModelError> {
    let (low, high) = (*range.start(), *range.end());
    if range.contains(&value) {
        Ok(())
    } else {
        Err(TextureModelError::Value { what, index, value, low, high })
    }
}

/// Whether nodes lie far enough from zero speed and force, where others join them, and from each other.
fn check_places(nodes: &[GrainNode]) -> Result<(), TextureModelError> {
    let highest = |value: &dyn Fn(&GrainNode) -> f64| nodes.iter().map(value).fold(0.0, f64::max);
    let (speed_max, force_max) = (highest(&|n| n.speed.0), highest(&|n| n.force.0));
    // Cells as wide as the smallest distance: whoever is too near is in the same cell or in one around it.
    let mut in_cell = BTreeMap::new();
    for (index, node) in nodes.iter().enumerate() {
        check_range("speed in m/s", index, node.speed.0, &(MIN_NODE_DISTANCE * speed_max..=speed_max))?;
        check_range("force in N", index, node.force.0, &(MIN_NODE_DISTANCE * force_max..=force_max))?;
        let at = [node.speed.0 / speed_max, node.force.0 / force_max].map(|c| c / MIN_NODE_DISTANCE);
        let cell = at.map(|c| c as i64);
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            if let Some((first, other)) = in_cell.get(&[cell[0] + dx, cell[1] + dy]) {
                let other: &[f64; 2] = other;
                if (at[0] - other[0]).abs().max((at[1] - other[1]).abs()) < 1.0 {
                    return Err(TextureModelError::SamePlace { first: *first, second: index });
                }
            }
        }
        in_cell.insert(cell, (index, at));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{GrainNode, LEVELS_MPS2, TextureModel, TextureModelError};
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
        // One ulp of f32 apart, and as near to the ends.
        for lsf in [[1.0, 1.0 + 1e-7], [1e-7, 1.0], [1.0, std::f64::consts::PI - 1e-7]] {
            assert_eq!(make(1000.0, vec![node(0.1, &lsf)]), TextureModelError::Frequencies { index: 0 });
        }
    }

    #[test]
    fn numbers_that_cannot_be_rendered_are_refused_with_their_range() {
        let error = |node: GrainNode| TextureModel::new(Hertz(1000.0), vec![node], None).unwrap_err();
        for bad in [0.0, -1.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
            let text = error(node(bad, &[1.0])).to_string();
            assert!(text.starts_with("speed in m/s of node 0") && text.ends_with("and 100"), "{text}");
            let text = error(GrainNode { force: Newtons(bad), ..node(0.1, &[1.0]) }).to_string();
            assert!(text.starts_with("force in N of node 0") && text.ends_with("and 10000"), "{text}");
        }
        for bad in [-1.0, 1e300, f64::NAN, f64::INFINITY] {
            let error = error(GrainNode { level_mps2: bad, ..node(0.1, &[1.0]) });
            let TextureModelError::Value { what, low, high, .. } = error else { panic!("{error}") };
            assert_eq!((what, low..=high), ("level in m/s²", LEVELS_MPS2));
        }
    }

    #[test]
    fn nodes_at_one_place_are_refused_and_neighbors_are_not() {
        let make = |places: &[[f64; 2]]| {
            let at = |[speed, force]: &[f64; 2]| GrainNode { force: Newtons(*force), ..node(*speed, &[1.0]) };
            TextureModel::new(Hertz(1000.0), places.iter().map(at).collect(), None).err()
        };
        let far = [0.2, 2.0];
        let same = Some(TextureModelError::SamePlace { first: 1, second: 2 });
        assert_eq!(make(&[far, [0.1, 1.0], [0.1, 1.0]]), same);
        // A hundredth of a percent of 0.2 m/s and of 2 N, just less and just more, across the border of a cell too.
        for speed in [0.1, 0.10001, 0.100_019] {
            assert_eq!(make(&[far, [speed, 1.0], [speed + 1.9e-5, 1.0 - 1.9e-4]]), same);
            assert_eq!(make(&[far, [speed, 1.0], [speed + 2.1e-5, 1.0]]), None);
            assert_eq!(make(&[far, [speed, 1.0], [speed, 1.0 + 2.1e-4]]), None);
        }
        // So near to zero speed that silence lies at the same place.
        assert!(matches!(make(&[far, [1e-5, 1.0]]), Some(TextureModelError::Value { index: 1, .. })));
    }
}
