//! Cross-validation of an axis model: how well it predicts textures that it was not trained on.

use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::folds::{outside, repeated};
use super::standardized::Standardized;
use super::{AxisModel, Choice, FeatureMatrix, Method, Prepared, SelectionError, all, table};
use crate::maths::rng::{Random, derive_seed};
use crate::maths::statistics::{correlation, mean, quantile, standard_deviation};

/// Cross-validation scheme and number of permutations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scheme {
    /// Number of folds, from 2 to the number of textures (leave-one-out).
    pub n_folds: usize,
    /// Number of random assignments of the textures to folds, at least 1.
    pub n_repeats: usize,
    /// Number of permutations of the positions for the null distribution; 0 gives no p-value.
    pub n_permutations: usize,
    /// Seed of folds and permutations.
    pub seed: u64,
}

/// Five folds as published, with 1,000 permutations. The assignment to folds is repeated four times, because the
/// correlation for 25 textures varies by about 0.1 from one assignment to another.
pub const STANDARD: Scheme = Scheme { n_folds: 5, n_repeats: 4, n_permutations: 1000, seed: 1 };

/// Validation result of an axis model.
#[derive(Clone, Debug, PartialEq)]
pub struct Validation {
    /// Scheme of the validation.
    pub scheme: Scheme,
    /// Plain (Pearson) correlation of predictions with positions in cross-validation, if features are selected on all
    /// textures: the figure that is usually published, strongly biased upwards. 0 if no feature was selected.
    pub cv_r: f64,
    /// Range-normalized accuracy of the predictions of [`Validation::cv_r`], `100 (1 - RMSE / range)`, in percent.
    pub cv_rms_percent: f64,
    /// Nested correlation: correlation of predictions with positions in nested cross-validation, where features are
    /// selected inside each fold. Both are relative to the mean of the training textures (see
    /// [`crate::space::selection`]). 0 if all predictions equal that mean.
    pub nested_cv_r: f64,
    /// Standard deviation of the nested correlation over the repeats, each with its own random assignment of the textures
    /// to folds. [`Validation::nested_cv_r`] pools the repeats, so another seed changes it by less. `None` with one
    /// repeat.
    pub nested_cv_r_deviation: Option<f64>,
    /// Plain correlation of the predictions in nested cross-validation with positions: same definition as
    /// [`Validation::cv_r`], for comparison with it. It is biased downwards if the predictions are close to the mean of
    /// the training textures (see [`crate::space::selection`]). 0 if all predictions equal that mean.
    pub nested_cv_plain_r: f64,
    /// Range-normalized accuracy of the nested predictions, in percent.
    pub nested_cv_rms_percent: f64,
    /// Range-normalized accuracy if the mean of the training textures is always predicted, in percent: the baseline
    /// that any model has to exceed.
    pub mean_rms_percent: f64,
    /// Permutation p-value of the nested correlation: `(1 + count) / (1 + permutations)`, where `count` is the number
    /// of permutations with a correlation at least as high. `None` without permutations.
    pub permutation_p: Option<f64>,
    /// 95th percentile of the nested correlation under permutation; `None` without permutations.
    pub null_r_95: Option<f64>,
    /// Number of permutations.
    pub n_permutations: usize,
    /// Nested prediction for each texture, 0..100, averaged over repeats.
    pub predicted: Vec<f64>,
}

