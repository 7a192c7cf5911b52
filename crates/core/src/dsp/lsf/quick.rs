//! Fast line spectral frequencies, for thousands of conversions per second.

use pulp::{Arch, Simd, WithSimd};

use crate::dsp::lsf::arc_cosine::arc_cosine;
use crate::dsp::lsf::lsf_from_ar;

/// Number of grid angles for the sign search. Roots that the grid does not separate are left to [`lsf_from_ar`].
const N_GRID: usize = 96;
/// The upper half of the grid has the cosines of the lower half with opposite sign; the same holds for odd multiples.
const HALF: usize = N_GRID / 2;
/// Maximum number of roots of a half polynomial: half of the highest order that is converted quickly. Higher ones are left
/// to [`lsf_from_ar`].
const MOST_ROOTS: usize = 16;
/// Maximum number of false-position steps. Early steps narrow a bracket, later steps square the error; about five are
/// usual.
const MOST_STEPS: usize = 30;
/// Step size in the cosine below which the iteration stops; the next step would be about its square.
const SMALL_STEP: f64 = 1e-8;

/// Cosine series `Σ c_k cos kω`.
type Series = [f64; MOST_ROOTS + 1];
/// `cos kω` on the lower half of the grid, for each `k`.
type Cosines = [[f64; HALF]; MOST_ROOTS + 1];

/// Fast version of [`lsf_from_ar`] with an error below 1e-6 radians. It searches signs on a coarse grid and narrows all
/// brackets in parallel. Predictors whose roots the grid does not separate fall back to [`lsf_from_ar`].
#[derive(Clone, Debug)]
pub(crate) struct FastLsf {
    cosines: Box<Cosines>,
}

impl FastLsf {
    /// Precomputes the cosines of the grid.
    pub(crate) fn new() -> Self {
        let cosine = |k: usize, i: usize| (std::f64::consts::PI * (k * i) as f64 / (N_GRID - 1) as f64).cos();
        Self { cosines: Box::new(std::array::from_fn(|k| std::array::from_fn(|i| cosine(k, i)))) }
    }

    /// Line spectral frequencies of a predictor; `None` if it is unstable.
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
        // The roots of the two polynomials alternate.
        let (first, second) = (roots(1.0)?, roots(-1.0)?);
        let mut lsf = Vec::with_capacity(order);
        for (a, b) in first.iter().zip(&second).take(degree) {
            lsf.extend([*a, *b]);
        }
        lsf.windows(2).all(|w| w[0] < w[1]).then_some(lsf)
    }
}

/// Ascending angles of the roots of a cosine series; the first `degree` entries are valid. `None` if fewer are found.
struct Roots<'a> {
    series: &'a Series,
    degree: usize,
    cosines: &'a Cosines,
}

/// One number for each root.
type OfRoots = [f64; MOST_ROOTS];

/// Cosines on both sides of each root, and the series values there.
struct Brackets {
    low: OfRoots,
    high: OfRoots,
    f_low: OfRoots,
    f_high: OfRoots,
}

impl WithSimd for Roots<'_> {
    type Output = Option<OfRoots>;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { series, degree, cosines } = self;
        let mut brackets = bracket(series, degree, cosines)?;
        // The number of vectors is a compile-time constant, so that they stay in registers.
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

/// Grid intervals in which a cosine series changes sign; `None` if their number differs from its degree. Unused entries
/// repeat the first interval.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
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
    // One bit for each negative value; a bit that differs from the next one is a sign change.
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

/// Moves the high ends of the first `V` vectors of brackets to their roots by false position; returns whether all
/// converged.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
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
            // Illinois algorithm: the function value at a retained end is halved, so that this end does not stay
            // forever.
            let crosses = simd.less_than_f64s(simd.mul_f64s(f[v], f_high[v]), zero);
            low[v] = simd.select_f64s(crosses, high[v], low[v]);
            f_low[v] = simd.select_f64s(crosses, f_high[v], simd.mul_f64s(half, f_low[v]));
            high[v] = x[v];
            // Avoids a zero difference in the denominator when a root is exact to the last bit.
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

/// Half of the symmetric (`sign` 1) or antisymmetric (-1) polynomial, divided by its root at -1 or 1.
fn half(ar: &[f64], sign: f64) -> Series {
    let order = ar.len();
    let m = order / 2;
    let mut series = [0.0; MOST_ROOTS + 1];
    // A ± z^-(p+1) A(1/z), divided by 1 ± z^-1: coefficients up to the middle one, which is the first of the series.
    let mut before = 1.0;
    series[m] = 2.0;
    for i in 1..=m {
        before = ar[i - 1] + sign * ar[order - i] - sign * before;
        series[m - i] = 2.0 * before;
    }
    series[0] *= 0.5;
    series
}

/// First `V` vectors of `of`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
fn vectors<S: Simd, const V: usize>(simd: S, of: &OfRoots) -> [S::f64s; V] {
    let mut vectors = [simd.splat_f64s(0.0); V];
    for (to, from) in vectors.iter_mut().zip(S::as_simd_f64s(of).0) {
        *to = *from;
    }
    vectors
}

/// Cosine series at each cosine, by Clenshaw's recurrence.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
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
    use super::{FastLsf, Roots, half};
    use crate::dsp::ar::power_gain;
    use crate::dsp::lsf::lsf_from_ar;
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
            // Resonances of up to 90 dB: beyond that, the digits of the coefficients do not always determine stability.
            prop_assume!(power_gain(&ar) < 1e9);
            let (quick, careful) = (FastLsf::new().of(&ar).unwrap(), lsf_from_ar(&ar).unwrap());
            prop_assert_eq!(quick.len(), careful.len());
            for (a, b) in quick.iter().zip(&careful) {
                // Near 0 and π an angle has half the digits of its cosine.
                prop_assert!((a - b).abs() < 1e-6, "got {}, expected {}", a, b);
            }
        }
    }

    #[test]
    fn machines_without_vectors_find_the_same() {
        let quick = FastLsf::new();
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
        let zeros = FastLsf::new().of(&[0.0; 8]).unwrap();
        for (i, w) in zeros.iter().enumerate() {
            assert!((w - std::f64::consts::PI * (i + 1) as f64 / 9.0).abs() < 1e-9);
        }
        assert_eq!(FastLsf::new().of(&[0.0, 1.1]), None);
        assert_eq!(FastLsf::new().of(&[]), None);
    }
}
