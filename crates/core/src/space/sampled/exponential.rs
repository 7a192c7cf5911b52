//! Fast exponential function for vectorized loops.

use std::f64::consts::{LN_2, LOG2_E};

/// Rounding constant 1.5 · 2⁵²: adding it rounds to an integer and leaves that integer in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// `eˣ` with a relative error of 2e-11 for -700 < x < 700; `x` is clamped to that range. It has no branch and no table,
/// so compilers vectorize it.
///
/// Uses `x = k ln 2 + r` with `|r|` at most 0.347, where ten terms of the Taylor series have an error of 1e-11.
#[inline(always)]
#[allow(clippy::inline_always, reason = "without inlining, the loop is compiled for the baseline CPU")]
pub(super) fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    let rounded = x * LOG2_E + ROUNDER;
    let k = rounded - ROUNDER;
    let r = x - k * LN_2;
    let high = 1.0 / 720.0 + r * (1.0 / 5040.0 + r * (1.0 / 40_320.0 + r * (1.0 / 362_880.0)));
    let low = 0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * high)));
    let power = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1.0_f64.to_bits()));
    power * (1.0 + r * (1.0 + r * low))
}

#[cfg(test)]
mod tests {
    use super::exp;

    #[test]
    fn exponentials_are_those_of_the_library() {
        for i in -69_999..=69_999 {
            let x = f64::from(i) * 0.01;
            assert!((exp(x) / x.exp() - 1.0).abs() < 2e-11, "e^{x} is {}, got {}", x.exp(), exp(x));
        }
        assert_eq!(exp(0.0), 1.0);
        assert!(exp(f64::INFINITY).is_finite() && exp(f64::NEG_INFINITY) > 0.0);
    }
}
