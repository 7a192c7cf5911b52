//! What the modes that make a texture know of a space: its textures sampled alike, and the field over them.

use std::sync::Arc;

use crate::authoring::layers::{mean_friction, mean_tap};
use crate::field::{Field, Site};
use crate::plane::Plane;
use crate::relief::Relief;
use crate::sampled::{Layers, SampledGrain, Sampling};
use crate::space::{Space, SpacePoint};
use crate::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};

/// Textures of a space, sampled alike, and the field over them.
#[derive(Clone, Debug)]
pub struct Models {
    sampling: Sampling,
    /// One for each texture that has a place, in the order of the space's sites.
    sites: Vec<Sampled>,
    field: Field,
}

#[derive(Clone, Debug)]
struct Sampled {
    /// Its index in the library.
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

/// Why textures cannot be blended into new ones.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelsError {
    /// Nothing has a place.
    #[error("no texture has a place in the space; place the textures first")]
    Empty,
    /// A texture that has a place was not given.
    #[error("texture {texture} has a place in the space, but was not given")]
    Missing {
        /// Its index in the library.
        texture: usize,
    },
    /// There is no telling places apart.
    #[error("the textures lie so near each other that no field goes through them; place them farther apart")]
    Degenerate,
    /// Rates differ.
    #[error(
        "texture {texture} has a rate of {rate_hz} Hz where the others have {expected_hz} Hz; convert it first"
    )]
    Rate {
        /// Its index in the library.
        texture: usize,
        /// Its rate.
        rate_hz: f64,
        /// That of the first one.
        expected_hz: f64,
    },
}

impl Models {
    /// What there is to know of the textures of `space`; `layers` is indexed like the library, and needs those that have
    /// a place, all of one rate.
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

    /// The texture of the field at a place, or so far on the way to a locked one, without a relief.
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

    /// The reliefs of textures by weight; `None` where none has one.
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

    /// What each texture says about a place in the field.
    pub(super) fn weights(&self, at: SpacePoint) -> Vec<(usize, f64)> {
        self.sites.iter().map(|site| site.texture).zip(self.field.weights(at.xy())).collect()
    }

    /// How far the field goes from a point of the hull towards one outside.
    pub(super) fn supported(&self, inside: SpacePoint, to: SpacePoint) -> SpacePoint {
        if inside == to { to } else { SpacePoint::from_xy(self.field.supported(inside.xy(), to.xy())) }
    }

    /// The mean of textures: line spectral frequencies and ln level by weight, at every contact; without a relief.
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
