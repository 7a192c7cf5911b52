//! Quality model: d′ as a weighted sum of feature distances, with fitted weights and their standard errors.

use super::{Distances, Feature};
use crate::maths::least_squares::least_squares;
use crate::maths::statistics::{dot, is_constant};
use crate::maths::weighted_statistics::weighted_variance;
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

/// Largest number of pairs of a fit.
pub const MOST_PAIRS: usize = 2000;
/// Largest number of textures of a fit; the rotations grow with its square.
pub const MOST_TEXTURES: usize = 100;

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
    /// Weight of the pair in a fit, above 0; 1 as published. A pair of weight 2 counts as two pairs.
    pub weight: f64,
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
    /// All distances by all features are zero.
    #[error("no two signals of a pair differ in any of the features; add pairs that differ")]
    Alike,
    /// All pairs have the same rating, or all ratings are zero.
    #[error(
        "all pairs have the same d', so that nothing can be predicted from it; add pairs with other ratings"
    )]
    SameRatings,
    /// A weight or a length is impossible.
    #[error(
        "the weight of {} must be 0 or more, and its length above 0, both finite; correct them, or fit the model again", .feature.id()
    )]
    Term {
        /// The feature.
        feature: Feature,
    },
    /// There are too few pairs to select among so many features.
    #[error(
        "selecting among {n_features} features needs more than {n_features} pairs besides those of any one texture, got {n_pairs}; add pairs, or choose fewer features (--features)"
    )]
    Pairs {
        /// Number of features with distances.
        n_features: usize,
        /// Pairs that remain without the pairs of one texture.
        n_pairs: usize,
    },
    /// There are more pairs or textures than can be fitted in reasonable time.
    #[error(
        "{n_pairs} pairs of {n_textures} textures are too many; use at most {MOST_PAIRS} pairs of {MOST_TEXTURES} textures"
    )]
    TooMany {
        /// Given number of pairs.
        n_pairs: usize,
        /// Given number of textures.
        n_textures: usize,
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
        let (columns, target) = model.system(pairs);
        for (term, weight) in model.terms.iter_mut().zip(non_negative(&columns, &target)) {
            term.weight = weight;
        }
        Ok(model)
    }

    /// Returns the normalized distances of each term and the ratings, all multiplied by the root of the pair's weight.
    fn system(&self, pairs: &[RatedPair]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let column = |term: &Term| -> Vec<f64> {
            let entry = |pair: &RatedPair| pair.weight.sqrt() * pair.distances.by(term.feature) / term.length;
            pairs.iter().map(entry).collect()
        };
        let target = pairs.iter().map(|pair| pair.weight.sqrt() * pair.d_prime).collect();
        (self.terms.iter().map(column).collect(), target)
    }

    /// Returns the standard errors of the weights of a model that was fitted to these pairs, in the order of
    /// [`QualityModel::terms`].
    ///
    /// They hold if the errors of the pairs are independent and their variances are inversely proportional to the weights of
    /// the pairs, and if the features were chosen before the pairs were rated. Features that were selected on the same pairs
    /// have larger errors. `None` for a weight that the constraint holds at 0, and for all if there are no more pairs than
    /// weights above 0.
    pub fn standard_errors(&self, pairs: &[RatedPair]) -> Vec<Option<f64>> {
        let free: Vec<usize> =
            (0..self.terms.len()).filter(|index| self.terms[*index].weight > 0.0).collect();
        let Some(dof) = pairs.len().checked_sub(free.len()).filter(|dof| *dof > 0) else {
            return vec![None; self.terms.len()];
        };
        let variance = self.squared_error(pairs) / dof as f64;
        let (columns, _) = self.system(pairs);
        let error = |index: usize| {
            let others = free.iter().filter(|other| **other != index);
            let others: Vec<Vec<f64>> = others.map(|other| columns[*other].clone()).collect();
            // Only the part of a column that the others do not explain determines its weight. Columns that depend on each
            // other do not come out of a fit with weights above 0.
            let own = least_squares(&others, &columns[index]).ok()?.residuals;
            let left = dot(&own, &own);
            (left > 0.0).then(|| (variance / left).sqrt())
        };
        let of_term = |index: usize| if free.contains(&index) { error(index) } else { None };
        (0..self.terms.len()).map(of_term).collect()
    }

    /// Returns the same model with the lengths that `n_pairs` pairs would have that are like the `n_corpus` pairs of its
    /// corpus, both above 0. The weights change with the lengths, so that all predictions stay.
    #[must_use]
    pub fn at_corpus_size(&self, n_corpus: usize, n_pairs: usize) -> Self {
        let share = (n_pairs as f64 / n_corpus as f64).sqrt();
        let scaled = |term: &Term| Term { weight: share * term.weight, length: share * term.length, ..*term };
        Self { terms: self.terms.iter().map(scaled).collect() }
    }

    /// Returns the weights that this model has for the features and lengths of `other`; 0 for a feature that it lacks.
    pub fn weights_at_lengths_of(&self, other: &Self) -> Vec<f64> {
        let weight = |term: &Term| {
            let own = self.terms.iter().find(|own| own.feature == term.feature);
            own.map_or(0.0, |own| own.weight / own.length * term.length)
        };
        other.terms.iter().map(weight).collect()
    }

    /// Returns features, weights and lengths.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Returns a model of stored terms.
    ///
    /// # Errors
    /// [`QualityModelError::Nothing`] without terms; [`QualityModelError::Term`] for a length that is not finite and
    /// above 0, or a weight that is not finite and 0 or more.
    pub fn of_terms(terms: Vec<Term>) -> Result<Self, QualityModelError> {
        if terms.is_empty() {
            return Err(QualityModelError::Nothing);
        }
        let is_possible = |term: &Term| {
            term.length > 0.0 && term.length.is_finite() && term.weight >= 0.0 && term.weight.is_finite()
        };
        match terms.iter().find(|term| !is_possible(term)) {
            Some(term) => Err(QualityModelError::Term { feature: term.feature }),
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

    /// Returns the sum of squared errors of predicted d′, each times the weight of its pair.
    pub fn squared_error(&self, pairs: &[RatedPair]) -> f64 {
        let error = |pair: &RatedPair| self.d_prime(&pair.distances) - pair.d_prime;
        pairs.iter().map(|pair| pair.weight * error(pair).powi(2)).sum()
    }

    /// Returns `R² = 1 - Σ w error² / Σ w (d′ - mean)²` on these pairs, with the weights w of the pairs and the weighted
    /// mean; `None` if all ratings are equal.
    pub fn r_squared(&self, pairs: &[RatedPair]) -> Option<f64> {
        r_squared(self.squared_error(pairs), pairs)
    }
}

/// As [`QualityModel::r_squared`], from the weighted sum of squared errors.
pub(super) fn r_squared(squared_error: f64, pairs: &[RatedPair]) -> Option<f64> {
    let rated: Vec<f64> = pairs.iter().map(|pair| pair.d_prime).collect();
    if is_constant(&rated) {
        return None;
    }
    let weights: Vec<f64> = pairs.iter().map(|pair| pair.weight).collect();
    let all = weights.iter().sum::<f64>() * weighted_variance(&rated, &weights);
    (all > 0.0).then(|| 1.0 - squared_error / all)
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
