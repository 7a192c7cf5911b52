//! Principal components of mean ratings, and their number by parallel analysis.
//!
//! The components are those of the correlation matrix, so that every adjective pair counts alike, whatever the spread of
//! its ratings. Parallel analysis (Horn 1965) compares each eigenvalue with the same eigenvalue of random normal ratings
//! of as many textures and pairs. The dimensions are the leading components whose eigenvalues exceed the 95th percentile
//! over the random draws (Glorfeld 1995).

use nalgebra::{DMatrix, SymmetricEigen};

use crate::maths::rng::{Random, derive_seed};
use crate::maths::statistics::{centered, dot, is_constant, quantile};

/// Maximum number of adjective pairs; the cost is cubic in their number.
pub const MAX_PAIRS: usize = 100;
/// Minimum number of textures that are rated on all pairs.
pub const MIN_TEXTURES: usize = 3;
/// Minimum number of adjective pairs.
const MIN_PAIRS: usize = 2;
/// Number of random draws of the parallel analysis.
const N_DRAWS: usize = 200;
/// Quantile of the draws that an eigenvalue must exceed.
const RANK: f64 = 0.95;

/// Principal components of the mean ratings of textures on several adjective pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct RatingComponents {
    /// Indices of the pairs included: those whose mean ratings differ between textures.
    pub pairs: Vec<usize>,
    /// Number of textures included: those that are rated on all rated pairs.
    pub n_textures: usize,
    /// Eigenvalues of the correlation matrix in descending order, one per component. Their sum is the number of pairs.
    pub eigenvalues: Vec<f64>,
    /// Fraction of the variance that each component explains, 0..1.
    pub explained: Vec<f64>,
    /// Loadings: for each component, the correlation of each included pair with it. The loading of largest magnitude is
    /// positive.
    pub loadings: Vec<Vec<f64>>,
    /// Eigenvalue that each component has to exceed: the 95th percentile for random ratings.
    pub random_eigenvalues: Vec<f64>,
    /// Number of dimensions: the leading components that exceed the random eigenvalues.
    pub n_dims: usize,
}

/// Reasons why mean ratings have no principal components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ComponentsError {
    /// Too few pairs distinguish textures.
    #[error(
        "principal components need at least {MIN_PAIRS} adjective pairs whose mean ratings differ between textures; there are {n_pairs}"
    )]
    TooFewPairs {
        /// Number of such pairs.
        n_pairs: usize,
    },
    /// There are too many pairs.
    #[error("principal components are computed for up to {MAX_PAIRS} adjective pairs; there are {n_pairs}")]
    TooManyPairs {
        /// Number of pairs.
        n_pairs: usize,
    },
    /// Too few textures are rated on all pairs.
    #[error(
        "principal components need at least {MIN_TEXTURES} textures that are rated on every adjective pair; there are {n_textures}"
    )]
    TooFewTextures {
        /// Number of such textures.
        n_textures: usize,
    },
    /// The caller stopped the analysis.
    #[error("the analysis of the principal components was stopped before it finished")]
    Stopped,
}

