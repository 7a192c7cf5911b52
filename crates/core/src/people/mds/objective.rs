//! Squared stress of a configuration and its gradient.
//!
//! Disparities `d̂` are a projection onto a convex cone: that of the ordered sequences, or that of the rising linear
//! functions of the dissimilarities without negative values. The gradient is therefore computed with them held fixed.
//! The gradient of `f = Σ (d - d̂)² / Σ d²` at point `i` is `2 / Σ d² · Σ_j ((d - d̂) / d - f) (x_i - x_j)`.

use crate::maths::isotonic::{Pool, Pools};
use crate::maths::sums::sum_of;
use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::descent::Evaluation;
use crate::people::mds::sorter::Sorter;
use crate::people::mds::{ShepardPair, Transform};

/// Number of pairs processed together, so that intermediate values stay in the cache.
const N_TOGETHER: usize = 256;

/// Pairs in the order of dissimilarity, with buffers for the evaluation of a configuration.
#[derive(Clone)]
pub(super) struct Objective<'a> {
    dissimilarities: &'a Dissimilarities,
    transform: Transform,
    pairs: Vec<[u16; 2]>,
    /// Start and end of each run of tied dissimilarities; runs of one pair are omitted.
    tied: Vec<(usize, usize)>,
    /// Dissimilarity of each pair minus the lowest one; only the linear transformation needs them.
    values: Vec<f64>,
    distances: Vec<f64>,
    pools: Pools,
    sorter: Sorter,
}

impl<'a> Objective<'a> {
    /// Objective of these dissimilarities, for at most [`crate::people::mds::MAX_ITEMS`] items.
    pub(super) fn new(dissimilarities: &'a Dissimilarities, transform: Transform) -> Self {
        let mut sorter = Sorter::default();
        let (pairs, tied) = in_order(dissimilarities, &mut sorter);
        let distances = vec![0.0; pairs.len()];
        let values = match transform {
            Transform::PrimaryTies | Transform::SecondaryTies => Vec::new(),
            Transform::Interval => {
                let lowest = pairs.first().map_or(0.0, |pair| value_of(dissimilarities, *pair));
                pairs.iter().map(|pair| value_of(dissimilarities, *pair) - lowest).collect()
            }
        };
        Self { dissimilarities, transform, pairs, tied, values, distances, pools: Pools::default(), sorter }
    }

    /// Squared stress at `points`, which hold `dims` coordinates each; writes its gradient into `gradient`.
    ///
    /// The value is infinite if all points coincide. Cost: linear in the pairs, except that tied pairs are sorted.
    pub(super) fn evaluate(&mut self, dims: usize, points: &[f64], gradient: &mut [f64]) -> Evaluation {
        // A constant number of dimensions lets the compiler unroll the loops over pairs.
        match dims {
            1 => self.evaluate_in::<1>(points, gradient),
            2 => self.evaluate_in::<2>(points, gradient),
            3 => self.evaluate_in::<3>(points, gradient),
            4 => self.evaluate_in::<4>(points, gradient),
            5 => self.evaluate_in::<5>(points, gradient),
            6 => self.evaluate_in::<6>(points, gradient),
            7 => self.evaluate_in::<7>(points, gradient),
            8 => self.evaluate_in::<8>(points, gradient),
            9 => self.evaluate_in::<9>(points, gradient),
            10 => self.evaluate_in::<10>(points, gradient),
            _ => {
                unreachable!("the number of dimensions is 1 to {}, not {dims}", crate::people::mds::MAX_DIMS)
            }
        }
    }

    /// All pairs with the distances and disparities of the last evaluation.
    pub(super) fn shepard(&self) -> Vec<ShepardPair> {
        let pair = |((items, distance), disparity): ((&[u16; 2], &f64), f64)| ShepardPair {
            items: items.map(usize::from),
            dissimilarity: value_of(self.dissimilarities, *items),
            distance: *distance,
            disparity,
        };
        self.pairs.iter().zip(&self.distances).zip(self.pools.fitted()).map(pair).collect()
    }

