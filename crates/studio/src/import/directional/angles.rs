//! Angles of the directions of one texture.

use std::collections::BTreeMap;

use shagreen_formats::recording::directional::{NamedDirections, mean_direction_rad};

use crate::import::directional::DirectionalError;

/// Sine of the angle between the axes that a name and the positions give, from which on the difference is reported: 15°.
const OTHER_AXIS: f64 = 0.26;

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
    for (direction, moved_rad) in moved {
        let stated = stated_deg.get(direction).map(|degrees| degrees.to_radians());
        let by_name = named.angles_rad.get(direction).copied().flatten();
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
    if is_counted {
        warnings.push(
            "the directions are numbered, and no positions show their angles; the lowest number is read as 0°, and each further one as 45° more, counterclockwise"
                .to_owned(),
        );
    }
    if unknown.is_empty() { Ok(angles_rad) } else { Err(DirectionalError::UnknownDirections(unknown)) }
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
