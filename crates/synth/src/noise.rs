//! Seeded Gaussian noise: the xoshiro256++ generator with the ziggurat method.
//!
//! Sources: D. Blackman and S. Vigna, "Scrambled linear pseudorandom number generators" (2021), for the generator; G.
//! Marsaglia and W. Tsang, "The ziggurat method" (2000), for the table.

const LAYERS: usize = 128;
/// Right edge of the lowest rectangle for 128 layers (Marsaglia and Tsang 2000).
const EDGE: f64 = 3.442_619_855_899;
/// Area of each layer for 128 layers (Marsaglia and Tsang 2000).
const AREA: f64 = 9.912_563_035_262_17e-3;

/// State of one seeded pseudorandom bit stream.
#[derive(Clone, Debug)]
pub struct Noise {
    state: [u64; 4],
}

impl Noise {
    /// A stream determined by `seed` alone; adjacent seeds give unrelated streams.
    pub fn new(seed: u64) -> Self {
        let mut counter = seed;
        let mut next = || {
            counter = counter.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = counter;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            z ^ (z >> 31)
        };
        Self { state: [next(), next(), next(), next()] }
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        let s = &mut self.state;
        let out = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        out
    }

    /// The next uniform number in (0, 1).
    pub fn uniform(&mut self) -> f64 {
        ((self.bits() >> 11) as f64 + 0.5) * (1.0 / 9_007_199_254_740_992.0)
    }
}

/// Ziggurat table of the standard normal distribution; any number of streams can share it.
#[derive(Clone, Debug)]
pub struct Gaussian {
    /// Right edge of each layer, widest first.
    edge: [f32; LAYERS + 1],
    /// Fraction of a layer that lies entirely under the density curve.
    inside: [f32; LAYERS],
    /// Height of the density curve at each edge.
    height: [f32; LAYERS + 1],
}

impl Default for Gaussian {
    fn default() -> Self {
        Self::new()
    }
}

impl Gaussian {
    /// Builds the table: about 128 logarithms and exponentials, once.
    pub fn new() -> Self {
        let density = |x: f64| libm::exp(-0.5 * x * x);
        let mut x = [0.0_f64; LAYERS + 1];
        x[0] = AREA / density(EDGE);
        x[1] = EDGE;
        for i in 2..LAYERS {
            x[i] = libm::sqrt(-2.0 * libm::log(AREA / x[i - 1] + density(x[i - 1])));
        }
        Self {
            edge: core::array::from_fn(|i| x[i] as f32),
            inside: core::array::from_fn(|i| (x[i + 1] / x[i]) as f32),
            height: core::array::from_fn(|i| density(x[i]) as f32),
        }
    }

    /// The next value of a standard normal distribution.
    ///
    /// Rejection sampling ends with probability one; fewer than one draw in a million needs more than three rounds. The
    /// rounds are bounded at 64 nevertheless, because no loop in the callback may be unbounded.
    #[inline]
    pub fn draw(&self, noise: &mut Noise) -> f32 {
        for _ in 0..64 {
            let bits = noise.bits();
            let layer = (bits & (LAYERS as u64 - 1)) as usize;
            // The top 24 bits as a signed fraction of the layer, in -1..1 and never exactly 0.
            let share = (((bits >> 40) as i32) - (1 << 23)) as f32 * (1.0 / (1 << 23) as f32)
                + (0.5 / (1 << 23) as f32);
            let x = share * self.edge[layer];
            if share.abs() < self.inside[layer] {
                return x;
            }
            if layer == 0 {
                return tail(noise, share < 0.0);
            }
            let (low, high) = (self.height[layer], self.height[layer + 1]);
            if low + noise.uniform() as f32 * (high - low) < libm::expf(-0.5 * x * x) {
                return x;
            }
        }
        0.0
    }
}

/// A value beyond the widest rectangle (Marsaglia 1964).
fn tail(noise: &mut Noise, negative: bool) -> f32 {
    for _ in 0..64 {
        let x = -libm::log(noise.uniform()) / EDGE;
        let y = -libm::log(noise.uniform());
        if y + y >= x * x {
            let value = (EDGE + x) as f32;
            return if negative { -value } else { value };
        }
    }
    EDGE as f32
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{EDGE, Gaussian, Noise};
    use std::vec::Vec;

    fn draws(seed: u64, n: usize) -> Vec<f64> {
        let (table, mut noise) = (Gaussian::new(), Noise::new(seed));
        (0..n).map(|_| f64::from(table.draw(&mut noise))).collect()
    }

    #[test]
    fn moments_are_those_of_a_normal_distribution() {
        let n = 2_000_000;
        let x = draws(1, n);
        let moment = |k: i32| x.iter().map(|v| v.powi(k)).sum::<f64>() / n as f64;
        // The bound is five standard errors of each sample moment: sqrt(var(x^k)/n).
        let bound = |variance: f64| 5.0 * (variance / n as f64).sqrt();
        assert!(moment(1).abs() < bound(1.0));
        assert!((moment(2) - 1.0).abs() < bound(2.0));
        assert!(moment(3).abs() < bound(15.0));
        assert!((moment(4) - 3.0).abs() < bound(96.0));
    }

    #[test]
    fn shares_under_the_curve_match_the_error_function() {
        let n = 2_000_000;
        let x = draws(2, n);
        // P(|x| > t) of the standard normal distribution, from the closed form erfc(t/sqrt 2).
        for (t, p) in
            [(0.5, 0.617_075), (1.0, 0.317_311), (2.0, 0.045_500_3), (3.0, 0.002_699_8), (EDGE, 0.000_576_07)]
        {
            let share = x.iter().filter(|v| v.abs() > t).count() as f64 / n as f64;
            let bound = 5.0 * (p * (1.0 - p) / n as f64).sqrt();
            assert!((share - p).abs() < bound, "|x| > {t}: {share} for {p}");
        }
    }

    #[test]
    fn same_seed_same_stream_and_white() {
        assert_eq!(draws(7, 100), draws(7, 100));
        assert_ne!(draws(7, 100), draws(8, 100));
        let n = 200_000;
        let x = draws(3, n);
        for lag in 1..20 {
            let r = x.windows(lag + 1).map(|w| w[0] * w[lag]).sum::<f64>() / n as f64;
            assert!(r.abs() < 5.0 / (n as f64).sqrt(), "lag {lag}: {r}");
        }
    }
}
