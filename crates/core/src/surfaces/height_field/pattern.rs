//! Regular patterns on a tile: ridges, weaves, studs, loops, pebbles and cells.
//!
//! Every shape is a function of position in periods, with a minimum of about -1 and a maximum of about 1. The pattern's
//! jitter warps the position by a smooth random field and varies the heights of the lattice cells.

use crate::maths::rng::{derive_seed, lattice_uniform};
use crate::surfaces::height_field::Tile;
use crate::surfaces::height_field::fractal::smooth_pair;
use crate::surfaces::material::{Pattern, PatternKind};
use std::f64::consts::{PI, TAU};

/// Correlation length of the warp, in periods.
const BEND_PERIODS: f64 = 4.0;

/// Crimp: rise and fall of a thread relative to its thickness.
const CRIMP: f64 = 0.5;

/// Adds the pattern to the heights; `stretch` lengthens the warp of ridges along y.
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

/// A whole number of periods on a tile, and the random variation of each cell.
struct Lattice {
    n_periods: i64,
    jitter: f64,
    /// Three numbers per cell, uniform in -1 to 1, row by row.
    variations: Vec<[f64; 3]>,
}

impl Lattice {
    fn new(pattern: &Pattern, tile: Tile, seed: u64) -> Self {
        // The repeat unit of the pattern must also close at the seam.
        let repeat = pattern.kind.n_periods();
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

    /// Random numbers of a cell, the same on every lap around the periodic tile.
    fn variations(&self, i: i64, j: i64) -> [f64; 3] {
        let n = self.n_periods;
        self.variations[(j.rem_euclid(n) * n + i.rem_euclid(n)).cast_unsigned() as usize]
    }

    /// Height factor with mean 1 that varies smoothly between neighboring indices.
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
    /// Threads along y pass below in one cell of `repeat`, shifted by one cell per row.
    repeat: i64,
    /// Depth of the threads along x below those along y.
    sunk: f64,
}

const PLAIN: Weave = Weave { repeat: 2, sunk: 0.0 };

/// A warp-faced twill: its weft threads are thinner and hidden.
const TWILL: Weave = Weave { repeat: 3, sunk: 0.7 };

/// Two crossing sets of round, twisted threads; the higher thread is visible.
fn weave(lattice: &Lattice, u: f64, v: f64, weave: &Weave) -> f64 {
    let over = |i: i64, j: i64| if (i + j).rem_euclid(weave.repeat) == 0 { -1.0 } else { 1.0 };
    let (i, j) = (u.floor() as i64, v.floor() as i64);
    let (across, along) = (u - u.floor() - 0.5, v - v.floor() - 0.5);
    // Halfway to its neighbor, a thread is halfway between the two levels.
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

/// Maximum over the lattice cells near (`u`, `v`) of a shape function of the offset from the cell center.
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
        // A stud with rounded shoulders: flat on top, half its height at a third of a period.
        let distance = du.hypot(dv) / 0.33;
        2.0 * height / (1.0 + distance.powi(8)) - 1.0
    })
}

fn loops(lattice: &Lattice, u: f64, v: f64) -> f64 {
    highest_near(u, v, |i, j, du, dv| {
        let [shift_u, shift_v, rise] = lattice.variations(i, j).map(|variation| lattice.jitter * variation);
        let (du, dv) = (du - 0.8 * shift_u, dv - 0.8 * shift_v);
        let arch = 1.0 - (du / 0.54).powi(2) - (dv / 0.66).powi(2);
        // The plies of the yarn run diagonally across the loop.
        let plies = 0.13 * (TAU * (3.5 * du + 1.6 * dv)).sin().abs().sqrt() - 0.05;
        2.0 * (1.0 + rise) * (arch.max(0.0).sqrt() * (0.9 + plies)) - 1.0
    })
}

/// Distances to the two nearest scattered points (Worley noise), and the cell of the nearest point.
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
        // A period is 20 cells; the tile has six periods.
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
            // Loops and pebbles can have a steep flank at any column, hence the factor.
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
