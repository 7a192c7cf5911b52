//! Friedman's test: whether the same subjects answer differently under different conditions, by the ranks of their
//! answers.
//!
//! It replaces an analysis of variance with repeated measures where the answers are not normal.

use crate::maths::hypothesis_tests::holm::holm;
use crate::maths::hypothesis_tests::ranks::ranks;
use crate::maths::hypothesis_tests::signed_rank::{SignedRank, signed_rank};
use crate::maths::hypothesis_tests::subject_table::SubjectTable;
use crate::maths::statistics::chi_squared_upper_tail;

/// Result of Friedman's test.
#[derive(Clone, Debug, PartialEq)]
pub struct Friedman {
    /// Mean rank of each condition over the complete subjects, from 1 for the lowest answers.
    pub mean_ranks: Vec<f64>,
    /// Number of complete subjects.
    pub n_subjects: usize,
    /// Number of subjects who were left out because of a missing cell.
    pub n_left_out: usize,
    /// Test of the ranks; `None` if every subject gives equal answers under all conditions.
    pub test: Option<FriedmanTest>,
}

/// Statistic of Friedman's test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FriedmanTest {
    /// Friedman's χ² with the correction for ties, 0 or more. Under two conditions, it is that of the sign test.
    pub chi_squared: f64,
    /// Degrees of freedom: the number of conditions minus 1.
    pub dof: usize,
    /// Probability of a χ² at least this large under the null hypothesis, by the χ² distribution. It is approximate for
    /// few subjects.
    pub p_value: f64,
    /// Kendall's coefficient of concordance W, the effect size: 0 (no agreement) to 1 (all subjects have the same
    /// ranks).
    pub kendalls_w: f64,
}

/// Comparison of two conditions after Friedman's test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConditionPair {
    /// Indices of the conditions, the lower one first.
    pub conditions: [usize; 2],
    /// Wilcoxon's test of first minus second; `None` if no subject answers differently.
    pub signed_rank: Option<SignedRank>,
    /// Its probability, adjusted by Holm for the number of pairs. A pair without a difference counts with a probability
    /// of 1.
    pub adjusted_p_value: f64,
}

/// Friedman's test of subjects under conditions. Each subject's answers become ranks; ties have mean ranks.
pub fn friedman(table: &SubjectTable) -> Friedman {
    let (n, k) = (table.n_subjects() as f64, table.n_conditions());
    let rows: Vec<Vec<f64>> = table.rows().iter().map(|row| ranks(row).ranks).collect();
    let sums: Vec<f64> = (0..k).map(|condition| rows.iter().map(|row| row[condition]).sum()).collect();
    // All of these sums are of half numbers, and exact.
    let middle = 0.5 * (k + 1) as f64;
    let between: f64 = sums.iter().map(|sum| (sum - n * middle).powi(2)).sum();
    let total: f64 = rows.iter().flatten().map(|rank| (rank - middle).powi(2)).sum();
    let test = (total > 0.0).then(|| {
        let dof = k - 1;
        let chi_squared = dof as f64 * between / total;
        FriedmanTest {
            chi_squared,
            dof,
            p_value: chi_squared_upper_tail(chi_squared, dof as f64),
            kendalls_w: chi_squared / (n * dof as f64),
        }
    });
    Friedman {
        mean_ranks: sums.iter().map(|sum| sum / n).collect(),
        n_subjects: table.n_subjects(),
        n_left_out: table.n_left_out(),
        test,
    }
}

/// Compares every pair of conditions by Wilcoxon's signed-rank test, adjusted by Holm: which conditions differ if
/// [`friedman`] finds that some do.
pub fn friedman_pairs(table: &SubjectTable) -> Vec<ConditionPair> {
    let tests: Vec<([usize; 2], Option<SignedRank>)> =
        table.pairs().into_iter().map(|pair| (pair, signed_rank(table, pair))).collect();
    let p_values: Vec<f64> = tests.iter().map(|(_, test)| test.map_or(1.0, |test| test.p_value)).collect();
    tests
        .into_iter()
        .zip(holm(&p_values))
        .map(|((conditions, signed_rank), adjusted_p_value)| ConditionPair {
            conditions,
            signed_rank,
            adjusted_p_value,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{friedman, friedman_pairs};
    use crate::maths::hypothesis_tests::subject_table::SubjectTable;
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn subjects_who_agree_have_a_concordance_of_one() {
        let rows: Vec<Vec<f64>> = [0.0, 10.0, 5.0].iter().map(|s| vec![s + 1.0, s + 9.0, s + 4.0]).collect();
        let found = friedman(&SubjectTable::complete(&rows));
        assert_eq!(found.mean_ranks, [1.0, 3.0, 2.0]);
        let test = found.test.unwrap();
        // The largest χ² is n (k - 1), with the tail exp(-χ² / 2) at 2 degrees of freedom.
        assert_eq!((test.chi_squared, test.dof, test.kendalls_w), (6.0, 2, 1.0));
        assert!((test.p_value - (-3.0_f64).exp()).abs() < 1e-12, "{test:?}");
        // Three positive differences of three have 2 of 8 combinations of signs; three pairs.
        for pair in friedman_pairs(&SubjectTable::complete(&rows)) {
            assert!((pair.adjusted_p_value - 0.75).abs() < 1e-12, "{pair:?}");
        }
    }

    #[test]
    fn equal_answers_have_no_test() {
        let rows = [vec![4.0; 3], vec![2.0; 3]];
        assert_eq!(friedman(&SubjectTable::complete(&rows)).test, None);
        for pair in friedman_pairs(&SubjectTable::complete(&rows)) {
            assert_eq!((pair.signed_rank, pair.adjusted_p_value), (None, 1.0));
        }
    }

    proptest! {
        /// Under two conditions, χ² is that of the sign test, without the subjects who answer equally.
        #[test]
        fn two_conditions_are_a_sign_test(pairs in prop::collection::vec(prop::array::uniform2(0..5_i32), 2..20)) {
            let rows: Vec<Vec<f64>> = pairs.iter().map(|pair| pair.map(f64::from).to_vec()).collect();
            let count = |sign: i32| pairs.iter().filter(|[a, b]| (a - b).signum() == sign).count() as f64;
            let (plus, minus) = (count(1), count(-1));
            let test = friedman(&SubjectTable::complete(&rows)).test;
            if plus + minus == 0.0 {
                prop_assert!(test.is_none());
            } else {
                let sign_test = (plus - minus).powi(2) / (plus + minus);
                prop_assert!((test.unwrap().chi_squared - sign_test).abs() < 1e-12, "{test:?} {sign_test}");
            }
        }

        /// Only the order of a subject's answers counts, and the order of the conditions does not.
        #[test]
        fn monotone_scales_change_nothing(
            rows in prop::collection::vec(prop::collection::vec(0..6_i32, 4), 2..12),
        ) {
            let plain: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().copied().map(f64::from).collect()).collect();
            let bent: Vec<Vec<f64>> = plain
                .iter()
                .enumerate()
                .map(|(i, row)| row.iter().rev().map(|x| (0.3 * x).exp() + i as f64).collect())
                .collect();
            let (a, b) = (friedman(&SubjectTable::complete(&plain)), friedman(&SubjectTable::complete(&bent)));
            prop_assert!(a.test == b.test, "{a:?} {b:?}");
            prop_assert!(a.mean_ranks.iter().rev().eq(b.mean_ranks.iter()));
        }
    }
}
