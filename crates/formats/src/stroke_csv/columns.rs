//! Assignment of the columns of a stroke table.

use crate::stroke::PressUnit;
use crate::stroke_csv::StrokeCsvError;

/// The quantities in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Speed and force.
    Contacts,
    /// Positions, and pressure or force.
    Pen(PressUnit),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TimeUnit {
    Seconds,
    Milliseconds,
}

/// Indices of the columns in a row of `n`.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    pub(super) n: usize,
    pub(super) kind: Kind,
    pub(super) time: usize,
    pub(super) time_unit: Option<TimeUnit>,
    pub(super) touching: Option<usize>,
    /// Speed towards the surface.
    pub(super) speed_normal: Option<usize>,
    /// Whether no acceleration recording has columns of these names.
    pub(super) are_of_a_stroke_only: bool,
    /// Indices of speed and force, or of x, y and pressure or force.
    values: Vec<usize>,
}

/// Quantities that a header can name.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Name {
    Time,
    X,
    Y,
    Speed,
    SpeedNormal,
    Force,
    Pressure,
    Touching,
}

impl Columns {
    /// Assigns the columns that a header names.
    pub(super) fn from_header(header: &csv::StringRecord) -> Result<Self, StrokeCsvError> {
        let mut names = Vec::new();
        for field in header {
            let (name, unit) = name_of(field).ok_or_else(|| StrokeCsvError::Header {
                problem: format!("the column \"{}\" is unknown", field.chars().take(40).collect::<String>()),
            })?;
            names.push((name, unit));
        }
        let place = |name: Name| names.iter().position(|(n, _)| *n == name);
        let needed = |name: Name, word: &str| {
            place(name)
                .ok_or_else(|| StrokeCsvError::Header { problem: format!("there is no column for {word}") })
        };
        let time = needed(Name::Time, "time")?;
        let (kind, values) = if let Some(speed) = place(Name::Speed) {
            (Kind::Contacts, vec![speed, needed(Name::Force, "force")?])
        } else {
            let (x, y) = (needed(Name::X, "speed or x")?, needed(Name::Y, "y")?);
            match place(Name::Force) {
                Some(force) => (Kind::Pen(PressUnit::Newtons), vec![x, y, force]),
                None => (
                    Kind::Pen(PressUnit::FullScale),
                    vec![x, y, needed(Name::Pressure, "force or pressure")?],
                ),
            }
        };
        let (touching, speed_normal) = (place(Name::Touching), place(Name::SpeedNormal));
        // Without a unit, x and y may be axes of acceleration.
        let is_axis = |(field, (name, _)): (&str, &(Name, _))| {
            matches!(name, Name::X | Name::Y) && !field.to_lowercase().contains("mm")
        };
        let has_axes = header.iter().zip(&names).any(is_axis);
        Ok(Self {
            n: names.len(),
            kind,
            time,
            time_unit: names[time].1,
            touching,
            speed_normal,
            are_of_a_stroke_only: !has_axes
                || touching.is_some()
                || speed_normal.is_some()
                || place(Name::Pressure).is_some(),
            values,
        })
    }

    /// Assigns the columns of a table without a header.
    pub(super) fn by_count(n: usize) -> Result<Self, StrokeCsvError> {
        let (kind, values) = match n {
            3 => (Kind::Contacts, vec![1, 2]),
            4 => (Kind::Pen(PressUnit::Newtons), vec![1, 2, 3]),
            _ => {
                let problem = format!("a table of {n} columns needs a header");
                return Err(StrokeCsvError::Header { problem });
            }
        };
        Ok(Self {
            n,
            kind,
            time: 0,
            time_unit: None,
            touching: None,
            speed_normal: None,
            are_of_a_stroke_only: false,
            values,
        })
    }

    /// Names and indices of the values in a row, without its time.
    pub(super) fn named_values(&self) -> impl Iterator<Item = (&'static str, usize)> + '_ {
        let names: &[&'static str] = match self.kind {
            Kind::Contacts => &["speed", "force"],
            Kind::Pen(PressUnit::FullScale) => &["x", "y", "pressure"],
            Kind::Pen(PressUnit::Newtons) => &["x", "y", "force"],
        };
        names.iter().copied().zip(self.values.iter().copied())
    }

    /// Describes the columns of a table without a header.
    pub(super) fn in_words(&self) -> &'static str {
        match self.kind {
            Kind::Contacts => "time, speed in mm/s, force in N",
            Kind::Pen(_) => "time, x and y in mm, force in N",
        }
    }
}

/// Parses a column name such as `t`, `Time (ms)`, `x_mm`, `force_n` or `speed_normal`.
fn name_of(field: &str) -> Option<(Name, Option<TimeUnit>)> {
    let lower = field.to_lowercase();
    let words: Vec<&str> =
        lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let (name, units) = match words.as_slice() {
        ["t" | "time" | "timestamp", units @ ..] => (Name::Time, units),
        ["x", units @ ..] => (Name::X, units),
        ["y", units @ ..] => (Name::Y, units),
        ["v" | "speed" | "velocity", "normal", units @ ..] => (Name::SpeedNormal, units),
        ["v" | "speed" | "velocity", units @ ..] => (Name::Speed, units),
        ["f" | "force", units @ ..] => (Name::Force, units),
        ["p" | "pressure", units @ ..] => (Name::Pressure, units),
        ["touching" | "touch" | "tip" | "on", units @ ..] => (Name::Touching, units),
        _ => return None,
    };
    // An unsupported unit is rejected, because it would cause a silent scaling error.
    let unit = units.concat();
    match (name, unit.as_str()) {
        (Name::Time, "s" | "sec" | "secs" | "seconds") => Some((name, Some(TimeUnit::Seconds))),
        (Name::Time, "ms" | "msec" | "milliseconds") => Some((name, Some(TimeUnit::Milliseconds))),
        (Name::Touching, "surface")
        | (Name::X | Name::Y, "mm")
        | (Name::Speed | Name::SpeedNormal, "mms" | "mmpers")
        | (Name::Force, "n")
        | (_, "") => Some((name, None)),
        _ => None,
    }
}
