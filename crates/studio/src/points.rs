//! Points of the space of a library, from coordinates in the order of its axes or by their names.

use shagreen_core::space::{SpacePoint, with_local_means};
use shagreen_core::words::counted;
use shagreen_formats::library::Library;
use shagreen_formats::project::plain_axis_name;

use crate::axes::axis_poles;
use crate::report::Reporter;

/// Why coordinates are no point of a space.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointError {
    /// There is another number of coordinates than of axes.
    #[error(
        "the point has {}, but the space has {} ({}); {}",
        counted(*.n_given, "coordinate"),
        counted_axes(.axes.len()),
        .axes.join(", "),
        how(.axes.len())
    )]
    Count {
        /// Number of coordinates.
        n_given: usize,
        /// Names of the axes.
        axes: Vec<String>,
    },
    /// A coordinate is outside its axis.
    #[error("{axis} is {value}; it must be between 0 and 100 (0 = {}, 100 = {})", .poles[0], .poles[1])]
    Coordinate {
        /// Name of the axis.
        axis: String,
        /// The coordinate.
        value: f64,
        /// Meaning of 0 and of 100 on the axis.
        poles: [String; 2],
    },
    /// The space has no axis of a name.
    #[error("the space has no axis \"{name}\"; its axes are {}", .axes.join(", "))]
    Unknown {
        /// The name.
        name: String,
        /// Names of the axes.
        axes: Vec<String>,
    },
    /// An axis is named twice.
    #[error("{axis} is given twice; give each axis once")]
    Twice {
        /// Name of the axis.
        axis: String,
    },
}

/// Returns the point with these coordinates, one for each axis of the library, in their order, each 0 to 100.
///
/// # Errors
/// [`PointError::Count`] and [`PointError::Coordinate`].
pub fn point_of(coordinates: &[f64], library: &Library) -> Result<SpacePoint, PointError> {
    let axes = library.axis_names();
    let count = || PointError::Count {
        n_given: coordinates.len(),
        axes: axes.iter().map(|axis| (*axis).to_owned()).collect(),
    };
    if coordinates.len() != axes.len() {
        return Err(count());
    }
    for (axis, value) in axes.iter().zip(coordinates) {
        check(axis, *value)?;
    }
    // A library has one to six axes.
    SpacePoint::of(coordinates).map_err(|_| count())
}

/// Returns the point with these coordinates by the names of the axes, each 0 to 100. On an axis that is not named, it has the
/// local mean of the textures, which is noted.
///
/// # Errors
/// [`PointError::Unknown`], [`PointError::Twice`] and [`PointError::Coordinate`].
pub fn named_point(
    named: &[(String, f64)],
    library: &Library,
    reporter: &dyn Reporter,
) -> Result<SpacePoint, PointError> {
    let axes = library.axis_names();
    let mut coordinates: Vec<Option<f64>> = vec![None; axes.len()];
    for (name, value) in named {
        let name = plain_axis_name(name);
        check(name, *value)?;
        let Some(axis) = axes.iter().position(|axis| *axis == name) else {
            let axes = axes.iter().map(|axis| (*axis).to_owned()).collect();
            return Err(PointError::Unknown { name: name.to_owned(), axes });
        };
        if coordinates[axis].replace(*value).is_some() {
            return Err(PointError::Twice { axis: name.to_owned() });
        }
    }
    let whole = with_local_means(&library.positions(), &coordinates);
    for ((axis, given), mean) in axes.iter().zip(&coordinates).zip(&whole) {
        if given.is_none() {
            reporter.note(&format!("{axis} is not given; its local mean is {mean:.1}"));
        }
    }
    point_of(&whole, library)
}

/// Returns the name of the texture at a point, such as `at 30 70`, which is `at-30-70` in file names.
pub fn point_name(coordinates: &[f64]) -> String {
    let numbers: Vec<String> = coordinates.iter().map(f64::to_string).collect();
    format!("at {}", numbers.join(" "))
}

fn check(axis: &str, value: f64) -> Result<(), PointError> {
    if (0.0..=100.0).contains(&value) {
        return Ok(());
    }
    Err(PointError::Coordinate { axis: axis.to_owned(), value, poles: axis_poles(axis) })
}

fn counted_axes(n: usize) -> String {
    if n == 1 { "1 axis".to_owned() } else { format!("{n} axes") }
}

fn how(n_axes: usize) -> &'static str {
    if n_axes == 2 { "write RS,HS as in 30,70" } else { "write one coordinate for each axis" }
}

#[cfg(test)]
mod tests {
    use super::{PointError, named_point, point_of};
    use crate::report::Warnings;
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn names_and_order_give_the_same_point_and_say_what_is_wrong() {
        let library = starter_library().unwrap();
        let named = |pairs: &[(&str, f64)]| {
            let pairs: Vec<(String, f64)> =
                pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
            named_point(&pairs, &library, &Warnings::default())
        };
        let at = SpacePoint::plane(30.0, 70.5);
        assert_eq!(point_of(&[30.0, 70.5], &library), Ok(at));
        assert_eq!(named(&[("hard-soft", 70.5), ("rough-smooth", 30.0)]), Ok(at));
        let mean = named(&[("hard-soft", 70.5)]).unwrap();
        assert!(mean.y() == 70.5 && (0.0..=100.0).contains(&mean.x()));
        let words = |point: Result<SpacePoint, PointError>| point.unwrap_err().to_string();
        assert!(
            words(point_of(&[30.0], &library)).contains("1 coordinate, but the space has 2 axes (rough-")
        );
        assert!(words(point_of(&[30.0, f64::NAN], &library)).starts_with("hard-soft is NaN; it must be"));
        assert!(words(named(&[("warm-cold", 3.0)])).contains("its axes are rough-smooth, hard-soft"));
        assert!(words(named(&[("hard-soft", 3.0), ("hard-soft", 4.0)])).contains("given twice"));
    }
}
