//! Encoder: samples to frames.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::{Codebooks, HalfFrame};
use super::code_search::CodeSearch;
use super::decoder::mixed;
use super::frame::{Frame, Half, lags};
use super::spectrum::{Lsf, SpectrumMeter, WINDOW_SAMPLES, widen};
use super::synthesis::{Predictor, Synthesis};
use super::{FRAME_SAMPLES, HALF_SAMPLES, LOOK_AHEAD_SAMPLES, N_SPLITS, NOTHING, ORDER, SPLITS, least};
use crate::maths::statistics::dot;

/// Perceptual weighting filter `A(z/0.94)/A(z/0.6)`.
const WEIGHTING: (f64, f64) = (0.94, 0.6);
/// Lags for which the fixed codebook is searched. Large codebooks take most of the time, and one lag less costs 0.3 dB.
const N_LAGS_TRIED: usize = 3;
const N_LAGS_TRIED_OF_MANY: usize = 2;
const MANY_CODES: usize = 4096;
/// Range of the adaptive codebook gain during the fixed codebook search.
const LAGGED_GAIN: (f64, f64) = (0.0, 1.2);
/// Smallest frequency spacing used in the LSF weights, in radians per sample.
const LEAST_DISTANCE: f64 = 0.02;

/// Streaming encoder.
#[derive(Clone, Debug)]
pub struct Encoder {
    rate: Bitrate,
    books: Arc<Codebooks>,
    meter: SpectrumMeter,
    synthesis: Synthesis,
    search: CodeSearch,
    /// Window around the next frame, filled up to `n_filled`.
    window: [f64; WINDOW_SAMPLES],
    n_filled: usize,
    /// Input samples not yet encoded.
    n_waiting: usize,
}

/// A candidate excitation of a subframe, and its weighted error.
#[derive(Clone, Copy, Debug)]
struct Trial {
    error: f64,
    half: Half,
    excitation: HalfFrame,
}

/// Inner products of the target and of the filtered adaptive and fixed excitation: enough to choose the gains.
#[derive(Clone, Copy, Debug)]
pub(super) struct Products {
    pub(super) target: f64,
    pub(super) target_lagged: f64,
    pub(super) target_fixed: f64,
    pub(super) lagged: f64,
    pub(super) fixed: f64,
    pub(super) both: f64,
}

impl Products {
    /// Returns the squared error for these gains.
    pub(super) fn error(&self, [lagged, fixed]: [f64; 2]) -> f64 {
        self.target - 2.0 * (lagged * self.target_lagged + fixed * self.target_fixed)
            + lagged * lagged * self.lagged
            + fixed * fixed * self.fixed
            + 2.0 * lagged * fixed * self.both
    }

    /// Returns the gain pair with the least error (the first of equals), and that error.
    fn least_error_of(&self, gains: &[[f64; 2]]) -> (usize, f64) {
        let mut best = (0, f64::INFINITY);
        for (index, gains) in gains.iter().enumerate() {
            let error = self.error(*gains);
            if error < best.1 {
                best = (index, error);
            }
        }
        best
    }

    /// Returns a lower bound of the error over all gains.
    fn least_error(&self) -> f64 {
        let determinant = self.lagged * self.fixed - self.both * self.both;
        if determinant <= 1e-9 * self.lagged * self.fixed {
            return 0.0;
        }
        let taken = self.fixed * self.target_lagged * self.target_lagged
            + self.lagged * self.target_fixed * self.target_fixed
            - 2.0 * self.both * self.target_lagged * self.target_fixed;
        self.target - taken / determinant
    }
}

impl Encoder {
    /// Returns an encoder at this rate; scale input samples to about unit RMS.
    pub fn new(rate: Bitrate, books: Arc<Codebooks>) -> Self {
        let synthesis = Synthesis::new(books.lsf_mean());
        let meter = SpectrumMeter::new();
        let window = [0.0; WINDOW_SAMPLES];
        let search = CodeSearch::new(rate.allocation().n_codes());
        Self { rate, books, meter, synthesis, search, window, n_filled: LOOK_AHEAD_SAMPLES, n_waiting: 0 }
    }

    /// Encodes samples and appends the completed frames.
    ///
    /// Samples that are not finite count as zero, so that a stream never stops.
    pub fn push(&mut self, samples: &[f64], frames: &mut Vec<Frame>) {
        self.push_looking(samples, frames, |_| ());
    }

