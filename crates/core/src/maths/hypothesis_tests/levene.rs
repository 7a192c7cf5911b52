//! Levene's test and the test of Brown and Forsythe: whether groups have different variances.

use crate::maths::hypothesis_tests::f_test::FTest;
use crate::maths::hypothesis_tests::groups::Groups;
use crate::maths::hypothesis_tests::one_way::squares_of;
use crate::maths::hypothesis_tests::rounding::{from_first, rounding_error, rounding_of_squares};
use crate::maths::statistics::{mean, quantile};

/// Center of a group, from which deviations are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Center {
    /// Mean (Levene 1960): for symmetric distributions with short tails.
    Mean,
    /// Median (Brown and Forsythe 1974): for skewed distributions; the default of scipy.
    Median,
}

/// Fewest values of a group whose deviations from their center can differ.
const LEAST_VALUES: usize = 3;

/// F test of the absolute deviations from the center of each group; its `f` is Levene's W.
///
/// `None` if every group has equal values or fewer than three: the two deviations in a pair are equal whatever its
/// variance is. W is infinite if the deviations are equal within every group, but not between groups.
pub fn levene(groups: &Groups, center: Center) -> Option<FTest> {
    let rounding = rounding_error(groups.values().iter().flatten().copied());
    let has_variance = |values: &Vec<f64>| {
        let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
        values.len() >= LEAST_VALUES && highest - lowest > rounding
    };
    if !groups.values().iter().any(has_variance) {
        return None;
    }
    let (_, shifted) = from_first(groups.values());
    let deviations: Vec<Vec<f64>> = shifted.iter().map(|values| deviations(values, center)).collect();
    FTest::of(squares_of(&deviations), groups.dof(), rounding_of_squares(groups.values()))
}

fn deviations(values: &[f64], center: Center) -> Vec<f64> {
    let center = match center {
        Center::Mean => mean(values),
        // A group has at least one value.
        Center::Median => quantile(values, 0.5).unwrap_or(0.0),
    };
    values.iter().map(|value| (value - center).abs()).collect()
}

#[cfg(test)]
mod tests {
    use super::{Center, levene};
    use crate::maths::hypothesis_tests::groups::Groups;
    use proptest::prelude::{prop, prop_assert, proptest};

    fn w(groups: &[&[f64]], center: Center) -> Option<f64> {
        let groups = Groups::new(groups.iter().map(|group| group.to_vec()).collect()).unwrap();
        levene(&groups, center).map(|test| test.f)
    }

    #[test]
    fn a_pair_of_values_shows_no_variance() {
        for center in [Center::Mean, Center::Median] {
            assert_eq!(w(&[&[1.0, 2.0], &[3.0, 9.0], &[4.0]], center), None);
            assert_eq!(w(&[&[1.0, 2.0], &[0.1 + 0.2, 0.3, 0.3]], center), None);
            assert_eq!(w(&[&[7.0; 3], &[7.0; 4]], center), None);
            // All deviations are 1 in one group and 3 in the other.
            assert_eq!(w(&[&[1.0, 3.0, 1.0, 3.0], &[0.0, 6.0, 0.0, 6.0]], center), Some(f64::INFINITY));
            assert_eq!(w(&[&[1.0, 3.0, 1.0, 3.0], &[4.0, 6.0, 4.0, 6.0]], center), None);
        }
    }

    #[test]
    fn the_deviations_of_small_groups_have_the_closed_form() {
        // Deviations from the median 2, 1, 0, 1, 2 and twice that: means 1.2 and 2.4; sums of squares 3.6 and 2.8,
        // 11.2.
        let w = w(&[&[1.0, 2.0, 3.0, 4.0, 5.0], &[0.0, 2.0, 4.0, 6.0, 8.0]], Center::Median).unwrap();
        assert!((w - 3.6 / (14.0 / 8.0)).abs() < 1e-12, "{w}");
    }

    proptest! {
        /// A shift of any group and a common factor leave W as it is.
        #[test]
        fn w_does_not_depend_on_means_or_unit(
            a in prop::collection::vec(-1.0..1.0_f64, 3..9),
            b in prop::collection::vec(-1.0..1.0_f64, 3..9),
            shift in -100.0..100.0_f64,
            factor in 0.01..100.0_f64,
        ) {
            for center in [Center::Mean, Center::Median] {
                let plain = w(&[&a, &b], center).unwrap();
                let scaled_a: Vec<f64> = a.iter().map(|value| factor * value).collect();
                let shifted_b: Vec<f64> = b.iter().map(|value| factor * (value + shift)).collect();
                let changed = w(&[&scaled_a, &shifted_b], center).unwrap();
                // Values up to a hundred times their spread lose two of sixteen digits.
                prop_assert!((plain - changed).abs() < 1e-8 * (1.0 + plain), "{plain} {changed}");
            }
        }
    }
}
