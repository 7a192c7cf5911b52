//! Terms of a radial basis interpolant: one kernel for each point, a constant and a linear polynomial.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::maths::triangulation::Xy;

/// Ratio of the spread across the main direction to the spread along it, below which points count as collinear.
const FLAT: f64 = 1e-6;

/// Radial kernel. Both kernels are conditionally positive definite. If the weights sum to zero, also after
/// multiplication with each coordinate, the interpolant is unique, in any number of dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// `φ(r) = -r`.
    Linear,
    /// Thin-plate spline, `φ(r) = r² ln r`: it has the least bending energy of all functions through the points.
    ThinPlate,
}

/// Terms of a radial basis interpolant in `N` dimensions. Linear terms run along the directions in which the points spread:
/// along their line for collinear points, none for a single point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Basis<const N: usize> {
    points: Vec<[f64; N]>,
    kernel: Kernel,
    middle: [f64; N],
    /// Directions of the linear terms, as unit vectors.
    directions: Vec<[f64; N]>,
}

impl Kernel {
    fn at<const N: usize>(self, from: &[f64; N], to: &[f64; N]) -> f64 {
        let offsets = from.iter().zip(to).map(|(from, to)| from - to);
        match self {
            Self::Linear => -offsets.reduce(f64::hypot).unwrap_or(0.0),
            Self::ThinPlate => {
                let square: f64 = offsets.map(|offset| offset * offset).sum();
                if square > 0.0 { 0.5 * square * square.ln() } else { 0.0 }
            }
        }
    }
}

impl<const N: usize> Basis<N> {
    /// Basis with a kernel at each point, a constant and the linear terms.
    pub(crate) fn new(points: &[[f64; N]], kernel: Kernel) -> Self {
        let middle = std::array::from_fn(|axis| {
            points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64
        });
        Self { points: points.to_vec(), kernel, middle, directions: directions(points, middle) }
    }

    /// Number of terms: one for each point, one constant, then the linear terms.
    pub(crate) fn n_terms(&self) -> usize {
        self.points.len() + 1 + self.directions.len()
    }

    /// Values of all terms at a point, in the order of the weights.
    pub(crate) fn terms(&self, at: [f64; N]) -> Vec<f64> {
        let kernels = self.points.iter().map(|point| self.kernel.at(point, &at));
        let slopes = self
            .directions
            .iter()
            .map(|direction| (0..N).map(|axis| direction[axis] * (at[axis] - self.middle[axis])).sum());
        kernels.chain(std::iter::once(1.0)).chain(slopes).collect()
    }
}

/// Principal directions of the points, without those along which the points have no spread.
fn directions<const N: usize>(points: &[[f64; N]], middle: [f64; N]) -> Vec<[f64; N]> {
    let varies = |axis: usize| points.iter().any(|point| point[axis] != points[0][axis]);
    if N >= 2 && !(2..N).any(varies) {
        return planar_directions(points, middle);
    }
    let off = |point: &[f64; N], axis: usize| point[axis] - middle[axis];
    let scatter =
        DMatrix::from_fn(N, N, |i, j| points.iter().map(|point| off(point, i) * off(point, j)).sum::<f64>());
    let eigen = SymmetricEigen::new(scatter);
    let largest = eigen.eigenvalues.max();
    // Eigenvalues are squared spreads.
    let has_spread = |of: &usize| eigen.eigenvalues[*of] > FLAT * FLAT * largest;
    let along = |of: usize| std::array::from_fn(|axis| eigen.eigenvectors[(axis, of)]);
    (0..N).filter(has_spread).map(along).collect()
}

/// [`directions`] in closed form, for points that only differ in their first two coordinates.
fn planar_directions<const N: usize>(points: &[[f64; N]], middle: [f64; N]) -> Vec<[f64; N]> {
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        points.iter().map(|p| of(p[0] - middle[0], p[1] - middle[1])).sum::<f64>()
    };
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = angle.sin_cos();
    let spread = |d: Xy| sum(&|x, y| (d[0] * x + d[1] * y).powi(2)).sqrt();
    let (along, across) = ([cos, sin], [-sin, cos]);
    let padded = |[x, y]: Xy| {
        let mut direction = [0.0; N];
        (direction[0], direction[1]) = (x, y);
        direction
    };
    if xx + yy == 0.0 {
        Vec::new()
    } else if spread(across) <= FLAT * spread(along) {
        vec![padded(along)]
    } else {
        vec![padded(along), padded(across)]
    }
}

#[cfg(test)]
mod tests {
    use super::{Basis, Kernel};

    #[test]
    fn linear_terms_run_where_the_points_spread() {
        let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
        let basis = Basis::new(&flat, Kernel::ThinPlate);
        assert_eq!((basis.n_terms(), basis.directions.len()), (7, 2));
        let across = [0.5_f64.sqrt(), 0.0, -0.5_f64.sqrt()];
        for direction in &basis.directions {
            let dot: f64 = direction.iter().zip(across).map(|(a, b)| a * b).sum();
            assert!(dot.abs() < 1e-9, "{direction:?}");
        }
        assert_eq!(Basis::new(&[[0.3, 0.4, 0.5]], Kernel::ThinPlate).directions.len(), 0);
        // Further coordinates that do not vary change no bit.
        let plane = [[0.1, 0.7], [0.9, 0.2], [0.4, 0.4]];
        let in_plane = Basis::new(&plane, Kernel::ThinPlate).terms([0.3, 0.6]);
        let padded = plane.map(|[x, y]| [x, y, 0.0, 0.0]);
        assert_eq!(Basis::new(&padded, Kernel::ThinPlate).terms([0.3, 0.6, 0.0, 0.0]), in_plane);
    }
}
