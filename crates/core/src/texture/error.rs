//! Why numbers do not make a texture.

use crate::texture::{
    MAX_NODES, MAX_ORDER, MAX_RADIAL_NODES, MIN_LSF_GAP, MIN_NODE_DISTANCE, MIN_PUBLISHED_LSF_GAP,
};

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
    /// Nodes of a published texture differ in the order of their moving average, or it cannot be rendered.
    #[error("node {index} has {order} line spectral frequencies of its moving average; every node needs the same number, 0 to {max}", max = MAX_ORDER)]
    MaOrder {
        /// Index of the node.
        index: usize,
        /// Its order.
        order: usize,
    },
    /// Frequencies of a published texture are not ascending within (0, π) by at least [`MIN_PUBLISHED_LSF_GAP`].
    #[error("{part} line spectral frequencies of node {index} do not ascend within 0 to pi by at least {gap} rad each", gap = MIN_PUBLISHED_LSF_GAP)]
    PublishedFrequencies {
        /// `AR` or `MA`.
        part: &'static str,
        /// Index of the node.
        index: usize,
    },
    /// A published texture lacks a node at a corner of its plane.
    #[error(
        "no node lies at {speed_mps} m/s and {force_n} N; a published texture needs one at every corner of its plane"
    )]
    Corner {
        /// Speed of the corner, in m/s.
        speed_mps: f64,
        /// Force of the corner, in N.
        force_n: f64,
    },
    /// More nodes than a radial basis is worked out for.
    #[error("a radial basis may have up to {max} measured speeds and forces, got {n}; interpolate in triangles instead", max = MAX_RADIAL_NODES)]
    TooManyForRadialBasis {
        /// The number given.
        n: usize,
    },
    /// The way of interpolation of a published texture cannot be chosen.
    #[error("a published texture is interpolated as it was published; only measured ones have a choice")]
    Published,
    /// The friction coefficient is not a finite, non-negative number.
    #[error("the friction coefficient is {value}; it must not be negative")]
    Friction {
        /// The value given.
        value: f64,
    },
}
