//! Search of the fixed codebook for entries that match a target.

use pulp::{Arch, Simd, WithSimd};

use super::books::{Block, Codebooks, HalfFrame, N_BLOCK, autocorrelation};
use super::{HALF_SAMPLES, NOTHING};
use crate::maths::statistics::dot;

/// Number of candidates kept.
const N_KEPT: usize = 8;
/// Number of candidates evaluated exactly; larger codebooks are preselected to this many.
const N_EXACT: usize = 32;

/// Codes per preselection group; only the highest score of a group is tracked.
const N_GROUP: usize = 16;

/// Search over the first codes of the codebook, one subframe after another.
#[derive(Clone, Debug)]
pub(super) struct CodeSearch {
    response: HalfFrame,
    /// Correlation matrix of the impulse response: a code's filtered energy is `Σ_ij c_i products[i][j] c_j`.
    products: [HalfFrame; HALF_SAMPLES],
    /// Approximate filtered energy of each code; empty if all codes are evaluated exactly.
    energies: Vec<f32>,
    scores: Vec<f32>,
    /// Highest score of each group; a group takes every n-th code, where n is the number of groups.
    highest: Vec<f32>,
    /// Copy of `highest` for partial sorting.
    ordered: Vec<f32>,
    ranked: Vec<(f64, usize)>,
}

impl CodeSearch {
    pub(super) fn new(n_codes: usize) -> Self {
        let n_rough = if n_codes > N_EXACT { n_codes } else { 0 };
        Self {
            response: [0.0; HALF_SAMPLES],
            products: [[0.0; HALF_SAMPLES]; HALF_SAMPLES],
            energies: vec![0.0; n_rough],
            scores: vec![0.0; n_rough],
            highest: vec![0.0; n_rough.div_ceil(N_GROUP)],
            ordered: Vec::new(),
            ranked: Vec::with_capacity(n_codes),
        }
    }

    /// Starts a subframe whose weighted synthesis filter has this impulse response.
    pub(super) fn begin(&mut self, books: &Codebooks, response: &HalfFrame) {
        self.response = *response;
        // Later pairs of code samples overlap less before the end of the subframe.
        for lag in 0..HALF_SAMPLES {
            let mut sum = 0.0;
            for n in 0..HALF_SAMPLES - lag {
                sum += response[n] * response[n + lag];
                let late = HALF_SAMPLES - 1 - n;
                (self.products[late - lag][late], self.products[late][late - lag]) = (sum, sum);
            }
        }
        // Energy as if the response were not truncated: autocorrelation of the response times that of the code.
        let mut shape = autocorrelation(response);
        for both_sides in &mut shape[1..] {
            *both_sides *= 2.0;
        }
        let blocks = &books.correlation_blocks;
        Arch::new().dispatch(Weighed { blocks, weights: &shape, out: &mut self.energies });
    }

    /// Returns the best codes of the first `n_codes`, best first, each with the target energy that it explains.
    pub(super) fn promising(
        &mut self,
        books: &Codebooks,
        n_codes: usize,
        left: &HalfFrame,
    ) -> &[(f64, usize)] {
        // Backward-filtered target: one inner product per code gives its correlation with the target.
        let backwards: HalfFrame =
            std::array::from_fn(|i| dot(&left[i..], &self.response[..HALF_SAMPLES - i]));
        self.ranked.clear();
        if self.energies.is_empty() {
            self.ranked.extend((0..n_codes).map(|i| (0.0, i)));
        } else {
            Arch::new().dispatch(Roughly { search: self, blocks: &books.code_blocks, backwards: &backwards });
        }
        let Self { products, ranked, .. } = self;
        Arch::new().dispatch(Exactly { codes: &books.codes, products, backwards: &backwards, ranked });
        keep_best(&mut self.ranked, N_KEPT);
        self.ranked.sort_unstable_by(best_first);
        &self.ranked
    }
}

fn best_first(a: &(f64, usize), b: &(f64, usize)) -> std::cmp::Ordering {
    b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))
}

fn keep_best(ranked: &mut Vec<(f64, usize)>, n_kept: usize) {
    if ranked.len() > n_kept {
        ranked.select_nth_unstable_by(n_kept - 1, best_first);
        ranked.truncate(n_kept);
    }
}

/// Computes `Σ_j weights[j] rows[i][j]` for every `i`.
struct Weighed<'a> {
    blocks: &'a [Block],
    weights: &'a HalfFrame,
    out: &'a mut [f32],
}

/// Preselects the codes with the highest approximate scores.
struct Roughly<'a> {
    search: &'a mut CodeSearch,
    blocks: &'a [Block],
    backwards: &'a HalfFrame,
}

/// Computes the exact score of each ranked code.
struct Exactly<'a> {
    codes: &'a [HalfFrame],
    products: &'a [HalfFrame; HALF_SAMPLES],
    backwards: &'a HalfFrame,
    ranked: &'a mut [(f64, usize)],
}

impl WithSimd for Weighed<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { blocks, weights, out } = self;
        for (block, out) in blocks.iter().zip(out.chunks_mut(N_BLOCK)) {
            let mut sums = [0.0_f32; N_BLOCK];
            for (column, weight) in block.iter().zip(weights) {
                let weight = *weight as f32;
                for (sum, x) in sums.iter_mut().zip(column) {
                    *sum += weight * x;
                }
            }
            out.copy_from_slice(&sums[..out.len()]);
        }
    }
}

impl WithSimd for Roughly<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, simd: S) {
        let CodeSearch { energies, scores, highest, ordered, ranked, .. } = self.search;
        Weighed { blocks: self.blocks, weights: self.backwards, out: scores }.with_simd(simd);
        for (score, energy) in scores.iter_mut().zip(energies) {
            // A NaN score becomes 0.
            *score = (*score * *score / energy.max(NOTHING as f32)).max(0.0);
        }
        let n_groups = highest.len();
        highest.fill(0.0);
        for row in scores.chunks(n_groups) {
            for (highest, score) in highest.iter_mut().zip(row) {
                *highest = if *score > *highest { *score } else { *highest };
            }
        }
        // At least [`N_EXACT`] groups reach this score, so no code below it is among the best.
        let mut least = 0.0;
        if n_groups > N_EXACT {
            ordered.clone_from(highest);
            least = *ordered.select_nth_unstable_by(N_EXACT - 1, |a, b| b.total_cmp(a)).1;
        }
        for (group, _) in highest.iter().enumerate().filter(|(_, highest)| **highest >= least) {
            for i in (group..scores.len()).step_by(n_groups) {
                if scores[i] >= least {
                    ranked.push((f64::from(scores[i]), i));
                }
            }
        }
        keep_best(ranked, N_EXACT);
    }
}

impl WithSimd for Exactly<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        for (score, code) in self.ranked {
            let code = &self.codes[*code];
            // Column by column, so that the sums vectorize.
            let mut filtered = [0.0; HALF_SAMPLES];
            for (c, row) in code.iter().zip(self.products) {
                for (sum, product) in filtered.iter_mut().zip(row) {
                    *sum += c * product;
                }
            }
            let (mut energy, mut alike) = (0.0, 0.0);
            for ((c, f), b) in code.iter().zip(&filtered).zip(self.backwards) {
                energy += c * f;
                alike += c * b;
            }
            *score = alike * alike / energy.max(NOTHING);
        }
    }
}
