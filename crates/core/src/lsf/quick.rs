//! Line spectral frequencies for where thousands of predictors are converted a second.

use crate::lsf::lsf_from_ar;

/// Angles at which signs are looked for; closer pairs are left to the careful search.
const N_GRID: usize = 160;
/// Most roots of one half polynomial: half the highest order, rounded up.
const LANES: usize = 16;
/// Steps of the false position: each narrows a bracket by more than half, and the last ones square the error.
const N_STEPS: usize = 12;

/// The frequencies of [`lsf_from_ar`] to about 1e-10 radians, several times as fast: signs are looked for on a coarse grid,
/// and all brackets are narrowed at once. What the grid does not resolve goes to the careful search.
#[derive(Clone, Debug)]
pub(crate) struct QuickLsf {
    /// Cosines of the grid, falling.
    cosines: Vec<f64>,
}

impl QuickLsf {
    /// The grid.
    pub(crate) fn new() -> Self {
        let cosine = |i: usize| (std::f64::consts::PI * i as f64 / N_GRID as f64).cos();
        Self { cosines: (0..=N_GRID).map(cosine).collect() }
    }

    /// The frequencies of a predictor, or `None` where it is not stable.
    pub(crate) fn of(&self, ar: &[f64]) -> Option<Vec<f64>> {
        self.quickly(ar).or_else(|| lsf_from_ar(ar))
    }

    fn quickly(&self, ar: &[f64]) -> Option<Vec<f64>> {
        let order = ar.len();
        if order == 0 || order > 2 * LANES || !order.is_multiple_of(2) {
            return None;
        }
        let mut lsf = self.roots(&half(ar, 1.0))?;
        lsf.extend(self.roots(&half(ar, -1.0))?);
        lsf.sort_by(f64::total_cmp);
        Some(lsf)
    }

    /// The angles at which a sum of cosines vanishes, if there are as many as its degree.
    fn roots(&self, series: &[f64]) -> Option<Vec<f64>> {
        let degree = series.len() - 1;
        let values = clenshaw_many(series, &self.cosines);
        let (mut low, mut high) = ([0.0; LANES], [0.0; LANES]);
        let (mut f_low, mut f_high) = ([1.0; LANES], [-1.0; LANES]);
        let mut n = 0;
        for (x, f) in self.cosines.windows(2).zip(values.windows(2)) {
            if f[0] * f[1] < 0.0 {
                if n == degree {
                    return None;
                }
                (low[n], high[n], f_low[n], f_high[n]) = (x[0], x[1], f[0], f[1]);
                n += 1;
            }
        }
        if n != degree {
            return None;
        }
        for _ in 0..N_STEPS {
            let mut x = [0.0; LANES];
            for i in 0..LANES {
                x[i] = high[i] - f_high[i] * (high[i] - low[i]) / (f_high[i] - f_low[i]);
            }
            let f = clenshaw(series, &x);
            for i in 0..LANES {
                // The Illinois rule: the end that stays counts half, so that it does not stay for ever.
                let crosses = f[i] * f_high[i] < 0.0;
                low[i] = if crosses { high[i] } else { low[i] };
                f_low[i] = if crosses { f_high[i] } else { 0.5 * f_low[i] };
                high[i] = x[i];
                // A value of zero ends the search: both ends would be the same.
                f_high[i] = if f[i] == 0.0 { f64::MIN_POSITIVE.copysign(-f_low[i]) } else { f[i] };
            }
        }
        Some(high[..degree].iter().map(|x| x.clamp(-1.0, 1.0).acos()).collect())
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

fn clenshaw_many(series: &[f64], x: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(x.len());
    let (chunks, rest) = x.as_chunks::<LANES>();
    for chunk in chunks {
        out.extend(clenshaw(series, chunk));
    }
    out.extend(rest.iter().map(|x| clenshaw(series, &[*x])[0]));
    out
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
                prop_assert!((a - b).abs() < 1e-7, "{} for {}", a, b);
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
