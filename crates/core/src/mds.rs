//! Nonmetric multidimensional scaling (Kruskal 1964): points whose distances are in the order of dissimilarities.
//!
//! What is minimized is stress-1, `sqrt(Σ (d - d̂)² / Σ d²)`, where `d` are distances and `d̂`, the disparities, their
//! isotonic regression on the dissimilarities. The square of it has a continuous gradient, in which the disparities may
//! be held still, and a step of it as long as majorization allows is exactly the step of SMACOF (de Leeuw 1977, Guttman
//! transform). Steps here begin as that, take curvature from the ones before (L-BFGS), and are taken only where stress
//! falls: the points that come out are stationary, after a fraction of SMACOF's steps.
//!
//! Stress says nothing about place, size and orientation: points are centered, their axes are principal axes, largest
//! spread first, each with its farthest coordinate positive, and their squared distances sum to the squared
//! dissimilarities.

mod axes;
mod descent;
mod objective;
mod start;

use std::ops::RangeInclusive;

use crate::dissimilarities::Dissimilarities;
use crate::mds::axes::settle;
use crate::mds::descent::{Stop, descend};
use crate::mds::objective::Objective;
use crate::rng::derive_seed;

/// The most dimensions.
pub const MAX_DIMS: usize = 10;

/// The most items: a pair is known by two numbers of 16 bits.
pub const MAX_ITEMS: usize = 1 << 16;

/// What becomes of pairs of equal dissimilarity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ties {
    /// They may be at different distances (Kruskal's primary approach).
    Primary,
    /// They get one disparity (Kruskal's secondary approach).
    Secondary,
}

/// How to scale; [`MdsOptions::usual`] is a good start.
#[derive(Clone, Debug, PartialEq)]
pub struct MdsOptions {
    /// What becomes of ties.
    pub ties: Ties,
    /// Random starts beside the classical one; the best result is kept.
    pub n_random_starts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// Fall of stress in one step, as a share of it, below which the points are stationary.
    pub tolerance: f64,
    /// The most steps from one start.
    pub max_steps: usize,
}

/// A configuration of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Mds {
    /// The points: a row of coordinates for each item.
    pub points: Vec<Vec<f64>>,
    /// Stress-1, 0..1.
    pub stress: f64,
    /// Whether stress stands still; `false` where the steps ran out.
    pub converged: bool,
    /// Steps taken, from the start that was kept.
    pub n_steps: usize,
    /// Stress that each start came to: the classical one, then the random ones; one for a start that was given.
    pub stress_by_start: Vec<f64>,
}

/// A pair in a Shepard diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShepardPair {
    /// Indices of its items, the lower first.
    pub items: [usize; 2],
    /// Its dissimilarity.
    pub dissimilarity: f64,
    /// The distance of its points.
    pub distance: f64,
    /// Its disparity: the distance that would be in order.
    pub disparity: f64,
}

/// Why dissimilarities have no configuration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MdsError {
    /// It was asked to stop.
    #[error("the configuration was not finished")]
    Stopped,
    /// More or fewer dimensions than can be asked for.
    #[error("{dims} dimensions cannot be scaled to; ask for 1 to {MAX_DIMS}")]
    Dims {
        /// The dimensions asked for.
        dims: usize,
    },
    /// Too few items for the dimensions.
    #[error("{dims} dimensions need at least {} items, got {n_items}", dims + 1)]
    TooFew {
        /// The dimensions asked for.
        dims: usize,
        /// The items.
        n_items: usize,
    },
    /// Too many items.
    #[error("{n_items} items are more than the {MAX_ITEMS} that can be scaled")]
    TooMany {
        /// The items.
        n_items: usize,
    },
    /// All dissimilarities are equal: they have no order.
    #[error("all dissimilarities are {value}: without a difference between them any configuration would do")]
    AllEqual {
        /// The value.
        value: f64,
    },
    /// Nothing joins two parts of the items.
    #[error(
        "no chain of compared pairs joins items 0 and {item}; compare items of the two parts, or scale them apart"
    )]
    Apart {
        /// Index of an item that is not joined to item 0.
        item: usize,
    },
    /// A start does not have a row for each item, or rows of different lengths.
    #[error("a configuration of {n_rows} rows does not fit {n_items} items, or its rows differ in length")]
    Shape {
        /// Rows of the configuration.
        n_rows: usize,
        /// The items.
        n_items: usize,
    },
    /// A coordinate is not finite.
    #[error("item {item} has a coordinate that is not a finite number")]
    NotFinite {
        /// Index of the item.
        item: usize,
    },
    /// All points are the same.
    #[error("all points of the configuration coincide: they have no distances to begin with")]
    OnePoint,
}

