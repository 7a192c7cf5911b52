mod bad_input;
mod golden;
mod oracle;

use std::f64::consts::TAU;

use super::{
    Dct, FilterShape, FirstCoefficient, Framing, Lifter, Logarithm, MelScale, MfccOptions, MfccPlan,
    Spectrum, TransformLength, Window, htk, paper, recommended,
};
use crate::maths::rng::lcg_noise;
use crate::units::Hertz;
use ndarray::Array2;

const RATE: Hertz = Hertz(1000.0);

/// Defaults of python_speech_features, except for the frequency band.
fn python_speech_features() -> MfccOptions {
    MfccOptions {
        label: "python_speech_features",
        frame_secs: 0.025,
        hop_secs: 0.015,
        framing: Framing::PaddedEnd,
        pre_emphasis: 0.97,
        window: Window::Rectangular,
        transform: TransformLength::Samples(512),
        spectrum: Spectrum::PowerPerSample,
        n_filters: 26,
        low: Hertz(10.0),
        high: Hertz(500.0),
        scale: MelScale::Htk,
        shape: FilterShape::FlooredToBins,
        logarithm: Logarithm::ZeroReplaced { instead: f64::EPSILON },
        dct: Dct::Orthonormal,
        n_coefficients: 13,
        first: FirstCoefficient::LogEnergy,
        lifter: Lifter::FromZero(22.0),
    }
}

/// Librosa with Slaney's mel scale and without padding.
fn librosa() -> MfccOptions {
    MfccOptions {
        label: "librosa",
        framing: Framing::Whole,
        pre_emphasis: 0.0,
        window: Window::Hann,
        spectrum: Spectrum::Power,
        scale: MelScale::Slaney,
        shape: FilterShape::UnitArea,
        logarithm: Logarithm::Decibels { floor: 1e-10, top_db: 80.0 },
        first: FirstCoefficient::OfTransform,
        lifter: Lifter::None,
        ..python_speech_features()
    }
}

fn coefficients(options: &MfccOptions, signal: &[f64]) -> Array2<f64> {
    MfccPlan::new(options, RATE).unwrap().coefficients(signal).unwrap()
}

/// Largest absolute difference; infinite if the shapes differ or a value is NaN.
fn distance(a: &Array2<f64>, b: &Array2<f64>) -> f64 {
    if a.dim() != b.dim() {
        return f64::INFINITY;
    }
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |worst, d| {
        if d <= worst {
            worst
        } else if d.is_nan() {
            f64::INFINITY
        } else {
            d
        }
    })
}

#[test]
fn an_impulse_has_the_sums_of_the_filters() {
    // A unit impulse has power 1 in every bin, at any position in the frame.
    let options = MfccOptions { window: Window::Rectangular, spectrum: Spectrum::Power, ..recommended() };
    let bank = super::filter_bank(&options, RATE, 64);
    for at in [0, 7, 24] {
        let mut signal = vec![0.0; 25];
        signal[at] = 1.0;
        let got = coefficients(&options, &signal);
        let mean = bank.rows().into_iter().map(|row| row.sum().ln()).sum::<f64>() / 20.0;
        // Coefficient 0 of the orthonormal transform is sqrt(M) times the mean.
        assert!((got[[0, 0]] - 20.0_f64.sqrt() * mean).abs() < 1e-12, "{}", got[[0, 0]]);
    }
}

#[test]
fn gain_moves_only_the_first_coefficient() {
    let x = lcg_noise(500, 6);
    let louder: Vec<f64> = x.iter().map(|x| 8.0 * x).collect();
    let (quiet, loud) = (coefficients(&recommended(), &x), coefficients(&recommended(), &louder));
    // The power in each of the 20 filters is multiplied by 64.
    let shift = 64.0_f64.ln() * 20.0_f64.sqrt();
    for (quiet, loud) in quiet.rows().into_iter().zip(loud.rows()) {
        assert!((loud[0] - quiet[0] - shift).abs() < 1e-11);
        assert!((1..13).all(|k| (loud[k] - quiet[k]).abs() < 1e-11));
    }
}

