//! The authoring space: a plane with the axes rough-smooth and hard-soft, on which textures have positions.

use std::fmt;

use crate::maths::triangulation::{Triangulation, TriangulationError, Xy};

/// A point of the space. Both axes run from 0 (roughest, hardest) to 100 (smoothest, softest).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpacePoint {
    /// Rough (0) to smooth (100).
    pub rough_smooth: f64,
    /// Hard (0) to soft (100).
    pub hard_soft: f64,
}

/// A coordinate is outside its axis.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{axis} is {value}; it must be between 0 and 100 (0 is {zero})")]
pub struct SpacePointError {
    /// Name of the axis.
    pub axis: &'static str,
    /// Value of the coordinate.
    pub value: f64,
    /// Meaning of 0 on this axis.
    pub zero: &'static str,
}

impl SpacePoint {
    /// Point with the given coordinates, each 0..100.
    ///
    /// # Errors
    /// [`SpacePointError`] if a coordinate is outside 0..100 or not finite.
    pub fn new(rough_smooth: f64, hard_soft: f64) -> Result<Self, SpacePointError> {
        let check = |axis, value: f64, zero| {
            if (0.0..=100.0).contains(&value) { Ok(()) } else { Err(SpacePointError { axis, value, zero }) }
        };
        check("rough-smooth", rough_smooth, "roughest")?;
        check("hard-soft", hard_soft, "hardest")?;
        Ok(Self { rough_smooth, hard_soft })
    }

    /// Euclidean distance to another point, in points of the axes.
    pub fn distance(self, other: Self) -> f64 {
        (self.rough_smooth - other.rough_smooth).hypot(self.hard_soft - other.hard_soft)
    }

    /// Coordinates scaled to the unit square.
    pub(crate) fn xy(self) -> Xy {
        [self.rough_smooth / 100.0, self.hard_soft / 100.0]
    }

    /// Point from coordinates in the unit square; slightly outside is allowed.
    pub(crate) fn from_xy(xy: Xy) -> Self {
        Self { rough_smooth: 100.0 * xy[0], hard_soft: 100.0 * xy[1] }
    }
}

impl fmt::Display for SpacePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1}, {:.1}", self.rough_smooth, self.hard_soft)
    }
}

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

/// Positions of textures and their Delaunay triangulation. A texture is identified by its index in the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// Library index and position of every texture that has a position.
    sites: Vec<(usize, SpacePoint)>,
    triangulation: Triangulation,
}

/// Location of a point relative to the textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Location {
    /// The requested point if it is inside the convex hull, else the nearest point of the hull.
    pub at: SpacePoint,
    /// Whether the requested point is outside the hull.
    pub clamped: bool,
    /// Library indices and barycentric weights of the surrounding textures: three, or fewer on an edge of the hull.
    /// Weights are non-negative and sum to one.
    pub corners: Vec<(usize, f64)>,
}

impl Space {
    /// Space of the textures that have a position; `positions` is indexed like the library.
    ///
    /// # Errors
    /// [`TriangulationError`] if a coordinate is not finite.
    pub fn new(positions: &[Option<SpacePoint>]) -> Result<Self, TriangulationError> {
        let sites: Vec<(usize, SpacePoint)> =
            positions.iter().enumerate().filter_map(|(i, p)| p.map(|p| (i, p))).collect();
        let points: Vec<Xy> = sites.iter().map(|(_, p)| p.xy()).collect();
        Ok(Self { triangulation: Triangulation::new(&points)?, sites })
    }

    /// Library index and position of every placed texture.
    pub fn sites(&self) -> &[(usize, SpacePoint)] {
        &self.sites
    }

    /// Library indices of the corners of all triangles.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.triangulation.triangles().map(|t| t.map(|i| self.sites[i].0))
    }

    /// Library indices of the ends of all edges of the convex hull.
    pub fn hull(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.triangulation.outline().iter().map(|e| e.map(|i| self.sites[i].0))
    }

    /// Location of `point`, or `None` if the space has no textures. A point outside the hull is moved to the nearest
    /// point of the hull, with `clamped` set.
    pub fn locate(&self, point: SpacePoint) -> Option<Location> {
        match self.triangulation.locate(point.xy()) {
            Some((triangle, weights)) => Some(self.inside(point, triangle, weights)),
            None => self.on_hull(point),
        }
    }

    /// Distance of a point from the boundary of the hull, in points of the axes; infinite if the space has no textures.
    pub fn hull_distance(&self, point: SpacePoint) -> f64 {
        let nearest = self.triangulation.nearest_on_outline(point.xy());
        nearest.map_or(f64::INFINITY, |(on, _)| SpacePoint::from_xy(on).distance(point))
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
        let at = SpacePoint::from_xy(on);
        // If the textures are collinear or fewer than three, a point on their line counts as inside.
        let clamped = at.distance(point) > 1e-9;
        let corners = ends.iter().filter(|(_, w)| *w > 0.0).map(|(c, w)| (self.sites[*c].0, *w)).collect();
        Some(Location { at, clamped, corners })
    }
}

#[cfg(test)]
mod tests {
    use super::{LabelSource, Space, SpacePoint};

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
    fn points_outside_the_square_are_refused() {
        for (rs, hs) in [(-0.1, 5.0), (5.0, 100.1), (f64::NAN, 5.0), (5.0, f64::INFINITY)] {
            assert!(SpacePoint::new(rs, hs).is_err());
        }
        let error = SpacePoint::new(130.0, 5.0).unwrap_err().to_string();
        assert!(error.contains("rough-smooth is 130"), "{error}");
    }

    #[test]
    fn sources_round_trip() {
        for source in LabelSource::ALL {
            assert_eq!(LabelSource::from_id(source.id()), Some(source));
        }
        assert_eq!(LabelSource::from_id("guessed"), None);
    }
}
