//! Delaunay triangles over scattered points of a plane, flat and ready to walk.
//!
//! `spade` builds them with exact predicates; what is kept is plain indices, so that a lookup is a walk over affine maps
//! and never sees a handle. Used twice: over (speed, force) within a texture, and over textures within a space.

use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation as _};

/// A point or vector of the plane.
pub type Xy = [f64; 2];

/// Triangles over points. Collinear or fewer than three points give none; the outline is then the chain of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    points: Vec<Xy>,
    triangles: Vec<[usize; 3]>,
    /// Neighbor across the edge opposite each corner.
    neighbors: Vec<[Option<usize>; 3]>,
    /// Edges of the convex hull, or of the chain of collinear points.
    outline: Vec<[usize; 2]>,
}

/// Why points cannot be triangulated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// A coordinate is not finite, or too large.
    #[error("point {index} has a coordinate that is not a usable number")]
    Coordinate {
        /// Index of the point.
        index: usize,
    },
}

/// A site that remembers its index.
#[derive(Debug)]
pub(crate) struct Site {
    position: Point2<f64>,
    pub(crate) index: usize,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The points, separated where they are equal, and their triangulation.
pub(crate) fn delaunay(points: &[Xy]) -> Result<(Vec<Xy>, DelaunayTriangulation<Site>), TriangulationError> {
    if let Some(index) = points.iter().position(|p| p.iter().any(|c| !c.is_finite() || c.abs() > 1e12)) {
        return Err(TriangulationError::Coordinate { index });
    }
    // Numbers below 1e-140 overflow the exact predicates, and are zero for every purpose here; so is minus zero. Before
    // points are separated, since they may make points equal.
    let plain = |c: f64| if c.abs() < 1e-100 { 0.0 } else { c };
    let points = separated(&points.iter().map(|p| p.map(plain)).collect::<Vec<_>>());
    let mut delaunay = DelaunayTriangulation::<Site>::new();
    for (index, [x, y]) in points.iter().enumerate() {
        let site = Site { position: Point2::new(*x, *y), index };
        delaunay.insert(site).map_err(|_| TriangulationError::Coordinate { index })?;
    }
    Ok((points, delaunay))
}

impl Triangulation {
    /// The Delaunay triangulation of `points`. Equal points are moved apart by about 1e-9 of their size, each by its
    /// own index, so that none is lost.
    ///
    /// # Errors
    /// A coordinate that is not finite or exceeds 1e12.
    pub fn new(points: &[Xy]) -> Result<Self, TriangulationError> {
        let (points, delaunay) = delaunay(points)?;
        let mut triangle_of_face = std::collections::BTreeMap::new();
        let mut triangles = Vec::new();
        for face in delaunay.inner_faces() {
            triangle_of_face.insert(face.fix().index(), triangles.len());
            triangles.push(face.vertices().map(|v| v.data().index));
        }
        let neighbors = delaunay
            .inner_faces()
            .map(|face| {
                // Edge i runs from corner i to corner i + 1, opposite corner i + 2.
                let across = face
                    .adjacent_edges()
                    .map(|e| triangle_of_face.get(&e.rev().face().fix().index()).copied());
                [across[1], across[2], across[0]]
            })
            .collect();
        let outline = if triangles.is_empty() {
            chain(&points)
        } else {
            delaunay.convex_hull().map(|e| [e.from().data().index, e.to().data().index]).collect()
        };
        Ok(Self { points, triangles, neighbors, outline })
    }

    /// The points, as given but for the separation of equal ones.
    pub fn points(&self) -> &[Xy] {
        &self.points
    }

    /// Corners of each triangle, counter-clockwise.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Neighbor of each triangle across the edge opposite each of its corners.
    pub fn neighbors(&self) -> &[[Option<usize>; 3]] {
        &self.neighbors
    }

    /// Edges of the convex hull, or of the chain through collinear points.
    pub fn outline(&self) -> &[[usize; 2]] {
        &self.outline
    }

