//! Digital filters for offline use: Butterworth high-pass filters and resampling with anti-aliasing.

mod resample;

pub use crate::dsp::filter::resample::resample;
pub use shagreen_synth::equalizer::Biquad;

use shagreen_synth::resampler::bessel_i0;

use crate::units::Hertz;
use std::f64::consts::PI;

/// Stop-band attenuation of the anti-aliasing filter of [`decimate`], in dB.
pub const DECIMATION_ATTENUATION_DB: f64 = 80.0;

/// Upper edge of the pass band of [`decimate`], as a fraction of the new Nyquist frequency.
pub const DECIMATION_PASS_SHARE: f64 = 0.9;

/// Second-order sections of a Butterworth high-pass filter of even `order` (2 or more), by the pre-warped bilinear
/// transform.
///
/// The gain at `cutoff` is 1/√2; `cutoff` must lie between 0 and half of `rate`.
pub fn butterworth_high_pass(order: usize, cutoff: Hertz, rate: Hertz) -> Vec<Biquad> {
    assert!(order >= 2 && order.is_multiple_of(2), "order {order} must be even and at least 2");
    assert!(
        cutoff.0 > 0.0 && 2.0 * cutoff.0 < rate.0,
        "cutoff {cutoff} must lie between 0 and half of {rate}"
    );
    let warped = (PI * cutoff.0 / rate.0).tan();
    (0..order / 2)
        .map(|pair| {
            // A pole pair of the unit Butterworth circle has the damping sin(angle from the imaginary axis).
            let damping = (PI * (2 * pair + 1) as f64 / (2 * order) as f64).sin();
            let scale = 1.0 / (1.0 + 2.0 * damping * warped + warped * warped);
            Biquad {
                b: [scale, -2.0 * scale, scale],
                a: [
                    2.0 * (warped * warped - 1.0) * scale,
                    (1.0 - 2.0 * damping * warped + warped * warped) * scale,
                ],
            }
        })
        .collect()
}

/// Filters `signal` in place, in one forward pass with zero initial state.
pub fn filter(sections: &[Biquad], signal: &mut [f64]) {
    for section in sections {
        let [b0, b1, b2] = section.b;
        let [a1, a2] = section.a;
        let (mut s1, mut s2) = (0.0, 0.0);
        for value in signal.iter_mut() {
            let input = *value;
            let output = b0 * input + s1;
            s1 = b1 * input - a1 * output + s2;
            s2 = b2 * input - a2 * output;
            *value = output;
        }
    }
}

/// Filters forward and backward in place, which gives zero delay and the squared gain of [`filter`].
///
/// Both passes start with zero state, so both ends have transients about as long as the filter's impulse response.
pub fn filter_zero_phase(sections: &[Biquad], signal: &mut [f64]) {
    filter(sections, signal);
    signal.reverse();
    filter(sections, signal);
    signal.reverse();
}

/// Returns every `factor`-th sample of `signal` after a linear-phase anti-aliasing low-pass filter.
///
/// The pass band is flat up to [`DECIMATION_PASS_SHARE`] of the new Nyquist frequency. From the Nyquist frequency up,
/// the attenuation is [`DECIMATION_ATTENUATION_DB`]. Output sample `i` corresponds to input sample `i * factor`; the
/// signal is zero beyond its ends.
pub fn decimate(signal: &[f64], factor: usize) -> Vec<f64> {
    assert!(factor > 0, "the decimation factor must be at least 1");
    if factor == 1 {
        return signal.to_vec();
    }
    let taps = decimation_taps(factor);
    let half = taps.len() / 2;
    (0..signal.len().div_ceil(factor))
        .map(|i| {
            let center = i * factor;
            let first = center.saturating_sub(half);
            let last = (center + half).min(signal.len() - 1);
            let taps = &taps[first + half - center..];
            signal[first..=last].iter().zip(taps).map(|(value, tap)| value * tap).sum()
        })
        .collect()
}

/// Kaiser-windowed sinc of odd length with unit gain at zero frequency.
fn decimation_taps(factor: usize) -> Vec<f64> {
    let kernel = LowPass::new(factor as f64);
    let half = kernel.half.ceil();
    let mut taps: Vec<f64> = (0..=2 * half as usize).map(|i| kernel.at(i as f64 - half)).collect();
    let gain: f64 = taps.iter().sum();
    for tap in &mut taps {
        *tap /= gain;
    }
    taps
}

/// Continuous impulse response for [`decimate`] and [`resample`]; time in input samples.
struct LowPass {
    /// Cutoff in cycles per sample, in the middle of the transition band.
    cutoff: f64,
    /// Half length of the impulse response, in samples.
    half: f64,
    beta: f64,
}

impl LowPass {
    /// Low-pass filter for a sample rate lower by `factor`.
    fn new(factor: f64) -> Self {
        let nyquist = 0.5 / factor;
        let transition = (1.0 - DECIMATION_PASS_SHARE) * nyquist;
        // Kaiser 1974: length and window parameter for an attenuation above 50 dB.
        let half = 0.5 * (DECIMATION_ATTENUATION_DB - 7.95) / (14.36 * transition);
        let beta = 0.1102 * (DECIMATION_ATTENUATION_DB - 8.7);
        Self { cutoff: nyquist - 0.5 * transition, half: half.ceil(), beta }
    }

    fn at(&self, t: f64) -> f64 {
        let sinc = if t == 0.0 { 2.0 * self.cutoff } else { (2.0 * PI * self.cutoff * t).sin() / (PI * t) };
        let window = (1.0 - (t / self.half).powi(2)).max(0.0).sqrt();
        sinc * bessel_i0(self.beta * window) / bessel_i0(self.beta)
    }
}

#[cfg(test)]
mod tests;
