//! Frames to samples.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::{Codebooks, HalfFrame};
use super::frame::Frame;
use super::spectrum::Lsf;
use super::synthesis::{Synthesis, USUAL_LENGTH};
use super::{FRAME_SAMPLES, HALF_SAMPLES};
use crate::rng::Random;
use crate::statistics::dot;

/// How much of both gains is kept from a lost half to the next.
const FADE: f64 = 0.8;
/// How far the frequencies of a lost frame go towards the mean.
const FORGET: f64 = 0.15;
/// Halves after a lost frame in which no excitation is longer than the longest before it: gains are told relative to what
/// the encoder remembers, and the decoder remembers something else.
const N_WARY: u32 = 12;
/// How much of the longest excitation is remembered from half to half. It is never less than what is usual: where nothing
/// was heard yet, nothing says that what comes is too loud.
const REMEMBER: f64 = 0.9;

/// Decodes a stream frame by frame. A frame that is lost is filled with more of the same, ever quieter.
#[derive(Clone, Debug)]
pub struct Decoder {
    rate: Bitrate,
    books: Arc<Codebooks>,
    synthesis: Synthesis,
    /// What the last half was made of: its lag, and its gains.
    last: (usize, [f64; 2]),
    random: Random,
    /// Length of the longest excitation of late, and halves that may not be longer.
    longest: f64,
    n_wary: u32,
    limit: f64,
}

impl Decoder {
    /// A decoder of a stream of this rate, of which no sample leaves `-limit..=limit`, in the unit of the stream.
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

    /// The samples of the next frame, `None` for one that was lost.
    pub fn decode(&mut self, frame: Option<&Frame>) -> [f64; FRAME_SAMPLES] {
        let mut samples = [0.0; FRAME_SAMPLES];
        let made = match frame {
            Some(frame) => self.known(frame),
            None => self.lost(),
        };
        for (to, from) in samples.iter_mut().zip(made.iter().flatten()) {
            // Whatever was said, an actuator must live with it.
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

    /// How much of an excitation is played: all of it, or so much that it is no longer than what was heard before a frame
    /// was lost.
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

/// Two excitations with their gains.
pub(super) fn mixed(a: &HalfFrame, gain_a: f64, b: &HalfFrame, gain_b: f64) -> HalfFrame {
    std::array::from_fn(|i| gain_a * a[i] + gain_b * b[i])
}
