//! Texture model: vibration and friction of a surface over tip speed and normal force.

mod check;
mod error;
mod layers;

use std::sync::Arc;

use crate::texture::limits::MAX_RADIAL_NODES;
use crate::texture::model::layers::TextureLayers;
use crate::texture::relief::Relief;
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

pub(in crate::texture) use crate::texture::model::check::decays;
pub use crate::texture::model::error::TextureModelError;

/// Grain node: the stochastic vibration at one speed and force, as an autoregressive (AR) process.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainNode {
    /// Tip speed of the measurement.
    pub speed: MetersPerSecond,
    /// Normal force of the measurement.
    pub force: Newtons,
    /// Line spectral frequencies in radians (0, π), ascending.
    pub lsf: Vec<f64>,
    /// Output level: root mean square acceleration in m/s².
    pub level_mps2: f64,
}

/// Grain node of a published model from the Penn Haptic Texture Toolkit: stochastic vibration at one speed and force.
///
/// `y[t] = -Σ a_i y[t-i] + gain (e[t] + Σ b_j e[t-j])` with white noise `e` (H. Culbertson, J. Lopez Delgado and K.
/// Kuchenbecker, "One hundred data-driven haptic texture models and open-source methods for rendering on 3D objects",
/// 2014).
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedNode {
    /// Tip speed; zero on the boundary.
    pub speed: MetersPerSecond,
    /// Normal force; zero on the boundary.
    pub force: Newtons,
    /// Line spectral frequencies of the AR part `a` in radians (0, π), ascending.
    pub ar_lsf: Vec<f64>,
    /// Line spectral frequencies of the moving-average part `b` in radians (0, π), ascending; empty without such a
    /// part.
    pub ma_lsf: Vec<f64>,
    /// Variance of `e` in (m/s²)²; usually zero at zero speed and at zero force.
    pub variance: f64,
    /// Output gain, dimensionless.
    pub gain: f64,
}

/// Interpolation of the grain between measured speeds and forces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Barycentric in the Delaunay triangles of the measured nodes; the level is interpolated linearly.
    #[default]
    Barycentric,
    /// Linear radial basis functions through all nodes, over line spectral frequencies and the logarithm of the level.
    RadialBasis,
}

/// Nodes that define a texture's grain, its stochastic vibration; the grain between them is interpolated.
#[derive(Clone, Debug, PartialEq)]
pub enum Grain {
    /// Nodes at measured speeds and forces; rendering adds the boundary around them.
    Measured {
        /// Nodes, at least one.
        nodes: Vec<GrainNode>,
        /// Interpolation between the nodes.
        interpolation: Interpolation,
    },
    /// Published nodes, which include the boundary and cover zero to the highest speed and force. Frequencies, variance
    /// and gain are each interpolated linearly in the Delaunay triangles.
    Published {
        /// Nodes, at least the four corners.
        nodes: Vec<PublishedNode>,
    },
}

/// Texture model: grain over (speed, force), friction, tap transient, relief and direction.
///
/// A texture has its own axes. Its lay, the direction of its grain or brushing, runs along y, as in its picture. The nodes
/// of [`Grain`] are for strokes across the lay. A texture without [`TextureModel::along`] is isotropic.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureModel {
    rate: Hertz,
    grain: Grain,
    friction: Option<f64>,
    layers: TextureLayers,
}

