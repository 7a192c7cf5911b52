//! Voice of one texture: linear predictor, filter state, and excitation level.

pub use crate::limits::MAX_TICK;
use crate::lsf::ar_from_lsf;
use crate::moving_average::MovingAverage;
use crate::texture::{Evaluated, MAX_MA_ORDER, MAX_ORDER};

/// Number of predictor coefficients for the most recent outputs. Only these have to wait for the previous sample.
const RECENT: usize = 4;
/// The other coefficients are processed in groups of this size, so that the compiler can vectorize them.
const LANES: usize = 4;
const MAX_CHUNKS: usize = (MAX_ORDER - RECENT) / LANES;
/// Number of groups of all orders up to [`USUAL_ORDER`].
const USUAL_CHUNKS: usize = 7;
/// Number of groups of all orders up to 48.
const MIDDLE_CHUNKS: usize = 11;
/// Highest order that needs neither longer loops nor a longer memory.
const USUAL_ORDER: usize = RECENT + LANES * USUAL_CHUNKS;
/// Excitations and filter states below this magnitude are treated as silence.
const TINY_MPS2: f32 = 1e-20;
/// Linear predictor of one texture, with its filter state and excitation level.
#[derive(Clone, Debug)]
pub struct Voice {
    /// Coefficients `a_1 … a_4`.
    recent: [f32; RECENT],
    /// Coefficients `a_5 …`; each group is in reverse order, to match the order of `memory`.
    older: [[f32; LANES]; MAX_CHUNKS],
    n_chunks: usize,
    /// Last outputs, oldest first, followed by room for one tick. Those before the last [`USUAL_ORDER`] are zero while
    /// the order is not higher.
    memory: [f32; MAX_ORDER + MAX_TICK],
    sigma: f32,
    sigma_next: f32,
    moving_average: MovingAverage,
}

impl Default for Voice {
    fn default() -> Self {
        Self::new()
    }
}

impl Voice {
    /// A silent voice.
    pub fn new() -> Self {
        Self {
            recent: [0.0; RECENT],
            older: [[0.0; LANES]; MAX_CHUNKS],
            n_chunks: 0,
            memory: [0.0; MAX_ORDER + MAX_TICK],
            sigma: 0.0,
            sigma_next: 0.0,
            moving_average: MovingAverage::new(),
        }
    }

    /// Sets the model at the contact at the end of the next tick.
    pub fn aim(&mut self, order: usize, at: &Evaluated) {
        let order = order.min(MAX_ORDER);
        let mut ar = [0.0; MAX_ORDER];
        ar_from_lsf(&at.lsf[..order], &mut ar[..order]);
        self.recent.copy_from_slice(&ar[..RECENT]);
        let n_chunks = order.saturating_sub(RECENT).div_ceil(LANES);
        if (n_chunks > USUAL_CHUNKS) != (self.n_chunks > USUAL_CHUNKS) {
            self.memory[..MAX_ORDER - USUAL_ORDER].fill(0.0);
        }
        self.n_chunks = n_chunks;
        // Loops of fixed length also read groups above the order, whose coefficients are zero.
        let n_set = match n_chunks {
            n if n <= USUAL_CHUNKS => USUAL_CHUNKS,
            n if n <= MIDDLE_CHUNKS => MIDDLE_CHUNKS,
            _ => MAX_CHUNKS,
        };
        for (chunk, a) in self.older.iter_mut().zip(ar[RECENT..].chunks_exact(LANES)).take(n_set) {
            *chunk = [a[3], a[2], a[1], a[0]];
        }
        self.moving_average.aim(&at.ma_lsf[..at.ma_order.min(MAX_MA_ORDER)]);
        self.sigma = self.sigma_next;
        self.sigma_next = if at.sigma_mps2 < TINY_MPS2 { 0.0 } else { at.sigma_mps2 };
    }

    /// Adds the voice's output to `out` (at most [`MAX_TICK`] samples), multiplied by a weight that changes linearly
    /// from `weights.0` to `weights.1`. The excitation is `noise` of unit variance, of the same length.
    ///
    /// Cost per sample: as many multiply-adds as the next higher of the orders 12, 16, 20, 32, 48 and 64, of which all
    /// but four are independent of the previous sample; with a moving average, [`MAX_MA_ORDER`] more.
    #[inline]
    pub fn add_tick(&mut self, noise: &[f32], weights: (f32, f32), out: &mut [f32]) {
        let n = noise.len().min(out.len()).min(MAX_TICK);
        if n == 0 {
            return;
        }
        let sigmas = (self.sigma, self.sigma_next);
        if self.moving_average.is_empty() {
            self.add(&noise[..n], sigmas, weights, &mut out[..n]);
        } else {
            let mut driven = [0.0; MAX_TICK];
            let step = (sigmas.1 - sigmas.0) / n as f32;
            let mut sigma = sigmas.0;
            for (x, e) in driven.iter_mut().zip(&noise[..n]) {
                sigma += step;
                *x = sigma * e;
            }
            self.moving_average.filter(&mut driven[..n]);
            self.add(&driven[..n], (1.0, 1.0), weights, &mut out[..n]);
        }
        self.sigma = self.sigma_next;
        self.settle();
    }

