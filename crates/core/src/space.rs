//! The authoring space: where textures lie between rough and smooth, hard and soft.

use std::fmt;

use crate::triangulation::{Triangulation, TriangulationError, Xy};

/// A point of the space. Both axes run 0 to 100: 0 is roughest, 0 is hardest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpacePoint {
    /// Rough to smooth, 0..100.
    pub rough_smooth: f64,
    /// Hard to soft, 0..100.
    pub hard_soft: f64,
}

/// Why numbers are no point of the space.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{axis} is {value}; it must lie between 0 and 100 (0 is {zero})")]
pub struct SpacePointError {
    /// The axis that is wrong.
    pub axis: &'static str,
    /// Its value.
    pub value: f64,
    /// What zero means on this axis.
    pub zero: &'static str,
}

impl SpacePoint {
    /// A point of the square.
    ///
    /// # Errors
    /// A coordinate outside 0..100, or not finite.
    pub fn new(rough_smooth: f64, hard_soft: f64) -> Result<Self, SpacePointError> {
        let check = |axis, value: f64, zero| {
            if (0.0..=100.0).contains(&value) { Ok(()) } else { Err(SpacePointError { axis, value, zero }) }
        };
        check("rough-smooth", rough_smooth, "roughest")?;
        check("hard-soft", hard_soft, "hardest")?;
        Ok(Self { rough_smooth, hard_soft })
    }

    /// Distance to another point, in points of the axes.
    pub fn distance(self, other: Self) -> f64 {
        (self.rough_smooth - other.rough_smooth).hypot(self.hard_soft - other.hard_soft)
    }

    /// The point in the unit square.
    pub(crate) fn xy(self) -> Xy {
        [self.rough_smooth / 100.0, self.hard_soft / 100.0]
    }

    /// A point of the unit square, which may lie a little outside of it.
    pub(crate) fn from_xy(xy: Xy) -> Self {
        Self { rough_smooth: 100.0 * xy[0], hard_soft: 100.0 * xy[1] }
    }
}

impl fmt::Display for SpacePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1}, {:.1}", self.rough_smooth, self.hard_soft)
    }
}

/// Where the positions of a space come from. They are never mixed up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelSource {
    /// People rated the textures.
    HumanRatings,
    /// Simulated raters did: for trying the pipeline, not for conclusions.
    SimulatedRaters,
    /// Physical quantities stand in for ratings: no person felt anything.
    PhysicalLabels,
    /// Words, a picture or a recording were taken for it: no person felt anything.
    Estimated,
}

impl LabelSource {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::HumanRatings, Self::SimulatedRaters, Self::PhysicalLabels, Self::Estimated];

    /// The words for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::HumanRatings => "human ratings",
            Self::SimulatedRaters => "simulated raters",
            Self::PhysicalLabels => "physical labels",
            Self::Estimated => "estimates",
        }
    }

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::HumanRatings => "human",
            Self::SimulatedRaters => "simulated",
            Self::PhysicalLabels => "physical",
            Self::Estimated => "estimated",
        }
    }

    /// The source that has this [`LabelSource::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|source| source.id() == id)
    }
}

/// Textures placed in the square and triangulated. A texture is known by its index in the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// Library index and position of every texture that has one.
    sites: Vec<(usize, SpacePoint)>,
    triangulation: Triangulation,
}

/// Where a point of the square lies among the textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Location {
    /// The point that is authored: the one asked for, or the nearest point of the hull.
    pub at: SpacePoint,
    /// Whether the point asked for lies outside the hull.
    pub clamped: bool,
    /// Library indices and barycentric weights of the surrounding textures: three, or fewer where the point lies on an
    /// edge of the hull. Weights are at least zero and sum to one.
    pub corners: Vec<(usize, f64)>,
}

impl Space {
    /// The space of the textures that have a position; `positions` is indexed like the library.
    ///
    /// # Errors
    /// A coordinate that is not finite.
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

    /// Library indices of the corners of every triangle.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.triangulation.triangles().map(|t| t.map(|i| self.sites[i].0))
    }

    /// Library indices of the ends of every edge of the hull.
    pub fn hull(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.triangulation.outline().iter().map(|e| e.map(|i| self.sites[i].0))
    }

    /// Where `point` lies; `None` only in a space without textures. A point outside the hull is moved to the hull's
    /// nearest point, and says so.
    pub fn locate(&self, point: SpacePoint) -> Option<Location> {
        match self.triangulation.locate(point.xy()) {
            Some((triangle, weights)) => Some(self.inside(point, triangle, weights)),
            None => self.on_hull(point),
        }
    }

    /// Distance of a point from the hull's outline, in points of the axes; infinite in a space without textures.
    pub fn hull_distance(&self, point: SpacePoint) -> f64 {
        let nearest = self.triangulation.nearest_on_outline(point.xy());
        nearest.map_or(f64::INFINITY, |(on, _)| SpacePoint::from_xy(on).distance(point))
    }

    /// The position of the texture with this library index.
    pub fn position(&self, texture: usize) -> Option<SpacePoint> {
        // Sites are in the order of the library.
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
        // Three or more collinear textures, or fewer than three: a point on their line is inside.
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
        // Index 1 has no position: library indices and sites differ.
        Space::new(&[Some(point(0.0, 0.0)), None, Some(point(100.0, 0.0)), Some(point(20.0, 90.0))]).unwrap()
    }

    #[test]
    fn golden_barycentric_weights() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../vectors/g_interp/weights_vectors.json")).unwrap();
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
