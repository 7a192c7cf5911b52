//! Analysis of variance of one factor with repeated measures: whether the same subjects answer differently under
//! different conditions.

use crate::maths::hypothesis_tests::f_test::FTest;
use crate::maths::hypothesis_tests::rounding::{from_first, rounding_of_squares};
use crate::maths::hypothesis_tests::subject_table::SubjectTable;
use crate::maths::statistics::{dot, f_upper_tail, mean};

/// Result of an analysis of variance with repeated measures.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatedMeasures {
    /// Mean under each condition, over the complete subjects.
    pub condition_means: Vec<f64>,
    /// Number of complete subjects.
    pub n_subjects: usize,
    /// Number of subjects who were left out because of a missing cell.
    pub n_left_out: usize,
    /// Sum of squares between conditions.
    pub squares_conditions: f64,
    /// Sum of squares between subjects.
    pub squares_subjects: f64,
    /// Sum of squares of the error: the interaction of subjects and conditions.
    pub squares_error: f64,
    /// Degrees of freedom of the conditions and of the error.
    pub dof: [usize; 2],
    /// F test with corrections and effect sizes; `None` if the conditions and the error have no variance, as if every
    /// subject gives one answer.
    pub test: Option<RepeatedMeasuresTest>,
}

/// F test of the conditions with its corrections and effect sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepeatedMeasuresTest {
    /// F test without a correction, which assumes sphericity: all differences of two conditions have the same variance.
    pub f_test: FTest,
    /// Correction of Greenhouse and Geisser (1959); `None` if the error is zero.
    pub greenhouse_geisser: Option<SphericityCorrection>,
    /// Correction of Huynh and Feldt (1976), less conservative; `None` if the error is zero, or for two subjects under
    /// three or more conditions.
    pub huynh_feldt: Option<SphericityCorrection>,
    /// Sum of squares of the conditions over that of conditions and error, 0 to 1.
    pub partial_eta_squared: f64,
    /// Sum of squares of the conditions over that of conditions, error and subjects, 0 to 1 (Olejnik and Algina 2003):
    /// it can be compared with η² of a study with other people under each condition.
    pub generalized_eta_squared: f64,
}

/// Correction of an F test for conditions whose differences have unequal variances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericityCorrection {
    /// Factor of both degrees of freedom, `1 / (k - 1)` to 1 for `k` conditions; 1 under sphericity.
    pub epsilon: f64,
    /// Probability of an F statistic at least this large, with the corrected degrees of freedom.
    pub p_value: f64,
}

impl SphericityCorrection {
    fn of(test: FTest, epsilon: f64) -> Self {
        let [conditions, error] = test.dof.map(|dof| epsilon * dof as f64);
        Self { epsilon, p_value: f_upper_tail(test.f, conditions, error) }
    }
}

/// Analysis of variance of subjects under conditions, which assumes normal residuals.
pub fn repeated_measures(table: &SubjectTable) -> RepeatedMeasures {
    let (n, k) = (table.n_subjects(), table.n_conditions());
    let (first, rows) = from_first(table.rows());
    let subject_means: Vec<f64> = rows.iter().map(|row| mean(row)).collect();
    let condition_means: Vec<f64> =
        (0..k).map(|condition| rows.iter().map(|row| row[condition]).sum::<f64>() / n as f64).collect();
    let grand_mean = mean(&subject_means);
    let residuals: Vec<Vec<f64>> = rows
        .iter()
        .zip(&subject_means)
        .map(|(row, subject)| {
            row.iter()
                .zip(&condition_means)
                .map(|(x, condition)| x - subject - condition + grand_mean)
                .collect()
        })
        .collect();
    let off = |means: &[f64]| means.iter().map(|mean| (mean - grand_mean).powi(2)).sum::<f64>();
    let squares_conditions = n as f64 * off(&condition_means);
    let squares_subjects = k as f64 * off(&subject_means);
    let squares_error: f64 = residuals.iter().map(|row| dot(row, row)).sum();
    let dof = [k - 1, (n - 1) * (k - 1)];
    let with_effects = |f_test: FTest| {
        let epsilon = f_test.f.is_finite().then(|| greenhouse_geisser_epsilon(&residuals));
        let huynh_feldt = epsilon.and_then(|epsilon| huynh_feldt_epsilon(epsilon, n, k));
        RepeatedMeasuresTest {
            f_test,
            greenhouse_geisser: epsilon.map(|epsilon| SphericityCorrection::of(f_test, epsilon)),
            huynh_feldt: huynh_feldt.map(|epsilon| SphericityCorrection::of(f_test, epsilon)),
            partial_eta_squared: squares_conditions / (squares_conditions + squares_error),
            generalized_eta_squared: squares_conditions
                / (squares_conditions + squares_error + squares_subjects),
        }
    };
    let rounding = rounding_of_squares(table.rows());
    RepeatedMeasures {
        condition_means: condition_means.iter().map(|mean| first + mean).collect(),
        n_subjects: n,
        n_left_out: table.n_left_out(),
        squares_conditions,
        squares_subjects,
        squares_error,
        dof,
        test: FTest::of([squares_conditions, squares_error], dof, rounding).map(with_effects),
    }
}

/// `ε = tr(S)² / ((k - 1) tr(S²))` of the covariance matrix S of the residuals, which is that of the conditions,
/// centered in rows and columns. Its scale cancels.
fn greenhouse_geisser_epsilon(residuals: &[Vec<f64>]) -> f64 {
    let k = residuals[0].len();
    let product = |a: usize, b: usize| residuals.iter().map(|row| row[a] * row[b]).sum::<f64>();
    let trace: f64 = (0..k).map(|a| product(a, a)).sum();
    let squared: f64 =
        (0..k).flat_map(|a| (0..k).map(move |b| (a, b))).map(|(a, b)| product(a, b).powi(2)).sum();
    let dof = (k - 1) as f64;
    // Rounding may move it slightly out of its range.
    (trace * trace / (dof * squared)).clamp(1.0 / dof, 1.0)
}

/// `ε = (n d g - 2) / (d (n - 1 - d g))`, at most 1, for `n` subjects, `d = k - 1` and the epsilon `g` of Greenhouse
/// and Geisser. For two subjects under three or more conditions, it is 0/0.
fn huynh_feldt_epsilon(greenhouse_geisser: f64, n: usize, k: usize) -> Option<f64> {
    if k == 2 {
        return Some(1.0);
    }
    if n == 2 {
        return None;
    }
    let (n, dof) = (n as f64, (k - 1) as f64);
    let numerator = n * dof * greenhouse_geisser - 2.0;
    let denominator = dof * (n - 1.0 - dof * greenhouse_geisser);
    // The denominator can be zero or, by rounding, negative. The numerator is above zero.
    Some(if denominator <= numerator { 1.0 } else { numerator / denominator })
}

#[cfg(test)]
mod tests;
