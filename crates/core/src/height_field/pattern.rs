//! Regular reliefs on a tile: ridges, weaves, studs, loops, pebbles and cells.
//!
//! Every shape is a function of position in periods, about -1 at its lowest and 1 at its highest. A smooth
//! random field bends the position, and the cells of the lattice vary in height, by the pattern's jitter.

use crate::height_field::Tile;
use crate::height_field::fractal::smooth_pair;
use crate::material::{Pattern, PatternKind};
use crate::rng::{derive_seed, lattice_uniform};
use std::f64::consts::{PI, TAU};

/// Periods over which the bending of a pattern varies.
const BEND_PERIODS: f64 = 4.0;

/// How far a thread rises and falls against its own thickness.
const CRIMP: f64 = 0.5;

/// Adds the pattern to the heights; `stretch` lengthens the bending of ridges along y.
pub(super) fn add(pattern: &Pattern, stretch: f64, tile: Tile, seed: u64, heights_m: &mut [f64]) {
    let n = tile.n_cells;
    let lattice = Lattice::new(pattern, tile, seed);
    let stretch = if pattern.kind == PatternKind::Ridges { stretch } else { 1.0 };
    let bend = smooth_pair(tile, BEND_PERIODS * pattern.period_m, stretch, derive_seed(seed, "bend"));
    let per_cell = lattice.n_periods as f64 / n as f64;
    for (i, (height, bend)) in heights_m.iter_mut().zip(&bend).enumerate() {
        let u = (i % n) as f64 * per_cell + pattern.jitter * bend.re;
        let v = (i / n) as f64 * per_cell + pattern.jitter * bend.im;
        let shape = match pattern.kind {
            PatternKind::Ridges => ridges(&lattice, u),
            PatternKind::PlainWeave => weave(&lattice, u, v, &PLAIN),
            PatternKind::Twill => weave(&lattice, u, v, &TWILL),
            PatternKind::Domes => domes(&lattice, u, v),
            PatternKind::Loops => loops(&lattice, u, v),
            PatternKind::Pebbles => pebbles(&lattice, u, v),
            PatternKind::Cells => cells(&lattice, u, v),
        };
        *height += pattern.amplitude_m * shape;
    }
}

/// The whole number of periods on a tile, and what differs from one to the next.
struct Lattice {
    n_periods: i64,
    jitter: f64,
    /// Three numbers uniform in -1 to 1 for each cell, row after row.
    variations: Vec<[f64; 3]>,
}

impl Lattice {
    fn new(pattern: &Pattern, tile: Tile, seed: u64) -> Self {
        // The repeat of the kind must close on itself too.
        let repeat = match pattern.kind {
            PatternKind::Twill => 3,
            PatternKind::PlainWeave | PatternKind::Domes | PatternKind::Loops => 2,
            PatternKind::Ridges | PatternKind::Pebbles | PatternKind::Cells => 1,
        };
        let repeats = (tile.side_m() / pattern.period_m / f64::from(repeat)).round().max(1.0);
        Self::with_periods(repeats as i64 * i64::from(repeat), pattern.jitter, seed)
    }

    fn with_periods(n_periods: i64, jitter: f64, seed: u64) -> Self {
        let cells = (0..n_periods).flat_map(|j| (0..n_periods).map(move |i| (i, j)));
        let variations = cells
            .map(|(i, j)| [1, 2, 3].map(|purpose| 2.0 * lattice_uniform(seed ^ purpose, i, j) - 1.0))
            .collect();
        Self { n_periods, jitter, variations }
    }

    /// What is particular to a cell, the same on every lap of the torus.
    fn variations(&self, i: i64, j: i64) -> [f64; 3] {
        let n = self.n_periods;
        self.variations[(j.rem_euclid(n) * n + i.rem_euclid(n)).cast_unsigned() as usize]
    }

    /// A height factor with a mean of 1 that goes smoothly from one index to the next.
    fn height_factor_along(&self, u: f64) -> f64 {
        let i = u.floor();
        let t = 0.5 - 0.5 * (PI * (u - i)).cos();
        let [a, b] = [0, 1].map(|step| self.variations(i as i64 + step, 0)[0]);
        1.0 + self.jitter * (a + t * (b - a))
    }
}

/// A sine sharpened by its second harmonic.
fn ridges(lattice: &Lattice, u: f64) -> f64 {
    let wave = (TAU * u).sin() + 0.3 * (2.0 * TAU * u + 0.7).sin();
    lattice.height_factor_along(u) * wave / 1.2
}

