//! Directions that file names state, as angles.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Directions that count as numbered by eighths of a turn: 0 to 7, or 1 to 8.
const N_EIGHTHS: usize = 8;

/// Highest whole number that may be a number of a direction instead of an angle in degrees.
const MAX_NUMBER: f64 = 8.0;

/// Angles of directions that file names state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedDirections {
    /// Direction as written, and its angle in rad, counterclockwise from the x axis (to the right); `None` if the text
    /// does not state an angle.
    pub angles_rad: BTreeMap<String, Option<f64>>,
    /// Directions that are numbered 0 to 7 or 1 to 8, with the angle in rad by eighths of a turn counterclockwise from
    /// the x axis; empty unless all numbers occur. The angles are an assumption.
    pub counted_rad: BTreeMap<String, f64>,
}

/// Interprets the directions of a folder.
///
/// Numbers are angles in degrees, counterclockwise from the x axis. If all of them are whole numbers up to 8, and there
/// are at least two, they only number the directions. Words such as `right`, `up`, `NE` and `45deg` are angles too.
pub fn name_directions(texts: &BTreeSet<&str>) -> NamedDirections {
    let bare: Vec<f64> = texts.iter().filter_map(|text| text.parse().ok()).collect();
    let is_number = |value: &f64| value.fract() == 0.0 && (0.0..=MAX_NUMBER).contains(value);
    let are_numbers = bare.len() >= 2 && bare.iter().all(is_number);
    let mut named = NamedDirections::default();
    for text in texts {
        let is_bare = text.parse::<f64>().is_ok();
        let angle_rad = if are_numbers && is_bare { None } else { angle_of(text) };
        named.angles_rad.insert((*text).to_owned(), angle_rad);
    }
    let lowest = bare.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = bare.iter().copied().fold(0.0, f64::max);
    if are_numbers && bare.len() == N_EIGHTHS && highest - lowest == (N_EIGHTHS - 1) as f64 {
        let angle_rad = |number: f64| (number - lowest) * TAU / N_EIGHTHS as f64;
        let of = |text: &&str| Some(((*text).to_owned(), angle_rad(text.parse().ok()?)));
        named.counted_rad = texts.iter().filter_map(of).collect();
    }
    named
}

/// Angle of a direction in rad: a number of degrees, or a word.
fn angle_of(text: &str) -> Option<f64> {
    let text = text.to_lowercase();
    if text.contains(|c: char| c.is_ascii_digit()) {
        return degrees_of(&text).map(|degrees| degrees.to_radians().rem_euclid(TAU));
    }
    let letters: String = text.chars().filter(|c| c.is_alphabetic()).collect();
    let eighths = match letters.as_str() {
        "right" | "e" | "east" | "horizontal" | "x" => 0,
        "upright" | "rightup" | "ne" | "northeast" => 1,
        "up" | "n" | "north" | "forward" | "vertical" | "y" => 2,
        "upleft" | "leftup" | "nw" | "northwest" => 3,
        "left" | "w" | "west" => 4,
        "downleft" | "leftdown" | "sw" | "southwest" => 5,
        "down" | "s" | "south" | "backward" => 6,
        "downright" | "rightdown" | "se" | "southeast" => 7,
        _ => return None,
    };
    Some(f64::from(eighths) * TAU / N_EIGHTHS as f64)
}

/// Number of degrees, with or without a label and a unit, such as `45`, `d45` and `45deg`.
fn degrees_of(text: &str) -> Option<f64> {
    let number = text.trim_start_matches(char::is_alphabetic);
    let label = &text[..text.len() - number.len()];
    let digits = number.trim_end_matches(|c: char| c.is_alphabetic() || c == '°');
    let unit = &number[digits.len()..];
    let is_known = ["", "d", "dir", "direction", "angle"].contains(&label)
        && ["", "°", "deg", "degree", "degrees"].contains(&unit);
    let degrees: Option<f64> = digits.parse().ok();
    degrees.filter(|degrees| is_known && (-360.0..=360.0).contains(degrees))
}

