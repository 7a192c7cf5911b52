//! Line spectral frequencies for where thousands of predictors are converted a second.

use pulp::{Arch, Simd, WithSimd};

use crate::lsf::arc_cosine::arc_cosine;
use crate::lsf::lsf_from_ar;

/// Angles at which signs are looked for: what they do not tell apart is left to the careful search.
const N_GRID: usize = 96;
/// The upper half of them has the cosines of the lower half with the other sign, and so have odd multiples of the angle.
const HALF: usize = N_GRID / 2;
/// Most roots of one half polynomial: half the highest order.
const MOST_ROOTS: usize = 16;
/// Most steps of the false position: the first ones narrow a bracket, the last ones square the error. A handful is usual.
const MOST_STEPS: usize = 30;
/// A step of all cosines below this is the last: the next one would be its square, about.
const SMALL_STEP: f64 = 1e-8;

/// A sum of cosines `Σ c_k cos kω`.
type Series = [f64; MOST_ROOTS + 1];
/// `cos kω` at the lower half of the grid, for each `k`.
type Cosines = [[f64; HALF]; MOST_ROOTS + 1];

/// The frequencies of [`lsf_from_ar`] to 1e-6 radians, many times as fast: signs are looked for on a coarse grid, and
/// all brackets are narrowed at once. What the grid does not tell apart goes to the careful search.
#[derive(Clone, Debug)]
pub(crate) struct QuickLsf {
    cosines: Box<Cosines>,
}

impl QuickLsf {
    /// The grid.
    pub(crate) fn new() -> Self {
        let cosine = |k: usize, i: usize| (std::f64::consts::PI * (k * i) as f64 / (N_GRID - 1) as f64).cos();
        Self { cosines: Box::new(std::array::from_fn(|k| std::array::from_fn(|i| cosine(k, i)))) }
    }

    /// The frequencies of a predictor, or `None` where it is not stable.
    pub(crate) fn of(&self, ar: &[f64]) -> Option<Vec<f64>> {
        self.quickly(ar).or_else(|| lsf_from_ar(ar))
    }

    fn quickly(&self, ar: &[f64]) -> Option<Vec<f64>> {
        let order = ar.len();
        if order == 0 || order > 2 * MOST_ROOTS || !order.is_multiple_of(2) {
            return None;
        }
        let degree = order / 2;
        let roots = |sign: f64| {
            let series = half(ar, sign);
            Arch::new().dispatch(Roots { series: &series, degree, cosines: &self.cosines })
        };
        // They take turns.
        let (first, second) = (roots(1.0)?, roots(-1.0)?);
        let mut lsf = Vec::with_capacity(order);
        for (a, b) in first.iter().zip(&second).take(degree) {
            lsf.extend([*a, *b]);
        }
        lsf.windows(2).all(|w| w[0] < w[1]).then_some(lsf)
    }
}

/// The angles at which a sum of cosines vanishes, the first as many as its degree, if there are so many; rising.
struct Roots<'a> {
    series: &'a Series,
    degree: usize,
    cosines: &'a Cosines,
}

/// A number for each root.
type OfRoots = [f64; MOST_ROOTS];

/// Cosines on both sides of each root, and the values there.
struct Brackets {
    low: OfRoots,
    high: OfRoots,
    f_low: OfRoots,
    f_high: OfRoots,
}

impl WithSimd for Roots<'_> {
    type Output = Option<OfRoots>;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { series, degree, cosines } = self;
        let mut brackets = bracket(series, degree, cosines)?;
        // As many vectors as roots need, a number known when compiling, so that they stay in registers.
        let is_found = match degree.div_ceil(S::F64_LANES) {
            0..=2 => narrow::<S, 2>(simd, series, degree, &mut brackets),
            3 => narrow::<S, 3>(simd, series, degree, &mut brackets),
            4 => narrow::<S, 4>(simd, series, degree, &mut brackets),
            5..=8 => narrow::<S, 8>(simd, series, degree, &mut brackets),
            _ => narrow::<S, MOST_ROOTS>(simd, series, degree, &mut brackets),
        };
        let mut angles = brackets.high;
        for angle in &mut angles {
            *angle = arc_cosine(*angle);
        }
        is_found.then_some(angles)
    }
}

