//! Meaning of column names.

use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit, letters};

/// The quantity that a column name denotes, with its unit if stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meaning {
    Time(Option<TimeUnit>),
    Acceleration(Option<AccelerationUnit>),
    Speed(Option<SpeedUnit>),
    Position(Option<PositionUnit>),
    /// A bare x, y or z: a position or an acceleration.
    Axis,
    /// Normal force.
    Force(Option<ForceUnit>),
    /// Force along z, usually the normal force.
    ForceZ(Option<ForceUnit>),
}

/// Parses a name such as `t`, `Time (ms)`, `acc_x [g]`, `Speed in cm/s`, `speed_mm_per_s`. Returns `None` for an
/// unknown unit, which would otherwise cause a silent scaling error.
pub(super) fn meaning_of(name: &str) -> Option<Meaning> {
    if let Some((word, unit)) = name.split_once(['[', '(']) {
        let word = word.trim_end();
        let bare = word.len().checked_sub(3).and_then(|at| word.split_at_checked(at));
        let word = bare.filter(|(_, end)| end.eq_ignore_ascii_case(" in")).map_or(word, |(bare, _)| bare);
        return meaning(&letters(word), &letters(unit.trim_start().trim_start_matches("in ")));
    }
    let words: Vec<String> = name
        .split(|c: char| !c.is_alphanumeric() && c != '²')
        .map(letters)
        .filter(|word| !word.is_empty())
        .collect();
    if words.len() > MAX_WORDS {
        return None;
    }
    (1..=words.len()).rev().find_map(|n| {
        let unit = match &words[n..] {
            [word, unit @ ..] if word == "in" && !unit.is_empty() => unit,
            unit => unit,
        };
        meaning(&words[..n].concat(), &unit.concat())
    })
}

/// The unit of time in the brackets of a column name, whatever the name itself is, as in `Zeit (ms)`.
pub(super) fn time_unit_in(name: &str) -> Option<TimeUnit> {
    let (_, unit) = name.split_once(['[', '('])?;
    TimeUnit::parse(unit)
}

/// Maximum number of words in a column name; a longer text is prose.
const MAX_WORDS: usize = 20;

/// A name has a unit that does not belong to its quantity.
struct WrongUnit;

/// The unit in a name, if there is one.
fn unit<T>(text: &str, parse: impl Fn(&str) -> Option<T>) -> Result<Option<T>, WrongUnit> {
    if text.is_empty() { Ok(None) } else { parse(text).map(Some).ok_or(WrongUnit) }
}

