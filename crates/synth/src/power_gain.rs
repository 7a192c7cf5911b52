//! Power gain of a linear predictor, for spectra that are mixed in the audio callback.

use crate::limits::MAX_ORDER;

/// Returns the natural logarithm of the power gain `1 / Π (1 - k²)` of a predictor `a_1 … a_p`, of which at most
/// [`MAX_ORDER`] are used. Its reflection coefficients `k` come from the step-down recursion. `None` if the predictor is
/// not stable.
///
/// Cost: about `p²` multiplications and `p` divisions.
pub(crate) fn ln_power_gain(ar: &[f32]) -> Option<f32> {
    let order = ar.len().min(MAX_ORDER);
    let mut a = [0.0_f64; MAX_ORDER];
    for (wide, narrow) in a.iter_mut().zip(ar) {
        *wide = f64::from(*narrow);
    }
    // Fraction of the power that is not predicted.
    let mut rest = 1.0;
    for last in (0..order).rev() {
        let k = a[last];
        let left = 1.0 - k * k;
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        rest *= left;
        // The predictor of the next lower order, from both ends to the middle.
        let scale = 1.0 / left;
        for i in 0..last.div_ceil(2) {
            let mirrored = last - 1 - i;
            let (x, y) = (a[i], a[mirrored]);
            (a[i], a[mirrored]) = (scale * (x - k * y), scale * (y - k * x));
        }
    }
    Some(-libm::log(rest) as f32)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::ln_power_gain;
    use crate::limits::MAX_ORDER;
    use crate::lsf::ar_from_lsf;
    use crate::lsf::tests::lsf_of_gaps;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::vec;
    use std::vec::Vec;

    #[test]
    fn orders_one_and_two_in_closed_form() {
        // For order 1, the power gain is 1 / (1 - a²).
        let gain = ln_power_gain(&[-0.5]).unwrap();
        assert!((gain + 0.75_f32.ln()).abs() < 1e-6, "{gain}");
        // For order 2, it is (1 + a_2) / ((1 - a_2) ((1 + a_2)² - a_1²)).
        let (a_1, a_2) = (-1.2_f32, 0.8_f32);
        let expected = ((1.0 + a_2) / ((1.0 - a_2) * ((1.0 + a_2).powi(2) - a_1 * a_1))).ln();
        let gain = ln_power_gain(&[a_1, a_2]).unwrap();
        assert!((gain - expected).abs() < 1e-5, "{gain} for {expected}");
        assert_eq!(ln_power_gain(&[]), Some(0.0));
    }

    #[test]
    fn what_grows_has_no_gain() {
        for bad in [&[1.0][..], &[-2.0], &[0.0, 1.5], &[f32::NAN], &[f32::INFINITY, 0.5]] {
            assert_eq!(ln_power_gain(bad), None, "{bad:?}");
        }
    }

    #[test]
    fn the_highest_order_agrees_with_the_impulse_response() {
        // Gaps that differ by a factor of five, as far as the pattern of three allows.
        let gaps: Vec<f64> = (0..=MAX_ORDER).map(|i| [0.2, 1.0, 0.6][i % 3]).collect();
        let lsf = lsf_of_gaps(&gaps);
        let mut ar = vec![0.0; lsf.len()];
        ar_from_lsf(&lsf, &mut ar);
        let gain = f64::from(ln_power_gain(&ar).unwrap());
        assert!((gain - oracle(&ar, 20_000)).abs() < 1e-4, "{gain} for {}", oracle(&ar, 20_000));
    }

    /// Slow reference: sum of the squared impulse response.
    fn oracle(ar: &[f32], n: usize) -> f64 {
        let mut response = vec![0.0_f64; n];
        for i in 0..n {
            let past = (1..=ar.len().min(i)).map(|k| f64::from(ar[k - 1]) * response[i - k]).sum::<f64>();
            response[i] = if i == 0 { 1.0 } else { -past };
        }
        response.iter().map(|y| y * y).sum::<f64>().ln()
    }

    proptest! {
        #[test]
        fn agrees_with_the_impulse_response(gaps in prop::collection::vec(0.2_f64..1.0, 2..33)) {
            let lsf = lsf_of_gaps(&gaps);
            let mut ar = vec![0.0; lsf.len()];
            ar_from_lsf(&lsf, &mut ar);
            let gain = f64::from(ln_power_gain(&ar).unwrap());
            // 20,000 samples hold all of the response of gaps that differ by a factor of at most five. The rest is the
            // rounding of the result to f32 and of the recursion.
            prop_assert!((gain - oracle(&ar, 20_000)).abs() < 1e-4, "{gain} for {}", oracle(&ar, 20_000));
        }
    }
}
