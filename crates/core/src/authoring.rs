//! From a point of the space to the texture that is authored there.

mod layers;
mod models;
#[cfg(test)]
pub(crate) mod tests;

use std::sync::{Arc, OnceLock};

pub use crate::authoring::models::{Models, ModelsError};
pub use crate::sampled::Layers;

use self::layers::mean_tap;
use crate::blend::{Mode, inverse_distance};
use crate::natural_neighbor::NaturalNeighbors;
use crate::relief::Relief;
use crate::space::{Location, Space, SpacePoint};
use crate::tap::Tap;
use crate::texture::TextureModel;

/// Which textures have a say at a point, and how much, in the modes that blend a few.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// The corners of the triangle, by barycentric weights.
    #[default]
    Barycentric,
    /// The natural neighbors, by the area that the point would take from each (Sibson 1981): no kink at edges. For
    /// [`Mode::Parametric`], since the renderer mixes no more than three signals.
    Natural,
}

/// What happens outside the hull of the textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// The nearest point of the hull is taken.
    #[default]
    Clamped,
    /// [`Mode::Field`] goes on, as far as the field supports: until a texture would rest on less than a copy of one does.
    Extrapolated,
}

/// How a point becomes a texture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blending {
    /// How textures become one.
    pub mode: Mode,
    /// Which of them count.
    pub weights: Weights,
    /// What happens outside their hull.
    pub outside: Outside,
    /// Library indices of textures that the field must meet exactly at their own points, instead of smoothing them.
    pub locked: Vec<usize>,
}

/// Why a blending asks for what its mode cannot do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BlendingError {
    /// Natural weights for a mixture of signals.
    #[error("natural weights are for the mode parametric alone")]
    Natural,
    /// Extrapolation without a field.
    #[error("only the mode field goes beyond the textures: the others have nothing to go by there")]
    Extrapolated,
    /// Locks without a field.
    #[error("only the mode field has textures to lock: in the others a texture's own point is that texture")]
    Locked,
}

impl From<Mode> for Blending {
    fn from(mode: Mode) -> Self {
        Self { mode, ..Self::default() }
    }
}

impl Blending {
    /// Whether the mode can do what is asked of it.
    ///
    /// # Errors
    /// See [`BlendingError`].
    pub fn check(&self) -> Result<(), BlendingError> {
        let is_field = self.mode == Mode::Field;
        if self.weights == Weights::Natural && self.mode != Mode::Parametric {
            Err(BlendingError::Natural)
        } else if self.outside == Outside::Extrapolated && !is_field {
            Err(BlendingError::Extrapolated)
        } else if !self.locked.is_empty() && !is_field {
            Err(BlendingError::Locked)
        } else {
            Ok(())
        }
    }
}

/// Weights smaller than this are rounding, and left out.
const LEAST_WEIGHT: f64 = 1e-12;

/// Distances from the hull, in points of the axes: below the first stolen areas reach to infinity and digits are lost, and
/// from there to the second they take over from the weights of the triangle.
const NEAR_HULL: (f64, f64) = (1e-3, 1.0);

/// Radius around a locked texture within which the field gives way to it, in points of the axes.
const LOCK_RADIUS: f64 = 8.0;

/// What is authored at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Authored {
    /// Where the point lies, with barycentric weights.
    pub location: Location,
    /// Whether the point lies outside the hull, and is authored nevertheless.
    pub is_extrapolated: bool,
    /// Library indices of the textures that have a say and their weights, which sum to one, largest first. Weights of a
    /// field may be below zero; zeros are left out.
    pub parents: Vec<(usize, f64)>,
    /// How they become one.
    pub mode: Mode,
    /// The texture that was made, in the modes that make one.
    pub model: Option<TextureModel>,
    /// The locked texture near the point, and its share of what sounds.
    pub lock: Option<(usize, f64)>,
}

/// What sounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Voice<'a> {
    /// A texture of the library.
    Texture(usize),
    /// A texture that was made for the point.
    Made(&'a TextureModel),
}

