//! Conversion of line spectral frequencies (LSFs) to linear-prediction coefficients, for the audio callback.
//!
//! With `P(z) = A(z) - z^-(p+1) A(1/z)` and `Q(z) = A(z) + z^-(p+1) A(1/z)`, the LSFs are the angles of the roots of Q
//! and P, which alternate. The inverse is `A = (P + Q) / 2` (Itakura 1975). Both polynomials are palindromic once their
//! roots at ±1 are removed, so only half of each is expanded, P and Q side by side.

use core::f64::consts::FRAC_PI_2;

use crate::limits::MAX_ORDER;

/// Highest order whose factors are multiplied in ascending order of their frequencies.
///
/// The coefficients of a product of the low frequencies alone grow by about a factor of 3 with each factor, to 3e8 at
/// order 64, and the high frequencies cancel them again. At higher orders so many digits cancel that a stable filter
/// becomes unstable. Their factors are therefore multiplied in the order of [`scattered`], in which the coefficients of
/// real filters stay below 1e4.
pub const ASCENDING_ORDER: usize = 32;

const MAX_FACTORS: usize = MAX_ORDER.div_ceil(2);

/// Indices of `n` factors in the order of their reversed bits: 0, 16, 8, 24, and so on for 32. Low and high frequencies
/// alternate, so that the coefficients of partial products stay small.
pub fn scattered(n: usize) -> impl Iterator<Item = usize> {
    // At least two, so that the shift is shorter than a word.
    let n_slots = n.max(2).next_power_of_two();
    let shift = n_slots.leading_zeros() + 1;
    (0..n_slots).map(move |slot| slot.reverse_bits() >> shift).filter(move |index| *index < n)
}

/// `-2 cos(w)` for `w` in (0, π), within 2e-11: twice the Taylor series of the sine at `w - π/2`.
#[inline]
fn minus_two_cos(w: f64) -> f64 {
    let x = w - FRAC_PI_2;
    let s = x * x;
    // The terms are 1/3!, 1/5!, …, 1/15! with alternating sign.
    let series = 1.0
        + s * (-1.0 / 6.0
            + s * (1.0 / 120.0
                + s * (-1.0 / 5_040.0
                    + s * (1.0 / 362_880.0
                        + s * (-1.0 / 39_916_800.0
                            + s * (1.0 / 6_227_020_800.0 + s * (-1.0 / 1_307_674_368_000.0)))))));
    2.0 * x * series
}

/// Writes the coefficients `a_1 … a_p` of `A(z) = 1 + Σ a_k z^-k` for `p` ascending frequencies in radians (0, π).
///
/// `lsf` and `ar` have the same length `p`, at most [`MAX_ORDER`]; further elements are ignored. Cost: `p` cosines and
/// about `p²/4` multiply-adds.
#[inline]
pub fn ar_from_lsf(lsf: &[f32], ar: &mut [f32]) {
    let order = lsf.len().min(ar.len()).min(MAX_ORDER);
    let (lsf, ar) = (&lsf[..order], &mut ar[..order]);
    // Usual orders need arrays of half the length.
    if order <= ASCENDING_ORDER {
        expand::<16, 17>(lsf, ar, |k| k);
    } else {
        let mut places = [0; MAX_FACTORS];
        for (place, index) in places.iter_mut().zip(scattered(order / 2)) {
            *place = index;
        }
        expand::<MAX_FACTORS, { MAX_FACTORS + 1 }>(lsf, ar, |k| places[k]);
    }
}

