//! Student's t tests of one sample, of pairs and of two groups, with confidence intervals and effect sizes.

use crate::maths::hypothesis_tests::intervals::{Confidence, Interval};
use crate::maths::hypothesis_tests::rounding::{deviation_beyond_rounding, rounding_error};
use crate::maths::hypothesis_tests::subject_table::SubjectTable;
use crate::maths::statistics::{f_upper_tail, mean, t_quantile_two_sided};

/// Result of a t test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TTest {
    /// Mean difference, in the unit of the values: mean minus expected mean, or first minus second.
    pub difference: f64,
    /// Standard error of the difference, 0 or more.
    pub standard_error: f64,
    /// Degrees of freedom, 1 or more; not whole for Welch's test.
    pub dof: f64,
    /// Confidence interval of the difference.
    pub interval: Interval,
    /// t with its probability; `None` if both the difference and its standard error are zero within rounding.
    pub ratio: Option<TRatio>,
    /// Size of the difference in standard deviations; `None` if these are zero within rounding.
    pub effect: Option<EffectSize>,
}

/// Ratio of a difference to its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TRatio {
    /// Student's t; infinite if the standard error is zero within rounding.
    pub t: f64,
    /// Probability of a t at least this large in magnitude, if the true difference is zero.
    pub p_value: f64,
}

/// Standardized difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectSize {
    /// Difference over standard deviation: Cohen's d, for pairs `d_z`.
    pub d: f64,
    /// Hedges' g: d times `1 - 3 / (4 ν - 1)` for `ν` degrees of freedom of the standard deviation, which removes most
    /// of the bias of d in small samples.
    pub hedges_g: f64,
}

/// Result of a t test of pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairedTTest {
    /// Test of the differences. The standard deviation of its effect size is that of the differences (`d_z`).
    pub test: TTest,
    /// Difference over the root mean square of the standard deviations under both conditions (Cohen's `d_av`), which
    /// can be compared with d of independent groups; `None` if these are zero within rounding.
    pub cohens_d: Option<f64>,
    /// Number of subjects who were left out because of a missing cell.
    pub n_left_out: usize,
}

/// Reasons why a t test is undefined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TTestError {
    /// A sample has fewer than two values.
    #[error("sample {sample} has {n} values, but a t test needs at least 2; add values")]
    TooFew {
        /// Index of the sample.
        sample: usize,
        /// Number of its values.
        n: usize,
    },
    /// A value is not finite.
    #[error("value {index} of sample {sample} is not a finite number; leave it out")]
    NotFinite {
        /// Index of the sample.
        sample: usize,
        /// Index of the value.
        index: usize,
    },
    /// The expected mean is not finite.
    #[error("the expected mean is not a finite number; state the mean to compare with")]
    Expected,
}

/// Tests whether values have the mean `expected`.
///
/// # Errors
/// See [`TTestError`].
pub fn one_sample_t(values: &[f64], expected: f64, confidence: Confidence) -> Result<TTest, TTestError> {
    check(0, values)?;
    if !expected.is_finite() {
        return Err(TTestError::Expected);
    }
    let magnitudes = || values.iter().copied().chain([expected]);
    // Differences from the expected mean cost no digits of values near it.
    let differences: Vec<f64> = values.iter().map(|value| value - expected).collect();
    let deviation = deviation_beyond_rounding(&differences, magnitudes());
    Ok(test_of_differences(&differences, deviation, rounding_error(magnitudes()), confidence))
}

/// Tests whether the subjects' mean differs between the conditions `first` and `second` of a table.
///
/// # Panics
/// If a condition is not an index of the table's conditions.
pub fn paired_t(table: &SubjectTable, [first, second]: [usize; 2], confidence: Confidence) -> PairedTTest {
    let conditions = [first, second].map(|condition| table.condition(condition));
    let magnitudes = || conditions.iter().flatten().copied();
    let differences = table.differences(first, second);
    let deviation = deviation_beyond_rounding(&differences, magnitudes());
    let test = test_of_differences(&differences, deviation, rounding_error(magnitudes()), confidence);
    let squares: f64 =
        conditions.iter().map(|values| deviation_beyond_rounding(values, magnitudes()).powi(2)).sum();
    PairedTTest {
        test,
        cohens_d: (squares > 0.0).then(|| test.difference / (0.5 * squares).sqrt()),
        n_left_out: table.n_left_out(),
    }
}