/// The places of the grid between which a sum of cosines changes its sign, if there are as many as its degree; the first
/// again where there is room for more.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn bracket(series: &Series, degree: usize, cosines: &Cosines) -> Option<Brackets> {
    let mut sums = [[0.0; HALF]; 2];
    for k in 0..=degree {
        let sum = &mut sums[k % 2];
        for i in 0..HALF {
            sum[i] += series[k] * cosines[k][i];
        }
    }
    let [even, odd] = &sums;
    let mut values = [0.0; N_GRID];
    for i in 0..HALF {
        (values[i], values[N_GRID - 1 - i]) = (even[i] + odd[i], even[i] - odd[i]);
    }
    // A bit for each value below zero; bits that differ from the next are changes.
    let (mut lower, mut upper) = (0_u64, 0_u64);
    for i in (0..HALF).rev() {
        lower = 2 * lower + (values[i].to_bits() >> 63);
        upper = 2 * upper + (values[HALF + i].to_bits() >> 63);
    }
    let signs = u128::from(lower) | u128::from(upper) << HALF;
    let mut changes = (signs ^ (signs >> 1)) & ((1 << (N_GRID - 1)) - 1);
    if changes.count_ones() as usize != degree {
        return None;
    }
    let cosine = |i: usize| if i < HALF { cosines[1][i] } else { -cosines[1][N_GRID - 1 - i] };
    let zeros = [0.0; MOST_ROOTS];
    let mut brackets = Brackets { low: zeros, high: zeros, f_low: zeros, f_high: zeros };
    let first = changes.trailing_zeros() as usize;
    for root in 0..MOST_ROOTS {
        let i = if changes == 0 { first } else { changes.trailing_zeros() as usize };
        changes &= changes.wrapping_sub(1);
        (brackets.low[root], brackets.f_low[root]) = (cosine(i), values[i]);
        (brackets.high[root], brackets.f_high[root]) = (cosine(i + 1), values[i + 1]);
    }
    Some(brackets)
}

/// Moves the high ends of the first `V` vectors of brackets to their roots, by the false position; whether that was done.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn narrow<S: Simd, const V: usize>(simd: S, series: &Series, degree: usize, brackets: &mut Brackets) -> bool {
    let zero = simd.splat_f64s(0.0);
    let [mut low, mut f_low] = [vectors::<S, V>(simd, &brackets.low), vectors(simd, &brackets.f_low)];
    let [mut high, mut f_high] = [vectors::<S, V>(simd, &brackets.high), vectors(simd, &brackets.f_high)];
    let [half, one, small, least] =
        [0.5, 1.0, SMALL_STEP, f64::MIN_POSITIVE].map(|value| simd.splat_f64s(value));
    for _ in 0..MOST_STEPS {
        let [mut x, mut n_small] = [[zero; V], [zero; V]];
        for v in 0..V {
            let slope = simd.div_f64s(simd.sub_f64s(high[v], low[v]), simd.sub_f64s(f_high[v], f_low[v]));
            let step = simd.mul_f64s(f_high[v], slope);
            x[v] = simd.sub_f64s(high[v], step);
            let is_small = simd.less_than_f64s(simd.abs_f64s(step), small);
            n_small[v] = simd.select_f64s(is_small, one, zero);
        }
        let f = clenshaw(simd, series, degree, &x);
        for v in 0..V {
            // The Illinois rule: the end that stays counts half, so that it does not stay for ever.
            let crosses = simd.less_than_f64s(simd.mul_f64s(f[v], f_high[v]), zero);
            low[v] = simd.select_f64s(crosses, high[v], low[v]);
            f_low[v] = simd.select_f64s(crosses, f_high[v], simd.mul_f64s(half, f_low[v]));
            high[v] = x[v];
            // At a root to the last bit both ends would have no difference to divide by.
            f_high[v] = simd.add_f64s(f[v], least);
        }
        let mut n = zero;
        for count in n_small {
            n = simd.add_f64s(n, count);
        }
        if simd.reduce_sum_f64s(n) as usize == V * S::F64_LANES {
            for (to, high) in S::as_mut_simd_f64s(&mut brackets.high).0.iter_mut().zip(high) {
                *to = high;
            }
            return true;
        }
    }
    false
}

