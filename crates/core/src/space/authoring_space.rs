//! The authoring space: one to six axes, usually rough-smooth and hard-soft, on which textures have positions.
//!
//! A space with one or two axes is triangulated. One with more has a convex hull, but no triangles; only the field
//! interpolates in it.

use crate::maths::nearest_in_hull::nearest_in_hull;
use crate::maths::triangulation::{Triangulation, TriangulationError, Xy};
use crate::space::space_point::{SpacePoint, Unit};

/// Source of the positions in a space. Positions from different sources are never mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelSource {
    /// People rated the textures.
    HumanRatings,
    /// Simulated raters rated the textures: for testing the pipeline, not for conclusions.
    SimulatedRaters,
    /// Physical quantities replace ratings; no person felt the textures.
    PhysicalLabels,
    /// Estimated from words, a picture, a recording or vibration features; the position is no rating.
    Estimated,
}

impl LabelSource {
    /// All sources.
    pub const ALL: [Self; 4] =
        [Self::HumanRatings, Self::SimulatedRaters, Self::PhysicalLabels, Self::Estimated];

    /// Name for display.
    pub fn label(self) -> &'static str {
        match self {
            Self::HumanRatings => "human ratings",
            Self::SimulatedRaters => "simulated raters",
            Self::PhysicalLabels => "physical labels",
            Self::Estimated => "estimates",
        }
    }

    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::HumanRatings => "human",
            Self::SimulatedRaters => "simulated",
            Self::PhysicalLabels => "physical",
            Self::Estimated => "estimated",
        }
    }

    /// Source with this [`LabelSource::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|source| source.id() == id)
    }
}

/// Positions of textures, with their Delaunay triangulation in a space of at most two axes. A texture is identified by its
/// index in the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    n_axes: usize,
    /// Library index and position of every texture that has a position.
    sites: Vec<(usize, SpacePoint)>,
    /// Empty in a space with more than two axes.
    triangulation: Triangulation,
    /// Positions of the sites in the unit cube; empty in a space of at most two axes.
    units: Vec<Unit>,
}

/// Reasons why positions make no space.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// A coordinate is not finite, or there are too many positions.
    #[error(transparent)]
    Triangulation(#[from] TriangulationError),
    /// Positions have different numbers of axes.
    #[error(
        "texture {texture} has a position on {n_axes} axes, but the others on {expected}; give all textures positions on the same axes"
    )]
    Axes {
        /// Library index of the texture.
        texture: usize,
        /// Number of axes of its position.
        n_axes: usize,
        /// Number of axes of the first position.
        expected: usize,
    },
}

/// Largest number of axes with a triangulation.
pub(crate) const MOST_TRIANGULATED: usize = 2;
/// Distance below which two points are the same, in points of the axes.
const SAME: f64 = 1e-9;

/// Location of a point relative to the textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Location {
    /// The requested point if it is inside the convex hull, else the nearest point of the hull.
    pub at: SpacePoint,
    /// Whether the requested point is outside the hull.
    pub clamped: bool,
    /// Library indices and barycentric weights of surrounding textures: at most one more than there are axes, and fewer on
    /// the hull. Weights are non-negative and sum to one.
    pub corners: Vec<(usize, f64)>,
}

impl Space {
    /// Space of the textures that have a position; `positions` is indexed like the library. Without positions it has two
    /// axes.
    ///
    /// # Errors
    /// [`SpaceError`] if a coordinate is not finite, or if positions differ in their number of axes.
    pub fn new(positions: &[Option<SpacePoint>]) -> Result<Self, SpaceError> {
        let sites: Vec<(usize, SpacePoint)> =
            positions.iter().enumerate().filter_map(|(i, p)| p.map(|p| (i, p))).collect();
        let expected = sites.first().map_or(2, |(_, at)| at.n_axes());
        if let Some((texture, at)) = sites.iter().find(|(_, at)| at.n_axes() != expected) {
            return Err(SpaceError::Axes { texture: *texture, n_axes: at.n_axes(), expected });
        }
        if expected <= MOST_TRIANGULATED {
            let points: Vec<Xy> = sites.iter().map(|(_, p)| p.xy()).collect();
            let triangulation = Triangulation::new(&points)?;
            return Ok(Self { n_axes: expected, sites, triangulation, units: Vec::new() });
        }
        let units: Vec<Unit> = sites.iter().map(|(_, at)| at.unit()).collect();
        if let Some(index) = units.iter().position(|unit| unit.iter().any(|x| !x.is_finite())) {
            return Err(TriangulationError::Coordinate { index }.into());
        }
        Ok(Self { n_axes: expected, sites, triangulation: Triangulation::default(), units })
    }

