//! Quality model: d′ as a weighted sum of feature distances, with fitted weights and feature selection.

use super::{Distances, Feature};
use crate::maths::least_squares::least_squares;
use crate::maths::statistics::{centered, dot};
use crate::units::Hertz;

/// Features selected in the paper.
pub const PAPER_FEATURES: [Feature; 4] =
    [Feature::Roughness, Feature::Brightness, Feature::SpectralPower, Feature::Envelope];
/// Weights of the paper's best rotation, for distances normalized to unit length over its 25 pairs.
///
/// The normalization lengths were not published, so a similar corpus must supply them.
pub const PAPER_WEIGHTS: [f64; 4] = [5.2, 3.8, 6.3, 3.3];
/// Number of signal pairs in the paper; lengths are sums over pairs.
pub const PAPER_PAIRS: usize = 25;
/// Sampling rate of the paper's signals.
pub const PAPER_RATE: Hertz = Hertz(2000.0);

/// Largest number of features in a fit: all subsets are enumerated.
const MOST_FEATURES: usize = 7;

/// A rated pair of signals.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedPair {
    /// Texture of the reference; pairs of one texture are left out together.
    pub texture: usize,
    /// Distances between the signals.
    pub distances: Distances,
    /// Rated discriminability d′.
    pub d_prime: f64,
}

/// Predicts d′ from distances: `d′ = Σ w x / ‖x‖`, with the normalization lengths ‖x‖ of the corpus behind the weights.
#[derive(Clone, Debug, PartialEq)]
pub struct QualityModel {
    terms: Vec<Term>,
}

/// A feature with its weight and normalization length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The feature.
    pub feature: Feature,
    /// Contribution of a normalized distance to d′, at least 0.
    pub weight: f64,
    /// Root sum of squares of the distances over the corpus, in the feature's unit, above 0.
    pub length: f64,
}

/// Reasons why there is no model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityModelError {
    /// There are no pairs, or no features.
    #[error("a model needs at least one rated pair and one feature; add them")]
    Nothing,
    /// All distances of the corpus by one feature are zero.
    #[error("no two signals of the corpus differ in {}; leave this feature out", .feature.id())]
    Constant {
        /// The feature.
        feature: Feature,
    },
    /// There are too few textures to leave some out.
    #[error("leaving textures out needs 3 or more, got {n}; add pairs of other textures")]
    Textures {
        /// Given number of textures.
        n: usize,
    },
}

impl QualityModel {
    /// Returns a model with known weights and the normalization lengths of a corpus.
    ///
    /// # Errors
    /// [`QualityModelError::Nothing`], [`QualityModelError::Constant`].
    pub fn weighted(weights: &[(Feature, f64)], corpus: &[Distances]) -> Result<Self, QualityModelError> {
        if weights.is_empty() || corpus.is_empty() {
            return Err(QualityModelError::Nothing);
        }
        let term = |(feature, weight): &(Feature, f64)| {
            let length = corpus.iter().map(|d| d.by(*feature).powi(2)).sum::<f64>().sqrt();
            if length > 0.0 {
                Ok(Term { feature: *feature, weight: *weight, length })
            } else {
                Err(QualityModelError::Constant { feature: *feature })
            }
        };
        Ok(Self { terms: weights.iter().map(term).collect::<Result<_, _>>()? })
    }

    /// Returns the model with the least-squares weights under the constraint that none is negative.
    ///
    /// # Errors
    /// [`QualityModelError::Nothing`], [`QualityModelError::Constant`].
    pub fn fitted(features: &[Feature], pairs: &[RatedPair]) -> Result<Self, QualityModelError> {
        let corpus: Vec<Distances> = pairs.iter().map(|pair| pair.distances).collect();
        let even: Vec<(Feature, f64)> = features.iter().map(|feature| (*feature, 1.0)).collect();
        let mut model = Self::weighted(&even, &corpus)?;
        let columns: Vec<Vec<f64>> = model
            .terms
            .iter()
            .map(|term| corpus.iter().map(|d| d.by(term.feature) / term.length).collect())
            .collect();
        let target: Vec<f64> = pairs.iter().map(|pair| pair.d_prime).collect();
        for (term, weight) in model.terms.iter_mut().zip(non_negative(&columns, &target)) {
            term.weight = weight;
        }
        Ok(model)
    }