    /// The triangle that holds `at` with the weights of its corners, which are at least zero and sum to one; `None`
    /// outside the hull or where there are no triangles.
    ///
    /// A visibility walk from `hint`; cost is that of the triangles crossed.
    pub fn locate(&self, at: Xy, hint: usize) -> Option<(usize, [f64; 3])> {
        if self.triangles.is_empty() || !at.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut current = hint.min(self.triangles.len() - 1);
        for _ in 0..=self.triangles.len() {
            let weights = self.weights_in(current, at);
            let lowest = (0..3).min_by(|a, b| weights[*a].total_cmp(&weights[*b]))?;
            if weights[lowest] >= -1e-12 {
                let clamped = weights.map(|w| w.max(0.0));
                let sum: f64 = clamped.iter().sum();
                return Some((current, clamped.map(|w| w / sum)));
            }
            current = self.neighbors[current][lowest]?;
        }
        None
    }

    /// Weights of the corners of triangle `index` at `at`; negative outside it.
    pub fn weights_in(&self, index: usize, at: Xy) -> [f64; 3] {
        weights_at(self.triangles[index].map(|i| self.points[i]), at)
    }

    /// The point of the outline nearest to `at`, with the two ends of its edge and their weights.
    pub fn nearest_on_outline(&self, at: Xy) -> Option<(Xy, [(usize, f64); 2])> {
        let project = |edge: &[usize; 2]| {
            let [a, b] = edge.map(|i| self.points[i]);
            let along = [b[0] - a[0], b[1] - a[1]];
            let length_squared = along[0] * along[0] + along[1] * along[1];
            let dot = (at[0] - a[0]) * along[0] + (at[1] - a[1]) * along[1];
            let t = if length_squared > 0.0 { (dot / length_squared).clamp(0.0, 1.0) } else { 0.0 };
            let on = [a[0] + t * along[0], a[1] + t * along[1]];
            let distance = (on[0] - at[0]).hypot(on[1] - at[1]);
            (distance, on, [(edge[0], 1.0 - t), (edge[1], t)])
        };
        let nearest = self.outline.iter().map(project).min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((_, on, ends)) => Some((on, ends)),
            None => self.points.first().map(|p| (*p, [(0, 1.0), (0, 0.0)])),
        }
    }
}

/// Weights of the corners of a triangle at `at`; negative outside it.
pub fn weights_at([a, b, c]: [Xy; 3], at: Xy) -> [f64; 3] {
    let det = (b[1] - c[1]) * (a[0] - c[0]) + (c[0] - b[0]) * (a[1] - c[1]);
    let u = ((b[1] - c[1]) * (at[0] - c[0]) + (c[0] - b[0]) * (at[1] - c[1])) / det;
    let v = ((c[1] - a[1]) * (at[0] - c[0]) + (a[0] - c[0]) * (at[1] - c[1])) / det;
    [u, v, 1.0 - u - v]
}

/// Points with equal ones moved apart: a spiral step by index, the same on every run.
fn separated(points: &[Xy]) -> Vec<Xy> {
    let size = points.iter().flatten().fold(0.0_f64, |m, c| m.max(c.abs())).max(1e-9);
    let mut seen = std::collections::BTreeSet::new();
    points
        .iter()
        .enumerate()
        .map(|(index, p)| {
            let mut moved = *p;
            let mut step = 0;
            while !seen.insert(moved.map(f64::to_bits)) {
                step += 1;
                let angle = (index + step) as f64 * 2.399_963;
                let radius = 1e-9 * size * (1.0 + step as f64);
                moved = [p[0] + radius * angle.cos(), p[1] + radius * angle.sin()];
            }
            moved
        })
        .collect()
}

