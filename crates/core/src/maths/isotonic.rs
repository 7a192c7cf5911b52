//! Isotonic regression: the non-decreasing sequence closest to a sequence in the least-squares sense.
//!
//! The fit consists of pools of adjacent values; each pool takes the mean of its values. The pools are the edges of the
//! greatest convex minorant of the cumulative sums, plotted over the number of values.

/// Pool of adjacent values with one common fitted value, `sum / weight`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pool {
    /// Sum of the values.
    pub(crate) sum: f64,
    /// Number of values.
    pub(crate) weight: f64,
}

/// Pools of a sequence that grows at its end. Clearing keeps the allocated memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pools {
    pools: Vec<Pool>,
    /// End indices of edges still to be examined, the nearest last.
    ends: Vec<usize>,
}

/// Number of values whose cumulative sums are processed together. It is large enough that few pools remain to be merged
/// one by one, and small enough that the sums stay accurate and in cache.
const N_TOGETHER: usize = 256;

/// Maximum number of falls in a chunk of rising values, such as sorted runs one after the other.
const MOST_FALLS: usize = 24;

/// Returns the non-decreasing sequence with the least sum of squared differences from `values`.
pub fn isotonic(values: &[f64]) -> Vec<f64> {
    let mut pools = Pools::default();
    pools.extend(values);
    pools.fitted().collect()
}

impl Pools {
    /// Removes all values.
    pub(crate) fn clear(&mut self) {
        self.pools.clear();
    }

    /// Pools in order; their means increase.
    pub(crate) fn as_slice(&self) -> &[Pool] {
        &self.pools
    }

    /// Fitted values, one for each input value.
    pub(crate) fn fitted(&self) -> impl Iterator<Item = f64> + '_ {
        self.pools.iter().flat_map(|pool| std::iter::repeat_n(pool.sum / pool.weight, pool.weight as usize))
    }

    /// Appends a pool, and merges it with earlier pools until the means increase (pool adjacent violators).
    pub(crate) fn push(&mut self, mut last: Pool) {
        // Means are compared by cross-multiplication: a division costs more than the rest of the step.
        while let Some(before) =
            self.pools.pop_if(|before| before.sum * last.weight >= last.sum * before.weight)
        {
            last = Pool { sum: before.sum + last.sum, weight: before.weight + last.weight };
        }
        self.pools.push(last);
    }

    /// Appends values. Pushing them one by one gives the same result but causes branch mispredictions.
    pub(crate) fn extend(&mut self, values: &[f64]) {
        let mut sums = [0.0; N_TOGETHER + 1];
        for values in values.chunks(N_TOGETHER) {
            let n_falls = values.windows(2).filter(|two| two[0] > two[1]).count();
            if n_falls <= MOST_FALLS {
                self.extend_rising(values);
                continue;
            }
            let mut sum = 0.0;
            for (total, value) in sums[1..].iter_mut().zip(values) {
                sum += value;
                *total = sum;
            }
            let mut from = 0;
            self.ends.push(values.len());
            while let Some(&to) = self.ends.last() {
                if let Some(between) = farthest_below(&sums[from..=to]) {
                    self.ends.push(from + between);
                } else {
                    self.ends.pop();
                    self.push(Pool { sum: sums[to] - sums[from], weight: (to - from) as f64 });
                    from = to;
                }
            }
        }
    }

    /// Appends values that rise nearly everywhere. In a run of rising values only the first ones can be merged with what
    /// is before.
    fn extend_rising(&mut self, values: &[f64]) {
        for run in values.chunk_by(|a, b| a < b) {
            let single = |value: &f64| Pool { sum: *value, weight: 1.0 };
            for (i, value) in run.iter().enumerate() {
                let n_before = self.pools.len();
                self.push(single(value));
                if self.pools.len() > n_before {
                    self.pools.extend(run[i + 1..].iter().map(single));
                    break;
                }
            }
        }
    }
}

