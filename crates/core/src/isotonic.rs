//! Isotonic regression: the non-decreasing sequence nearest to a sequence, in the least squares sense.
//!
//! Pools of adjacent violators: a value that lies below the pool before it joins that pool, and a pool is worth its mean.

/// Adjacent values that share one fitted value, `sum / weight`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pool {
    /// Weighted sum of the values.
    pub(crate) sum: f64,
    /// Sum of the weights.
    pub(crate) weight: f64,
}

/// The non-decreasing sequence with the least sum of squared differences from `values`.
pub fn isotonic(values: &[f64]) -> Vec<f64> {
    let ones = values.iter().map(|v| Pool { sum: *v, weight: 1.0 });
    let mut pools = Vec::with_capacity(values.len());
    pool(ones, &mut pools);
    // Weights are counts.
    pools.iter().flat_map(|p| std::iter::repeat_n(p.sum / p.weight, p.weight as usize)).collect()
}

/// The pools of the non-decreasing regression on `values`, each a pool already; what `pools` held is forgotten.
///
/// Cost: one step a value, and one for each pool that is joined.
pub(crate) fn pool(mut values: impl Iterator<Item = Pool>, pools: &mut Vec<Pool>) {
    pools.clear();
    let Some(mut last) = values.next() else { return };
    for value in values {
        // Means are compared by products: a division costs more than the rest of the step.
        if value.sum * last.weight > last.sum * value.weight {
            pools.push(last);
            last = value;
            continue;
        }
        last = last.joined(value);
        while let Some(before) = pools.pop_if(|before| before.sum * last.weight >= last.sum * before.weight) {
            last = before.joined(last);
        }
    }
    pools.push(last);
}

impl Pool {
    fn joined(self, other: Self) -> Self {
        Self { sum: self.sum + other.sum, weight: self.weight + other.weight }
    }
}

#[cfg(test)]
mod tests {
    use super::{Pool, isotonic, pool};
    use proptest::prelude::{prop, prop_assert, proptest};

    /// The slow oracle, by the minimax formula: the largest over all beginnings of the smallest over all ends of means.
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
        let mut pools = Vec::new();
        let value = |v: f64, weight: f64| Pool { sum: v * weight, weight };
        pool([value(4.0, 3.0), value(0.0, 1.0), value(5.0, 2.0)].into_iter(), &mut pools);
        assert_eq!(pools, [Pool { sum: 12.0, weight: 4.0 }, Pool { sum: 10.0, weight: 2.0 }]);
    }

    proptest! {
        #[test]
        fn agrees_with_the_minimax_formula(values in prop::collection::vec(-5.0_f64..5.0, 1..40)) {
            // Both average the same values of up to 5: differences are rounding.
            for (fast, slow) in isotonic(&values).iter().zip(by_minimax(&values)) {
                prop_assert!((fast - slow).abs() < 1e-13);
            }
        }
    }
}