impl MdsOptions {
    /// Primary ties, twenty random starts, and steps until stress stands still to ten digits.
    ///
    /// Sorts make many ties. On simulated panels over 25 textures with five labels, places along the two axes correlate
    /// with the labels, on average over both axes and eight panels (twelve without noise), by:
    ///
    /// | noise | participants | primary | secondary |
    /// |---|---|---|---|
    /// | 8 points | 3 | .85 | .90 |
    /// | 8 points | 5 | .92 | .92 |
    /// | 8 points | 10 | .94 | .93 |
    /// | 8 points | 20 | .93 | .93 |
    /// | none | 10 | .75 | .87 |
    ///
    /// So secondary ties are the better ones where few take part or all agree; they move less between panels, and have two
    /// to three times the stress.
    pub fn usual(seed: u64) -> Self {
        Self { ties: Ties::Primary, n_random_starts: 20, seed, tolerance: 1e-10, max_steps: 2000 }
    }
}

/// The best configuration of all starts, in `dims` dimensions.
///
/// Items of dissimilarity 0 may coincide, and need not. Pairs never compared have no say. Cost: a sort of the pairs, a
/// decomposition that grows with the items cubed, and tens of steps a start that grow with the pairs.
///
/// # Errors
/// See [`MdsError`].
pub fn nonmetric(
    dissimilarities: &Dissimilarities,
    dims: usize,
    options: &MdsOptions,
) -> Result<Mds, MdsError> {
    check(dissimilarities, dims)?;
    let classical = start::classical(dissimilarities, dims, derive_seed(options.seed, "classical start"));
    best(dissimilarities, dims, options, vec![classical], &mut || true)
}

/// The configuration that one start, a row for each item, descends to; `options` names no other start.
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
    best(dissimilarities, start[0].len(), &options, vec![flat], &mut || true)
}

/// The best configuration in each number of dimensions; the best of one dimension fewer is a start too, so that stress
/// does not rise with dimensions. `go_on` is asked before every step of every descent.
///
/// # Errors
/// See [`MdsError`].
pub fn by_dimension(
    dissimilarities: &Dissimilarities,
    dims: RangeInclusive<usize>,
    options: &MdsOptions,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Mds>, MdsError> {
    let mut all: Vec<Mds> = Vec::new();
    for dims in dims {
        check(dissimilarities, dims)?;
        let seed = derive_seed(options.seed, "classical start");
        let mut starts = vec![start::classical(dissimilarities, dims, seed)];
        if let Some(before) = all.last() {
            starts.push(start::with_axis(&before.points, derive_seed(options.seed, "another axis")));
        }
        all.push(best(dissimilarities, dims, options, starts, go_on)?);
    }
    Ok(all)
}

/// Every compared pair in the order of dissimilarity, with distance and disparity in a configuration.
///
/// # Errors
/// See [`MdsError`].
pub fn shepard(
    dissimilarities: &Dissimilarities,
    points: &[Vec<f64>],
    ties: Ties,
) -> Result<Vec<ShepardPair>, MdsError> {
    let flat = flat(dissimilarities, points)?;
    check(dissimilarities, points[0].len())?;
    let mut objective = Objective::new(dissimilarities, ties);
    objective.evaluate(points[0].len(), &flat, &mut vec![0.0; flat.len()]);
    Ok(objective.shepard())
}

/// Stress-1 of a configuration, a row for each item.
///
/// # Errors
/// See [`MdsError`].
pub fn stress(dissimilarities: &Dissimilarities, points: &[Vec<f64>], ties: Ties) -> Result<f64, MdsError> {
    let pairs = shepard(dissimilarities, points, ties)?;
    let sum = |of: fn(&ShepardPair) -> f64| pairs.iter().map(of).sum::<f64>();
    Ok((sum(|p| (p.distance - p.disparity).powi(2)) / sum(|p| p.distance.powi(2))).sqrt())
}

/// What can be wrong with a question before its start is looked at.
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
    // One pair alone has an order, and is scaled exactly.
    let mut values = dissimilarities.pairs().map(|(_, _, value)| value);
    match values.next() {
        Some(value) if n_items > 2 && values.all(|v| v == value) => Err(MdsError::AllEqual { value }),
        _ => Ok(()),
    }
}

/// The coordinates of a configuration, point by point.
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

/// The best of what `starts` and the random starts descend to.
fn best(
    dissimilarities: &Dissimilarities,
    dims: usize,
    options: &MdsOptions,
    mut starts: Vec<Vec<f64>>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Mds, MdsError> {
    let n_items = dissimilarities.n_items();
    starts.extend((0..options.n_random_starts).map(|i| start::random(n_items, dims, options.seed, i)));
    let stop = Stop { tolerance: options.tolerance, max_steps: options.max_steps };
    let mut objective = Objective::new(dissimilarities, options.ties);
    let mut found = Vec::with_capacity(starts.len());
    for mut points in starts {
        let end = descend(&mut points, stop, go_on, |at, gradient| objective.evaluate(dims, at, gradient));
        if end.was_stopped {
            return Err(MdsError::Stopped);
        }
        found.push((end, points));
    }
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