/// Mean direction in rad, 0 to 2π. Directions that cancel, such as strokes there and back, give the axis of the strokes,
/// 0 to π. `None` without directions.
pub fn mean_direction_rad(directions_rad: &[f64]) -> Option<f64> {
    let mean = |times: f64| {
        let (sines, cosines): (Vec<f64>, Vec<f64>) =
            directions_rad.iter().map(|direction| (times * direction).sin_cos()).unzip();
        let (sin, cos) = (sines.iter().sum::<f64>(), cosines.iter().sum::<f64>());
        (sin.hypot(cos) / directions_rad.len() as f64, sin.atan2(cos) / times)
    };
    if directions_rad.is_empty() {
        return None;
    }
    let (length, direction_rad) = mean(1.0);
    Some(if length >= 0.5 { direction_rad.rem_euclid(TAU) } else { mean(2.0).1.rem_euclid(0.5 * TAU) })
}

#[cfg(test)]
mod tests {
    use super::{angle_of, mean_direction_rad, name_directions};
    use std::collections::BTreeSet;

    fn degrees(text: &str) -> Option<f64> {
        angle_of(text).map(|angle| (1e9 * angle.to_degrees()).round() * 1e-9)
    }

    #[test]
    fn angles_are_degrees_or_words() {
        for (text, expected) in [
            ("0", 0.0),
            ("22.5", 22.5),
            ("-45", 315.0),
            ("45deg", 45.0),
            ("135°", 135.0),
            ("D90", 90.0),
            ("dir180", 180.0),
            ("angle270degrees", 270.0),
            ("right", 0.0),
            ("NE", 45.0),
            ("Up", 90.0),
            ("left-down", 225.0),
            ("vertical", 90.0),
        ] {
            let found = degrees(text).unwrap_or_else(|| panic!("{text} is an angle"));
            assert!((found - expected).abs() < 1e-6, "{text} is {found}");
        }
        for text in ["", "720", "45rad", "run45", "n45", "along", "1e9", "nan", "inf", "-", "°"] {
            assert_eq!(degrees(text), None, "{text}");
        }
    }

    #[test]
    fn small_whole_numbers_only_number_the_directions() {
        let named = |texts: &[&str]| name_directions(&texts.iter().copied().collect::<BTreeSet<&str>>());
        let angles = named(&["0", "45", "90"]);
        assert!(angles.angles_rad.values().all(Option::is_some) && angles.counted_rad.is_empty());
        let few = named(&["1", "2", "3"]);
        assert!(few.angles_rad.values().all(Option::is_none) && few.counted_rad.is_empty());
        for eight in [["0", "1", "2", "3", "4", "5", "6", "7"], ["1", "2", "3", "4", "5", "6", "7", "8"]] {
            let counted = named(&eight);
            assert!(counted.angles_rad.values().all(Option::is_none));
            for (text, eighths) in eight.iter().zip(0..) {
                let angle = counted.counted_rad[*text].to_degrees();
                assert!((angle - 45.0 * f64::from(eighths)).abs() < 1e-9, "{text} is {angle}");
            }
        }
        // One direction, and numbers beside words, keep their meaning.
        assert_eq!(named(&["0"]).angles_rad["0"], Some(0.0));
        assert!(named(&["1", "2", "up"]).angles_rad["up"].is_some());
    }

    #[test]
    fn the_mean_of_directions_is_theirs_or_that_of_their_axis() {
        let mean = |degrees: &[f64]| {
            let angles: Vec<f64> = degrees.iter().map(|d| d.to_radians()).collect();
            mean_direction_rad(&angles).map(f64::to_degrees)
        };
        for (directions, expected) in [
            (vec![10.0, 20.0], 15.0),
            (vec![350.0, 12.0], 1.0),
            (vec![40.0, 220.0, 50.0, 230.0], 45.0),
            (vec![200.0], 200.0),
        ] {
            let found = mean(&directions).unwrap();
            assert!((found - expected).abs() < 1e-6, "{found}, expected {expected}");
        }
        assert_eq!(mean(&[]), None);
    }
}
