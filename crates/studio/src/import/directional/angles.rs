//! Angles of the directions of one texture.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use shagreen_formats::recording::directional::{NamedDirections, mean_direction_rad};

use crate::import::directional::DirectionalError;

/// Sine of the angle between the axes that a name and the positions give, from which on the difference is reported: 15°.
const OTHER_AXIS: f64 = 0.26;

/// Number of directions whose axes show that names count angles clockwise.
const MIN_CLOCKWISE: usize = 2;

/// Angle in rad of each direction of the strokes, which are given as the direction of the file name and the direction of
/// the positions.
///
/// # Errors
/// [`DirectionalError::UnknownDirections`].
pub(super) fn angles_rad(
    strokes: &[(&str, Option<f64>)],
    named: &NamedDirections,
    stated_deg: &BTreeMap<String, f64>,
    warnings: &mut Vec<String>,
) -> Result<BTreeMap<String, f64>, DirectionalError> {
    let mut moved: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (direction, moved_rad) in strokes {
        moved.entry(*direction).or_default().extend(*moved_rad);
    }
    let mut angles_rad = BTreeMap::new();
    let (mut unknown, mut others, mut is_counted) = (Vec::new(), Vec::new(), false);
    let is_clockwise = are_clockwise(&moved, named);
    for (direction, moved_rad) in moved {
        let stated = stated_deg.get(direction).map(|degrees| degrees.to_radians());
        let named_rad = named.angles_rad.get(direction).copied().flatten();
        let by_name = named_rad.map(|rad| if is_clockwise { (TAU - rad).rem_euclid(TAU) } else { rad });
        let by_motion = mean_direction_rad(&moved_rad);
        if stated.is_none()
            && let Some((name_rad, motion_rad)) = by_name.zip(by_motion)
            && (name_rad - motion_rad).sin().abs() > OTHER_AXIS
        {
            others.push(format!("{direction} ({:.0}°)", motion_rad.to_degrees()));
        }
        let known = stated.or(by_name).or(by_motion);
        let by_count = named.counted_rad.get(direction).copied();
        is_counted |= known.is_none() && by_count.is_some();
        match known.or(by_count) {
            Some(angle_rad) => _ = angles_rad.insert(direction.to_owned(), angle_rad),
            None => unknown.push(direction.to_owned()),
        }
    }
    if !others.is_empty() {
        warnings.push(format!(
            "the positions run along other axes than the names of the directions say: {}; the names are used, state the angles to use others",
            others.join(", ")
        ));
    }
    if is_clockwise {
        warnings.push(
            "the names of the directions count angles clockwise, as the positions show; they are converted to counterclockwise"
                .to_owned(),
        );
    }
    if is_counted {
        warnings.push(
            "the directions are numbered, and no positions show their angles; the lowest number is read as 0°, and each further one as 45° more, counterclockwise"
                .to_owned(),
        );
    }
    if unknown.is_empty() { Ok(angles_rad) } else { Err(DirectionalError::UnknownDirections(unknown)) }
}

/// Whether the positions run along the mirror images of the axes that the names state, and along none of these axes.
/// Axes that are their own mirror images, such as 0° and 90°, show nothing.
fn are_clockwise(moved: &BTreeMap<&str, Vec<f64>>, named: &NamedDirections) -> bool {
    let is_same_axis = |a: f64, b: f64| (a - b).sin().abs() <= OTHER_AXIS;
    let both = moved.iter().filter_map(|(direction, moved_rad)| {
        let name_rad = named.angles_rad.get(*direction).copied().flatten()?;
        Some((name_rad, mean_direction_rad(moved_rad)?))
    });
    let oblique: Vec<(f64, f64)> = both.filter(|(name, _)| !is_same_axis(*name, -*name)).collect();
    oblique.len() >= MIN_CLOCKWISE
        && oblique.iter().all(|(name, motion)| is_same_axis(-*name, *motion) && !is_same_axis(*name, *motion))
}

#[cfg(test)]
mod tests {
    use super::{DirectionalError, angles_rad};
    use shagreen_formats::recording::directional::name_directions;
    use std::collections::BTreeMap;

