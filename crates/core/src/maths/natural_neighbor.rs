//! Natural-neighbor weights: the share of each neighbor's Voronoi cell that an inserted point would take over (Sibson
//! 1981).
//!
//! Like barycentric weights they have linear precision: the weighted sum of the neighbors is the point itself. Unlike
//! them they have no kinks at triangle edges; they are smooth everywhere except at the points themselves. `spade`
//! computes the areas.

use spade::{DelaunayTriangulation, Point2, Triangulation as _};

use crate::maths::triangulation::{Loading, Site, TriangulationError, Xy, delaunay};

/// Point set for natural-neighbor interpolation.
#[derive(Debug)]
pub struct NaturalNeighbors {
    delaunay: DelaunayTriangulation<Site>,
}

impl NaturalNeighbors {
    /// Triangulates `points`. Coincident points are separated as in [`crate::maths::triangulation::Triangulation`].
    ///
    /// # Errors
    /// A coordinate is not finite or exceeds 1e12, or there are too many points to triangulate.
    pub fn new(points: &[Xy]) -> Result<Self, TriangulationError> {
        Ok(Self { delaunay: delaunay(points, Loading::AtOnce)?.1 })
    }

    /// Index and weight of each natural neighbor of `at`, sorted by index. Weights are at least zero and sum to one.
    /// Empty outside the convex hull, or if a coordinate is not finite.
    pub fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        // Two points have no triangle that could contain the query point.
        if !at.iter().all(|c| c.is_finite()) || self.delaunay.num_inner_faces() == 0 {
            return Vec::new();
        }
        let mut found = Vec::new();
        self.delaunay.natural_neighbor().get_weights(Point2::new(at[0], at[1]), &mut found);
        let mut weights: Vec<(usize, f64)> = found
            .into_iter()
            .map(|(vertex, weight)| (self.delaunay.vertex(vertex).data().index, weight.max(0.0)))
            .collect();
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Vec::new();
        }
        for (_, weight) in &mut weights {
            *weight /= sum;
        }
        weights.sort_by_key(|(index, _)| *index);
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::NaturalNeighbors;
    use crate::maths::triangulation::{Triangulation, Xy};
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn golden_weights() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../../vectors/g_interp/weights_vectors.json")).unwrap();
        let xy = |value: &serde_json::Value| [0, 1].map(|axis| value[axis].as_f64().unwrap());
        let sites: Vec<Xy> = v["sites"].as_array().unwrap().iter().map(xy).collect();
        let weights = NaturalNeighbors::new(&sites).unwrap().weights(xy(&v["sibson_q"]["q"]));
        for (index, golden) in v["sibson_q"]["w"].as_object().unwrap() {
            let index: usize = index.parse().unwrap();
            let weight = weights.iter().find(|(i, _)| *i == index).map_or(0.0, |(_, w)| *w);
            assert!(
                (weight - golden.as_f64().unwrap()).abs() < 1e-9,
                "index {index}: weight {weight}, expected {golden}"
            );
        }
    }

    #[test]
    fn in_the_middle_of_a_square_all_corners_count_alike_and_outside_nobody_does() {
        let square = NaturalNeighbors::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
        let weights = square.weights([0.5, 0.5]);
        assert!(weights.len() == 4 && weights.iter().all(|(_, w)| (w - 0.25).abs() < 1e-12), "{weights:?}");
        assert_eq!(square.weights([1.0, 1.0]), [(2, 1.0)]);
        assert!(square.weights([2.0, 2.0]).is_empty() && square.weights([f64::NAN, 0.0]).is_empty());
        assert!(NaturalNeighbors::new(&[[0.5, 0.5]]).unwrap().weights([0.5, 0.5]).is_empty());
        assert!(NaturalNeighbors::new(&[[0.0, 0.0], [1.0, 1.0]]).unwrap().weights([0.5, 0.5]).is_empty());
        assert!(NaturalNeighbors::new(&[]).unwrap().weights([0.0, 0.0]).is_empty());
        assert!(NaturalNeighbors::new(&[[f64::NAN, 0.0]]).is_err());
    }

    proptest! {
        /// Weights sum to one and reproduce the point (linear precision).
        #[test]
        fn weights_reproduce_the_point(
            points in prop::collection::vec((0.0_f64..100.0, 0.0_f64..100.0), 3..25),
            at in (0.0_f64..100.0, 0.0_f64..100.0),
        ) {
            let points: Vec<Xy> = points.into_iter().map(|(x, y)| [x, y]).collect();
            let triangulation = Triangulation::new(&points).unwrap();
            let at = [at.0, at.1];
            let Some((_, inside)) = triangulation.locate(at) else { return Ok(()) };
            // Near the convex hull, Voronoi cells extend to infinity and the areas lose digits.
            if inside.iter().any(|weight| *weight < 1e-3) {
                return Ok(());
            }
            let weights = NaturalNeighbors::new(&points).unwrap().weights(at);
            let sum: f64 = weights.iter().map(|(_, w)| w).sum();
            prop_assert!((sum - 1.0).abs() < 1e-9 && weights.iter().all(|(_, w)| *w >= 0.0));
            for axis in 0..2 {
                let place: f64 = weights.iter().map(|(i, w)| w * points[*i][axis]).sum();
                prop_assert!((place - at[axis]).abs() < 1e-5, "got {place}, expected {}", at[axis]);
            }
        }
    }
}