    /// Number of axes, 1 to [`MOST_AXES`](crate::space::MOST_AXES).
    pub fn n_axes(&self) -> usize {
        self.n_axes
    }

    /// Whether the space is triangulated: only then modes other than the field interpolate in it.
    pub fn is_triangulated(&self) -> bool {
        self.n_axes <= MOST_TRIANGULATED
    }

    /// Library index and position of every placed texture.
    pub fn sites(&self) -> &[(usize, SpacePoint)] {
        &self.sites
    }

    /// Library indices of the corners of all triangles; none in a space with more than two axes.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.triangulation.triangles().map(|t| t.map(|i| self.sites[i].0))
    }

    /// Library indices of the ends of all edges of the convex hull; none in a space with more than two axes.
    pub fn hull(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.triangulation.outline().iter().map(|e| e.map(|i| self.sites[i].0))
    }

    /// Location of `point`, or `None` if the space has no textures. A point outside the hull is moved to the nearest
    /// point of the hull, with `clamped` set.
    ///
    /// A point with another number of axes than the space is extended by the middle of the missing axes, or cut.
    pub fn locate(&self, point: SpacePoint) -> Option<Location> {
        let point = point.on(self.n_axes);
        if !self.is_triangulated() {
            return self.in_hull(point);
        }
        match self.triangulation.locate(point.xy()) {
            Some((triangle, weights)) => Some(self.inside(point, triangle, weights)),
            None => self.on_hull(point),
        }
    }

    /// Distance of a point from the boundary of the hull, in points of the axes; infinite if the space has no textures or
    /// no triangulation.
    pub fn hull_distance(&self, point: SpacePoint) -> f64 {
        let nearest = self.triangulation.nearest_on_outline(point.xy());
        nearest.map_or(f64::INFINITY, |(on, _)| point.moved_to(on).distance(point))
    }

    /// Position of the texture with this library index, or `None` if it has no position.
    pub fn position(&self, texture: usize) -> Option<SpacePoint> {
        // Sites are sorted by library index.
        let site = self.sites.binary_search_by_key(&texture, |(index, _)| *index).ok()?;
        Some(self.sites[site].1)
    }

    fn inside(&self, at: SpacePoint, triangle: usize, weights: [f64; 3]) -> Location {
        let corners = self.triangulation.corners(triangle).into_iter().zip(weights);
        Location { at, clamped: false, corners: corners.map(|(c, w)| (self.sites[c].0, w)).collect() }
    }

    fn on_hull(&self, point: SpacePoint) -> Option<Location> {
        let (on, ends) = self.triangulation.nearest_on_outline(point.xy())?;
        let at = point.moved_to(on);
        // If the textures are collinear or fewer than three, a point on their line counts as inside.
        let clamped = at.distance(point) > SAME;
        let corners = ends.iter().filter(|(_, w)| *w > 0.0).map(|(c, w)| (self.sites[*c].0, *w)).collect();
        Some(Location { at, clamped, corners })
    }

    /// Location in a space without a triangulation: the corners are those of the part of the hull in which the nearest point
    /// lies. They are not unique for a point inside.
    fn in_hull(&self, point: SpacePoint) -> Option<Location> {
        let (nearest, corners) = nearest_in_hull(&self.units, point.unit())?;
        let nearest = SpacePoint::from_unit(self.n_axes, nearest);
        let clamped = nearest.distance(point) > SAME;
        let corners = corners.into_iter().map(|(site, weight)| (self.sites[site].0, weight)).collect();
        Some(Location { at: if clamped { nearest } else { point }, clamped, corners })
    }
}

#[cfg(test)]
mod tests {
    use super::{LabelSource, Space, SpaceError, SpacePoint};

    fn point(rs: f64, hs: f64) -> SpacePoint {
        SpacePoint::new(rs, hs).unwrap()
    }

    fn triangle() -> Space {
        // Index 1 has no position, so library indices and site indices differ.
        Space::new(&[Some(point(0.0, 0.0)), None, Some(point(100.0, 0.0)), Some(point(20.0, 90.0))]).unwrap()
    }