/// Half of the symmetric (`sign` 1) or antisymmetric (-1) polynomial without its root at -1 or 1.
fn half(ar: &[f64], sign: f64) -> Series {
    let order = ar.len();
    let m = order / 2;
    let mut series = [0.0; MOST_ROOTS + 1];
    // A ± z^-(p+1) A(1/z), divided by 1 ± z^-1: its coefficients up to the middle one, which is the first of the series.
    let mut before = 1.0;
    series[m] = 2.0;
    for i in 1..=m {
        before = ar[i - 1] + sign * ar[order - i] - sign * before;
        series[m - i] = 2.0 * before;
    }
    series[0] *= 0.5;
    series
}

/// The first `V` vectors.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn vectors<S: Simd, const V: usize>(simd: S, of: &OfRoots) -> [S::f64s; V] {
    let mut vectors = [simd.splat_f64s(0.0); V];
    for (to, from) in vectors.iter_mut().zip(S::as_simd_f64s(of).0) {
        *to = *from;
    }
    vectors
}

/// The sum of cosines at each cosine, by Clenshaw's recurrence.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn clenshaw<S: Simd, const V: usize>(
    simd: S,
    series: &Series,
    degree: usize,
    x: &[S::f64s; V],
) -> [S::f64s; V] {
    let [mut b1, mut b2] = [[simd.splat_f64s(0.0); V]; 2];
    let mut twice = *x;
    for x in &mut twice {
        *x = simd.add_f64s(*x, *x);
    }
    for k in (1..=degree).rev() {
        let c = simd.splat_f64s(series[k]);
        for v in 0..V {
            let b = simd.mul_add_e_f64s(twice[v], b1[v], simd.sub_f64s(c, b2[v]));
            b2[v] = b1[v];
            b1[v] = b;
        }
    }
    let c = simd.splat_f64s(series[0]);
    for v in 0..V {
        b1[v] = simd.mul_add_e_f64s(x[v], b1[v], simd.sub_f64s(c, b2[v]));
    }
    b1
}

#[cfg(test)]
mod tests {
    use super::{QuickLsf, Roots, half};
    use crate::ar::power_gain;
    use crate::lsf::lsf_from_ar;
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, prop_assume, proptest};
    use pulp::{Arch, Scalar, Simd};

    fn predictor(reflections: &[f64]) -> Vec<f64> {
        let mut ar: Vec<f64> = Vec::new();
        for k in reflections {
            let before = ar.clone();
            for (j, a) in ar.iter_mut().enumerate() {
                *a += k * before[before.len() - 1 - j];
            }
            ar.push(*k);
        }
        ar
    }

    proptest! {
        #[test]
        fn agrees_with_the_careful_search(reflections in prop::collection::vec(-0.97_f64..0.97, 1..33)) {
            let ar = predictor(&reflections);
            // Resonances of 90 dB: with more of them the digits of the coefficients do not always say that it is stable.
            prop_assume!(power_gain(&ar) < 1e9);
            let (quick, careful) = (QuickLsf::new().of(&ar).unwrap(), lsf_from_ar(&ar).unwrap());
            prop_assert_eq!(quick.len(), careful.len());
            for (a, b) in quick.iter().zip(&careful) {
                // Near 0 and π an angle has half the digits of its cosine.
                prop_assert!((a - b).abs() < 1e-6, "{} for {}", a, b);
            }
        }
    }

    #[test]
    fn machines_without_vectors_find_the_same() {
        let quick = QuickLsf::new();
        for order in [2, 14, 20, 26, 32] {
            let ar = predictor(&(0..order).map(|i| 0.8 * f64::from(i).sin()).collect::<Vec<_>>());
            for sign in [1.0, -1.0] {
                let series = half(&ar, sign);
                let roots = || Roots { series: &series, degree: ar.len() / 2, cosines: &quick.cosines };
                let here = Arch::new().dispatch(roots()).unwrap();
                let anywhere = Scalar::new().vectorize(roots()).unwrap();
                for (a, b) in here.iter().zip(&anywhere).take(ar.len() / 2) {
                    assert!((a - b).abs() < 1e-9, "order {order}: {a} and {b}");
                }
            }
        }
    }

    #[test]
    fn predictors_of_zeros_and_unstable_ones() {
        let zeros = QuickLsf::new().of(&[0.0; 8]).unwrap();
        for (i, w) in zeros.iter().enumerate() {
            assert!((w - std::f64::consts::PI * (i + 1) as f64 / 9.0).abs() < 1e-9);
        }
        assert_eq!(QuickLsf::new().of(&[0.0, 1.1]), None);
        assert_eq!(QuickLsf::new().of(&[]), None);
    }
}
