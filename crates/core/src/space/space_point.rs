//! Points of the authoring space.

use std::fmt;

use crate::maths::triangulation::Xy;

/// Largest number of axes of a space.
pub const MOST_AXES: usize = 6;

/// Coordinates in the unit cube; those of axes that the space does not have are zero.
pub(crate) type Unit = [f64; MOST_AXES];

/// Middle of an axis: the coordinate of a point on an axis where nothing else is known.
pub const MIDDLE: f64 = 50.0;

/// Half of the last decimal with which points are displayed, in points of the axes.
const HALF_OF_LAST_DECIMAL: f64 = 0.05;

/// A point of the space, with one coordinate for each of its one to [`MOST_AXES`] axes.
///
/// Axes run from 0 to 100. The first two are those of the canvas, usually rough (0) to smooth (100) and hard (0) to soft
/// (100).
#[derive(Clone, Copy, PartialEq)]
pub struct SpacePoint {
    n_axes: usize,
    /// Those of axes that the point does not have are zero.
    coordinates: [f64; MOST_AXES],
}

/// A point cannot have these coordinates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpacePointError {
    /// A coordinate is outside its axis.
    #[error("{axis} is {value}; it must be between 0 and 100{}", meaning(*.zero))]
    Coordinate {
        /// Name of the axis.
        axis: String,
        /// Value of the coordinate.
        value: f64,
        /// Meaning of 0 on this axis, if it is known.
        zero: Option<&'static str>,
    },
    /// There is no coordinate, or there are too many.
    #[error("a point has 1 to {MOST_AXES} coordinates, got {n}; give one for each axis of the space")]
    Count {
        /// Number of coordinates.
        n: usize,
    },
}

impl Default for SpacePoint {
    /// The point at 0 on two axes.
    fn default() -> Self {
        Self::plane(0.0, 0.0)
    }
}

impl SpacePoint {
    /// Point on the two usual axes, each 0..100.
    ///
    /// # Errors
    /// [`SpacePointError`] if a coordinate is outside 0..100 or not finite.
    pub fn new(rough_smooth: f64, hard_soft: f64) -> Result<Self, SpacePointError> {
        let check = |axis: &str, value: f64, zero| {
            if is_on_axis(value) {
                return Ok(());
            }
            Err(SpacePointError::Coordinate { axis: axis.to_owned(), value, zero: Some(zero) })
        };
        check("rough-smooth", rough_smooth, "roughest")?;
        check("hard-soft", hard_soft, "hardest")?;
        Ok(Self::plane(rough_smooth, hard_soft))
    }

    /// Point with these coordinates, each 0..100, one for each axis.
    ///
    /// # Errors
    /// [`SpacePointError`] if there are none or too many, or one is outside 0..100 or not finite.
    pub fn of(coordinates: &[f64]) -> Result<Self, SpacePointError> {
        let n = coordinates.len();
        if !(1..=MOST_AXES).contains(&n) {
            return Err(SpacePointError::Count { n });
        }
        if let Some(axis) = coordinates.iter().position(|value| !is_on_axis(*value)) {
            let (name, value) = (format!("coordinate {}", axis + 1), coordinates[axis]);
            return Err(SpacePointError::Coordinate { axis: name, value, zero: None });
        }
        Ok(Self::default().on(n).with_all(coordinates))
    }

    /// Point on two axes, whose coordinates are not checked.
    pub const fn plane(x: f64, y: f64) -> Self {
        let mut coordinates = [0.0; MOST_AXES];
        (coordinates[0], coordinates[1]) = (x, y);
        Self { n_axes: 2, coordinates }
    }

    /// Number of axes.
    pub fn n_axes(self) -> usize {
        self.n_axes
    }

