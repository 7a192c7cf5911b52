//! Slow reference by the definitions: every bin of every frame in `f64`, term by term.

use std::f64::consts::{PI, TAU};

use super::{distance, htk, librosa, paper, python_speech_features, recommended};
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::mfcc::{
    Dct, FirstCoefficient, Framing, Lifter, Logarithm, MfccOptions, MfccPlan, Spectrum, TransformLength,
    Window, filter_bank,
};
use crate::maths::rng::lcg_noise;
use crate::units::Hertz;
use ndarray::Array2;

fn oracle(options: &MfccOptions, rate: Hertz, x: &[f64]) -> Array2<f64> {
    let (n, hop) =
        ((options.frame_secs * rate.0).round() as usize, (options.hop_secs * rate.0).round() as usize);
    let n_transform = match options.transform {
        TransformLength::Samples(n) => n,
        TransformLength::PowersOfTwo(times) => n.next_power_of_two() * times,
    };
    let emphasized = |i: usize| if i == 0 { x[0] } else { x[i] - options.pre_emphasis * x[i - 1] };
    let at = |i: isize| if i < 0 || i as usize >= x.len() { 0.0 } else { emphasized(i as usize) };
    let (n_frames, first) = match options.framing {
        Framing::Whole => ((x.len() - n) / hop + 1, 0),
        Framing::PaddedEnd => (1 + (x.len().max(n) - n).div_ceil(hop), 0),
        Framing::Centered => (
            (x.len() + 2 * (n_transform / 2) - n_transform) / hop + 1,
            (n_transform / 2 - (n_transform - n) / 2).cast_signed(),
        ),
    };
    let window = |i: usize| match options.window {
        Window::Rectangular => 1.0,
        Window::Hamming => 0.54 - 0.46 * (TAU * i as f64 / (n as f64 - 1.0)).cos(),
        Window::Hann => (PI * i as f64 / n as f64).sin().powi(2),
    };
    let bank = filter_bank(options, rate, n_transform);
    let n_filters = options.n_filters;
    let (mut logs, mut energies) = (Array2::zeros((n_frames, n_filters)), Vec::new());
    for frame in 0..n_frames {
        let samples: Vec<f64> =
            (0..n).map(|i| window(i) * at((frame * hop + i).cast_signed() - first)).collect();
        let bin = |k: usize| {
            let angle = |i: usize| TAU * (k * i % n_transform) as f64 / n_transform as f64;
            let re: f64 = samples.iter().enumerate().map(|(i, s)| s * angle(i).cos()).sum();
            let im: f64 = samples.iter().enumerate().map(|(i, s)| s * angle(i).sin()).sum();
            match options.spectrum {
                Spectrum::Magnitude => re.hypot(im),
                Spectrum::Power => re * re + im * im,
                Spectrum::PowerPerSample => (re * re + im * im) / n_transform as f64,
            }
        };
        let bins: Vec<f64> = (0..=n_transform / 2).map(bin).collect();
        energies.push(bins.iter().sum::<f64>());
        for j in 0..n_filters {
            let sum: f64 = bins.iter().zip(bank.row(j)).map(|(b, w)| b * w).sum();
            logs[[frame, j]] = match options.logarithm {
                Logarithm::Floored { floor } => sum.max(floor).ln(),
                Logarithm::ZeroReplaced { instead } => (if sum == 0.0 { instead } else { sum }).ln(),
                Logarithm::Decibels { floor, .. } => 10.0 * sum.max(floor).log10(),
            };
        }
    }
    if let Logarithm::Decibels { top_db, .. } = options.logarithm {
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        logs.mapv_inplace(|v| v.max(top - top_db));
    }
    let m = n_filters as f64;
    Array2::from_shape_fn((n_frames, options.n_coefficients), |(frame, k)| {
        if k == 0 && options.first == FirstCoefficient::LogEnergy {
            return energies[frame].ln();
        }
        let sum: f64 =
            (0..n_filters).map(|j| logs[[frame, j]] * (PI * k as f64 * (j as f64 + 0.5) / m).cos()).sum();
        let first = if k == 0 && options.dct == Dct::Orthonormal { 0.5_f64.sqrt() } else { 1.0 };
        let lift = match options.lifter {
            Lifter::None => 1.0,
            Lifter::FromZero(l) => 1.0 + l / 2.0 * (PI * k as f64 / l).sin(),
            Lifter::FromOne(l) => 1.0 + l / 2.0 * (PI * (k as f64 + 1.0) / l).sin(),
        };
        (2.0 / m).sqrt() * first * lift * sum
    })
}

/// Texture whose spectrum falls by tens of decibels, so that the outputs of some filters are small relative to the
/// frame energy.
fn steep(n: usize, rate: Hertz, seed: u64) -> Vec<f64> {
    let a = from_resonances(rate, &[(Hertz(40.0), 0.99), (Hertz(60.0), 0.98), (Hertz(90.0), 0.97)]);
    let mut x = lcg_noise(n, seed);
    for t in 0..n {
        x[t] -= (1..=a.len().min(t)).map(|k| a[k - 1] * x[t - k]).sum::<f64>();
    }
    x
}

#[track_caller]
fn check(options: &MfccOptions, rate: Hertz, x: &[f64]) {
    let got = MfccPlan::new(options, rate).unwrap().coefficients(x).unwrap();
    let far = distance(&got, &oracle(options, rate, x));
    // Outputs are accurate to 1e-10 at worst (mostly 1e-12), and the lifter multiplies by up to 12.
    assert!(far < 1e-9, "{} at {rate}, {} samples: largest error {far:e}", options.label, x.len());
}

#[test]
fn every_preset_at_every_rate() {
    let presets = [paper(), htk(), recommended(), librosa(), python_speech_features()];
    for rate in [Hertz(1000.0), Hertz(1500.0), Hertz(2000.0), Hertz(2800.0), Hertz(8000.0)] {
        for options in &presets {
            let n = (0.2 * rate.0) as usize;
            check(options, rate, &lcg_noise(n, 3));
            check(options, rate, &steep(n, rate, 4));
        }
    }
}

#[test]
fn every_framing_and_transform() {
    let x = lcg_noise(211, 5);
    for framing in [Framing::Whole, Framing::PaddedEnd, Framing::Centered] {
        for n_transform in [25, 26, 31, 64, 512] {
            for window in [Window::Rectangular, Window::Hamming, Window::Hann] {
                for spectrum in [Spectrum::Magnitude, Spectrum::Power, Spectrum::PowerPerSample] {
                    let transform = TransformLength::Samples(n_transform);
                    let options = MfccOptions { framing, window, transform, spectrum, ..recommended() };
                    check(&options, Hertz(1000.0), &x);
                }
            }
        }
    }
    // Signals shorter than a frame, for the framings that pad.
    for framing in [Framing::PaddedEnd, Framing::Centered] {
        check(&MfccOptions { framing, ..recommended() }, Hertz(1000.0), &x[..3]);
    }
}

#[test]
fn quiet_filters_are_as_exact_as_loud_ones() {
    // A slow oscillation and a smooth window: at least 100 dB between the strongest and the weakest filter.
    let swing: Vec<f64> = (0..400).map(|i| (TAU * 12.0 * f64::from(i) / 1000.0).sin()).collect();
    let quiet = lcg_noise(400, 7);
    for share in [1e-2, 1e-4, 1e-6] {
        let x: Vec<f64> = swing.iter().zip(&quiet).map(|(s, q)| s + share * q).collect();
        for window in [Window::Hamming, Window::Hann] {
            check(&MfccOptions { window, ..recommended() }, Hertz(1000.0), &x);
        }
    }
}
