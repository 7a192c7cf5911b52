//! Terms of a radial basis interpolant: one kernel for each point, a constant and a linear polynomial.

use crate::maths::triangulation::Xy;

/// Ratio of the spread across the main direction to the spread along it, below which points count as collinear.
const FLAT: f64 = 1e-6;

/// Radial kernel. Both kernels are conditionally positive definite. If the weights sum to zero, also after
/// multiplication with either coordinate, the interpolant is unique.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// `φ(r) = -r`.
    Linear,
    /// Thin-plate spline, `φ(r) = r² ln r`: it has the least bending energy of all functions through the points.
    ThinPlate,
}

/// Terms of a radial basis interpolant. Collinear points get a linear term along their line only; a single point gets
/// none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Basis {
    points: Vec<Xy>,
    kernel: Kernel,
    middle: Xy,
    /// Directions of the linear terms: zero, one or two unit vectors.
    directions: Vec<Xy>,
}

impl Kernel {
    fn at(self, [dx, dy]: Xy) -> f64 {
        match self {
            Self::Linear => -dx.hypot(dy),
            Self::ThinPlate => {
                let square = dx * dx + dy * dy;
                if square > 0.0 { 0.5 * square * square.ln() } else { 0.0 }
            }
        }
    }
}

impl Basis {
    /// Basis with a kernel at each point, a constant and the linear terms.
    pub(crate) fn new(points: &[Xy], kernel: Kernel) -> Self {
        let middle = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
        Self { points: points.to_vec(), kernel, middle, directions: directions(points, middle) }
    }

    /// Number of terms: one for each point, one constant, then the linear terms.
    pub(crate) fn n_terms(&self) -> usize {
        self.points.len() + 1 + self.directions.len()
    }

    /// Values of all terms at a point, in the order of the weights.
    pub(crate) fn terms(&self, at: Xy) -> Vec<f64> {
        let kernels = self.points.iter().map(|p| self.kernel.at([p[0] - at[0], p[1] - at[1]]));
        let slopes =
            self.directions.iter().map(|d| d[0] * (at[0] - self.middle[0]) + d[1] * (at[1] - self.middle[1]));
        kernels.chain(std::iter::once(1.0)).chain(slopes).collect()
    }
}

/// Principal directions of the points, without those along which the points have no spread.
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