impl Authored {
    /// One texture of the library alone, at a point.
    pub fn alone(texture: usize, at: SpacePoint, mode: Mode) -> Self {
        let location = Location { at, clamped: false, corners: Vec::new() };
        let parents = vec![(texture, 1.0)];
        Self { location, is_extrapolated: false, parents, mode, model: None, lock: Some((texture, 1.0)) }
    }

    /// What sounds and how loud, at most three, to be mixed in [`Authored::mixing`]; nothing where a texture should have
    /// been made and was not.
    pub fn voices(&self) -> Vec<(Voice<'_>, f64)> {
        if !self.mode.makes_a_model() {
            return self
                .parents
                .iter()
                .map(|(texture, weight)| (Voice::Texture(*texture), *weight))
                .collect();
        }
        let locked = self.lock.map_or(0.0, |(_, share)| share);
        let lock = self.lock.map(|(texture, share)| (Voice::Texture(texture), share));
        match &self.model {
            Some(model) => {
                let made = (Voice::Made(model), 1.0 - locked);
                [Some(made), lock].into_iter().flatten().filter(|(_, share)| *share > 0.0).collect()
            }
            // Without the rest, a part of a locked texture would only be too quiet.
            None => lock.filter(|(_, share)| *share == 1.0).into_iter().collect(),
        }
    }

    /// What a landing sounds like: the weighted geometric mean of what is known of the voices' landings; `of` tells that of
    /// a texture of the library.
    pub fn tap(&self, of: impl Fn(usize) -> Option<Tap>) -> Option<Tap> {
        let known = |(voice, share): (Voice<'_>, f64)| match voice {
            Voice::Texture(texture) => (of(texture), share),
            Voice::Made(model) => (model.tap(), share),
        };
        mean_tap(self.voices().into_iter().map(known))
    }

    /// How the voices are mixed: what was made is one signal, and joins a locked texture under one excitation.
    pub fn mixing(&self) -> Mode {
        if self.mode.makes_a_model() { Mode::Shared } else { self.mode }
    }
}

/// A space that can be authored in.
#[derive(Clone, Debug)]
pub struct Authoring {
    space: Space,
    models: Option<Arc<Models>>,
    natural: OnceLock<Option<Arc<NaturalNeighbors>>>,
    has_reliefs: bool,
}

impl Authoring {
    /// A space for the modes that mix signals.
    pub fn new(space: Space) -> Self {
        Self { space, models: None, natural: OnceLock::new(), has_reliefs: true }
    }

    /// The same with what the modes that make a texture need; `models` were made for this space.
    #[must_use]
    pub fn with_models(mut self, models: Arc<Models>) -> Self {
        self.models = Some(models);
        self
    }

    /// The same without the reliefs of what is made: adding up lines of 65,000 values is too much for what is looked at in
    /// thousands of places.
    #[must_use]
    pub fn without_reliefs(mut self) -> Self {
        self.has_reliefs = false;
        self
    }

    /// The space.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The texture at `point`; `None` in a space without textures. What the mode cannot do is left undone
    /// ([`Blending::check`]).
    pub fn author(&self, point: SpacePoint, blending: &Blending) -> Option<Authored> {
        let location = self.space.locate(point)?;
        let models = self.models.as_deref();
        let mode = blending.mode;
        let mut authored =
            Authored { location, is_extrapolated: false, parents: Vec::new(), mode, model: None, lock: None };
        let corners = &authored.location.corners;
        match mode {
            Mode::Paper => authored.parents = inverse_distance(&self.space, &authored.location),
            Mode::Power | Mode::Shared => authored.parents.clone_from(corners),
            Mode::Parametric => {
                authored.parents = match blending.weights {
                    Weights::Barycentric => corners.clone(),
                    Weights::Natural => self.natural_weights(&authored.location),
                };
                // A mean of textures is one; should rounding make it none, there is nothing to hear.
                let mean = |models: &Models| {
                    let model = models.mean(&authored.parents).ok()?;
                    Some(model.with_relief(self.relief(models, &authored.parents)))
                };
                authored.model = models.and_then(mean);
            }
            Mode::Field => {
                if let Some(models) = models {
                    let reached = match blending.outside {
                        Outside::Clamped => authored.location.at,
                        Outside::Extrapolated => models.supported(authored.location.at, point),
                    };
                    authored.is_extrapolated = reached.distance(authored.location.at) > 1e-9;
                    authored.location.clamped = reached.distance(point) > 1e-9;
                    authored.location.at = reached;
                    authored.parents = models.weights(reached);
                    // Far from all textures a spectrum may be beyond what a texture may be: then nothing is heard.
                    let relief = self.relief(models, &authored.parents);
                    authored.model =
                        models.texture(reached, None).ok().map(|model| model.with_relief(relief));
                    authored.lock = self.lock(reached, &blending.locked);
                    if let Some((locked, share)) = authored.lock {
                        for (texture, weight) in &mut authored.parents {
                            *weight *= 1.0 - share;
                            *weight += if *texture == locked { share } else { 0.0 };
                        }
                    }
                }
            }
        }
        authored.parents.retain(|(_, w)| w.abs() > LEAST_WEIGHT);
        authored.parents.sort_by(|a, b| b.1.total_cmp(&a.1));
        Some(authored)
    }

