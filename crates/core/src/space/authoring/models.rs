//! Models for the modes that interpolate a texture: all textures of a space on one sampling lattice, and their field.

use std::sync::Arc;

use crate::maths::sums::add_times;
use crate::space::authoring::LEAST_WEIGHT;
use crate::space::authoring::layers::{mean_friction, mean_stick_slip, mean_tap};
use crate::space::field::{Field, Site};
use crate::space::mean_axes::MeanAxes;
use crate::space::sampled::{Layers, SampledGrain, Sampling};
use crate::space::{Space, SpacePoint};
use crate::texture::height_map::{CommonTile, HeightMap, TilePart};
use crate::texture::plane::Plane;
use crate::texture::relief::Relief;
use crate::texture::stick_slip::StickSlip;
use crate::texture::tap::Tap;
use crate::texture::{GrainNode, TextureModel, TextureModelError};

/// All placed textures of a space on one sampling lattice, and the field over them.
#[derive(Clone, Debug)]
pub struct Models {
    sampling: Sampling,
    /// One entry per texture with a position, in the order of the space's sites.
    sites: Vec<Sampled>,
    field: Field,
    /// Index of each texture in `sites`, by its library index.
    site_of: Vec<Option<usize>>,
    /// Whether a texture has a relief.
    has_relief: bool,
    /// Whether a texture has stick-slip friction.
    has_stick_slip: bool,
    /// Whether a texture is rotated on the pad.
    is_turned: bool,
    /// Height maps of the sites; `None` if no texture has one.
    height_maps: Option<CommonTile>,
}

#[derive(Clone, Debug)]
struct Sampled {
    /// Library index of the texture.
    texture: usize,
    /// Grain across the lay.
    grain: SampledGrain,
    /// Grain along the lay; `None` for an isotropic texture.
    along: Option<SampledGrain>,
    friction: Option<f64>,
    tap: Option<Tap>,
    relief: Option<Arc<Relief>>,
    height_map: Option<Arc<HeightMap>>,
    stick_slip: Option<StickSlip>,
    turn_rad: f64,
}

