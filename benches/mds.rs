//! Benchmark of nonmetric multidimensional scaling (MDS).
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation. The note states the final stress, so that times are comparable.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with dissimilarities and start configurations, such as `nmds_25.f32` and
//! `nmds_init_25.f32` for 25 items; otherwise they are generated.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every result has a note; elsewhere none has")]
mod measure;

use std::path::Path;

use measure::bench_noted;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::people::dissimilarities::Dissimilarities;
use shagreen_core::people::mds::{MdsOptions, nonmetric_from};

/// Relative stress decrease at which the descent stops; the peers reach no lower stress within the digits of the note.
const TOLERANCE: f64 = 1e-8;

fn floats(path: &Path) -> Vec<f64> {
    let bytes = std::fs::read(path).expect("cannot read a benchmark input");
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))).collect()
}

/// Returns dissimilarities, pair by pair, and a start configuration with two coordinates per item.
fn inputs(n_items: usize) -> (Vec<f64>, Vec<f64>) {
    if let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") {
        let folder = Path::new(&folder);
        let named = |name: &str| floats(&folder.join(format!("{name}_{n_items}.f32")));
        return (named("nmds"), named("nmds_init"));
    }
    let points = lcg_noise(4 * n_items, 1);
    let points: Vec<&[f64]> = points.chunks_exact(4).collect();
    let noise = lcg_noise(n_items * n_items, 2);
    let mut condensed = Vec::new();
    for (i, p) in points.iter().enumerate() {
        for q in &points[i + 1..] {
            let axes = p.iter().zip(*q).zip([1.0, 1.0, 0.4, 0.3]);
            let square: f64 = axes.map(|((p, q), spread)| (spread * (p - q)).powi(2)).sum();
            condensed.push(square.powf(0.7) * (0.15 * noise[condensed.len()]).exp());
        }
    }
    (condensed, points.iter().flat_map(|p| [p[0], p[1]]).collect())
}

fn main() {
    for n_items in [25, 100, 500] {
        let (condensed, start) = inputs(n_items);
        let condensed = condensed.into_iter().map(Some).collect();
        let dissimilarities = Dissimilarities::from_condensed(n_items, condensed).expect("bad input");
        let start: Vec<Vec<f64>> = start.chunks_exact(2).map(<[f64]>::to_vec).collect();
        let options = MdsOptions { tolerance: TOLERANCE, ..MdsOptions::usual(1) };
        bench_noted(&format!("nonmetric MDS of {n_items} items, one start"), 1.0, "fit", || {
            let found = nonmetric_from(&dissimilarities, &start, &options).expect("MDS failed");
            assert!(found.converged, "{n_items} items: not converged after {} steps", found.n_steps);
            format!("stress {:.7}", found.stress)
        });
    }
}