/// Validates a method on features and positions (0..100). The same seed gives the same result.
///
/// Cost: folds × repeats × permutations fits, a few seconds in a release build for 25 textures and 325 features.
/// `go_on` is called before every fit; returning `false` stops the validation.
///
/// # Errors
/// See [`SelectionError`].
pub fn validate(
    features: &FeatureMatrix,
    target: &[f64],
    method: Method,
    scheme: &Scheme,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Validation, SelectionError> {
    table::check(features, target)?;
    let n = target.len();
    let mut random = Random::new(derive_seed(scheme.seed, "folds"));
    let folds = repeated(n, scheme.n_folds, scheme.n_repeats, &mut random)?;
    let mut random = Random::new(derive_seed(scheme.seed, "permutations"));
    // The unpermuted positions come first, so that they and the permutations are processed in the same way.
    let mut targets = vec![target.to_vec()];
    targets.extend(
        (0..scheme.n_permutations)
            .map(|_| random.shuffled(n).iter().map(|i| target[*i]).collect::<Vec<f64>>()),
    );
    let mut products = vec![FromMeans::default(); targets.len()];
    // Each repeat has the same number of folds.
    let mut repeats = vec![FromMeans::default(); folds.len() / scheme.n_folds];
    let (mut nested, mut flat) = (LeftOut::default(), LeftOut::default());
    for (fold_idx, fold) in folds.iter().enumerate() {
        let textures = outside(fold, n);
        let train = Standardized::new(features, &textures);
        let prepared = Prepared::new(&train, method);
        let fits = targets.par_iter().zip(&mut products).enumerate().map(|(index, (target, product))| {
            if !go_on() {
                return Err(SelectionError::Stopped);
            }
            let known: Vec<f64> = textures.iter().map(|t| target[*t]).collect();
            let choice = prepared.choose(&train, &known);
            let model = prepared.estimate(&train, &known, &choice);
            let center = mean(&known);
            let mut unpermuted = Vec::new();
            for texture in fold {
                let predicted = position(&model, features, *texture).clamp(0.0, 100.0);
                product.add(predicted - center, target[*texture] - center);
                if index == 0 {
                    unpermuted.push((*texture, target[*texture], predicted, center));
                }
            }
            Ok(unpermuted)
        });
        for (texture, target, predicted, center) in fits.collect::<Result<Vec<_>, _>>()?.concat() {
            nested.add(texture, target, predicted);
            flat.add(texture, target, center);
            repeats[fold_idx / scheme.n_folds].add(predicted - center, target - center);
        }
    }
    let observed = products[0].r();
    let null: Vec<f64> = products[1..].iter().map(FromMeans::r).collect();
    let as_high = null.iter().filter(|r| **r >= observed).count();
    let chosen = chosen_on_all(features, target, method, &folds);
    // Predictions that equal the means of the training textures get a correlation of 0 (see the documentation of
    // `selection`).
    let plain_r = |left_out: &LeftOut| {
        let found = left_out.predictions != flat.predictions;
        if found { correlation(&left_out.targets, &left_out.predictions).unwrap_or(0.0) } else { 0.0 }
    };
    Ok(Validation {
        scheme: *scheme,
        cv_r: plain_r(&chosen),
        cv_rms_percent: chosen.rms_percent(),
        nested_cv_r: observed,
        nested_cv_r_deviation: deviation(&repeats),
        nested_cv_plain_r: plain_r(&nested),
        nested_cv_rms_percent: nested.rms_percent(),
        mean_rms_percent: flat.rms_percent(),
        permutation_p: (!null.is_empty()).then(|| (1 + as_high) as f64 / (1 + null.len()) as f64),
        null_r_95: quantile(&null, 0.95),
        n_permutations: null.len(),
        predicted: nested.by_texture(n),
    })
}

/// Standard deviation of the correlations of the repeats; `None` with one repeat.
fn deviation(repeats: &[FromMeans]) -> Option<f64> {
    let correlations: Vec<f64> = repeats.iter().map(FromMeans::r).collect();
    (correlations.len() > 1).then(|| standard_deviation(&correlations))
}

/// Cross-validation as published: features are selected once, on all textures.
fn chosen_on_all(features: &FeatureMatrix, target: &[f64], method: Method, folds: &[Vec<usize>]) -> LeftOut {
    let everything = Standardized::new(features, &all(features));
    let choice = Prepared::new(&everything, method).choose(&everything, target);
    let mut left_out = LeftOut::default();
    for fold in folds {
        for (texture, raw) in fold.iter().zip(fold_predictions(features, target, method, &choice, fold)) {
            left_out.add(*texture, target[*texture], raw.clamp(0.0, 100.0));
        }
    }
    left_out
}

/// Unclipped predictions for the textures of a fold, from a model with the chosen features trained on the other
/// textures.
pub(super) fn fold_predictions(
    features: &FeatureMatrix,
    target: &[f64],
    method: Method,
    choice: &Choice,
    fold: &[usize],
) -> Vec<f64> {
    let textures = outside(fold, target.len());
    let train = Standardized::new(features, &textures);
    let known: Vec<f64> = textures.iter().map(|t| target[*t]).collect();
    let model = Prepared::new(&train, method).estimate(&train, &known, choice);
    fold.iter().map(|texture| position(&model, features, *texture)).collect()
}

fn position(model: &AxisModel, features: &FeatureMatrix, texture: usize) -> f64 {
    model.raw(|feature| features.value(texture, feature))
}

/// Sums for the correlation relative to the means of the training textures.
#[derive(Clone, Copy, Default)]
struct FromMeans {
    product: f64,
    predicted: f64,
    target: f64,
}

impl FromMeans {
    fn add(&mut self, predicted: f64, target: f64) {
        self.product += predicted * target;
        self.predicted += predicted * predicted;
        self.target += target * target;
    }

    fn r(&self) -> f64 {
        // Positions are at most 100, so smaller deviations from the mean are rounding error.
        if self.predicted <= 1e-18 * self.target {
            return 0.0;
        }
        self.product / (self.predicted * self.target).sqrt()
    }
}

/// Positions and predictions of left-out textures.
#[derive(Default)]
pub(super) struct LeftOut {
    textures: Vec<usize>,
    targets: Vec<f64>,
    predictions: Vec<f64>,
}

impl LeftOut {
    fn add(&mut self, texture: usize, target: f64, prediction: f64) {
        self.textures.push(texture);
        self.targets.push(target);
        self.predictions.push(prediction);
    }

    fn rms_percent(&self) -> f64 {
        rms_percent(&self.targets, &self.predictions)
    }

    fn by_texture(&self, n: usize) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); n];
        for (texture, prediction) in self.textures.iter().zip(&self.predictions) {
            sums[*texture].0 += prediction;
            sums[*texture].1 += 1.0;
        }
        sums.into_iter().map(|(sum, count)| sum / count).collect()
    }
}

/// Range-normalized accuracy `100 (1 - RMSE / range)`, in percent. The published "root-mean-squared value of 91.59 %"
/// is consistent with the published correlation only under this definition.
pub(super) fn rms_percent(targets: &[f64], predictions: &[f64]) -> f64 {
    let squares: Vec<f64> = targets.iter().zip(predictions).map(|(t, p)| (t - p) * (t - p)).collect();
    let high = targets.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = targets.iter().copied().fold(f64::INFINITY, f64::min);
    100.0 * (1.0 - mean(&squares).sqrt() / (high - low))
}
