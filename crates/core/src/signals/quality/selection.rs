//! Selection of the features of a quality model, and its validation with pairs of textures that it does not know.

use super::Feature;
use crate::signals::quality::model::{QualityModel, QualityModelError, RatedPair, r_squared};

/// Result of backward elimination.
#[derive(Clone, Debug, PartialEq)]
pub struct Elimination {
    /// Remaining features, in the order of [`Feature::ALL`].
    pub kept: Vec<Feature>,
    /// Removed features, first to last, each with the sum of squared errors after its removal.
    pub dropped: Vec<(Feature, f64)>,
}

/// Returns the result of backward elimination: removes the feature that raises the error least, step by step.
///
/// It stops before the sum of squared errors would exceed that of all features by more than `tolerance` (0.1 for 10 %).
/// Features with zero distances throughout are removed first and not listed as dropped.
///
/// # Errors
/// [`QualityModelError::Nothing`], and [`QualityModelError::Alike`] if all distances are zero.
pub fn eliminate(
    features: &[Feature],
    pairs: &[RatedPair],
    tolerance: f64,
) -> Result<Elimination, QualityModelError> {
    if pairs.is_empty() || features.is_empty() {
        return Err(QualityModelError::Nothing);
    }
    let mut kept = differing(features, pairs)?;
    let error = |features: &[Feature]| -> Result<f64, QualityModelError> {
        Ok(QualityModel::fitted(features, pairs)?.squared_error(pairs))
    };
    let limit = (1.0 + tolerance) * error(&kept)?;
    let mut dropped = Vec::new();
    while kept.len() > 1 {
        let mut without: Vec<(usize, f64)> = Vec::with_capacity(kept.len());
        for index in 0..kept.len() {
            let rest: Vec<Feature> = kept.iter().copied().filter(|feature| *feature != kept[index]).collect();
            without.push((index, error(&rest)?));
        }
        let Some((index, error)) = without.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if error > limit {
            break;
        }
        dropped.push((kept.remove(index), error));
    }
    Ok(Elimination { kept, dropped })
}

/// A model fitted to some textures and evaluated on all.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// Left-out textures.
    pub left_out: [usize; 2],
    /// Model fitted to the other textures. It lacks features in which none of their pairs differ.
    pub model: QualityModel,
    /// Sum of squared errors over all textures.
    pub squared_error: f64,
    /// Sum of squared errors over the left-out textures, which are out-of-sample.
    pub squared_error_left_out: f64,
}

/// Returns one model for each pair of left-out textures, sorted by error over all textures, best first.
///
/// The paper reports the best rotation, which is optimistic. The unbiased figure is `squared_error_left_out` over all
/// rotations.
///
/// # Errors
/// [`QualityModelError::Textures`], and [`QualityModelError::Alike`] if the pairs of the textures that remain differ in none
/// of the features.
pub fn rotate(features: &[Feature], pairs: &[RatedPair]) -> Result<Vec<Rotation>, QualityModelError> {
    let textures = textures(pairs)?;
    let mut rotations = Vec::new();
    for (i, first) in textures.iter().enumerate() {
        for second in &textures[i + 1..] {
            let left_out = [*first, *second];
            let (out, used) = without(&left_out, pairs);
            let model = QualityModel::fitted(&differing(features, &used)?, &used)?;
            let squared_error_left_out = model.squared_error(&out);
            let squared_error = squared_error_left_out + model.squared_error(&used);
            rotations.push(Rotation { left_out, model, squared_error, squared_error_left_out });
        }
    }
    rotations.sort_by(|a, b| a.squared_error.total_cmp(&b.squared_error));
    Ok(rotations)
}

/// Nested cross-validation: predictions of pairs by models that were selected and fitted without their texture.
#[derive(Clone, Debug, PartialEq)]
pub struct NestedValidation {
    /// Predicted d′, in the order of the pairs.
    pub predicted: Vec<f64>,
    /// Features that were kept without each texture, in ascending order of the textures.
    pub kept: Vec<Vec<Feature>>,
    /// `R² = 1 - Σ w error² / Σ w (d′ - mean)²`, with the weights w of the pairs; `None` if all ratings are equal. It is
    /// negative if the predictions are worse than the mean of all ratings.
    pub r_squared: Option<f64>,
}

/// Leaves each texture in turn out of both feature selection and weight fit, and predicts its pairs.
///
/// # Errors
/// [`QualityModelError::Textures`], [`QualityModelError::Pairs`], and those of [`eliminate`].
pub fn nested_validation(
    features: &[Feature],
    pairs: &[RatedPair],
    tolerance: f64,
) -> Result<NestedValidation, QualityModelError> {
    let mut predicted = vec![0.0; pairs.len()];
    let mut kept = Vec::new();
    for texture in textures(pairs)? {
        let (_, used) = without(&[texture], pairs);
        let n_features = differing(features, &used)?.len();
        if used.len() <= n_features {
            // All features would fit the ratings exactly, and no feature could be removed.
            return Err(QualityModelError::Pairs { n_features, n_pairs: used.len() });
        }
        let of_fold = eliminate(features, &used, tolerance)?.kept;
        let model = QualityModel::fitted(&of_fold, &used)?;
        for (predicted, pair) in predicted.iter_mut().zip(pairs).filter(|(_, pair)| pair.texture == texture) {
            *predicted = model.d_prime(&pair.distances);
        }
        kept.push(of_fold);
    }
    let squared_error: f64 =
        pairs.iter().zip(&predicted).map(|(pair, d)| pair.weight * (d - pair.d_prime).powi(2)).sum();
    Ok(NestedValidation { r_squared: r_squared(squared_error, pairs), predicted, kept })
}

/// Returns the distinct textures of the pairs in ascending order, at least three.
pub(super) fn textures(pairs: &[RatedPair]) -> Result<Vec<usize>, QualityModelError> {
    let mut textures: Vec<usize> = pairs.iter().map(|pair| pair.texture).collect();
    textures.sort_unstable();
    textures.dedup();
    let n = textures.len();
    if n < 3 { Err(QualityModelError::Textures { n }) } else { Ok(textures) }
}

/// Returns the features in which the signals of any pair differ, in the order of [`Feature::ALL`].
fn differing(features: &[Feature], pairs: &[RatedPair]) -> Result<Vec<Feature>, QualityModelError> {
    let differs = |feature: &Feature| pairs.iter().any(|pair| pair.distances.by(*feature) > 0.0);
    let mut differing: Vec<Feature> = features.iter().copied().filter(differs).collect();
    differing.sort();
    differing.dedup();
    if differing.is_empty() { Err(QualityModelError::Alike) } else { Ok(differing) }
}

/// Returns the pairs of the left-out textures, and all others.
fn without(left_out: &[usize], pairs: &[RatedPair]) -> (Vec<RatedPair>, Vec<RatedPair>) {
    pairs.iter().cloned().partition(|pair| left_out.contains(&pair.texture))
}
