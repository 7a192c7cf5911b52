//! Errors of texture models.

use crate::texture::{
    MAX_MA_ORDER, MAX_NODES, MAX_ORDER, MAX_RADIAL_NODES, MIN_LSF_GAP, MIN_NODE_DISTANCE,
    MIN_PUBLISHED_LSF_GAP,
};

/// Error of creating a texture model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureModelError {
    /// The model rate is outside 200 to 4000 Hz.
    #[error("a model rate must lie between 200 and 4000 Hz, got {rate_hz}")]
    Rate {
        /// Requested rate, in Hz.
        rate_hz: f64,
    },
    /// There are more nodes than the renderer can index.
    #[error("a texture may have up to {max} nodes of speed and force, got {n}; remove some", max = MAX_NODES)]
    TooMany {
        /// Number of nodes.
        n: usize,
    },
    /// There are no nodes.
    #[error("a texture needs at least one node of speed and force, got none")]
    Empty,
    /// Nodes differ in predictor order, or the order is not supported.
    #[error("node {index} has {order} line spectral frequencies; every node needs the same number, 1 to {max}", max = MAX_ORDER)]
    Order {
        /// Index of the node.
        index: usize,
        /// Predictor order of the node.
        order: usize,
    },
    /// Line spectral frequencies do not ascend within (0, π) by at least [`MIN_LSF_GAP`].
    #[error("line spectral frequencies of node {index} do not ascend within 0 to pi by at least {gap} rad each", gap = MIN_LSF_GAP)]
    Frequencies {
        /// Index of the node.
        index: usize,
    },
    /// The filter of a node would grow instead of decay in the renderer.
    #[error(
        "line spectral frequencies of node {index} are so close together that its filter is unstable in single precision; use a lower order, or fit the node again"
    )]
    Unstable {
        /// Index of the node.
        index: usize,
    },
    /// A speed, force, level, variance or gain is out of range or not finite.
    #[error("{what} of node {index} is {value}; it must lie between {low} and {high}")]
    Value {
        /// Quantity that is out of range, with its unit.
        what: &'static str,
        /// Index of the node.
        index: usize,
        /// Value of the quantity.
        value: f64,
        /// Lowest valid value; for speed and force, it depends on the other nodes.
        low: f64,
        /// Highest valid value.
        high: f64,
    },
    /// Two nodes have the same speed and force, or are closer than [`MIN_NODE_DISTANCE`].
    #[error("nodes {first} and {second} have the same speed and force, within {share} of the highest; keep one of them", share = MIN_NODE_DISTANCE)]
    SamePlace {
        /// Index of the first node.
        first: usize,
        /// Index of the second node.
        second: usize,
    },
    /// Nodes of a published texture differ in the order of their moving-average part, or the order is not supported.
    #[error("node {index} has {order} line spectral frequencies of its moving-average part; every node needs the same number, 0 to {max}", max = MAX_MA_ORDER)]
    MaOrder {
        /// Index of the node.
        index: usize,
        /// Moving-average order of the node.
        order: usize,
    },
    /// Line spectral frequencies of a published texture do not ascend within (0, π) by at least
    /// [`MIN_PUBLISHED_LSF_GAP`].
    #[error("{part} line spectral frequencies of node {index} do not ascend within 0 to pi by at least {gap} rad each", gap = MIN_PUBLISHED_LSF_GAP)]
    PublishedFrequencies {
        /// `AR` or `MA`.
        part: &'static str,
        /// Index of the node.
        index: usize,
    },
    /// A published texture has no node at a corner of its speed-force range.
    #[error(
        "no node lies at {speed_mps} m/s and {force_n} N; a published texture needs a node at every corner of its range"
    )]
    Corner {
        /// Speed of the corner, in m/s.
        speed_mps: f64,
        /// Force of the corner, in N.
        force_n: f64,
    },
    /// There are more nodes than radial basis interpolation supports.
    #[error("radial basis interpolation supports up to {max} nodes, got {n}; use barycentric interpolation", max = MAX_RADIAL_NODES)]
    TooManyForRadialBasis {
        /// Number of nodes.
        n: usize,
    },
    /// The interpolation of a published texture is fixed.
    #[error("the interpolation of a published texture is fixed; only measured textures have a choice")]
    Published,
    /// A published texture cannot have a grain along its lay.
    #[error(
        "a published texture feels the same in all directions; only a measured texture can have a grain along its lay"
    )]
    AlongPublished,
    /// The grain along the lay has another number of nodes than that across it.
    #[error(
        "the grain along the lay has {n} nodes, and that across it {expected}; give both the same speeds and forces"
    )]
    AlongCount {
        /// Number of nodes along the lay.
        n: usize,
        /// Number of nodes across it.
        expected: usize,
    },
    /// A node of the grain along the lay has another speed, force or order than the node across it.
    #[error(
        "{what} of node {index} is {value} along the lay and {expected} across it; give both the same speeds, forces and order, in the same sequence"
    )]
    Along {
        /// Quantity that differs, with its unit.
        what: &'static str,
        /// Index of the node.
        index: usize,
        /// Value along the lay.
        value: f64,
        /// Value across the lay.
        expected: f64,
    },
    /// The grain along the lay has another error.
    #[error("the grain along the lay is not valid")]
    InAlong(#[source] Box<TextureModelError>),
    /// The friction coefficient is negative or not finite.
    #[error("the friction coefficient is {value}; it must be finite and not negative")]
    Friction {
        /// Value of the coefficient.
        value: f64,
    },
}
