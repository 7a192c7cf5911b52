//! Prediction of a position on an axis from features of a texture: feature selection, models and their validation.
//!
//! [`Method::Paper`] is the *published chain*, the method of the authoring paper ([`crate::space`]): sequential forward
//! selection by partial F, parallel analysis, the first principal component, and a cubic polynomial.
//! [`Method::Practical`] predicts better: it is the mean of ridge regressions over the 5, 20 and 80 features with the
//! highest correlation and over all features. `ridge.rs` documents the alternatives that were tried.
//!
//! Features that were selected on all textures and then cross-validated on the same textures look predictive even if
//! they are noise (selection bias). [`validate`] reports this biased correlation, because it is the one that is usually
//! published. It also reports the unbiased correlation from nested cross-validation, where the selection is repeated
//! inside each fold, and its p-value under permutations.
//!
//! # Correlation in nested cross-validation
//!
//! A model that has found nothing predicts the mean of its training textures. That mean is low exactly if the left-out
//! texture is high. The usual correlation of predictions with targets is therefore -1 for such a model in leave-one-out
//! cross-validation, and negative with larger folds. This is an artifact, not a finding. Here, predictions and targets
//! are both measured relative to the mean of the training textures, `q = prediction - mean`, `t = target - mean`. The
//! correlation is `r = Σ q t / sqrt(Σ q² Σ t²)` over all left-out textures of all repeats. Under the null hypothesis a
//! left-out target is independent of `q`, so `Σ q t` is zero on average. A model that predicts the mean has `q = 0` and
//! gets `r = 0`.

mod component;
mod error;
mod folds;
mod forward;
mod model;
mod parallel;
mod ridge;
mod standardized;
mod table;
mod validation;

pub use error::SelectionError;
pub use forward::{Forward, Order};
pub use model::{AxisModel, Term};
pub use parallel::Parallel;
pub use table::FeatureMatrix;
pub use validation::{STANDARD, Scheme, Validation, validate};

use parallel::Thresholds;
use ridge::{Kernel, Products};
use standardized::Standardized;

/// Minimum number of textures for a prediction; with fewer, the training part of a fold is too small for a cubic
/// polynomial.
pub const MIN_TEXTURES: usize = 8;
/// Number of textures minus maximum number of features; the difference leaves degrees of freedom for the residuals.
pub const SPARE_TEXTURES: usize = 8;
/// Seed of the random features of parallel analysis.
pub const PARALLEL_SEED: u64 = 500;

/// Method that predicts a position on an axis from features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The published chain, with this order of forward selection.
    Paper(Order),
    /// Mean of ridge regressions; it predicts better than the published chain.
    Practical,
}

impl Method {
    /// All methods, in the order in which the user interface lists them.
    pub const ALL: [Self; 3] = [Self::Practical, Self::Paper(Order::Greedy), Self::Paper(Order::Ranked)];

    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Paper(Order::Greedy) => "paper",
            Self::Paper(Order::Ranked) => "paper-ranked",
            Self::Practical => "practical",
        }
    }

    /// Method with this [`Method::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.id() == id)
    }
}

/// Steps of the published chain and the resulting model.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperChain {
    /// Result of sequential forward selection.
    pub forward: Forward,
    /// Result of parallel analysis of the selected features; `None` with fewer than three features, which form no
    /// group.
    pub parallel: Option<Parallel>,
    /// Fraction of the variance of the kept features that the principal component explains, 0..1.
    pub explained: f64,
    /// The model; it has no terms if no feature was kept.
    pub model: AxisModel,
}

/// Fits a model of an axis; `target` is the position of each texture, 0..100.
///
/// # Errors
/// See [`SelectionError`].
pub fn fit_axis(
    features: &FeatureMatrix,
    target: &[f64],
    method: Method,
) -> Result<AxisModel, SelectionError> {
    table::check(features, target)?;
    let train = Standardized::new(features, &all(features));
    let prepared = Prepared::new(&train, method);
    let choice = prepared.choose(&train, target);
    Ok(prepared.estimate(&train, target, &choice))
}

/// Fits a model of an axis by the published chain and returns all steps.
///
/// # Errors
/// See [`SelectionError`].
pub fn paper_chain(
    features: &FeatureMatrix,
    target: &[f64],
    order: Order,
) -> Result<PaperChain, SelectionError> {
    table::check(features, target)?;
    let train = Standardized::new(features, &all(features));
    let (forward, parallel) = select_and_group(&train, target, order, &Thresholds::new(PARALLEL_SEED));
    let kept = parallel.as_ref().map_or(&forward.features, |p| &p.kept);
    let explained = component::first(&train, kept).map_or(0.0, |c| c.explained);
    let model = component::cubic_model(&train, target, kept);
    Ok(PaperChain { forward, parallel, explained, model })
}

/// Forward selection and parallel analysis, the first two steps of the published chain.
fn select_and_group(
    train: &Standardized,
    target: &[f64],
    order: Order,
    thresholds: &Thresholds,
) -> (Forward, Option<Parallel>) {
    let forward = forward::select(train, target, order, most_features(train.n));
    let parallel = parallel::analyze(train, target, &forward.features, thresholds);
    (forward, parallel)
}

fn all(features: &FeatureMatrix) -> Vec<usize> {
    (0..features.n_textures()).collect()
}

fn most_features(n_textures: usize) -> usize {
    n_textures.saturating_sub(SPARE_TEXTURES).max(1)
}

/// Selected features of a method: one group, or one group per regression.
struct Choice(Vec<Vec<usize>>);

/// Results of a method that do not depend on the target, shared between permutations.
enum Prepared {
    Paper { order: Order, thresholds: Thresholds },
    Practical { products: Products, all: Option<Kernel> },
}

impl Prepared {
    fn new(train: &Standardized, method: Method) -> Self {
        match method {
            Method::Paper(order) => Self::Paper { order, thresholds: Thresholds::new(PARALLEL_SEED) },
            Method::Practical => {
                let products = Products::new(train);
                let all = Kernel::new(train, &products, &train.varying());
                Self::Practical { products, all }
            }
        }
    }

    fn choose(&self, train: &Standardized, target: &[f64]) -> Choice {
        match self {
            Self::Paper { order, thresholds } => {
                let (forward, parallel) = select_and_group(train, target, *order, thresholds);
                Choice(vec![parallel.map_or(forward.features, |p| p.kept)])
            }
            Self::Practical { .. } => Choice(ridge::groups(train, target)),
        }
    }

    fn estimate(&self, train: &Standardized, target: &[f64], choice: &Choice) -> AxisModel {
        match self {
            Self::Paper { .. } => component::cubic_model(train, target, &choice.0[0]),
            Self::Practical { products, all } => {
                ridge::mean_model(train, target, products, &choice.0, all.as_ref())
            }
        }
    }
}

#[cfg(test)]
mod golden;
#[cfg(test)]
mod tests;
