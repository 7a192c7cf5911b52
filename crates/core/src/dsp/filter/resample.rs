//! Sample-rate conversion at any ratio.

use crate::dsp::filter::{LowPass, decimate};
use crate::units::Hertz;

/// Table entries per sample at the lower rate. Linear interpolation has an error of at most `(π / 1024)² / 8`, about a
/// millionth.
const TABLE_STEPS: usize = 1024;

/// Converts `signal` to the sample rate `to`, with the pass band and attenuation of [`decimate`].
///
/// Integer ratios use [`decimate`] itself. Upsampling adds nothing above the band of the input. Output sample `i`
/// corresponds to the time `i / to` from the first sample; the signal is zero beyond its ends.
///
/// # Panics
/// If a rate is not above zero.
pub fn resample(signal: &[f64], from: Hertz, to: Hertz) -> Vec<f64> {
    assert!(to.0 > 0.0 && from.0 > 0.0, "sample rates must be above zero, got {from} and {to}");
    let factor = from.0 / to.0;
    let whole = factor.round();
    // Rates that agree to a millionth drift by a thousandth of a sample over a thousand samples.
    if (factor - whole).abs() < 1e-6 * factor {
        return decimate(signal, whole as usize);
    }
    let kernel = LowPass::new(factor.max(1.0));
    let step = factor.max(1.0) / TABLE_STEPS as f64;
    let n_table = (kernel.half / step).ceil() as usize + 2;
    let table: Vec<f64> = (0..n_table).map(|i| kernel.at(i as f64 * step)).collect();
    let n_out = (signal.len() as f64 / factor).ceil() as usize;
    (0..n_out)
        .map(|i| {
            let center = i as f64 * factor;
            let first = (center - kernel.half).ceil().max(0.0) as usize;
            let last = ((center + kernel.half) as usize).min(signal.len() - 1);
            let (mut sum, mut gain) = (0.0, 0.0);
            for (j, value) in signal.iter().enumerate().take(last + 1).skip(first) {
                let at = (j as f64 - center).abs() / step;
                let entry = at as usize;
                let share = at - entry as f64;
                let tap = table[entry] + share * (table[entry + 1] - table[entry]);
                sum += tap * value;
                gain += tap;
            }
            // Normalizes the rounding errors of table and grid where the whole impulse response has samples.
            let inside = center >= kernel.half && center + kernel.half <= (signal.len() - 1) as f64;
            if inside { sum / gain } else { sum }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::resample;
    use crate::dsp::filter::decimate;
    use crate::dsp::spectrum::rms;
    use crate::maths::rng::lcg_noise;
    use crate::units::Hertz;
    use std::f64::consts::TAU;

    fn sine(frequency_hz: f64, rate_hz: f64) -> Vec<f64> {
        (0..rate_hz as usize).map(|i| (TAU * frequency_hz * i as f64 / rate_hz).sin()).collect()
    }

    #[test]
    fn a_sine_in_the_band_is_the_same_sine_and_one_above_is_gone() {
        for from_hz in [1200.0, 3333.0, 11_025.0, 44_100.0] {
            for frequency_hz in [20.0, 200.0, 440.0] {
                let got = resample(&sine(frequency_hz, from_hz), Hertz(from_hz), Hertz(1000.0));
                let expected = sine(frequency_hz, 1000.0);
                assert_eq!(got.len(), 1000);
                for (got, expected) in got[200..800].iter().zip(&expected[200..800]) {
                    // 80 dB in the pass band too, plus a margin for ripple.
                    assert!(
                        (got - expected).abs() < 3e-4,
                        "{frequency_hz} Hz from {from_hz} Hz: got {got}, expected {expected}"
                    );
                }
            }
            let above = resample(&sine(560.0, from_hz), Hertz(from_hz), Hertz(1000.0));
            assert!(rms(&above[200..800]) < 3e-4, "{}", rms(&above[200..800]));
        }
    }

    #[test]
    fn a_higher_rate_has_the_same_sine_and_nothing_above() {
        for to_hz in [1500.0, 2000.0, 4410.0] {
            for frequency_hz in [20.0, 200.0, 400.0] {
                let got = resample(&sine(frequency_hz, 1000.0), Hertz(1000.0), Hertz(to_hz));
                let expected = sine(frequency_hz, to_hz);
                assert_eq!(got.len(), expected.len());
                let middle = got.len() / 5..got.len() * 4 / 5;
                for (got, expected) in got[middle.clone()].iter().zip(&expected[middle]) {
                    assert!(
                        (got - expected).abs() < 3e-4,
                        "{frequency_hz} Hz to {to_hz} Hz: got {got}, expected {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn whole_ratios_are_those_of_the_decimator() {
        let x = lcg_noise(4000, 2);
        assert_eq!(resample(&x, Hertz(4000.0), Hertz(1000.0)), decimate(&x, 4));
        assert_eq!(resample(&x, Hertz(1000.0), Hertz(1000.0)), x);
        assert!(resample(&[], Hertz(3333.0), Hertz(1000.0)).is_empty());
        // The general method at a ratio close to an integer.
        let near = resample(&x, Hertz(4000.1), Hertz(1000.0));
        for (a, b) in near[300..400].iter().zip(&decimate(&x, 4)[300..400]) {
            assert!((a - b).abs() < 0.06, "got {a}, expected {b}");
        }
    }
}