/// Consecutive pairs of collinear points along their line.
fn chain(points: &[Xy]) -> Vec<[usize; 2]> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let ([ax, ay], [bx, by]) = (points[*a], points[*b]);
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    order.windows(2).map(|w| [w[0], w[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::{Triangulation, TriangulationError};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn walk_agrees_with_looking_at_every_triangle(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..60),
            at in [-0.2_f64..1.2, -0.2_f64..1.2],
            hint in 0_usize..100,
        ) {
            let t = Triangulation::new(&points).unwrap();
            let oracle = (0..t.triangles().len())
                .find(|&i| t.weights_in(i, at).iter().all(|w| *w >= -1e-12));
            let found = t.locate(at, hint);
            prop_assert_eq!(found.is_some(), oracle.is_some());
            if let Some((index, w)) = found {
                // Weights reproduce the point: linear precision.
                let corners = t.triangles()[index].map(|i| t.points()[i]);
                for axis in 0..2 {
                    let sum: f64 = (0..3).map(|i| w[i] * corners[i][axis]).sum();
                    prop_assert!((sum - at[axis]).abs() < 1e-9);
                }
                prop_assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            }
        }

        #[test]
        fn neighbors_share_the_edge_opposite_the_corner(points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 3..40)) {
            let t = Triangulation::new(&points).unwrap();
            let mut open = 0;
            for (i, around) in t.neighbors().iter().enumerate() {
                for (corner, neighbor) in around.iter().enumerate() {
                    let mine = t.triangles()[i];
                    let edge = [mine[(corner + 1) % 3], mine[(corner + 2) % 3]];
                    match neighbor {
                        Some(n) => prop_assert!(edge.iter().all(|v| t.triangles()[*n].contains(v))),
                        None => open += 1,
                    }
                }
            }
            prop_assert_eq!(open, t.outline().len());
        }

        #[test]
        fn nearest_on_outline_is_no_farther_than_any_point_of_it(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 1..20),
            at in [-2.0_f64..3.0, -2.0_f64..3.0],
        ) {
            let t = Triangulation::new(&points).unwrap();
            let (on, ends) = t.nearest_on_outline(at).unwrap();
            let distance = (on[0] - at[0]).hypot(on[1] - at[1]);
            for [a, b] in t.outline() {
                for step in 0..=20 {
                    let s = f64::from(step) / 20.0;
                    let p = [0, 1].map(|k| (1.0 - s) * t.points()[*a][k] + s * t.points()[*b][k]);
                    prop_assert!(distance <= (p[0] - at[0]).hypot(p[1] - at[1]) + 1e-9);
                }
            }
            prop_assert!((ends[0].1 + ends[1].1 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn collinear_equal_and_single_points_are_chains() {
        let line = Triangulation::new(&[[0.0, 0.0], [2.0, 2.0], [1.0, 1.0]]).unwrap();
        assert!(line.triangles().is_empty());
        assert_eq!(line.outline(), [[0, 2], [2, 1]]);
        assert_eq!(line.locate([1.0, 1.0], 0), None);
        let one = Triangulation::new(&[[0.3, 0.4]]).unwrap();
        assert_eq!(one.nearest_on_outline([9.0, 9.0]).unwrap().1[0], (0, 1.0));
        assert_eq!(Triangulation::new(&[]).unwrap().nearest_on_outline([0.0, 0.0]), None);
        let twins = Triangulation::new(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).unwrap();
        assert_eq!(n_used(&twins), 4, "a point equal to another was lost");
    }

    fn n_used(t: &Triangulation) -> usize {
        t.triangles().iter().flatten().collect::<std::collections::BTreeSet<_>>().len()
    }

    #[test]
    fn zeros_of_either_sign_and_numbers_next_to_zero_are_one_place_and_none_is_lost() {
        for zero in [-0.0, 1e-200, -1e-200, f64::MIN_POSITIVE] {
            let t =
                Triangulation::new(&[[0.0, 0.0], [zero, 0.0], [0.0, zero], [1.0, 0.0], [0.0, 1.0]]).unwrap();
            assert_eq!(n_used(&t), 5, "a point at {zero} was lost");
            assert!(t.points().iter().flatten().all(|c| *c == 0.0 || c.abs() > 1e-100));
        }
    }

    #[test]
    fn nonsense_coordinates_are_named() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let error = Triangulation::new(&[[0.0, 0.0], [1.0, bad]]).unwrap_err();
            assert_eq!(error, TriangulationError::Coordinate { index: 1 });
        }
    }
}