    /// Coordinates, one for each axis.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates[..self.n_axes]
    }

    /// Coordinate on the first axis, to the right on the canvas.
    pub fn x(self) -> f64 {
        self.coordinates[0]
    }

    /// Coordinate on the second axis, upward on the canvas; the middle for a point with one axis.
    pub fn y(self) -> f64 {
        self.get(1).unwrap_or(MIDDLE)
    }

    /// Coordinate on an axis, counted from 0; `None` if the point does not have the axis.
    pub fn get(self, axis: usize) -> Option<f64> {
        self.coordinates().get(axis).copied()
    }

    /// The point with another coordinate on one axis, which is limited to the axis. An axis that the point does not have
    /// changes nothing.
    #[must_use]
    pub fn with(mut self, axis: usize, value: f64) -> Self {
        if axis < self.n_axes {
            self.coordinates[axis] = value.clamp(0.0, 100.0);
        }
        self
    }

    /// The point moved on the canvas to another one, with its own coordinates on the other axes.
    #[must_use]
    pub fn on_canvas_at(mut self, to: Self) -> Self {
        let n = self.n_axes.min(2);
        self.coordinates[..n].copy_from_slice(&[to.x(), to.y()][..n]);
        self
    }

    /// The point on this number of axes (1 to [`MOST_AXES`]): further coordinates are in the middle, or left out.
    #[must_use]
    pub fn on(mut self, n_axes: usize) -> Self {
        let n_axes = n_axes.clamp(1, MOST_AXES);
        if n_axes == self.n_axes {
            return self;
        }
        for axis in 0..MOST_AXES {
            if axis >= n_axes {
                self.coordinates[axis] = 0.0;
            } else if axis >= self.n_axes {
                self.coordinates[axis] = MIDDLE;
            }
        }
        self.n_axes = n_axes;
        self
    }

    fn with_all(mut self, coordinates: &[f64]) -> Self {
        self.coordinates[..self.n_axes].copy_from_slice(coordinates);
        self
    }

    /// The point that lies at this share, 0..1, of the straight way to another one.
    #[must_use]
    pub fn toward(mut self, to: Self, share: f64) -> Self {
        for (from, to) in self.coordinates.iter_mut().zip(to.coordinates) {
            *from += share * (to - *from);
        }
        self
    }

    /// Euclidean distance to another point, in points of the axes.
    pub fn distance(self, other: Self) -> f64 {
        // The same bits for two axes as in the plane.
        let [x, y, further @ ..] =
            std::array::from_fn::<f64, MOST_AXES, _>(|axis| self.coordinates[axis] - other.coordinates[axis]);
        let n_further = self.n_axes.max(other.n_axes).saturating_sub(2);
        further[..n_further].iter().fold(x.hypot(y), |sum, distance| sum.hypot(*distance))
    }

    /// Axis, counted from 0, on which another point differs most from this one as points are displayed, with one decimal.
    /// `None` if all displayed coordinates are equal, or if the points are at most half of the last decimal apart.
    pub fn most_different_axis(self, other: Self) -> Option<usize> {
        if self.distance(other) <= HALF_OF_LAST_DECIMAL {
            return None;
        }
        let shown = |value: f64| format!("{value:.1}");
        let difference = |axis: usize| Some((self.get(axis)? - other.get(axis)?).abs());
        let is_shown = |axis: &usize| self.get(*axis).map(shown) != other.get(*axis).map(shown);
        let different = (0..self.n_axes).filter(is_shown).filter_map(|axis| Some((axis, difference(axis)?)));
        different.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(axis, _)| axis)
    }

    /// Coordinates on the first two axes, scaled to the unit square.
    pub(crate) fn xy(self) -> Xy {
        [self.coordinates[0] / 100.0, self.coordinates[1] / 100.0]
    }

    /// The point with other coordinates on its first two axes, from the unit square; slightly outside is allowed.
    pub(crate) fn moved_to(self, xy: Xy) -> Self {
        self.on_canvas_at(Self::plane(100.0 * xy[0], 100.0 * xy[1]))
    }

    /// Coordinates scaled to the unit cube.
    pub(crate) fn unit(self) -> Unit {
        self.coordinates.map(|coordinate| coordinate / 100.0)
    }

    /// Point on this number of axes from coordinates in the unit cube; slightly outside is allowed.
    pub(crate) fn from_unit(n_axes: usize, unit: Unit) -> Self {
        Self { n_axes, coordinates: unit.map(|coordinate| 100.0 * coordinate) }.on(n_axes)
    }
}

fn meaning(zero: Option<&str>) -> String {
    zero.map_or(String::new(), |zero| format!(" (0 is {zero})"))
}

