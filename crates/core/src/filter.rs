//! Small digital filters for offline use: Butterworth high-pass sections and an anti-aliased decimator.

use shagreen_synth::resampler::bessel_i0;

use crate::units::Hertz;
use std::f64::consts::PI;

/// Stop-band attenuation of [`decimate`]'s anti-aliasing filter.
pub const DECIMATION_ATTENUATION_DB: f64 = 80.0;

/// Upper edge of [`decimate`]'s pass band as a share of the new Nyquist frequency.
pub const DECIMATION_PASS_SHARE: f64 = 0.9;

/// A second-order recursive filter `(b0 + b1 z⁻¹ + b2 z⁻²) / (1 + a1 z⁻¹ + a2 z⁻²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biquad {
    /// Feed-forward coefficients b0, b1, b2.
    pub b: [f64; 3],
    /// Feedback coefficients a1, a2; a0 is 1.
    pub a: [f64; 2],
}

/// The sections of a Butterworth high-pass of even `order` (2 or more), by the pre-warped bilinear transform.
///
/// `cutoff`, where the gain is 1/√2, lies between 0 and half of `rate`.
pub fn butterworth_high_pass(order: usize, cutoff: Hertz, rate: Hertz) -> Vec<Biquad> {
    assert!(order >= 2 && order.is_multiple_of(2), "order {order} is not even and at least 2");
    assert!(cutoff.0 > 0.0 && 2.0 * cutoff.0 < rate.0, "cut-off {cutoff} is outside 0 to half of {rate}");
    let warped = (PI * cutoff.0 / rate.0).tan();
    (0..order / 2)
        .map(|pair| {
            // A pole pair of the unit Butterworth circle has damping sin of its angle from the imaginary axis.
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

/// Filters `signal` in place, once, from rest.
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

/// Filters forward and then backward, in place: no delay, and the gain of [`filter`] squared.
///
/// Both passes start from rest, so the ends carry transients about as long as the filter rings.
pub fn filter_zero_phase(sections: &[Biquad], signal: &mut [f64]) {
    filter(sections, signal);
    signal.reverse();
    filter(sections, signal);
    signal.reverse();
}

/// Every `factor`-th sample of `signal` after a linear-phase low-pass that leaves nothing to alias.
///
/// Flat to [`DECIMATION_PASS_SHARE`] of the new Nyquist frequency and [`DECIMATION_ATTENUATION_DB`] down from that
/// frequency up. Sample `i` of the result belongs to sample `i * factor` of `signal`, which counts as zero
/// beyond its ends.
pub fn decimate(signal: &[f64], factor: usize) -> Vec<f64> {
    assert!(factor > 0, "a decimation factor is at least 1");
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

/// Kaiser-windowed sinc of odd length and unit gain at zero frequency.
fn decimation_taps(factor: usize) -> Vec<f64> {
    let nyquist = 0.5 / factor as f64;
    let transition = (1.0 - DECIMATION_PASS_SHARE) * nyquist;
    let cutoff = nyquist - 0.5 * transition;
    // Kaiser 1974: length and shape for an attenuation in decibels above 50.
    let half = (0.5 * (DECIMATION_ATTENUATION_DB - 7.95) / (14.36 * transition)).ceil();
    let beta = 0.1102 * (DECIMATION_ATTENUATION_DB - 8.7);
    let n_taps = 2 * half as usize + 1;
    let mut taps: Vec<f64> = (0..n_taps)
        .map(|i| {
            let t = i as f64 - half;
            let sinc = if t == 0.0 { 2.0 * cutoff } else { (2.0 * PI * cutoff * t).sin() / (PI * t) };
            sinc * bessel_i0(beta * (1.0 - (t / half).powi(2)).max(0.0).sqrt()) / bessel_i0(beta)
        })
        .collect();
    let gain: f64 = taps.iter().sum();
    for tap in &mut taps {
        *tap /= gain;
    }
    taps
}

#[cfg(test)]
mod tests {
    use super::{
        Biquad, Hertz, PI, butterworth_high_pass, decimate, decimation_taps, filter, filter_zero_phase,
    };
    use crate::rng::lcg_noise;
    use crate::spectrum::rms;

    fn sine(frequency_hz: f64, rate_hz: f64, n: usize) -> Vec<f64> {
        (0..n).map(|i| (2.0 * PI * frequency_hz * i as f64 / rate_hz).sin()).collect()
    }

    /// |H| on the unit circle, from the coefficients.
    fn gain(sections: &[Biquad], frequency_hz: f64, rate_hz: f64) -> f64 {
        let w = 2.0 * PI * frequency_hz / rate_hz;
        let norm = |c0: f64, c1: f64, c2: f64| {
            (c0 + c1 * w.cos() + c2 * (2.0 * w).cos()).hypot(c1 * w.sin() + c2 * (2.0 * w).sin())
        };
        sections.iter().map(|s| norm(s.b[0], s.b[1], s.b[2]) / norm(1.0, s.a[0], s.a[1])).product()
    }

    #[test]
    fn butterworth_has_the_closed_form_gain() {
        for (order, cutoff_hz, rate_hz) in [(2_u8, 10.0, 1000.0), (4, 20.0, 1000.0), (6, 300.0, 2000.0)] {
            let sections = butterworth_high_pass(usize::from(order), Hertz(cutoff_hz), Hertz(rate_hz));
            assert!((gain(&sections, cutoff_hz, rate_hz) - 0.5_f64.sqrt()).abs() < 1e-9);
            for frequency_hz in [3.0, 17.0, 120.0, 450.0] {
                let warp = |f: f64| (PI * f / rate_hz).tan();
                let ratio = warp(cutoff_hz) / warp(frequency_hz);
                let expected = 1.0 / (1.0 + ratio.powi(2 * i32::from(order))).sqrt();
                let got = gain(&sections, frequency_hz, rate_hz);
                assert!((got - expected).abs() < 1e-9, "order {order} at {frequency_hz} Hz: {got}");
            }
        }
    }

    #[test]
    fn filter_scales_a_sine_by_the_gain() {
        let sections = butterworth_high_pass(2, Hertz(10.0), Hertz(1000.0));
        for frequency_hz in [5.0, 10.0, 50.0] {
            let mut signal = sine(frequency_hz, 1000.0, 4000);
            filter(&sections, &mut signal);
            let expected = gain(&sections, frequency_hz, 1000.0) * 0.5_f64.sqrt();
            // 0.2 s settle; what is left of the transient after 2 s is below rounding.
            assert!((rms(&signal[2000..]) - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn zero_phase_does_not_move_a_sine() {
        let sections = butterworth_high_pass(2, Hertz(10.0), Hertz(1000.0));
        let input = sine(50.0, 1000.0, 4000);
        let mut output = input.clone();
        filter_zero_phase(&sections, &mut output);
        let expected = gain(&sections, 50.0, 1000.0).powi(2);
        for (output, input) in output[1500..2500].iter().zip(&input[1500..2500]) {
            assert!((output - expected * input).abs() < 1e-6);
        }
    }

    #[test]
    fn decimation_matches_the_full_convolution() {
        let signal = lcg_noise(700, 9);
        let taps = decimation_taps(4);
        let half = taps.len() / 2;
        for (i, got) in decimate(&signal, 4).iter().enumerate() {
            let expected: f64 = (0..taps.len())
                .filter_map(|k| Some(taps[k] * signal.get((4 * i + k).checked_sub(half)?)?))
                .sum();
            assert!((got - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn decimation_passes_the_band_and_stops_aliases() {
        let check = |frequency_hz: f64, low: f64, high: f64| {
            let out = decimate(&sine(frequency_hz, 16_000.0, 16_000), 16);
            let gain = rms(&out[200..800]) / 0.5_f64.sqrt();
            assert!((low..high).contains(&gain), "gain {gain} at {frequency_hz} Hz");
        };
        // 80 dB is 1e-4, in the pass band too; the window of 600 samples is no whole period, hence 2e-3.
        for frequency_hz in [20.0, 100.0, 300.0, 450.0] {
            check(frequency_hz, 0.998, 1.002);
        }
        for frequency_hz in [505.0, 700.0, 1040.0, 7900.0] {
            check(frequency_hz, 0.0, 1.5e-4);
        }
    }
}
