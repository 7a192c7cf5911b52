//! Leave-one-out error of the interpolation, measured as spectral distance. Each texture is removed, interpolated at
//! its position from the remaining textures, and compared with the original ([`crate::space::fidelity`]).
//!
//! For each removed texture, everything is recomputed from the remaining textures: triangulation, sampled models,
//! principal components and the field with its ridge parameter. Nothing of the removed texture enters the interpolated
//! texture except its position. A position that was computed from the vibration of the texture, like the roughness of
//! physical labels from its level, contains part of the answer; [`Outcome::shape_error_db`] excludes the overall
//! level.

mod error;
mod parts;
pub(in crate::space) mod rest;
mod signals;

pub use crate::space::leave_one_out::error::LeaveOneOutError;
pub use crate::space::leave_one_out::parts::{LeaveOneOutPart, PartsError, join_parts};

use crate::dsp::spectrum::median;
use crate::maths::shard::Shard;
use crate::maths::statistics::mean;
use crate::space::authoring::Blending;
use crate::space::fidelity::{
    Channels, Profile, error_db, is_within_measured, level_error_db, shape_error_db,
};
use crate::space::{Space, SpaceError, SpacePoint};
use crate::texture::TextureModel;

use crate::space::leave_one_out::rest::{Made, Placed, Rests, is_inside, nearest};

/// Minimum number of textures with a position: three, and one inside their triangle.
const MIN_PLACED: usize = 4;

/// Options of the evaluation.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Interpolation options to evaluate.
    pub blendings: Vec<Blending>,
    /// Whether and how rendered signals are compared in addition to the models.
    pub signals: Option<SignalPlan>,
}

/// Amount of rendering for the comparison of signals with models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalPlan {
    /// Maximum number of textures to render, evenly chosen if there are more.
    pub n_textures: usize,
    /// Length of each signal, in seconds.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// Leave-one-out results of all methods and textures.
#[derive(Clone, Debug, PartialEq)]
pub struct LeaveOneOut {
    /// Summary per method: a copy of the nearest texture first, then the interpolation options in their order.
    pub methods: Vec<Summary>,
    /// Results per evaluated texture, in library order. In a space of one or two axes, only textures strictly inside the hull
    /// of the others are evaluated.
    pub textures: Vec<LeftOut>,
    /// Library indices of the textures that have a position but lie on the hull, and so are not evaluated.
    pub on_hull: Vec<usize>,
    /// Spectral distance in dB between the two textures that are farthest apart on the first axis; [`Outcome::nrs`] is
    /// zero at this distance.
    pub reach_db: f64,
}

/// Method that predicts the texture at a position.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Copy of the nearest texture, the baseline.
    Nearest,
    /// Interpolation with these options.
    Blended(Blending),
}

/// Leave-one-out summary of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// Number of textures evaluated.
    pub n: usize,
    /// Mean spectral distance between interpolated and original texture, in dB.
    pub error_db_mean: f64,
    /// Median of that distance, in dB.
    pub error_db_median: f64,
    /// Mean absolute level difference, in dB.
    pub level_error_db_mean: f64,
    /// Mean of [`Outcome::shape_error_db`], in dB.
    pub shape_error_db_mean: f64,
    /// Fraction of textures for which the original is the closest of all textures to the interpolated texture.
    pub rank1: f64,
    /// Fraction of textures for which the original is among the five closest.
    pub top5: f64,
    /// Mean of [`Outcome::nrs`]; `None` if the reach is zero.
    pub nrs_mean: Option<f64>,
    /// Comparison with rendered signals, if requested.
    pub signals: Option<SignalCheck>,
}