/// Principal components of mean ratings: one row per adjective pair, with the mean of each texture, `None` if nobody rated
/// it. Pairs that nobody rated are left out. The same seed gives the same random eigenvalues. `go_on` is called before
/// every random draw; returning `false` stops the analysis.
///
/// Cost: 200 eigendecompositions of a matrix with a row and a column per pair.
///
/// # Errors
/// See [`ComponentsError`].
///
/// # Panics
/// If the rows differ in length.
pub fn rating_components(
    means: &[Vec<Option<f64>>],
    seed: u64,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<RatingComponents, ComponentsError> {
    let rated: Vec<usize> =
        (0..means.len()).filter(|pair| means[*pair].iter().any(Option::is_some)).collect();
    let all = 0..means.first().map_or(0, Vec::len);
    let complete: Vec<usize> =
        all.filter(|texture| rated.iter().all(|pair| means[*pair][*texture].is_some())).collect();
    let n_textures = complete.len();
    if n_textures < MIN_TEXTURES {
        return Err(ComponentsError::TooFewTextures { n_textures });
    }
    let column =
        |pair: usize| -> Vec<f64> { complete.iter().filter_map(|texture| means[pair][*texture]).collect() };
    let (pairs, columns): (Vec<usize>, Vec<Vec<f64>>) =
        rated.iter().map(|pair| (*pair, column(*pair))).filter(|(_, column)| !is_constant(column)).unzip();
    let n_pairs = pairs.len();
    if n_pairs < MIN_PAIRS {
        return Err(ComponentsError::TooFewPairs { n_pairs });
    }
    if n_pairs > MAX_PAIRS {
        return Err(ComponentsError::TooManyPairs { n_pairs });
    }
    let Principal { eigenvalues, loadings } = principal(&columns);
    let random_eigenvalues =
        random_eigenvalues(n_textures, n_pairs, seed, go_on).ok_or(ComponentsError::Stopped)?;
    let exceeds = |(found, random): &(&f64, &f64)| found > random;
    let n_dims = eigenvalues.iter().zip(&random_eigenvalues).take_while(exceeds).count();
    Ok(RatingComponents {
        explained: eigenvalues.iter().map(|eigenvalue| eigenvalue / n_pairs as f64).collect(),
        pairs,
        n_textures,
        eigenvalues,
        loadings,
        random_eigenvalues,
        n_dims,
    })
}

/// Eigenvalues of a correlation matrix in descending order, and the loadings of each component.
struct Principal {
    eigenvalues: Vec<f64>,
    loadings: Vec<Vec<f64>>,
}

/// Principal components of columns of equal length, none of them constant.
fn principal(columns: &[Vec<f64>]) -> Principal {
    let unit = |column: &Vec<f64>| -> Vec<f64> {
        let centered = centered(column);
        let length = dot(&centered, &centered).sqrt();
        centered.iter().map(|value| value / length).collect()
    };
    let units: Vec<Vec<f64>> = columns.iter().map(unit).collect();
    let n = units.len();
    let eigen = SymmetricEigen::new(DMatrix::from_fn(n, n, |i, j| dot(&units[i], &units[j])));
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    // Rounding makes eigenvalues of zero slightly negative.
    let eigenvalue = |component: &usize| eigen.eigenvalues[*component].max(0.0);
    let loadings = |component: &usize| -> Vec<f64> {
        let length = eigenvalue(component).sqrt();
        let vector = eigen.eigenvectors.column(*component);
        let largest = vector.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let sign = if largest.is_some_and(|value| value < 0.0) { -1.0 } else { 1.0 };
        vector.iter().map(|value| sign * length * value).collect()
    };
    Principal {
        eigenvalues: order.iter().map(eigenvalue).collect(),
        loadings: order.iter().map(loadings).collect(),
    }
}

/// The 95th percentile of each eigenvalue over draws of random normal ratings; `None` if `go_on` returns `false`.
fn random_eigenvalues(
    n_textures: usize,
    n_pairs: usize,
    seed: u64,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<f64>> {
    let mut random = Random::new(derive_seed(seed, &format!("rating components {n_textures} {n_pairs}")));
    let mut by_component: Vec<Vec<f64>> = vec![Vec::new(); n_pairs];
    for _ in 0..N_DRAWS {
        if !go_on() {
            return None;
        }
        let mut column = || -> Vec<f64> { (0..n_textures).map(|_| random.normal()).collect() };
        let columns: Vec<Vec<f64>> = (0..n_pairs).map(|_| column()).collect();
        for (drawn, eigenvalue) in by_component.iter_mut().zip(principal(&columns).eigenvalues) {
            drawn.push(eigenvalue);
        }
    }
    // There is at least one draw, so the quantiles exist.
    Some(by_component.iter().map(|drawn| quantile(drawn, RANK).unwrap_or(f64::INFINITY)).collect())
}

#[cfg(test)]
mod tests;
