//! What further axes add to a space: leave-one-out errors of the field with one to six axes, which are chosen without the
//! texture that is predicted.
//!
//! Axes are chosen one after the other, each time the one with the lowest error. The error of a choice is the leave-one-out
//! error of a smoothing spline through the spectra of the textures, in closed form. A choice on all textures fits them by
//! chance, too. So the reported errors are *nested*: the textures are divided into folds; the axes are chosen without a fold,
//! and the field over the other textures predicts those of the fold. Unlike [`crate::space::leave_one_out`], textures on
//! the convex hull are predicted as well, since nearly all are on it with many axes.
//!
//! An axis that is computed from the vibration, such as the spectral centroid, contains a part of the answer. The errors then
//! say how well a texture can be authored by its coordinates, not how well ratings predict it.

mod choice;
mod nested;

use crate::space::MOST_AXES;
use crate::space::leave_one_out::LeaveOneOutError;
use crate::texture::TextureModel;

use self::choice::{Spectra, chosen};
use self::nested::nested;

/// Smallest number of textures with a value on every candidate.
const MIN_TEXTURES: usize = 10;
/// Number of parts into which the textures are divided.
const N_FOLDS: usize = 10;
/// Multiple of the standard error by which the error must fall for a step to count as helpful.
const SURE: f64 = 2.0;

/// Axis that may become part of a space.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisCandidate {
    /// Name of the axis.
    pub name: String,
    /// Coordinate of each texture, 0 to 100; `None` where it is unknown.
    pub values: Vec<Option<f64>>,
}

/// Errors with some number of axes, chosen without the textures that are predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisStep {
    /// Number of axes.
    pub n_axes: usize,
    /// Index of the candidate that is the next best on all textures.
    pub added: usize,
    /// Share of the folds that choose the same candidates.
    pub agreement: f64,
    /// Mean spectral distance between the textures and their predictions, in dB.
    pub error_db_mean: f64,
    /// Share of the textures for which the original is the closest of all to the prediction.
    pub rank1: f64,
    /// Mean spectral distance between the textures and the nearest other texture of the same space, in dB.
    pub nearest_db_mean: f64,
    /// Share of the textures for which the original is the closest of all to that nearest other texture.
    pub nearest_rank1: f64,
    /// Mean decrease of the error, in dB, with its standard error, compared with the last step that helped, or else the first
    /// one; `None` for the first step.
    pub gain_db: Option<[f64; 2]>,
}

impl AxisStep {
    /// Whether the error fell by more than chance explains.
    pub fn helps(&self) -> Option<bool> {
        self.gain_db.map(|[gain, error]| gain > SURE * error)
    }
}

/// Result of an evaluation of axes. The axes up to the last step that helps are worth using.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisEvaluation {
    /// Indices of the textures with a value on every candidate; only these were used.
    pub textures: Vec<usize>,
    /// Indices of the candidates that too few textures have.
    pub left_out: Vec<usize>,
    /// Errors with one axis more at each step.
    pub steps: Vec<AxisStep>,
}

/// Reasons why axes cannot be evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AxisEvaluationError {
    /// Too few textures have a value on every candidate.
    #[error(
        "the evaluation of axes needs {MIN_TEXTURES} textures with a value on every axis, got {n}; add textures or leave out axes"
    )]
    TooFew {
        /// Number of textures.
        n: usize,
    },
    /// The first axes are no different candidates, or too many.
    #[error("the first axes must be at most {MOST_AXES} different ones of the candidates; correct them")]
    First,
    /// A prediction failed, or the caller stopped the evaluation.
    #[error(transparent)]
    Prediction(#[from] LeaveOneOutError),
}

/// Evaluates the axes `first` (indices of candidates), then further ones up to [`MOST_AXES`], each time the candidate that
/// adds most.
///
/// Every candidate has a value for each of `textures`. A candidate that fewer than four fifths of the textures have is left
/// out, unless it is one of `first`. `on_progress` receives the number of finished folds and their total; returning `false`
/// stops the evaluation.
///
/// # Errors
/// See [`AxisEvaluationError`].
pub fn evaluate_axes(
    textures: &[&TextureModel],
    candidates: &[AxisCandidate],
    first: &[usize],
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<AxisEvaluation, AxisEvaluationError> {
    let is_different = |(at, axis): (usize, &usize)| !first[..at].contains(axis);
    if first.len() > MOST_AXES
        || first.iter().any(|axis| *axis >= candidates.len())
        || !first.iter().enumerate().all(is_different)
    {
        return Err(AxisEvaluationError::First);
    }
    let is_usual = |axis: &usize| {
        let n_known = candidates[*axis].values.iter().flatten().count();
        first.contains(axis) || 5 * n_known >= 4 * textures.len()
    };
    let (used, left_out): (Vec<usize>, Vec<usize>) = (0..candidates.len()).partition(is_usual);
    let value = |texture: usize, axis: usize| candidates[axis].values.get(texture).copied().flatten();
    let known: Vec<usize> = (0..textures.len())
        .filter(|texture| used.iter().all(|axis| value(*texture, *axis).is_some()))
        .collect();
    if known.len() < MIN_TEXTURES {
        return Err(AxisEvaluationError::TooFew { n: known.len() });
    }
    let models: Vec<&TextureModel> = known.iter().map(|texture| textures[*texture]).collect();
    let coordinates: Vec<Vec<f64>> =
        used.iter().map(|axis| known.iter().filter_map(|texture| value(*texture, *axis)).collect()).collect();
    let spectra = Spectra::new(&models)?;
    let first: Vec<usize> =
        first.iter().filter_map(|axis| used.iter().position(|candidate| candidate == axis)).collect();
    let all: Vec<usize> = (0..known.len()).collect();
    let order = chosen(&spectra, &coordinates, &all, &first);
    let n_folds = N_FOLDS.min(known.len());
    let mut steps = nested(&models, &spectra, &coordinates, &first, (&order, n_folds), on_progress)?;
    for step in &mut steps {
        step.added = used[step.added];
    }
    Ok(AxisEvaluation { textures: known, left_out, steps })
}

#[cfg(test)]
mod tests;
