//! From features of textures to a position on an axis: selection, models, and what they are worth.
//!
//! [`Method::Paper`] is the published chain: sequential forward selection by partial F, parallel analysis, one principal
//! component, a cubic. [`Method::Practical`] predicts better: the mean of ridge regressions over the 5, 20 and 80
//! features that correlate best and over all of them (`ridge.rs` says what else was tried).
//!
//! Features that were selected on all textures and then cross-validated on the same textures look predictive even when
//! they are noise. [`validate`] gives that number, since it is what is published, and beside it the one that counts:
//! nested cross-validation, where everything is selected anew inside each fold, and the chance of it under
//! permutations.
//!
//! # What the correlation of nested cross-validation is
//!
//! A model that has found nothing predicts the mean of its training textures. That mean is low exactly where the
//! left-out texture is high, so the usual correlation of predictions with targets is -1 for such a model with one
//! texture left out, and below zero with more: an artifact, not a finding. Here both are measured from the mean of the
//! training textures, `q = prediction - mean`, `t = target - mean`, and `r = Σ q t / sqrt(Σ q² Σ t²)` over all
//! left-out textures of all repeats. Under the null a left-out target says nothing about `q`, so `Σ q t` is zero on
//! average; a model that predicts its mean has `q = 0` and gets `r = 0`.

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
use ridge::Kernel;
use standardized::Standardized;

/// Fewest textures from which an axis can be predicted: with fewer, a fold leaves less than a cubic needs.
pub const MIN_TEXTURES: usize = 8;
/// Features may not be more than the textures less this: what is left is for the error of the regression.
pub const SPARE_TEXTURES: usize = 8;
/// Seed of the random data of parallel analysis.
pub const PARALLEL_SEED: u64 = 500;

/// How an axis is predicted from features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The published chain.
    Paper(Order),
    /// The one that predicts best.
    Practical,
}

impl Method {
    /// All methods, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Practical, Self::Paper(Order::Greedy), Self::Paper(Order::Ranked)];

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Paper(Order::Greedy) => "paper",
            Self::Paper(Order::Ranked) => "paper-ranked",
            Self::Practical => "practical",
        }
    }

    /// The method that has this [`Method::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.id() == id)
    }
}

/// The steps of the published chain, and the model they end in.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperChain {
    /// Sequential forward selection.
    pub forward: Forward,
    /// Parallel analysis of what was selected; `None` with fewer than three features, which it cannot group.
    pub parallel: Option<Parallel>,
    /// Share of the variance of the kept features that the component holds, 0..1.
    pub explained: f64,
    /// The model; without terms where no feature was kept.
    pub model: AxisModel,
}

/// Fits an axis: `target` is the position of each texture, 0..100.
///
/// # Errors
/// See [`SelectionError`].
pub fn fit_axis(
    features: &FeatureMatrix,
    target: &[f64],
    method: Method,
) -> Result<AxisModel, SelectionError> {
    error::check(features, target)?;
    let train = Standardized::new(features, &all(features));
    let mut prepared = Prepared::new(&train, method);
    let choice = prepared.choose(&train, target);
    Ok(prepared.estimate(&train, target, &choice))
}

/// Fits an axis by the published chain, and returns its steps.
///
/// # Errors
/// See [`SelectionError`].
pub fn paper_chain(
    features: &FeatureMatrix,
    target: &[f64],
    order: Order,
) -> Result<PaperChain, SelectionError> {
    error::check(features, target)?;
    let train = Standardized::new(features, &all(features));
    let (forward, parallel) = select_and_group(&train, target, order, &mut Thresholds::new(PARALLEL_SEED));
    let kept = parallel.as_ref().map_or(&forward.features, |p| &p.kept);
    let explained = component::first(&train, kept).map_or(0.0, |c| c.explained);
    let model = component::cubic_model(&train, target, kept);
    Ok(PaperChain { forward, parallel, explained, model })
}

/// The first two steps of the published chain.
fn select_and_group(
    train: &Standardized,
    target: &[f64],
    order: Order,
    thresholds: &mut Thresholds,
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

/// Features that a method has settled on: one group, or one for each of several regressions.
struct Choice(Vec<Vec<usize>>);

/// What a method can work out before it sees a target: permutations share it.
enum Prepared {
    Paper { order: Order, thresholds: Thresholds },
    Practical { all: Option<Kernel> },
}

impl Prepared {
    fn new(train: &Standardized, method: Method) -> Self {
        match method {
            Method::Paper(order) => Self::Paper { order, thresholds: Thresholds::new(PARALLEL_SEED) },
            Method::Practical => Self::Practical { all: Kernel::new(train, &train.varying()) },
        }
    }

    fn choose(&mut self, train: &Standardized, target: &[f64]) -> Choice {
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
            Self::Practical { all } => ridge::mean_model(train, target, &choice.0, all.as_ref()),
        }
    }
}

#[cfg(test)]
mod golden;
#[cfg(test)]
mod tests;
