//! What encoder and decoder do alike: excitation through the spectrum of a frame.

use super::spectrum::Lsf;
use super::{HALF_SAMPLES, LAGS, ORDER};
use crate::codec::books::HalfFrame;
use crate::lsf::ar_from_lsf;
use crate::statistics::dot;

/// Samples of the excitation that are remembered.
const HISTORY: usize = LAGS.1;
/// How fast what is expected follows, and its range: logarithms of the length of half a frame's excitation.
const FOLLOW: f64 = 0.4;
const LOG_LENGTHS: (f64, f64) = (-9.0, 6.0);
/// What it is before there was any, and what it goes back to by this share from half to half. Lengths are told relative to
/// what is expected: without that share, a decoder that missed a frame would expect something else than the encoder ever
/// after.
const USUAL_LOG_LENGTH: f64 = -0.5;
const FORGOTTEN: f64 = 0.1;
/// The usual length itself, `e^-0.5`.
pub(super) const USUAL_LENGTH: f64 = 0.606_530_659_712_633_4;
/// Length of an excitation below which it counts as this.
const LEAST_LENGTH: f64 = 1e-4;

/// The coefficients `a_1 … a_10` of half a frame.
pub(super) type Predictor = [f64; ORDER];

/// The state of a decoder, which the encoder follows.
#[derive(Clone, Debug)]
pub(super) struct Synthesis {
    /// The frequencies of the frame before.
    pub(super) lsf: Lsf,
    /// Excitation, oldest first.
    history: [f64; HISTORY],
    /// Logarithm of the expected length of half a frame's excitation.
    log_length: f64,
    /// What came out last, newest first.
    out: [f64; ORDER],
}

impl Synthesis {
    pub(super) fn new(lsf: Lsf) -> Self {
        Self { lsf, history: [0.0; HISTORY], log_length: USUAL_LOG_LENGTH, out: [0.0; ORDER] }
    }

    /// The predictors of both halves of a frame with these frequencies: the first lies between it and the one before.
    pub(super) fn predictors(&self, lsf: &Lsf) -> [Predictor; 2] {
        let between: Lsf = std::array::from_fn(|i| 0.5 * (self.lsf[i] + lsf[i]));
        [&between, lsf].map(|lsf| {
            let ar = ar_from_lsf(lsf);
            std::array::from_fn(|i| ar[i])
        })
    }

    /// The excitation of so many samples before.
    pub(super) fn lagged(&self, lag: usize) -> HalfFrame {
        let begin = HISTORY - lag;
        std::array::from_fn(|i| self.history[begin + i])
    }

    /// The length that the excitation of a fixed code of gain one is expected to have.
    pub(super) fn expected_length(&self) -> f64 {
        self.log_length.exp()
    }

    /// What still rings, without any excitation.
    pub(super) fn ringing(&self, predictor: &Predictor) -> HalfFrame {
        let mut out = self.out;
        std::array::from_fn(|_| step(predictor, &mut out, 0.0))
    }

    /// Half a frame of this excitation.
    pub(super) fn excite(&mut self, predictor: &Predictor, excitation: &HalfFrame) -> HalfFrame {
        let length = dot(excitation, excitation).sqrt().max(LEAST_LENGTH);
        let followed = self.log_length + FOLLOW * (length.ln() - self.log_length);
        self.log_length =
            (followed + FORGOTTEN * (USUAL_LOG_LENGTH - followed)).clamp(LOG_LENGTHS.0, LOG_LENGTHS.1);
        self.fill(predictor, excitation)
    }

    /// Half a frame that nobody said: it changes nothing of what is expected.
    pub(super) fn fill(&mut self, predictor: &Predictor, excitation: &HalfFrame) -> HalfFrame {
        let out = std::array::from_fn(|i| step(predictor, &mut self.out, excitation[i]));
        self.history.copy_within(HALF_SAMPLES.., 0);
        self.history[HISTORY - HALF_SAMPLES..].copy_from_slice(excitation);
        out
    }
}

/// One sample of `1/A`; `out` is what came out before, newest first.
fn step(predictor: &Predictor, out: &mut [f64; ORDER], excitation: f64) -> f64 {
    let y = excitation - dot(predictor, out);
    out.copy_within(..ORDER - 1, 1);
    out[0] = y;
    y
}
