//! How well authoring works, measured on signals: each texture is taken out, authored at its place from the rest, and
//! compared with itself ([`crate::fidelity`]).
//!
//! The rest is put together anew for each texture: triangles, sampled models, components and the field with its ridge.
//! Nothing of the texture that is left out is in what is authored.

mod rest;
mod signals;

use crate::authoring::{Blending, BlendingError, ModelsError};
use crate::fidelity::{Channels, Profile, error_db, is_within_measured, level_error_db};
use crate::rate::AtRateError;
use crate::render::RenderError;
use crate::space::{Space, SpacePoint};
use crate::spectrum::median;
use crate::statistics::mean;
use crate::texture::TextureModel;
use crate::triangulation::TriangulationError;

use crate::leave_one_out::rest::{Made, Placed, Rests, is_inside, nearest};
use crate::leave_one_out::signals::Rendered;

/// Fewest textures that have a place: three, and one between them.
const MIN_PLACED: usize = 4;

/// What is measured.
#[derive(Clone, Debug)]
pub struct Plan {
    /// How textures are authored.
    pub blendings: Vec<Blending>,
    /// Whether the renderer's signals are compared as well as the models.
    pub signals: Option<SignalPlan>,
}

/// How much is rendered to see whether signals are as far apart as models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalPlan {
    /// Most textures that are left out, evenly chosen where there are more.
    pub n_textures: usize,
    /// Length of each signal.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// What became of every texture, by every method.
#[derive(Clone, Debug, PartialEq)]
pub struct LeaveOneOut {
    /// The methods: a copy of the nearest texture, then the blendings in their order.
    pub methods: Vec<Summary>,
    /// Textures that lie strictly inside the hull of the rest, in the order of the library.
    pub textures: Vec<LeftOut>,
    /// Library indices of textures that have a place and lie on the hull.
    pub on_hull: Vec<usize>,
    /// Distance in dB of the two textures that are farthest apart on the first axis, where `nrs` is zero.
    pub reach_db: f64,
}

/// A way to a texture at a place where there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// A copy of the nearest texture.
    Nearest,
    /// Authoring.
    Blended(Blending),
}

/// What a method came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// Textures that were left out.
    pub n: usize,
    /// Mean distance of authored and original, in dB.
    pub error_db_mean: f64,
    /// Its median.
    pub error_db_median: f64,
    /// Mean difference of level, in dB.
    pub level_error_db_mean: f64,
    /// Share of textures whose original is the nearest of all to what was authored.
    pub rank1: f64,
    /// Share of textures whose original is among the five nearest.
    pub top5: f64,
    /// Mean of [`Outcome::nrs`]; `None` where the reach is zero.
    pub nrs_mean: Option<f64>,
    /// What the renderer's signals say about it.
    pub signals: Option<SignalCheck>,
}

/// Whether signals are as far apart as models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalCheck {
    /// Textures whose signals were compared.
    pub n: usize,
    /// Length of each signal.
    pub seconds: f64,
    /// Mean distance of the signals of authored and original, in dB.
    pub error_db_mean: f64,
    /// Mean over textures of the absolute difference of that distance from the models'.
    pub mean_difference_db: f64,
    /// The largest of these.
    pub largest_difference_db: f64,
    /// Mean distance of what was rendered from its own model, in dB.
    pub from_model_db: f64,
    /// What of that chance alone makes ([`crate::fidelity::chance_db`]).
    pub chance_db: f64,
}

/// A texture that was left out.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Its index in the library.
    pub texture: usize,
    /// Its place.
    pub at: SpacePoint,
    /// Library index of the texture nearest to it in the space.
    pub nearest: usize,
    /// Whether the speeds and forces of the comparison lie within what was measured of it; else the nearest were taken.
    pub is_within_measured: bool,
    /// What each method came to.
    pub outcomes: Vec<Outcome>,
}

/// What was authored, beside the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Their distance in dB.
    pub error_db: f64,
    /// Mean difference of level, in dB.
    pub level_error_db: f64,
    /// Place of the original among all textures by distance from what was authored, from 1.
    pub rank: usize,
    /// Normalized similarity `1 - d / reach`: one for the same model, zero for what is as far off as the two textures
    /// farthest apart on the first axis; `None` where these are the same.
    pub nrs: Option<f64>,
    /// Distance of rendered signals of the two in dB; `None` where none were rendered.
    pub signal_error_db: Option<f64>,
}

