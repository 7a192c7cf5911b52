//! Points of the space as arguments: coordinates in the order of the axes, or by the names of the axes.

use serde_json::{Value, json};
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::Library;
use shagreen_formats::named_point::named_coordinates;
use shagreen_studio::points::{PointError, named_point, point_of};

use crate::cli::axis_name::axis_name;
use crate::cli::output::{Printed, Usage};

/// A point whose axes are those of a library that is not loaded yet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PointArg {
    /// Coordinates in the order of the axes, at least one.
    Ordered(Vec<f64>),
    /// Coordinates by the names of their axes, at least one. The names differ.
    Named(Vec<(String, f64)>),
}

/// How a point is written.
const HOW: &str =
    "write coordinates as in 30,70, or names and coordinates as in rough-smooth=30,hard-soft=70";

/// Parses a point: `30,70,45`, or `rough-smooth=30,sticky-slippery=45`.
pub(crate) fn parse_point(text: &str) -> Result<PointArg, String> {
    if !text.contains('=') {
        return Ok(PointArg::Ordered(text.split(',').map(number).collect::<Result<_, _>>()?));
    }
    let mut named: Vec<(String, f64)> = Vec::new();
    for part in text.split(',') {
        let Some((name, value)) = part.rsplit_once('=') else {
            return Err(format!("\"{}\" has no name; {HOW}", part.trim()));
        };
        let name = name.trim();
        if name.is_empty() {
            return Err(format!("\"{}\" has no name; {HOW}", part.trim()));
        }
        if named.iter().any(|(other, _)| other == name) {
            return Err(format!("{name} is given twice; give each axis once"));
        }
        named.push((name.to_owned(), number(value)?));
    }
    Ok(PointArg::Named(named))
}

fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    text.parse().map_err(|_| format!("\"{text}\" is not a number; {HOW}"))
}

impl PointArg {
    /// Returns the names of axes that the point states.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        let named: &[(String, f64)] = match self {
            Self::Ordered(_) => &[],
            Self::Named(named) => named,
        };
        named.iter().map(|(name, _)| name.as_str())
    }

    /// Returns the point on the axes of a library. On an axis that it does not name, it has the local mean of the textures,
    /// which a note states.
    ///
    /// Wrong usage: a coordinate outside 0 to 100, another number of coordinates than of axes, an axis that is named twice
    /// or that the library's positions do not have.
    pub(crate) fn in_space(&self, library: &Library) -> anyhow::Result<SpacePoint> {
        let point = match self {
            Self::Ordered(coordinates) => point_of(coordinates, library),
            Self::Named(named) => {
                let named: Vec<(String, f64)> =
                    named.iter().map(|(name, value)| (axis_name(library, name), *value)).collect();
                named_point(&named, library, &Printed)
            }
        };
        Ok(point.map_err(usage)?)
    }
}

/// Wrong usage, with the option that selects other axes.
fn usage(error: PointError) -> Usage {
    match error {
        PointError::Count { .. } => Usage(format!("{error}, or select the axes with --axes")),
        error => Usage(error.to_string()),
    }
}

/// Returns the coordinates of a point by the names of the axes, as JSON; null without a point.
pub(crate) fn named_json(library: &Library, at: Option<SpacePoint>) -> Value {
    json!(at.map(|at| named_coordinates(library.axis_names(), at)))
}

#[cfg(test)]
mod tests {
    use super::{named_json, parse_point};
    use serde_json::json;
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn names_and_order_give_the_same_point() {
        let library = starter_library().unwrap();
        let point = |text: &str| parse_point(text).unwrap().in_space(&library).unwrap();
        let at = point("30, 70.5");
        assert_eq!(at, SpacePoint::plane(30.0, 70.5));
        assert_eq!(point("hard-soft = 70.5, rough-smooth=30"), at);
        assert_eq!(named_json(&library, Some(at)), json!({"rough-smooth": 30.0, "hard-soft": 70.5}));
        assert!(named_json(&library, None).is_null());
    }

    /// Positions on the unnamed axis grow with the named one, so does the local mean.
    #[test]
    fn an_axis_without_a_name_has_its_local_mean() {
        let mut library = starter_library().unwrap();
        for (index, texture) in library.textures.iter_mut().enumerate() {
            let along = 4.0 * index as f64;
            texture.place.as_mut().unwrap().at = SpacePoint::plane(along, 20.0 + 0.5 * along);
        }
        for along in [10.0, 60.0] {
            let at = parse_point(&format!("rough-smooth={along}")).unwrap().in_space(&library).unwrap();
            assert_eq!(at.x(), along);
            assert!((at.y() - 20.0 - 0.5 * along).abs() < 1e-6, "{at}");
        }
        library.textures.clear();
        let at = parse_point("hard-soft=30").unwrap().in_space(&library).unwrap();
        assert_eq!(at, SpacePoint::plane(50.0, 30.0));
    }

    #[test]
    fn points_say_what_is_wrong() {
        let library = starter_library().unwrap();
        for (text, words) in [
            ("30", "write RS,HS"),
            ("30,70,45", "3 coordinates, but the space has 2 axes (rough-smooth, hard-soft)"),
            ("a,70", "\"a\" is not a number"),
            ("", "\"\" is not a number"),
            ("130,70", "rough-smooth is 130; it must be between 0 and 100 (0 = rough, 100 = smooth)"),
            ("30,-1", "hard-soft is -1"),
            ("NaN,1", "rough-smooth is NaN"),
            ("rough-smooth=130", "rough-smooth is 130"),
            ("rough-smooth=x", "\"x\" is not a number"),
            ("rough-smooth=30,70", "\"70\" has no name"),
            ("=30", "\"=30\" has no name"),
            ("hard-soft=3,hard-soft=4", "given twice"),
            ("warm-cold=3", "no axis \"warm-cold\"; its axes are rough-smooth, hard-soft"),
        ] {
            let error = match parse_point(text) {
                Ok(point) => point.in_space(&library).unwrap_err().to_string(),
                Err(error) => error,
            };
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
