//! Comparison with python_speech_features and librosa (vectors written by `vectors/e_mfcc/mfcc_ref.py`), and with an
//! HTK-style script, `vectors/e_mfcc/htk_ref.py`.

use super::{RATE, coefficients, distance, librosa, python_speech_features};
use crate::dsp::mfcc::filter_bank::mel_edges;
use crate::dsp::mfcc::{
    FilterShape, FirstCoefficient, Lifter, MelScale, MfccOptions, TransformLength, Window, filter_bank, htk,
    paper, recommended,
};
use crate::units::Hertz;
use ndarray::{Array2, Axis, Slice};
use serde_json::Value;

macro_rules! vector {
    ($name:literal) => {
        table(include_str!(concat!("../../../../../../vectors/e_mfcc/", $name, ".csv")))
    };
}

fn table(csv: &str) -> Array2<f64> {
    let rows: Vec<Vec<f64>> =
        csv.lines().map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect();
    Array2::from_shape_vec((rows.len(), rows[0].len()), rows.concat()).unwrap()
}

fn input() -> Vec<f64> {
    vector!("input").into_raw_vec_and_offset().0
}

fn summary() -> Value {
    serde_json::from_str(include_str!("../../../../../../vectors/e_mfcc/summary.json")).unwrap()
}

