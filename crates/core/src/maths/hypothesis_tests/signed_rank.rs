//! Signed-rank test of Wilcoxon: whether the answers of the same subjects under two conditions differ in their
//! location.

use std::f64::consts::FRAC_1_SQRT_2;

use statrs::function::erf::erfc;

use crate::maths::hypothesis_tests::ranks::ranks;
use crate::maths::hypothesis_tests::subject_table::SubjectTable;

/// Most differences for which the probability is exact, if no two have the same magnitude and none is zero.
const MOST_EXACT: usize = 50;

/// Most differences for which the probability is exact with ties or zeros.
const MOST_EXACT_TIED: usize = 13;

/// Result of a signed-rank test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignedRank {
    /// Sum of the ranks of positive differences; equal magnitudes have the mean of their ranks.
    pub positive: f64,
    /// Sum of the ranks of negative differences. scipy's statistic is the smaller of both sums.
    pub negative: f64,
    /// Number of differences other than zero; zeros are left out (Wilcoxon 1945).
    pub n: usize,
    /// Probability of sums at least this unequal, if positive and negative differences are equally likely.
    pub p_value: f64,
    /// Computation of the probability.
    pub method: Method,
    /// Effect size: the difference of both sums over their total, the matched-pairs rank-biserial correlation, -1 to 1.
    pub rank_biserial: f64,
}

/// Computation of the probability of a signed-rank test, chosen as by scipy's method "auto".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Over all combinations of signs of the ranks: for up to 50 differences without ties or zeros, or up to 13 in all.
    Exact,
    /// By the normal approximation with the correction for ties, and without one for continuity.
    Normal,
}

/// Test of the conditions `first` and `second` of a table; `None` if all differences are zero.
///
/// Differences are compared as they are computed: decimals such as 0.3 - 0.2 and 0.2 - 0.1 are no tie. Convert ratings
/// to whole numbers first, as for scipy.
///
/// # Panics
/// If `first` or `second` is not an index of the table's conditions.
pub fn signed_rank(table: &SubjectTable, [first, second]: [usize; 2]) -> Option<SignedRank> {
    let all = table.differences(first, second);
    let differences: Vec<f64> = all.iter().copied().filter(|difference| *difference != 0.0).collect();
    let n = differences.len();
    if n == 0 {
        return None;
    }
    let ranked = ranks(&differences.iter().map(|difference| difference.abs()).collect::<Vec<f64>>());
    let signed = differences.iter().zip(&ranked.ranks);
    let positive: f64 = signed.filter(|(difference, _)| **difference > 0.0).map(|(_, rank)| rank).sum();
    let total = 0.5 * (n * (n + 1)) as f64;
    let is_plain = ranked.ties.is_empty() && n == all.len();
    let limit = if is_plain { MOST_EXACT } else { MOST_EXACT_TIED };
    let method = if all.len() <= limit { Method::Exact } else { Method::Normal };
    let p_value = match method {
        Method::Exact => exact_probability(&ranked.ranks, positive),
        Method::Normal => normal_probability(n, &ranked.ties, positive),
    };
    let negative = total - positive;
    Some(SignedRank { positive, negative, n, p_value, method, rank_biserial: (positive - negative) / total })
}

/// Twice the smaller tail of the sum of positive ranks over all combinations of signs, at most 1.
fn exact_probability(ranks: &[f64], positive: f64) -> f64 {
    // Ranks are whole or half: twice a rank is an index.
    let doubled = |rank: f64| (2.0 * rank).round() as usize;
    let n_sums = ranks.iter().map(|rank| doubled(*rank)).sum::<usize>() + 1;
    // Number of combinations with each sum, below 2^50 and therefore exact.
    let mut counts = vec![0.0; n_sums];
    counts[0] = 1.0;
    for rank in ranks {
        let rank = doubled(*rank);
        for sum in (rank..n_sums).rev() {
            counts[sum] += counts[sum - rank];
        }
    }
    let at = doubled(positive);
    let (below, above): (f64, f64) = (counts[..=at].iter().sum(), counts[at..].iter().sum());
    (2.0 * below.min(above) / counts.iter().sum::<f64>()).min(1.0)
}

