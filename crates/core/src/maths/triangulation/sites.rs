//! Conversion of points to `spade`'s triangulation, within the limits of its predicates, with coincident points
//! separated.

use std::collections::BTreeSet;

use spade::{DelaunayTriangulation, HasPosition, MIN_ALLOWED_VALUE, Point2, Triangulation as _};

use crate::maths::triangulation::{TriangulationError, Xy};

/// Largest magnitude of a coordinate.
pub(super) const MAX_COORDINATE: f64 = 1e12;

/// Maximum number of points. Triangles (fewer than two for each point) and `spade`'s directed edges (fewer than six)
/// need 32-bit indices, and the last index means none.
const MAX_POINTS: usize = (u32::MAX / 6) as usize;

/// Insertion order of the points. Both diagonals of a regular grid cell are valid; the order decides which one is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Loading {
    /// Bulk loading, which is faster.
    AtOnce,
    /// One by one, in input order.
    InOrder,
}

/// Vertex with the index of its point.
#[derive(Debug)]
pub(crate) struct Site {
    position: Point2<f64>,
    pub(crate) index: usize,
}

impl Site {
    pub(super) fn place(&self) -> Xy {
        [self.position.x, self.position.y]
    }
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// Returns the points, separated where they coincide, and their triangulation.
pub(crate) fn delaunay(
    points: &[Xy],
    loading: Loading,
) -> Result<(Vec<Xy>, DelaunayTriangulation<Site>), TriangulationError> {
    few_enough(points.len())?;
    if let Some(index) =
        points.iter().position(|p| p.iter().any(|c| !c.is_finite() || c.abs() > MAX_COORDINATE))
    {
        return Err(TriangulationError::Coordinate { index });
    }
    // Smaller magnitudes overflow the exact predicates and are negligible here, so they become zero; so does minus
    // zero. This runs before the test for coincident points, because it can make points coincide.
    let plain = |c: f64| if c.abs() < MIN_ALLOWED_VALUE { 0.0 } else { c };
    let points: Vec<Xy> = points.iter().map(|p| p.map(plain)).collect();
    let delaunay = loaded(&points, loading);
    if delaunay.num_vertices() == points.len() {
        return Ok((points, delaunay));
    }
    // Of coincident points, `spade` keeps one.
    let points = separated(&points);
    let delaunay = loaded(&points, loading);
    Ok((points, delaunay))
}

fn few_enough(n_points: usize) -> Result<(), TriangulationError> {
    if n_points > MAX_POINTS {
        return Err(TriangulationError::Count { n_points, most: MAX_POINTS });
    }
    Ok(())
}

fn loaded(points: &[Xy], loading: Loading) -> DelaunayTriangulation<Site> {
    let site = |(index, [x, y]): (usize, &Xy)| Site { position: Point2::new(*x, *y), index };
    let sites = points.iter().enumerate().map(site);
    let loaded = if loading == Loading::InOrder {
        let mut delaunay = DelaunayTriangulation::new();
        sites.map(|site| delaunay.insert(site)).collect::<Result<Vec<_>, _>>().map(|_| delaunay)
    } else {
        DelaunayTriangulation::bulk_load(sites.collect())
    };
    match loaded {
        Ok(delaunay) => delaunay,
        Err(error) => unreachable!("all coordinates are within the limits of spade: {error}"),
    }
}

/// Separates coincident points by a spiral step that depends on the index, the same in every run.
fn separated(points: &[Xy]) -> Vec<Xy> {
    let size = points.iter().flatten().fold(0.0_f64, |m, c| m.max(c.abs())).max(1e-9);
    let mut seen = BTreeSet::new();
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

#[cfg(test)]
mod tests {
    use super::{MAX_POINTS, TriangulationError, few_enough};

    #[test]
    fn more_points_than_there_are_numbers_are_refused() {
        assert_eq!(few_enough(MAX_POINTS), Ok(()));
        let error = few_enough(MAX_POINTS + 1).unwrap_err();
        assert_eq!(error, TriangulationError::Count { n_points: MAX_POINTS + 1, most: MAX_POINTS });
        assert!(6 * MAX_POINTS < u32::MAX as usize);
    }
}
