//! Nonmetric multidimensional scaling (Kruskal 1964): places points so that their distances follow the rank order of
//! the dissimilarities.
//!
//! The objective is stress-1, `sqrt(Σ (d - d̂)² / Σ d²)`. Here `d` are the distances, and the disparities `d̂` are
//! their regression on the dissimilarities: isotonic, or linear for interval scaling ([`Transform`]). Squared stress
//! has a continuous gradient, which can be computed with the disparities held fixed. A gradient step of the largest
//! size that majorization guarantees is exactly one SMACOF step (de Leeuw 1977, Guttman transform). This solver starts
//! with such a step, adds curvature from previous steps (L-BFGS), and accepts a step only if stress decreases. It
//! reaches stationary points in a fraction of SMACOF's steps.
//!
//! Stress does not depend on translation, rotation, reflection or scale, so the result is normalized. Points are
//! centered, and their axes are principal axes in order of decreasing variance. The coordinate of largest magnitude on
//! each axis is positive. The sum of squared distances equals the sum of squared dissimilarities.

mod axes;
mod degeneracy;
mod descent;
mod objective;
mod random_stress;
mod sorter;
mod start;

use std::ops::RangeInclusive;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::maths::rng::derive_seed;
use crate::people::dissimilarities::Dissimilarities;
pub use crate::people::mds::degeneracy::{Degeneracy, degeneracy};
pub use crate::people::mds::random_stress::expected_random_stress;

use crate::people::mds::axes::settle;
use crate::people::mds::descent::{Stop, descend};
use crate::people::mds::objective::Objective;
use crate::people::mds::start::Classical;

/// Maximum number of dimensions.
pub const MAX_DIMS: usize = 10;

/// Maximum number of items: a pair is stored as two 16-bit indices.
pub const MAX_ITEMS: usize = 1 << 16;

/// Name of the random stream of the classical start.
const CLASSICAL: &str = "classical start";

/// Transformation of the dissimilarities into disparities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transform {
    /// Monotone; tied (equal) dissimilarities may have different disparities (Kruskal's primary approach).
    PrimaryTies,
    /// Monotone; tied dissimilarities get the same disparity (Kruskal's secondary approach).
    SecondaryTies,
    /// Linear with a slope of 0 or more and without negative disparities: interval scaling, which is metric. It cannot
    /// merge different dissimilarities, so it has no degenerate solution of clusters ([`degeneracy()`]).
    Interval,
}

/// Options for scaling; [`MdsOptions::usual`] gives reasonable defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct MdsOptions {
    /// Transformation of the dissimilarities.
    pub transform: Transform,
    /// Number of random starts in addition to the classical start. The result with the lowest stress is kept.
    pub n_random_starts: usize,
    /// Seed for the random starts.
    pub seed: u64,
    /// Relative decrease of stress in one step below which the descent counts as converged.
    pub tolerance: f64,
    /// Maximum number of steps from one start.
    pub max_steps: usize,
}

/// A configuration of points and its stress.
#[derive(Clone, Debug, PartialEq)]
pub struct Mds {
    /// Point coordinates: one row per item.
    pub points: Vec<Vec<f64>>,
    /// Stress-1 of the configuration, 0..1.
    pub stress: f64,
    /// Whether the descent converged; `false` if it reached the maximum number of steps.
    pub converged: bool,
    /// Number of steps from the start that was kept.
    pub n_steps: usize,
    /// Final stress of each start: the classical one (or the given one) first, then the random ones.
    pub stress_by_start: Vec<f64>,
}

/// One pair of a Shepard diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShepardPair {
    /// Indices of the two items, the lower one first.
    pub items: [usize; 2],
    /// Dissimilarity of the pair.
    pub dissimilarity: f64,
    /// Distance between the two points.
    pub distance: f64,
    /// Disparity of the pair: its distance after regression on the dissimilarities.
    pub disparity: f64,
}

/// Reasons why dissimilarities cannot be scaled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MdsError {
    /// The caller stopped the computation.
    #[error("multidimensional scaling was stopped before it finished")]
    Stopped,
    /// The number of dimensions is out of range.
    #[error("cannot scale to {dims} dimensions; choose 1 to {MAX_DIMS}")]
    Dims {
        /// Number of dimensions requested.
        dims: usize,
    },
    /// There are too few items for this number of dimensions.
    #[error("{dims} dimensions need at least {} items, got {n_items}", dims + 1)]
    TooFew {
        /// Number of dimensions requested.
        dims: usize,
        /// Number of items.
        n_items: usize,
    },
    /// There are too many items.
    #[error("{n_items} items exceed the maximum of {MAX_ITEMS} for scaling")]
    TooMany {
        /// Number of items.
        n_items: usize,
    },
    /// All dissimilarities are equal, so they have no rank order.
    #[error(
        "all dissimilarities are {value}; without differences between them every configuration fits equally well"
    )]
    AllEqual {
        /// The common value.
        value: f64,
    },
    /// The compared pairs do not connect all items.
    #[error(
        "no chain of compared pairs connects items 0 and {item}; compare items of the two sets, or scale each set on its own"
    )]
    Apart {
        /// Index of an item that is not connected to item 0.
        item: usize,
    },
    /// The configuration does not have one row per item, or its rows differ in length.
    #[error("the configuration has {n_rows} rows for {n_items} items, or its rows differ in length")]
    Shape {
        /// Number of rows of the configuration.
        n_rows: usize,
        /// Number of items.
        n_items: usize,
    },
    /// A coordinate is not finite.
    #[error("item {item} has a coordinate that is not a finite number")]
    NotFinite {
        /// Index of the item.
        item: usize,
    },
    /// All points coincide.
    #[error("all points of the configuration coincide; a start needs points with distances between them")]
    OnePoint,
}

