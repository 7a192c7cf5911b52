use std::f32::consts::TAU;

use super::{ASSUMED_HZ, FULL_RMS, HYSTERESIS_OCTAVES, TAP_CREST, Translator, WINDOW_SECS};
use crate::haptic_pen::waveform::{Play, Waveform};

const RATE_HZ: u32 = 8000;
const WINDOW: usize = (WINDOW_SECS * RATE_HZ as f32) as usize;

fn all() -> Translator {
    let every = ASSUMED_HZ.map(|(waveform, _)| waveform).into_iter().chain([Waveform::CLICK]);
    Translator::new(RATE_HZ, every.collect::<Vec<_>>().iter().copied())
}

/// A sine with this root mean square, as a share of full scale.
fn sine(frequency_hz: f32, rms: f32, n_frames: usize) -> Vec<f32> {
    let amplitude = rms * 2.0_f32.sqrt();
    (0..n_frames).map(|n| amplitude * (TAU * frequency_hz * n as f32 / RATE_HZ as f32).sin()).collect()
}

/// Noise with a flat spectrum, uniform between ±`peak`.
fn noise(peak: f32, n_frames: usize) -> Vec<f32> {
    let mut seed = 1_u32;
    let next = |_| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        peak * ((seed >> 8) as f32 / (1 << 23) as f32 - 1.0)
    };
    (0..n_frames).map(next).collect()
}

fn played(translator: &mut Translator, signal: &[f32]) -> Play {
    translator.process(signal, 1).unwrap()
}

#[test]
fn a_sine_is_measured_exactly() {
    for frequency_hz in [40.0, 100.0, 250.0, 1000.0, 3500.0] {
        let mut translator = all();
        // The first window begins at zero, before which there was no sample.
        let signal = sine(frequency_hz, 0.1, 2 * WINDOW);
        let mut measures = signal.iter().filter_map(|sample| translator.take(*sample));
        let measure = measures.nth(1).unwrap();
        // Windows hold a whole number of periods of these frequencies.
        assert!((measure.frequency_hz / frequency_hz - 1.0).abs() < 1e-3, "{measure:?}");
        assert!((measure.rms - 0.1).abs() < 1e-5);
    }
}

/// Slow oracle: the root mean square frequency from a discrete Fourier transform of a whole window, for differences that
/// wrap around.
#[test]
fn the_frequency_of_noise_is_that_of_its_spectrum() {
    let signal = noise(0.3, WINDOW);
    let n = signal.len();
    let power = |k: usize| {
        let part = |turn: f64| {
            let angle = |i: usize| std::f64::consts::TAU * (k * i % n) as f64 / n as f64 + turn;
            signal.iter().enumerate().map(|(i, x)| f64::from(*x) * angle(i).cos()).sum::<f64>()
        };
        part(0.0).powi(2) + part(std::f64::consts::FRAC_PI_2).powi(2)
    };
    let (mut steps, mut total) = (0.0, 0.0);
    for k in 0..n {
        let half_angle = std::f64::consts::PI * k as f64 / n as f64;
        let power = power(k);
        steps += 4.0 * half_angle.sin().powi(2) * power;
        total += power;
    }
    let expected = f64::from(RATE_HZ) / std::f64::consts::PI * (0.5 * (steps / total).sqrt()).asin();
    let mut translator = all();
    let measure = signal.iter().filter_map(|sample| translator.take(*sample)).last().unwrap();
    // The first of 400 differences is from zero instead of the last sample. Its square is at most six times the mean,
    // which changes the frequency by at most 1 %.
    assert!((f64::from(measure.frequency_hz) / expected - 1.0).abs() < 1e-2, "{measure:?} for {expected}");
}

#[test]
fn the_intensity_is_proportional_to_the_level() {
    for (rms, expected) in [(0.0, 0), (0.001, 0), (0.0125, 5), (0.125, 50), (FULL_RMS, 100), (0.6, 100)] {
        let play = played(&mut all(), &sine(300.0, rms, 2 * WINDOW));
        assert_eq!(play.intensity_percent, expected, "{rms}");
        assert_eq!(play.waveform.is_some(), expected > 0);
    }
}

#[test]
fn each_waveform_is_chosen_at_its_frequency() {
    for (waveform, hz) in ASSUMED_HZ {
        assert_eq!(played(&mut all(), &sine(hz, 0.1, 2 * WINDOW)).waveform, Some(waveform), "{hz} Hz");
    }
    assert_eq!(played(&mut all(), &sine(10.0, 0.2, 4 * WINDOW)).waveform, Some(Waveform::BRUSH));
    assert_eq!(played(&mut all(), &sine(3000.0, 0.1, 2 * WINDOW)).waveform, Some(Waveform::SPARKLE));
    // A pen with the mandatory waveforms only.
    let mut few = Translator::new(RATE_HZ, [Waveform::CLICK, Waveform::INK].into_iter());
    assert_eq!(played(&mut few, &sine(60.0, 0.1, 2 * WINDOW)).waveform, Some(Waveform::INK));
}