    #[test]
    fn golden_barycentric_weights() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../../vectors/g_interp/weights_vectors.json")).unwrap();
        for case in v["weights"].as_array().unwrap() {
            let at = point(100.0 * case["q"][0].as_f64().unwrap(), 100.0 * case["q"][1].as_f64().unwrap());
            let location = triangle().locate(at).unwrap();
            for (corner, index) in [0, 2, 3].into_iter().enumerate() {
                let weight = location.corners.iter().find(|(i, _)| *i == index).map_or(0.0, |(_, w)| *w);
                assert!((weight - case["bary"][corner].as_f64().unwrap()).abs() < 1e-12, "{case}");
            }
        }
    }

    #[test]
    fn outside_points_are_moved_to_the_hull_and_say_so() {
        let location = triangle().locate(point(50.0, 0.0)).unwrap();
        assert!(!location.clamped);
        let location = triangle().locate(point(100.0, 100.0)).unwrap();
        assert!(location.clamped && location.corners.len() == 2);
        assert!((location.corners.iter().map(|c| c.1).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(location.at.distance(point(100.0, 100.0)) > 1.0);
    }

    #[test]
    fn positions_are_those_of_the_library() {
        let places: Vec<_> = (0..40)
            .map(|i| (i % 3 > 0).then(|| point(f64::from(i * 37 % 101), f64::from(i * 59 % 97))))
            .collect();
        let space = Space::new(&places).unwrap();
        for (texture, place) in places.iter().enumerate() {
            assert_eq!(space.position(texture), *place);
        }
        assert_eq!(space.position(places.len()), None);
    }

    #[test]
    fn few_textures_still_make_a_space() {
        assert_eq!(Space::new(&[None]).unwrap().locate(point(1.0, 2.0)), None);
        let one = Space::new(&[Some(point(30.0, 40.0))]).unwrap().locate(point(90.0, 40.0)).unwrap();
        assert!(one.clamped && one.corners == [(0, 1.0)]);
        let two = Space::new(&[Some(point(0.0, 0.0)), Some(point(100.0, 0.0))]).unwrap();
        assert_eq!(two.locate(point(25.0, 0.0)).unwrap().corners, [(0, 0.75), (1, 0.25)]);
        assert!(!two.locate(point(25.0, 0.0)).unwrap().clamped);
    }

    #[test]
    fn one_axis_is_a_line() {
        let at = |x: f64| Some(SpacePoint::of(&[x]).unwrap());
        let space = Space::new(&[at(20.0), at(80.0), at(40.0)]).unwrap();
        assert!(space.is_triangulated() && space.n_axes() == 1 && space.triangles().count() == 0);
        let between = space.locate(SpacePoint::of(&[30.0]).unwrap()).unwrap();
        assert!(!between.clamped);
        for ((corner, weight), expected) in between.corners.into_iter().zip([0, 2]) {
            assert!(corner == expected && (weight - 0.5).abs() < 1e-12, "{corner}: {weight}");
        }
        let outside = space.locate(SpacePoint::of(&[95.0]).unwrap()).unwrap();
        assert!(outside.clamped && outside.at.distance(at(80.0).unwrap()) < 1e-9);
        assert_eq!(outside.at.n_axes(), 1);
    }

    #[test]
    fn more_than_two_axes_have_a_hull_without_triangles() {
        let at = |x: f64, y: f64, z: f64| Some(SpacePoint::of(&[x, y, z]).unwrap());
        let space = Space::new(&[
            at(0.0, 0.0, 0.0),
            None,
            at(90.0, 0.0, 0.0),
            at(0.0, 90.0, 0.0),
            at(0.0, 0.0, 90.0),
        ])
        .unwrap();
        assert!(!space.is_triangulated() && space.triangles().count() == 0 && space.hull().count() == 0);
        let inside = space.locate(at(9.0, 18.0, 27.0).unwrap()).unwrap();
        assert_eq!((inside.clamped, inside.at), (false, at(9.0, 18.0, 27.0).unwrap()));
        for (texture, weight) in [(0, 0.4), (2, 0.1), (3, 0.2), (4, 0.3)] {
            let found = inside.corners.iter().find(|(of, _)| *of == texture).unwrap().1;
            assert!((found - weight).abs() < 1e-9, "{texture}: {found}");
        }
        let outside = space.locate(at(60.0, 60.0, 0.0).unwrap()).unwrap();
        assert!(outside.clamped && outside.at.distance(at(45.0, 45.0, 0.0).unwrap()) < 1e-9);
        // A point of the plane lies in the middle of the third axis.
        assert_eq!(space.locate(point(9.0, 18.0)).unwrap().at, at(9.0, 18.0, 50.0).unwrap());
        assert!(space.hull_distance(at(1.0, 1.0, 1.0).unwrap()).is_infinite());
    }

    #[test]
    fn positions_on_different_axes_make_no_space() {
        let places = [Some(point(1.0, 2.0)), None, Some(SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap())];
        assert_eq!(Space::new(&places), Err(SpaceError::Axes { texture: 2, n_axes: 3, expected: 2 }));
    }

    #[test]
    fn sources_round_trip() {
        for source in LabelSource::ALL {
            assert_eq!(LabelSource::from_id(source.id()), Some(source));
        }
        assert_eq!(LabelSource::from_id("guessed"), None);
    }
}
