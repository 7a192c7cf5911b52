//! Coordinates of a position in a file: the first two under the names of the usual axes, further ones in a list.

use serde::{Deserialize, Serialize};
use shagreen_core::space::{SpacePoint, SpacePointError};

/// Coordinates of a position. The names of the first two fields are those of the usual axes, whatever the axes are.
#[derive(Serialize, Deserialize)]
pub(crate) struct CoordinatesV1 {
    rough_smooth: f64,
    /// Absent for a position on one axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hard_soft: Option<f64>,
    /// Coordinates from the third axis on. Since version 1.8 of libraries, and 1.3 of projects.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    further: Vec<f64>,
}

/// Why coordinates in a file are not those of a position.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoordinatesError {
    /// There are further coordinates, but there is none on the second axis.
    #[error("it has `further` coordinates, but no `hard_soft`, the coordinate on the second axis")]
    NoSecond,
    /// A coordinate is outside its axis, or there are too many.
    #[error(transparent)]
    Point(#[from] SpacePointError),
}

impl CoordinatesV1 {
    /// The coordinates of a point, each rounded by a function.
    pub(crate) fn of(at: SpacePoint, rounded: impl Fn(f64) -> f64) -> Self {
        Self {
            rough_smooth: rounded(at.x()),
            hard_soft: at.get(1).map(&rounded),
            further: at.coordinates().iter().skip(2).map(|coordinate| rounded(*coordinate)).collect(),
        }
    }

    /// The point with these coordinates.
    pub(crate) fn point(&self) -> Result<SpacePoint, CoordinatesError> {
        match (self.hard_soft, &self.further[..]) {
            // Errors of a position on two axes say what the ends of the usual axes mean.
            (Some(hard_soft), []) => Ok(SpacePoint::new(self.rough_smooth, hard_soft)?),
            (Some(hard_soft), further) => {
                let first = [self.rough_smooth, hard_soft];
                Ok(SpacePoint::of(&[first.as_slice(), further].concat())?)
            }
            (None, []) => Ok(SpacePoint::of(&[self.rough_smooth])?),
            (None, _) => Err(CoordinatesError::NoSecond),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CoordinatesError, CoordinatesV1};
    use proptest::prelude::{prop, prop_assert_eq, proptest};
    use shagreen_core::space::{MOST_AXES, SpacePoint, SpacePointError};

    fn read(text: &str) -> Result<SpacePoint, CoordinatesError> {
        serde_json::from_str::<CoordinatesV1>(text).unwrap().point()
    }

    #[test]
    fn the_fields_are_as_many_as_there_are_axes() {
        for (coordinates, text) in [
            (&[1.5_f64][..], r#"{"rough_smooth":1.5}"#),
            (&[1.5, 2.0][..], r#"{"rough_smooth":1.5,"hard_soft":2.0}"#),
            (&[1.5, 2.0, 3.0][..], r#"{"rough_smooth":1.5,"hard_soft":2.0,"further":[3.0]}"#),
            (
                &[1.5, 2.0, 3.0, 4.0, 5.0, 6.0][..],
                r#"{"rough_smooth":1.5,"hard_soft":2.0,"further":[3.0,4.0,5.0,6.0]}"#,
            ),
        ] {
            let point = SpacePoint::of(coordinates).unwrap();
            assert_eq!(serde_json::to_string(&CoordinatesV1::of(point, |x| x)).unwrap(), text);
            assert_eq!(read(text), Ok(point));
        }
    }

    #[test]
    fn coordinates_of_no_position_are_refused() {
        assert_eq!(read(r#"{"rough_smooth": 1, "further": [3]}"#), Err(CoordinatesError::NoSecond));
        let seven = read(r#"{"rough_smooth": 1, "hard_soft": 2, "further": [3, 4, 5, 6, 7]}"#);
        assert_eq!(seven, Err(CoordinatesError::Point(SpacePointError::Count { n: 7 })));
        let message = |text: &str| read(text).unwrap_err().to_string();
        let meaning = "hard-soft is 101; it must be between 0 and 100 (0 is hardest)";
        assert_eq!(message(r#"{"rough_smooth": 1, "hard_soft": 101}"#), meaning);
        let third = message(r#"{"rough_smooth": 1, "hard_soft": 2, "further": [-3]}"#);
        assert!(third.starts_with("coordinate 3 is -3"), "{third}");
        assert!(message(r#"{"rough_smooth": 101}"#).starts_with("coordinate 1 is 101"));
    }

    proptest! {
        #[test]
        fn points_go_there_and_back(coordinates in prop::collection::vec(0.0_f64..=100.0, 1..=MOST_AXES)) {
            let point = SpacePoint::of(&coordinates).unwrap();
            let text = serde_json::to_string(&CoordinatesV1::of(point, |x| x)).unwrap();
            prop_assert_eq!(read(&text), Ok(point));
        }
    }
}