/// Tests whether the means of two independent groups differ, without the assumption of equal variances (B. L. Welch
/// 1947). Cohen's d uses the pooled standard deviation.
///
/// # Errors
/// See [`TTestError`].
pub fn welch_t(first: &[f64], second: &[f64], confidence: Confidence) -> Result<TTest, TTestError> {
    check(0, first)?;
    check(1, second)?;
    let magnitudes = || first.iter().chain(second).copied();
    let shifted = [first, second].map(|values| values.iter().map(|v| v - first[0]).collect::<Vec<f64>>());
    let difference = beyond(mean(&shifted[0]) - mean(&shifted[1]), rounding_error(magnitudes()));
    let dofs = [first, second].map(|values| (values.len() - 1) as f64);
    let variances = shifted.each_ref().map(|values| deviation_beyond_rounding(values, magnitudes()).powi(2));
    let [a, b] = [0, 1].map(|i| variances[i] / (dofs[i] + 1.0));
    let standard_error = (a + b).sqrt();
    // Without variance, the degrees of freedom of Welch are 0/0. scipy takes 1.
    let dof = if standard_error > 0.0 { (a + b).powi(2) / (a * a / dofs[0] + b * b / dofs[1]) } else { 1.0 };
    let total_dof = dofs[0] + dofs[1];
    let pooled = ((dofs[0] * variances[0] + dofs[1] * variances[1]) / total_dof).sqrt();
    Ok(TTest {
        difference,
        standard_error,
        dof,
        interval: interval(difference, standard_error, dof, confidence),
        ratio: TRatio::of(difference, standard_error, dof),
        effect: EffectSize::of(difference, pooled, total_dof),
    })
}

impl TRatio {
    fn of(difference: f64, standard_error: f64, dof: f64) -> Option<Self> {
        if difference == 0.0 && standard_error == 0.0 {
            return None;
        }
        let t = difference / standard_error;
        Some(Self { t, p_value: f_upper_tail(t * t, 1.0, dof) })
    }
}

impl EffectSize {
    fn of(difference: f64, deviation: f64, dof: f64) -> Option<Self> {
        (deviation > 0.0).then(|| {
            let d = difference / deviation;
            Self { d, hedges_g: d * (1.0 - 3.0 / (4.0 * dof - 1.0)) }
        })
    }
}

/// Test of whether differences, of this standard deviation, have the mean zero.
fn test_of_differences(differences: &[f64], deviation: f64, rounding: f64, confidence: Confidence) -> TTest {
    let n = differences.len() as f64;
    let (difference, standard_error) = (beyond(mean(differences), rounding), deviation / n.sqrt());
    TTest {
        difference,
        standard_error,
        dof: n - 1.0,
        interval: interval(difference, standard_error, n - 1.0, confidence),
        ratio: TRatio::of(difference, standard_error, n - 1.0),
        effect: EffectSize::of(difference, deviation, n - 1.0),
    }
}

fn interval(difference: f64, standard_error: f64, dof: f64, confidence: Confidence) -> Interval {
    Interval::around(difference, t_quantile_two_sided(confidence.outside(), dof) * standard_error)
}

/// A value, or 0 if its magnitude is at most `rounding`.
fn beyond(value: f64, rounding: f64) -> f64 {
    if value.abs() > rounding { value } else { 0.0 }
}

fn check(sample: usize, values: &[f64]) -> Result<(), TTestError> {
    if let Some(index) = values.iter().position(|value| !value.is_finite()) {
        return Err(TTestError::NotFinite { sample, index });
    }
    let n = values.len();
    if n < 2 { Err(TTestError::TooFew { sample, n }) } else { Ok(()) }
}

#[cfg(test)]
mod tests;
