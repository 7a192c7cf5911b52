//! The complete fit of a quality model to rated pairs: selection, rotations, weights with their errors, and validation.
//!
//! It follows the paper, with these differences. The final weights are fitted to all pairs; the paper takes those of the
//! rotation with the smallest error. No weight is negative, since a distance cannot make signals more alike. The paper does
//! not state its threshold of elimination and its lengths; [`USUAL_TOLERANCE`] is ours, and lengths are those of the pairs.

use super::Feature;
use crate::signals::quality::model::{
    MOST_PAIRS, MOST_TEXTURES, PAPER_PAIRS, QualityModel, QualityModelError, RatedPair,
};
use crate::signals::quality::selection::{
    Elimination, NestedValidation, Rotation, eliminate, nested_validation, rotate, textures,
};

/// Usual relative rise of the squared error at which elimination stops. With the 25 pairs and 7 features of the paper, removing
/// three features of pure noise raises the error by 3 / (25 - 7) = 17 % on average.
pub const USUAL_TOLERANCE: f64 = 0.2;

/// A model that was fitted to rated pairs, and how far it can be trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct QualityFit {
    /// Model with the kept features, fitted to all pairs. Its lengths are scaled to [`PAPER_PAIRS`] pairs, so that weights of
    /// tables of different sizes can be compared.
    pub model: QualityModel,
    /// Standard errors of the weights, in the order of [`QualityModel::terms`] ([`QualityModel::standard_errors`]).
    pub standard_errors: Vec<Option<f64>>,
    /// Selection of the features on all pairs.
    pub elimination: Elimination,
    /// Fits with the kept features without the pairs of two textures, the best first.
    pub rotations: Vec<Rotation>,
    /// Validation with pairs of textures that neither selection nor fit know.
    pub nested: NestedValidation,
    /// R² of the model on the pairs that it was fitted to; `None` if all ratings are equal. It is optimistic.
    pub r_squared: Option<f64>,
    /// The same, corrected for the number of weights above 0; `None` if there are no more pairs than weights.
    pub adjusted_r_squared: Option<f64>,
    /// R² of the model with all features, before the elimination.
    pub r_squared_of_all: Option<f64>,
}

/// Fits a model to rated pairs with the best of these features. `tolerance` is that of [`eliminate`], 0 or more.
///
/// # Errors
/// [`QualityModelError::TooMany`], [`QualityModelError::SameRatings`], and those of [`eliminate`], [`rotate`] and
/// [`nested_validation`].
pub fn fit_quality_model(
    features: &[Feature],
    pairs: &[RatedPair],
    tolerance: f64,
) -> Result<QualityFit, QualityModelError> {
    let (n_pairs, n_textures) = (pairs.len(), textures(pairs)?.len());
    if n_pairs > MOST_PAIRS || n_textures > MOST_TEXTURES {
        return Err(QualityModelError::TooMany { n_pairs, n_textures });
    }
    if features.is_empty() {
        return Err(QualityModelError::Nothing);
    }
    let nested = nested_validation(features, pairs, tolerance)?;
    if pairs.windows(2).all(|two| two[0].d_prime.total_cmp(&two[1].d_prime).is_eq()) {
        return Err(QualityModelError::SameRatings);
    }
    let elimination = eliminate(features, pairs, tolerance)?;
    let rotations = rotate(&elimination.kept, pairs)?;
    let fitted = QualityModel::fitted(&elimination.kept, pairs)?;
    let model = fitted.at_corpus_size(n_pairs, PAPER_PAIRS);
    let r_squared = model.r_squared(pairs);
    let n_weights = model.terms().iter().filter(|term| term.weight > 0.0).count();
    let adjusted = |r_squared: f64| {
        let dof = n_pairs.checked_sub(n_weights).filter(|dof| *dof > 0)?;
        Some(1.0 - (1.0 - r_squared) * (n_pairs - 1) as f64 / dof as f64)
    };
    let dropped = elimination.dropped.iter().map(|(feature, _)| *feature);
    let all: Vec<Feature> = elimination.kept.iter().copied().chain(dropped).collect();
    Ok(QualityFit {
        standard_errors: model.standard_errors(pairs),
        adjusted_r_squared: r_squared.and_then(adjusted),
        r_squared_of_all: QualityModel::fitted(&all, pairs)?.r_squared(pairs),
        model,
        elimination,
        rotations,
        nested,
        r_squared,
    })
}

#[cfg(test)]
mod tests;