/// Why nothing was measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeaveOneOutError {
    /// Too few textures have a place.
    #[error("leaving one out needs {MIN_PLACED} textures that have a place, got {n}; place more of them")]
    TooFew {
        /// How many have one.
        n: usize,
    },
    /// All lie on the hull.
    #[error(
        "none of the {n} textures lies strictly inside the outline of the others (all on one line, perhaps), so none can be \
         authored from the rest; place some inside"
    )]
    NoneInside {
        /// How many have a place.
        n: usize,
    },
    /// A blending that asks for what its mode cannot do.
    #[error(transparent)]
    Blending(#[from] BlendingError),
    /// A place that is no number.
    #[error("the textures cannot be placed")]
    Space(#[from] TriangulationError),
    /// A texture cannot be had at the rate of the others.
    #[error("texture {texture} cannot be had at the rate of the others")]
    Rate {
        /// Its index in the library.
        texture: usize,
        /// Why.
        source: AtRateError,
    },
    /// The rest cannot be blended.
    #[error("without texture {texture} the others cannot be blended")]
    Models {
        /// Its index in the library.
        texture: usize,
        /// Why.
        source: ModelsError,
    },
    /// Nothing was authored.
    #[error("at the place of texture {texture} the mode {mode} makes no texture; leave the mode out")]
    Unmade {
        /// Its index in the library.
        texture: usize,
        /// The mode's id.
        mode: &'static str,
    },
    /// A signal could not be rendered.
    #[error("texture {texture} could not be rendered")]
    Render {
        /// Index of the one that was left out.
        texture: usize,
        /// Why.
        source: RenderError,
    },
    /// The caller asked to stop.
    #[error("stopped before the end")]
    Stopped,
}

impl LeaveOneOutError {
    /// Library index of the texture that is to blame, where one is.
    pub fn texture(&self) -> Option<usize> {
        match self {
            Self::Rate { texture, .. }
            | Self::Models { texture, .. }
            | Self::Unmade { texture, .. }
            | Self::Render { texture, .. } => Some(*texture),
            Self::TooFew { .. }
            | Self::NoneInside { .. }
            | Self::Blending(_)
            | Self::Space(_)
            | Self::Stopped => None,
        }
    }
}

/// Leaves each texture out that lies strictly inside the hull of the rest, authors one at its place and compares the two.
/// `textures` is indexed like the library; those without a place have no part in it.
///
/// `on_progress` is told how many textures are done and of how many, and stops by `false`. Cost: that of
/// [`crate::authoring::Models::new`] for each texture, tenths of a second where there are a hundred.
///
/// # Errors
/// See [`LeaveOneOutError`].
pub fn leave_one_out(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    plan: &Plan,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<LeaveOneOut, LeaveOneOutError> {
    for blending in &plan.blendings {
        blending.check()?;
    }
    let mut rests = Rests::new(textures);
    let nearest_first = std::iter::once(Method::Nearest);
    let methods = nearest_first.chain(plan.blendings.iter().cloned().map(Method::Blended)).collect();
    let mut author = |left_out: &Placed, nearest: &Placed| {
        let authored = rests.made_without(left_out, &plan.blendings)?;
        Ok(std::iter::once(nearest.original()).chain(authored).collect())
    };
    measure(textures, methods, plan.signals, &mut author, on_progress)
}

/// What makes something of the place of a texture, by each method; it is told which texture is the nearest.
type Author<'a> = dyn FnMut(&Placed, &Placed) -> Result<Vec<Made>, LeaveOneOutError> + 'a;

/// As [`leave_one_out`], with whatever `author` makes of each texture's place.
fn measure(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    methods: Vec<Method>,
    signals: Option<SignalPlan>,
    author: &mut Author<'_>,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<LeaveOneOut, LeaveOneOutError> {
    let placed = Placed::all(textures)?;
    if placed.len() < MIN_PLACED {
        return Err(LeaveOneOutError::TooFew { n: placed.len() });
    }
    let channels = Channels::of_models();
    let profiles: Vec<Profile> = placed.iter().map(|p| p.original().profile(&channels)).collect();
    let reach_db = reach_db(&placed, &profiles);
    let mut inside = Vec::new();
    let mut on_hull = Vec::new();
    for (index, texture) in placed.iter().enumerate() {
        let rest = rest_of(textures, texture.texture)?;
        if is_inside(&rest, texture.at) { inside.push(index) } else { on_hull.push(texture.texture) }
    }
    if inside.is_empty() {
        return Err(LeaveOneOutError::NoneInside { n: placed.len() });
    }
    let rendered_every = signals.map(|plan| inside.len().div_ceil(plan.n_textures.max(1)));
    let mut left_out = Vec::with_capacity(inside.len());
    let mut checks: Vec<Vec<Rendered>> = vec![Vec::new(); methods.len()];
    for (n_done, index) in inside.iter().copied().enumerate() {
        if !on_progress(n_done, inside.len()) {
            return Err(LeaveOneOutError::Stopped);
        }
        let original = &placed[index];
        let Some(nearest) = nearest(&placed, original) else {
            return Err(LeaveOneOutError::TooFew { n: placed.len() });
        };
        let made = author(original, nearest)?;
        let authored: Vec<Profile> = made.iter().map(|made| made.profile(&channels)).collect();
        let mut outcomes: Vec<Outcome> =
            authored.iter().map(|authored| outcome(authored, index, &profiles, reach_db)).collect();
        if let (Some(plan), Some(every)) = (signals, rendered_every)
            && n_done.is_multiple_of(every)
        {
            let rendered = signals::compare(&plan, original, &profiles[index], &made, &authored);
            let rendered =
                rendered.map_err(|source| LeaveOneOutError::Render { texture: original.texture, source })?;
            for ((outcome, checks), rendered) in outcomes.iter_mut().zip(&mut checks).zip(rendered) {
                outcome.signal_error_db = Some(rendered.error_db);
                checks.push(rendered);
            }
        }
        let (texture, at) = (original.texture, original.at);
        let is_within_measured = is_within_measured(&original.plane);
        left_out.push(LeftOut { texture, at, nearest: nearest.texture, is_within_measured, outcomes });
    }
    on_progress(inside.len(), inside.len());
    let summaries = methods.into_iter().zip(&checks).enumerate().map(|(index, (method, rendered))| {
        let outcomes: Vec<&Outcome> = left_out.iter().map(|left| &left.outcomes[index]).collect();
        summary(method, &outcomes, signals.and_then(|plan| signals::check(&plan, rendered)))
    });
    Ok(LeaveOneOut { methods: summaries.collect(), textures: left_out, on_hull, reach_db })
}

/// The space without one texture, its indices still those of the library.
fn rest_of(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    left_out: usize,
) -> Result<Space, TriangulationError> {
    let place = |(texture, (_, at)): (usize, &(&TextureModel, Option<SpacePoint>))| {
        at.filter(|_| texture != left_out)
    };
    Space::new(&textures.iter().enumerate().map(place).collect::<Vec<_>>())
}

/// Distance of the two textures farthest apart on the first axis.
fn reach_db(placed: &[Placed], profiles: &[Profile]) -> f64 {
    let along = |(a, _): &(&Placed, &Profile), (b, _): &(&Placed, &Profile)| {
        a.at.rough_smooth.total_cmp(&b.at.rough_smooth)
    };
    let all = || placed.iter().zip(profiles);
    match (all().min_by(along), all().max_by(along)) {
        (Some((_, rough)), Some((_, smooth))) => error_db(rough, smooth),
        _ => 0.0,
    }
}

fn outcome(authored: &Profile, original: usize, profiles: &[Profile], reach_db: f64) -> Outcome {
    let distance = error_db(authored, &profiles[original]);
    Outcome {
        error_db: distance,
        level_error_db: level_error_db(authored, &profiles[original]),
        rank: 1 + profiles.iter().filter(|other| error_db(authored, other) < distance).count(),
        nrs: (reach_db > 0.0).then_some(1.0 - distance / reach_db),
        signal_error_db: None,
    }
}

fn summary(method: Method, outcomes: &[&Outcome], signals: Option<SignalCheck>) -> Summary {
    let of = |value: fn(&Outcome) -> f64| -> Vec<f64> { outcomes.iter().map(|o| value(o)).collect() };
    let within =
        |rank: usize| outcomes.iter().filter(|o| o.rank <= rank).count() as f64 / outcomes.len() as f64;
    let nrs: Option<Vec<f64>> = outcomes.iter().map(|outcome| outcome.nrs).collect();
    let errors_db = of(|outcome| outcome.error_db);
    Summary {
        method,
        n: outcomes.len(),
        error_db_mean: mean(&errors_db),
        error_db_median: median(errors_db),
        level_error_db_mean: mean(&of(|outcome| outcome.level_error_db)),
        rank1: within(1),
        top5: within(5),
        nrs_mean: nrs.map(|nrs| mean(&nrs)),
        signals,
    }
}

#[cfg(test)]
mod tests;
