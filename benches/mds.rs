//! How fast items are placed by nonmetric multidimensional scaling: one JSON line a measurement, CPU time per call, in
//! the form that the peers' scripts print too (`benches/run` puts all into one rotation). The note is the stress that was
//! reached, without which a time says nothing.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `nmds_25.f32`, the dissimilarities of 25 items, and `nmds_init_25.f32`,
//! points to start from, and so on; without it they are made up.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints its figures and stops at what is wrong"
)]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every figure has its note; elsewhere none has")]
mod measure;

use std::path::Path;

use measure::bench_noted;
use shagreen_core::dissimilarities::Dissimilarities;
use shagreen_core::mds::{MdsOptions, nonmetric_from};
use shagreen_core::rng::lcg_noise;

/// Share of stress that a step may still gain when the descent stops: peers come no lower in the digits of the note.
const TOLERANCE: f64 = 1e-8;

fn floats(path: &Path) -> Vec<f64> {
    let bytes = std::fs::read(path).expect("an input of the peers");
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))).collect()
}

/// Dissimilarities, pair by pair, and points to start from, two coordinates each.
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
        let dissimilarities = Dissimilarities::from_condensed(n_items, condensed).expect("dissimilarities");
        let start: Vec<Vec<f64>> = start.chunks_exact(2).map(<[f64]>::to_vec).collect();
        let options = MdsOptions { tolerance: TOLERANCE, ..MdsOptions::usual(1) };
        bench_noted(&format!("nonmetric MDS of {n_items} items, one start"), 1.0, "fit", || {
            let found = nonmetric_from(&dissimilarities, &start, &options).expect("points");
            assert!(found.converged, "{n_items} items after {} steps", found.n_steps);
            format!("stress {:.7}", found.stress)
        });
    }
}