fn is_on_axis(value: f64) -> bool {
    (0.0..=100.0).contains(&value)
}

impl fmt::Debug for SpacePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("SpacePoint").field(&self.coordinates()).finish()
    }
}

impl fmt::Display for SpacePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (axis, coordinate) in self.coordinates().iter().enumerate() {
            let comma = if axis == 0 { "" } else { ", " };
            write!(f, "{comma}{coordinate:.1}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_AXES, SpacePoint, SpacePointError};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

    #[test]
    fn points_outside_their_axes_are_refused() {
        for (x, y) in [(-0.1, 5.0), (5.0, 100.1), (f64::NAN, 5.0), (5.0, f64::INFINITY)] {
            assert!(SpacePoint::new(x, y).is_err() && SpacePoint::of(&[x, y]).is_err());
        }
        let error = SpacePoint::new(130.0, 5.0).unwrap_err().to_string();
        assert_eq!(error, "rough-smooth is 130; it must be between 0 and 100 (0 is roughest)");
        let error = SpacePoint::of(&[1.0, 2.0, -3.0]).unwrap_err().to_string();
        assert_eq!(error, "coordinate 3 is -3; it must be between 0 and 100");
        for n in [0, MOST_AXES + 1] {
            assert_eq!(SpacePoint::of(&vec![1.0; n]), Err(SpacePointError::Count { n }));
        }
    }

    #[test]
    fn a_point_takes_and_leaves_axes() {
        let point = SpacePoint::of(&[10.0, 20.0, 30.0, 40.0]).unwrap();
        assert_eq!((point.x(), point.y(), point.get(3), point.get(4)), (10.0, 20.0, Some(40.0), None));
        assert_eq!(point.to_string(), "10.0, 20.0, 30.0, 40.0");
        assert_eq!(point.on(2), SpacePoint::plane(10.0, 20.0));
        assert_eq!(point.on(2).on(4).coordinates(), [10.0, 20.0, 50.0, 50.0]);
        assert_eq!(point.with(2, 130.0).coordinates(), [10.0, 20.0, 100.0, 40.0]);
        assert_eq!(point.with(4, 1.0), point);
        let moved = point.on_canvas_at(SpacePoint::plane(1.0, 2.0));
        assert_eq!(moved.coordinates(), [1.0, 2.0, 30.0, 40.0]);
        let one = SpacePoint::of(&[7.0]).unwrap();
        assert_eq!((one.y(), one.on_canvas_at(point).coordinates()), (50.0, [10.0].as_slice()));
    }

    #[test]
    fn points_that_look_equal_differ_on_no_axis() {
        let from = SpacePoint::of(&[48.86, 49.74, 34.0]).unwrap();
        let differs = |coordinates: [f64; 3]| from.most_different_axis(SpacePoint::of(&coordinates).unwrap());
        assert_eq!(differs([48.86, 49.74, 34.0]), None);
        assert_eq!(differs([48.86, 49.76, 34.0]), None, "less than half of the last decimal");
        // A larger distance that no displayed digit shows.
        assert_eq!(differs([48.94, 49.74, 34.0]), None);
        assert_eq!(differs([48.94, 49.79, 34.0]), Some(1), "the axis whose digits differ");
        assert_eq!(differs([50.0, 49.0, 62.0]), Some(2));
    }

    proptest! {
        #[test]
        fn distances_are_euclidean_and_units_go_there_and_back(
            a in prop::collection::vec(0.0_f64..100.0, 1..=MOST_AXES),
            b in prop::collection::vec(0.0_f64..100.0, MOST_AXES),
            share in 0.0_f64..1.0,
        ) {
            let (from, to) = (SpacePoint::of(&a).unwrap(), SpacePoint::of(&b[..a.len()]).unwrap());
            let sum: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
            prop_assert!((from.distance(to) - sum.sqrt()).abs() < 1e-9);
            prop_assert!(SpacePoint::from_unit(a.len(), from.unit()).distance(from) < 1e-9);
            let between = from.toward(to, share);
            prop_assert_eq!(between.n_axes(), a.len());
            prop_assert!((between.distance(from) - share * sum.sqrt()).abs() < 1e-9);
        }
    }
}