/// Which threads of a weave are on top, and how deep the threads along x lie.
struct Weave {
    /// The threads along y are below in one cell of so many, each row one cell on.
    repeat: i64,
    /// How much lower the threads along x lie than those along y.
    sunk: f64,
}

const PLAIN: Weave = Weave { repeat: 2, sunk: 0.0 };

/// A warp-faced twill: its filling threads are thinner and hidden.
const TWILL: Weave = Weave { repeat: 3, sunk: 0.7 };

/// Two crossing sets of round, twisted threads; the higher of the two shows.
fn weave(lattice: &Lattice, u: f64, v: f64, weave: &Weave) -> f64 {
    let over = |i: i64, j: i64| if (i + j).rem_euclid(weave.repeat) == 0 { -1.0 } else { 1.0 };
    let (i, j) = (u.floor() as i64, v.floor() as i64);
    let (across, along) = (u - u.floor() - 0.5, v - v.floor() - 0.5);
    // Half-way to the neighbor a thread is half-way between the two levels.
    let level = |offset: f64, own: f64, next: f64| own + 0.5 * (1.0 - (PI * offset).cos()) * (next - own);
    let thickness = |i: i64, axis: usize| 1.0 + lattice.jitter * lattice.variations(i, 0)[axis];
    let round = |offset: f64| (1.0 - (2.0 * offset).powi(2)).max(0.0).sqrt();
    let twist = |across: f64, along: f64| 0.09 * (TAU * (2.0 * along + 1.5 * across)).cos();

    let upright = CRIMP * level(along, over(i, j), over(i, j + along.signum() as i64))
        + thickness(i, 0) * (round(across) + twist(across, along));
    let lying = -CRIMP * level(across, over(i, j), over(i + across.signum() as i64, j))
        + thickness(j, 1) * (round(along) + twist(along, across))
        - weave.sunk;
    (upright.max(lying) - 0.7) / 0.8
}

/// Offset of the odd rows of a staggered lattice.
fn stagger(j: i64) -> f64 {
    if j.rem_euclid(2) == 0 { 0.0 } else { 0.5 }
}

/// The largest over the lattice cells near (`u`, `v`) of a shape of the offset from the cell's center.
fn highest_near(u: f64, v: f64, shape: impl Fn(i64, i64, f64, f64) -> f64) -> f64 {
    let row = v.floor() as i64;
    let mut highest = f64::NEG_INFINITY;
    for j in row - 1..=row + 1 {
        let column = (u - stagger(j)).floor() as i64;
        for i in column - 1..=column + 1 {
            let du = u - stagger(j) - i as f64 - 0.5;
            highest = highest.max(shape(i, j, du, v - j as f64 - 0.5));
        }
    }
    highest
}

fn domes(lattice: &Lattice, u: f64, v: f64) -> f64 {
    highest_near(u, v, |i, j, du, dv| {
        let height = 1.0 + lattice.jitter * lattice.variations(i, j)[0];
        // A stud with rounded shoulders: flat on top, half-way down at a third of a period.
        let distance = du.hypot(dv) / 0.33;
        2.0 * height / (1.0 + distance.powi(8)) - 1.0
    })
}

fn loops(lattice: &Lattice, u: f64, v: f64) -> f64 {
    highest_near(u, v, |i, j, du, dv| {
        let [shift_u, shift_v, rise] = lattice.variations(i, j).map(|variation| lattice.jitter * variation);
        let (du, dv) = (du - 0.8 * shift_u, dv - 0.8 * shift_v);
        let arch = 1.0 - (du / 0.54).powi(2) - (dv / 0.66).powi(2);
        // The plies of the yarn run slanted over the arch.
        let plies = 0.13 * (TAU * (3.5 * du + 1.6 * dv)).sin().abs().sqrt() - 0.05;
        2.0 * (1.0 + rise) * (arch.max(0.0).sqrt() * (0.9 + plies)) - 1.0
    })
}