#[test]
fn frames_do_not_know_of_each_other() {
    // More frames than one block; each frame is also computed from a signal that starts one frame earlier.
    let x = lcg_noise(25 + 15 * 300, 8);
    for options in [recommended(), htk(), paper()] {
        let all = coefficients(&options, &x);
        let hop = (options.hop_secs * RATE.0).round() as usize;
        // Pre-emphasis has no previous sample for the first sample, so the first frame is skipped.
        for i in (1..all.nrows()).step_by(37) {
            let later = coefficients(&options, &x[(i - 1) * hop..]);
            let (alone, among) = (later.row(1), all.row(i));
            assert!(alone.iter().zip(among).all(|(a, b)| (a - b).abs() < 1e-11), "frame {i}");
        }
    }
}

#[test]
fn counts_of_frames_are_those_of_the_paper() {
    let frames = |options: &MfccOptions, n| MfccPlan::new(options, RATE).unwrap().n_frames(n);
    assert_eq!((frames(&paper(), 1000), frames(&htk(), 1000)), (66, 98));
    assert_eq!((frames(&paper(), 25_000), frames(&htk(), 25_000)), (1666, 2498));
    assert_eq!([24, 25, 39, 40].map(|n| frames(&paper(), n)), [0, 1, 1, 2]);
    let padded = python_speech_features();
    assert_eq!([0, 1, 25, 26, 40, 41, 25_000].map(|n| frames(&padded, n)), [0, 1, 1, 2, 2, 3, 1666]);
}

#[test]
fn presets_differ_and_say_who_they_are() {
    let x = lcg_noise(1000, 9);
    let presets = [paper(), htk(), recommended()];
    for (i, a) in presets.iter().enumerate() {
        assert_eq!(MfccPlan::new(a, RATE).unwrap().label(), a.label);
        for b in &presets[i + 1..] {
            assert_ne!(a.label, b.label);
            assert!(distance(&coefficients(a, &x), &coefficients(b, &x)) > 0.1);
        }
    }
}

#[test]
fn empty_filters_are_counted() {
    let empty = |n_filters, n_transform| {
        let options = MfccOptions {
            n_filters,
            transform: TransformLength::Samples(n_transform),
            ..python_speech_features()
        };
        MfccPlan::new(&options, RATE).unwrap().n_empty_filters()
    };
    assert_eq!([empty(20, 32), empty(26, 32), empty(13, 32), empty(26, 64)], [4, 10, 0, 0]);
    assert!(
        [paper(), htk(), recommended()]
            .iter()
            .all(|o| MfccPlan::new(o, RATE).unwrap().n_empty_filters() == 0)
    );
}

#[test]
fn a_tone_is_loudest_where_it_is() {
    // With as many coefficients as filters, the inverse transform recovers the logarithms.
    let options = MfccOptions { n_coefficients: 20, ..recommended() };
    let tone: Vec<f64> = (0..25).map(|i| (TAU * 154.0 * f64::from(i) / 1000.0).sin()).collect();
    let c = coefficients(&options, &tone);
    let logarithm = |m: usize| -> f64 {
        let term = |k: usize| {
            let scale = if k == 0 { (1.0 / 20.0_f64).sqrt() } else { (2.0 / 20.0_f64).sqrt() };
            scale * c[[0, k]] * (std::f64::consts::PI * k as f64 * (m as f64 + 0.5) / 20.0).cos()
        };
        (0..20).map(term).sum()
    };
    let loudest = (0..20).max_by(|a, b| logarithm(*a).total_cmp(&logarithm(*b))).unwrap();
    let edges = super::filter_bank::mel_edges(&options);
    assert!(edges[loudest].0 < 154.0 && edges[loudest + 2].0 > 154.0, "filter {loudest}");
}
