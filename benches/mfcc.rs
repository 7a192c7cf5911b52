//! How fast cepstral coefficients are taken: one JSON line a measurement, CPU time per call, in the form that the peers'
//! scripts print too (`benches/run` puts all into one rotation).
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `mfcc_25x25s_1kHz.f32`, 25 signals of 25 s at 1 kHz; without it signals are
//! made up. All take 13 coefficients of 26 mel filters from 10 to 500 Hz, from frames of 25 ms under Hamming's window every
//! 10 ms, by a transform of 256 samples.
#![allow(clippy::expect_used, reason = "a benchmark stops at what is wrong")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::mfcc::{Logarithm, MfccOptions, MfccPlan, Spectrum, TransformLength, recommended};
use shagreen_core::rng::lcg_noise;
use shagreen_core::units::Hertz;

const N_SIGNALS: usize = 25;
const N_SAMPLES: usize = 25_000;
const RATE: Hertz = Hertz(1000.0);

fn signals() -> Vec<Vec<f64>> {
    let all: Vec<f64> = match std::env::var_os("SHAGREEN_BENCH_INPUTS") {
        None => lcg_noise(N_SIGNALS * N_SAMPLES, 1),
        Some(folder) => {
            let path = std::path::Path::new(&folder).join("mfcc_25x25s_1kHz.f32");
            let bytes = std::fs::read(path).expect("the signals of the peers");
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
    let plan = MfccPlan::new(&options(), RATE).expect("a plan");
    bench("MFCC, 25 signals of 25 s at 1 kHz", signals.len() as f64, "signal", || {
        for signal in &signals {
            black_box(plan.coefficients(signal).expect("coefficients"));
        }
    });
    // The libraries among the peers make their filters anew for every signal.
    bench("MFCC, 1 signal of 25 s at 1 kHz", 1.0, "signal", || {
        let plan = MfccPlan::new(&options(), RATE).expect("a plan");
        black_box(plan.coefficients(&signals[0]).expect("coefficients"));
    });
}
