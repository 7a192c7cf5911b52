//! Start triangles for point location: a grid with about one cell for each point, which stores a triangle near each
//! cell.
//!
//! Cells are numbered along a Hilbert curve, and triangles are sorted by the cell of their centroid. Neighboring
//! triangles therefore mostly share cache lines or pages. The counting sort also yields each cell's first triangle,
//! where walks to that cell start. A cell without triangles gets the next triangle on the curve.

use crate::maths::triangulation::Xy;

/// Grid of start triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    lowest: Xy,
    cells_per_unit: Xy,
    /// Number of cells along each axis.
    side: usize,
    /// First triangle of each cell, row by row. Before the triangles are sorted, the cell's number on the curve.
    cells: Vec<u32>,
}

impl Grid {
    /// Grid over the bounding box of `points`, which must not be empty.
    pub(super) fn new(points: &[Xy]) -> Self {
        let bounds = |axis: usize| {
            let along = points.iter().map(|p| p[axis]);
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| (low.min(c), high.max(c)))
        };
        let bounds = [bounds(0), bounds(1)];
        let log2_side = (0.5 * (points.len() as f64).log2()).round() as u32;
        let side = 1_usize << log2_side;
        let lowest = bounds.map(|(low, _)| low);
        let cells_per_unit = bounds.map(|(low, high)| side as f64 / (high - low));
        Self { lowest, cells_per_unit, side, cells: hilbert(log2_side) }
    }

    /// Sorts triangles by cell with a counting sort, and returns the new index of each triangle. `places` holds the
    /// curve number of each triangle's cell, from [`Grid::near`] of the centroid. Afterwards each cell stores its first
    /// triangle.
    pub(super) fn settle(&mut self, mut places: Vec<u32>) -> Vec<u32> {
        let mut starts = vec![0; self.cells.len() + 1];
        for cell in &places {
            starts[*cell as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let last = places.len().saturating_sub(1) as u32;
        for cell in &mut self.cells {
            *cell = starts[*cell as usize].min(last);
        }
        for place in &mut places {
            let free = &mut starts[*place as usize];
            *place = *free;
            *free += 1;
        }
        places
    }

    /// First triangle of the cell that contains `at`, or of the nearest cell. Before the sort: the cell's number on the
    /// curve.
    pub(super) fn near(&self, at: Xy) -> usize {
        // The cast turns negative numbers and NaN into zero.
        let cell = |axis: usize| ((at[axis] - self.lowest[axis]) * self.cells_per_unit[axis]) as usize;
        let [x, y] = [cell(0), cell(1)].map(|c| c.min(self.side.saturating_sub(1)));
        self.cells.get(y * self.side + x).map_or(0, |cell| *cell as usize)
    }
}

/// Numbers along the Hilbert curve of the cells of a square with `2^log2_side` cells on each side, row by row.
fn hilbert(log2_side: u32) -> Vec<u32> {
    let mut numbers = vec![0];
    let mut side = 1_usize;
    for _ in 0..log2_side {
        let quarter = numbers.len() as u32;
        let mut doubled = vec![0; 4 * numbers.len()];
        let mut put = |x: usize, y: usize, number: u32| doubled[y * 2 * side + x] = number;
        for (y, row) in numbers.chunks_exact(side).enumerate() {
            for (x, number) in row.iter().enumerate() {
                put(y, x, *number);
                put(x, side + y, quarter + number);
                put(side + x, side + y, 2 * quarter + number);
                put(2 * side - 1 - y, side - 1 - x, 3 * quarter + number);
            }
        }
        numbers = doubled;
        side *= 2;
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::{Grid, hilbert};

    #[test]
    fn the_curve_steps_from_cell_to_neighbor_through_all_cells() {
        for log2_side in 0..6 {
            let side = 1_usize << log2_side;
            let mut cells = vec![None; side * side];
            for (cell, number) in hilbert(log2_side).into_iter().enumerate() {
                assert_eq!(cells[number as usize].replace([cell % side, cell / side]), None);
            }
            let cells: Vec<[usize; 2]> = cells.into_iter().flatten().collect();
            let step = |w: &[[usize; 2]]| w[0][0].abs_diff(w[1][0]) + w[0][1].abs_diff(w[1][1]);
            assert!(cells.windows(2).all(|w| step(w) == 1));
        }
    }

    #[test]
    fn triangles_stand_in_the_order_of_their_cells_and_cells_know_the_first() {
        let points: Vec<[f64; 2]> = (0..64).map(|i| [f64::from(i % 8), f64::from(i / 8)]).collect();
        let mut grid = Grid::new(&points);
        assert_eq!(grid.side, 8);
        let middles: Vec<[f64; 2]> = points.iter().rev().step_by(3).copied().collect();
        let curve = grid.clone();
        let places = grid.settle(middles.iter().map(|at| curve.near(*at) as u32).collect());
        let mut cells = vec![usize::MAX; middles.len()];
        for (middle, place) in middles.iter().zip(&places) {
            assert_eq!(cells[*place as usize], usize::MAX, "two triangles have the same index");
            cells[*place as usize] = curve.near(*middle);
        }
        assert!(cells.is_sorted());
        for at in points {
            // The first triangle of this cell or of a later cell, or the last triangle.
            let (first, cell) = (grid.near(at), curve.near(at));
            assert!(first == 0 || cells[first - 1] < cell);
            assert!(cells[first] >= cell || first + 1 == cells.len());
        }
        assert_eq!(grid.near([-1e300, f64::NAN]), grid.near([0.0, 0.0]));
        assert_eq!(grid.near([1e300, f64::INFINITY]), grid.near([7.0, 7.0]));
    }
}