/// Distances to the two nearest of the lattice's scattered points, and the cell of the nearest.
fn nearest_two(lattice: &Lattice, u: f64, v: f64) -> (f64, f64, (i64, i64)) {
    let (column, row) = (u.floor() as i64, v.floor() as i64);
    let (mut first, mut second, mut cell) = (f64::INFINITY, f64::INFINITY, (column, row));
    for j in row - 2..=row + 2 {
        for i in column - 2..=column + 2 {
            let [shift_u, shift_v, _] = lattice.variations(i, j);
            let du = u - i as f64 - 0.5 - 0.45 * shift_u;
            let dv = v - j as f64 - 0.5 - 0.45 * shift_v;
            let distance = du.hypot(dv);
            if distance < first {
                (first, second, cell) = (distance, first, (i, j));
            } else if distance < second {
                second = distance;
            }
        }
    }
    (first, second, cell)
}

fn pebbles(lattice: &Lattice, u: f64, v: f64) -> f64 {
    let (first, second, (i, j)) = nearest_two(lattice, u, v);
    let plateau = 1.0 - (-(second - first) / 0.12).exp();
    let rise = lattice.jitter * lattice.variations(i, j)[2];
    2.0 * plateau * (1.0 + rise) - 1.0
}

fn cells(lattice: &Lattice, u: f64, v: f64) -> f64 {
    let (first, second, (i, j)) = nearest_two(lattice, u, v);
    let wall = (-((second - first) / 0.22).powi(2)).exp();
    let floor = lattice.jitter * lattice.variations(i, j)[2];
    2.0 * wall.max(0.3 * floor.max(0.0)) - 1.0
}

#[cfg(test)]
mod tests {
    use super::{Lattice, Pattern, PatternKind, Tile, add, ridges};

    const TILE: Tile = Tile { n_cells: 120, spacing_m: 50e-6 };

    fn heights(kind: PatternKind, period_m: f64, jitter: f64) -> Vec<f64> {
        let pattern = Pattern { kind, period_m, amplitude_m: 1.0, jitter };
        let mut heights = vec![0.0; TILE.n_cells * TILE.n_cells];
        add(&pattern, 1.0, TILE, 5, &mut heights);
        heights
    }

    fn check_shift(kind: PatternKind, shift: (usize, usize), same: bool) {
        let n = TILE.n_cells;
        let heights = heights(kind, 1e-3, 0.0);
        let worst = (0..n * n)
            .map(|i| {
                let moved = (i / n + shift.1) % n * n + (i % n + shift.0) % n;
                (heights[i] - heights[moved]).abs()
            })
            .fold(0.0, f64::max);
        assert_eq!(worst < 1e-9, same, "{kind:?} moved by {shift:?} cells differs by {worst}");
    }

    #[test]
    fn without_jitter_each_kind_has_its_symmetry() {
        // A period is 20 cells; six fit the tile.
        check_shift(PatternKind::Ridges, (20, 7), true);
        check_shift(PatternKind::Ridges, (10, 0), false);
        check_shift(PatternKind::PlainWeave, (20, 20), true);
        check_shift(PatternKind::PlainWeave, (20, 0), false);
        check_shift(PatternKind::Twill, (20, 100), true);
        check_shift(PatternKind::Twill, (60, 0), true);
        check_shift(PatternKind::Twill, (20, 20), false);
        check_shift(PatternKind::Domes, (10, 20), true);
        check_shift(PatternKind::Domes, (20, 0), true);
        check_shift(PatternKind::Loops, (0, 40), true);
    }

    #[test]
    fn patterns_close_at_the_seam() {
        for kind in [PatternKind::Pebbles, PatternKind::Cells, PatternKind::Loops, PatternKind::Ridges] {
            let n = TILE.n_cells;
            let heights = heights(kind, 1.5e-3, 0.1);
            let step = |row: usize, a: usize, b: usize| (heights[row * n + a] - heights[row * n + b]).abs();
            let seam = (0..n).map(|row| step(row, n - 1, 0)).sum::<f64>();
            let inside = (0..n).map(|row| step(row, n / 2, n / 2 + 1)).sum::<f64>();
            // Loops and pebbles have steep flanks wherever a column happens to run, hence the factor.
            assert!(seam < 4.0 * inside, "{kind:?}: {seam} against {inside}");
        }
    }

    #[test]
    fn a_ridge_is_the_sum_of_two_sines() {
        let lattice = Lattice::with_periods(6, 0.0, 1);
        for (u, expected) in [(0.0, 0.3 * 0.7_f64.sin()), (0.25, 1.0 - 0.3 * 0.7_f64.sin())] {
            assert!((1.2 * ridges(&lattice, u) - expected).abs() < 1e-12);
        }
    }
}
