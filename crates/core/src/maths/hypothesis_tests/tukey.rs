//! Tukey's honestly significant difference: which means differ, with one error rate for all pairs.

use crate::maths::hypothesis_tests::groups::Groups;
use crate::maths::hypothesis_tests::intervals::{Confidence, Interval};
use crate::maths::hypothesis_tests::one_way::one_way;
use crate::maths::hypothesis_tests::repeated_measures::repeated_measures;
use crate::maths::hypothesis_tests::studentized_range::{
    studentized_range_quantile_above, studentized_range_upper_tail,
};
use crate::maths::hypothesis_tests::subject_table::{SubjectTable, pairs};

/// Result of Tukey's test of all pairs of means.
#[derive(Clone, Debug, PartialEq)]
pub struct TukeyHsd {
    /// Mean square of the error, in the squared unit of the values.
    pub mean_square: f64,
    /// Degrees of freedom of the error.
    pub dof: usize,
    /// Studentized range that a pair must exceed at the confidence level.
    pub critical: f64,
    /// Every pair of means, in the order of the indices.
    pub pairs: Vec<TukeyPair>,
}

/// Comparison of two means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TukeyPair {
    /// Indices of the groups or conditions, the lower one first.
    pub means: [usize; 2],
    /// First mean minus second mean.
    pub difference: f64,
    /// Confidence interval of the difference. All intervals together contain their true differences with the confidence
    /// level.
    pub interval: Interval,
    /// Studentized range: magnitude of the difference over the standard error of a mean.
    pub studentized_range: f64,
    /// Probability that the largest difference of all means is at least this large, if no means differ.
    pub p_value: f64,
}

/// Tukey's test of independent groups, which assumes normal values with equal variances; for groups of unequal size by
/// C. Y. Kramer (1956). `None` if the values are equal within every group.
pub fn tukey_hsd(groups: &Groups, confidence: Confidence) -> Option<TukeyHsd> {
    let anova = one_way(groups);
    let is_exact = anova.test?.f_test.f.is_infinite();
    let mean_square = anova.squares_within / anova.dof[1] as f64;
    (!is_exact).then(|| compare(&anova.means, &anova.sizes, mean_square, anova.dof[1], confidence))
}

/// Tukey's test of conditions with the error of an analysis of variance with repeated measures. `None` if the error is
/// zero.
///
/// It assumes sphericity: all differences of two conditions have the same variance. Otherwise, compare pairs by
/// [`super::t_tests::paired_t`] with [`super::holm::holm`].
pub fn tukey_hsd_repeated(table: &SubjectTable, confidence: Confidence) -> Option<TukeyHsd> {
    let anova = repeated_measures(table);
    let is_exact = anova.test?.f_test.f.is_infinite();
    let mean_square = anova.squares_error / anova.dof[1] as f64;
    let sizes = vec![anova.n_subjects; anova.condition_means.len()];
    (!is_exact).then(|| compare(&anova.condition_means, &sizes, mean_square, anova.dof[1], confidence))
}

fn compare(means: &[f64], sizes: &[usize], mean_square: f64, dof: usize, confidence: Confidence) -> TukeyHsd {
    let critical = studentized_range_quantile_above(confidence.outside(), means.len(), dof as f64);
    let compare_pair = |[first, second]: [usize; 2]| {
        let difference = means[first] - means[second];
        // Half of the variance of the difference: for equal sizes, the variance of one mean.
        let variance = 0.5 * mean_square * (1.0 / sizes[first] as f64 + 1.0 / sizes[second] as f64);
        let studentized_range = difference.abs() / variance.sqrt();
        TukeyPair {
            means: [first, second],
            difference,
            interval: Interval::around(difference, critical * variance.sqrt()),
            studentized_range,
            p_value: studentized_range_upper_tail(studentized_range, means.len(), dof as f64),
        }
    };
    let pairs = pairs(means.len()).into_iter().map(compare_pair).collect();
    TukeyHsd { mean_square, dof, critical, pairs }
}

