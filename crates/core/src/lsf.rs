//! Predictor coefficients to line spectral frequencies and back, offline and in f64.
//!
//! Frequencies are angles in radians (0, π), ascending. A predictor is stable exactly when its frequencies are distinct
//! and lie inside, and so is any weighted mean of such sets: that is why models are interpolated in this form.

mod arc_cosine;
mod quick;

use std::f64::consts::PI;
use std::sync::LazyLock;

pub(crate) use crate::lsf::quick::QuickLsf;

/// Angles at which roots are looked for first, and their cosines.
const FIRST_GRID: usize = 128;
static FIRST_COSINES: LazyLock<[f64; FIRST_GRID + 1]> =
    LazyLock::new(|| std::array::from_fn(|i| (PI * i as f64 / FIRST_GRID as f64).cos()));

/// Smallest distance between neighboring frequencies that [`repair`] leaves, in radians: 0.8 Hz at 1 kHz.
pub const MIN_GAP: f64 = 0.005;

/// The line spectral frequencies of `A(z) = 1 + Σ ar[k-1] z^-k`, or `None` where the predictor is not stable,
/// or so nearly unstable (a power gain over 1e9) that the digits of its coefficients do not tell.
///
/// Half-degree polynomials in `cos ω` are searched for sign changes on a grid that is refined until all roots are
/// found, then bisected to the last bit.
pub fn lsf_from_ar(ar: &[f64]) -> Option<Vec<f64>> {
    let order = ar.len();
    if order == 0 || ar.iter().any(|a| !a.is_finite()) || crate::ar::power_gain(ar).is_infinite() {
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

/// Divides a polynomial in z^-1 by `1 - root z^-1`, dropping the remainder, which is zero for a true root.
fn divide_by_first_order(poly: &mut Vec<f64>, root: f64) {
    for i in 1..poly.len() {
        poly[i] += root * poly[i - 1];
    }
    poly.pop();
}

/// The angles in (0, π) of all roots of a palindrome of even degree, or `None` if they are not all on the circle.
fn palindrome_roots(poly: &[f64]) -> Option<Vec<f64>> {
    let m = (poly.len() - 1) / 2;
    // e^{jmω} times the palindrome is real: poly[m] + 2 Σ poly[m-k] cos kω, summed by Clenshaw's recurrence.
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

/// The sign change of `value`, a function of the cosine, between the angles `low` and `high`, to the last bit.
fn bisect(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64, f_low: f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (value(middle.cos()) < 0.0) == (f_low < 0.0) { low = middle } else { high = middle }
    }
}

/// The predictor coefficients `a_1 … a_p` of ascending line spectral frequencies.
pub fn ar_from_lsf(lsf: &[f64]) -> Vec<f64> {
    let order = lsf.len();
    // Frequencies take turns; then come the roots at both ends of the circle.
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

/// The polynomial with every other frequency from `first` on as an angle of its roots on the circle, with room for as many
/// coefficients as there are frequencies, and one more.
fn with_roots(lsf: &[f64], first: usize) -> Vec<f64> {
    let mut poly = vec![0.0; lsf.len() + 2];
    poly[0] = 1.0;
    let mut degree = 0;
    for w in lsf.iter().skip(first).step_by(2) {
        // Times 1 - 2 cos(w) z + z², in place from the highest coefficient down.
        let middle = -2.0 * w.cos();
        degree += 2;
        for i in (2..=degree).rev() {
            poly[i] += poly[i - 2] + middle * poly[i - 1];
        }
        poly[1] += middle;
    }
    poly
}

/// Frequencies put back in order and at least [`MIN_GAP`] apart and from both ends, for interpolators that can break
/// the order. Sets that keep the rule already are returned as they are.
pub fn repair(lsf: &[f64]) -> Vec<f64> {
    repair_to(lsf.to_vec(), MIN_GAP)
}

/// The same with a smallest distance of `gap` radians, at most π over one more than there are frequencies.
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
    use crate::ar::burg;
    use crate::ar::test_signals::from_resonances;
    use crate::rng::lcg_noise;
    use crate::units::Hertz;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::PI;

    #[test]
    fn golden_frequencies() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../vectors/a_ar/ar_vectors.json")).unwrap();
        let true_ar = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
        let other = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
        for (ar, golden) in [(true_ar, &v["true"]["lsf"]), (other, &v["interp"]["lsf_b"])] {
            for (w, g) in lsf_from_ar(&ar).unwrap().iter().zip(golden.as_array().unwrap()) {
                // The reference takes roots of a polynomial, good to about 1e-11.
                assert!((w - g.as_f64().unwrap()).abs() < 1e-10, "{w} for {g}");
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
                // The reference reports 2.4e-11 over these orders and reflections; close pairs amplify the last bit.
                prop_assert!((a - b).abs() < 1e-9 * scale, "{a} for {b}");
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
            serde_json::from_str(include_str!("../../../vectors/a_ar/ar_vectors.json")).unwrap();
        let golden = v["lsf_roundtrip_maxerr"].as_f64().unwrap();
        let mut random = crate::rng::Random::new(0);
        // The reference's orders, with reflections as it draws them: nowhere worse than it.
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
                assert!((a - b).abs() <= golden, "order {order}: {a} for {b}");
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
        // Published models store frequencies to six decimals; coefficients come back within 2.2e-5.
        let ar = burg(&lcg_noise(1000, 5), 20).unwrap().ar;
        let rounded: Vec<f64> = lsf_from_ar(&ar).unwrap().iter().map(|w| (w * 1e6).round() / 1e6).collect();
        for (a, b) in ar_from_lsf(&rounded).iter().zip(&ar) {
            assert!((a - b).abs() < 2.2e-5);
        }
    }
}
