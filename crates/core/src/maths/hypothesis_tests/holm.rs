//! Correction of p-values for the number of tests.

/// Adjusts p-values by S. Holm (1979): the probability of one or more false rejections among all tests is at most the
/// level with which the adjusted values are compared, also for tests that depend on each other.
///
/// The smallest of `m` values is multiplied by `m`, the next one by `m - 1`, and so on. No value is below one that was
/// smaller before, or above 1. The order of the values stays.
pub fn holm(p_values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|a, b| p_values[*a].total_cmp(&p_values[*b]));
    let mut adjusted = vec![0.0; p_values.len()];
    let mut largest = 0.0_f64;
    for (n_before, index) in order.into_iter().enumerate() {
        largest = largest.max((p_values.len() - n_before) as f64 * p_values[index]).min(1.0);
        adjusted[index] = largest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::holm;
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn values_are_multiplied_by_the_number_of_those_that_are_not_smaller() {
        let adjusted = holm(&[0.01, 0.04, 0.03, 0.005]);
        for (got, expected) in adjusted.iter().zip([0.03, 0.06, 0.06, 0.02]) {
            assert!((got - expected).abs() < 1e-12, "{adjusted:?}");
        }
        assert_eq!((holm(&[]), holm(&[0.7, 0.9])), (vec![], vec![1.0, 1.0]));
    }

    proptest! {
        /// The closed test of all intersections: a hypothesis is rejected if every set of hypotheses that contains it
        /// is, each by Bonferroni. Its adjusted value is the largest of the sets.
        #[test]
        fn holm_is_the_closed_bonferroni_test(p_values in prop::collection::vec(0.0..0.4_f64, 1..7)) {
            let adjusted = holm(&p_values);
            let n = p_values.len();
            for (index, adjusted) in adjusted.iter().enumerate() {
                let of_set = |set: u32| {
                    let members = (0..n).filter(|member| set & (1_u32 << *member) != 0);
                    let smallest = members.map(|member| p_values[member]).fold(1.0, f64::min);
                    (f64::from(set.count_ones()) * smallest).min(1.0)
                };
                let sets = (1..1_u32 << n).filter(|set| *set & (1_u32 << index) != 0);
                let closed = sets.map(of_set).fold(0.0, f64::max);
                prop_assert!((adjusted - closed).abs() < 1e-12, "{adjusted} {closed}");
            }
        }
    }
}
