//! F test of two mean squares.

use crate::maths::statistics::f_upper_tail;

/// F statistic with its degrees of freedom and its probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FTest {
    /// Ratio of the mean square of the effect to that of the error, 0 or more; infinite if the error is zero within
    /// rounding.
    pub f: f64,
    /// Degrees of freedom of the effect and of the error.
    pub dof: [usize; 2],
    /// Probability of an F statistic at least this large under the null hypothesis.
    pub p_value: f64,
}

impl FTest {
    /// Test of the sums of squares of an effect and of its error; `None` if both are at most `rounding`, so that F is
    /// 0/0.
    pub(super) fn of(squares: [f64; 2], dof: [usize; 2], rounding: f64) -> Option<Self> {
        let [effect, error] = squares;
        let f = match (effect > rounding, error > rounding) {
            (false, false) => return None,
            (true, false) => f64::INFINITY,
            (_, true) => (effect / dof[0] as f64) / (error / dof[1] as f64),
        };
        Some(Self { f, dof, p_value: f_upper_tail(f, dof[0] as f64, dof[1] as f64) })
    }
}

#[cfg(test)]
mod tests {
    use super::FTest;

    #[test]
    fn an_error_of_zero_gives_an_infinite_or_no_ratio() {
        let of = |effect, error| FTest::of([effect, error], [2, 6], 1e-20).map(|test| (test.f, test.p_value));
        assert_eq!(of(0.0, 1e-21), None);
        assert_eq!(of(1.0, 1e-21), Some((f64::INFINITY, 0.0)));
        assert_eq!(of(0.0, 3.0), Some((0.0, 1.0)));
        // With 2 degrees of freedom of the effect, P(F > f) = (1 + 2 f / d)^(-d / 2).
        let (f, p) = of(2.0, 3.0).unwrap();
        assert!((f - 2.0).abs() < 1e-12 && (p - (5.0_f64 / 3.0).powi(-3)).abs() < 1e-12, "{f} {p}");
    }
}
