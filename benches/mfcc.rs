//! Benchmark of mel-frequency cepstral coefficients (MFCC).
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `mfcc_25x25s_1kHz.f32`, 25 signals of 25 s at 1 kHz; otherwise signals
//! are generated. Settings: 13 coefficients, 26 mel filters from 10 to 500 Hz, Hamming frames of 25 ms every 10 ms, FFT
//! of 256 samples.
#![allow(clippy::expect_used, reason = "a benchmark panics on errors")]
#![allow(clippy::print_stdout, reason = "a benchmark prints results")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::dsp::mfcc::{Logarithm, MfccOptions, MfccPlan, Spectrum, TransformLength, recommended};
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::units::Hertz;

const N_SIGNALS: usize = 25;
const N_SAMPLES: usize = 25_000;
const RATE: Hertz = Hertz(1000.0);

fn signals() -> Vec<Vec<f64>> {
    let all: Vec<f64> = match std::env::var_os("SHAGREEN_BENCH_INPUTS") {
        None => lcg_noise(N_SIGNALS * N_SAMPLES, 1),
        Some(folder) => {
            let path = std::path::Path::new(&folder).join("mfcc_25x25s_1kHz.f32");
            let bytes = std::fs::read(path).expect("cannot read mfcc_25x25s_1kHz.f32");
            let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
            bytes.chunks_exact(4).map(float).collect()
        }
    };
    all.chunks_exact(N_SAMPLES).map(<[f64]>::to_vec).collect()
}

fn options() -> MfccOptions {
    MfccOptions {
        hop_secs: 0.010,
        transform: TransformLength::Samples(256),
        spectrum: Spectrum::Power,
        n_filters: 26,
        logarithm: Logarithm::Floored { floor: 1e-10 },
        ..recommended()
    }
}

fn main() {
    let signals = signals();
    let plan = MfccPlan::new(&options(), RATE).expect("no plan");
    bench("MFCC, 25 signals of 25 s at 1 kHz", signals.len() as f64, "signal", || {
        for signal in &signals {
            black_box(plan.coefficients(signal).expect("MFCC failed"));
        }
    });
    // The peer libraries build their filter bank again for every signal.
    bench("MFCC, 1 signal of 25 s at 1 kHz", 1.0, "signal", || {
        let plan = MfccPlan::new(&options(), RATE).expect("no plan");
        black_box(plan.coefficients(&signals[0]).expect("MFCC failed"));
    });
}