fn normal_probability(n: usize, ties: &[usize], positive: f64) -> f64 {
    let n = n as f64;
    let tied: f64 = ties.iter().map(|size| *size as f64).map(|size| size * size * size - size).sum();
    let variance = (n * (n + 1.0) * (2.0 * n + 1.0) - 0.5 * tied) / 24.0;
    let z = (positive - 0.25 * n * (n + 1.0)) / variance.sqrt();
    erfc(z.abs() * FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::{Method, SignedRank, exact_probability, normal_probability, signed_rank};
    use crate::maths::hypothesis_tests::subject_table::SubjectTable;
    use proptest::prelude::{prop, prop_assert, proptest};

    fn of_differences(differences: &[f64]) -> Option<SignedRank> {
        let rows: Vec<Vec<f64>> = differences.iter().map(|difference| vec![*difference, 0.0]).collect();
        signed_rank(&SubjectTable::complete(&rows), [0, 1])
    }

    #[test]
    fn five_positive_differences_have_two_of_32_combinations() {
        let found = of_differences(&[1.0, 2.5, 3.0, 4.0, 7.0]).unwrap();
        assert_eq!((found.positive, found.negative, found.n, found.method), (15.0, 0.0, 5, Method::Exact));
        assert_eq!((found.p_value, found.rank_biserial), (2.0 / 32.0, 1.0));
        assert_eq!(of_differences(&[0.0, 0.0, -0.0]), None);
    }

    #[test]
    fn the_method_depends_on_number_ties_and_zeros() {
        let method = |n: i32, last: &[f64]| {
            let mut differences: Vec<f64> = (1..=n).map(f64::from).collect();
            differences.extend(last);
            of_differences(&differences).unwrap().method
        };
        assert_eq!((method(50, &[]), method(51, &[])), (Method::Exact, Method::Normal));
        assert_eq!((method(12, &[-5.0]), method(13, &[-5.0])), (Method::Exact, Method::Normal));
        assert_eq!((method(12, &[0.0]), method(13, &[0.0])), (Method::Exact, Method::Normal));
    }

    #[test]
    fn the_normal_approximation_is_near_the_exact_probability() {
        let ranks: Vec<f64> = (1..=50).map(f64::from).collect();
        for positive in [300.0, 420.0, 637.0, 800.0] {
            let (exact, normal) =
                (exact_probability(&ranks, positive), normal_probability(50, &[], positive));
            // Half a step of the sum of ranks is 0.005 standard deviations.
            assert!((exact - normal).abs() < 0.006, "{positive}: {exact} {normal}");
        }
    }

    proptest! {
        /// Slow oracle: the sums of all combinations of signs.
        #[test]
        fn the_exact_probability_counts_combinations(
            differences in prop::collection::vec(-4..=4_i32, 2..11),
        ) {
            let differences: Vec<f64> = differences.into_iter().map(f64::from).collect();
            let Some(found) = of_differences(&differences) else { return Ok(()) };
            let magnitudes: Vec<f64> = differences.iter().map(|d| d.abs()).filter(|d| *d > 0.0).collect();
            let rank = |of: f64| {
                let below = magnitudes.iter().filter(|other| **other < of).count();
                let equal = magnitudes.iter().filter(|other| **other == of).count();
                below as f64 + 0.5 * (equal + 1) as f64
            };
            let n_combinations = 1_u32 << found.n;
            let (mut below, mut above) = (0_u32, 0_u32);
            for signs in 0..n_combinations {
                let positive = magnitudes.iter().enumerate().filter(|(i, _)| signs & (1_u32 << *i) != 0);
                let sum: f64 = positive.map(|(_, magnitude)| rank(*magnitude)).sum();
                below += u32::from(sum <= found.positive);
                above += u32::from(sum >= found.positive);
            }
            let oracle = (2.0 * f64::from(below.min(above)) / f64::from(n_combinations)).min(1.0);
            prop_assert!((found.p_value - oracle).abs() < 1e-12, "{found:?} {oracle}");
            let opposite: Vec<f64> = differences.iter().map(|d| -d).collect();
            let opposite = of_differences(&opposite).unwrap();
            prop_assert!(opposite.rank_biserial == -found.rank_biserial);
            prop_assert!((opposite.p_value - found.p_value).abs() < 1e-12);
        }
    }
}
