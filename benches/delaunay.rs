//! Benchmark of Delaunay triangulation, point location and barycentric interpolation.
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer programs; `benches/run` runs
//! all in alternation. `spade`, which builds our triangulations, is also measured on its own. The note states the
//! computed result, so that equal work can be verified.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with points of the unit square, such as `delaunay_25.f64`, and query points,
//! `delaunay_drag.f64` and `delaunay_random.f64`; otherwise points are generated.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every result has a note, and some belong to a peer")]
mod measure;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;

use measure::{bench_noted, bench_peer};
use shagreen_core::maths::rng::Random;
use shagreen_core::maths::triangulation::{Triangulation, Xy};
use spade::{
    DelaunayTriangulation, FloatTriangulation as _, HasPosition, HierarchyHintGenerator, HintGenerator,
    LastUsedVertexHintGenerator, Point2, Triangulation as _,
};

/// Samples of one full period of the drag curve.
const N_DRAG: usize = 100_000;
const N_RANDOM: usize = 100_000;

/// A point with the value to interpolate.
struct Valued {
    at: Point2<f64>,
    value: f64,
}

impl HasPosition for Valued {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

type Raw<Hint> = DelaunayTriangulation<Valued, (), (), (), Hint>;

fn value(&[x, y]: &Xy) -> f64 {
    (6.0 * x).sin() + (5.0 * y).cos()
}

/// Returns the named input, or generated points.
fn input(name: &str, made_up: impl FnOnce() -> Vec<Xy>) -> Vec<Xy> {
    let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") else { return made_up() };
    let bytes = std::fs::read(Path::new(&folder).join(format!("delaunay_{name}.f64")))
        .expect("cannot read a benchmark input");
    let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("a number has eight bytes"));
    bytes.chunks_exact(16).map(|b| [number(&b[..8]), number(&b[8..])]).collect()
}

fn uniform(n: usize, seed: u64, margin: f64) -> Vec<Xy> {
    let mut random = Random::new(seed);
    (0..n).map(|_| [0; 2].map(|_| margin + (1.0 - 2.0 * margin) * random.uniform())).collect()
}

/// A curve that fills the square, sampled every millisecond.
fn drag() -> Vec<Xy> {
    let along = |t: f64, hz: f64, phase: f64| 0.5 + 0.45 * (TAU * hz * t + phase).sin();
    (0..N_DRAG).map(|i| 1e-3 * i as f64).map(|t| [along(t, 0.31, 0.0), along(t, 0.47, 1.0)]).collect()
}

fn said(points: &[Xy], (n_inside, sum): (usize, f64)) -> String {
    let share = 100.0 * n_inside as f64 / points.len() as f64;
    format!("{share:.3} % inside, mean {:.9}", sum / n_inside as f64)
}

/// Returns how many points are inside the hull, and the sum of their interpolated values.
fn ours(
    triangulation: &Triangulation,
    values: &[f64],
    found: impl Iterator<Item = Option<(usize, [f64; 3])>>,
) -> (usize, f64) {
    found.flatten().fold((0, 0.0), |(n_inside, sum), (triangle, [u, v, w])| {
        let [a, b, c] = triangulation.corners(triangle).map(|corner| values[corner]);
        (n_inside + 1, sum + u * a + v * b + w * c)
    })
}

fn spades<Hint: HintGenerator<f64>>(triangulation: &Raw<Hint>, points: &[Xy]) -> (usize, f64) {
    let barycentric = triangulation.barycentric();
    let at = |[x, y]: &Xy| barycentric.interpolate(|v| v.data().value, Point2::new(*x, *y));
    points.iter().filter_map(at).fold((0, 0.0), |(n_inside, sum), value| (n_inside + 1, sum + value))
}

fn loaded<Hint: HintGenerator<f64>>(points: &[Xy], values: &[f64]) -> Raw<Hint> {
    let valued =
        points.iter().zip(values).map(|(p, value)| Valued { at: Point2::new(p[0], p[1]), value: *value });
    Raw::bulk_load(valued.collect()).expect("spade triangulation failed")
}

fn main() {
    let drag = input("drag", drag);
    let random = input("random", || uniform(N_RANDOM, 950, 0.01));
    for n in [25, 1000, 10_000, 100_000] {
        let points = input(&n.to_string(), || uniform(n, 900 + n as u64, 0.0));
        let values: Vec<f64> = points.iter().map(value).collect();
        let case = format!("Delaunay of {n} points");
        let build = || Triangulation::new(&points).expect("triangulation failed");
        bench_noted(&case, n as f64, "point", || format!("{} triangles", build().triangles().len()));
        let raw = || loaded::<LastUsedVertexHintGenerator>(&points, &values);
        bench_peer(&case, "spade", n as f64, "point", || format!("{} triangles", raw().num_inner_faces()));
        let (built, near, anywhere) =
            (build(), raw(), loaded::<HierarchyHintGenerator<f64>>(&points, &values));
        let drag_value = || {
            let mut hint = 0;
            said(&drag, ours(&built, &values, drag.iter().map(|at| built.locate_near(*at, &mut hint))))
        };
        let case = format!("barycentric weights among {n} points along a drag");
        let note = drag_value();
        bench_noted(&case, N_DRAG as f64, "point", || {
            let mut hint = 0;
            for at in &drag {
                black_box(built.locate_near(*at, &mut hint));
            }
            note.clone()
        });
        let case = format!("interpolation among {n} points along a drag");
        bench_noted(&case, N_DRAG as f64, "value", drag_value);
        bench_peer(&case, "spade, last vertex", N_DRAG as f64, "value", || said(&drag, spades(&near, &drag)));
        let case = format!("interpolation among {n} points at random");
        bench_noted(&case, N_RANDOM as f64, "value", || {
            said(&random, ours(&built, &values, random.iter().map(|at| built.locate(*at))))
        });
        bench_peer(&case, "spade, hierarchy", N_RANDOM as f64, "value", || {
            said(&random, spades(&anywhere, &random))
        });
    }
}
