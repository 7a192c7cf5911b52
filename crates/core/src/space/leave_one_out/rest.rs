//! Spaces and models of the remaining textures, rebuilt for each removed texture.

use std::sync::Arc;

use crate::space::authoring::{Authored, Authoring, Blending, Layers, Models, Voice};
use crate::space::fidelity::{COMPARED_RATE, Channels, Profile};
use crate::space::leave_one_out::{LeaveOneOutError, rest_of};
use crate::space::{Space, SpacePoint};
use crate::texture::TextureModel;
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;
use crate::texture::rate::{at_rate, highest_rate};
use crate::units::Hertz;

/// Distance from the hull boundary, in points of the axes, below which a texture counts as on the hull.
const ON_HULL: f64 = 1e-6;

/// A texture with a position.
#[derive(Clone, Debug)]
pub(in crate::space) struct Placed {
    /// Library index of the texture.
    pub(in crate::space) texture: usize,
    /// Position of the texture.
    pub(in crate::space) at: SpacePoint,
    /// Plane of the texture, at its own sample rate or [`COMPARED_RATE`], whichever is higher.
    pub(in crate::space) plane: Arc<Plane>,
}

/// A predicted texture: planes of one sample rate, their weights, and the mode that mixes them.
#[derive(Clone, Debug)]
pub(in crate::space) struct Made {
    pub(in crate::space) parts: Vec<(Arc<Plane>, f64)>,
    pub(in crate::space) mixing: Mode,
}

impl Made {
    fn parents(&self) -> Vec<(&Plane, f64)> {
        self.parts.iter().map(|(plane, weight)| (&**plane, *weight)).collect()
    }

    pub(in crate::space) fn profile(&self, channels: &Channels) -> Profile {
        channels.profile(&self.parents(), self.mixing)
    }
}

impl Placed {
    /// All textures with a position.
    pub(in crate::space) fn all(
        textures: &[(&TextureModel, Option<SpacePoint>)],
    ) -> Result<Vec<Self>, LeaveOneOutError> {
        let placed = textures.iter().enumerate().filter_map(|(i, (model, at))| at.map(|at| (i, *model, at)));
        placed
            .map(|(texture, model, at)| {
                let rate = higher(model.rate(), COMPARED_RATE);
                Ok(Self { texture, at, plane: Arc::new(plane_at(texture, model, rate)?) })
            })
            .collect()
    }

    /// The unchanged texture.
    pub(in crate::space) fn original(&self) -> Made {
        Made { parts: vec![(self.plane.clone(), 1.0)], mixing: Mode::Shared }
    }
}

/// Whether a position is strictly inside the hull of a space. On one axis, it is if it lies strictly between the lowest and
/// the highest position.
pub(in crate::space) fn is_inside(space: &Space, at: SpacePoint) -> bool {
    if space.n_axes() == 1 {
        // All points between the textures lie on their outline, so that a distance from it says nothing.
        let mut offsets = space.sites().iter().map(|(_, site)| site.x() - at.x());
        return offsets.clone().any(|offset| offset < -ON_HULL) && offsets.any(|offset| offset > ON_HULL);
    }
    space.locate(at).is_some_and(|location| !location.clamped) && space.hull_distance(at) > ON_HULL
}

/// The other texture nearest to `to` in the space.
pub(in crate::space) fn nearest<'a>(placed: &'a [Placed], to: &Placed) -> Option<&'a Placed> {
    let rest = placed.iter().filter(|placed| placed.texture != to.texture);
    rest.min_by(|a, b| a.at.distance(to.at).total_cmp(&b.at.distance(to.at)))
}

/// Textures of a library, as input for all spaces without one of them.
pub(in crate::space) struct Rests<'a> {
    textures: &'a [(&'a TextureModel, Option<SpacePoint>)],
    /// Planes by sample rate, indexed like the library; `None` for a texture with a higher rate. There are at most two
    /// entries: the highest rate of all textures, and the highest without the only texture that has it.
    at_rates: Vec<(Hertz, Vec<Option<Arc<Plane>>>)>,
}