/// Agreement between distances of rendered signals and distances of models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalCheck {
    /// Number of textures with rendered signals.
    pub n: usize,
    /// Length of each signal, in seconds.
    pub seconds: f64,
    /// Mean spectral distance between the signals of interpolated and original texture, in dB.
    pub error_db_mean: f64,
    /// Mean spectral distance between the models of the same textures, in dB.
    pub model_error_db_mean: f64,
    /// Mean over textures of the absolute difference between signal distance and model distance, in dB.
    pub mean_difference_db: f64,
    /// Largest of these differences, in dB.
    pub largest_difference_db: f64,
    /// Mean spectral distance between a rendered signal and its own model, in dB.
    pub from_model_db: f64,
    /// Part of that distance expected from random estimation error alone, in dB
    /// ([`crate::space::fidelity::chance_db`]).
    pub chance_db: f64,
}

/// Leave-one-out result of one texture.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Library index of the texture.
    pub texture: usize,
    /// Position of the texture.
    pub at: SpacePoint,
    /// Library index of the nearest other texture in the space.
    pub nearest: usize,
    /// Whether the measured range of the texture contains all compared speeds and forces; otherwise they were clamped.
    pub is_within_measured: bool,
    /// Outcome of each method.
    pub outcomes: Vec<Outcome>,
}

/// Comparison of one interpolated texture with its original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Spectral distance, in dB.
    pub error_db: f64,
    /// Mean absolute level difference, in dB.
    pub level_error_db: f64,
    /// Spectral distance that remains when the overall level of the original is known, in dB
    /// ([`crate::space::fidelity::shape_error_db`]). Positions that were computed from levels do not lower it.
    pub shape_error_db: f64,
    /// Rank of the original among all textures by distance from the interpolated one, starting at 1.
    pub rank: usize,
    /// Normalized similarity `1 - d / reach`: one for identical models, zero for a distance equal to that of the two
    /// textures farthest apart on the first axis. `None` if that distance is zero.
    pub nrs: Option<f64>,
    /// Spectral distance between rendered signals, in dB; `None` if none were rendered.
    pub signal_error_db: Option<f64>,
    /// Spectral distance between the rendered signal and its own model, in dB; `None` if none was rendered.
    pub signal_from_model_db: Option<f64>,
}

