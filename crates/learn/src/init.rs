//! Random initial weights of networks, by seed.

use shagreen_core::maths::rng::Random;

/// Draws from uniform distributions around zero.
#[derive(Clone, Debug)]
pub(crate) struct Uniform {
    random: Random,
}

impl Uniform {
    pub(crate) fn new(seed: u64) -> Self {
        Self { random: Random::new(seed) }
    }

    /// Returns `n` numbers, uniform in `-limit..limit`.
    pub(crate) fn within(&mut self, limit: f32, n: usize) -> Vec<f32> {
        (0..n).map(|_| limit * (2.0 * self.random.uniform() - 1.0) as f32).collect()
    }

    /// Returns `n` Glorot-uniform weights for this fan-in and fan-out (X. Glorot and Y. Bengio 2010, equation 16).
    pub(crate) fn glorot(&mut self, n_inputs: usize, n_outputs: usize, n: usize) -> Vec<f32> {
        self.within((6.0 / (n_inputs + n_outputs) as f32).sqrt(), n)
    }
}
