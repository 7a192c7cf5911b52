//! Studentized range: the distribution of the range of normal means over their estimated standard error.
//!
//! The range of `k` standard normal variables is at most `w` with the probability
//! `H(w) = k ∫ φ(z) (Φ(z) - Φ(z - w))^(k - 1) dz`. The studentized range exceeds `q` with the probability
//! `∫ f(s) (1 - H(q s)) ds`, where `f` is the density of `√(χ²/ν)` with `ν` degrees of freedom (M. D. Copenhaver and
//! B. Holland, "Computation of the distribution of the maximum studentized range statistic", 1988).
//!
//! Both integrands are analytic and vanish at both ends, the outer one over the logarithm of `s`. The trapezoidal rule
//! then converges faster than any power of its step. Half the steps change no probability by more than 1e-14, for 2 to
//! 100 means and 1 to 1000 degrees of freedom; scipy agrees within 1e-9.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use statrs::function::erf::erfc;

/// Step of the normal variable, for one mean; it decreases with the root of the number of means.
const STEP: f64 = 0.7;
/// Normal deviates beyond this limit have a density below 1e-16.
const LARGEST_DEVIATE: f64 = 8.6;
/// Largest step of the logarithm of the standard error.
const LOG_STEP: f64 = 0.05;
/// Step of the logarithm of the standard error in units of its standard deviation, times the root of 2.
const LOG_STEP_SHARE: f64 = 0.45;
/// Weight relative to the largest one below which a term is left out.
const LEAST_WEIGHT: f64 = 1e-18;
/// Range that up to a million normal variables exceed with a probability below 1e-16.
const LARGEST_RANGE: f64 = 40.0;
/// Maximum number of steps of the search for a quantile; it takes ten to twenty.
const MAX_STEPS: usize = 100;
/// Relative precision of a quantile.
const QUANTILE_PRECISION: f64 = 1e-12;

/// Probability that the studentized range of `n_means` means exceeds `q`, 0 or more.
///
/// `dof` is the degrees of freedom of the standard error, above 0, and may be infinite. The cost is up to 20,000
/// √`n_means` error functions.
///
/// # Panics
/// If there are fewer than two means.
pub fn studentized_range_upper_tail(q: f64, n_means: usize, dof: f64) -> f64 {
    NormalRange::new(n_means).studentized_upper_tail(q, dof)
}

/// Value that the studentized range of `n_means` means exceeds with `probability` (0 to 1, ends excluded). `dof` is the
/// degrees of freedom of the standard error, above 0, and may be infinite. It costs ten to twenty probabilities.
///
/// # Panics
/// If there are fewer than two means.
pub fn studentized_range_quantile_above(probability: f64, n_means: usize, dof: f64) -> f64 {
    let range = NormalRange::new(n_means);
    let excess = |q: f64| range.studentized_upper_tail(q, dof) - probability;
    let (mut low, mut excess_low) = (0.0, 1.0 - probability);
    let (mut high, mut excess_high) = (1.0, excess(1.0));
    while excess_high > 0.0 {
        (low, excess_low) = (high, excess_high);
        high *= 2.0;
        excess_high = excess(high);
    }
    // Regula falsi of the Illinois type: if the same end stays, its value is halved.
    let (mut last, mut was_low) = (high, None);
    for _ in 0..MAX_STEPS {
        let q = (low * excess_high - high * excess_low) / (excess_high - excess_low);
        let at = excess(q);
        if at == 0.0 || (q - last).abs() <= QUANTILE_PRECISION * q {
            return q;
        }
        if at > 0.0 {
            (low, excess_low) = (q, at);
            if was_low == Some(true) {
                excess_high *= 0.5;
            }
        } else {
            (high, excess_high) = (q, at);
            if was_low == Some(false) {
                excess_low *= 0.5;
            }
        }
        (last, was_low) = (q, Some(at > 0.0));
    }
    last
}

/// Range of independent standard normal variables, with the nodes of its integral.
struct NormalRange {
    n: f64,
    nodes: Vec<Node>,
}

/// Node of the integral over the largest variable.
struct Node {
    z: f64,
    /// Density times step.
    weight: f64,
    /// Probability of a variable below `z`.
    below: f64,
}

impl NormalRange {
    fn new(n: usize) -> Self {
        assert!(n >= 2, "a range needs at least two means, got {n}");
        let step = STEP / (n as f64).sqrt();
        let n_steps = (LARGEST_DEVIATE / step).ceil();
        let node = |i: usize| {
            let z = (i as f64 - n_steps) * step;
            Node { z, weight: step * (-0.5 * z * z).exp() / (2.0 * PI).sqrt(), below: normal_below(z) }
        };
        Self { n: n as f64, nodes: (0..=2 * n_steps as usize).map(node).collect() }
    }

    /// Probability of a range of at most `w`, 0 or more.
    fn at_most(&self, w: f64) -> f64 {
        let term =
            |node: &Node| node.weight * (node.below - normal_below(node.z - w)).max(0.0).powf(self.n - 1.0);
        self.n * self.nodes.iter().map(term).sum::<f64>()
    }