#[cfg(test)]
mod tests {
    use super::{tukey_hsd, tukey_hsd_repeated};
    use crate::maths::hypothesis_tests::groups::Groups;
    use crate::maths::hypothesis_tests::intervals::Confidence;
    use crate::maths::hypothesis_tests::one_way::one_way;
    use crate::maths::hypothesis_tests::subject_table::SubjectTable;
    use crate::maths::hypothesis_tests::t_tests::paired_t;
    use proptest::prelude::{ProptestConfig, prop, prop_assert, proptest};

    const LEVEL: Confidence = Confidence::NINETY_FIVE;

    fn groups(values: &[Vec<f64>]) -> Groups {
        Groups::new(values.to_vec()).unwrap()
    }

    /// Example of the documentation of scipy.stats.tukey_hsd, with intervals of six decimals.
    #[test]
    fn the_example_of_scipy_has_its_intervals() {
        let values = [
            vec![24.5, 23.5, 26.4, 27.1, 29.9],
            vec![28.4, 34.2, 29.5, 32.2, 30.1],
            vec![26.1, 28.3, 24.3, 26.2, 27.8],
        ];
        let found = tukey_hsd(&groups(&values), LEVEL).unwrap();
        assert_eq!(found.dof, 12);
        let expected = [
            ([0, 1], -8.249_159, -0.950_841),
            ([0, 2], -3.909_159, 3.389_159),
            ([1, 2], 0.690_841, 7.989_159),
        ];
        for (pair, (means, low, high)) in found.pairs.iter().zip(expected) {
            assert_eq!(pair.means, means);
            assert!((pair.interval.low - low).abs() < 6e-7, "{pair:?}, expected {low}");
            assert!((pair.interval.high - high).abs() < 6e-7, "{pair:?}, expected {high}");
            assert_eq!(pair.p_value < 0.05, low > 0.0 || high < 0.0, "{pair:?}");
        }
    }

    #[test]
    fn an_error_of_zero_has_no_test() {
        assert_eq!(tukey_hsd(&groups(&[vec![0.1; 3], vec![0.3; 3], vec![0.1; 2]]), LEVEL), None);
        assert_eq!(tukey_hsd(&groups(&[vec![0.1; 3], vec![0.1; 3]]), LEVEL), None);
        let additive: Vec<Vec<f64>> = [0.1, 0.4, 0.2].iter().map(|s| vec![*s, s + 0.1, s + 0.3]).collect();
        assert_eq!(tukey_hsd_repeated(&SubjectTable::complete(&additive), LEVEL), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// With two groups or conditions, the test is the F test, or the paired t test.
        #[test]
        fn two_means_have_the_p_value_of_f_and_t(
            values in prop::collection::vec(prop::array::uniform2(-9.0..9.0_f64), 2..12),
        ) {
            let columns = [0, 1].map(|i| values.iter().map(|pair| pair[i]).collect::<Vec<f64>>());
            let pair = tukey_hsd(&groups(&columns), LEVEL).unwrap().pairs[0];
            let f_test = one_way(&groups(&columns)).test.unwrap().f_test;
            prop_assert!((pair.p_value - f_test.p_value).abs() < 1e-8, "{pair:?} {f_test:?}");
            let rows: Vec<Vec<f64>> = values.iter().map(|pair| pair.to_vec()).collect();
            let pair = tukey_hsd_repeated(&SubjectTable::complete(&rows), LEVEL).unwrap().pairs[0];
            let paired = paired_t(&SubjectTable::complete(&rows), [0, 1], LEVEL).test;
            prop_assert!((pair.p_value - paired.ratio.unwrap().p_value).abs() < 1e-8, "{pair:?} {paired:?}");
            let width = paired.interval.high - paired.interval.low;
            prop_assert!((pair.interval.low - paired.interval.low).abs() < 1e-7 * width);
        }
    }
}