    /// As [`Self::push`]; `look` receives the products among which the gains of each subframe were chosen.
    pub(super) fn push_looking(
        &mut self,
        samples: &[f64],
        frames: &mut Vec<Frame>,
        mut look: impl FnMut(Products),
    ) {
        for sample in samples {
            self.n_waiting += 1;
            self.take(*sample, frames, &mut look);
        }
    }

    /// Pads the remaining samples with silence and appends their frames.
    pub fn finish(mut self, frames: &mut Vec<Frame>) {
        let n_wanted = frames.len() + self.n_waiting.div_ceil(FRAME_SAMPLES);
        while frames.len() < n_wanted {
            self.take(0.0, frames, &mut |_| ());
        }
    }

    fn take(&mut self, sample: f64, frames: &mut Vec<Frame>, look: &mut impl FnMut(Products)) {
        self.window[self.n_filled] = if sample.is_finite() { sample } else { 0.0 };
        self.n_filled += 1;
        if self.n_filled == WINDOW_SAMPLES {
            frames.push(self.encode(look));
            self.window.copy_within(FRAME_SAMPLES.., 0);
            self.n_filled -= FRAME_SAMPLES;
            self.n_waiting = self.n_waiting.saturating_sub(FRAME_SAMPLES);
        }
    }

    /// Returns the frame at the center of the window.
    fn encode(&mut self, look: &mut impl FnMut(Products)) -> Frame {
        let measured = self.meter.measure(&self.window);
        let lsf_indices = self.quantized(&measured);
        let lsf = self.books.frequencies(self.rate, lsf_indices);
        let predictors = self.synthesis.predictors(&lsf);
        let mut frame = Frame { lsf: lsf_indices, ..Frame::default() };
        let mut first_lag = None;
        for (half, predictor) in predictors.iter().enumerate() {
            let begin = LOOK_AHEAD_SAMPLES + half * HALF_SAMPLES;
            let wanted: HalfFrame = std::array::from_fn(|i| self.window[begin + i]);
            let (trial, products) = self.best(predictor, &wanted, lags(first_lag));
            look(products);
            frame.halves[half] = trial.half;
            first_lag = Some(frame.lags()[0]);
            self.synthesis.excite(predictor, &trial.excitation);
        }
        self.synthesis.lsf = lsf;
        frame
    }

    /// Returns the nearest VQ entries; closely spaced frequencies have a higher weight.
    fn quantized(&self, lsf: &Lsf) -> [u16; N_SPLITS] {
        let below = |i: usize| if i == 0 { 0.0 } else { lsf[i - 1] };
        let above = |i: usize| if i + 1 == ORDER { std::f64::consts::PI } else { lsf[i + 1] };
        let weight = |i: usize| 1.0 / (lsf[i] - below(i)).min(above(i) - lsf[i]).max(LEAST_DISTANCE);
        let mean = self.books.lsf_mean();
        std::array::from_fn(|split| {
            let (begin, _) = SPLITS[split];
            let distance = |entry: &Vec<f64>| -> f64 {
                let parts = entry.iter().enumerate();
                parts.map(|(j, e)| weight(begin + j) * (lsf[begin + j] - mean[begin + j] - e).powi(2)).sum()
            };
            least(self.books.split(self.rate, split).iter().map(distance)) as u16
        })
    }