    /// Probability that the range over an independent standard error exceeds `q`.
    fn studentized_upper_tail(&self, q: f64, dof: f64) -> f64 {
        if q <= 0.0 {
            return 1.0;
        }
        if dof.is_infinite() {
            return (1.0 - self.at_most(q.min(LARGEST_RANGE))).clamp(0.0, 1.0);
        }
        let step = LOG_STEP.min(LOG_STEP_SHARE / dof.sqrt());
        // Density of the logarithm t of the standard error, relative to its largest value at 0.
        let weight = |t: f64| (dof * (t - 0.5 * (2.0 * t).exp_m1())).exp();
        let (mut total, mut above) = (0.0, 0.0);
        let mut add = |t: f64| {
            let (weight, w) = (weight(t), q * t.exp());
            total += weight;
            // (Φ(z) - Φ(z - w)) is at most w / √(2π).
            let at_most = self.n * (0.4 * w).powf(self.n - 1.0);
            above += if weight * at_most.min(1.0) < LEAST_WEIGHT {
                weight
            } else if w < LARGEST_RANGE {
                weight * (1.0 - self.at_most(w))
            } else {
                0.0
            };
            weight >= LEAST_WEIGHT
        };
        for direction in [-1.0, 1.0] {
            // The term at 0 belongs to the first direction.
            let mut t = if direction < 0.0 { 0.0 } else { step };
            while add(t) {
                t += direction * step;
            }
        }
        (above / total).clamp(0.0, 1.0)
    }
}

/// Probability that a standard normal variable is below `z`.
fn normal_below(z: f64) -> f64 {
    0.5 * erfc(-z * FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::{studentized_range_quantile_above, studentized_range_upper_tail};
    use crate::maths::statistics::{f_upper_tail, t_quantile_two_sided};
    use std::f64::consts::PI;

    /// Two means: the studentized range is √2 times the magnitude of Student's t.
    #[test]
    fn two_means_have_the_t_distribution() {
        for dof in [1.0, 2.0, 5.0, 24.0, 120.0, 5000.0] {
            for q in [0.1, 1.0, 2.8, 5.0, 12.0] {
                let tail = studentized_range_upper_tail(q, 2, dof);
                assert!((tail - f_upper_tail(0.5 * q * q, 1.0, dof)).abs() < 1e-10, "{q} {dof}: {tail}");
            }
            for probability in [0.1, 0.05, 0.001] {
                let q = studentized_range_quantile_above(probability, 2, dof);
                let t = t_quantile_two_sided(probability, dof);
                assert!((q / (2.0_f64.sqrt() * t) - 1.0).abs() < 1e-8, "{probability} {dof}: {q}");
            }
        }
    }

    /// The mean range of 2, 3 and 4 normal variables is 2 / √π, 3 / √π and 12 atan(√2) / π^(3/2).
    #[test]
    fn normal_ranges_have_their_means() {
        let of_four = 12.0 * 2.0_f64.sqrt().atan() / PI.powf(1.5);
        let means = [(2, 2.0 / PI.sqrt()), (3, 3.0 / PI.sqrt()), (4, of_four)];
        for (n, mean) in means {
            // The mean is the integral of the tail; its derivative is 0 at both ends for three or more.
            let step = 0.01;
            let tail = |i: i32| studentized_range_upper_tail(step * f64::from(i), n, f64::INFINITY);
            let sum = step * (0.5 + (1..2000).map(tail).sum::<f64>());
            // The trapezoidal rule for two variables is off by step² φ(0) √2 / 12, which is 5e-6.
            assert!((sum - mean).abs() < 1e-5, "{n} variables: {sum}, expected {mean}");
        }
    }

    /// A printed table of critical values (Harter 1960), three digits.
    #[test]
    fn critical_values_are_those_of_the_table() {
        for (probability, n, dof, table) in [
            (0.05, 3, 10.0, 3.88),
            (0.05, 5, 20.0, 4.23),
            (0.01, 4, 20.0, 5.02),
            (0.05, 10, 60.0, 4.65),
            (0.05, 3, f64::INFINITY, 3.31),
        ] {
            let q = studentized_range_quantile_above(probability, n, dof);
            assert!((q - table).abs() < 0.0051, "{n} means, {dof}: {q}, expected {table}");
            let back = studentized_range_upper_tail(q, n, dof);
            assert!((back - probability).abs() < 1e-10, "{back}");
        }
    }

    #[test]
    fn tails_fall_with_the_range_and_rise_with_the_number_of_means() {
        for dof in [1.0, 3.0, 30.0, f64::INFINITY] {
            for n in [2, 3, 8, 20] {
                let tail = |q: f64, n: usize| studentized_range_upper_tail(q, n, dof);
                assert!(tail(2.0, n) > tail(3.0, n) && tail(3.0, n + 1) > tail(3.0, n), "{dof} {n}");
                assert!(tail(0.0, n) == 1.0 && tail(1e-9, n) > 1.0 - 1e-8, "{dof} {n}");
                assert!(tail(1e9, n) < 1e-8, "{dof} {n}");
            }
        }
    }
}