impl Transform {
    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::PrimaryTies => "primary",
            Self::SecondaryTies => "secondary",
            Self::Interval => "interval",
        }
    }
}

impl MdsOptions {
    /// Default options: primary ties, twenty random starts, and a relative tolerance of ten digits.
    ///
    /// Sorting data contain many ties. The table is for simulated panels over 25 textures with five labels each. It
    /// gives the correlation of the positions along the two axes with the labels, averaged over both axes and eight
    /// panels (twelve for the row without noise):
    ///
    /// | noise | participants | primary | secondary |
    /// |---|---|---|---|
    /// | 8 points | 3 | .85 | .90 |
    /// | 8 points | 5 | .92 | .92 |
    /// | 8 points | 10 | .94 | .93 |
    /// | 8 points | 20 | .93 | .93 |
    /// | none | 10 | .75 | .87 |
    ///
    /// Secondary ties are therefore better when few participants take part or when all agree. Their configurations vary
    /// less between panels, and their stress is two to three times as high.
    pub fn usual(seed: u64) -> Self {
        let transform = Transform::PrimaryTies;
        Self { transform, n_random_starts: 20, seed, tolerance: 1e-10, max_steps: 2000 }
    }
}

/// Configuration with the lowest stress of all starts, in `dims` dimensions. It is nonmetric unless the transformation
/// is [`Transform::Interval`].
///
/// Items of dissimilarity 0 may coincide but need not. Pairs that were never compared carry no weight. Cost: one sort
/// of the pairs, one eigendecomposition (cubic in the number of items), and tens of steps per start, each linear in the
/// pairs.
///
/// # Errors
/// See [`MdsError`].
pub fn nonmetric(
    dissimilarities: &Dissimilarities,
    dims: usize,
    options: &MdsOptions,
) -> Result<Mds, MdsError> {
    check(dissimilarities, dims)?;
    let classical = Classical::new(dissimilarities).in_dims(dims, derive_seed(options.seed, CLASSICAL));
    let objective = Objective::new(dissimilarities, options.transform);
    best(dissimilarities, &objective, dims, options, vec![classical], &|| true)
}

/// Configuration that descent from one given start (one row per item) reaches; random starts in `options` are ignored.
///
/// # Errors
/// See [`MdsError`].
pub fn nonmetric_from(
    dissimilarities: &Dissimilarities,
    start: &[Vec<f64>],
    options: &MdsOptions,
) -> Result<Mds, MdsError> {
    let flat = flat(dissimilarities, start)?;
    check(dissimilarities, start[0].len())?;
    let options = MdsOptions { n_random_starts: 0, ..options.clone() };
    let objective = Objective::new(dissimilarities, options.transform);
    best(dissimilarities, &objective, start[0].len(), &options, vec![flat], &|| true)
}

/// Scaling in one number of dimensions after the other, of the same dissimilarities.
pub struct ByDimension<'a> {
    dissimilarities: &'a Dissimilarities,
    options: MdsOptions,
    classical: Classical,
    objective: Objective<'a>,
}

impl<'a> ByDimension<'a> {
    /// Prepares the scaling: the decomposition for the classical start serves every number of dimensions.
    ///
    /// # Errors
    /// See [`MdsError`].
    pub fn new(dissimilarities: &'a Dissimilarities, options: &MdsOptions) -> Result<Self, MdsError> {
        check(dissimilarities, 1)?;
        let objective = Objective::new(dissimilarities, options.transform);
        let classical = Classical::new(dissimilarities);
        Ok(Self { dissimilarities, options: options.clone(), classical, objective })
    }

