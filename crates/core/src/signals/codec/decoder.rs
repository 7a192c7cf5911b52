//! Decoder: frames to samples, with concealment of lost frames.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::{Codebooks, HalfFrame};
use super::frame::Frame;
use super::spectrum::Lsf;
use super::synthesis::{Synthesis, USUAL_LENGTH};
use super::{FRAME_SAMPLES, HALF_SAMPLES};
use crate::maths::rng::Random;
use crate::maths::statistics::dot;

/// Decay of both gains per lost subframe.
const FADE: f64 = 0.8;
/// Relative shift of the frequencies toward the mean per lost frame.
const FORGET: f64 = 0.15;
/// Subframes after a lost frame in which the excitation norm is limited to the recent maximum.
///
/// Gains are coded relative to a prediction from past excitation, which differs between encoder and decoder after a
/// loss.
const N_WARY: u32 = 12;
/// Decay of the tracked maximum norm per subframe.
///
/// It never falls below the usual norm: before any signal, there is no evidence that new excitation is too loud.
const REMEMBER: f64 = 0.9;

/// Decodes a stream frame by frame. Lost frames are concealed by repeating past excitation with decaying gain.
#[derive(Clone, Debug)]
pub struct Decoder {
    rate: Bitrate,
    books: Arc<Codebooks>,
    synthesis: Synthesis,
    /// Lag and gains of the last subframe.
    last: (usize, [f64; 2]),
    random: Random,
    /// Recent maximum of the excitation norm, and the number of subframes still limited to it.
    longest: f64,
    n_wary: u32,
    limit: f64,
}

impl Decoder {
    /// Returns a decoder for a stream of this rate; samples are clipped to `-limit..=limit`, in the unit of the stream.
    pub fn new(rate: Bitrate, books: Arc<Codebooks>, limit: f64) -> Self {
        let synthesis = Synthesis::new(books.lsf_mean());
        Self {
            rate,
            books,
            synthesis,
            last: (HALF_SAMPLES, [0.0; 2]),
            random: Random::new(0),
            longest: USUAL_LENGTH,
            n_wary: 0,
            limit: limit.abs(),
        }
    }

    /// Returns the samples of the next frame; `None` conceals a lost frame.
    pub fn decode(&mut self, frame: Option<&Frame>) -> [f64; FRAME_SAMPLES] {
        let mut samples = [0.0; FRAME_SAMPLES];
        let made = match frame {
            Some(frame) => self.known(frame),
            None => self.lost(),
        };
        for (to, from) in samples.iter_mut().zip(made.iter().flatten()) {
            // Safety for the actuator: every output sample is finite and within the limit.
            *to = if from.is_finite() { from.clamp(-self.limit, self.limit) } else { 0.0 };
        }
        samples
    }

    fn known(&mut self, frame: &Frame) -> [HalfFrame; 2] {
        let lsf = self.books.frequencies(self.rate, frame.lsf);
        let predictors = self.synthesis.predictors(&lsf);
        let books = Arc::clone(&self.books);
        let (gains, lags) = (books.gains(self.rate), frame.lags());
        let n_codes = self.rate.allocation().n_codes();
        let made = [0, 1].map(|half| {
            let said = &frame.halves[half];
            let [lagged, fixed] = gains[said.gain as usize % gains.len()];
            let fixed = fixed * self.synthesis.expected_length();
            let code = books.codes[said.code as usize % n_codes];
            let before = self.synthesis.lagged(lags[half]);
            let excitation = mixed(&before, lagged, &code, fixed);
            let share = self.share_of(&excitation);
            self.last = (lags[half], [share * lagged, share * fixed]);
            self.synthesis.excite(&predictors[half], &excitation.map(|x| share * x))
        });
        self.synthesis.lsf = lsf;
        made
    }

    /// Returns the scale factor of an excitation: 1, or less where its norm exceeds the maximum before a frame was
    /// lost.
    fn share_of(&mut self, excitation: &HalfFrame) -> f64 {
        let length = dot(excitation, excitation).sqrt();
        if self.n_wary == 0 {
            self.longest = length.max(REMEMBER * self.longest).max(USUAL_LENGTH);
            return 1.0;
        }
        self.n_wary -= 1;
        if length > self.longest { self.longest / length } else { 1.0 }
    }

    fn lost(&mut self) -> [HalfFrame; 2] {
        self.n_wary = N_WARY;
        let mean = self.books.lsf_mean();
        let before = self.synthesis.lsf;
        let lsf: Lsf = std::array::from_fn(|i| before[i] + FORGET * (mean[i] - before[i]));
        let predictors = self.synthesis.predictors(&lsf);
        let n_codes = self.rate.allocation().n_codes();
        let made = predictors.map(|predictor| {
            let (lag, gains) = &mut self.last;
            for gain in gains.iter_mut() {
                *gain *= FADE;
            }
            let code = self.books.codes[self.random.below(n_codes)];
            let excitation = mixed(&self.synthesis.lagged(*lag), gains[0].min(FADE), &code, gains[1]);
            self.synthesis.fill(&predictor, &excitation)
        });
        self.synthesis.lsf = lsf;
        made
    }
}

/// Returns the sum of two excitations with their gains.
pub(super) fn mixed(a: &HalfFrame, gain_a: f64, b: &HalfFrame, gain_b: f64) -> HalfFrame {
    std::array::from_fn(|i| gain_a * a[i] + gain_b * b[i])
}