/// Writes the coefficients of as many frequencies as `ar` has elements: at most twice `FACTORS`, one less than `HALF`.
/// Factor `place(k)` of each polynomial is multiplied as number `k`.
#[inline]
fn expand<const FACTORS: usize, const HALF: usize>(
    lsf: &[f32],
    ar: &mut [f32],
    place: impl Fn(usize) -> usize,
) {
    let order = lsf.len();
    if order == 0 {
        return;
    }
    let (q_factors, p_factors) = (order.div_ceil(2), order / 2);
    let mut factor = [[0.0_f64; 2]; FACTORS];
    for (i, pair) in lsf.chunks(2).enumerate() {
        factor[i] =
            [minus_two_cos(f64::from(pair[0])), pair.get(1).map_or(0.0, |&w| minus_two_cos(f64::from(w)))];
    }
    // half[i] is coefficient i of [Q, P], 0..=degree/2. Both are expanded over p_factors; any remaining factor is Q's.
    let mut half = [[0.0_f64; 2]; HALF];
    half[0] = [1.0, 1.0];
    for k in 0..p_factors {
        multiply::<2, HALF>(&mut half, k, factor[place(k)]);
    }
    if q_factors > p_factors {
        multiply::<1, HALF>(&mut half, p_factors, factor[p_factors]);
    }
    let q_at = |i: usize| if i <= q_factors { half[i][0] } else { half[2 * q_factors - i][0] };
    let p_at = |i: usize| if i <= p_factors { half[i][1] } else { half[2 * p_factors - i][1] };
    if order.is_multiple_of(2) {
        // Q also has the root z = -1, and P the root z = 1.
        let (mut q_last, mut p_last) = (1.0, 1.0);
        for (i, a) in (1..).zip(ar.iter_mut()) {
            let (q, p) = (q_at(i), p_at(i));
            *a = (0.5 * (q + q_last + p - p_last)) as f32;
            (q_last, p_last) = (q, p);
        }
    } else {
        // P has the roots z = 1 and z = -1; Q has neither.
        for (i, a) in (1..).zip(ar.iter_mut()) {
            let p = if i <= 2 * p_factors { p_at(i) } else { 0.0 };
            let p_before = if i >= 2 { p_at(i - 2) } else { 0.0 };
            *a = (0.5 * (q_at(i) + p - p_before)) as f32;
        }
    }
}

/// Multiplies the first `N` of two palindromes of degree `2 k` by `1 + c z + z²` each. Only their first halves are stored.
#[inline]
fn multiply<const N: usize, const HALF: usize>(half: &mut [[f64; 2]; HALF], k: usize, c: [f64; 2]) {
    for lane in 0..N {
        // The coefficient after the middle equals the coefficient before it.
        let before = if k >= 1 { half[k - 1][lane] } else { 0.0 };
        half[k + 1][lane] = 2.0 * before + c[lane] * half[k][lane];
    }
    if k == 0 {
        // A single factor has degree 2: 1, c, 1.
        return;
    }
    for i in (2..=k).rev() {
        for lane in 0..N {
            half[i][lane] += c[lane] * half[i - 1][lane] + half[i - 2][lane];
        }
    }
    for lane in 0..N {
        half[1][lane] += c[lane] * half[0][lane];
    }
}

#[cfg(test)]
pub(crate) mod tests {
    extern crate std;
    use super::{MAX_FACTORS, ar_from_lsf, expand, minus_two_cos, scattered};
    use crate::limits::MAX_ORDER;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::vec;
    use std::vec::Vec;

    /// Slow reference: multiplies all factors at full length, the lowest and the highest frequencies by turns, so that
    /// few digits cancel.
    fn oracle(lsf: &[f64]) -> Vec<f64> {
        let convolve = |a: &[f64], b: &[f64]| {
            let mut out = vec![0.0; a.len() + b.len() - 1];
            for (i, x) in a.iter().enumerate() {
                for (j, y) in b.iter().enumerate() {
                    out[i + j] += x * y;
                }
            }
            out
        };
        let (mut q, mut p) = (vec![1.0], vec![1.0]);
        let n = lsf.len();
        let by_turns =
            (0..n).map(|i| if i % 4 < 2 { i / 4 * 2 + i % 2 } else { n - 1 - (i / 4 * 2 + i % 2) });
        for i in by_turns {
            let factor = [1.0, -2.0 * lsf[i].cos(), 1.0];
            if i % 2 == 0 { q = convolve(&q, &factor) } else { p = convolve(&p, &factor) }
        }
        if lsf.len().is_multiple_of(2) {
            q = convolve(&q, &[1.0, 1.0]);
            p = convolve(&p, &[1.0, -1.0]);
        } else {
            p = convolve(&p, &[1.0, 0.0, -1.0]);
        }
        (1..=lsf.len()).map(|i| 0.5 * (q[i] + p[i])).collect()
    }