    fn evaluate_in<const DIMS: usize>(&mut self, points: &[f64], gradient: &mut [f64]) -> Evaluation {
        let (points, _) = points.as_chunks::<DIMS>();
        let (gradient, _) = gradient.as_chunks_mut::<DIMS>();
        let size = self.measure(points);
        self.regress();
        gradient.fill([0.0; DIMS]);
        let value = self.pull(points, gradient) / size;
        if !value.is_finite() {
            return Evaluation { value: f64::INFINITY, guttman: 0.0, size };
        }
        self.pull_alike(points, gradient, value);
        for g in gradient.as_flattened_mut() {
            *g *= 2.0 / size;
        }
        Evaluation { value, guttman: size / (2.0 * points.len() as f64 * (1.0 - value)), size }
    }

    /// Computes all distances and returns the sum of their squares.
    fn measure<const DIMS: usize>(&mut self, points: &[[f64; DIMS]]) -> f64 {
        let mut size = 0.0;
        let together = self.distances.chunks_mut(N_TOGETHER).zip(self.pairs.chunks(N_TOGETHER));
        for (distances, pairs) in together {
            for (distance, pair) in distances.iter_mut().zip(pairs) {
                let [p, q] = pair.map(|item| &points[usize::from(item)]);
                *distance = (0..DIMS).map(|axis| (p[axis] - q[axis]) * (p[axis] - q[axis])).sum();
            }
            size += sum_of(distances, |square| square);
            for distance in distances {
                *distance = distance.sqrt();
            }
        }
        size
    }

    /// Computes the regression of the distances in the order of dissimilarity.
    fn regress(&mut self) {
        self.pools.clear();
        if self.transform == Transform::Interval {
            self.regress_linearly();
            return;
        }
        let mut from = 0;
        for &(tied, free) in &self.tied {
            match self.transform {
                // Sorted by distance, tied pairs do not constrain the regression.
                Transform::PrimaryTies => {
                    self.sorter.sort(&mut self.distances[tied..free], &mut self.pairs[tied..free]);
                }
                Transform::SecondaryTies | Transform::Interval => {
                    let run = &self.distances[tied..free];
                    self.pools.extend(&self.distances[from..tied]);
                    self.pools.push(Pool { sum: run.iter().sum(), weight: run.len() as f64 });
                    from = free;
                }
            }
        }
        self.pools.extend(&self.distances[from..]);
    }

    /// Computes the linear regression of the distances on the dissimilarities, with a slope and a lowest disparity of 0
    /// or more.
    fn regress_linearly(&mut self) {
        let n = self.values.len() as f64;
        let value_mean = sum_of(&self.values, |value| value) / n;
        let mean = sum_of(&self.distances, |distance| distance) / n;
        let spread = sum_of(&self.values, |value| (value - value_mean) * (value - value_mean));
        let product = |from: f64, center: f64| -> f64 {
            self.values.iter().zip(&self.distances).map(|(value, d)| (value - from) * (d - center)).sum()
        };
        let mut slope = if spread > 0.0 { (product(value_mean, mean) / spread).max(0.0) } else { 0.0 };
        let mut lowest = mean - slope * value_mean;
        if lowest < 0.0 {
            // The projection lies on the edge of the cone: a line through the origin.
            lowest = 0.0;
            slope = product(0.0, 0.0) / sum_of(&self.values, |value| value * value);
        }
        // The values rise, so only equal ones are pooled.
        for value in &self.values {
            self.pools.push(Pool { sum: lowest + slope * value, weight: 1.0 });
        }
    }

