//! Means, correlations, quantiles, and the F, t, χ² and binomial distributions.
//!
//! Tail probabilities use the regularized incomplete beta function (Abramowitz and Stegun 26.5.28, 26.6.2, 26.7.1), and
//! that of χ² the regularized incomplete gamma function (26.4.19).

use statrs::function::beta::{beta_reg, inv_beta_reg};
use statrs::function::gamma::gamma_ur;

/// Ratio of the centered to the raw sum of squares below which a column counts as constant; equal numbers leave this
/// much rounding error.
const CONSTANT_SHARE: f64 = 1e-24;

/// Arithmetic mean; 0 for an empty slice.
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Values minus their mean.
pub fn centered(values: &[f64]) -> Vec<f64> {
    let mean = mean(values);
    values.iter().map(|v| v - mean).collect()
}

/// Sample standard deviation with divisor `n - 1`; 0 for fewer than two values.
pub fn standard_deviation(values: &[f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let centered = centered(values);
    (dot(&centered, &centered) / (values.len() - 1) as f64).sqrt()
}

/// Returns whether all values are equal within rounding error.
pub fn is_constant(values: &[f64]) -> bool {
    let centered = centered(values);
    dot(&centered, &centered) <= CONSTANT_SHARE * dot(values, values)
}

/// Pearson's correlation coefficient, -1 to 1; `None` if either input is constant.
///
/// # Panics
/// If the lengths differ.
pub fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    assert_eq!(a.len(), b.len(), "both columns must have the same length");
    if is_constant(a) || is_constant(b) {
        return None;
    }
    let (a, b) = (centered(a), centered(b));
    Some((dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt()).clamp(-1.0, 1.0))
}

/// Dot product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four partial sums: a single sum would make each addition wait for the previous one.
    let (a_blocks, b_blocks) = (a.chunks_exact(4), b.chunks_exact(4));
    let tail: f64 = a_blocks.remainder().iter().zip(b_blocks.remainder()).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 4];
    for (x, y) in a_blocks.zip(b_blocks) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + tail
}

/// Probability that an F-distributed variable with `numerator` and `denominator` degrees of freedom (above 0) exceeds
/// `f`.
pub fn f_upper_tail(f: f64, numerator: f64, denominator: f64) -> f64 {
    if f <= 0.0 {
        return 1.0;
    }
    if f.is_infinite() {
        return 0.0;
    }
    beta_reg(0.5 * denominator, 0.5 * numerator, denominator / (denominator + numerator * f))
}

/// Value that an F-distributed variable exceeds with `probability` (0 to 1, ends excluded). `numerator` and
/// `denominator` are the degrees of freedom, above 0.
pub fn f_quantile_above(probability: f64, numerator: f64, denominator: f64) -> f64 {
    let x = inv_beta_reg(0.5 * denominator, 0.5 * numerator, probability);
    denominator * (1.0 - x) / (numerator * x)
}

/// Critical value that the magnitude of Student's t exceeds with `probability` (0 to 1, ends excluded). `dof` is the
/// degrees of freedom, above 0.
pub fn t_quantile_two_sided(probability: f64, dof: f64) -> f64 {
    f_quantile_above(probability, 1.0, dof).sqrt()
}

/// Probability that a χ²-distributed variable with `dof` degrees of freedom (above 0) exceeds `chi_squared`.
pub fn chi_squared_upper_tail(chi_squared: f64, dof: f64) -> f64 {
    if chi_squared <= 0.0 {
        return 1.0;
    }
    if chi_squared.is_infinite() {
        return 0.0;
    }
    gamma_ur(0.5 * dof, 0.5 * chi_squared)
}

/// Probability of at least `n_right` correct answers in `n_trials`, if each is correct with probability `chance` (0..1,
/// ends excluded). This is the upper tail of the binomial distribution (Abramowitz and Stegun 26.5.24); it is 1 if
/// `n_right` is 0.
pub fn binomial_upper_tail(n_right: u64, n_trials: u64, chance: f64) -> f64 {
    if n_right == 0 {
        return 1.0;
    }
    if n_right > n_trials {
        return 0.0;
    }
    beta_reg(n_right as f64, (n_trials - n_right + 1) as f64, chance)
}

/// Quantile at `rank` (0 to 1), interpolated linearly between order statistics; `None` for an empty slice.
pub fn quantile(values: &[f64], rank: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = rank.clamp(0.0, 1.0) * sorted.len().checked_sub(1)? as f64;
    let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
    Some(low + at.fract() * (high - low))
}

#[cfg(test)]
mod tests {
    use super::{
        binomial_upper_tail, chi_squared_upper_tail, correlation, dot, f_quantile_above, f_upper_tail,
        is_constant, quantile, t_quantile_two_sided,
    };

