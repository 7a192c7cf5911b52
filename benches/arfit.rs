//! Benchmark of AR model fitting (Burg, Yule-Walker).
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `arfit_100x2000.f32`, 100 segments of 2,000 samples; otherwise segments
//! are generated.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::dsp::ar::{burg, yule_walker};
use shagreen_core::maths::rng::lcg_noise;

const N_SEGMENTS: usize = 100;
const N_SAMPLES: usize = 2000;
const ORDER: usize = 20;

fn segments() -> Vec<Vec<f64>> {
    let all: Vec<f64> = match std::env::var_os("SHAGREEN_BENCH_INPUTS") {
        None => lcg_noise(N_SEGMENTS * N_SAMPLES, 1),
        Some(folder) => {
            let path = std::path::Path::new(&folder).join("arfit_100x2000.f32");
            let bytes = std::fs::read(path).expect("cannot read arfit_100x2000.f32");
            let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
            bytes.chunks_exact(4).map(float).collect()
        }
    };
    all.chunks_exact(N_SAMPLES).map(<[f64]>::to_vec).collect()
}

fn main() {
    let segments = segments();
    bench(&format!("Burg, {N_SAMPLES} samples, order {ORDER}"), segments.len() as f64, "fit", || {
        for segment in &segments {
            black_box(burg(segment, ORDER).expect("no AR model"));
        }
    });
    bench(&format!("Yule-Walker, {N_SAMPLES} samples, order {ORDER}"), segments.len() as f64, "fit", || {
        for segment in &segments {
            black_box(yule_walker(segment, ORDER).expect("no AR model"));
        }
    });
}