    /// Adds `(d - d̂) / d (x_i - x_j)` to the gradient at `i` for every `j` and returns the sum of `(d - d̂)²`.
    fn pull<const DIMS: usize>(&self, points: &[[f64; DIMS]], gradient: &mut [[f64; DIMS]]) -> f64 {
        let mut shares = [0.0; N_TOGETHER];
        let mut misfit = 0.0;
        let mut from = 0;
        for pool in self.pools.as_slice() {
            let to = from + pool.weight as usize;
            let disparity = pool.sum / pool.weight;
            let together =
                self.distances[from..to].chunks(N_TOGETHER).zip(self.pairs[from..to].chunks(N_TOGETHER));
            for (distances, pairs) in together {
                misfit += sum_of(distances, |distance| (distance - disparity) * (distance - disparity));
                for (share, distance) in shares.iter_mut().zip(distances) {
                    // Coincident points have no direction between them.
                    *share = if *distance > 0.0 { (distance - disparity) / distance } else { 0.0 };
                }
                for (share, pair) in shares.iter().zip(pairs) {
                    pull_pair(points, gradient, *pair, *share);
                }
            }
            from = to;
        }
        misfit
    }

    /// Subtracts `share (x_i - x_j)` from the gradient at `i` for every `j`.
    fn pull_alike<const DIMS: usize>(
        &self,
        points: &[[f64; DIMS]],
        gradient: &mut [[f64; DIMS]],
        share: f64,
    ) {
        let n = points.len();
        if self.pairs.len() < n * (n - 1) / 2 {
            for pair in &self.pairs {
                pull_pair(points, gradient, *pair, -share);
            }
            return;
        }
        // For complete data the sum over all pairs has a closed form.
        for axis in 0..DIMS {
            let sum: f64 = points.iter().map(|p| p[axis]).sum();
            for (g, p) in gradient.iter_mut().zip(points) {
                g[axis] -= share * (n as f64 * p[axis] - sum);
            }
        }
    }
}

fn pull_pair<const DIMS: usize>(
    points: &[[f64; DIMS]],
    gradient: &mut [[f64; DIMS]],
    pair: [u16; 2],
    share: f64,
) {
    let [i, j] = pair.map(usize::from);
    for axis in 0..DIMS {
        let force = share * (points[i][axis] - points[j][axis]);
        gradient[i][axis] += force;
        gradient[j][axis] -= force;
    }
}

/// All compared pairs sorted by dissimilarity, then by items, and the start and end of each run of ties.
fn in_order(dissimilarities: &Dissimilarities, sorter: &mut Sorter) -> (Vec<[u16; 2]>, Vec<(usize, usize)>) {
    // Integers sort several times faster than pairs with their dissimilarity. A 64-bit key holds the dissimilarity in
    // 32 bits and both items. Pairs whose 32 bits are equal are then sorted exactly.
    let highest = dissimilarities.pairs().map(|(_, _, value)| value).fold(0.0, f64::max);
    let scale = f64::from(u32::MAX) / highest;
    let mut keys: Vec<u64> = Vec::with_capacity(dissimilarities.n_items().pow(2) / 2);
    // Not collected: internal iteration is faster for a chained iterator.
    dissimilarities.pairs().for_each(|(first, second, value)| {
        keys.push(u64::from((value * scale) as u32) << 32 | (first as u64) << 16 | second as u64);
    });
    keys.sort_unstable();
    let mut pairs: Vec<[u16; 2]> = keys.iter().map(|key| [(key >> 16) as u16, *key as u16]).collect();
    let mut tied = Vec::new();
    let mut from = 0;
    for run in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
        let to = from + run.len();
        if run.len() > 1 {
            let pairs = &mut pairs[from..to];
            let mut values: Vec<f64> = pairs.iter().map(|pair| value_of(dissimilarities, *pair)).collect();
            sorter.sort(&mut values, pairs);
            let mut begin = from;
            for equal in values.chunk_by(|a, b| a == b) {
                if equal.len() > 1 {
                    tied.push((begin, begin + equal.len()));
                }
                begin += equal.len();
            }
        }
        from = to;
    }
    (pairs, tied)
}

/// Dissimilarity of a compared pair.
fn value_of(dissimilarities: &Dissimilarities, [first, second]: [u16; 2]) -> f64 {
    dissimilarities.between(usize::from(first), usize::from(second)).unwrap_or_default()
}
