//! Models for the modes that interpolate a texture: all textures of a space on one sampling lattice, and their field.

use std::sync::Arc;

use crate::space::authoring::layers::{mean_friction, mean_tap};
use crate::space::field::{Field, Site};
use crate::space::sampled::{Layers, SampledGrain, Sampling};
use crate::space::{Space, SpacePoint};
use crate::texture::plane::Plane;
use crate::texture::relief::Relief;
use crate::texture::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};

/// All placed textures of a space on one sampling lattice, and the field over them.
#[derive(Clone, Debug)]
pub struct Models {
    sampling: Sampling,
    /// One entry per texture with a position, in the order of the space's sites.
    sites: Vec<Sampled>,
    field: Field,
}

#[derive(Clone, Debug)]
struct Sampled {
    /// Library index of the texture.
    texture: usize,
    grain: SampledGrain,
    friction: Option<f64>,
    tap: Option<Tap>,
    relief: Option<Arc<Relief>>,
}

impl Sampled {
    fn at(&self, at: SpacePoint) -> Site<'_> {
        Site { at: at.xy(), grain: &self.grain, friction: self.friction, tap: self.tap }
    }
}

/// Reasons why textures cannot be interpolated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelsError {
    /// No texture has a position.
    #[error("no texture has a position in the space; place the textures first")]
    Empty,
    /// A texture with a position is missing from the input.
    #[error(
        "texture {texture} has a position in the space, but its model is missing; load it or remove its position"
    )]
    Missing {
        /// Library index of the texture.
        texture: usize,
    },
    /// Positions are too close to each other.
    #[error("the textures are too close to each other to fit a field; move them farther apart")]
    Degenerate,
    /// The sample rates differ.
    #[error(
        "texture {texture} has a sample rate of {rate_hz} Hz, but the others have {expected_hz} Hz; convert it first"
    )]
    Rate {
        /// Library index of the texture.
        texture: usize,
        /// Its sample rate in Hz.
        rate_hz: f64,
        /// Sample rate of the first texture in Hz.
        expected_hz: f64,
    },
}

impl Models {
    /// Models of the textures of `space`. `layers` is indexed like the library; every texture with a position needs an
    /// entry, and all need the same sample rate.
    ///
    /// # Errors
    /// See [`ModelsError`].
    pub fn new(space: &Space, layers: &[Option<Layers<'_>>]) -> Result<Self, ModelsError> {
        let of = |texture: usize| layers.get(texture).copied().flatten();
        let mut placed = Vec::with_capacity(space.sites().len());
        for (texture, _) in space.sites() {
            placed.push((*texture, of(*texture).ok_or(ModelsError::Missing { texture: *texture })?));
        }
        let planes: Vec<&Plane> = placed.iter().map(|(_, layers)| layers.plane).collect();
        let sampling = Sampling::new(&planes).ok_or(ModelsError::Empty)?;
        let expected_hz = placed[0].1.plane.rate().0;
        if let Some((texture, other)) = placed.iter().find(|(_, l)| l.plane.rate().0 != expected_hz) {
            let rate_hz = other.plane.rate().0;
            return Err(ModelsError::Rate { texture: *texture, rate_hz, expected_hz });
        }
        let sites: Vec<Sampled> = placed
            .into_iter()
            .map(|(texture, Layers { plane, friction, tap })| Sampled {
                texture,
                grain: sampling.sample(plane),
                friction,
                tap,
                relief: plane.relief().cloned(),
            })
            .collect();
        let at_places: Vec<Site<'_>> =
            sites.iter().zip(space.sites()).map(|(site, (_, at))| site.at(*at)).collect();
        let field = Field::new(&at_places).ok_or(ModelsError::Degenerate)?;
        Ok(Self { sampling, sites, field })
    }

    /// Texture of the field at a point, moved towards a pinned texture by the weight in `lock`; without a relief.
    pub(super) fn texture(
        &self,
        at: SpacePoint,
        lock: Option<(usize, f64)>,
    ) -> Result<TextureModel, TextureModelError> {
        let own = |(texture, share): (usize, f64)| {
            Some((self.sites.iter().find(|site| site.texture == texture)?.at(at), share))
        };
        self.field.texture(&self.sampling, at.xy(), lock.and_then(own))
    }

    /// Weighted sum of the textures' reliefs; `None` if no texture has one.
    pub(super) fn relief(&self, parents: &[(usize, f64)]) -> Option<Arc<Relief>> {
        if self.sites.iter().all(|site| site.relief.is_none()) {
            return None;
        }
        let of = |texture: usize| {
            let site = self.sites.iter().find(|site| site.texture == texture);
            site.and_then(|site| site.relief.as_deref())
        };
        let parts: Vec<_> = parents.iter().map(|(texture, weight)| (of(*texture), *weight)).collect();
        Relief::blended(&parts).map(Arc::new)
    }

    /// Weight of each texture in the field at a point.
    pub(super) fn weights(&self, at: SpacePoint) -> Vec<(usize, f64)> {
        self.sites.iter().map(|site| site.texture).zip(self.field.weights(at.xy())).collect()
    }

    /// Farthest point to which the field extrapolates from a point of the hull towards one outside.
    pub(super) fn supported(&self, inside: SpacePoint, to: SpacePoint) -> SpacePoint {
        if inside == to { to } else { SpacePoint::from_xy(self.field.supported(inside.xy(), to.xy())) }
    }

    /// Weighted mean of textures: line spectral frequencies and ln level at every contact; without a relief.
    pub(super) fn mean(&self, parents: &[(usize, f64)]) -> Result<TextureModel, TextureModelError> {
        let first = &self.sites[0].grain;
        let (mut lsf, mut ln_level) = (vec![0.0; first.lsf.len()], vec![0.0; first.ln_level.len()]);
        let known = parents.iter().filter_map(|(texture, weight)| {
            self.sites.iter().find(|site| site.texture == *texture).map(|site| (site, *weight))
        });
        let known: Vec<(&Sampled, f64)> = known.collect();
        for (site, weight) in &known {
            for (sum, w) in lsf.iter_mut().zip(&site.grain.lsf) {
                *sum += weight * w;
            }
            for (sum, l) in ln_level.iter_mut().zip(&site.grain.ln_level) {
                *sum += weight * l;
            }
        }
        let friction = mean_friction(known.iter().map(|(site, weight)| (site.friction, *weight)));
        let tap = mean_tap(known.iter().map(|(site, weight)| (site.tap, *weight)));
        self.sampling.texture_of_frequencies(&lsf, &ln_level, friction, tap)
    }
}
