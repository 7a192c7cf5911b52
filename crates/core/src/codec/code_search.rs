//! Which of many fixed codes match a target.

use super::books::{Codebooks, HalfFrame, autocorrelation};
use super::encoder::convolved;
use super::{HALF_SAMPLES, NOTHING};
use crate::statistics::dot;

/// Codes that are kept.
const N_KEPT: usize = 8;
/// Codes whose energy is worked out exactly; of more, those that promise most.
const N_EXACT: usize = 64;
/// Codes that are looked at side by side: as many sums as fit the registers of a processor, and some.
const N_BLOCK: usize = 64;

/// A search among the first codes, half after half.
#[derive(Clone, Debug)]
pub(super) struct CodeSearch {
    response: HalfFrame,
    /// About the energy of each code through the response; none where all are looked at exactly.
    energies: Vec<f32>,
    scores: Vec<f32>,
    ranked: Vec<(f64, usize)>,
}

impl CodeSearch {
    pub(super) fn new(n_codes: usize) -> Self {
        let n_rough = if n_codes > N_EXACT { n_codes } else { 0 };
        Self {
            response: [0.0; HALF_SAMPLES],
            energies: vec![0.0; n_rough],
            scores: vec![0.0; n_rough],
            ranked: Vec::with_capacity(n_codes),
        }
    }

    /// Begins half a frame, whose weighted filter has this response.
    pub(super) fn begin(&mut self, books: &Codebooks, response: &HalfFrame) {
        self.response = *response;
        // Energy as if the response went on: its autocorrelation times that of the code.
        let mut shape = autocorrelation(response);
        for both_sides in &mut shape[1..] {
            *both_sides *= 2.0;
        }
        weighed(&books.correlation_columns, &shape, &mut self.energies);
    }

    /// The codes, best first, that take most of what is left of the target, out of the first `n_codes`; each with how much.
    pub(super) fn promising(
        &mut self,
        books: &Codebooks,
        n_codes: usize,
        left: &HalfFrame,
    ) -> &[(f64, usize)] {
        // What is left, filtered backwards: one product tells how well a code matches.
        let backwards: HalfFrame =
            std::array::from_fn(|i| dot(&left[i..], &self.response[..HALF_SAMPLES - i]));
        self.ranked.clear();
        if self.energies.is_empty() {
            self.ranked.extend((0..n_codes).map(|i| (0.0, i)));
        } else {
            weighed(&books.code_columns, &backwards, &mut self.scores);
            for (score, energy) in self.scores.iter_mut().zip(&self.energies) {
                *score = *score * *score / energy.max(NOTHING as f32);
            }
            self.ranked.extend(self.scores.iter().enumerate().map(|(i, score)| (f64::from(*score), i)));
            self.ranked.select_nth_unstable_by(N_EXACT - 1, best_first);
            self.ranked.truncate(N_EXACT);
        }
        for (score, code) in &mut self.ranked {
            let code = &books.codes[*code];
            let made = convolved(&self.response, code);
            *score = dot(&backwards, code).powi(2) / dot(&made, &made).max(NOTHING);
        }
        self.ranked.sort_unstable_by(best_first);
        self.ranked.truncate(N_KEPT);
        &self.ranked
    }
}

fn best_first(a: &(f64, usize), b: &(f64, usize)) -> std::cmp::Ordering {
    b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))
}

/// `Σ_j weights[j] columns[j][i]` for every `i`.
fn weighed(columns: &[Vec<f32>], weights: &HalfFrame, out: &mut [f32]) {
    for (block, out) in out.chunks_mut(N_BLOCK).enumerate() {
        let mut sums = [0.0_f32; N_BLOCK];
        for (column, weight) in columns.iter().zip(weights) {
            let weight = *weight as f32;
            for (sum, x) in sums.iter_mut().zip(&column[block * N_BLOCK..]) {
                *sum += weight * x;
            }
        }
        out.copy_from_slice(&sums[..out.len()]);
    }
}