    /// The texture at `point` as one model, in the modes that make one: near a locked texture the field's and its own
    /// spectrum are averaged, where [`Authoring::author`] mixes both. `None` where there is none.
    pub fn model(&self, point: SpacePoint, blending: &Blending) -> Option<TextureModel> {
        let authored = self.author(point, blending)?;
        match (authored.lock, self.models.as_deref()) {
            // As in `author`.
            (Some(lock), Some(models)) => {
                let model = models.texture(authored.location.at, Some(lock)).ok()?;
                Some(model.with_relief(self.relief(models, &authored.parents)))
            }
            _ => authored.model,
        }
    }

    /// The reliefs of textures by weight, where reliefs are wanted.
    fn relief(&self, models: &Models, parents: &[(usize, f64)]) -> Option<Arc<Relief>> {
        if self.has_reliefs { models.relief(parents) } else { None }
    }

    /// Weights by stolen area. On the hull, where that is infinite, they are those of its edge, and next to it, between the
    /// two.
    fn natural_weights(&self, location: &Location) -> Vec<(usize, f64)> {
        let sites = self.space.sites();
        let natural = self.natural.get_or_init(|| {
            let places: Vec<_> = sites.iter().map(|(_, at)| at.xy()).collect();
            NaturalNeighbors::new(&places).ok().map(Arc::new)
        });
        let (never, always) = NEAR_HULL;
        let inside = if location.clamped { 0.0 } else { self.space.hull_distance(location.at) };
        let share = ((inside - never) / (always - never)).clamp(0.0, 1.0);
        let stolen = match natural {
            Some(natural) if share > 0.0 => natural.weights(location.at.xy()),
            _ => Vec::new(),
        };
        if stolen.is_empty() {
            return location.corners.clone();
        }
        let mut weights: Vec<(usize, f64)> =
            stolen.into_iter().map(|(site, weight)| (sites[site].0, share * weight)).collect();
        for (corner, weight) in &location.corners {
            let weight = (1.0 - share) * weight;
            match weights.iter_mut().find(|(texture, _)| texture == corner) {
                Some((_, sum)) => *sum += weight,
                None => weights.push((*corner, weight)),
            }
        }
        weights
    }

    /// The locked texture whose circle holds the point, and its share: one at its own place, and nothing at the rim.
    /// Circles do not overlap.
    fn lock(&self, at: SpacePoint, locked: &[usize]) -> Option<(usize, f64)> {
        let placed: Vec<(usize, SpacePoint)> = locked
            .iter()
            .filter_map(|texture| self.space.position(*texture).map(|p| (*texture, p)))
            .collect();
        let distance = |(_, p): &&(usize, SpacePoint)| p.distance(at);
        let (texture, place) = placed.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        // Of two that lie at one place the first is met.
        let others = placed.iter().map(|(_, p)| p.distance(*place)).filter(|distance| *distance > 1e-9);
        let radius = others.map(|distance| 0.5 * distance).fold(LOCK_RADIUS, f64::min);
        let share = at.distance(*place) / radius;
        (share < 1.0).then(|| (*texture, (1.0 - share * share).powi(2)))
    }
}
