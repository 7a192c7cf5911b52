//! Assignment of the columns of a stroke table.

use crate::recording::{ForceUnit, PositionUnit, SpeedUnit, TimeUnit};
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

/// Indices of the columns in a row of `n`.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    pub(super) n: usize,
    pub(super) kind: Kind,
    pub(super) time: usize,
    /// One unit of time in seconds, if the header states it.
    pub(super) time_secs: Option<f64>,
    pub(super) touching: Option<usize>,
    /// Speed towards the surface.
    pub(super) speed_normal: Option<usize>,
    /// One unit of this speed in m/s, if the header states it, or the unit of speed or position.
    speed_normal_si: Option<f64>,
    /// Whether no acceleration recording has columns of these names.
    pub(super) are_of_a_stroke_only: bool,
    /// Indices of speed and force, or of x, y and pressure or force.
    values: Vec<usize>,
    /// One unit of each of these in the SI unit, if it is stated.
    units_si: Vec<Option<f64>>,
    has_header: bool,
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
        let has_axes = names.iter().any(|(name, unit)| matches!(name, Name::X | Name::Y) && unit.is_none());
        let units_si = values.iter().map(|index| names[*index].1).collect();
        // Both speeds of a table have the same unit, unless it states another one. With positions, it is theirs per second.
        let unit_of = |name: Name| place(name).and_then(|index| names[index].1);
        let [own, along, position] = [Name::SpeedNormal, Name::Speed, Name::X].map(unit_of);
        let speed_normal_si = own.or(along).or(position);
        Ok(Self {
            n: names.len(),
            kind,
            time,
            time_secs: names[time].1,
            touching,
            speed_normal,
            speed_normal_si,
            are_of_a_stroke_only: !has_axes
                || touching.is_some()
                || speed_normal.is_some()
                || place(Name::Pressure).is_some(),
            values,
            units_si,
            has_header: true,
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
            time_secs: None,
            touching: None,
            speed_normal: None,
            speed_normal_si: None,
            are_of_a_stroke_only: false,
            units_si: vec![None; values.len()],
            values,
            has_header: false,
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

    /// Names and units of the values, without pressure: the stated or assumed unit in SI units, its assumed name, and
    /// whether it is assumed.
    fn units(&self) -> impl Iterator<Item = (&'static str, f64, &'static str, bool)> + '_ {
        let unit = |((name, _), stated): ((&'static str, usize), &Option<f64>)| {
            let (usual_si, usual) = match name {
                "speed" => (USUAL_SPEED.si(), USUAL_SPEED.name()),
                "force" => (USUAL_FORCE.si(), USUAL_FORCE.name()),
                "pressure" => return None,
                _ => (USUAL_POSITION.si(), USUAL_POSITION.name()),
            };
            Some((name, stated.unwrap_or(usual_si), usual, stated.is_none()))
        };
        self.named_values().zip(&self.units_si).filter_map(unit)
    }

    /// Returns one unit of each value in a row in the SI unit; 1 for pressure.
    pub(super) fn values_si(&self) -> [f64; 3] {
        let mut si = [1.0; 3];
        for (si, (_, unit_si, _, _)) in si.iter_mut().zip(self.units()) {
            *si = unit_si;
        }
        si
    }

    /// One unit of the speed towards the surface, in m/s.
    pub(super) fn speed_normal_mps(&self) -> f64 {
        self.speed_normal_si.unwrap_or(USUAL_SPEED.si())
    }

    /// Whether the unit of speed is assumed.
    pub(super) fn speed_is_assumed(&self) -> bool {
        self.units().any(|(name, _, _, is_assumed)| name == "speed" && is_assumed)
    }

    /// Returns a warning that names the units which the header does not state; `None` if it states all, or if there is no
    /// header, whose columns are then described with their units.
    pub(super) fn assumed_units(&self) -> Option<String> {
        let mut assumed: Vec<String> = self
            .units()
            .filter(|(_, _, _, is_assumed)| self.has_header && *is_assumed)
            .map(|(name, _, unit, _)| format!("{name} in {unit}"))
            .collect();
        if self.speed_normal.is_some() && self.speed_normal_si.is_none() {
            assumed.push(format!("speed_normal in {}", USUAL_SPEED.name()));
        }
        let as_in = if self.kind == Kind::Contacts {
            "speed_mm/s or speed_m/s, force_N"
        } else {
            "x_mm, y_mm, force_N"
        };
        (!assumed.is_empty()).then(|| {
            format!(
                "the header does not state all units; these are assumed: {} (name the columns as in {as_in})",
                assumed.join(", ")
            )
        })
    }

    /// Describes the columns of a table without a header.
    pub(super) fn in_words(&self) -> &'static str {
        match self.kind {
            Kind::Contacts => "time, speed in mm/s, force in N",
            Kind::Pen(_) => "time, x and y in mm, force in N",
        }
    }
}

/// Units of columns whose name states none.
const USUAL_SPEED: SpeedUnit = SpeedUnit::MillimetersPerSecond;
const USUAL_POSITION: PositionUnit = PositionUnit::Millimeters;
const USUAL_FORCE: ForceUnit = ForceUnit::Newtons;

/// Parses a column name such as `t`, `Time (ms)`, `x_mm`, `force_n`, `speed_m/s` or `speed_normal`: its quantity, and one
/// unit in the SI unit if it is stated.
fn name_of(field: &str) -> Option<(Name, Option<f64>)> {
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
    if unit.is_empty() || (name == Name::Touching && unit == "surface") {
        return Some((name, None));
    }
    let si = match name {
        Name::Time => TimeUnit::parse(&unit).map(TimeUnit::si),
        Name::X | Name::Y => PositionUnit::parse(&unit).map(PositionUnit::si),
        Name::Speed | Name::SpeedNormal => SpeedUnit::parse(&unit).map(SpeedUnit::si),
        Name::Force => ForceUnit::parse(&unit).map(ForceUnit::si),
        Name::Pressure | Name::Touching => None,
    };
    Some((name, Some(si?)))
}