fn row(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Test case with the name of its vector file.
struct Case {
    name: &'static str,
    options: MfccOptions,
    golden: Array2<f64>,
    tolerance: f64,
}

/// Both sides round to about 1e-13; the files have twelve digits, which `check` allows for.
const PSF: f64 = 1e-10;
/// Librosa computes its filters in `f32`: the reference script, in `f64` throughout, differs from it by up to 5.8e-7.
const LIBROSA: f64 = 1e-6;

/// As [`PSF`]. The script uses `1127 ln` instead of `2595 log₁₀`, but equidistant edges do not depend on this factor.
const HTK: f64 = 1e-10;

fn cases() -> Vec<Case> {
    let psf = python_speech_features();
    let plain = MfccOptions {
        pre_emphasis: 0.0,
        window: Window::Hamming,
        transform: TransformLength::Samples(64),
        n_filters: 20,
        first: FirstCoefficient::OfTransform,
        lifter: Lifter::None,
        ..psf.clone()
    };
    let of_25 = MfccOptions { transform: TransformLength::Samples(25), n_filters: 13, ..librosa() };
    let htk_of_25 = MfccOptions { scale: MelScale::Htk, shape: FilterShape::Triangle, ..of_25.clone() };
    let htk_lifted = MfccOptions {
        scale: MelScale::Htk,
        shape: FilterShape::Triangle,
        lifter: Lifter::FromOne(22.0),
        ..librosa()
    };
    let case = |name, options, golden, tolerance| Case { name, options, golden, tolerance };
    vec![
        case("psf_default_hop15", psf.clone(), vector!("psf_default_hop15"), PSF),
        case("psf_default_hop10", MfccOptions { hop_secs: 0.010, ..psf }, vector!("psf_default_hop10"), PSF),
        case("psf_plain_hamming_20_64", plain, vector!("psf_plain_hamming_20_64"), PSF),
        case("librosa_slaney_nfft25", of_25, vector!("librosa_slaney_nfft25"), LIBROSA),
        case("librosa_htk_nonorm_nfft25", htk_of_25, vector!("librosa_htk_nonorm_nfft25"), LIBROSA),
        case("librosa_slaney_26_512", librosa(), vector!("librosa_slaney_26_512"), LIBROSA),
        case("librosa_htk_26_512_lifter22", htk_lifted, vector!("librosa_htk_26_512_lifter22"), LIBROSA),
        case("recommended", recommended(), vector!("recommended_htk20_64_hop15"), PSF),
    ]
}

fn check(name: &str, got: &Array2<f64>, golden: &Array2<f64>, tolerance: f64) {
    assert_eq!(got.dim(), golden.dim(), "{name}");
    for ((at, got), golden) in got.indexed_iter().zip(golden) {
        // Half a unit of the last digit in the file.
        let tolerance = tolerance + 5e-12 * golden.abs();
        assert!((got - golden).abs() < tolerance, "{name} {at:?}: got {got}, expected {golden}");
    }
}

#[test]
fn coefficients_are_those_of_a_script_after_htk() {
    let x = input();
    check("htk", &coefficients(&htk(), &x), &vector!("htk_hop10"), HTK);
    check("paper", &coefficients(&paper(), &x), &vector!("htk_hop15"), HTK);
}

#[test]
fn coefficients_are_those_of_the_libraries() {
    let (x, summary) = (input(), summary());
    for Case { name, options, golden, tolerance } in cases() {
        let got = coefficients(&options, &x);
        check(name, &got, &golden, tolerance);
        // The first row again, with all digits.
        for (k, golden) in row(&summary[name]["row0"]).into_iter().enumerate() {
            assert!(
                (got[[0, k]] - golden).abs() < tolerance,
                "{name} c{k}: got {}, expected {golden}",
                got[[0, k]]
            );
        }
    }
}

#[test]
fn the_recommended_means_are_those_of_the_reference() {
    let golden = summary();
    let got = coefficients(&recommended(), &input());
    for (k, golden) in row(&golden["recommended"]["mean"]).into_iter().enumerate() {
        let mean = got.column(k).sum() / got.nrows() as f64;
        assert!((mean - golden).abs() < 1e-11, "c{k}: got {mean}, expected {golden}");
    }
    for (k, golden) in row(&golden["recommended"]["row1"]).into_iter().enumerate() {
        assert!((got[[1, k]] - golden).abs() < 1e-11, "c{k}");
    }
}

#[test]
fn filters_are_those_of_the_libraries() {
    let close = |options: &MfccOptions, n_transform, golden: &Array2<f64>| {
        let got = filter_bank(options, RATE, n_transform);
        assert_eq!(got.dim(), golden.dim());
        // The files have eight digits of numbers up to 1, and ten for the recommended preset.
        assert!(distance(&got, golden) < 1e-8, "{}: {}", options.label, distance(&got, golden));
        distance(&got, golden)
    };
    close(&python_speech_features(), 512, &vector!("fb_psf_26_512"));
    close(&librosa(), 512, &vector!("fb_librosa_slaney_26_512"));
    assert!(close(&recommended(), 64, &vector!("fb_recommended_htk20_64")) < 1e-10);
    let edges: Vec<f64> = mel_edges(&recommended()).into_iter().map(|f: Hertz| f.0).collect();
    for (got, golden) in edges.iter().zip(row(&summary()["mel_edges_htk_M20"])) {
        assert!((got - golden).abs() < 1e-10, "got {got}, expected {golden}");
    }
}

#[test]
fn what_libraries_do_differently_would_be_seen() {
    let x = input();
    let golden = |name: &str| cases().into_iter().find(|c| c.name == name).unwrap();
    let wrong = |name: &str, change: fn(MfccOptions) -> MfccOptions| {
        let Case { options, golden, .. } = golden(name);
        let rows = Slice::from(..golden.nrows());
        distance(&coefficients(&change(options), &x).slice_axis(Axis(0), rows).to_owned(), &golden)
    };
    let by = [
        wrong("librosa_htk_26_512_lifter22", |o| MfccOptions { lifter: Lifter::FromZero(22.0), ..o }),
        wrong("librosa_slaney_26_512", |o| MfccOptions { scale: MelScale::Htk, ..o }),
        wrong("librosa_slaney_nfft25", |o| MfccOptions { window: Window::Hamming, ..o }),
        wrong("psf_default_hop15", |o| MfccOptions { shape: FilterShape::Triangle, ..o }),
        wrong("psf_default_hop15", |o| MfccOptions { pre_emphasis: 0.9699, ..o }),
        wrong("psf_default_hop15", |o| MfccOptions { first: FirstCoefficient::OfTransform, ..o }),
        wrong("recommended", |o| MfccOptions { high: Hertz(499.9), ..o }),
    ];
    assert!(by.iter().all(|d| *d > 1e-4), "{by:?}");
}
