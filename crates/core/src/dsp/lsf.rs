//! Conversion between linear prediction coefficients and line spectral frequencies (LSF), offline in f64.
//!
//! LSFs are angles in (0, π) radians, in ascending order. A predictor is stable if and only if its LSFs are distinct
//! and inside this interval. Any weighted mean of such sets (non-negative weights) has the same property; this is why
//! AR models are interpolated as LSFs.

mod arc_cosine;
mod quick;

use std::f64::consts::PI;
use std::sync::LazyLock;

pub(crate) use crate::dsp::lsf::quick::FastLsf;

use shagreen_synth::lsf::{ASCENDING_ORDER, scattered};

/// First grid of the root search, and its cosines.
const FIRST_GRID: usize = 128;
static FIRST_COSINES: LazyLock<[f64; FIRST_GRID + 1]> =
    LazyLock::new(|| std::array::from_fn(|i| (PI * i as f64 / FIRST_GRID as f64).cos()));

/// Minimum distance in radians between neighboring LSFs after [`repair`]: 0.8 Hz at a sample rate of 1 kHz.
pub const MIN_GAP: f64 = 0.005;

/// Returns the line spectral frequencies of `A(z) = 1 + Σ ar[k-1] z^-k`.
///
/// Returns `None` for an unstable predictor. The same holds for one so nearly unstable (power gain above 1e9) that the
/// digits of its coefficients do not determine stability.
///
/// Half-degree polynomials in `cos ω` are searched for sign changes on a grid. The grid is refined until it separates
/// all roots, and bisection then finds each root to the last bit.
pub fn lsf_from_ar(ar: &[f64]) -> Option<Vec<f64>> {
    let order = ar.len();
    if order == 0 || ar.iter().any(|a| !a.is_finite()) || crate::dsp::ar::power_gain(ar).is_infinite() {
        return None;
    }
    let a_at = |i: usize| if i == 0 { 1.0 } else { ar.get(i - 1).copied().unwrap_or(0.0) };
    // P(z) = A - z^-(p+1) A(1/z) and Q(z) = A + z^-(p+1) A(1/z), both of degree p + 1.
    let mut p: Vec<f64> = (0..=order + 1).map(|i| a_at(i) - a_at(order + 1 - i)).collect();
    let mut q: Vec<f64> = (0..=order + 1).map(|i| a_at(i) + a_at(order + 1 - i)).collect();
    if order.is_multiple_of(2) {
        divide_by_first_order(&mut p, 1.0);
        divide_by_first_order(&mut q, -1.0);
    } else {
        divide_by_first_order(&mut p, 1.0);
        divide_by_first_order(&mut p, -1.0);
    }
    let mut lsf = palindrome_roots(&q)?;
    lsf.extend(palindrome_roots(&p)?);
    lsf.sort_by(f64::total_cmp);
    Some(lsf)
}

/// Divides a polynomial in z^-1 by `1 - root z^-1` and drops the remainder, which is zero for an exact root.
fn divide_by_first_order(poly: &mut Vec<f64>, root: f64) {
    for i in 1..poly.len() {
        poly[i] += root * poly[i - 1];
    }
    poly.pop();
}

/// Angles in (0, π) of all roots of a palindromic polynomial of even degree; `None` if not all roots lie on the unit
/// circle.
fn palindrome_roots(poly: &[f64]) -> Option<Vec<f64>> {
    let m = (poly.len() - 1) / 2;
    // e^{jmω} times the polynomial is real: poly[m] + 2 Σ poly[m-k] cos kω, evaluated by Clenshaw's recurrence.
    let value = |cosine: f64| {
        let x = 2.0 * cosine;
        let (mut b1, mut b2) = (0.0, 0.0);
        for k in (1..=m).rev() {
            (b1, b2) = (2.0 * poly[m - k] + x * b1 - b2, b1);
        }
        poly[m] + 0.5 * x * b1 - b2
    };
    let mut n_grid = FIRST_GRID;
    while n_grid <= 1 << 17 {
        let mut roots = Vec::with_capacity(m);
        let (mut w0, mut f0) = (0.0, value(1.0));
        for i in 1..=n_grid {
            let w1 = PI * i as f64 / n_grid as f64;
            let f1 = value(if n_grid == FIRST_GRID { FIRST_COSINES[i] } else { w1.cos() });
            if f0 == 0.0 && w0 > 0.0 {
                roots.push(w0);
            } else if f0 * f1 < 0.0 {
                roots.push(bisect(&value, w0, w1, f0));
            }
            (w0, f0) = (w1, f1);
        }
        if roots.len() == m {
            return Some(roots);
        }
        n_grid *= 4;
    }
    None
}

