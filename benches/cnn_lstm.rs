//! How fast the network of strokes answers and learns, on one core: one segment of 200 samples, and a step over 32 of them;
//! one JSON line a measurement, in the form that the peers' scripts print too (`benches/run` puts all into one rotation).
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `cnnlstm_batch_32x200x5.f32`, 32 segments of five channels, of which the first
//! three are taken; without it they are made up. The network is `literal`, as the peers build it. What is timed holds cutting
//! strokes into segments, which the peers do not do.
#![allow(clippy::expect_used, reason = "a benchmark stops at what is wrong")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::fit::Stroke;
use shagreen_core::rng::lcg_noise;
use shagreen_learn::cnn_lstm::Architecture;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

const N_SEGMENTS: usize = 32;
const N_SAMPLES: usize = 200;
/// Channels of a sample in the file.
const N_IN_FILE: usize = 5;
const N_OUTPUTS: usize = 5;

fn samples() -> Vec<f64> {
    let n = N_SEGMENTS * N_SAMPLES * N_IN_FILE;
    let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") else { return lcg_noise(n, 1) };
    let bytes = std::fs::read(std::path::Path::new(&folder).join("cnnlstm_batch_32x200x5.f32"));
    let Ok(bytes) = bytes else { return lcg_noise(n, 1) };
    bytes.as_chunks::<4>().0.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect()
}

fn main() {
    let samples = samples();
    let channel = |segments: std::ops::Range<usize>, channel: usize| -> Vec<f64> {
        let begin = segments.start * N_SAMPLES * N_IN_FILE;
        let end = segments.end * N_SAMPLES * N_IN_FILE;
        samples[begin..end].iter().skip(channel).step_by(N_IN_FILE).copied().collect()
    };
    let stroke = |segments: std::ops::Range<usize>| Stroke {
        accel_mps2: channel(segments.clone(), 0),
        speed_mps: channel(segments.clone(), 1),
        force_n: channel(segments, 2),
    };
    let texture = |half: usize| StrokedTexture {
        id: half.to_string(),
        strokes: vec![stroke(half * N_SEGMENTS / 2..(half + 1) * N_SEGMENTS / 2)],
        attributes: vec![20.0 + 60.0 * half as f64; N_OUTPUTS],
    };
    let textures = [texture(0), texture(1)];
    let references: Vec<&StrokedTexture> = textures.iter().collect();
    // All segments are one step, and nothing is kept aside.
    let config = TrainingConfig::paper(Architecture::literal(N_OUTPUTS), 1_000_000, None, 1);
    let mut training = Training::new(&references, config).expect("a training");
    bench("CNN-LSTM, training step of 32 segments", N_SEGMENTS as f64, "segment", || {
        black_box(training.run_epoch(|_| true).expect("a step"));
    });
    let model = training.finish().expect("a network");
    let one = [stroke(0..1)];
    bench("CNN-LSTM, inference of one segment", 1.0, "segment", || {
        black_box(model.predict(&one).expect("attributes"));
    });
}
