//! Interpolation: computes the texture at any point of the space.

mod layers;
mod models;
#[cfg(test)]
pub(crate) mod tests;

use std::sync::{Arc, OnceLock};

pub use crate::space::authoring::models::{Models, ModelsError};
pub use crate::space::sampled::Layers;

use self::layers::mean_tap;
use crate::maths::natural_neighbor::NaturalNeighbors;
use crate::space::authoring_space::MOST_TRIANGULATED;
use crate::space::inverse_distance::inverse_distance;
use crate::space::mean_axes::MeanAxes;
use crate::space::{Location, Space, SpacePoint};
use crate::texture::blend::Mode;
use crate::texture::shape::Shape;
use crate::texture::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};

/// Weighting of the textures in the interpolation modes that combine a few textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// Barycentric weights of the corners of the triangle.
    #[default]
    Barycentric,
    /// Natural-neighbor weights (Sibson 1981): each weight is proportional to the Voronoi area that the point takes
    /// from that texture. These weights have no kink at triangle edges. Only for [`Mode::Parametric`], because the
    /// modes that mix signals mix at most three.
    Natural,
}

/// Behavior outside the convex hull of the textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// The point is moved to the nearest point of the hull.
    #[default]
    Clamped,
    /// [`Mode::Field`] extrapolates, up to the point where the noise gain `Σ w²` of the weights `w` would exceed 1, the
    /// noise gain of a copy of one texture.
    Extrapolated,
}

/// Options of the interpolation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blending {
    /// Interpolation mode.
    pub mode: Mode,
    /// Weighting of the textures.
    pub weights: Weights,
    /// Behavior outside the hull.
    pub outside: Outside,
    /// Library indices of pinned textures: the field passes through them at their positions instead of smoothing them.
    pub locked: Vec<usize>,
}

/// Options that the interpolation mode does not support.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BlendingError {
    /// Natural-neighbor weights in a mode that mixes signals.
    #[error("natural-neighbor weights are available only in mode parametric; change the mode or the weights")]
    Natural,
    /// Extrapolation in a mode without a field.
    #[error(
        "extrapolation outside the convex hull is available only in mode field; change the mode or clamp to the hull"
    )]
    Extrapolated,
    /// A mode without a field in a space with more than two axes.
    #[error(
        "mode {mode} interpolates in triangles, so it needs a space with one or two axes, but this one has {n_axes}; choose mode field, or fewer axes"
    )]
    Axes {
        /// Identifier of the mode.
        mode: &'static str,
        /// Number of axes of the space.
        n_axes: usize,
    },
    /// Pinned textures in a mode without a field.
    #[error(
        "textures can be pinned only in mode field; in the other modes each texture is exact at its own position"
    )]
    Locked,
}

impl From<Mode> for Blending {
    fn from(mode: Mode) -> Self {
        Self { mode, ..Self::default() }
    }
}

impl Blending {
    /// Checks that the mode supports all options, and interpolates in a space with this number of axes.
    ///
    /// # Errors
    /// See [`BlendingError`].
    pub fn check_in(&self, n_axes: usize) -> Result<(), BlendingError> {
        if n_axes > MOST_TRIANGULATED && self.mode != Mode::Field {
            return Err(BlendingError::Axes { mode: self.mode.id(), n_axes });
        }
        self.check()
    }

    /// Checks that the mode supports all options.
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

/// Weights smaller than this are rounding error and are dropped.
const LEAST_WEIGHT: f64 = 1e-12;

/// Distances from the hull boundary, in points of the axes. Below the first, Voronoi areas tend to infinity and lose
/// precision, so the weights are barycentric. Between the two, natural-neighbor weights fade in and barycentric weights
/// fade out. Above the second, the weights are those of the natural neighbors.
const NEAR_HULL: (f64, f64) = (1e-3, 1.0);

/// Largest radius around a pinned texture, in points of the axes, within which the field fades into that texture.
const LOCK_RADIUS: f64 = 8.0;

/// Result of the interpolation at one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Authored {
    /// Location of the point, with barycentric weights.
    pub location: Location,
    /// Whether the point is outside the hull and its texture was extrapolated.
    pub is_extrapolated: bool,
    /// Library indices and weights of the contributing textures, largest weight first. Weights sum to one. Weights of a
    /// field may be negative; zero weights are omitted.
    pub parents: Vec<(usize, f64)>,
    /// Interpolation mode.
    pub mode: Mode,
    /// Interpolated texture, in the modes that compute one.
    pub model: Option<TextureModel>,
    /// Pinned texture near the point and its weight in the output signal.
    pub lock: Option<(usize, f64)>,
    /// Shape of the result. The interpolated texture already has it; textures of the library do not.
    pub shape: Shape,
}

