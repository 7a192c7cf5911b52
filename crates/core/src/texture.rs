//! A texture: what a surface does to a tip at every speed and force.

mod check;
mod error;

use std::ops::RangeInclusive;
use std::sync::Arc;

use crate::relief::Relief;
use crate::tap::Tap;
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

pub use crate::texture::error::TextureModelError;

/// Highest order of a predictor that can be rendered.
pub const MAX_ORDER: usize = shagreen_synth::texture::MAX_ORDER;

/// Most nodes of a texture: with its boundary, twice as many triangles still have 16-bit numbers in the renderer.
pub const MAX_NODES: usize = 20_000;

/// Most nodes of a texture with a radial basis, whose system of equations takes as many cubed multiplications.
pub const MAX_RADIAL_NODES: usize = 500;

/// Rates that a model may have, in Hz.
pub const RATES_HZ: RangeInclusive<f64> = 200.0..=4000.0;

/// Speeds that a node may have, in m/s: wide enough for any hand, and usable numbers in the renderer's `f32`.
pub const SPEEDS_MPS: RangeInclusive<f64> = 1e-6..=100.0;

/// Forces that a node may have, in N.
pub const FORCES_N: RangeInclusive<f64> = 1e-6..=1e4;

/// Levels that a node may have, in m/s².
pub const LEVELS_MPS2: RangeInclusive<f64> = 0.0..=1e6;

/// Variances that a published node may have, in (m/s²)².
pub const VARIANCES: RangeInclusive<f64> = 0.0..=1e12;

/// Gains that a published node may have.
pub const GAINS: RangeInclusive<f64> = 0.0..=1e6;

/// Smallest distance between neighboring line spectral frequencies, and from 0 and π, in radians: 40 times the spacing
/// of `f32` near π, so that they are still apart in the renderer.
pub const MIN_LSF_GAP: f64 = 1e-5;

/// The same between frequencies of a published texture: half of the last of the six decimals that are published, and
/// still twice the spacing of `f32` near π.
pub const MIN_PUBLISHED_LSF_GAP: f64 = 5e-7;

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

/// The stochastic vibration at one speed and force as the Penn Haptic Texture Toolkit publishes it:
/// `y[t] = -Σ a_i y[t-i] + gain (e[t] + Σ b_j e[t-j])` with white `e` (H. Culbertson, J. Lopez Delgado and
/// K. Kuchenbecker, "One hundred data-driven haptic texture models and open-source methods for rendering on 3D objects",
/// 2014).
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedNode {
    /// Speed; zero on the boundary.
    pub speed: MetersPerSecond,
    /// Normal force; zero on the boundary.
    pub force: Newtons,
    /// Line spectral frequencies of the predictor `a` in radians (0, π), ascending.
    pub ar_lsf: Vec<f64>,
    /// Line spectral frequencies of the moving average `b` in radians (0, π), ascending; none where there is none.
    pub ma_lsf: Vec<f64>,
    /// Variance of `e` in (m/s²)²; zero is usual on the axes of zero speed and force.
    pub variance: f64,
    /// `gain`, without a unit.
    pub gain: f64,
}

/// How grain is interpolated between the speeds and forces that were measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in the Delaunay triangles of the measured nodes; levels are interpolated as levels.
    #[default]
    Barycentric,
    /// A linear radial basis function through all nodes, over line spectral frequencies and the logarithm of the level.
    RadialBasis,
}

/// What is known of a texture's grain, and what lies between follows from.
#[derive(Clone, Debug, PartialEq)]
pub enum Grain {
    /// Measured speeds and forces; the boundary around them is added where the texture is rendered.
    Measured {
        /// At least one.
        nodes: Vec<GrainNode>,
        /// How to find what lies between.
        interpolation: Interpolation,
    },
    /// Published nodes, which include the boundary and cover the plane from zero to the highest speed and force:
    /// frequencies, variance and gain are each linear in their Delaunay triangles.
    Published {
        /// At least the four corners.
        nodes: Vec<PublishedNode>,
    },
}

/// A texture model: grain over (speed, force), and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureModel {
    rate: Hertz,
    grain: Grain,
    friction: Option<f64>,
    tap: Option<Tap>,
    /// Shared with planes and blends: it is long.
    relief: Option<Arc<Relief>>,
}

