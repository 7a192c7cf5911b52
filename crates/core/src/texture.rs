//! Texture models: vibration, friction and contact transients of a surface over tip speed and force, and their
//! rendering.
//!
//! Input: nodes of (speed, force) with line spectral frequencies and levels, a tap transient, friction and a relief
//! ([`TextureModel`]). Output: interpolated spectra ([`plane::Plane`]), textures prepared for the renderer
//! ([`plane::Prepared`]) and rendered acceleration ([`render::render`]).

pub mod blend;
pub mod boundary;
pub mod height_map;
mod limits;
mod model;
pub mod patterns;
pub mod plane;
pub mod profile;
pub mod rate;
mod refit;
pub mod relief;
pub mod render;
pub mod shape;
pub mod steady_stick_slip;
pub mod stick_slip;
pub mod tap;

pub use crate::texture::limits::{
    FORCES_N, GAINS, LEVELS_MPS2, MAX_MA_ORDER, MAX_NODES, MAX_ORDER, MAX_RADIAL_NODES, MIN_LSF_GAP,
    MIN_NODE_DISTANCE, MIN_PUBLISHED_LSF_GAP, RATES_HZ, SPEEDS_MPS, VARIANCES,
};
#[cfg(test)]
pub(crate) use crate::texture::model::test_textures;
pub use crate::texture::model::{
    Grain, GrainNode, Interpolation, PublishedNode, TextureModel, TextureModelError,
};