/// An audible texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Voice<'a> {
    /// A texture of the library, by index.
    Texture(usize),
    /// A texture interpolated for the point.
    Made(&'a TextureModel),
}

impl Authored {
    /// A single texture of the library at a point.
    pub fn alone(texture: usize, at: SpacePoint, mode: Mode) -> Self {
        let location = Location { at, clamped: false, corners: Vec::new() };
        let parents = vec![(texture, 1.0)];
        let (model, lock, shape) = (None, Some((texture, 1.0)), Shape::default());
        Self { location, is_extrapolated: false, parents, mode, model, lock, shape }
    }

    /// Returns the result in this shape. Textures of the library among its voices must be shaped before they play.
    ///
    /// # Errors
    /// As [`Shape::apply`].
    pub fn shaped(mut self, shape: &Shape) -> Result<Self, TextureModelError> {
        self.model = self.model.map(|model| shape.apply(&model)).transpose()?;
        self.shape = *shape;
        Ok(self)
    }

    /// Audible textures and their weights, at most three, to be mixed in mode [`Authored::mixing`]. Empty if the mode
    /// needs an interpolated texture and there is none.
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
            // Without the interpolated texture, a partial weight of the pinned texture would only make the signal too
            // quiet.
            None => lock.filter(|(_, share)| *share == 1.0).into_iter().collect(),
        }
    }

    /// Tap transient: weighted geometric mean over the known tap transients of the audible textures, in the shape of the
    /// result. `of` returns the tap transient of a library texture, without a shape.
    pub fn tap(&self, of: impl Fn(usize) -> Option<Tap>) -> Option<Tap> {
        let known = |(voice, share): (Voice<'_>, f64)| match voice {
            Voice::Texture(texture) => (self.shape.tap(of(texture)), share),
            Voice::Made(model) => (model.tap(), share),
        };
        mean_tap(self.voices().into_iter().map(known))
    }

    /// Mode in which the audible textures are mixed. An interpolated texture and a pinned one share one excitation.
    pub fn mixing(&self) -> Mode {
        if self.mode.makes_a_model() { Mode::Shared } else { self.mode }
    }
}

/// A space with everything needed to interpolate in it.
#[derive(Clone, Debug)]
pub struct Authoring {
    space: Space,
    models: Option<Arc<Models>>,
    natural: OnceLock<Option<Arc<NaturalNeighbors>>>,
    has_reliefs: bool,
}

impl Authoring {
    /// Interpolation in a space, without models: sufficient for the modes that mix signals.
    pub fn new(space: Space) -> Self {
        Self { space, models: None, natural: OnceLock::new(), has_reliefs: true }
    }

    /// Adds the models that the other modes need; `models` must belong to this space.
    #[must_use]
    pub fn with_models(mut self, models: Arc<Models>) -> Self {
        self.models = Some(models);
        self
    }

    /// Disables reliefs and height maps in interpolated textures. Adding up their tens of thousands of values is too
    /// slow for maps with thousands of points.
    #[must_use]
    pub fn without_reliefs(mut self) -> Self {
        self.has_reliefs = false;
        self
    }

