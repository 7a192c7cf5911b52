//! Interpolation of scattered points in the plane with linear radial basis functions.
//!
//! `s(q) = Σ λ_i φ(|q - q_i|) + c_0 + c_1 x + c_2 y` with `φ(r) = -r` and `Σ λ_i = Σ λ_i x_i = Σ λ_i y_i = 0`.

mod basis;

pub(crate) use crate::maths::radial_basis::basis::{Basis, Kernel};

use crate::maths::triangulation::Xy;

/// Several interpolated functions of the plane, defined at the same points.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialBasis {
    basis: Basis<2>,
    /// Rows: one for each point, then the constant, then one for each direction. Columns: one for each function.
    weights: Vec<Vec<f64>>,
}

impl RadialBasis {
    /// Fits functions to `values`: one row for each point, one column for each function. `ridge` is added to the
    /// diagonal: a larger value smooths more and interpolates less exactly.
    ///
    /// Returns `None` if there are no points, if the row count or row lengths disagree, or if points are too close for
    /// a unique solution. Cost: cubic in the number of points.
    pub fn new(points: &[Xy], values: &[Vec<f64>], ridge: f64) -> Option<Self> {
        let n = points.len();
        let n_functions = values.first()?.len();
        if values.len() != n || values.iter().any(|row| row.len() != n_functions) {
            return None;
        }
        let basis = Basis::new(points, Kernel::Linear);
        let size = basis.n_terms();
        let mut rows: Vec<Vec<f64>> = points.iter().map(|p| basis.terms(*p)).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            row[i] += ridge;
        }
        for column in n..size {
            let transposed = rows[..n].iter().map(|row| row[column]);
            let row = transposed.chain(std::iter::repeat_n(0.0, size - n)).collect();
            rows.push(row);
        }
        let right = values.iter().cloned().chain(std::iter::repeat_n(vec![0.0; n_functions], size - n));
        for (row, right) in rows.iter_mut().zip(right) {
            row.extend(right);
        }
        Some(Self { weights: solved(rows, size)?, basis })
    }

    /// Values of all functions at a point.
    pub fn at(&self, at: Xy) -> Vec<f64> {
        let mut sum = vec![0.0; self.weights[0].len()];
        for (term, weights) in self.basis.terms(at).into_iter().zip(&self.weights) {
            for (s, w) in sum.iter_mut().zip(weights) {
                *s += term * w;
            }
        }
        sum
    }
}

/// Solves the linear system by Gaussian elimination with partial pivoting. `rows` are `size` coefficients followed by
/// the right-hand sides.
fn solved(mut rows: Vec<Vec<f64>>, size: usize) -> Option<Vec<Vec<f64>>> {
    for column in 0..size {
        let largest =
            (column..size).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))?;
        rows.swap(column, largest);
        let (above, below) = rows.split_at_mut(column + 1);
        let pivot = &above[column];
        if pivot[column] == 0.0 || !pivot[column].is_finite() {
            return None;
        }
        for row in below {
            let factor = row[column] / pivot[column];
            if factor != 0.0 {
                for (x, p) in row[column..].iter_mut().zip(&pivot[column..]) {
                    *x -= factor * p;
                }
            }
        }
    }
    let mut solution: Vec<Vec<f64>> = vec![Vec::new(); size];
    for row in (0..size).rev() {
        let mut right = rows[row][size..].to_vec();
        for column in row + 1..size {
            for (r, s) in right.iter_mut().zip(&solution[column]) {
                *r -= rows[row][column] * s;
            }
        }
        solution[row] = right.into_iter().map(|r| r / rows[row][row]).collect();
    }
    solution.iter().flatten().all(|w| w.is_finite()).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::RadialBasis;
    use proptest::prelude::{prop, prop_assert, prop_assume, proptest};

    fn check(basis: &RadialBasis, at: [f64; 2], want: &[f64], tolerance: f64) {
        for (got, want) in basis.at(at).iter().zip(want) {
            assert!((got - want).abs() <= tolerance, "got {got}, expected {want} at {at:?}");
        }
    }

    #[test]
    fn few_points_in_closed_form() {
        let one = RadialBasis::new(&[[0.3, 0.4]], &[vec![2.0, -1.0]], 1e-6).unwrap();
        check(&one, [0.9, 0.1], &[2.0, -1.0], 1e-12);
        // With two points, the constraints force both kernel weights to zero, so that only the linear part is left.
        let two = RadialBasis::new(&[[0.0, 0.0], [1.0, 1.0]], &[vec![1.0], vec![3.0]], 1e-6).unwrap();
        for t in [-1.0, 0.25, 0.5, 2.0] {
            check(&two, [t, t], &[1.0 + 2.0 * t], 1e-12);
        }
        // Along a line, |x| kernels plus a linear term give the polyline through the points.
        let three = [[0.0, 0.5], [0.25, 0.5], [1.0, 0.5]];
        let polygon = RadialBasis::new(&three, &[vec![0.0], vec![1.0], vec![0.0]], 0.0).unwrap();
        for (x, want) in [(0.1, 0.4), (0.25, 1.0), (0.625, 0.5), (0.85, 0.2)] {
            check(&polygon, [x, 0.5], &[want], 1e-12);
        }
    }

    #[test]
    fn what_has_no_solution_is_none() {
        assert_eq!(RadialBasis::new(&[], &[], 0.0), None);
        assert_eq!(RadialBasis::new(&[[0.0, 0.0]], &[vec![1.0], vec![2.0]], 0.0), None);
        assert_eq!(RadialBasis::new(&[[0.5, 0.5]; 2], &[vec![1.0], vec![2.0]], 0.0), None);
        assert_eq!(RadialBasis::new(&[[0.0, 0.0]], &[vec![f64::NAN]], 0.0), None);
    }

    proptest! {
        #[test]
        fn meets_its_points_and_reproduces_what_is_linear(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 1..40),
            slopes in [-3.0_f64..3.0, -3.0_f64..3.0],
            noise in prop::collection::vec(-1.0_f64..1.0, 40),
            at in [0.0_f64..1.0, 0.0_f64..1.0],
        ) {
            let distance = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
            for (i, p) in points.iter().enumerate() {
                prop_assume!(points[..i].iter().all(|q| distance(p, q) > 1e-2));
            }
            let linear = |p: &[f64; 2]| 0.7 + slopes[0] * p[0] + slopes[1] * p[1];
            let values: Vec<_> = points.iter().zip(&noise).map(|(p, n)| vec![linear(p), *n]).collect();
            let basis = RadialBasis::new(&points, &values, 1e-6).unwrap();
            for (p, n) in points.iter().zip(&noise) {
                // The ridge leaves an error of 1e-6 times a weight; a weight is about a difference of values over a
                // distance.
                prop_assert!((basis.at(*p)[1] - n).abs() < 1e-3);
            }
            if points.len() >= 10 {
                let got = basis.at(at)[0];
                prop_assert!((got - linear(&at)).abs() < 1e-8, "got {got}, expected {}", linear(&at));
            }
        }
    }
}