    /// Returns features, weights and lengths.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Returns a model of stored terms.
    ///
    /// # Errors
    /// [`QualityModelError::Nothing`] without terms; [`QualityModelError::Constant`] for a length that is not finite
    /// and above 0, or a negative weight.
    pub fn of_terms(terms: Vec<Term>) -> Result<Self, QualityModelError> {
        if terms.is_empty() {
            return Err(QualityModelError::Nothing);
        }
        match terms.iter().find(|term| !(term.length > 0.0 && term.length.is_finite() && term.weight >= 0.0))
        {
            Some(term) => Err(QualityModelError::Constant { feature: term.feature }),
            None => Ok(Self { terms }),
        }
    }

    /// Returns the predicted d′ of a pair of signals; 0 for equal signals.
    pub fn d_prime(&self, distances: &Distances) -> f64 {
        self.parts(distances).map(|(_, part)| part).sum()
    }

    /// Returns the contribution of each feature to d′.
    pub fn parts(&self, distances: &Distances) -> impl Iterator<Item = (Feature, f64)> {
        self.terms.iter().map(|term| (term.feature, term.weight * distances.by(term.feature) / term.length))
    }

    /// Returns the sum of squared errors of predicted d′.
    pub fn squared_error(&self, pairs: &[RatedPair]) -> f64 {
        pairs.iter().map(|pair| (self.d_prime(&pair.distances) - pair.d_prime).powi(2)).sum()
    }

    /// Returns `R² = 1 - Σ error² / Σ (d′ - mean)²` on these pairs; `None` if all ratings are equal.
    pub fn r_squared(&self, pairs: &[RatedPair]) -> Option<f64> {
        r_squared(self.squared_error(pairs), pairs)
    }
}

