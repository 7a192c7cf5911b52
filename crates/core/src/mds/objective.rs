//! Stress of a configuration and its gradient.
//!
//! With the disparities `d̂` held still, as the projection onto sequences in order allows, the gradient of
//! `f = Σ (d - d̂)² / Σ d²` at point `i` is `2 / Σ d² · Σ_j ((d - d̂) / d - f) (x_i - x_j)`.

use crate::ar::sum_of;
use crate::dissimilarities::Dissimilarities;
use crate::isotonic::{Pool, pool};
use crate::mds::descent::Evaluation;
use crate::mds::{ShepardPair, Ties};

/// Pairs in the order of dissimilarity, and room for what is worked out of a configuration.
pub(super) struct Objective {
    ties: Ties,
    n_items: usize,
    dissimilarities: Vec<f64>,
    pairs: Vec<[u16; 2]>,
    /// Where runs of equal dissimilarity begin and end, those of one pair left out.
    tied: Vec<(usize, usize)>,
    distances: Vec<f64>,
    /// What the difference of a pair's points is weighted with in the gradient.
    pulls: Vec<f64>,
    pools: Vec<Pool>,
}

impl Objective {
    /// The objective of these dissimilarities, of at most [`crate::mds::MAX_ITEMS`] items.
    pub(super) fn new(dissimilarities: &Dissimilarities, ties: Ties) -> Self {
        let (values, pairs) = in_order(dissimilarities);
        let n = pairs.len();
        let mut tied = Vec::new();
        let mut from = 0;
        for run in values.chunk_by(|a, b| a == b) {
            if run.len() > 1 {
                tied.push((from, from + run.len()));
            }
            from += run.len();
        }
        Self {
            ties,
            n_items: dissimilarities.n_items(),
            dissimilarities: values,
            pairs,
            tied,
            distances: vec![0.0; n],
            pulls: vec![0.0; n],
            pools: Vec::with_capacity(n),
        }
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

    /// Root of the squares of dissimilarities over those of the distances of `points`.
    pub(super) fn size(&mut self, dims: usize, points: &[f64]) -> f64 {
        let mut gradient = vec![0.0; points.len()];
        self.evaluate(dims, points, &mut gradient);
        (sum_of_squares(&self.dissimilarities) / sum_of_squares(&self.distances)).sqrt()
    }

    /// The pairs as they were evaluated last.
    pub(super) fn shepard(&self) -> Vec<ShepardPair> {
        let disparities =
            self.pools.iter().flat_map(|p| std::iter::repeat_n(p.sum / p.weight, p.weight as usize));
        let measured = self.dissimilarities.iter().zip(&self.distances).zip(disparities);
        let pair = |(items, ((dissimilarity, distance), disparity)): (&[u16; 2], ((&f64, &f64), f64))| {
            let items = items.map(usize::from);
            ShepardPair { items, dissimilarity: *dissimilarity, distance: *distance, disparity }
        };
        self.pairs.iter().zip(measured).map(pair).collect()
    }

    fn evaluate_in<const DIMS: usize>(&mut self, points: &[f64], gradient: &mut [f64]) -> Evaluation {
        let (points, _) = points.as_chunks::<DIMS>();
        let (gradient, _) = gradient.as_chunks_mut::<DIMS>();
        self.measure(points);
        self.regress();
        let size = sum_of_squares(&self.distances);
        let value = self.misfit() / size;
        // Points that coincide have no direction to part in.
        for (pull, distance) in self.pulls.iter_mut().zip(&self.distances) {
            *pull = if *distance > 0.0 { *pull / distance - value } else { 0.0 };
        }
        gradient.fill([0.0; DIMS]);
        self.pull(points, gradient);
        for g in gradient.as_flattened_mut() {
            *g *= 2.0 / size;
        }
        if !value.is_finite() {
            return Evaluation { value: f64::INFINITY, guttman: 0.0 };
        }
        Evaluation { value, guttman: size / (2.0 * self.n_items as f64 * (1.0 - value)) }
    }

    fn measure<const DIMS: usize>(&mut self, points: &[[f64; DIMS]]) {
        for (distance, pair) in self.distances.iter_mut().zip(&self.pairs) {
            let [p, q] = pair.map(|item| &points[usize::from(item)]);
            *distance = (0..DIMS).map(|axis| (p[axis] - q[axis]) * (p[axis] - q[axis])).sum();
        }
        // A pass of its own, because roots of neighbors are taken at once.
        for distance in &mut self.distances {
            *distance = distance.sqrt();
        }
    }

    /// Pools of the distances, in the order of dissimilarity.
    fn regress(&mut self) {
        match self.ties {
            Ties::Primary => {
                for &(from, to) in &self.tied {
                    sort_together(&mut self.distances[from..to], &mut self.pairs[from..to]);
                }
                let each = self.distances.iter().map(|d| Pool { sum: *d, weight: 1.0 });
                pool(each, &mut self.pools);
            }
            Ties::Secondary => {
                let mut rest = &self.distances[..];
                let runs = self.dissimilarities.chunk_by(|a, b| a == b).map(|run| {
                    let (tied, after) = rest.split_at(run.len());
                    rest = after;
                    Pool { sum: tied.iter().sum(), weight: tied.len() as f64 }
                });
                pool(runs, &mut self.pools);
            }
        }
    }

    /// Sum of the squared differences of distances and disparities; the differences are left in `pulls`.
    fn misfit(&mut self) -> f64 {
        let mut from = 0;
        for pool in &self.pools {
            let to = from + pool.weight as usize;
            let disparity = pool.sum / pool.weight;
            for (pull, distance) in self.pulls[from..to].iter_mut().zip(&self.distances[from..to]) {
                *pull = distance - disparity;
            }
            from = to;
        }
        sum_of_squares(&self.pulls)
    }

    fn pull<const DIMS: usize>(&self, points: &[[f64; DIMS]], gradient: &mut [[f64; DIMS]]) {
        for (pull, pair) in self.pulls.iter().zip(&self.pairs) {
            let [i, j] = pair.map(usize::from);
            for axis in 0..DIMS {
                let force = pull * (points[i][axis] - points[j][axis]);
                gradient[i][axis] += force;
                gradient[j][axis] -= force;
            }
        }
    }
}

/// Every compared pair in the order of dissimilarity, then of items: dissimilarities and items.
fn in_order(dissimilarities: &Dissimilarities) -> (Vec<f64>, Vec<[u16; 2]>) {
    // Whole numbers sort several times faster than pairs with their dissimilarity. One of 64 bits holds the dissimilarity
    // to 32 bits and both items; those whose 32 bits are equal are sorted exactly afterwards.
    let highest = dissimilarities.pairs().map(|(_, _, value)| value).fold(0.0, f64::max);
    let scale = f64::from(u32::MAX) / highest;
    let key = |(first, second, value): (usize, usize, f64)| {
        u64::from((value * scale) as u32) << 32 | (first as u64) << 16 | second as u64
    };
    let mut keys: Vec<u64> = dissimilarities.pairs().map(key).collect();
    keys.sort_unstable();
    let items = |key: &u64| [(key >> 16) as u16, *key as u16];
    let value = |[first, second]: [u16; 2]| {
        // A pair with a key was compared.
        dissimilarities.between(usize::from(first), usize::from(second)).unwrap_or_default()
    };
    let mut pairs: Vec<[u16; 2]> = keys.iter().map(items).collect();
    let mut values: Vec<f64> = pairs.iter().map(|pair| value(*pair)).collect();
    let mut from = 0;
    for run in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
        let to = from + run.len();
        sort_together(&mut values[from..to], &mut pairs[from..to]);
        from = to;
    }
    (values, pairs)
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

fn sum_of_squares(values: &[f64]) -> f64 {
    sum_of(values, |v| v * v)
}