    #[inline]
    fn add(&mut self, noise: &[f32], sigmas: (f32, f32), weights: (f32, f32), out: &mut [f32]) {
        match self.n_chunks {
            // Usual orders have fixed loop lengths, which keep the coefficients in registers.
            2 => self.run::<2>(noise, sigmas, weights, out),
            3 => self.run::<3>(noise, sigmas, weights, out),
            4 => self.run::<4>(noise, sigmas, weights, out),
            n if n <= USUAL_CHUNKS => self.run::<USUAL_CHUNKS>(noise, sigmas, weights, out),
            n if n <= MIDDLE_CHUNKS => self.run::<MIDDLE_CHUNKS>(noise, sigmas, weights, out),
            _ => self.run::<MAX_CHUNKS>(noise, sigmas, weights, out),
        }
    }

    #[inline]
    fn run<const CHUNKS: usize>(
        &mut self,
        noise: &[f32],
        sigmas: (f32, f32),
        weights: (f32, f32),
        out: &mut [f32],
    ) {
        let n = noise.len().min(out.len()).min(MAX_TICK);
        let per_sample = 1.0 / n as f32;
        let (sigma_step, weight_step) =
            ((sigmas.1 - sigmas.0) * per_sample, (weights.1 - weights.0) * per_sample);
        let older: [[f32; LANES]; CHUNKS] = core::array::from_fn(|i| self.older[i]);
        let [a1, a2, a3, a4] = self.recent;
        let m = &mut self.memory;
        let (mut y1, mut y2, mut y3, mut y4) =
            (m[MAX_ORDER - 1], m[MAX_ORDER - 2], m[MAX_ORDER - 3], m[MAX_ORDER - 4]);
        let (mut sigma, mut weight) = (sigmas.0, weights.0);
        for i in 0..n {
            let mut sum = [0.0_f32; LANES];
            for (chunk_idx, a) in older.iter().enumerate() {
                let start = i + MAX_ORDER - RECENT - LANES * (chunk_idx + 1);
                let past = &m[start..start + LANES];
                for lane in 0..LANES {
                    sum[lane] += a[lane] * past[lane];
                }
            }
            sigma += sigma_step;
            weight += weight_step;
            let rest = ((sum[0] + sum[2]) + (sum[1] + sum[3])) + (a4 * y4 + a3 * y3);
            let y = ((noise[i] * sigma - rest) - a2 * y2) - a1 * y1;
            m[MAX_ORDER + i] = y;
            (y4, y3, y2, y1) = (y3, y2, y1, y);
            out[i] += weight * y;
        }
        // Usual orders do not move what only a high order needs.
        let n_kept = if CHUNKS > USUAL_CHUNKS { MAX_ORDER } else { USUAL_ORDER };
        m.copy_within(MAX_ORDER + n - n_kept..MAX_ORDER + n, MAX_ORDER - n_kept);
    }

    /// Sets a filter state that has decayed below [`TINY_MPS2`] to exactly zero. Subnormal numbers (below 1e-38) cost a
    /// processor hundreds of cycles each, and nothing below `TINY_MPS2` can be felt or measured.
    ///
    /// [`Voice::aim`] also sets excitations below `TINY_MPS2` to zero. A nonzero excitation thus keeps the state near
    /// or above `TINY_MPS2`, far above 1e-38. Without excitation the state decays and becomes zero once all of it is
    /// below `TINY_MPS2`. A fast decay can leave subnormal numbers for a few ticks only.
    fn settle(&mut self) {
        if self.sigma_next == 0.0 && self.memory[..MAX_ORDER].iter().all(|y| y.abs() < TINY_MPS2) {
            self.memory[..MAX_ORDER].fill(0.0);
        }
    }

    /// Clears the filter state; coefficients and levels stay.
    pub fn clear_memory(&mut self) {
        self.memory.fill(0.0);
        self.moving_average.clear();
    }

