//! How fast predictors are fitted: one JSON line a measurement, CPU time per call, in the form that the peers' scripts
//! print too (`benches/run` puts all into one rotation).
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `arfit_100x2000.f32`, 100 segments of 2,000 samples; without it segments
//! are made up.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints its figures and stops at what is wrong"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::ar::{burg, yule_walker};
use shagreen_core::rng::lcg_noise;

const N_SEGMENTS: usize = 100;
const N_SAMPLES: usize = 2000;
const ORDER: usize = 20;

fn segments() -> Vec<Vec<f64>> {
    let all: Vec<f64> = match std::env::var_os("SHAGREEN_BENCH_INPUTS") {
        None => lcg_noise(N_SEGMENTS * N_SAMPLES, 1),
        Some(folder) => {
            let path = std::path::Path::new(&folder).join("arfit_100x2000.f32");
            let bytes = std::fs::read(path).expect("the segments of the peers");
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
            black_box(burg(segment, ORDER).expect("a predictor"));
        }
    });
    bench(&format!("Yule-Walker, {N_SAMPLES} samples, order {ORDER}"), segments.len() as f64, "fit", || {
        for segment in &segments {
            black_box(yule_walker(segment, ORDER).expect("a predictor"));
        }
    });
}
