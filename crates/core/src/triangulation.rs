//! Delaunay triangles over scattered points of a plane, flat and ready to walk.
//!
//! `spade` builds them with exact predicates; what is kept is plain numbers, a cache line a triangle, so that a lookup is
//! a walk over affine maps and never sees a handle. Used twice: over (speed, force) within a texture, and over textures
//! within a space.

mod grid;
mod outline;
mod record;
mod sites;
#[cfg(test)]
mod tests;
mod walk;

use spade::Triangulation as _;

use crate::triangulation::grid::Grid;
use crate::triangulation::outline::chain;
use crate::triangulation::record::{NONE, Record, opposite_longest};
use crate::triangulation::sites::MAX_COORDINATE;
pub(crate) use crate::triangulation::sites::{Site, delaunay};

/// A point or vector of the plane.
pub type Xy = [f64; 2];

/// Triangles over points. Collinear or fewer than three points give none; the outline is then the chain of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    points: Vec<Xy>,
    /// Corners of each triangle, counter-clockwise, the one opposite the longest edge last.
    corners: Vec<[u32; 3]>,
    records: Vec<Record>,
    grid: Grid,
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
    /// There are too many points.
    #[error("{n_points} points are too many: {most} can be triangulated")]
    Count {
        /// How many there are.
        n_points: usize,
        /// How many there may be.
        most: usize,
    },
}

impl Triangulation {
    /// The Delaunay triangulation of `points`. Equal points are moved apart by about 1e-9 of their size, each by its
    /// own index, so that none is lost.
    ///
    /// # Errors
    /// A coordinate that is not finite or exceeds 1e12; more points than their triangles could be numbered.
    pub fn new(points: &[Xy]) -> Result<Self, TriangulationError> {
        let (points, delaunay) = delaunay(points)?;
        if delaunay.num_inner_faces() == 0 {
            let outline = chain(&points);
            return Ok(Self { points, outline, ..Self::default() });
        }
        let outline = delaunay.convex_hull().map(|e| [e.from().data().index, e.to().data().index]).collect();
        // Inner faces are numbered from one.
        let (mut corners, mut neighbors) = (Vec::new(), Vec::new());
        corners.reserve_exact(delaunay.num_inner_faces());
        neighbors.reserve_exact(delaunay.num_inner_faces());
        for face in delaunay.inner_faces() {
            let edges = face.adjacent_edges();
            let of_face = edges.map(|e| e.from().data().index as u32);
            // Edge i runs from corner i to corner i + 1, opposite corner i + 2.
            let across = edges.map(|e| e.rev().face().as_inner().map_or(NONE, |f| f.fix().index() as u32 - 1));
            let last = opposite_longest(of_face.map(|corner| points[corner as usize]));
            let in_order = [(last + 1) % 3, (last + 2) % 3, last];
            corners.push(in_order.map(|i| of_face[i]));
            neighbors.push(in_order.map(|i| across[(i + 1) % 3]));
        }
        let (grid, places) = Grid::new(&points, &corners);
        let mut faces = vec![0; places.len()];
        for (face, place) in places.iter().enumerate() {
            faces[*place as usize] = face;
        }
        let record = |face: &usize| {
            let corners = corners[*face].map(|corner| points[corner as usize]);
            let place = |face| if face == NONE { NONE } else { places[face as usize] };
            Record::new(corners, neighbors[*face].map(place))
        };
        let records = faces.iter().map(record).collect();
        let corners = faces.iter().map(|face| corners[*face]).collect();
        Ok(Self { points, corners, records, grid, outline })
    }

    /// The points, as given but for the separation of equal ones.
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

    /// Neighbor of a triangle across the edge opposite each of its corners.
    pub fn neighbors(&self, triangle: usize) -> [Option<usize>; 3] {
        self.records[triangle].neighbors.map(|next| (next != NONE).then_some(next as usize))
    }

    /// Edges of the convex hull, or of the chain through collinear points.
    pub fn outline(&self) -> &[[usize; 2]] {
        &self.outline
    }

    /// The triangle that holds `at` with the weights of its corners, which are at least zero and sum to one; `None`
    /// outside the hull or where there are no triangles.
    ///
    /// A walk from a triangle near the point: a few steps, however many triangles there are.
    pub fn locate(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        if !self.is_near(at) {
            return None;
        }
        self.walk(at, &mut (self.grid.near(at) as usize))
    }

    /// As [`Triangulation::locate`], by a walk from the triangle `hint`: cost is that of the triangles crossed. The
    /// triangle found is the hint for a point close by.
    #[inline]
    pub fn locate_near(&self, at: Xy, hint: &mut usize) -> Option<(usize, [f64; 3])> {
        if !self.is_near(at) {
            return None;
        }
        *hint = (*hint).min(self.records.len() - 1);
        self.walk(at, hint)
    }

    /// Whether there are triangles and `at` is not so far from them that numbers overflow.
    #[inline]
    fn is_near(&self, at: Xy) -> bool {
        !self.records.is_empty() && at.iter().all(|c| c.abs() <= 2.0 * MAX_COORDINATE)
    }
}

/// Weights of the corners of a triangle at `at`; negative outside it.
pub fn weights_at([a, b, c]: [Xy; 3], at: Xy) -> [f64; 3] {
    let det = (b[1] - c[1]) * (a[0] - c[0]) + (c[0] - b[0]) * (a[1] - c[1]);
    let u = ((b[1] - c[1]) * (at[0] - c[0]) + (c[0] - b[0]) * (at[1] - c[1])) / det;
    let v = ((c[1] - a[1]) * (at[0] - c[0]) + (a[0] - c[0]) * (at[1] - c[1])) / det;
    [u, v, 1.0 - u - v]
}
