//! Arc cosine of many numbers at once.

use std::f64::consts::{FRAC_PI_2, PI};

/// Number of series terms; the first omitted term is 1e-13 at the end of the range.
const N_TERMS: usize = 17;

/// Coefficients of `asin s = s Σ c_n s^2n`, `c_n = (2n)! / (4ⁿ n!² (2n + 1))`.
const SERIES: [f64; N_TERMS] = series();

const fn series() -> [f64; N_TERMS] {
    let mut c = [1.0; N_TERMS];
    let mut central = 1.0;
    let mut n = 1;
    while n < N_TERMS {
        central *= (2 * n - 1) as f64 / (2 * n) as f64;
        c[n] = central / (2 * n + 1) as f64;
        n += 1;
    }
    c
}

/// Arc cosine with an error below 1e-12; `x` is clamped to -1..=1. The code has no branches and no tables, so that the
/// compiler vectorizes it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
pub(super) fn arc_cosine(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    let size = x.abs();
    // Above one half, the half-angle formula keeps the argument of the series small.
    let is_steep = size > 0.5;
    let halved = 0.5 * (1.0 - size);
    let square = if is_steep { halved } else { size * size };
    let s = square.sqrt();
    let mut sum = 0.0;
    for c in SERIES.iter().rev() {
        sum = c + square * sum;
    }
    let arc_sine = s * sum;
    let of_size = if is_steep { 2.0 * arc_sine } else { FRAC_PI_2 - arc_sine };
    if x < 0.0 { PI - of_size } else { of_size }
}

#[cfg(test)]
mod tests {
    use super::arc_cosine;

    #[test]
    fn angles_are_those_of_the_library() {
        for i in -100_000..=100_000 {
            let x = f64::from(i) * 1e-5;
            assert!(
                (arc_cosine(x) - x.acos()).abs() < 1e-12,
                "acos {x} is {}, got {}",
                x.acos(),
                arc_cosine(x)
            );
        }
        for x in [0.5_f64.next_up(), 1.0_f64.next_down(), -0.5, f64::MIN_POSITIVE, -0.0] {
            assert!((arc_cosine(x) - x.acos()).abs() < 1e-12, "{x}");
        }
        assert_eq!([arc_cosine(1.0 + 1e-9), arc_cosine(-2.0)], [0.0, std::f64::consts::PI]);
    }
}
