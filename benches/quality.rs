//! Benchmark of the quality features of signal pairs.
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `quality_32pairs_2240.f32`, 32 pairs of 0.8 s at 2.8 kHz; otherwise
//! pairs are generated. The peers compute fewer features: no channel activation by amplitude, and no search for the
//! best lag.
#![allow(clippy::expect_used, reason = "a benchmark panics on errors")]
#![allow(clippy::print_stdout, reason = "a benchmark prints results")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::signals::quality::QualityMeter;
use shagreen_core::units::Hertz;
use shagreen_formats::thresholds::ThresholdKind;

const N_PAIRS: usize = 32;
const N_SAMPLES: usize = 2240;
const RATE: Hertz = Hertz(2800.0);

fn signals() -> Vec<f64> {
    let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") else {
        return lcg_noise(2 * N_PAIRS * N_SAMPLES, 1);
    };
    let path = std::path::Path::new(&folder).join("quality_32pairs_2240.f32");
    let bytes = std::fs::read(path).expect("cannot read quality_32pairs_2240.f32");
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))).collect()
}

fn main() {
    let signals = signals();
    let threshold = ThresholdKind::default().read().expect("no threshold");
    let meter = QualityMeter::new(RATE, &threshold).expect("no meter");
    bench("quality of 32 pairs of 0.8 s at 2.8 kHz", N_PAIRS as f64, "pair", || {
        for pair in signals.chunks_exact(2 * N_SAMPLES) {
            let (reference, other) = pair.split_at(N_SAMPLES);
            black_box(meter.distances(reference, other).expect("comparison failed"));
        }
    });
}