impl Sampled {
    fn at(&self, at: SpacePoint) -> Site<'_> {
        let (along, turn_rad) = (self.along.as_ref(), self.turn_rad);
        Site { at: at.unit(), grain: &self.grain, along, turn_rad, friction: self.friction, tap: self.tap }
    }

    /// Grains that the texture contributes with this weight across (0) or along (1) the lay of `axes`, and their weights.
    fn grains(&self, weight: f64, axes: &MeanAxes, direction: usize) -> [(&SampledGrain, f64); 2] {
        let share = if self.along.is_some() { axes.shares_along(self.turn_rad)[direction] } else { 0.0 };
        let along = self.along.as_ref().unwrap_or(&self.grain);
        [(&self.grain, (1.0 - share) * weight), (along, share * weight)]
    }

    /// Whether the texture depends on the direction of the stroke.
    fn has_axes(&self) -> bool {
        self.along.is_some() || self.height_map.is_some() || self.relief.is_some()
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
            .map(|(texture, layers)| Sampled {
                texture,
                grain: sampling.sample(layers.plane),
                along: layers.along.map(|along| sampling.sample(along)),
                friction: layers.friction,
                tap: layers.tap,
                relief: layers.plane.relief().cloned(),
                height_map: layers.height_map.cloned(),
                stick_slip: layers.stick_slip,
                turn_rad: layers.turn_rad,
            })
            .collect();
        let at_places: Vec<Site<'_>> =
            sites.iter().zip(space.sites()).map(|(site, (_, at))| site.at(*at)).collect();
        let field = Field::new(&at_places).ok_or(ModelsError::Degenerate)?;
        let height_maps: Vec<_> = sites.iter().map(|site| site.height_map.clone()).collect();
        let mut site_of = vec![None; layers.len()];
        for (index, site) in sites.iter().enumerate() {
            site_of[site.texture] = Some(index);
        }
        Ok(Self {
            has_relief: sites.iter().any(|site| site.relief.is_some()),
            has_stick_slip: sites.iter().any(|site| site.stick_slip.is_some()),
            is_turned: sites.iter().any(|site| site.turn_rad != 0.0),
            height_maps: CommonTile::new(&height_maps),
            sampling,
            sites,
            field,
            site_of,
        })
    }

    /// Prepares the height maps of all textures, which takes some time, so that their sums take little. Without this, the
    /// first sum with a height map prepares it.
    pub fn prepare_height_maps(&self) {
        if let Some(height_maps) = &self.height_maps {
            height_maps.prepare();
        }
    }

    /// Texture of the field at a point, moved towards a pinned texture by the weight in `lock`; with friction, tap and the
    /// grains across and along the lay of `axes` only. `weights` are those of the sites at the point ([`Models::weights`]).
    pub(super) fn texture(
        &self,
        (at, weights): (SpacePoint, &[f64]),
        axes: &MeanAxes,
        lock: Option<(usize, f64)>,
    ) -> Result<TextureModel, TextureModelError> {
        let own = |(texture, share): (usize, f64)| Some((self.site(texture)?.at(at), share));
        self.field.texture(&self.sampling, (at.unit(), weights), axes, lock.and_then(own))
    }

    /// Weighted sum of the textures' reliefs; `None` if no texture has one.
    pub(super) fn relief(&self, parents: &[(usize, f64)]) -> Option<Arc<Relief>> {
        if !self.has_relief {
            return None;
        }
        let parts: Vec<_> =
            self.weighted(parents).map(|(site, weight)| (site.relief.as_deref(), weight)).collect();
        Relief::blended(&parts).map(Arc::new)
    }

    /// Weighted sum of the textures' height maps in `axes`; `None` if no texture has one.
    pub(super) fn height_map(&self, parents: &[(usize, f64)], axes: &MeanAxes) -> Option<Arc<HeightMap>> {
        let height_maps = self.height_maps.as_ref()?;
        if let Some(alone) = self.alone(parents) {
            return alone.height_map.clone();
        }
        let part = |(texture, weight): &(usize, f64)| {
            let map = self.site_index(*texture)?;
            Some(TilePart { map, weight: *weight, turn_rad: self.sites[map].turn_rad - axes.turn_rad })
        };
        let parts: Vec<TilePart> = parents.iter().filter_map(part).collect();
        height_maps.blended(&parts).map(Arc::new)
    }

    /// Mean parameters of stick-slip friction; `None` if no texture has it.
    pub(super) fn stick_slip(&self, parents: &[(usize, f64)]) -> Option<StickSlip> {
        if !self.has_stick_slip {
            return None;
        }
        match self.alone(parents) {
            Some(alone) => alone.stick_slip,
            None => {
                mean_stick_slip(self.contributing(parents).map(|(site, weight)| (site.stick_slip, weight)))
            }
        }
    }

    /// Mean axes of the textures that depend on the direction of the stroke; those of the pad if there are none.
    pub(super) fn axes(&self, parents: &[(usize, f64)]) -> MeanAxes {
        if !self.is_turned {
            return MeanAxes::at(0.0);
        }
        if let Some(alone) = self.alone(parents) {
            return MeanAxes::at(alone.turn_rad);
        }
        let parts = self.contributing(parents).filter(|(site, _)| site.has_axes());
        MeanAxes::mean(parts.map(|(site, weight)| (site.turn_rad, weight)))
    }

    /// Weight of each site in the field at a point, in the order of the sites. With many textures, this is the slowest part of
    /// the interpolation.
    pub(super) fn weights(&self, at: SpacePoint) -> Vec<f64> {
        self.field.weights(at.unit())
    }

    /// Library indices of the sites, with these weights.
    pub(super) fn weighted_textures(&self, weights: &[f64]) -> Vec<(usize, f64)> {
        self.sites.iter().map(|site| site.texture).zip(weights.iter().copied()).collect()
    }

    /// Farthest point to which the field extrapolates from a point of the hull towards one outside.
    pub(super) fn supported(&self, inside: SpacePoint, to: SpacePoint) -> SpacePoint {
        if inside == to {
            return to;
        }
        SpacePoint::from_unit(inside.n_axes(), self.field.supported(inside.unit(), to.unit()))
    }

    /// Weighted mean of textures: line spectral frequencies and ln level at every contact, across the lay of `axes` and, if
    /// one of the textures is directional, along it; with friction and tap, without other layers.
    pub(super) fn mean(
        &self,
        parents: &[(usize, f64)],
        axes: &MeanAxes,
    ) -> Result<TextureModel, TextureModelError> {
        let known: Vec<(&Sampled, f64)> = self.weighted(parents).collect();
        let nodes = |direction: usize| {
            let grains = known.iter().flat_map(|(site, weight)| site.grains(*weight, axes, direction));
            self.mean_nodes(grains.filter(|(_, weight)| *weight != 0.0))
        };
        let is_directional = self.contributing(parents).any(|(site, _)| site.along.is_some());
        let along = is_directional.then(|| nodes(1));
        let friction = mean_friction(known.iter().map(|(site, weight)| (site.friction, *weight)));
        let tap = mean_tap(known.iter().map(|(site, weight)| (site.tap, *weight)));
        self.sampling.texture(nodes(0), along, friction, tap)
    }

    /// Nodes with the weighted mean of line spectral frequencies and ln level.
    fn mean_nodes<'a, I: Iterator<Item = (&'a SampledGrain, f64)>>(&self, grains: I) -> Vec<GrainNode> {
        let first = &self.sites[0].grain;
        let (mut lsf, mut ln_level) = (vec![0.0; first.lsf.len()], vec![0.0; first.ln_level.len()]);
        for (grain, weight) in grains {
            add_times(&grain.lsf, weight, &mut lsf);
            add_times(&grain.ln_level, weight, &mut ln_level);
        }
        self.sampling.nodes_of_frequencies(&lsf, &ln_level)
    }

    fn site_index(&self, texture: usize) -> Option<usize> {
        self.site_of.get(texture).copied().flatten()
    }

    /// Texture with this library index.
    fn site(&self, texture: usize) -> Option<&Sampled> {
        self.site_index(texture).map(|index| &self.sites[index])
    }

    /// Textures with these library indices and weights.
    fn weighted(&self, parents: &[(usize, f64)]) -> impl Iterator<Item = (&Sampled, f64)> {
        parents.iter().filter_map(move |(texture, weight)| Some((self.site(*texture)?, *weight)))
    }

    /// As [`Models::weighted`], without textures whose weight is a rounding error.
    fn contributing(&self, parents: &[(usize, f64)]) -> impl Iterator<Item = (&Sampled, f64)> {
        self.weighted(parents).filter(|(_, weight)| weight.abs() > LEAST_WEIGHT)
    }

    /// The texture that contributes alone, as a pinned one at its position; its layers stay as they are.
    fn alone(&self, parents: &[(usize, f64)]) -> Option<&Sampled> {
        match parents {
            [(texture, weight)] if *weight == 1.0 => self.site(*texture),
            _ => None,
        }
    }
}