    fn angles(
        strokes: &[(&str, Option<f64>)],
        stated: &[(&str, f64)],
    ) -> (Result<Vec<f64>, DirectionalError>, Vec<String>) {
        let named = name_directions(&strokes.iter().map(|(direction, _)| *direction).collect());
        let stated: BTreeMap<String, f64> =
            stated.iter().map(|(direction, degrees)| ((*direction).to_owned(), *degrees)).collect();
        let moved: Vec<(&str, Option<f64>)> =
            strokes.iter().map(|(direction, degrees)| (*direction, degrees.map(f64::to_radians))).collect();
        let mut warnings = Vec::new();
        let found = angles_rad(&moved, &named, &stated, &mut warnings);
        (found.map(|found| found.values().map(|angle| angle.to_degrees().round()).collect()), warnings)
    }

    #[test]
    fn the_stated_angle_counts_first_then_the_name_then_the_positions() {
        let strokes = [("0", Some(1.0)), ("90", Some(91.0)), ("along", Some(45.0)), ("along", Some(47.0))];
        assert_eq!(angles(&strokes, &[]), (Ok(vec![0.0, 90.0, 46.0]), vec![]));
        assert_eq!(angles(&strokes, &[("90", 80.0)]).0, Ok(vec![0.0, 80.0, 46.0]));
        // The opposite direction is the same axis.
        assert_eq!(angles(&[("0", Some(181.0))], &[]), (Ok(vec![0.0]), vec![]));
        let (found, warnings) = angles(&[("0", Some(0.0)), ("45", Some(315.0))], &[]);
        assert_eq!(found, Ok(vec![0.0, 45.0]));
        assert!(warnings.len() == 1 && warnings[0].contains("45 (315°)"), "{warnings:?}");
    }

    /// The Cluster Haptic Texture Dataset counts its angles clockwise.
    #[test]
    fn names_that_count_clockwise_are_recognized_by_the_positions() {
        let names = ["0", "45", "90", "135", "180", "225", "270", "315"];
        let degrees = |name: &str| name.parse::<f64>().unwrap();
        let clockwise = names.map(|name| (name, Some(360.0 - degrees(name))));
        let (found, warnings) = angles(&clockwise, &[]);
        // In the order of the names as texts.
        let mut in_order = names;
        in_order.sort_unstable();
        let expected: Vec<f64> = in_order.iter().map(|name| (360.0 - degrees(name)) % 360.0).collect();
        assert_eq!(found, Ok(expected));
        assert!(warnings.len() == 1 && warnings[0].contains("clockwise"), "{warnings:?}");
        // A stated angle counts as it is.
        assert_eq!(angles(&clockwise, &[("45", 45.0)]).0.unwrap()[6], 45.0);
        // Names that count counterclockwise, a single oblique direction and mixed ones stay.
        let counter = names.map(|name| (name, Some(degrees(name))));
        assert_eq!(angles(&counter, &[]).1, [""; 0]);
        let mixed = [("45", Some(315.0)), ("135", Some(135.0))];
        assert!(angles(&mixed, &[]).1[0].contains("45 (315°)"));
    }

    #[test]
    fn numbers_are_eighths_of_a_turn_only_if_nothing_else_is_known() {
        let numbers = ["1", "2", "3", "4", "5", "6", "7", "8"];
        let (found, warnings) = angles(&numbers.map(|number| (number, None)), &[]);
        assert_eq!(found, Ok((0..8).map(|i| 45.0 * f64::from(i)).collect()));
        assert!(warnings.len() == 1 && warnings[0].contains("are numbered"), "{warnings:?}");
        let moved = numbers.map(|number| (number, Some(10.0)));
        assert_eq!(angles(&moved, &[]), (Ok(vec![10.0; 8]), vec![]));
        let (found, _) = angles(&[("1", None), ("2", None)], &[("1", 0.0)]);
        assert_eq!(found, Err(DirectionalError::UnknownDirections(vec!["2".to_owned()])));
    }
}