fn meaning(word: &str, text: &str) -> Option<Meaning> {
    let axis = |stems: &[&str], marks: &[&str]| {
        stems.iter().any(|stem| {
            marks.iter().any(|mark| {
                word.strip_prefix(stem) == Some(mark)
                    || (word.strip_suffix(stem) == Some(mark) && !mark.is_empty())
            })
        })
    };
    let accelerations = [
        "a",
        "ac",
        "acc",
        "accel",
        "accelerometer",
        "acceleration",
        "accelerations",
        "linacc",
        "linearacceleration",
    ];
    match word {
        "millis" if text.is_empty() => return Some(Meaning::Time(Some(TimeUnit::Milliseconds))),
        "micros" if text.is_empty() => return Some(Meaning::Time(Some(TimeUnit::Microseconds))),
        "seconds" | "secs" if text.is_empty() => return Some(Meaning::Time(Some(TimeUnit::Seconds))),
        "t" | "time" | "timestamp" | "timestamps" | "elapsed" | "elapsedtime" => {
            return unit(text, TimeUnit::parse).map(Meaning::Time).ok();
        }
        "v" | "vel" | "speed" | "velocity" | "tangentialspeed" | "tangentialvelocity" | "scanspeed"
        | "scanningspeed" | "toolspeed" | "tipspeed" => {
            return unit(text, SpeedUnit::parse).map(Meaning::Speed).ok();
        }
        "f" | "fn" | "force" | "normalforce" | "forcenormal" | "fnormal" | "load" | "normalload" => {
            return unit(text, ForceUnit::parse).map(Meaning::Force).ok();
        }
        "fz" | "forcez" | "zforce" => return unit(text, ForceUnit::parse).map(Meaning::ForceZ).ok(),
        "x" | "y" | "z" => {
            return match (AccelerationUnit::parse(text), PositionUnit::parse(text)) {
                (Some(unit), _) => Some(Meaning::Acceleration(Some(unit))),
                (None, Some(unit)) => Some(Meaning::Position(Some(unit))),
                (None, None) => text.is_empty().then_some(Meaning::Axis),
            };
        }
        _ => {}
    }
    if axis(&["p", "pos", "position"], &["x", "y", "z"]) {
        return unit(text, PositionUnit::parse).map(Meaning::Position).ok();
    }
    if axis(&accelerations, &["", "x", "y", "z", "0", "1", "2", "3"]) {
        return unit(text, AccelerationUnit::parse).map(Meaning::Acceleration).ok();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{Meaning, meaning_of};
    use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

    #[test]
    fn usual_names_are_understood_and_others_are_not() {
        let si = Some(AccelerationUnit::MetersPerSecondSquared);
        let g = Some(AccelerationUnit::StandardGravity);
        for (name, expected) in [
            ("t", Some(Meaning::Time(None))),
            ("Time (ms)", Some(Meaning::Time(Some(TimeUnit::Milliseconds)))),
            ("t_s", Some(Meaning::Time(Some(TimeUnit::Seconds)))),
            ("time_us", Some(Meaning::Time(Some(TimeUnit::Microseconds)))),
            ("timestamp [s]", Some(Meaning::Time(Some(TimeUnit::Seconds)))),
            ("acc_x [g]", Some(Meaning::Acceleration(g))),
            ("ax (m/s^2)", Some(Meaning::Acceleration(si))),
            ("Acceleration X (m/s²)", Some(Meaning::Acceleration(si))),
            ("accel_y_mps2", Some(Meaning::Acceleration(si))),
            ("acc1", Some(Meaning::Acceleration(None))),
            ("AccZ", Some(Meaning::Acceleration(None))),
            ("a", Some(Meaning::Acceleration(None))),
            ("x [mm]", Some(Meaning::Position(Some(PositionUnit::Millimeters)))),
            ("pos_y", Some(Meaning::Position(None))),
            ("x [g]", Some(Meaning::Acceleration(g))),
            ("z", Some(Meaning::Axis)),
            ("speed_mm_per_s", Some(Meaning::Speed(Some(SpeedUnit::MillimetersPerSecond)))),
            ("v (m/s)", Some(Meaning::Speed(Some(SpeedUnit::MetersPerSecond)))),
            ("Normal force [N]", Some(Meaning::Force(Some(ForceUnit::Newtons)))),
            ("force_mN", Some(Meaning::Force(Some(ForceUnit::Millinewtons)))),
            ("Fz", Some(Meaning::ForceZ(None))),
            ("Speed in cm/s", Some(Meaning::Speed(Some(SpeedUnit::CentimetersPerSecond)))),
            ("Speed in (cm/s)", Some(Meaning::Speed(Some(SpeedUnit::CentimetersPerSecond)))),
            ("speed [in mm/s]", Some(Meaning::Speed(Some(SpeedUnit::MillimetersPerSecond)))),
            ("Force in N", Some(Meaning::Force(Some(ForceUnit::Newtons)))),
            ("normal force in mN", Some(Meaning::Force(Some(ForceUnit::Millinewtons)))),
            ("acceleration (m/s^2)", Some(Meaning::Acceleration(si))),
            ("acceleration in m/s^2", Some(Meaning::Acceleration(si))),
            ("time in ms", Some(Meaning::Time(Some(TimeUnit::Milliseconds)))),
            ("TIME IN [S]", Some(Meaning::Time(Some(TimeUnit::Seconds)))),
            ("x in mm", Some(Meaning::Position(Some(PositionUnit::Millimeters)))),
            // Inches are not supported.
            ("x in", None),
            ("force in lbf", None),
            ("acc_x [V]", None),
            ("gyro_x", None),
            ("Fx", None),
            ("material", None),
            ("", None),
        ] {
            assert_eq!(meaning_of(name), expected, "{name}");
        }
        assert_eq!(meaning_of(&"a ".repeat(1 << 20)), None);
    }
}