fn r_squared(squared_error: f64, pairs: &[RatedPair]) -> Option<f64> {
    let rated: Vec<f64> = pairs.iter().map(|pair| pair.d_prime).collect();
    let centered = centered(&rated);
    let all = dot(&centered, &centered);
    (all > 0.0).then(|| 1.0 - squared_error / all)
}

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
/// [`QualityModelError::Nothing`].
pub fn eliminate(
    features: &[Feature],
    pairs: &[RatedPair],
    tolerance: f64,
) -> Result<Elimination, QualityModelError> {
    if pairs.is_empty() {
        return Err(QualityModelError::Nothing);
    }
    let differs = |feature: &Feature| pairs.iter().any(|pair| pair.distances.by(*feature) > 0.0);
    let mut kept: Vec<Feature> = features.iter().copied().filter(differs).collect();
    kept.sort();
    let error = |features: &[Feature]| Ok(QualityModel::fitted(features, pairs)?.squared_error(pairs));
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
    /// Model fitted to the other textures.
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
/// [`QualityModelError::Textures`], and those of [`QualityModel::fitted`].
pub fn rotate(features: &[Feature], pairs: &[RatedPair]) -> Result<Vec<Rotation>, QualityModelError> {
    let textures = textures(pairs)?;
    let mut rotations = Vec::new();
    for (i, first) in textures.iter().enumerate() {
        for second in &textures[i + 1..] {
            let left_out = [*first, *second];
            let (out, used) = without(&left_out, pairs);
            let model = QualityModel::fitted(features, &used)?;
            let squared_error_left_out = model.squared_error(&out);
            let squared_error = squared_error_left_out + model.squared_error(&used);
            rotations.push(Rotation { left_out, model, squared_error, squared_error_left_out });
        }
    }
    rotations.sort_by(|a, b| a.squared_error.total_cmp(&b.squared_error));
    Ok(rotations)
}

/// Returns the nested leave-one-texture-out R²: `1 - Σ error² / Σ (d′ - mean)²`; `None` if all ratings are equal.
///
/// Each texture in turn is left out of both feature selection and weight fit, so it is fully out-of-sample.
///
/// # Errors
/// [`QualityModelError::Textures`], and those of [`eliminate`].
pub fn nested_r_squared(
    features: &[Feature],
    pairs: &[RatedPair],
    tolerance: f64,
) -> Result<Option<f64>, QualityModelError> {
    let mut squared_error = 0.0;
    for texture in textures(pairs)? {
        let (out, used) = without(&[texture], pairs);
        let kept = eliminate(features, &used, tolerance)?.kept;
        squared_error += QualityModel::fitted(&kept, &used)?.squared_error(&out);
    }
    Ok(r_squared(squared_error, pairs))
}

/// Returns the distinct textures of the pairs, at least three.
fn textures(pairs: &[RatedPair]) -> Result<Vec<usize>, QualityModelError> {
    let mut textures: Vec<usize> = pairs.iter().map(|pair| pair.texture).collect();
    textures.sort_unstable();
    textures.dedup();
    let n = textures.len();
    if n < 3 { Err(QualityModelError::Textures { n }) } else { Ok(textures) }
}

/// Returns the pairs of the left-out textures, and all others.
fn without(left_out: &[usize], pairs: &[RatedPair]) -> (Vec<RatedPair>, Vec<RatedPair>) {
    pairs.iter().cloned().partition(|pair| left_out.contains(&pair.texture))
}

/// Returns the non-negative least-squares coefficients.
///
/// With few columns, all subsets are enumerated. The best subset whose unconstrained solution has no negative
/// coefficient is the solution (Lawson and Hanson 1974, ch. 23).
fn non_negative(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    debug_assert!(columns.len() <= MOST_FEATURES, "at most MOST_FEATURES columns are supported");
    let mut best = (dot(target, target), vec![0.0; columns.len()]);
    for subset in 1_u32..1 << columns.len() {
        let is_in = |index: &usize| subset >> index & 1 == 1;
        let indices: Vec<usize> = (0..columns.len()).filter(is_in).collect();
        let chosen: Vec<Vec<f64>> = indices.iter().map(|index| columns[*index].clone()).collect();
        // Another subset covers linearly dependent columns.
        let Ok(fit) = least_squares(&chosen, target) else { continue };
        let error = dot(&fit.residuals, &fit.residuals);
        if error < best.0 && fit.coefficients.iter().all(|c| *c >= 0.0) {
            let mut coefficients = vec![0.0; columns.len()];
            for (index, c) in indices.into_iter().zip(fit.coefficients) {
                coefficients[index] = c;
            }
            best = (error, coefficients);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::non_negative;
    use crate::maths::statistics::dot;
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        /// Karush-Kuhn-Tucker conditions: no negative coefficient, no descent direction into the feasible set, and zero
        /// gradient for free coefficients.
        #[test]
        fn no_better_coefficients_are_allowed(
            columns in prop::collection::vec(prop::collection::vec(0.0_f64..1.0, 9), 1..6),
            target in prop::collection::vec(-1.0_f64..3.0, 9),
        ) {
            let coefficients = non_negative(&columns, &target);
            let mut residuals = target.clone();
            for (column, c) in columns.iter().zip(&coefficients) {
                prop_assert!(*c >= 0.0);
                for (r, x) in residuals.iter_mut().zip(column) {
                    *r -= c * x;
                }
            }
            for (column, c) in columns.iter().zip(&coefficients) {
                let slope = dot(column, &residuals);
                prop_assert!(slope < 1e-8 && (*c == 0.0 || slope.abs() < 1e-8), "{slope} at {c}");
            }
        }
    }
}