    /// Returns the best excitation of a subframe.
    fn best(
        &mut self,
        predictor: &Predictor,
        wanted: &HalfFrame,
        (low, high): (usize, usize),
    ) -> (Trial, Products) {
        let Self { rate, books, synthesis, search, .. } = self;
        let n_codes = rate.allocation().n_codes();
        let ringing = synthesis.ringing(predictor);
        let missing: HalfFrame = std::array::from_fn(|i| wanted[i] - ringing[i]);
        let weighted = weighted(predictor, &missing);
        let target = dot(&weighted, &weighted);
        let response = weighted_response(predictor);
        let expected = synthesis.expected_length();
        let gains = books.gains(*rate);
        search.begin(books, &response);
        let mut best: Option<(Trial, Products)> = None;
        let n_lags = if n_codes < MANY_CODES { N_LAGS_TRIED } else { N_LAGS_TRIED_OF_MANY };
        for (lag, made) in promising_lags(synthesis, &response, &weighted, low, high).take(n_lags) {
            let before = synthesis.lagged(lag);
            let (energy, target_lagged) = (dot(&made, &made), dot(&weighted, &made));
            let gain = if energy > NOTHING {
                (target_lagged / energy).clamp(LAGGED_GAIN.0, LAGGED_GAIN.1)
            } else {
                0.0
            };
            let left: HalfFrame = std::array::from_fn(|i| weighted[i] - gain * made[i]);
            for (_, code) in search.promising(books, n_codes, &left) {
                let fixed = convolved(&response, &books.codes[*code]);
                let products = Products {
                    target,
                    target_lagged,
                    target_fixed: expected * dot(&weighted, &fixed),
                    lagged: energy,
                    fixed: expected * expected * dot(&fixed, &fixed),
                    both: expected * dot(&made, &fixed),
                };
                if best.as_ref().is_some_and(|(best, _)| products.least_error() >= best.error) {
                    continue;
                }
                let (chosen, error) = products.least_error_of(gains);
                let [lagged_gain, fixed_gain] = gains[chosen];
                if best.as_ref().is_none_or(|(best, _)| error < best.error) {
                    let half = Half { lag: (lag - low) as u16, gain: chosen as u16, code: *code as u16 };
                    let excitation = mixed(&before, lagged_gain, &books.codes[*code], fixed_gain * expected);
                    best = Some((Trial { error, half, excitation }, products));
                }
            }
        }
        match best {
            Some(best) => best,
            None => unreachable!("the search always has a lag and a code"),
        }
    }
}

/// Returns the lags that match best without a fixed codebook entry, each with its weighted filtered excitation.
fn promising_lags(
    synthesis: &Synthesis,
    response: &HalfFrame,
    weighted: &HalfFrame,
    low: usize,
    high: usize,
) -> impl Iterator<Item = (usize, HalfFrame)> {
    let mut best = [(f64::NEG_INFINITY, low, [0.0; HALF_SAMPLES]); N_LAGS_TRIED];
    let mut made = convolved(response, &synthesis.lagged(low));
    for lag in low..=high {
        if lag > low {
            // Recursive update: shift by one sample and add the response to the new sample.
            let fresh = synthesis.lagged(lag)[0];
            made.copy_within(..HALF_SAMPLES - 1, 1);
            made[0] = 0.0;
            for (y, h) in made.iter_mut().zip(response) {
                *y += fresh * h;
            }
        }
        let (alike, energy) = (dot(weighted, &made), dot(&made, &made));
        let score = if energy > NOTHING { alike * alike.abs() / energy } else { 0.0 };
        // A later equal score is placed after the first.
        let place = best.iter().position(|(least, ..)| score > *least);
        if let Some(place) = place {
            best[place..].rotate_right(1);
            best[place] = (score, lag, made);
        }
    }
    best.into_iter().filter(|(score, ..)| *score > f64::NEG_INFINITY).map(|(_, lag, made)| (lag, made))
}

/// Returns the first [`HALF_SAMPLES`] samples of a convolution.
pub(super) fn convolved(response: &HalfFrame, x: &HalfFrame) -> HalfFrame {
    let mut out = [0.0; HALF_SAMPLES];
    for (i, x) in x.iter().enumerate() {
        for (y, h) in out[i..].iter_mut().zip(response) {
            *y += x * h;
        }
    }
    out
}

/// Returns a signal filtered by `A(z/0.94)/A(z/0.6)` with zero initial state.
fn weighted(predictor: &Predictor, x: &HalfFrame) -> HalfFrame {
    let (ahead, behind) = (widened(predictor, WEIGHTING.0), widened(predictor, WEIGHTING.1));
    let mut out = [0.0; HALF_SAMPLES];
    for n in 0..HALF_SAMPLES {
        let mut y = x[n];
        for k in 1..=ORDER.min(n) {
            y += ahead[k - 1] * x[n - k] - behind[k - 1] * out[n - k];
        }
        out[n] = y;
    }
    out
}

/// Returns the impulse response of the weighted synthesis filter `1/A(z) · A(z/0.94)/A(z/0.6)`.
fn weighted_response(predictor: &Predictor) -> HalfFrame {
    let mut out = [0.0; HALF_SAMPLES];
    out[0] = 1.0;
    for n in 1..HALF_SAMPLES {
        for k in 1..=ORDER.min(n) {
            out[n] -= predictor[k - 1] * out[n - k];
        }
    }
    weighted(predictor, &out)
}

/// Returns the bandwidth-expanded predictor `A(z/factor)`.
fn widened(predictor: &Predictor, factor: f64) -> Predictor {
    let mut widened = *predictor;
    widen(&mut widened, factor);
    widened
}