/// Interpolates every texture that lies strictly inside the hull of the others from the remaining textures, and
/// compares it with the original. On one axis, these are all but the textures at its ends. In a space with more than two
/// axes nearly all textures lie on the hull, so all are evaluated. `textures` is indexed like the library; textures without a position are ignored.
///
/// `on_progress` receives the number of finished textures and their total; returning `false` stops the evaluation.
/// Cost: one [`crate::space::authoring::Models::new`] per texture, tenths of a second for a hundred textures.
///
/// # Errors
/// See [`LeaveOneOutError`].
pub fn leave_one_out(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    plan: &Plan,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<LeaveOneOut, LeaveOneOutError> {
    let part = leave_one_out_part(textures, plan, Shard::WHOLE, on_progress)?;
    Ok(part.alone(methods_of(plan), plan.signals))
}

/// As [`leave_one_out`], for a part of the evaluated textures. All parts together are the whole ([`join_parts`]), to the bit.
///
/// # Errors
/// See [`LeaveOneOutError`].
pub fn leave_one_out_part(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    plan: &Plan,
    shard: Shard,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<LeaveOneOutPart, LeaveOneOutError> {
    let n_axes = textures.iter().find_map(|(_, at)| *at).map_or(2, SpacePoint::n_axes);
    for blending in &plan.blendings {
        blending.check_in(n_axes)?;
    }
    let mut rests = Rests::new(textures);
    let mut author = |left_out: &Placed, nearest: &Placed| {
        let authored = rests.made_without(left_out, &plan.blendings)?;
        Ok(std::iter::once(nearest.original()).chain(authored).collect())
    };
    measure(textures, (plan.signals, shard), &mut author, on_progress)
}

/// Methods of a plan: a copy of the nearest texture, then its interpolation options.
fn methods_of(plan: &Plan) -> Vec<Method> {
    std::iter::once(Method::Nearest).chain(plan.blendings.iter().cloned().map(Method::Blended)).collect()
}

/// Predicts the texture at the position of a removed texture, with every method. The arguments are the removed texture
/// and the nearest other texture.
type Author<'a> = dyn FnMut(&Placed, &Placed) -> Result<Vec<Made>, LeaveOneOutError> + 'a;

/// Like [`leave_one_out_part`], with predictions from `author`.
fn measure(
    textures: &[(&TextureModel, Option<SpacePoint>)],
    (signals, shard): (Option<SignalPlan>, Shard),
    author: &mut Author<'_>,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<LeaveOneOutPart, LeaveOneOutError> {
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
        if !rest.is_triangulated() || is_inside(&rest, texture.at) {
            inside.push(index);
        } else {
            on_hull.push(texture.texture);
        }
    }
    if inside.is_empty() {
        let n = placed.len();
        let is_line = placed.iter().all(|texture| texture.at.n_axes() == 1);
        return Err(if is_line {
            LeaveOneOutError::NoneBetween { n }
        } else {
            LeaveOneOutError::NoneInside { n }
        });
    }
    let rendered_every = signals.map(|plan| inside.len().div_ceil(plan.n_textures.max(1)));
    let ours: Vec<usize> = shard.indices(inside.len()).collect();
    let mut left_out = Vec::with_capacity(ours.len());
    for (n_done, turn) in ours.iter().copied().enumerate() {
        if !on_progress(n_done, ours.len()) {
            return Err(LeaveOneOutError::Stopped);
        }
        let index = inside[turn];
        let original = &placed[index];
        let Some(nearest) = nearest(&placed, original) else {
            return Err(LeaveOneOutError::TooFew { n: placed.len() });
        };
        let made = author(original, nearest)?;
        let authored: Vec<Profile> = made.iter().map(|made| made.profile(&channels)).collect();
        let mut outcomes: Vec<Outcome> =
            authored.iter().map(|authored| outcome(authored, index, &profiles, reach_db)).collect();
        if let (Some(plan), Some(every)) = (signals, rendered_every)
            && turn.is_multiple_of(every)
        {
            let rendered = signals::compare(&plan, original, &profiles[index], &made, &authored);
            let rendered =
                rendered.map_err(|source| LeaveOneOutError::Render { texture: original.texture, source })?;
            for (outcome, rendered) in outcomes.iter_mut().zip(rendered) {
                outcome.signal_error_db = Some(rendered.error_db);
                outcome.signal_from_model_db = Some(rendered.from_model_db);
            }
        }
        let (texture, at) = (original.texture, original.at);
        let is_within_measured = is_within_measured(&original.plane);
        left_out.push(LeftOut { texture, at, nearest: nearest.texture, is_within_measured, outcomes });
    }
    on_progress(ours.len(), ours.len());
    Ok(LeaveOneOutPart { shard, n_evaluated: inside.len(), textures: left_out, on_hull, reach_db })
}

/// Space without one texture; its indices are still those of the library.
fn rest_of(textures: &[(&TextureModel, Option<SpacePoint>)], left_out: usize) -> Result<Space, SpaceError> {
    let place = |(texture, (_, at)): (usize, &(&TextureModel, Option<SpacePoint>))| {
        at.filter(|_| texture != left_out)
    };
    Space::new(&textures.iter().enumerate().map(place).collect::<Vec<_>>())
}

/// Spectral distance between the two textures that are farthest apart on the first axis.
fn reach_db(placed: &[Placed], profiles: &[Profile]) -> f64 {
    let along = |(a, _): &(&Placed, &Profile), (b, _): &(&Placed, &Profile)| a.at.x().total_cmp(&b.at.x());
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
        shape_error_db: shape_error_db(authored, &profiles[original]),
        rank: 1 + profiles.iter().filter(|other| error_db(authored, other) < distance).count(),
        nrs: (reach_db > 0.0).then_some(1.0 - distance / reach_db),
        signal_error_db: None,
        signal_from_model_db: None,
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
        shape_error_db_mean: mean(&of(|outcome| outcome.shape_error_db)),
        rank1: within(1),
        top5: within(5),
        nrs_mean: nrs.map(|nrs| mean(&nrs)),
        signals,
    }
}

#[cfg(test)]
mod tests;
