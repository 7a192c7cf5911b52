//! Delaunay triangulation of scattered points in the plane, stored as flat arrays for fast point location.
//!
//! `spade` builds the triangulation with exact predicates. Only plain numbers are kept, so that point location walks
//! over flat arrays instead of `spade`'s handles. Used over (tip speed, normal force) within a texture and over
//! textures within a space.

mod grid;
mod outline;
mod shape;
mod sites;
#[cfg(test)]
mod tests;
mod walk;

use spade::Triangulation as _;

use crate::maths::triangulation::grid::Grid;
use crate::maths::triangulation::outline::chain;
use crate::maths::triangulation::shape::{NONE, Shape, opposite_longest};
pub(crate) use crate::maths::triangulation::sites::{Loading, Site, delaunay};

/// Point or vector in the plane.
pub type Xy = [f64; 2];

/// Triangulated point set. Collinear points, or fewer than three, have no triangles; their outline is the chain of
/// points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    points: Vec<Xy>,
    /// Corners of each triangle, counter-clockwise; the last one is opposite the longest edge.
    corners: Vec<[u32; 3]>,
    shapes: Vec<Shape>,
    grid: Grid,
    /// Edges of the convex hull, or of the chain of collinear points.
    outline: Vec<[usize; 2]>,
}

/// Error of triangulating a point set.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// A coordinate is not finite, or its magnitude exceeds 1e12.
    #[error(
        "point {index} has a coordinate that is not finite or exceeds 1e12 in magnitude; remove or correct the point"
    )]
    Coordinate {
        /// Index of the point.
        index: usize,
    },
    /// There are more points than 32-bit indices can number.
    #[error("{n_points} points are too many to triangulate; use at most {most}")]
    Count {
        /// Number of points.
        n_points: usize,
        /// Maximum number of points.
        most: usize,
    },
}

impl Triangulation {
    /// Triangulates `points`. Coincident points are separated by about 1e-9 of the largest coordinate, in a direction
    /// that depends on the index, so that none is lost.
    ///
    /// # Errors
    /// A coordinate is not finite or exceeds 1e12, or there are too many points.
    pub fn new(points: &[Xy]) -> Result<Self, TriangulationError> {
        Self::loaded(points, Loading::AtOnce)
    }

    /// Triangulates `points`, inserted in their order.
    ///
    /// The order decides the diagonal of each cell of a regular grid. A texture measured on a grid thus sounds the same
    /// in every version.
    ///
    /// # Errors
    /// As [`Triangulation::new`].
    pub fn in_order(points: &[Xy]) -> Result<Self, TriangulationError> {
        Self::loaded(points, Loading::InOrder)
    }

    fn loaded(points: &[Xy], loading: Loading) -> Result<Self, TriangulationError> {
        let (points, delaunay) = delaunay(points, loading)?;
        if delaunay.num_inner_faces() == 0 {
            let outline = chain(&points);
            return Ok(Self { points, outline, ..Self::default() });
        }
        let outline = delaunay.convex_hull().map(|e| [e.from().data().index, e.to().data().index]).collect();
        let mut grid = Grid::new(&points);
        let (mut faces, mut cells) = (Vec::new(), Vec::new());
        faces.reserve_exact(delaunay.num_inner_faces());
        cells.reserve_exact(delaunay.num_inner_faces());
        for face in delaunay.inner_faces() {
            let edges = face.adjacent_edges();
            let [a, b, c] = edges.map(|edge| edge.from().data().place());
            cells.push(grid.near([0, 1].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0)) as u32);
            let corners = edges.map(|edge| edge.from().data().index as u32);
            // Inner faces are numbered from one. Edge i runs from corner i to corner i + 1; corner i + 2 is opposite.
            let across =
                edges.map(|e| e.rev().face().as_inner().map_or(NONE, |f| f.fix().index() as u32 - 1));
            let last = opposite_longest([a, b, c]);
            let in_order = [(last + 1) % 3, (last + 2) % 3, last];
            faces.push((in_order.map(|i| corners[i]), in_order.map(|i| across[(i + 1) % 3])));
        }
        let order = grid.settle(cells);
        let mut face_at = vec![0_u32; order.len()];
        for (face, place) in order.iter().enumerate() {
            face_at[*place as usize] = face as u32;
        }
        let place = |next: u32| if next == NONE { NONE } else { order[next as usize] };
        let sorted = || face_at.iter().map(|face| faces[*face as usize]);
        let corners = sorted().map(|(corners, _)| corners).collect();
        let shape = |(corners, neighbors): ([u32; 3], [u32; 3])| {
            Shape::new(corners.map(|corner| points[corner as usize]), neighbors.map(place))
        };
        let shapes = sorted().map(shape).collect();
        Ok(Self { points, corners, shapes, grid, outline })
    }

    /// Points in input order; coincident ones are separated.
    pub fn points(&self) -> &[Xy] {
        &self.points
    }

    /// Corners of each triangle, counter-clockwise.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [usize; 3]> + '_ {
        self.corners.iter().map(|corners| corners.map(|corner| corner as usize))
    }

    /// Corners of one triangle, counter-clockwise.
    #[inline]
    pub fn corners(&self, triangle: usize) -> [usize; 3] {
        self.corners[triangle].map(|corner| corner as usize)
    }

    /// Neighbor of a triangle across the edge opposite each corner.
    #[cfg(test)]
    pub(crate) fn neighbors(&self, triangle: usize) -> [Option<usize>; 3] {
        self.shapes[triangle].neighbors.map(|next| (next != NONE).then_some(next as usize))
    }

    /// Edges of the convex hull, or of the chain through collinear points.
    pub fn outline(&self) -> &[[usize; 2]] {
        &self.outline
    }
}

/// Barycentric weights of a triangle's corners at `at`; they sum to one, and some are negative outside the triangle.
pub fn weights_at([a, b, c]: [Xy; 3], at: Xy) -> [f64; 3] {
    let det = (b[1] - c[1]) * (a[0] - c[0]) + (c[0] - b[0]) * (a[1] - c[1]);
    let u = ((b[1] - c[1]) * (at[0] - c[0]) + (c[0] - b[0]) * (at[1] - c[1])) / det;
    let v = ((c[1] - a[1]) * (at[0] - c[0]) + (a[0] - c[0]) * (at[1] - c[1])) / det;
    [u, v, 1.0 - u - v]
}
