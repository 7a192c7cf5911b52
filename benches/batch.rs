//! Benchmark of batches: textures of 10 s at 8 kHz, in times of real time on one core. The aim is a thousand times.
//!
//! Prints one JSON line per measurement, as `live`. The last case writes its files and flushes them to the disk, so it is by the
//! clock: on an idle machine, the difference to the case before is what the disk takes.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::time::Instant;

use measure::bench;
use serde_json::json;
use shagreen_core::maths::shard::Shard;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::batch_manifest::read_batch_manifest;
use shagreen_formats::starter::starter_library;
use shagreen_formats::wav::{SidecarV1, wav_bytes};
use shagreen_formats::wav_encoding::SampleType;
use shagreen_studio::batch::{BatchOptions, BatchPlan, BatchSources, LoadedStroke, plan};
use shagreen_studio::render::{SampleFormat, render_prepared};
use shagreen_studio::report::Warnings;

const RATE_HZ: u32 = 8000;
const SECS: f64 = 10.0;
/// Points of the space along each axis: 500 textures.
const N_POINTS: [usize; 2] = [25, 20];

/// The manifest of textures at points of the space.
fn points_manifest() -> String {
    let [n_x, n_y] = N_POINTS;
    let coordinate = |i: usize, n: usize| 25.0 + 50.0 * i as f64 / n as f64;
    let points: Vec<String> = (0..n_x * n_y)
        .map(|i| format!("[{}, {}]", coordinate(i % n_x, n_x), coordinate(i / n_x, n_y)))
        .collect();
    format!(
        "format = \"shagreen-batch\"\nversion = \"1.0\"\nname = \"Bench\"\n[[texture]]\nat = [{}]\n\
        [[stroke]]\nid = \"steady\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = {SECS}\n\
        [[output]]\nid = \"wav\"\nformat = \"wav\"\nrate_hz = {RATE_HZ}\nbits = 16\n",
        points.join(", ")
    )
}

fn planned(contact: Contact) -> BatchPlan {
    let manifest = read_batch_manifest(points_manifest().as_bytes()).expect("a manifest");
    let sources = BatchSources {
        library: starter_library().expect("no starter library"),
        project: None,
        strokes: vec![LoadedStroke::Steady { contact, seconds: SECS }],
        actuators: vec![None],
    };
    plan(manifest, sources, (Vec::new(), "bench"), &Warnings::default()).expect("a batch")
}

fn main() {
    let contact = Contact::from_mm_per_s_and_n(60.0, 0.5);
    let library = starter_library().expect("no starter library");
    let textures: Vec<Vec<(Prepared, f64)>> =
        library.textures.iter().map(|entry| vec![(Plane::new(&entry.model).prepare(), 1.0)]).collect();
    let format = SampleFormat { rate: Hertz(f64::from(RATE_HZ)), seconds: SECS, seed: 1, loops: false };
    let secs = SECS * textures.len() as f64;
    let render = |voices: &Vec<(Prepared, f64)>| {
        let mut hand = |_: f64| contact;
        render_prepared(voices, Mode::Shared, format, &mut hand).expect("a signal")
    };
    bench("batch: 10 s at 8 kHz, rendered", secs, "second", || {
        for voices in &textures {
            black_box(render(voices));
        }
    });
    let sidecar = SidecarV1::new(RATE_HZ, SECS, 1, "bench");
    bench("batch: 10 s at 8 kHz, rendered and encoded", secs, "second", || {
        for voices in &textures {
            black_box(wav_bytes(&render(voices), &sidecar, (SampleType::Pcm16, 10.0)).expect("a file"));
        }
    });

    let plan = planned(contact);
    let folder = tempfile::tempdir().expect("no folder for temporary files");
    let options =
        BatchOptions { folder: folder.path(), n_threads: 1, shard: Shard::WHOLE, created_by: "bench" };
    let begun = Instant::now();
    let outcome = plan.run(&options, &|| true).expect("a run");
    let wall_s = begun.elapsed().as_secs_f64();
    assert_eq!(outcome.n_written(), plan.n_textures(), "some textures are missing");
    let units = SECS * plan.n_textures() as f64;
    // The work is on another thread, so that only the clock measures it.
    let line = json!({
        "case": "batch: 500 points of the space, with files", "peer": "shagreen", "wall_s": wall_s, "cpu_s": wall_s,
        "units": units, "unit": "second", "threads": 1, "inner": 1, "per_s": units / wall_s, "note": "by the clock",
    });
    println!("{line}");
}