    /// Clears the filter state and the coefficients.
    pub fn reset(&mut self) {
        *self = Self::new();
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{MAX_TICK, TINY_MPS2, Voice};
    use crate::lsf::ar_from_lsf;
    use crate::noise::{Gaussian, Noise};
    use crate::texture::{Evaluated, MAX_MA_ORDER, MAX_ORDER};
    use std::vec;
    use std::vec::Vec;

    fn evaluated(order: usize, sigma_mps2: f32) -> Evaluated {
        let mut lsf = [0.0; MAX_ORDER];
        for (i, w) in lsf[..order].iter_mut().enumerate() {
            // Uneven gaps give resonances where they are narrow.
            *w = core::f32::consts::PI * (i as f32 + 0.7 + 0.25 * (i as f32).sin()) / (order as f32 + 1.0);
        }
        Evaluated { lsf, ma_lsf: [0.0; MAX_MA_ORDER], ma_order: 0, level_mps2: 1.0, sigma_mps2 }
    }

    #[test]
    fn every_order_agrees_with_the_plain_recursion() {
        let (table, mut noise) = (Gaussian::new(), Noise::new(5));
        let e: Vec<f32> = (0..500).map(|_| table.draw(&mut noise)).collect();
        for order in 1..=MAX_ORDER {
            let at = evaluated(order, 0.5);
            let mut ar = vec![0.0_f32; order];
            ar_from_lsf(&at.lsf[..order], &mut ar);
            let mut voice = Voice::new();
            voice.aim(order, &at);
            voice.aim(order, &at);
            let mut out = vec![0.0_f32; e.len()];
            // With uneven ticks, the filter state must carry over for every tick length.
            let mut at_sample = 0;
            for n in [1, 3, MAX_TICK, 7].into_iter().cycle() {
                let end = (at_sample + n).min(e.len());
                voice.add_tick(&e[at_sample..end], (1.0, 1.0), &mut out[at_sample..end]);
                at_sample = end;
                if end == e.len() {
                    break;
                }
            }
            let mut y = vec![0.0_f64; e.len()];
            for n in 0..e.len() {
                y[n] = f64::from(e[n]) * 0.5;
                for k in 1..=order.min(n) {
                    y[n] -= f64::from(ar[k - 1]) * y[n - k];
                }
            }
            let peak = y.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            for (n, (a, b)) in out.iter().zip(&y).enumerate() {
                // The tolerance covers rounding to f32 in a resonance with a gain below 100.
                assert!((f64::from(*a) - b).abs() < 1e-4 * peak, "order {order}, sample {n}: {a} for {b}");
            }
        }
    }

    #[test]
    fn the_order_can_change_and_nothing_of_the_old_coefficients_stays() {
        let playing = |order: usize| {
            let at = evaluated(order, 0.5);
            let mut voice = Voice::new();
            voice.aim(order, &at);
            voice.aim(order, &at);
            voice
        };
        let tick = |voice: &mut Voice| {
            let mut out = [0.0; MAX_TICK];
            voice.add_tick(&[1.0; MAX_TICK], (1.0, 1.0), &mut out);
            out
        };
        for (first, second) in [(64, 20), (64, 33), (48, 32), (20, 64), (8, 33), (33, 48)] {
            let mut changed = playing(first);
            for _ in 0..4 {
                tick(&mut changed);
            }
            // A voice that always had the second order, with the same last outputs.
            let mut fresh = playing(second);
            fresh.memory = changed.memory;
            changed.aim(second, &evaluated(second, 0.5));
            assert_eq!(tick(&mut changed), tick(&mut fresh), "order {first}, then {second}");
        }
    }

    #[test]
    fn level_and_weight_move_in_straight_lines() {
        let mut at = evaluated(2, 0.0);
        let mut voice = Voice::new();
        voice.aim(2, &at);
        at.sigma_mps2 = 1.0;
        voice.aim(2, &at);
        // With zero predictor coefficients, the output is noise × level × weight.
        voice.recent = [0.0; 4];
        let mut out = [0.0; 4];
        voice.add_tick(&[1.0; 4], (0.0, 1.0), &mut out);
        assert_eq!(out, [0.0625, 0.25, 0.5625, 1.0]);
    }

    #[test]
    fn rings_out_to_exactly_zero() {
        let mut voice = Voice::new();
        // What a high order leaves behind must not keep the voice from silence.
        voice.aim(64, &evaluated(64, 1.0));
        voice.add_tick(&[1.0; 20], (1.0, 1.0), &mut [0.0; 20]);
        voice.aim(8, &evaluated(8, 1.0));
        voice.add_tick(&[1.0; 20], (1.0, 1.0), &mut [0.0; 20]);
        for _ in 0..2000 {
            voice.aim(8, &evaluated(8, 0.0));
            voice.add_tick(&[0.5; 20], (1.0, 1.0), &mut [0.0; 20]);
        }
        assert!(voice.memory.iter().all(|&y| y == 0.0));
    }

    #[test]
    fn an_excitation_too_small_to_feel_rings_out_to_exactly_zero_too() {
        // Excitations from the smallest subnormal number to just below the threshold.
        for sigma_mps2 in [f32::from_bits(1), 1e-38, 1e-30, 0.99 * TINY_MPS2] {
            let mut voice = Voice::new();
            voice.aim(8, &evaluated(8, 1.0));
            voice.add_tick(&[1.0; 20], (1.0, 1.0), &mut [0.0; 20]);
            for _ in 0..2000 {
                voice.aim(8, &evaluated(8, sigma_mps2));
                voice.add_tick(&[0.5; 20], (1.0, 1.0), &mut [0.0; 20]);
            }
            assert!(voice.memory.iter().all(|&y| y == 0.0), "excited by {sigma_mps2}");
        }
    }
}
