//! Natural logarithms of many numbers at once.

use std::f64::consts::{FRAC_1_SQRT_2, LN_2};

use pulp::{Arch, Simd, WithSimd};

const MANTISSA: u64 = (1 << 52) - 1;
/// Bits of 2⁵². Adding a smaller integer to the mantissa bits adds that integer to the number.
const TWO_POW_52: u64 = 0x4330_0000_0000_0000;

/// Replaces each value by the natural logarithm of `mended(value)`, accurate to a few units in the last place. The
/// result of `mended` must be positive, finite and normal.
///
/// The code has no branches and no tables, so that the compiler vectorizes it. It takes half the time of scalar calls;
/// logarithms are half of the work for coefficients of short frames.
pub(super) fn ln_all(values: &mut [f64], mended: impl Fn(f64) -> f64) {
    Arch::new().dispatch(LnAll { values, mended });
}

struct LnAll<'a, F> {
    values: &'a mut [f64],
    mended: F,
}

impl<F: Fn(f64) -> f64> WithSimd for LnAll<'_, F> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { values, mended } = self;
        for value in values {
            *value = ln(mended(*value));
        }
    }
}

/// Natural logarithm of one number. With `x = 2ᵉ m` and `m` in √½ .. √2, `ln m = 2 artanh s = 2 (s + s³/3 + s⁵/5 + …)`
/// for `s = (m - 1) / (m + 1)`, at most 0.172. Eleven terms leave an error of `2 s²³/23`, 2e-19.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
fn ln(x: f64) -> f64 {
    let lowest = FRAC_1_SQRT_2.to_bits();
    let bits = x.to_bits() + (1.0_f64.to_bits() - lowest);
    let exponent = f64::from_bits(bits >> 52 | TWO_POW_52) - (f64::from_bits(TWO_POW_52) + 1023.0);
    let m = f64::from_bits((bits & MANTISSA) + lowest);
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let w = z * z;
    let odd = 2.0 / 3.0 + w * (2.0 / 7.0 + w * (2.0 / 11.0 + w * (2.0 / 15.0 + w * (2.0 / 19.0))));
    let even = 2.0 / 5.0 + w * (2.0 / 9.0 + w * (2.0 / 13.0 + w * (2.0 / 17.0 + w * (2.0 / 21.0))));
    exponent * LN_2 + (2.0 * s + s * (z * odd + w * even))
}

#[cfg(test)]
mod tests {
    use super::ln_all;

    #[test]
    fn logarithms_are_those_of_the_library() {
        // All exponents, varied mantissas, and the limits of the range.
        let mut values =
            vec![f64::MIN_POSITIVE, f64::MAX, 1.0, 2.0, 0.5, std::f64::consts::SQRT_2, 1.0 + f64::EPSILON];
        values.extend((0..40_000).map(|i| 2.0_f64.powf(-1021.9 + 0.0511 * f64::from(i))));
        values.extend((0..2000).map(|i| 0.5 + 0.001 * f64::from(i)));
        let mut logarithms = values.clone();
        ln_all(&mut logarithms, |x| x);
        for (x, got) in values.iter().zip(&logarithms) {
            // Two roundings of the result; near one, the rounding of s.
            let tolerance = 2.0 * f64::EPSILON * x.ln().abs();
            assert!((got - x.ln()).abs() <= tolerance, "ln {x} is {}, got {got}", x.ln());
        }
    }
}
