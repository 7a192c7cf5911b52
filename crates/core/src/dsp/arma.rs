//! Autoregressive moving-average (ARMA) processes: power gain and transfer function.
//!
//! `y[t] = -Σ a_i y[t-i] + e[t] + Σ b_j e[t-j]` with white noise `e`. Coefficient slices omit the leading one, as in
//! [`crate::dsp::ar`].

use std::f64::consts::TAU;

use crate::units::Hertz;

/// Variance of the process for unit excitation variance; infinite if the AR part is unstable.
///
/// Computed by the recursion that reduces the order of both polynomials together (K. Åström, E. Jury and R. Agniel, "A
/// numerical method for the evaluation of complex integrals", 1970). It is a sum of squares, so no digits cancel where
/// zeros lie near poles.
pub fn power_gain(ar: &[f64], ma: &[f64]) -> f64 {
    let degree = ar.len().max(ma.len());
    let padded = |rest: &[f64]| -> Vec<f64> {
        let zeros = std::iter::repeat_n(0.0, degree - rest.len());
        std::iter::once(1.0).chain(rest.iter().copied()).chain(zeros).collect()
    };
    let (mut a, mut b) = (padded(ar), padded(ma));
    let mut sum = 0.0;
    loop {
        let lead = a[0];
        if lead <= 0.0 || lead.is_nan() {
            return f64::INFINITY;
        }
        let (Some(a_last), Some(b_last)) = (a.pop(), b.pop()) else { return sum };
        sum += b_last * b_last / lead;
        let n = a.len();
        if n == 0 {
            return sum;
        }
        let (alpha, beta) = (a_last / lead, b_last / lead);
        // Pairs coefficient i with coefficient n - i of the polynomial before its last coefficient was removed.
        let turned: Vec<f64> = std::iter::once(a_last).chain(a[1..].iter().rev().copied()).collect();
        for i in 0..n {
            a[i] -= alpha * turned[i];
            b[i] -= beta * turned[i];
        }
    }
}

/// Transfer function `B(e^{jω}) / A(e^{jω})` at each frequency, as (real, imaginary).
pub fn response(ar: &[f64], ma: &[f64], rate: Hertz, frequencies: &[Hertz]) -> Vec<(f64, f64)> {
    let one = |f: &Hertz| {
        let (sin, cos) = (TAU * f.0 / rate.0).sin_cos();
        // Horner's method in z^-1 = cos - j sin, from the highest coefficient down.
        let value = |rest: &[f64]| {
            let highest_first = rest.iter().rev().chain(std::iter::once(&1.0));
            highest_first.fold((0.0, 0.0), |(re, im), c| (re * cos + im * sin + c, im * cos - re * sin))
        };
        let ((re, im), (above_re, above_im)) = (value(ar), value(ma));
        let square = re * re + im * im;
        ((above_re * re + above_im * im) / square, (above_im * re - above_re * im) / square)
    };
    frequencies.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{power_gain, response};
    use crate::dsp::ar;
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::lsf::ar_from_lsf;
    use crate::units::Hertz;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::PI;

    fn check(got: f64, want: f64, tolerance: f64) {
        assert!((got - want).abs() <= tolerance * want.abs(), "got {got}, expected {want}");
    }

    #[test]
    fn first_order_in_closed_form() {
        // y[t] = a y[t-1] + e[t] + b e[t-1]: (1 + 2ab + b²) / (1 - a²).
        for (a, b) in [(0.6, 0.3), (-0.9, 0.5), (0.5, -0.5), (0.0, 2.0)] {
            check(power_gain(&[-a], &[b]), (1.0 + 2.0 * a * b + b * b) / (1.0 - a * a), 1e-14);
        }
        check(power_gain(&[], &[0.5, 0.25]), 1.0 + 0.25 + 0.0625, 1e-15);
        assert_eq!(power_gain(&[], &[]), 1.0);
        assert_eq!(power_gain(&[1.0], &[0.5]), f64::INFINITY);
        // A zero that cancels a pole leaves white noise, however sharp the pole.
        check(power_gain(&[-0.999_999], &[-0.999_999]), 1.0, 1e-14);
    }

    #[test]
    fn the_integral_of_the_density_is_the_power() {
        let a = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
        let b =
            from_resonances(Hertz(1000.0), &[(Hertz(120.0), 0.95), (Hertz(330.0), 0.9), (Hertz(450.0), 0.7)]);
        let n = 20_000;
        let f: Vec<Hertz> = (0..n).map(|i| Hertz((f64::from(i) + 0.5) * 500.0 / f64::from(n))).collect();
        let square = |(re, im): (f64, f64)| re * re + im * im;
        let mean = response(&a, &b, Hertz(1000.0), &f).into_iter().map(square).sum::<f64>() / f64::from(n);
        check(power_gain(&a, &b), mean, 1e-9);
    }

    proptest! {
        /// Slow reference: energy of the impulse response.
        #[test]
        fn power_is_the_energy_of_the_impulse_response(
            gaps in prop::collection::vec(0.2_f64..1.0, 1..20),
            zeros in prop::collection::vec(0.2_f64..1.0, 1..20),
        ) {
            let lsf = |gaps: &[f64]| -> Vec<f64> {
                let total: f64 = gaps.iter().sum();
                (1..gaps.len()).map(|i| PI * gaps[..i].iter().sum::<f64>() / total).collect()
            };
            let (a, b) = (ar_from_lsf(&lsf(&gaps)), ar_from_lsf(&lsf(&zeros)));
            let mut y: Vec<f64> = Vec::new();
            for t in 0..20_000 {
                let driven = if t == 0 { 1.0 } else { b.get(t - 1).copied().unwrap_or(0.0) };
                let past: f64 = a.iter().enumerate().filter(|(i, _)| *i < t).map(|(i, a)| a * y[t - 1 - i]).sum();
                y.push(driven - past);
            }
            let energy: f64 = y.iter().map(|y| y * y).sum();
            let got = power_gain(&a, &b);
            prop_assert!((got - energy).abs() < 1e-8 * energy, "got {got}, expected {energy}");
            let alone = ar::power_gain(&a);
            prop_assert!((power_gain(&a, &[]) - alone).abs() < 1e-9 * alone);
        }
    }
}
