//! How fast points are triangulated, and located with their weights: one JSON line a measurement, CPU time per call, in
//! the form that the peers' programs print too (`benches/run` puts all into one rotation). `spade`, which builds our
//! triangles, is measured here too, on its own. The note says what came out, without which nobody knows what was timed.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `delaunay_25.f64`, points of the unit square, and so on, and the points to
//! locate, `delaunay_drag.f64` and `delaunay_random.f64`; without it they are made up.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints its figures and stops at what is wrong"
)]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every figure has its note and some are a peer's")]
mod measure;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;

use measure::{bench_noted, bench_peer};
use shagreen_core::rng::Random;
use shagreen_core::triangulation::{Triangulation, Xy};
use spade::{
    DelaunayTriangulation, FloatTriangulation as _, HasPosition, HierarchyHintGenerator, HintGenerator,
    LastUsedVertexHintGenerator, Point2, Triangulation as _,
};

/// As many points as it takes until the curve begins anew.
const N_DRAG: usize = 100_000;
const N_RANDOM: usize = 100_000;

/// A point and what is interpolated between the points.
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

/// The input of this name, or what stands for it.
fn input(name: &str, made_up: impl FnOnce() -> Vec<Xy>) -> Vec<Xy> {
    let Some(folder) = std::env::var_os("SHAGREEN_BENCH_INPUTS") else { return made_up() };
    let bytes = std::fs::read(Path::new(&folder).join(format!("delaunay_{name}.f64")))
        .expect("an input of the peers");
    let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
    bytes.chunks_exact(16).map(|b| [number(&b[..8]), number(&b[8..])]).collect()
}

fn uniform(n: usize, seed: u64, margin: f64) -> Vec<Xy> {
    let mut random = Random::new(seed);
    (0..n).map(|_| [0; 2].map(|_| margin + (1.0 - 2.0 * margin) * random.uniform())).collect()
}

/// A curve that fills the square, a point every thousandth of a second.
fn drag() -> Vec<Xy> {
    let along = |t: f64, hz: f64, phase: f64| 0.5 + 0.45 * (TAU * hz * t + phase).sin();
    (0..N_DRAG).map(|i| 1e-3 * i as f64).map(|t| [along(t, 0.31, 0.0), along(t, 0.47, 1.0)]).collect()
}

fn said(points: &[Xy], (n_inside, sum): (usize, f64)) -> String {
    let share = 100.0 * n_inside as f64 / points.len() as f64;
    format!("{share:.3} % inside, mean {:.9}", sum / n_inside as f64)
}

/// How many of the points are inside, and the sum of what is interpolated there.
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
    Raw::bulk_load(valued.collect()).expect("points")
}

fn main() {
    let drag = input("drag", drag);
    let random = input("random", || uniform(N_RANDOM, 950, 0.01));
    for n in [25, 1000, 10_000, 100_000] {
        let points = input(&n.to_string(), || uniform(n, 900 + n as u64, 0.0));
        let values: Vec<f64> = points.iter().map(value).collect();
        let case = format!("Delaunay of {n} points");
        let build = || Triangulation::new(&points).expect("points");
        bench_noted(&case, n as f64, "point", || format!("{} triangles", build().triangles().len()));
        let raw = || loaded::<LastUsedVertexHintGenerator>(&points, &values);
        bench_peer(&case, "spade", n as f64, "point", || format!("{} triangles", raw().num_inner_faces()));
        let (built, near, anywhere) =
            (build(), raw(), loaded::<HierarchyHintGenerator<f64>>(&points, &values));
        let drag_value = || {
            let mut hint = 0;
            said(&drag, ours(&built, &values, drag.iter().map(|at| built.locate_near(*at, &mut hint))))
        };
        let case = format!("weights among {n} points along a drag");
        let note = drag_value();
        bench_noted(&case, N_DRAG as f64, "point", || {
            let mut hint = 0;
            for at in &drag {
                black_box(built.locate_near(*at, &mut hint));
            }
            note.clone()
        });
        let case = format!("value among {n} points along a drag");
        bench_noted(&case, N_DRAG as f64, "value", drag_value);
        bench_peer(&case, "spade, last vertex", N_DRAG as f64, "value", || said(&drag, spades(&near, &drag)));
        let case = format!("value among {n} points at random");
        bench_noted(&case, N_RANDOM as f64, "value", || {
            said(&random, ours(&built, &values, random.iter().map(|at| built.locate(*at))))
        });
        bench_peer(&case, "spade, hierarchy", N_RANDOM as f64, "value", || {
            said(&random, spades(&anywhere, &random))
        });
    }
}