    /// The space.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// Texture at `point`, or `None` if the space has no textures. Options that the mode does not support are ignored
    /// (see [`Blending::check`]). In a space with more than two axes, every mode is the field ([`Blending::check_in`]).
    pub fn author(&self, point: SpacePoint, blending: &Blending) -> Option<Authored> {
        let location = self.space.locate(point)?;
        let models = self.models.as_deref();
        let point = point.on(self.space.n_axes());
        let mode = if self.space.is_triangulated() { blending.mode } else { Mode::Field };
        let mut authored = Authored {
            location,
            is_extrapolated: false,
            parents: Vec::new(),
            mode,
            model: None,
            lock: None,
            shape: Shape::default(),
        };
        let corners = &authored.location.corners;
        match mode {
            Mode::Paper => authored.parents = inverse_distance(&self.space, &authored.location),
            Mode::Power | Mode::Shared => authored.parents.clone_from(corners),
            Mode::Parametric => {
                authored.parents = match blending.weights {
                    Weights::Barycentric => corners.clone(),
                    Weights::Natural => self.natural_weights(&authored.location),
                };
                // A weighted mean of textures is a valid texture; if rounding makes it invalid, the output is silent.
                let mean = |models: &Models| {
                    let axes = models.axes(&authored.parents);
                    let model = models.mean(&authored.parents, &axes).ok()?;
                    Some(self.layered(model, models, &authored.parents, &axes))
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
                    let weights = models.weights(reached);
                    authored.parents = models.weighted_textures(&weights);
                    // Far from all textures, a spectrum may exceed the limits of a texture model; then the output is
                    // silent.
                    let axes = models.axes(&authored.parents);
                    let model = models.texture((reached, &weights), &axes, None).ok();
                    authored.model = model.map(|model| self.layered(model, models, &authored.parents, &axes));
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

    /// Texture at `point` as a single model, in the modes that interpolate a model. Near a pinned texture, the model
    /// averages the log spectra of the field and of that texture, whereas [`Authoring::author`] mixes their signals.
    /// `None` if there is no model.
    pub fn model(&self, point: SpacePoint, blending: &Blending) -> Option<TextureModel> {
        let authored = self.author(point, blending)?;
        match (authored.lock, self.models.as_deref()) {
            // An invalid texture gives `None`, as in `author`.
            (Some(lock), Some(models)) => {
                let axes = models.axes(&authored.parents);
                let at = authored.location.at;
                let model = models.texture((at, &models.weights(at)), &axes, Some(lock)).ok()?;
                Some(self.layered(model, models, &authored.parents, &axes))
            }
            _ => authored.model,
        }
    }

    /// `model` in these axes, with the layers that are combined by the weights of the textures, without reliefs and height
    /// maps if they are disabled.
    fn layered(
        &self,
        model: TextureModel,
        models: &Models,
        parents: &[(usize, f64)],
        axes: &MeanAxes,
    ) -> TextureModel {
        let model = model.with_stick_slip(models.stick_slip(parents)).with_turn_rad(axes.turn_rad);
        if self.has_reliefs {
            model.with_relief(models.relief(parents)).with_height_map(models.height_map(parents, axes))
        } else {
            model
        }
    }

    /// Natural-neighbor weights. On the hull boundary, where Voronoi areas are infinite, the result is the barycentric
    /// weights of the edge; near the boundary, a mixture of both.
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

    /// The pinned texture whose circle contains the point, and its weight: one at its position, zero on the circle. The
    /// radius is [`LOCK_RADIUS`] or half the distance to the nearest other pinned texture, so circles do not overlap.
    fn lock(&self, at: SpacePoint, locked: &[usize]) -> Option<(usize, f64)> {
        let placed: Vec<(usize, SpacePoint)> = locked
            .iter()
            .filter_map(|texture| self.space.position(*texture).map(|p| (*texture, p)))
            .collect();
        let distance = |(_, p): &&(usize, SpacePoint)| p.distance(at);
        let (texture, place) = placed.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        // If two pinned textures have the same position, the first is used.
        let others = placed.iter().map(|(_, p)| p.distance(*place)).filter(|distance| *distance > 1e-9);
        let radius = others.map(|distance| 0.5 * distance).fold(LOCK_RADIUS, f64::min);
        let share = at.distance(*place) / radius;
        (share < 1.0).then(|| (*texture, (1.0 - share * share).powi(2)))
    }
}