impl TextureModel {
    /// A texture from its measured nodes, interpolated in triangles; silent and saturated boundaries are added where it
    /// is rendered, not here.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub fn new(rate: Hertz, nodes: Vec<GrainNode>, friction: Option<f64>) -> Result<Self, TextureModelError> {
        check::frame(rate, nodes.len(), friction)?;
        check::measured(&nodes)?;
        let grain = Grain::Measured { nodes, interpolation: Interpolation::Barycentric };
        Ok(Self { rate, grain, friction, tap: None, relief: None })
    }

    /// A texture from published nodes, which include the boundary: one at each corner of the rectangle from zero to the
    /// highest speed and force, to within [`MIN_NODE_DISTANCE`].
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub fn published(
        rate: Hertz,
        nodes: Vec<PublishedNode>,
        friction: Option<f64>,
    ) -> Result<Self, TextureModelError> {
        check::frame(rate, nodes.len(), friction)?;
        check::published(&nodes)?;
        Ok(Self { rate, grain: Grain::Published { nodes }, friction, tap: None, relief: None })
    }

    /// The same measured nodes, interpolated in this way.
    ///
    /// # Errors
    /// [`TextureModelError::Published`], and [`TextureModelError::TooManyForRadialBasis`] above [`MAX_RADIAL_NODES`].
    pub fn with_interpolation(mut self, wanted: Interpolation) -> Result<Self, TextureModelError> {
        let Grain::Measured { nodes, interpolation } = &mut self.grain else {
            return Err(TextureModelError::Published);
        };
        if wanted == Interpolation::RadialBasis && nodes.len() > MAX_RADIAL_NODES {
            return Err(TextureModelError::TooManyForRadialBasis { n: nodes.len() });
        }
        *interpolation = wanted;
        Ok(self)
    }

    /// The same texture with a landing.
    #[must_use]
    pub fn with_tap(mut self, tap: Option<Tap>) -> Self {
        self.tap = tap;
        self
    }

    /// The same texture with a relief.
    #[must_use]
    pub fn with_relief(mut self, relief: Option<Arc<Relief>>) -> Self {
        self.relief = relief;
        self
    }

    /// A texture that is silent but for its relief, with so many samples a second: a relief is played up to half of them.
    ///
    /// # Errors
    /// [`TextureModelError`], where no texture has this rate.
    pub fn of_relief(relief: Arc<Relief>, rate: Hertz) -> Result<Self, TextureModelError> {
        // One node of no level: whatever its shape, nothing is heard of it.
        let (speed, force) = (MetersPerSecond(0.1), relief.force());
        let node = GrainNode { speed, force, lsf: vec![1.0, 2.0], level_mps2: 0.0 };
        Ok(Self::new(rate, vec![node], None)?.with_relief(Some(relief)))
    }

    /// Samples a second of the model.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// What is known of the grain.
    pub fn grain(&self) -> &Grain {
        &self.grain
    }

    /// The measured nodes, at least one; none where the texture is published.
    pub fn nodes(&self) -> &[GrainNode] {
        match &self.grain {
            Grain::Measured { nodes, .. } => nodes,
            Grain::Published { .. } => &[],
        }
    }

    /// The published nodes with their boundary; none where the texture is measured.
    pub fn published_nodes(&self) -> &[PublishedNode] {
        match &self.grain {
            Grain::Measured { .. } => &[],
            Grain::Published { nodes } => nodes,
        }
    }

    /// Speed and force of every node, measured or published.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + Clone + '_ {
        let measured = self.nodes().iter().map(|n| Contact { speed: n.speed, force: n.force });
        measured.chain(self.published_nodes().iter().map(|n| Contact { speed: n.speed, force: n.force }))
    }

    /// How many nodes there are, measured or published.
    pub fn n_nodes(&self) -> usize {
        self.nodes().len() + self.published_nodes().len()
    }

    /// Order of the predictor, the same at every node.
    pub fn order(&self) -> usize {
        match &self.grain {
            Grain::Measured { nodes, .. } => nodes[0].lsf.len(),
            Grain::Published { nodes } => nodes[0].ar_lsf.len(),
        }
    }

    /// Order of the moving average, the same at every node; zero where there is none, as in everything measured.
    pub fn ma_order(&self) -> usize {
        self.published_nodes().first().map_or(0, |node| node.ma_lsf.len())
    }

    /// Kinetic friction coefficient, where it is known.
    pub fn friction(&self) -> Option<f64> {
        self.friction
    }

    /// How grain is interpolated between measured nodes; `None` where the texture is published.
    pub fn interpolation(&self) -> Option<Interpolation> {
        match self.grain {
            Grain::Measured { interpolation, .. } => Some(interpolation),
            Grain::Published { .. } => None,
        }
    }

    /// The transient of a landing, where it was measured.
    pub fn tap(&self) -> Option<Tap> {
        self.tap
    }

    /// What lies at each place of it, where anything does.
    pub fn relief(&self) -> Option<&Arc<Relief>> {
        self.relief.as_ref()
    }

    /// The highest speed of a node: above it the texture stays as it is there.
    pub fn speed_max(&self) -> MetersPerSecond {
        MetersPerSecond(self.contacts().map(|c| c.speed.0).fold(0.0, f64::max))
    }

    /// The highest force of a node: above it the texture stays as it is there.
    pub fn force_max(&self) -> Newtons {
        Newtons(self.contacts().map(|c| c.force.0).fold(0.0, f64::max))
    }
}

#[cfg(test)]
pub(crate) mod test_textures;
#[cfg(test)]
mod tests;
