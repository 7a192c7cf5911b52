//! Benchmark of spatial spectrograms: transform, inverse transform and refinement.
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation. The note states the reconstruction accuracy, so that times are comparable.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `profile_100mm_1um.f32`, a profile of 100 mm in steps of 1 µm; otherwise
//! one is generated. Windows are 20 to 0.2 mm long, with a hop of a quarter window.
#![allow(clippy::expect_used, reason = "a benchmark panics on errors")]
#![allow(clippy::print_stdout, reason = "a benchmark prints results")]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every result has a note; elsewhere none has")]
mod measure;

use std::hint::black_box;

use measure::bench_noted;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::signals::quality::snr_db;
use shagreen_core::signals::spatial_spectrogram::{
    Framing, PAPER_WINDOWS_M, SpatialSpectrogram, Transform, profile_of, refine, spectral_convergence,
};

const STEP_M: f64 = 1e-6;
const N_SAMPLES: usize = 100_000;
/// Window length of the refinement, in m, and its number of iterations.
const REFINED_M: f64 = 2e-3;
const N_STEPS: usize = 32;

fn profile() -> Vec<f64> {
    let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") else {
        return lcg_noise(N_SAMPLES, 1).into_iter().map(|x| 0.5 + 0.1 * x).collect();
    };
    let path = std::path::Path::new(&folder).join("profile_100mm_1um.f32");
    let bytes = std::fs::read(path).expect("cannot read profile_100mm_1um.f32");
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))).collect()
}

fn transform(window_m: f64) -> Transform {
    let framing = Framing::of_length(window_m, STEP_M);
    Transform::new(framing.with_hop(framing.window() / 4).expect("invalid hop"))
}

fn main() {
    let profile = profile();
    let transforms = PAPER_WINDOWS_M.map(transform);
    bench_noted("spatial spectrogram of 100 mm, 7 windows", 1.0, "profile", || {
        for transform in &transforms {
            black_box(transform.spectra(&profile).expect("transform failed"));
        }
        String::new()
    });
    let spectra = transforms.each_ref().map(|t| t.spectra(&profile).expect("transform failed"));
    bench_noted("inverse spatial spectrogram of 100 mm, 7 windows", 1.0, "profile", || {
        let made = transforms.iter().zip(&spectra).map(|(t, spectra)| snr_db(&profile, &t.profile(spectra)));
        format!("{:.0} dB", made.fold(f64::INFINITY, f64::min))
    });
    let refined = transform(REFINED_M);
    let spectrogram = SpatialSpectrogram::of(&profile, &refined).expect("no spectrogram");
    bench_noted("Griffin-Lim, 32 iterations, windows of 2 mm", 1.0, "profile", || {
        let start = profile_of(&spectrogram, &refined);
        let made = refine(&spectrogram, &start, N_STEPS).expect("refinement failed");
        let power = SpatialSpectrogram::of(&made, &refined).expect("no spectrogram");
        let off = spectral_convergence(spectrogram.power(), power.power(), 0);
        format!("{:.1} dB", -20.0 * off.log10())
    });
}
