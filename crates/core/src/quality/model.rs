//! Distances to d′: a weighted sum, its weights fitted, its features chosen.

use super::{Distances, Feature};
use crate::least_squares::least_squares;
use crate::statistics::{centered, dot};
use crate::units::Hertz;

/// The features that the paper kept.
pub const PAPER_FEATURES: [Feature; 4] =
    [Feature::Roughness, Feature::Brightness, Feature::SpectralPower, Feature::Envelope];
/// Their weights: those of the best of the paper's rotations, for distances scaled to unit length over its 25 pairs. The
/// lengths were not published, so they have to come from a corpus that is like it.
pub const PAPER_WEIGHTS: [f64; 4] = [5.2, 3.8, 6.3, 3.3];
/// How many pairs of signals the paper had: lengths are sums over pairs.
pub const PAPER_PAIRS: usize = 25;
/// The rate of its signals.
pub const PAPER_RATE: Hertz = Hertz(2000.0);

/// Most features that are fitted: subsets are tried one by one.
const MOST_FEATURES: usize = 7;

/// A pair of signals that people have rated.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedPair {
    /// What the reference is: pairs of one texture are left out together.
    pub texture: usize,
    /// How far the signals lie apart.
    pub distances: Distances,
    /// How well people told them apart.
    pub d_prime: f64,
}

/// Predicts d′ from distances: `d′ = Σ w x / ‖x‖`, with the lengths of the corpus that the weights were made for.
#[derive(Clone, Debug, PartialEq)]
pub struct QualityModel {
    terms: Vec<Term>,
}

/// A feature with its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The feature.
    pub feature: Feature,
    /// What a distance counts in d′ once it is scaled, at least 0.
    pub weight: f64,
    /// Root of the sum of the squares of the distances over the corpus, in the feature's unit, above 0.
    pub length: f64,
}

/// Why there is no model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityModelError {
    /// No pairs, or no features.
    #[error("a model needs rated pairs and features")]
    Nothing,
    /// A feature by which no two signals of the corpus differ.
    #[error("no two signals of the corpus differ in {}; leave it out", .feature.id())]
    Constant {
        /// The feature.
        feature: Feature,
    },
    /// Too few textures to leave some out.
    #[error("{n} textures are too few to leave two out; three or more are needed")]
    Textures {
        /// How many there are.
        n: usize,
    },
}

impl QualityModel {
    /// A model with known weights, its lengths those of a corpus.
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

    /// The weights, none below zero, that predict the ratings best in the sense of least squares.
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

    /// Features, weights and lengths.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// A model of these terms, as one that was kept.
    ///
    /// # Errors
    /// [`QualityModelError::Nothing`] without any; [`QualityModelError::Constant`] for a length that is not above 0.
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

    /// d′ of a pair of signals, 0 where they are equal.
    pub fn d_prime(&self, distances: &Distances) -> f64 {
        self.parts(distances).map(|(_, part)| part).sum()
    }

    /// What each feature of the model adds to it.
    pub fn parts(&self, distances: &Distances) -> impl Iterator<Item = (Feature, f64)> {
        self.terms.iter().map(|term| (term.feature, term.weight * distances.by(term.feature) / term.length))
    }

    /// The sum of the squares of what the model is off by.
    pub fn squared_error(&self, pairs: &[RatedPair]) -> f64 {
        pairs.iter().map(|pair| (self.d_prime(&pair.distances) - pair.d_prime).powi(2)).sum()
    }

    /// `1 - Σ error² / Σ (d′ - mean)²` on these pairs; `None` where all are rated alike.
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

/// What backward elimination kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Elimination {
    /// The features that are left, in the order of [`Feature::ALL`].
    pub kept: Vec<Feature>,
    /// Those that were dropped, first to last, with the sum of squared errors once each was gone.
    pub dropped: Vec<(Feature, f64)>,
}

/// Drops features one by one, always the one that is missed least, until the sum of squared errors without the next would
/// exceed that of all features by more than `tolerance` (0.1 for a tenth). Features by which nothing differs go first.
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

/// A model that was fitted to some textures and tried on the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// The textures that were left out.
    pub left_out: [usize; 2],
    /// The model of the others.
    pub model: QualityModel,
    /// Sum of squared errors over all textures.
    pub squared_error: f64,
    /// Sum of squared errors over those left out: nothing of them went into the model.
    pub squared_error_left_out: f64,
}

/// A model for every two textures that are left out, best first by the error over all textures: the paper reports the best,
/// which is optimistic. What is honest is `squared_error_left_out` over all rotations.
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

/// How well d′ of textures that went into nothing, neither the choice of features nor the weights, is predicted: each
/// texture in turn is left out of elimination and fit. `1 - Σ error² / Σ (d′ - mean)²`; `None` where all are rated alike.
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

/// The textures of the pairs, each once: three at least.
fn textures(pairs: &[RatedPair]) -> Result<Vec<usize>, QualityModelError> {
    let mut textures: Vec<usize> = pairs.iter().map(|pair| pair.texture).collect();
    textures.sort_unstable();
    textures.dedup();
    let n = textures.len();
    if n < 3 { Err(QualityModelError::Textures { n }) } else { Ok(textures) }
}

/// The pairs of the textures that are left out, and all others.
fn without(left_out: &[usize], pairs: &[RatedPair]) -> (Vec<RatedPair>, Vec<RatedPair>) {
    pairs.iter().cloned().partition(|pair| left_out.contains(&pair.texture))
}

/// The least squares of which no coefficient is below zero. There are few columns, so every subset of them is tried: the
/// best of those whose own least squares have none below zero is the solution (Lawson and Hanson 1974, ch. 23).
fn non_negative(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    debug_assert!(columns.len() <= MOST_FEATURES, "as many as there are features");
    let mut best = (dot(target, target), vec![0.0; columns.len()]);
    for subset in 1_u32..1 << columns.len() {
        let is_in = |index: &usize| subset >> index & 1 == 1;
        let indices: Vec<usize> = (0..columns.len()).filter(is_in).collect();
        let chosen: Vec<Vec<f64>> = indices.iter().map(|index| columns[*index].clone()).collect();
        // Columns that depend on each other are tried in another subset.
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
    use crate::statistics::dot;
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        /// The conditions of Kuhn and Tucker: no coefficient below zero, no slope that leads down into what is allowed, and no
        /// slope at all where a coefficient is free.
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
