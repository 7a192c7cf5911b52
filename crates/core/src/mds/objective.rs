//! Stress of a configuration and its gradient.
//!
//! With the disparities `d̂` held still, as the projection onto sequences in order allows, the gradient of
//! `f = Σ (d - d̂)² / Σ d²` at point `i` is `2 / Σ d² · Σ_j ((d - d̂) / d - f) (x_i - x_j)`.

use crate::ar::sum_of;
use crate::dissimilarities::Dissimilarities;
use crate::isotonic::{Pool, Pools};
use crate::mds::descent::Evaluation;
use crate::mds::{ShepardPair, Ties};

/// Pairs that are worked on together, so that what is between two steps stays near.
const N_TOGETHER: usize = 256;

/// Pairs in the order of dissimilarity, and room for what is worked out of a configuration.
pub(super) struct Objective<'a> {
    dissimilarities: &'a Dissimilarities,
    ties: Ties,
    pairs: Vec<[u16; 2]>,
    /// Where runs of equal dissimilarity begin and end, those of one pair left out.
    tied: Vec<(usize, usize)>,
    distances: Vec<f64>,
    pools: Pools,
}

impl<'a> Objective<'a> {
    /// The objective of these dissimilarities, of at most [`crate::mds::MAX_ITEMS`] items.
    pub(super) fn new(dissimilarities: &'a Dissimilarities, ties: Ties) -> Self {
        let (pairs, tied) = in_order(dissimilarities);
        let distances = vec![0.0; pairs.len()];
        Self { dissimilarities, ties, pairs, tied, distances, pools: Pools::default() }
    }

    /// Stress squared at `points`, `dims` coordinates each, and its gradient into `gradient`.
    ///
    /// Infinite where the points have no distances. Cost: linear in the pairs, but for ties, which are sorted.
    pub(super) fn evaluate(&mut self, dims: usize, points: &[f64], gradient: &mut [f64]) -> Evaluation {
        // The number of dimensions is known to the loops over pairs, so that they unroll.
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
            _ => unreachable!("dimensions are 1 to {}, not {dims}", crate::mds::MAX_DIMS),
        }
    }

    /// The pairs as they were evaluated last.
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

    /// Works the distances out, and the sum of their squares.
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

    /// Pools of the distances, in the order of dissimilarity.
    fn regress(&mut self) {
        self.pools.clear();
        let mut from = 0;
        for &(tied, free) in &self.tied {
            match self.ties {
                // In the order of distance, ties are no constraint.
                Ties::Primary => sort_together(&mut self.distances[tied..free], &mut self.pairs[tied..free]),
                Ties::Secondary => {
                    let run = &self.distances[tied..free];
                    self.pools.extend(&self.distances[from..tied]);
                    self.pools.push(Pool { sum: run.iter().sum(), weight: run.len() as f64 });
                    from = free;
                }
            }
        }
        self.pools.extend(&self.distances[from..]);
    }

    /// Adds `(d - d̂) / d (x_i - x_j)` to the gradient at `i` for every `j`, and gives the sum of `(d - d̂)²`.
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
                    // Points that coincide have no direction to part in.
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

    /// Takes `share (x_i - x_j)` from the gradient at `i` for every `j`.
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
        // With every pair there, the sum is known without them.
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

/// Every compared pair in the order of dissimilarity, then of items, and where those of equal dissimilarity begin and end.
fn in_order(dissimilarities: &Dissimilarities) -> (Vec<[u16; 2]>, Vec<(usize, usize)>) {
    // Whole numbers sort several times faster than pairs with their dissimilarity. One of 64 bits holds the dissimilarity
    // to 32 bits and both items; those whose 32 bits are equal are sorted exactly afterwards.
    let highest = dissimilarities.pairs().map(|(_, _, value)| value).fold(0.0, f64::max);
    let scale = f64::from(u32::MAX) / highest;
    let mut keys: Vec<u64> = Vec::with_capacity(dissimilarities.n_items().pow(2) / 2);
    // Not collected: an iterator of many parts runs faster from within.
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
            sort_together(&mut values, pairs);
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

/// The dissimilarity of a pair that was compared.
fn value_of(dissimilarities: &Dissimilarities, [first, second]: [u16; 2]) -> f64 {
    dissimilarities.between(usize::from(first), usize::from(second)).unwrap_or_default()
}

/// Sorts `values`, and puts `pairs` into the same order.
fn sort_together(values: &mut [f64], pairs: &mut [[u16; 2]]) {
    if values.is_sorted() {
        return;
    }
    let mut both: Vec<(f64, [u16; 2])> = values.iter().copied().zip(pairs.iter().copied()).collect();
    // Stable, which also makes use of what is in order from the step before.
    both.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    for ((value, pair), sorted) in values.iter_mut().zip(pairs).zip(both) {
        (*value, *pair) = sorted;
    }
}
