//! Linear radial basis functions through scattered points of a plane.
//!
//! `s(q) = Σ λ_i φ(|q - q_i|) + c_0 + c_1 x + c_2 y` with `φ(r) = -r`, which is conditionally positive definite: with
//! `Σ λ_i = Σ λ_i x_i = Σ λ_i y_i = 0` the system has one solution. Points on one line get a polynomial along the line
//! only, and a single point a constant.

use crate::triangulation::Xy;

/// Breadth of points across their main direction, as a share of that along it, below which they lie on one line.
const FLAT: f64 = 1e-6;

/// Functions of a plane, several at once, each through its values at the same points.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialBasis {
    points: Vec<Xy>,
    middle: Xy,
    /// Directions of the polynomial's slopes: none, one or two unit vectors.
    directions: Vec<Xy>,
    /// A row for each point, then one for the constant and one for each direction; a column for each function.
    weights: Vec<Vec<f64>>,
}

impl RadialBasis {
    /// The functions through `values`, a row for each of the points and a column for each function. `ridge` is added to the diagonal:
    /// the larger, the more is smoothed instead of met.
    ///
    /// `None` without points, where rows are not as many or not as long as each other, and where points lie so near each
    /// other that there is no telling them apart. Cost: the number of points cubed.
    pub fn new(points: &[Xy], values: &[Vec<f64>], ridge: f64) -> Option<Self> {
        let n = points.len();
        let n_functions = values.first()?.len();
        if values.len() != n || values.iter().any(|row| row.len() != n_functions) {
            return None;
        }
        let middle = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / n as f64);
        let directions = directions(points, middle);
        let mut basis = Self { points: points.to_vec(), middle, directions, weights: Vec::new() };
        let size = n + 1 + basis.directions.len();
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
        basis.weights = solved(rows, size)?;
        Some(basis)
    }

    /// The functions at a point.
    pub fn at(&self, at: Xy) -> Vec<f64> {
        let mut sum = vec![0.0; self.weights[0].len()];
        for (term, weights) in self.terms(at).into_iter().zip(&self.weights) {
            for (s, w) in sum.iter_mut().zip(weights) {
                *s += term * w;
            }
        }
        sum
    }

    /// What the weights are multiplied with at a point.
    fn terms(&self, at: Xy) -> Vec<f64> {
        let kernels = self.points.iter().map(|p| -(p[0] - at[0]).hypot(p[1] - at[1]));
        let slopes =
            self.directions.iter().map(|d| d[0] * (at[0] - self.middle[0]) + d[1] * (at[1] - self.middle[1]));
        kernels.chain(std::iter::once(1.0)).chain(slopes).collect()
    }
}

/// The main directions in which points spread, those left out in which they do not.
fn directions(points: &[Xy], middle: Xy) -> Vec<Xy> {
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        points.iter().map(|p| of(p[0] - middle[0], p[1] - middle[1])).sum::<f64>()
    };
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = angle.sin_cos();
    let spread = |d: Xy| sum(&|x, y| (d[0] * x + d[1] * y).powi(2)).sqrt();
    let (along, across) = ([cos, sin], [-sin, cos]);
    if xx + yy == 0.0 {
        Vec::new()
    } else if spread(across) <= FLAT * spread(along) {
        vec![along]
    } else {
        vec![along, across]
    }
}

/// Solves `rows`, each as long as `size` plus its right sides, by elimination with the largest pivot of each column.
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
            assert!((got - want).abs() <= tolerance, "{got} for {want} at {at:?}");
        }
    }

    #[test]
    fn few_points_in_closed_form() {
        let one = RadialBasis::new(&[[0.3, 0.4]], &[vec![2.0, -1.0]], 1e-6).unwrap();
        check(&one, [0.9, 0.1], &[2.0, -1.0], 1e-12);
        // Two points: the kernels' weights sum to zero twice over, so that only the straight line is left.
        let two = RadialBasis::new(&[[0.0, 0.0], [1.0, 1.0]], &[vec![1.0], vec![3.0]], 1e-6).unwrap();
        for t in [-1.0, 0.25, 0.5, 2.0] {
            check(&two, [t, t], &[1.0 + 2.0 * t], 1e-12);
        }
        // Along a line |x| kernels with a straight line are the polygon through the points.
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
                // The ridge leaves 1e-6 times a weight, which is about a difference over a distance.
                prop_assert!((basis.at(*p)[1] - n).abs() < 1e-3);
            }
            if points.len() >= 10 {
                let got = basis.at(at)[0];
                prop_assert!((got - linear(&at)).abs() < 1e-8, "{got} for {}", linear(&at));
            }
        }
    }
}
