use super::{Biquad, Hertz, PI, butterworth_high_pass, decimate, decimation_taps, filter, filter_zero_phase};
use crate::dsp::spectrum::rms;
use crate::maths::rng::lcg_noise;

fn sine(frequency_hz: f64, rate_hz: f64, n: usize) -> Vec<f64> {
    (0..n).map(|i| (2.0 * PI * frequency_hz * i as f64 / rate_hz).sin()).collect()
}

/// Magnitude response |H| on the unit circle.
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
        // The filter settles within 0.2 s; after 2 s the transient is below rounding error.
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
        let expected: f64 =
            (0..taps.len()).filter_map(|k| Some(taps[k] * signal.get((4 * i + k).checked_sub(half)?)?)).sum();
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
    // 80 dB is 1e-4, also in the pass band; 600 samples are not an integer number of periods, hence 2e-3.
    for frequency_hz in [20.0, 100.0, 300.0, 450.0] {
        check(frequency_hz, 0.998, 1.002);
    }
    for frequency_hz in [505.0, 700.0, 1040.0, 7900.0] {
        check(frequency_hz, 0.0, 1.5e-4);
    }
}
