//! One-way analysis of variance: whether the means of independent groups differ.

use crate::maths::hypothesis_tests::f_test::FTest;
use crate::maths::hypothesis_tests::groups::Groups;
use crate::maths::hypothesis_tests::rounding::{from_first, rounding_of_squares};
use crate::maths::statistics::{centered, dot, mean};

/// Result of a one-way analysis of variance.
#[derive(Clone, Debug, PartialEq)]
pub struct OneWay {
    /// Mean of each group.
    pub means: Vec<f64>,
    /// Number of values of each group.
    pub sizes: Vec<usize>,
    /// Sum of squares between groups: squared distances of the group means from the mean of all values, times the
    /// sizes.
    pub squares_between: f64,
    /// Sum of squares within groups: squared distances of the values from their group mean.
    pub squares_within: f64,
    /// Degrees of freedom between and within groups.
    pub dof: [usize; 2],
    /// F test with its effect sizes; `None` if all values are equal.
    pub test: Option<OneWayTest>,
}

/// F test of a one-way analysis of variance with its effect sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneWayTest {
    /// F test. F is infinite if the values are equal within every group, but not between groups.
    pub f_test: FTest,
    /// Share of the total sum of squares that is between groups, η², 0 to 1. It overestimates the share in the
    /// population.
    pub eta_squared: f64,
    /// Less biased estimate of this share, `ω² = (SSb - (k - 1) MSw) / (SSt + MSw)`, at most 1; below 0 if F is below
    /// 1.
    pub omega_squared: f64,
}

/// One-way analysis of variance of groups, which assumes normal values with equal variances.
pub fn one_way(groups: &Groups) -> OneWay {
    let (first, shifted) = from_first(groups.values());
    let dof = groups.dof();
    let [between, within] = squares_of(&shifted);
    let with_effects = |f_test| {
        let (total, mean_square) = (between + within, within / dof[1] as f64);
        OneWayTest {
            f_test,
            eta_squared: between / total,
            omega_squared: (between - dof[0] as f64 * mean_square) / (total + mean_square),
        }
    };
    OneWay {
        means: shifted.iter().map(|values| first + mean(values)).collect(),
        sizes: groups.sizes(),
        squares_between: between,
        squares_within: within,
        dof,
        test: FTest::of([between, within], dof, rounding_of_squares(groups.values())).map(with_effects),
    }
}

/// Sums of squares between and within groups.
pub(super) fn squares_of(groups: &[Vec<f64>]) -> [f64; 2] {
    let grand_mean = mean(&groups.concat());
    let between = |values: &Vec<f64>| values.len() as f64 * (mean(values) - grand_mean).powi(2);
    let within = |values: &Vec<f64>| {
        let centered = centered(values);
        dot(&centered, &centered)
    };
    [groups.iter().map(between).sum(), groups.iter().map(within).sum()]
}

#[cfg(test)]
mod tests {
    use super::one_way;
    use crate::maths::hypothesis_tests::groups::Groups;
    use crate::maths::statistics::{dot, mean, standard_deviation};
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn three_small_groups_have_the_sums_of_the_textbook() {
        // Means 2, 3 and 7 of three values each, 4 overall: 3 (4 + 1 + 9) between, and 2 within each group.
        let groups = vec![vec![1.0, 2.0, 3.0], vec![2.0, 3.0, 4.0], vec![6.0, 7.0, 8.0]];
        let anova = one_way(&Groups::new(groups).unwrap());
        assert_eq!((anova.means, anova.sizes, anova.dof), (vec![2.0, 3.0, 7.0], vec![3; 3], [2, 6]));
        assert!((anova.squares_between - 42.0).abs() < 1e-12 && (anova.squares_within - 6.0).abs() < 1e-12);
        let test = anova.test.unwrap();
        assert!((test.f_test.f - 21.0).abs() < 1e-12 && (test.eta_squared - 0.875).abs() < 1e-12);
        assert!((test.omega_squared - 40.0 / 49.0).abs() < 1e-12, "{test:?}");
        // P(F > 21) with 2 and 6 degrees of freedom: (1 + 42 / 6)^-3.
        assert!((test.f_test.p_value - 1.0 / 512.0).abs() < 1e-12);
    }

    fn groups_of(values: &[Vec<f64>]) -> Groups {
        Groups::new(values.to_vec()).unwrap()
    }

    proptest! {
        /// For two groups, F is the square of Student's t with the pooled variance.
        #[test]
        fn f_of_two_groups_is_t_squared(
            a in prop::collection::vec(-50.0..50.0_f64, 2..15),
            b in prop::collection::vec(-50.0..50.0_f64, 2..15),
        ) {
            let test = one_way(&groups_of(&[a.clone(), b.clone()])).test.unwrap().f_test;
            let dof = [a.len() as f64 - 1.0, b.len() as f64 - 1.0];
            let variances = [&a, &b].map(|values| standard_deviation(values).powi(2));
            let pooled = dot(&dof, &variances) / (dof[0] + dof[1]);
            let error = pooled * (1.0 / a.len() as f64 + 1.0 / b.len() as f64);
            let t = (mean(&a) - mean(&b)) / error.sqrt();
            prop_assert!((test.f - t * t).abs() < 1e-9 * (1.0 + test.f), "{test:?} {t}");
        }

        /// Neither a shift nor a factor nor the order of the groups changes the test. The tolerance is the precision of
        /// values that are a thousand times their spread.
        #[test]
        fn the_test_does_not_depend_on_unit_offset_or_order(
            values in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 3..8), 2..6),
            shift in -1000.0..1000.0_f64,
            factor in 0.01..100.0_f64,
        ) {
            let test = one_way(&groups_of(&values)).test.unwrap();
            let mut other: Vec<Vec<f64>> = values
                .iter()
                .map(|group| group.iter().rev().map(|value| factor * (value + shift)).collect())
                .collect();
            other.reverse();
            let changed = one_way(&groups_of(&other)).test.unwrap();
            prop_assert!((test.f_test.f - changed.f_test.f).abs() < 1e-8 * (1.0 + test.f_test.f));
            prop_assert!((test.omega_squared - changed.omega_squared).abs() < 1e-8);
        }
    }
}
