//! Boundary of the triangulation: the convex hull, or the chain of points if there are no triangles.

use crate::maths::triangulation::shape::{dot, sub};
use crate::maths::triangulation::{Triangulation, Xy};

impl Triangulation {
    /// Nearest point of the boundary to `at`, with the two ends of its edge and their weights; `None` without points.
    ///
    /// Cost: linear in the number of boundary edges, which is small for a hull and equals the number of points for a
    /// chain.
    pub fn nearest_on_outline(&self, at: Xy) -> Option<(Xy, [(usize, f64); 2])> {
        let project = |edge: &[usize; 2]| {
            let [a, b] = edge.map(|i| self.points[i]);
            let along = sub(b, a);
            let length_squared = dot(along, along);
            let t = if length_squared > 0.0 {
                (dot(sub(at, a), along) / length_squared).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let on = [a[0] + t * along[0], a[1] + t * along[1]];
            let off = sub(on, at);
            (dot(off, off), on, [(edge[0], 1.0 - t), (edge[1], t)])
        };
        let nearest = self.outline.iter().map(project).min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((_, on, ends)) => Some((on, ends)),
            None => self.points.first().map(|p| (*p, [(0, 1.0), (0, 0.0)])),
        }
    }
}

/// Consecutive pairs of collinear points, sorted along their line.
pub(super) fn chain(points: &[Xy]) -> Vec<[usize; 2]> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let ([ax, ay], [bx, by]) = (points[*a], points[*b]);
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    order.windows(2).map(|w| [w[0], w[1]]).collect()
}