#[test]
fn the_present_waveform_is_kept_until_another_is_clearly_nearer() {
    let (ink_hz, pencil_hz) = (ASSUMED_HZ[4].1, ASSUMED_HZ[5].1);
    let mut translator = all();
    let mut at = |hz: f32| played(&mut translator, &sine(hz, 0.1, 2 * WINDOW)).waveform;
    let middle_hz = (ink_hz * pencil_hz).sqrt();
    assert_eq!(at(ink_hz), Some(Waveform::INK));
    // Halfway, and somewhat beyond it.
    let beyond = |octaves: f32| middle_hz * 2.0_f32.powf(0.5 * octaves);
    assert_eq!(at(beyond(0.8 * HYSTERESIS_OCTAVES)), Some(Waveform::INK));
    assert_eq!(at(beyond(1.2 * HYSTERESIS_OCTAVES)), Some(Waveform::PENCIL));
    assert_eq!(at(beyond(-0.8 * HYSTERESIS_OCTAVES)), Some(Waveform::PENCIL));
    assert_eq!(at(beyond(-1.2 * HYSTERESIS_OCTAVES)), Some(Waveform::INK));
}

#[test]
fn a_tap_after_silence_is_a_click_and_the_waveform_follows() {
    let tap: Vec<f32> = (0..WINDOW)
        .map(|n| {
            let secs = n as f32 / RATE_HZ as f32;
            0.6 * (-secs / 0.004).exp() * (TAU * 250.0 * secs).cos()
        })
        .collect();
    let mut translator = all();
    assert_eq!(played(&mut translator, &[0.0; WINDOW]), Play::SILENCE);
    let click = played(&mut translator, &tap);
    assert_eq!(click, Play { waveform: Some(Waveform::CLICK), intensity_percent: 60 });
    let follows = played(&mut translator, &sine(266.0, 0.05, WINDOW));
    assert_eq!(follows, Play { waveform: Some(Waveform::INK), intensity_percent: 20 });
    // While something plays, a peak is no tap, and a steady signal is none after silence either.
    assert_ne!(played(&mut translator, &tap).waveform, Some(Waveform::CLICK));
    played(&mut translator, &[0.0; 2 * WINDOW]);
    let steady = sine(266.0, 0.05, WINDOW);
    let crest = 2.0_f32.sqrt();
    assert!(crest < TAP_CREST && played(&mut translator, &steady).waveform == Some(Waveform::INK));
    // A pen without a click plays its waveform at once.
    let mut few = Translator::new(RATE_HZ, [Waveform::INK].into_iter());
    assert_eq!(played(&mut few, &tap).waveform, Some(Waveform::INK));
    // Within a longer block, the click is the answer.
    let mut translator = all();
    let block = [vec![0.0; WINDOW], tap, sine(266.0, 0.05, WINDOW)].concat();
    assert_eq!(played(&mut translator, &block).waveform, Some(Waveform::CLICK));
}

#[test]
fn blocks_of_any_size_and_channels_are_the_same_signal() {
    let signal = noise(0.4, 5 * WINDOW);
    let mut whole = all();
    let expected: Vec<Play> = signal.chunks(WINDOW).map(|window| whole.process(window, 1).unwrap()).collect();
    for size in [1, 7, 64, 399, 400] {
        for channels in [1, 2, 5] {
            let mut translator = all();
            let mut found = Vec::new();
            for block in signal.chunks(size) {
                // The last channel carries the signal, the others nothing.
                let frames = block.iter().flat_map(|x| std::iter::repeat_n(0.0, channels - 1).chain([*x]));
                found.extend(translator.process(&frames.collect::<Vec<f32>>(), channels));
            }
            assert_eq!(found, expected, "{size} frames, {channels} channels");
        }
    }
}

#[test]
fn nonsense_samples_are_silence() {
    for sample in [f32::NAN, f32::INFINITY, -f32::INFINITY] {
        let mut translator = all();
        let play = played(&mut translator, &[sample; WINDOW]);
        assert!(play.intensity_percent <= 100);
        // A later window is not affected.
        played(&mut translator, &[0.0; WINDOW]);
        assert_eq!(played(&mut translator, &sine(266.0, 0.125, WINDOW)).intensity_percent, 50);
    }
}
