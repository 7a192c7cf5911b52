//! What radial basis functions are sums of: a kernel around each point, and a straight slope.

use crate::triangulation::Xy;

/// Breadth of points across their main direction, as a share of that along it, below which they lie on one line.
const FLAT: f64 = 1e-6;

/// What stands around each point. Both are conditionally positive definite: with weights that sum to zero, and to zero
/// when multiplied with either coordinate, there is one function through the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// `φ(r) = -r`.
    Linear,
    /// `φ(r) = r² ln r`: of all functions through the points the one that bends least.
    ThinPlate,
}

/// The terms of radial basis functions. Points on one line get a slope along the line only, and a single point none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Basis {
    points: Vec<Xy>,
    kernel: Kernel,
    middle: Xy,
    /// Directions of the slopes: none, one or two unit vectors.
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
    /// A kernel around each point, a constant, and slopes.
    pub(crate) fn new(points: &[Xy], kernel: Kernel) -> Self {
        let middle = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
        Self { points: points.to_vec(), kernel, middle, directions: directions(points, middle) }
    }

    /// How many terms there are: one for each point, the constant, then the slopes.
    pub(crate) fn n_terms(&self) -> usize {
        self.points.len() + 1 + self.directions.len()
    }

    /// The terms at a point, what weights are multiplied with.
    pub(crate) fn terms(&self, at: Xy) -> Vec<f64> {
        let kernels = self.points.iter().map(|p| self.kernel.at([p[0] - at[0], p[1] - at[1]]));
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