    /// Best configuration for each number of dimensions. The best configuration with one dimension fewer, `before` for
    /// the first number, is an additional start, so stress does not rise with the number of dimensions. `go_on` is
    /// called before every step of every descent; returning `false` stops the computation.
    ///
    /// # Errors
    /// See [`MdsError`].
    pub fn best(
        &self,
        dims: RangeInclusive<usize>,
        before: Option<&Mds>,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<Mds>, MdsError> {
        let seed = self.options.seed;
        let mut all: Vec<Mds> = Vec::new();
        for dims in dims {
            check(self.dissimilarities, dims)?;
            let mut starts = vec![self.classical.in_dims(dims, derive_seed(seed, CLASSICAL))];
            if let Some(before) = all.last().or(before) {
                starts.push(start::with_axis(&before.points, derive_seed(seed, "another axis")));
            }
            all.push(best(self.dissimilarities, &self.objective, dims, &self.options, starts, go_on)?);
        }
        Ok(all)
    }
}

/// All compared pairs in the order of dissimilarity, with their distance and disparity in a configuration.
///
/// # Errors
/// See [`MdsError`].
pub fn shepard(
    dissimilarities: &Dissimilarities,
    points: &[Vec<f64>],
    transform: Transform,
) -> Result<Vec<ShepardPair>, MdsError> {
    let flat = flat(dissimilarities, points)?;
    check(dissimilarities, points[0].len())?;
    let mut objective = Objective::new(dissimilarities, transform);
    objective.evaluate(points[0].len(), &flat, &mut vec![0.0; flat.len()]);
    Ok(objective.shepard())
}

/// Stress-1 of a configuration with one row per item.
///
/// # Errors
/// See [`MdsError`].
pub fn stress(
    dissimilarities: &Dissimilarities,
    points: &[Vec<f64>],
    transform: Transform,
) -> Result<f64, MdsError> {
    let pairs = shepard(dissimilarities, points, transform)?;
    let sum = |of: fn(&ShepardPair) -> f64| pairs.iter().map(of).sum::<f64>();
    Ok((sum(|p| (p.distance - p.disparity).powi(2)) / sum(|p| p.distance.powi(2))).sqrt())
}

/// Validates the dissimilarities and the number of dimensions, before any start is checked.
fn check(dissimilarities: &Dissimilarities, dims: usize) -> Result<(), MdsError> {
    let n_items = dissimilarities.n_items();
    if !(1..=MAX_DIMS).contains(&dims) {
        return Err(MdsError::Dims { dims });
    }
    if n_items <= dims {
        return Err(MdsError::TooFew { dims, n_items });
    }
    if n_items > MAX_ITEMS {
        return Err(MdsError::TooMany { n_items });
    }
    if let Some(item) = dissimilarities.unreachable() {
        return Err(MdsError::Apart { item });
    }
    // With two items there is only one pair, and it is always scaled exactly.
    let mut values = dissimilarities.pairs().map(|(_, _, value)| value);
    match values.next() {
        Some(value) if n_items > 2 && values.all(|v| v == value) => Err(MdsError::AllEqual { value }),
        _ => Ok(()),
    }
}

/// Coordinates of a configuration as one flat vector, point by point.
fn flat(dissimilarities: &Dissimilarities, points: &[Vec<f64>]) -> Result<Vec<f64>, MdsError> {
    let n_items = dissimilarities.n_items();
    let shape = MdsError::Shape { n_rows: points.len(), n_items };
    let Some(first) = points.first() else { return Err(shape) };
    if points.len() != n_items || points.iter().any(|row| row.len() != first.len()) {
        return Err(shape);
    }
    if let Some(item) = points.iter().position(|row| row.iter().any(|v| !v.is_finite())) {
        return Err(MdsError::NotFinite { item });
    }
    if points.iter().all(|row| row == first) { Err(MdsError::OnePoint) } else { Ok(points.concat()) }
}

/// Configuration with the lowest stress among the results from `starts` and the random starts.
fn best(
    dissimilarities: &Dissimilarities,
    objective: &Objective<'_>,
    dims: usize,
    options: &MdsOptions,
    mut starts: Vec<Vec<f64>>,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Mds, MdsError> {
    let n_items = dissimilarities.n_items();
    starts.extend((0..options.n_random_starts).map(|i| start::random(n_items, dims, options.seed, i)));
    let stop = Stop { tolerance: options.tolerance, max_steps: options.max_steps };
    let descents = starts.into_par_iter().map(|mut points| {
        // An objective of its own, because one reorders its pairs: a result must not depend on what was computed before.
        let mut objective = objective.clone();
        let end = descend(&mut points, stop, go_on, |at, gradient| objective.evaluate(dims, at, gradient));
        if end.was_stopped { Err(MdsError::Stopped) } else { Ok((end, points)) }
    });
    let found: Vec<_> = descents.collect::<Result<_, _>>()?;
    let stress_by_start = found.iter().map(|(end, _)| end.at.value.sqrt()).collect();
    let (end, points) = found
        .into_iter()
        .min_by(|(a, _), (b, _)| a.at.value.total_cmp(&b.at.value))
        .ok_or(MdsError::OnePoint)?;
    let squares = dissimilarities.pairs().fold(0.0, |sum, (_, _, value)| sum + value * value);
    let points = settle(&points, dims, (squares / end.at.size).sqrt());
    Ok(Mds {
        points,
        stress: end.at.value.sqrt(),
        converged: end.converged,
        n_steps: end.n_steps,
        stress_by_start,
    })
}

#[cfg(test)]
mod tests;