    /// Compares with the sum of the binomial terms, computed by their recurrence.
    #[test]
    fn the_binomial_tail_is_the_sum_of_its_terms() {
        for (n, chance) in [(1_u64, 0.5_f64), (7, 0.5), (20, 0.25), (60, 0.9)] {
            let mut term = (1.0 - chance).powf(n as f64);
            let mut terms = vec![term];
            for k in 1..=n {
                term *= (n - k + 1) as f64 / k as f64 * chance / (1.0 - chance);
                terms.push(term);
            }
            for k in 0..=n {
                let sum: f64 = terms[k as usize..].iter().sum();
                assert!((binomial_upper_tail(k, n, chance) - sum).abs() < 1e-12, "at least {k} of {n}");
            }
            assert_eq!(binomial_upper_tail(n + 1, n, chance), 0.0);
        }
    }

    #[test]
    fn tails_have_their_closed_forms() {
        // With 2 numerator degrees of freedom, P(F > f) = (1 + 2 f / d)^(-d/2). F(1, 2) is the square of t with 2
        // degrees of freedom.
        for (f, d) in [(0.3_f64, 5.0_f64), (1.0, 22.0), (4.0, 7.0), (30.0, 12.0)] {
            let closed = (1.0 + 2.0 * f / d).powf(-0.5 * d);
            assert!((f_upper_tail(f, 2.0, d) / closed - 1.0).abs() < 1e-12, "{f} {d}");
            let t = f.sqrt();
            let closed = 1.0 - t / (2.0 + t * t).sqrt();
            assert!((f_upper_tail(f, 1.0, 2.0) - closed).abs() < 1e-12, "{f}");
        }
        assert_eq!((f_upper_tail(0.0, 1.0, 3.0), f_upper_tail(f64::INFINITY, 1.0, 3.0)), (1.0, 0.0));
    }

    #[test]
    fn the_chi_squared_tail_is_its_poisson_sum() {
        // With 2 m degrees of freedom, P(χ² > x) is the probability of fewer than m events at a rate of x / 2.
        for x in [1e-9_f64, 0.3, 4.0, 30.0, 200.0] {
            let mut term = (-0.5 * x).exp();
            let mut sum = 0.0;
            for m in 1..=10 {
                sum += term;
                term *= 0.5 * x / f64::from(m);
                let tail = chi_squared_upper_tail(x, 2.0 * f64::from(m));
                assert!(
                    (tail - sum).abs() < 1e-12,
                    "{x}, {} degrees of freedom: {tail}, expected {sum}",
                    2 * m
                );
            }
        }
        // With 1 degree of freedom, x is the square of a normal variable; the limit of F.
        assert!((chi_squared_upper_tail(3.841_458_820_694_124, 1.0) - 0.05).abs() < 1e-12);
        assert_eq!(
            (chi_squared_upper_tail(0.0, 3.0), chi_squared_upper_tail(f64::INFINITY, 3.0)),
            (1.0, 0.0)
        );
    }

    #[test]
    fn quantiles_undo_tails_and_match_printed_tables() {
        for (p, a, b) in [(0.05, 1.0, 23.0), (0.01, 3.0, 9.0), (0.025, 24.0, 7.3), (0.975, 4.0, 4.0)] {
            let back = f_upper_tail(f_quantile_above(p, a, b), a, b);
            assert!((back - p).abs() < 1e-9, "got {back}, expected {p}");
        }
        // Textbook tables, three decimals.
        for (dof, table) in [(1.0, 12.706), (4.0, 2.776), (9.0, 2.262), (24.0, 2.064), (120.0, 1.980)] {
            let t = t_quantile_two_sided(0.05, dof);
            assert!((t - table).abs() < 6e-4, "{dof} degrees of freedom: got {t}, expected {table}");
        }
    }

    #[test]
    fn correlations_of_lines_and_constants() {
        assert_eq!(correlation(&[1.0, 2.0, 4.0], &[3.0, 5.0, 9.0]), Some(1.0));
        assert!((correlation(&[1.0, 2.0, 3.0, 4.0], &[1.0, -1.0, -1.0, 1.0]).unwrap()).abs() < 1e-15);
        assert_eq!(correlation(&[0.1; 7], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]), None);
        assert!(is_constant(&[1e9 + 0.1; 25]) && !is_constant(&[1.0, 1.0 + 1e-9]) && is_constant(&[0.0; 3]));
    }

    #[test]
    fn sums_and_quantiles_of_any_length() {
        for n in 0..11_u8 {
            let values: Vec<f64> = (0..n).map(f64::from).collect();
            let n = f64::from(n);
            assert_eq!(dot(&values, &values), (n - 1.0) * n * (2.0 * n - 1.0) / 6.0);
        }
        assert_eq!(quantile(&[3.0, 1.0, 2.0], 0.75), Some(2.5));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