/// Angle between `low` and `high` at which `value`, a function of the cosine, changes sign; exact to the last bit.
fn bisect(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64, f_low: f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (value(middle.cos()) < 0.0) == (f_low < 0.0) { low = middle } else { high = middle }
    }
}

/// Linear prediction coefficients `a_1 … a_p` of ascending line spectral frequencies.
pub fn ar_from_lsf(lsf: &[f64]) -> Vec<f64> {
    let order = lsf.len();
    // The frequencies belong to Q and P alternately; the roots at 1 and -1 are multiplied in afterwards.
    let (mut q, mut p) = (with_roots(lsf, 0), with_roots(lsf, 1));
    if order.is_multiple_of(2) {
        for i in (1..=order).rev() {
            q[i] += q[i - 1];
            p[i] -= p[i - 1];
        }
    } else {
        for i in (2..=order).rev() {
            p[i] -= p[i - 2];
        }
    }
    (1..=order).map(|i| 0.5 * (q[i] + p[i])).collect()
}

/// Polynomial whose roots on the unit circle have every other frequency from `first` on as their angle. The vector has
/// two more coefficients than there are frequencies.
fn with_roots(lsf: &[f64], first: usize) -> Vec<f64> {
    let mut poly = vec![0.0; lsf.len() + 2];
    poly[0] = 1.0;
    let mut degree = 0;
    let mut multiply = |w: f64| {
        // Multiplication by 1 - 2 cos(w) z + z², in place from the highest coefficient down.
        let middle = -2.0 * w.cos();
        degree += 2;
        for i in (2..=degree).rev() {
            poly[i] += poly[i - 2] + middle * poly[i - 1];
        }
        poly[1] += middle;
    };
    let own: Vec<f64> = lsf.iter().skip(first).step_by(2).copied().collect();
    if lsf.len() <= ASCENDING_ORDER {
        own.into_iter().for_each(multiply);
    } else {
        scattered(own.len()).for_each(|index| multiply(own[index]));
    }
    poly
}

/// Sorts LSFs and separates them by at least [`MIN_GAP`] from each other and from both ends. Use it after interpolators
/// that can break the order. Valid sets are returned unchanged.
pub fn repair(lsf: &[f64]) -> Vec<f64> {
    repair_to(lsf.to_vec(), MIN_GAP)
}

