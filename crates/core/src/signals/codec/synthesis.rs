//! Synthesis shared by encoder and decoder: excitation through the synthesis filter of a frame.

use super::spectrum::Lsf;
use super::{HALF_SAMPLES, LAGS, ORDER};
use crate::dsp::lsf::ar_from_lsf;
use crate::maths::statistics::dot;
use crate::signals::codec::books::HalfFrame;

/// Samples of past excitation kept.
const HISTORY: usize = LAGS.1;
/// Tracking rate and range of the predicted log norm of a subframe's excitation.
const FOLLOW: f64 = 0.4;
const LOG_LENGTHS: (f64, f64) = (-9.0, 6.0);
/// Initial predicted log norm, and the rate per subframe at which the prediction leaks back to it.
///
/// Gains are coded relative to this prediction. Without the leak, a decoder that missed a frame would differ from the
/// encoder permanently.
const USUAL_LOG_LENGTH: f64 = -0.5;
const FORGOTTEN: f64 = 0.1;
/// Usual excitation norm, `e^-0.5`.
pub(super) const USUAL_LENGTH: f64 = 0.606_530_659_712_633_4;
/// Smallest excitation norm that counts in the prediction.
const LEAST_LENGTH: f64 = 1e-4;

/// The coefficients `a_1 … a_10` of a subframe.
pub(super) type Predictor = [f64; ORDER];

/// Decoder state; the encoder keeps an identical copy.
#[derive(Clone, Debug)]
pub(super) struct Synthesis {
    /// Frequencies of the previous frame.
    pub(super) lsf: Lsf,
    /// Past excitation, oldest first.
    history: [f64; HISTORY],
    /// Predicted log norm of a subframe's excitation.
    log_length: f64,
    /// Past output of the synthesis filter, newest first.
    out: [f64; ORDER],
}

impl Synthesis {
    pub(super) fn new(lsf: Lsf) -> Self {
        Self { lsf, history: [0.0; HISTORY], log_length: USUAL_LOG_LENGTH, out: [0.0; ORDER] }
    }

    /// Returns the predictors of both subframes; the first uses the mean of these frequencies and the previous ones.
    pub(super) fn predictors(&self, lsf: &Lsf) -> [Predictor; 2] {
        let between: Lsf = std::array::from_fn(|i| 0.5 * (self.lsf[i] + lsf[i]));
        [&between, lsf].map(|lsf| {
            let ar = ar_from_lsf(lsf);
            std::array::from_fn(|i| ar[i])
        })
    }

    /// Returns the excitation `lag` samples in the past.
    pub(super) fn lagged(&self, lag: usize) -> HalfFrame {
        let begin = HISTORY - lag;
        std::array::from_fn(|i| self.history[begin + i])
    }

    /// Returns the predicted excitation norm, the reference of the fixed codebook gain.
    pub(super) fn expected_length(&self) -> f64 {
        self.log_length.exp()
    }

    /// Returns the zero-input response of the synthesis filter.
    pub(super) fn ringing(&self, predictor: &Predictor) -> HalfFrame {
        let mut out = self.out;
        std::array::from_fn(|_| step(predictor, &mut out, 0.0))
    }

    /// Synthesizes a subframe from coded excitation, and updates the prediction.
    pub(super) fn excite(&mut self, predictor: &Predictor, excitation: &HalfFrame) -> HalfFrame {
        let length = dot(excitation, excitation).sqrt().max(LEAST_LENGTH);
        let followed = self.log_length + FOLLOW * (length.ln() - self.log_length);
        self.log_length =
            (followed + FORGOTTEN * (USUAL_LOG_LENGTH - followed)).clamp(LOG_LENGTHS.0, LOG_LENGTHS.1);
        self.fill(predictor, excitation)
    }

    /// Synthesizes a concealed subframe; the prediction stays unchanged.
    pub(super) fn fill(&mut self, predictor: &Predictor, excitation: &HalfFrame) -> HalfFrame {
        let out = std::array::from_fn(|i| step(predictor, &mut self.out, excitation[i]));
        self.history.copy_within(HALF_SAMPLES.., 0);
        self.history[HISTORY - HALF_SAMPLES..].copy_from_slice(excitation);
        out
    }
}

/// Returns one sample of `1/A(z)`; `out` is the past output, newest first.
fn step(predictor: &Predictor, out: &mut [f64; ORDER], excitation: f64) -> f64 {
    let y = excitation - dot(predictor, out);
    out.copy_within(..ORDER - 1, 1);
    out[0] = y;
    y
}
