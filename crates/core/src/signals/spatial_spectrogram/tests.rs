use proptest::prelude::{prop, prop_assert, proptest};
use rustfft::num_complex::Complex;
use serde_json::Value;

use super::phase::{staircase, with_phases};
use super::{
    Edges, Framing, FramingError, PAPER_WINDOWS_M, RefineError, SpatialSpectrogram, Transform, fidelity,
    fidelity_by_window, profile_of, refine, spectral_convergence,
};
use crate::maths::rng::lcg_noise;
use crate::signals::profile_stimuli::{PaperTexture, STEP_M};

fn golden(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Windows inside the profile only, as in the paper.
fn cut(window: usize) -> Transform {
    Transform::new(Framing::new(window).unwrap().with_edges(Edges::Cut))
}

#[test]
fn golden_small_profile() {
    let v = golden(include_str!("../../../../../vectors/j_spec/vectors.json"));
    let (profile, transform) = (numbers(&v["f"]), cut(8));
    let spectrogram = SpatialSpectrogram::of(&profile, &transform).unwrap();
    assert_eq!(spectrogram.offset(), 0.0);
    for (bins, golden) in spectrogram.power().frames().zip(v["S"].as_array().unwrap()) {
        assert!(largest_difference(bins, &numbers(golden)) < 1e-12);
    }
    let centers: Vec<f64> = (0..3).map(|frame| transform.framing().center(frame)).collect();
    assert_eq!(centers, numbers(&v["centres"]));
    assert!(largest_difference(&staircase(&spectrogram, &transform), &numbers(&v["d_paper_edge"])) < 1e-12);
    assert!(largest_difference(&profile_of(&spectrogram, &transform), &numbers(&v["y_paper"])) < 1e-10);
    let exact = transform.profile(&transform.spectra(&profile).unwrap());
    assert!(largest_difference(&exact, &numbers(&v["istft_exact"])) < 1e-12);
}

/// Reference table: correlation, envelope correlation and spectral convergence for every texture and window length.
///
/// Where two staircase steps are nearly equal, round-off affects the phases, so the noisy textures A and C have a wider
/// tolerance.
#[test]
fn golden_table() {
    let v = golden(include_str!("../../../../../vectors/j_spec/results.json"));
    for texture in PaperTexture::ALL {
        let profile = texture.profile(8000);
        for window_m in PAPER_WINDOWS_M {
            let transform = Transform::new(Framing::of_length(window_m, STEP_M).with_edges(Edges::Cut));
            let spectrogram = SpatialSpectrogram::of(&profile, &transform).unwrap();
            let made = profile_of(&spectrogram, &transform);
            let got = fidelity(&profile, &made, STEP_M, &spectrogram, &transform).unwrap();
            let window = format!("{}", (window_m * 1e4).round() / 10.0);
            let want = &v[texture.name()][&window]["paper"];
            for (got, key) in [
                (got.correlation, "corr"),
                (got.envelope_correlation, "env"),
                (got.spectral_convergence, "sc_ac"),
            ] {
                let want = want[key].as_f64().unwrap();
                let is_noisy = matches!(texture, PaperTexture::A | PaperTexture::C);
                let tolerance = if is_noisy { 0.1 } else { 0.03 };
                assert!(
                    (got - want).abs() < tolerance,
                    "{} {window} mm, {key}: {got}, not {want}",
                    texture.name()
                );
            }
        }
    }
}

#[test]
fn the_narrowest_windows_keep_every_texture() {
    for texture in PaperTexture::ALL {
        let framings = PAPER_WINDOWS_M.map(|window_m| Framing::of_length(window_m, STEP_M));
        let kept = fidelity_by_window(&texture.profile(8000), STEP_M, &framings).unwrap();
        let narrowest = kept.last().unwrap();
        assert!(narrowest.envelope_correlation >= 0.99, "{}: {narrowest:?}", texture.name());
        assert!(kept[0].envelope_correlation < 0.5, "{}: {:?}", texture.name(), kept[0]);
    }
}

#[test]
fn more_steps_fit_the_spectrogram_better() {
    for texture in PaperTexture::ALL {
        let profile = texture.profile(4000);
        let transform = Transform::new(Framing::of_length(1e-3, STEP_M));
        let spectrogram = SpatialSpectrogram::of(&profile, &transform).unwrap();
        let start = profile_of(&spectrogram, &transform);
        let apart = |profile: &[f64]| {
            fidelity(profile, profile, STEP_M, &spectrogram, &transform).unwrap().spectral_convergence
        };
        let refined = refine(&spectrogram, &start, 60).unwrap();
        assert!(apart(&refined) < 0.5 * apart(&start), "{}", texture.name());
        // A profile that matches the spectrogram stays unchanged, up to single precision.
        let same = refine(&spectrogram, &profile, 3).unwrap();
        assert!(largest_difference(&same, &profile) < 1e-5);
    }
    let transform = Transform::new(Framing::new(8).unwrap());
    let spectrogram = SpatialSpectrogram::of(&[0.5; 20], &transform).unwrap();
    assert_eq!(refine(&spectrogram, &[0.5; 19], 1), Err(RefineError::Mismatch));
}

/// Corrects an error in the printed equations: level and sign of a constant are preserved.
#[test]
fn constants_keep_their_level_and_their_sign() {
    for level in [0.7, -0.7, 0.0] {
        for edges in [Edges::Cut, Edges::Mirrored] {
            let transform = Transform::new(Framing::new(100).unwrap().with_edges(edges));
            let spectrogram = SpatialSpectrogram::of(&[level; 1000], &transform).unwrap();
            let made = profile_of(&spectrogram, &transform);
            assert!(largest_difference(&made, &[level; 1000]) < 1e-12, "{level}, {edges:?}");
        }
    }
}

/// Two equal local means leave only round-off: their phases are set to zero, on every machine.
#[test]
fn phases_that_nothing_tells_are_zero() {
    let transform = cut(64);
    let spectrogram = SpatialSpectrogram::of(&[0.7; 640], &transform).unwrap();
    let spectra = with_phases(&spectrogram, &transform);
    // Bin 1 of the window itself is negative.
    let beyond_window = spectra.frames().flat_map(|bins| &bins[2..]);
    assert!(beyond_window.into_iter().all(|bin| bin.im == 0.0 && bin.re >= 0.0));
}

#[test]
fn one_window_is_its_transform() {
    let profile = lcg_noise(16, 3);
    let spectra = cut(16).spectra(&profile).unwrap();
    let bins = spectra.frames().next().unwrap();
    for (k, bin) in bins.iter().enumerate() {
        let slow: Complex<f64> = (0..16)
            .map(|n| {
                let angle = std::f64::consts::TAU * n as f64 / 16.0;
                Complex::from_polar((0.5 - 0.5 * angle.cos()) * profile[n], -angle * k as f64)
            })
            .sum();
        assert!((bin - slow).norm() < 1e-12, "{k}: {bin} and {slow}");
    }
}

#[test]
fn what_cannot_be_cut_is_named() {
    assert_eq!(Framing::new(7), Err(FramingError::Window { window: 7 }));
    assert_eq!(Framing::new(2), Err(FramingError::Window { window: 2 }));
    let framing = Framing::new(8).unwrap();
    for hop in [0, 3, 8] {
        assert_eq!(framing.with_hop(hop), Err(FramingError::Hop { hop, window: 8 }));
    }
    assert!(matches!(cut(8).power(&[0.0; 7]), Err(FramingError::Short { needed: 8, .. })));
    assert!(matches!(cut(8).power(&[0.0; 9]), Err(FramingError::Ragged { n_samples: 9, hop: 4 })));
    let mirrored = Transform::new(framing);
    assert!(matches!(mirrored.power(&[0.0]), Err(FramingError::Short { needed: 2, .. })));
    assert_eq!(mirrored.power(&[0.0, f64::NAN]), Err(FramingError::NotFinite { index: 1 }));
    assert_eq!(Framing::of_length(0.2e-3, STEP_M).window(), 20);
    assert_eq!(Framing::of_length(0.0, STEP_M).window(), 4);
}

proptest! {
    /// Unmodified spectra reconstruct the profile, for any framing and length.
    #[test]
    fn true_phases_give_the_profile_back(
        profile in prop::collection::vec(-1.0_f64..1.0, 2..300),
        half in 2_usize..80,
        is_quarter in prop::bool::ANY,
    ) {
        let framing = Framing::new(2 * half).unwrap();
        let framing = if is_quarter && half % 2 == 0 { framing.with_hop(half / 2).unwrap() } else { framing };
        let transform = Transform::new(framing);
        let spectra = transform.spectra(&profile).unwrap();
        prop_assert!(largest_difference(&transform.profile(&spectra), &profile) < 1e-12);
        let power = transform.power(&profile).unwrap();
        prop_assert!(spectral_convergence(&power, &power, 0) == 0.0);
        for (a, b) in power.frames().flatten().zip(spectra.frames().flatten()) {
            prop_assert!((a - b.norm_sqr()).abs() < 1e-9);
        }
    }

    /// Any painted spectrogram gives a finite profile.
    #[test]
    fn painted_spectrograms_sound(
        painted in prop::collection::vec(-1.0_f64..100.0, 45),
        offset in 0.0_f64..1.0,
    ) {
        let transform = Transform::new(Framing::new(16).unwrap());
        let mut spectrogram = SpatialSpectrogram::of(&[-offset; 24], &transform).unwrap();
        for (power, painted) in spectrogram.power.frames_mut().flatten().zip(painted) {
            *power = painted;
        }
        prop_assert!(profile_of(&spectrogram, &transform).iter().all(|x| x.is_finite()));
    }
}