/// Index of the point between the ends that lies farthest below the straight line through them. This point is a vertex
/// of the greatest convex minorant. Returns `None` if no point lies below the line.
fn farthest_below(sums: &[f64]) -> Option<usize> {
    const LANES: usize = 4;
    let [first, between @ .., last] = sums else { return None };
    let slope = (last - first) / (between.len() + 1) as f64;
    let mut lowest = [0.0_f64; LANES];
    let mut lowest_at = [0.0; LANES];
    let mut at = [1.0, 2.0, 3.0, 4.0];
    let (fours, rest) = between.as_chunks::<LANES>();
    // Branch-free, four points at once. Counts are floats, so that all values fit one type of register.
    for four in fours {
        for lane in 0..LANES {
            let height = four[lane] - slope * at[lane] - first;
            let lower = height < lowest[lane];
            lowest[lane] = if lower { height } else { lowest[lane] };
            lowest_at[lane] = if lower { at[lane] } else { lowest_at[lane] };
            at[lane] += LANES as f64;
        }
    }
    let (mut low, mut low_at) = (0.0, 0.0);
    let heights = rest.iter().zip(at).map(|(sum, at)| (sum - slope * at - first, at));
    for (height, at) in lowest.into_iter().zip(lowest_at).chain(heights) {
        if height < low {
            (low, low_at) = (height, at);
        }
    }
    (low < 0.0).then_some(low_at as usize)
}

#[cfg(test)]
mod tests {
    use super::{Pool, Pools, isotonic};
    use crate::maths::rng::lcg_noise;
    use proptest::prelude::{prop, prop_assert, proptest};

    /// Slow reference by the minimax formula: the maximum over all starts of the minimum over all ends of the means.
    fn by_minimax(values: &[f64]) -> Vec<f64> {
        let mean = |from: usize, to: usize| values[from..=to].iter().sum::<f64>() / (to - from + 1) as f64;
        let smallest =
            |from: usize, k: usize| (k..values.len()).map(|to| mean(from, to)).fold(f64::INFINITY, f64::min);
        (0..values.len())
            .map(|k| (0..=k).map(|from| smallest(from, k)).fold(f64::NEG_INFINITY, f64::max))
            .collect()
    }

    #[test]
    fn by_hand() {
        assert_eq!(isotonic(&[]), Vec::<f64>::new());
        assert_eq!(isotonic(&[2.0]), [2.0]);
        assert_eq!(isotonic(&[1.0, 2.0, 2.0, 3.0]), [1.0, 2.0, 2.0, 3.0]);
        assert_eq!(isotonic(&[3.0, 2.0, 1.0]), [2.0, 2.0, 2.0]);
        assert_eq!(isotonic(&[1.0, 4.0, 2.0, 0.0]), [1.0, 2.0, 2.0, 2.0]);
    }

    #[test]
    fn weights_count() {
        let mut pools = Pools::default();
        for (value, weight) in [(4.0, 3.0), (0.0, 1.0), (5.0, 2.0)] {
            pools.push(Pool { sum: value * weight, weight });
        }
        assert_eq!(pools.as_slice(), [Pool { sum: 12.0, weight: 4.0 }, Pool { sum: 10.0, weight: 2.0 }]);
    }

    #[test]
    fn values_together_are_values_one_by_one() {
        for (slope, run, n) in [
            (0.0, 1, 1000),
            (0.001, 1, 3000),
            (0.1, 1, 700),
            (-0.01, 1, 600),
            (2.0, 1, 513),
            (0.0, 50, 1000),
            (0.001, 300, 3000),
            (0.0, 11, 700),
        ] {
            let noise = lcg_noise(n, n as u64);
            let mut values: Vec<f64> = noise.iter().zip(0..).map(|(e, k)| e + slope * f64::from(k)).collect();
            values.chunks_mut(run).for_each(|run| run.sort_by(f64::total_cmp));
            let (mut together, mut single) = (Pools::default(), Pools::default());
            // Chunks whose length is not a multiple of [`N_TOGETHER`].
            for part in values.chunks(301) {
                together.extend(part);
            }
            for sum in &values {
                single.push(Pool { sum: *sum, weight: 1.0 });
            }
            // Sums reach hundreds, and their differences are divided by counts.
            assert!(together.fitted().zip(single.fitted()).all(|(a, b)| (a - b).abs() < 1e-10));
            assert!(together.as_slice().is_sorted_by(|a, b| a.sum * b.weight < b.sum * a.weight));
            together.clear();
            assert!(together.as_slice().is_empty());
        }
    }

    proptest! {
        #[test]
        fn agrees_with_the_minimax_formula(values in prop::collection::vec(-5.0_f64..5.0, 1..40)) {
            // Both methods average the same values of magnitude up to 5; sums up to 200 have rounding errors near 1e-14
            // each.
            for (fast, slow) in isotonic(&values).iter().zip(by_minimax(&values)) {
                prop_assert!((fast - slow).abs() < 1e-12);
            }
        }
    }
}