impl<'a> Rests<'a> {
    pub(in crate::space) fn new(textures: &'a [(&'a TextureModel, Option<SpacePoint>)]) -> Self {
        Self { textures, at_rates: Vec::new() }
    }

    /// Predictions at the position of `left_out` from the remaining textures, one per blending.
    pub(in crate::space) fn made_without(
        &mut self,
        left_out: &Placed,
        blendings: &[Blending],
    ) -> Result<Vec<Made>, LeaveOneOutError> {
        let (left_out, at) = (left_out.texture, left_out.at);
        let space = rest_of(self.textures, left_out)?;
        let planes = self.planes_without(left_out)?;
        let authoring = self.authoring(space, &planes, blendings, left_out)?;
        let authored = blendings.iter().map(|blending| {
            let unmade = LeaveOneOutError::Unmade { texture: left_out, mode: blending.mode.id() };
            let authored = authoring.author(at, blending);
            authored.and_then(|authored| made(&authored, &planes)).ok_or(unmade)
        });
        authored.collect()
    }

    /// Predictions at positions, from all textures that have a position; `predicted` are the library indices of the textures
    /// that are predicted.
    pub(in crate::space) fn made_at(
        &mut self,
        positions: &[SpacePoint],
        blending: &Blending,
        predicted: &[usize],
    ) -> Result<Vec<Made>, LeaveOneOutError> {
        let places: Vec<Option<SpacePoint>> = self.textures.iter().map(|(_, at)| *at).collect();
        // No texture has this index, so none is left out.
        let planes = self.planes_without(usize::MAX)?;
        let first = predicted.first().copied().unwrap_or_default();
        let authoring =
            self.authoring(Space::new(&places)?, &planes, std::slice::from_ref(blending), first)?;
        let authored = positions.iter().zip(predicted).map(|(at, texture)| {
            let unmade = LeaveOneOutError::Unmade { texture: *texture, mode: blending.mode.id() };
            authoring.author(*at, blending).and_then(|authored| made(&authored, &planes)).ok_or(unmade)
        });
        authored.collect()
    }

    /// Interpolation in a space, with the models that the blendings need. An error names the texture that is predicted.
    fn authoring(
        &self,
        space: Space,
        planes: &[Option<Arc<Plane>>],
        blendings: &[Blending],
        left_out: usize,
    ) -> Result<Authoring, LeaveOneOutError> {
        let mut authoring = Authoring::new(space);
        if blendings.iter().any(|blending| blending.mode.makes_a_model()) {
            let layers = self.textures.iter().zip(planes);
            let layers = layers.map(|((model, _), plane)| Some(Layers::of(model, plane.as_deref()?)));
            let layers: Vec<Option<Layers<'_>>> = layers.collect();
            let models = Models::new(authoring.space(), &layers)
                .map_err(|source| LeaveOneOutError::Models { texture: left_out, source })?;
            authoring = authoring.with_models(Arc::new(models));
        }
        Ok(authoring)
    }

    /// Planes of the remaining textures, at the highest sample rate among them.
    fn planes_without(&mut self, left_out: usize) -> Result<Vec<Option<Arc<Plane>>>, LeaveOneOutError> {
        let placed = |(index, (model, at)): (usize, &(&'a TextureModel, Option<SpacePoint>))| {
            at.map(|_| (index, *model))
        };
        let rest = self.textures.iter().enumerate().filter_map(placed).filter(|(i, _)| *i != left_out);
        let rate =
            highest_rate(rest.map(|(_, model)| model)).map_or(COMPARED_RATE, |r| higher(r, COMPARED_RATE));
        let known = self.at_rates.iter().find(|(known, _)| *known == rate).map(|(_, planes)| planes.clone());
        let mut planes = if let Some(planes) = known {
            planes
        } else {
            let mut planes = vec![None; self.textures.len()];
            for (texture, model) in self.textures.iter().enumerate().filter_map(placed) {
                if model.rate().0 <= rate.0 {
                    planes[texture] = Some(Arc::new(plane_at(texture, model, rate)?));
                }
            }
            self.at_rates.push((rate, planes.clone()));
            planes
        };
        if let Some(plane) = planes.get_mut(left_out) {
            *plane = None;
        }
        Ok(planes)
    }
}

/// Audible textures of an interpolation result; `None` if there are none.
fn made(authored: &Authored, planes: &[Option<Arc<Plane>>]) -> Option<Made> {
    let parts = authored.voices().into_iter().map(|(voice, weight)| match voice {
        Voice::Texture(texture) => planes.get(texture).cloned().flatten().map(|plane| (plane, weight)),
        Voice::Made(model) => Some((Arc::new(Plane::new(model)), weight)),
    });
    let parts: Vec<(Arc<Plane>, f64)> = parts.collect::<Option<_>>()?;
    (!parts.is_empty()).then(|| Made { parts, mixing: authored.mixing() })
}

fn plane_at(texture: usize, model: &TextureModel, rate: Hertz) -> Result<Plane, LeaveOneOutError> {
    let converted = at_rate(model, rate).map_err(|source| LeaveOneOutError::Rate { texture, source })?;
    Ok(Plane::new(&converted.model))
}

fn higher(a: Hertz, b: Hertz) -> Hertz {
    if a.0 > b.0 { a } else { b }
}