/// Repairs LSFs like [`repair`], with a minimum distance of `gap` radians, which must be at most π / (number of LSFs +
/// 1).
pub(crate) fn repair_to(lsf: Vec<f64>, gap: f64) -> Vec<f64> {
    let n = lsf.len();
    let is_within = n == 0 || (lsf[0] >= gap && lsf[n - 1] <= PI - gap);
    if is_within && lsf.windows(2).all(|w| w[1] >= w[0] + gap) {
        return lsf;
    }
    let mut out = lsf;
    out.sort_by(f64::total_cmp);
    for i in 0..n {
        let floor = if i == 0 { gap } else { out[i - 1] + gap };
        out[i] = out[i].max(floor);
    }
    for i in (0..n).rev() {
        let ceiling = if i + 1 == n { PI - gap } else { out[i + 1] - gap };
        out[i] = out[i].min(ceiling);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{MIN_GAP, ar_from_lsf, lsf_from_ar, repair};
    use crate::dsp::ar::burg;
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::maths::rng::lcg_noise;
    use crate::units::Hertz;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::PI;

    #[test]
    fn golden_frequencies() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../../vectors/a_ar/ar_vectors.json")).unwrap();
        let true_ar = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
        let other = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
        for (ar, golden) in [(true_ar, &v["true"]["lsf"]), (other, &v["interp"]["lsf_b"])] {
            for (w, g) in lsf_from_ar(&ar).unwrap().iter().zip(golden.as_array().unwrap()) {
                // The reference computes polynomial roots with an accuracy of about 1e-11.
                assert!((w - g.as_f64().unwrap()).abs() < 1e-10, "got {w}, expected {g}");
            }
        }
    }

    proptest! {
        #[test]
        fn round_trip_at_every_order(reflections in prop::collection::vec(-0.8_f64..0.8, 1..26)) {
            let mut ar: Vec<f64> = Vec::new();
            for k in reflections {
                let before = ar.clone();
                for (j, a) in ar.iter_mut().enumerate() { *a += k * before[before.len() - 1 - j]; }
                ar.push(k);
            }
            let lsf = lsf_from_ar(&ar).unwrap();
            prop_assert!(lsf.windows(2).all(|w| w[0] < w[1]) && lsf[0] > 0.0 && lsf[lsf.len() - 1] < PI);
            let scale = ar.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
            for (a, b) in ar_from_lsf(&lsf).iter().zip(&ar) {
                // The reference reports 2.4e-11 for these orders and reflection coefficients; close pairs amplify the
                // last bit.
                prop_assert!((a - b).abs() < 1e-9 * scale, "got {a}, expected {b}");
            }
        }

        #[test]
        fn repair_orders_anything(mut lsf in prop::collection::vec(-1.0_f64..4.0, 1..33)) {
            let fixed = repair(&lsf);
            prop_assert!(fixed[0] >= MIN_GAP - 1e-12 && fixed[fixed.len() - 1] <= PI - MIN_GAP + 1e-12);
            prop_assert!(fixed.windows(2).all(|w| w[1] - w[0] >= MIN_GAP - 1e-12));
            lsf.clone_from(&fixed);
            prop_assert!(repair(&lsf).iter().zip(&fixed).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }

    #[test]
    fn golden_round_trip() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../../vectors/a_ar/ar_vectors.json")).unwrap();
        let golden = v["lsf_roundtrip_maxerr"].as_f64().unwrap();
        let mut random = crate::maths::rng::Random::new(0);
        // Orders and distribution of reflection coefficients as in the reference; the error must not exceed its error.
        for order in [3, 4, 7, 10, 15, 20, 25] {
            let mut ar: Vec<f64> = Vec::new();
            for _ in 0..order {
                let k = 1.6 * random.uniform() - 0.8;
                let before = ar.clone();
                for (a, b) in ar.iter_mut().zip(before.iter().rev()) {
                    *a += k * b;
                }
                ar.push(k);
            }
            for (a, b) in ar_from_lsf(&lsf_from_ar(&ar).unwrap()).iter().zip(&ar) {
                assert!((a - b).abs() <= golden, "order {order}: got {a}, expected {b}");
            }
        }
    }

    /// Spectra of strokes are steep, so that all low frequencies lie close together.
    #[test]
    fn high_orders_round_trip_too() {
        let ar =
            from_resonances(Hertz(1000.0), &[(Hertz(25.0), 0.98), (Hertz(60.0), 0.97), (Hertz(180.0), 0.95)]);
        let mut x = lcg_noise(20_000, 11);
        for i in ar.len()..x.len() {
            x[i] -= (1..=ar.len()).map(|k| ar[k - 1] * x[i - k]).sum::<f64>();
        }
        for order in [33, 47, 64, 80] {
            let fitted = burg(&x, order).unwrap().ar;
            let lsf = lsf_from_ar(&fitted).unwrap();
            for (a, b) in ar_from_lsf(&lsf).iter().zip(&fitted) {
                // Measured: below 1e-11. In ascending order of the frequencies, 0.06 at order 64.
                assert!((a - b).abs() < 1e-8, "order {order}: got {a}, expected {b}");
            }
        }
    }

    #[test]
    fn unstable_predictors_have_none() {
        assert_eq!(lsf_from_ar(&[0.0, 1.1]), None);
        assert_eq!(lsf_from_ar(&[f64::NAN]), None);
        assert_eq!(lsf_from_ar(&[]), None);
    }

    #[test]
    fn survives_six_decimals() {
        // Published models store LSFs with six decimals; the coefficients are then accurate to 2.2e-5.
        let ar = burg(&lcg_noise(1000, 5), 20).unwrap().ar;
        let rounded: Vec<f64> = lsf_from_ar(&ar).unwrap().iter().map(|w| (w * 1e6).round() / 1e6).collect();
        for (a, b) in ar_from_lsf(&rounded).iter().zip(&ar) {
            assert!((a - b).abs() < 2.2e-5);
        }
    }
}
