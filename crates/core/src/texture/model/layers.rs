//! Layers of a texture model beside its grain across the lay and its friction coefficient.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use crate::texture::height_map::HeightMap;
use crate::texture::model::{Grain, GrainNode, TextureModel, TextureModelError, check};
use crate::texture::relief::Relief;
use crate::texture::stick_slip::StickSlip;
use crate::texture::tap::Tap;

/// What a texture has beside its grain across the lay and its friction coefficient.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TextureLayers {
    tap: Option<Tap>,
    /// Shared with planes and blends, because it is large, as the next two.
    relief: Option<Arc<Relief>>,
    along: Option<Arc<[GrainNode]>>,
    height_map: Option<Arc<HeightMap>>,
    stick_slip: Option<StickSlip>,
    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    turn_rad: f64,
}

impl TextureModel {
    /// Returns the texture with this tap transient.
    #[must_use]
    pub fn with_tap(mut self, tap: Option<Tap>) -> Self {
        self.layers.tap = tap;
        self
    }

    /// Returns the texture with this relief.
    #[must_use]
    pub fn with_relief(mut self, relief: Option<Arc<Relief>>) -> Self {
        self.layers.relief = relief;
        self
    }

    /// Returns the texture with this grain for strokes along the lay (the texture's y axis), or without one. The nodes
    /// must have the speeds, forces and order of the texture's own measured nodes, in the same sequence.
    ///
    /// # Errors
    /// [`TextureModelError::AlongPublished`] for a published texture, [`TextureModelError::AlongCount`] and
    /// [`TextureModelError::Along`] for other speeds, forces or another order, and the errors of [`TextureModel::new`] for
    /// these nodes within [`TextureModelError::InAlong`].
    pub fn with_along(mut self, nodes: Option<Vec<GrainNode>>) -> Result<Self, TextureModelError> {
        let Some(nodes) = nodes else {
            self.layers.along = None;
            return Ok(self);
        };
        let model = self.with_blended_along(nodes)?;
        check::stable_along(model.along().unwrap_or_default())?;
        Ok(model)
    }

    /// As [`TextureModel::with_along`], for a blend of textures; its filters are not judged, as in
    /// [`TextureModel::blended`].
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub(crate) fn with_blended_along(mut self, nodes: Vec<GrainNode>) -> Result<Self, TextureModelError> {
        check::along(&self.grain, &nodes)?;
        self.layers.along = Some(Arc::from(nodes));
        Ok(self)
    }

    /// Returns the texture with this height map, or without one.
    #[must_use]
    pub fn with_height_map(mut self, height_map: Option<Arc<HeightMap>>) -> Self {
        self.layers.height_map = height_map;
        self
    }

    /// Returns the texture with stick-slip friction, or without it.
    #[must_use]
    pub fn with_stick_slip(mut self, stick_slip: Option<StickSlip>) -> Self {
        self.layers.stick_slip = stick_slip;
        self
    }

    /// Returns the texture rotated so that its x axis lies at this angle on the pad, counterclockwise in rad. A value
    /// that is not finite is read as zero.
    #[must_use]
    pub fn with_turn_rad(mut self, turn_rad: f64) -> Self {
        let turn_rad = if turn_rad.is_finite() { turn_rad } else { 0.0 };
        // Both ends of the range stay, so that a texture read from a file is written as it was.
        let is_within = turn_rad.abs() <= PI;
        self.layers.turn_rad = if is_within { turn_rad } else { turn_rad - TAU * (turn_rad / TAU).round() };
        self
    }

    /// Returns the texture with the tap, relief, height map, stick-slip and rotation of another one. The grain, also
    /// that along the lay, and the friction coefficient stay.
    #[must_use]
    pub fn with_layers_of(mut self, other: &Self) -> Self {
        let along = self.layers.along.take();
        self.layers = TextureLayers { along, ..other.layers.clone() };
        self
    }

    /// Tap transient, if known.
    pub fn tap(&self) -> Option<Tap> {
        self.layers.tap
    }

    /// Relief, if the texture has one.
    pub fn relief(&self) -> Option<&Arc<Relief>> {
        self.layers.relief.as_ref()
    }

    /// Grain for strokes along the lay (the texture's y axis); `None` for an isotropic texture. The nodes have the speeds
    /// and forces of [`TextureModel::nodes`].
    pub fn along(&self) -> Option<&[GrainNode]> {
        self.layers.along.as_deref()
    }

    /// The isotropic texture of the grain along the lay, without other layers; `None` for an isotropic texture.
    pub fn along_model(&self) -> Option<Self> {
        let nodes = self.along()?.to_vec();
        let interpolation = self.interpolation()?;
        let grain = Grain::Measured { nodes, interpolation };
        Some(Self { rate: self.rate, grain, friction: self.friction, layers: TextureLayers::default() })
    }

    /// Height map, if the texture has one.
    pub fn height_map(&self) -> Option<&Arc<HeightMap>> {
        self.layers.height_map.as_ref()
    }

    /// Parameters of stick-slip friction, if the texture has it.
    pub fn stick_slip(&self) -> Option<StickSlip> {
        self.layers.stick_slip
    }

    /// Angle of the texture's x axis on the pad, counterclockwise, in rad, -π to π.
    pub fn turn_rad(&self) -> f64 {
        self.layers.turn_rad
    }
}
