//! Benchmark of the stroke network on one core: inference of one segment of 200 samples, and a training step on 32
//! segments.
//!
//! Prints one JSON line per measurement, in the format of the peer scripts; `benches/run` runs all in alternation.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `cnnlstm_batch_32x200x5.f32`, 32 segments of five channels, of which the
//! first three are used; otherwise segments are generated. The network is `literal`, as in the peers. The times here
//! include splitting strokes into segments, which the peers do not do.
#![allow(clippy::expect_used, reason = "a benchmark panics on errors")]
#![allow(clippy::print_stdout, reason = "a benchmark prints results")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;

use measure::bench;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::recording::fit::Stroke;
use shagreen_learn::cnn_lstm::Architecture;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

const N_SEGMENTS: usize = 32;
const N_SAMPLES: usize = 200;
/// Channels per sample in the file.
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
        axes_mps2: vec![channel(segments.clone(), 0)],
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
    // All segments form one batch, and there is no validation set.
    let config = TrainingConfig::paper(Architecture::literal(N_OUTPUTS), 1_000_000, None, 1);
    let mut training = Training::new(&references, config).expect("cannot start training");
    bench("CNN-LSTM, training step of 32 segments", N_SEGMENTS as f64, "segment", || {
        black_box(training.run_epoch(|_| true).expect("training step failed"));
    });
    let model = training.finish().expect("no network");
    let one = [stroke(0..1)];
    bench("CNN-LSTM, inference of one segment", 1.0, "segment", || {
        black_box(model.predict(&one).expect("inference failed"));
    });
}