    /// Line spectral frequencies with these gaps, in any proportion; one fewer than gaps.
    pub(crate) fn lsf_of_gaps(gaps: &[f64]) -> Vec<f32> {
        let total: f64 = gaps.iter().sum();
        let mut w = 0.0;
        let next = |gap: &f64| {
            w += gap * core::f64::consts::PI / total;
            w as f32
        };
        gaps[..gaps.len() - 1].iter().map(next).collect()
    }

    #[test]
    fn cosine_is_within_its_bound() {
        for i in 0..=10_000 {
            let w = core::f64::consts::PI * f64::from(i) / 10_000.0;
            assert!((minus_two_cos(w) + 2.0 * w.cos()).abs() < 2e-11, "at {w}");
        }
    }

    #[test]
    fn first_order_in_closed_form() {
        // For order 1, Q = 1 - 2 cos(w) z + z² and P = 1 - z², so a_1 = -cos(w).
        let mut ar = [0.0];
        ar_from_lsf(&[1.0], &mut ar);
        assert!((f64::from(ar[0]) + 1.0_f64.cos()).abs() < 1e-7);
    }

    #[test]
    fn every_factor_is_multiplied_once() {
        for n in 0..100 {
            let mut places: Vec<usize> = scattered(n).collect();
            places.sort_unstable();
            assert!(places.iter().copied().eq(0..n), "{places:?} of {n}");
        }
    }

    /// Evenly spaced frequencies are a predictor of zeros.
    #[test]
    fn white_noise_in_closed_form_at_every_order() {
        let even = |order: usize| -> Vec<f32> {
            (1..=order).map(|i| (core::f64::consts::PI * i as f64 / (order as f64 + 1.0)) as f32).collect()
        };
        let largest = |ar: &[f32]| ar.iter().fold(0.0_f32, |most, a| most.max(a.abs()));
        for order in 1..=MAX_ORDER {
            let mut ar = vec![f32::NAN; order];
            ar_from_lsf(&even(order), &mut ar);
            // The frequencies are rounded to f32, about 1e-7 each.
            assert!(largest(&ar) < 5e-6, "order {order}: {ar:?}");
        }
        // Negative control: in ascending order, high orders lose nearly all digits.
        let mut ar = vec![f32::NAN; MAX_ORDER];
        expand::<MAX_FACTORS, { MAX_FACTORS + 1 }>(&even(MAX_ORDER), &mut ar, |k| k);
        assert!(largest(&ar) > 1e-3, "{ar:?}");
    }

    proptest! {
        #[test]
        fn agrees_with_the_full_expansion(gaps in prop::collection::vec(0.02_f64..1.0, 2..MAX_ORDER + 2)) {
            let lsf = lsf_of_gaps(&gaps);
            let mut ar = vec![f32::NAN; lsf.len()];
            ar_from_lsf(&lsf, &mut ar);
            let wide: Vec<f64> = lsf.iter().map(|&w| f64::from(w)).collect();
            let expected = oracle(&wide);
            let scale = expected.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
            for (a, e) in ar.iter().zip(&expected) {
                // The result is rounded to f32 once; half a unit in the last place is 6e-8 of the largest value.
                prop_assert!((f64::from(*a) - e).abs() < 2e-7 * scale, "{a} for {e}");
            }
        }
    }
}
