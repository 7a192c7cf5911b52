//! Line spectral frequencies for where thousands of predictors are converted a second.

use pulp::{Arch, Simd, WithSimd};

use crate::lsf::lsf_from_ar;

/// Angles at which signs are looked for, so many at once: what they do not tell apart is left to the careful search.
const N_GRID: usize = 96;
const AT_ONCE: usize = 16;
/// Most roots of one half polynomial: half the highest order.
const MOST_ROOTS: usize = 16;
/// Most steps of the false position: the first ones narrow a bracket, the last ones square the error. A handful is usual.
const MOST_STEPS: usize = 30;
/// A step of all cosines below this is the last: the next one would be its square, about.
const SMALL_STEP: f64 = 1e-8;

/// The frequencies of [`lsf_from_ar`] to 1e-6 radians, many times as fast: signs are looked for on a coarse grid, and
/// all brackets are narrowed at once. What the grid does not tell apart goes to the careful search.
#[derive(Clone, Debug)]
pub(crate) struct QuickLsf {
    /// Cosines of the grid, falling.
    cosines: [[f64; AT_ONCE]; N_GRID / AT_ONCE],
}

impl QuickLsf {
    /// The grid.
    pub(crate) fn new() -> Self {
        let cosine = |i: usize| (std::f64::consts::PI * i as f64 / (N_GRID - 1) as f64).cos();
        Self { cosines: std::array::from_fn(|i| std::array::from_fn(|j| cosine(i * AT_ONCE + j))) }
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
        // Known numbers of roots side by side keep them in registers.
        match order / 2 {
            0..=8 => self.angles::<8>(ar),
            9..=12 => self.angles::<12>(ar),
            _ => self.angles::<MOST_ROOTS>(ar),
        }
    }

    /// The angles of all roots, which take turns between the two half polynomials.
    fn angles<const N: usize>(&self, ar: &[f64]) -> Option<Vec<f64>> {
        let roots = |sign: f64| {
            let series = half(ar, sign);
            Arch::new().dispatch(Roots::<N> { series: &series, grid: &self.cosines })
        };
        let (first, second) = (roots(1.0)?, roots(-1.0)?);
        let mut lsf = Vec::with_capacity(ar.len());
        for (a, b) in first.iter().zip(&second).take(ar.len() / 2) {
            lsf.extend([a, b].map(|x| x.clamp(-1.0, 1.0).acos()));
        }
        lsf.windows(2).all(|w| w[0] < w[1]).then_some(lsf)
    }
}

/// The cosines at which a sum of cosines vanishes, the first as many as its degree, if there are so many; falling.
struct Roots<'a, const N: usize> {
    series: &'a [f64],
    grid: &'a [[f64; AT_ONCE]; N_GRID / AT_ONCE],
}

impl<const N: usize> WithSimd for Roots<'_, N> {
    type Output = Option<[f64; N]>;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { series, grid } = self;
        let degree = series.len() - 1;
        let (mut low, mut high) = ([0.0; N], [1.0; N]);
        let (mut f_low, mut f_high) = ([-1.0; N], [1.0; N]);
        let mut n = 0;
        let (mut x_before, mut f_before) = (1.0, 0.0);
        for x in grid {
            let f = clenshaw(series, x);
            for (x, f) in x.iter().zip(f) {
                if f_before * f < 0.0 {
                    if n == degree {
                        return None;
                    }
                    (low[n], high[n], f_low[n], f_high[n]) = (x_before, *x, f_before, f);
                    n += 1;
                }
                (x_before, f_before) = (*x, f);
            }
        }
        if n != degree {
            return None;
        }
        // Places that are left over do as the first.
        for i in degree..N {
            (low[i], high[i], f_low[i], f_high[i]) = (low[0], high[0], f_low[0], f_high[0]);
        }
        for _ in 0..MOST_STEPS {
            let mut x = [0.0; N];
            for i in 0..N {
                x[i] = high[i] - f_high[i] * (high[i] - low[i]) / (f_high[i] - f_low[i]);
            }
            let f = clenshaw(series, &x);
            let mut step = 0.0_f64;
            for i in 0..N {
                step = step.max((x[i] - high[i]).abs());
                // The Illinois rule: the end that stays counts half, so that it does not stay for ever.
                let crosses = f[i] * f_high[i] < 0.0;
                low[i] = if crosses { high[i] } else { low[i] };
                f_low[i] = if crosses { f_high[i] } else { 0.5 * f_low[i] };
                high[i] = x[i];
                // At a root to the last bit both ends would have no difference to divide by.
                f_high[i] = if f[i] == 0.0 { f64::MIN_POSITIVE.copysign(-f_low[i]) } else { f[i] };
            }
            if step < SMALL_STEP {
                return Some(high);
            }
        }
        None
    }
}

/// Half of the symmetric (`sign` 1) or antisymmetric (-1) polynomial without its root at -1 or 1, as a sum of cosines
/// `Σ c_k cos kω`.
fn half(ar: &[f64], sign: f64) -> Vec<f64> {
    let order = ar.len();
    let m = order / 2;
    let a_at = |i: usize| if i == 0 { 1.0 } else { ar.get(i - 1).copied().unwrap_or(0.0) };
    // A ± z^-(p+1) A(1/z), divided by 1 ± z^-1: its coefficients up to the middle one.
    let mut divided = Vec::with_capacity(m + 1);
    let mut before = 0.0;
    for i in 0..=m {
        before = a_at(i) + sign * a_at(order + 1 - i) - sign * before;
        divided.push(before);
    }
    (0..=m).map(|k| if k == 0 { divided[m] } else { 2.0 * divided[m - k] }).collect()
}

/// The sum of cosines at each cosine.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn clenshaw<const N: usize>(series: &[f64], x: &[f64; N]) -> [f64; N] {
    let (mut b1, mut b2) = ([0.0; N], [0.0; N]);
    for c in series[1..].iter().rev() {
        for i in 0..N {
            let b = c + 2.0 * x[i] * b1[i] - b2[i];
            (b2[i], b1[i]) = (b1[i], b);
        }
    }
    std::array::from_fn(|i| series[0] + x[i] * b1[i] - b2[i])
}

#[cfg(test)]
mod tests {
    use super::QuickLsf;
    use crate::lsf::lsf_from_ar;
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

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
            let (quick, careful) = (QuickLsf::new().of(&ar).unwrap(), lsf_from_ar(&ar).unwrap());
            prop_assert_eq!(quick.len(), careful.len());
            for (a, b) in quick.iter().zip(&careful) {
                // Near 0 and π an angle has half the digits of its cosine.
                prop_assert!((a - b).abs() < 1e-6, "{} for {}", a, b);
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