impl TextureModel {
    /// Creates a texture from measured nodes, with barycentric interpolation. The boundary nodes
    /// ([`crate::texture::boundary`]) are added for rendering, not here.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub fn new(rate: Hertz, nodes: Vec<GrainNode>, friction: Option<f64>) -> Result<Self, TextureModelError> {
        let made = Self::blended(rate, nodes, friction)?;
        made.check_stable()?;
        Ok(made)
    }

    /// Checks that the filters of measured nodes, also along the lay, do not grow in the renderer, as
    /// [`TextureModel::new`] and [`TextureModel::with_along`] do.
    ///
    /// # Errors
    /// [`TextureModelError::Unstable`], for the grain along the lay within [`TextureModelError::InAlong`].
    pub fn check_stable(&self) -> Result<(), TextureModelError> {
        check::stable(self.nodes())?;
        check::stable_along(self.along().unwrap_or_default())
    }

    /// As [`TextureModel::new`], for a blend of textures, which is made at each movement of a point. Its filters are not
    /// judged again: means of line spectral frequencies are no closer together than those of one of the textures, and
    /// fits to mean spectra are smooth. A filter that grows all the same ends in the limiter.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub(crate) fn blended(
        rate: Hertz,
        nodes: Vec<GrainNode>,
        friction: Option<f64>,
    ) -> Result<Self, TextureModelError> {
        check::frame(rate, nodes.len(), friction)?;
        check::measured(&nodes)?;
        let grain = Grain::Measured { nodes, interpolation: Interpolation::Barycentric };
        Ok(Self { rate, grain, friction, layers: TextureLayers::default() })
    }

    /// Creates a texture from published nodes, which include the boundary. Every corner of the rectangle from zero to
    /// the highest speed and force needs a node, within [`MIN_NODE_DISTANCE`](crate::texture::MIN_NODE_DISTANCE).
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
        Ok(Self { rate, grain: Grain::Published { nodes }, friction, layers: TextureLayers::default() })
    }

    /// Returns the texture with another interpolation of its measured nodes.
    ///
    /// # Errors
    /// [`TextureModelError::Published`] for a published texture, [`TextureModelError::TooManyForRadialBasis`] above
    /// [`MAX_RADIAL_NODES`].
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

    /// Returns the texture with another friction coefficient.
    ///
    /// # Errors
    /// [`TextureModelError::Friction`] if it is out of range.
    pub fn with_friction(mut self, friction: Option<f64>) -> Result<Self, TextureModelError> {
        check::frame(self.rate, self.n_nodes(), friction)?;
        self.friction = friction;
        Ok(self)
    }

    /// Creates a texture with a relief and no grain. `rate` is the model rate; the relief is rendered up to half of it.
    ///
    /// # Errors
    /// [`TextureModelError`] if the rate is out of range.
    pub fn of_relief(relief: Arc<Relief>, rate: Hertz) -> Result<Self, TextureModelError> {
        // One node of zero level; its spectrum has no effect.
        let (speed, force) = (MetersPerSecond(0.1), relief.force());
        let node = GrainNode { speed, force, lsf: vec![1.0, 2.0], level_mps2: 0.0 };
        Ok(Self::new(rate, vec![node], None)?.with_relief(Some(relief)))
    }

    /// Model rate.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// Nodes of the grain.
    pub fn grain(&self) -> &Grain {
        &self.grain
    }

    /// Measured nodes, at least one; empty for a published texture.
    pub fn nodes(&self) -> &[GrainNode] {
        match &self.grain {
            Grain::Measured { nodes, .. } => nodes,
            Grain::Published { .. } => &[],
        }
    }

    /// Published nodes including the boundary; empty for a measured texture.
    pub fn published_nodes(&self) -> &[PublishedNode] {
        match &self.grain {
            Grain::Measured { .. } => &[],
            Grain::Published { nodes } => nodes,
        }
    }

    /// Speed and force of each node, measured or published.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + Clone + '_ {
        let measured = self.nodes().iter().map(|n| Contact { speed: n.speed, force: n.force });
        measured.chain(self.published_nodes().iter().map(|n| Contact { speed: n.speed, force: n.force }))
    }

    /// Number of nodes, measured or published.
    pub fn n_nodes(&self) -> usize {
        self.nodes().len() + self.published_nodes().len()
    }

    /// Order of the AR part, the same at every node.
    pub fn order(&self) -> usize {
        match &self.grain {
            Grain::Measured { nodes, .. } => nodes[0].lsf.len(),
            Grain::Published { nodes } => nodes[0].ar_lsf.len(),
        }
    }

    /// Order of the moving-average part, the same at every node; zero for measured textures.
    pub fn ma_order(&self) -> usize {
        self.published_nodes().first().map_or(0, |node| node.ma_lsf.len())
    }

    /// Kinetic friction coefficient, dimensionless, if known.
    pub fn friction(&self) -> Option<f64> {
        self.friction
    }

    /// Interpolation between measured nodes; `None` for a published texture.
    pub fn interpolation(&self) -> Option<Interpolation> {
        match self.grain {
            Grain::Measured { interpolation, .. } => Some(interpolation),
            Grain::Published { .. } => None,
        }
    }

    /// Highest speed of a node; above it the texture is constant.
    pub fn speed_max(&self) -> MetersPerSecond {
        MetersPerSecond(self.contacts().map(|c| c.speed.0).fold(0.0, f64::max))
    }

    /// Highest force of a node; above it the texture is constant.
    pub fn force_max(&self) -> Newtons {
        Newtons(self.contacts().map(|c| c.force.0).fold(0.0, f64::max))
    }
}

#[cfg(test)]
pub(crate) mod test_textures;
#[cfg(test)]
mod tests;
