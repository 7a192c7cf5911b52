//! From a table to columns in SI units, by a map and by what can be told from names and numbers.

use shagreen_core::recording::{Fault, RawClock, RawMotion, RawRecording, RawTrack, check_clock};
use shagreen_core::spectrum::median;
use shagreen_core::units::Hertz;

use crate::recording::column_map::{Column, ColumnMap};
use crate::recording::inquiry::Inquiry;
use crate::recording::names::{Meaning, meaning_of};
use crate::recording::question::Ask;
use crate::recording::table::Table;
use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};
use crate::recording::{RecordingFile, RecordingFileError};

/// Rates that a recording can have, in Hz, where only the unit of time decides.
const LIKELY_RATES_HZ: [f64; 2] = [20.0, 48_500.0];
/// How near to gravity the mean vector is, and how much smaller what moves is, where gravity tells the unit.
const GRAVITY_SHARE: f64 = 0.06;
const MOVING_SHARE: f64 = 0.5;
/// Speeds of hands: none is above this in m/s, and a stroke is not below this in mm/s.
const FASTEST_MPS: f64 = 2.0;
/// No stylus is pressed harder, in N.
const STRONGEST_N: f64 = 50.0;

/// Reads the recording out of a table.
pub(super) fn recording_of_table(table: Table, map: &ColumnMap) -> Result<RecordingFile, RecordingFileError> {
    let meanings: Vec<Option<Meaning>> =
        table.names.iter().map(|name| if table.header { meaning_of(name) } else { None }).collect();
    let mut reading = Reading { inquiry: Inquiry::new(map.clone()), table, meanings, used: Vec::new() };
    reading.inquiry.warnings.append(&mut reading.table.warnings);
    let clock = reading.clock()?;
    let faults: Vec<Fault> = clock.as_ref().map_or_else(Vec::new, |clock| check_clock(clock).1);
    let axes = reading.acceleration_columns()?;
    if reading.table.header && axes.as_ref().is_some_and(Vec::is_empty) {
        return Err(RecordingFileError::NoAcceleration { columns: reading.table.names, faults });
    }
    let positions = reading.position_columns()?;
    let acceleration = axes.map(|axes| reading.acceleration(&axes));
    let motion = reading.motion(&positions)?;
    let force_n = reading.force()?;
    let full_scale = reading.inquiry.map.full_scale;
    reading.name_unused();
    let Reading { mut inquiry, table, .. } = reading;
    inquiry.map.separator = Some(table.separator);
    inquiry.map.decimal_comma = Some(table.decimal_comma);
    inquiry.map.header = Some(table.header);
    let unit = inquiry.map.acceleration_unit.map(AccelerationUnit::si);
    let full_scale_mps2 = full_scale.zip(unit).map(|(scale, si)| scale * si);
    let raw = clock.zip(acceleration).map(|(clock, acceleration_mps2)| RawRecording {
        clock,
        acceleration_mps2,
        motion,
        force_n,
        full_scale_mps2,
    });
    inquiry.close(raw, faults)
}

struct Reading {
    inquiry: Inquiry,
    table: Table,
    meanings: Vec<Option<Meaning>>,
    /// Columns that were taken for something.
    used: Vec<usize>,
}

impl Reading {
    /// The place of a column that a map names.
    fn place(&self, column: &Column) -> Result<usize, RecordingFileError> {
        let names = &self.table.names;
        let found = match column {
            Column::Number(number) => number.checked_sub(1).filter(|place| *place < names.len()),
            Column::Name(name) => {
                let bare = |text: &str| text.split(['[', '(']).next().unwrap_or("").trim().to_lowercase();
                let same = |other: &&String| other.to_lowercase() == name.to_lowercase();
                names
                    .iter()
                    .position(|other| same(&other))
                    .or_else(|| names.iter().position(|other| bare(other) == name.to_lowercase()))
            }
        };
        found.ok_or_else(|| {
            let names = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
            RecordingFileError::Map { problem: format!("there is no column {column}; there are {names}") }
        })
    }

    fn places(&self, columns: &[Column]) -> Result<Vec<usize>, RecordingFileError> {
        columns.iter().map(|column| self.place(column)).collect()
    }

    /// Columns of a meaning, in the order of the file.
    fn meant(&self, is: impl Fn(Meaning) -> bool) -> Vec<usize> {
        let meanings = self.meanings.iter().enumerate();
        meanings.filter(|(_, meaning)| meaning.is_some_and(&is)).map(|(place, _)| place).collect()
    }

    fn column(&self, place: usize) -> Column {
        if self.table.header && !self.table.names[place].is_empty() {
            Column::Name(self.table.names[place].clone())
        } else {
            Column::Number(place + 1)
        }
    }

    fn name(&self, places: &[usize]) -> String {
        places.iter().map(|place| self.table.names[*place].as_str()).collect::<Vec<_>>().join(", ")
    }

    /// Takes the values of a column, in the SI unit.
    fn take(&mut self, place: usize, si: f64) -> Vec<f64> {
        self.used.push(place);
        let cells = self.table.not_numbers[place];
        if cells.n > 0 {
            let name = &self.table.names[place];
            self.inquiry.warnings.push(format!(
                "{} cells of {name:?} are not numbers, the first in line {}; they count as missing",
                cells.n, cells.first_line
            ));
        }
        self.table.columns[place].iter().map(|value| value * si).collect()
    }

    fn clock(&mut self) -> Result<Option<RawClock>, RecordingFileError> {
        let named = self.inquiry.map.time.clone().map(|column| self.place(&column)).transpose()?;
        if let (Some(rate_hz), None) = (self.inquiry.map.rate_hz, named) {
            let time = self.meant(|meaning| matches!(meaning, Meaning::Time(_)));
            if let Some(place) = time.first() {
                let name = &self.table.names[*place];
                self.inquiry.warnings.push(format!("{name:?} is not used, since the rate was stated"));
                self.used.push(*place);
            }
            return Ok(Some(RawClock::Rate(Hertz(rate_hz))));
        }
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Time(_)));
        let Some(place) = named.or(meant.first().copied()) else {
            if !self.table.header && self.table.names.len() > 1 && goes_on(&self.table.columns[0]) {
                let text = "which column is time is not stated; column 1 goes on evenly".to_owned();
                if self.inquiry.guess(Ask::Time, "1", &[], text) {
                    return Ok(Some(self.times(0)));
                }
            }
            let text = "there is no time column, and the rate is not stated; give the rate in Hz".to_owned();
            self.inquiry.ask(Ask::RateHz, &[], text);
            return Ok(None);
        };
        self.inquiry.map.time = Some(self.column(place));
        Ok(Some(self.times(place)))
    }

    fn times(&mut self, place: usize) -> RawClock {
        let by_name = match self.meanings[place] {
            Some(Meaning::Time(unit)) => unit,
            _ => None,
        };
        if self.inquiry.map.time_unit.is_none() {
            self.inquiry.map.time_unit = by_name;
        }
        let names: Vec<&str> = TimeUnit::ALL.iter().map(|unit| unit.name()).collect();
        if self.inquiry.map.time_unit.is_none() {
            let name = self.name(&[place]);
            let text = format!("the unit of {name} is not stated");
            match likely_time_unit(&self.table.columns[place]) {
                Some((unit, why)) => {
                    self.inquiry.guess(Ask::TimeUnit, unit.name(), &names, format!("{text}; {why}"));
                }
                None => self.inquiry.ask(Ask::TimeUnit, &names, text),
            }
        }
        let si = self.inquiry.map.time_unit.map_or(1.0, TimeUnit::si);
        let start = self.table.columns[place].iter().copied().find(|time| time.is_finite()).unwrap_or(0.0);
        // Taken from the start, times of an epoch keep their digits.
        self.used.push(place);
        RawClock::Times(self.table.columns[place].iter().map(|time| (time - start) * si).collect())
    }

    /// The columns of acceleration; none where that is asked, no column where there cannot be one.
    fn acceleration_columns(&mut self) -> Result<Option<Vec<usize>>, RecordingFileError> {
        if let Some(columns) = self.inquiry.map.acceleration.clone() {
            if !(1..=3).contains(&columns.len()) {
                let problem = format!("acceleration has one to three columns, not {}", columns.len());
                return Err(RecordingFileError::Map { problem });
            }
            return self.places(&columns).map(Some);
        }
        let taken = |reading: &mut Self, places: Vec<usize>| {
            let columns = places.iter().map(|place| reading.column(*place)).collect();
            reading.inquiry.map.acceleration = Some(columns);
            Ok(Some(places))
        };
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Acceleration(_)));
        let choices: Vec<String> = self.free_columns();
        let choices: Vec<&str> = choices.iter().map(String::as_str).collect();
        if meant.len() > 3 {
            let text = format!("{} may all be acceleration; name one to three of them", self.name(&meant));
            self.inquiry.ask(Ask::Acceleration, &choices, text);
            return Ok(None);
        }
        if !meant.is_empty() {
            return taken(self, meant);
        }
        let axes = self.meant(|meaning| meaning == Meaning::Axis);
        let has_speed = self.inquiry.map.speed.is_some()
            || self.inquiry.map.constant_speed.is_some()
            || !self.meant(|meaning| matches!(meaning, Meaning::Speed(_) | Meaning::Position(_))).is_empty();
        if !axes.is_empty() && self.inquiry.map.positions.is_none() {
            let name = self.name(&axes);
            let text = format!("{name} may be positions or accelerations");
            if has_speed {
                let text = format!("{text}; since the motion is in other columns they are accelerations");
                let columns = axes.iter().map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(",");
                self.inquiry.guess(Ask::Acceleration, &columns, &choices, text);
                return taken(self, axes);
            }
            self.inquiry.ask(Ask::Acceleration, &choices, text);
            return Ok(None);
        }
        if self.table.header {
            return Ok(Some(Vec::new()));
        }
        let text = "the columns have no names; say which are acceleration, by their places from 1".to_owned();
        self.inquiry.ask(Ask::Acceleration, &choices, text);
        Ok(None)
    }

    /// What a column that is not taken yet may be called in an answer.
    fn free_columns(&self) -> Vec<String> {
        (0..self.table.names.len())
            .filter(|place| !self.used.contains(place))
            .map(|place| match self.column(place) {
                Column::Name(name) => name,
                Column::Number(number) => number.to_string(),
            })
            .collect()
    }

    fn acceleration(&mut self, places: &[usize]) -> Vec<Vec<f64>> {
        if self.inquiry.map.acceleration_unit.is_none() {
            let mut units = places.iter().map(|place| match self.meanings[*place] {
                Some(Meaning::Acceleration(unit)) => unit,
                _ => None,
            });
            let first = units.next().flatten();
            self.inquiry.map.acceleration_unit = first.filter(|first| units.all(|unit| unit == Some(*first)));
        }
        if self.inquiry.map.acceleration_unit.is_none() {
            let names: Vec<&str> = AccelerationUnit::ALL.iter().map(|unit| unit.name()).collect();
            let text = format!("the unit of {} is not stated", self.name(places));
            let columns: Vec<&[f64]> =
                places.iter().map(|place| self.table.columns[*place].as_slice()).collect();
            match unit_by_gravity(&columns, self.inquiry.map.per_count.unwrap_or(1.0)) {
                Some((unit, length)) => {
                    let text = format!("{text}; the mean vector is {length:.3} long, as gravity is");
                    self.inquiry.guess(Ask::AccelerationUnit, unit.name(), &names, text);
                }
                None => self.inquiry.ask(Ask::AccelerationUnit, &names, text),
            }
        }
        let unit = self.inquiry.map.acceleration_unit.map_or(1.0, AccelerationUnit::si);
        let si = unit * self.inquiry.map.per_count.unwrap_or(1.0);
        places.iter().map(|place| self.take(*place, si)).collect()
    }

    fn position_columns(&mut self) -> Result<Vec<usize>, RecordingFileError> {
        if let Some(columns) = self.inquiry.map.positions.clone() {
            return self.places(&columns);
        }
        let has_speed = self.inquiry.map.speed.is_some()
            || self.inquiry.map.constant_speed.is_some()
            || !self.meant(|meaning| matches!(meaning, Meaning::Speed(_))).is_empty();
        if has_speed {
            return Ok(Vec::new());
        }
        let mut meant = self.meant(|meaning| matches!(meaning, Meaning::Position(_)));
        let axes = self.meant(|meaning| meaning == Meaning::Axis);
        let in_acceleration = self.inquiry.map.acceleration.clone().unwrap_or_default();
        let is_free = |place: &usize| !in_acceleration.contains(&self.column(*place));
        if meant.is_empty() && !in_acceleration.is_empty() && axes.iter().all(is_free) && !axes.is_empty() {
            let name = self.name(&axes);
            let text = format!("{name} are taken for positions, since acceleration is in other columns");
            let columns = axes.iter().map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(",");
            self.inquiry.guess(Ask::Positions, &columns, &[], text);
            meant = axes;
        }
        meant.truncate(3);
        if !meant.is_empty() {
            self.inquiry.map.positions = Some(meant.iter().map(|place| self.column(*place)).collect());
        }
        Ok(meant)
    }

    fn motion(&mut self, positions: &[usize]) -> Result<RawMotion, RecordingFileError> {
        if let Some(speed) = self.inquiry.map.constant_speed {
            return Ok(RawMotion::Speed(RawTrack::Constant(speed.0)));
        }
        let named = self.inquiry.map.speed.clone().map(|column| self.place(&column)).transpose()?;
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Speed(_)));
        if named.is_none() && !positions.is_empty() {
            let by_name = positions.iter().find_map(|place| match self.meanings[*place] {
                Some(Meaning::Position(unit)) => unit,
                _ => None,
            });
            if self.inquiry.map.position_unit.is_none() {
                self.inquiry.map.position_unit = by_name;
            }
            if self.inquiry.map.position_unit.is_none() {
                let names: Vec<&str> = PositionUnit::ALL.iter().map(|unit| unit.name()).collect();
                let text = format!("the unit of {} is not stated", self.name(positions));
                self.inquiry.ask(Ask::PositionUnit, &names, text);
            }
            let si = self.inquiry.map.position_unit.map_or(1.0, PositionUnit::si);
            return Ok(RawMotion::Positions(positions.iter().map(|place| self.take(*place, si)).collect()));
        }
        let Some(place) = named.or(meant.first().copied()) else {
            let text = "the file has neither speed nor positions; name a column, or say the constant speed, such as \"100 mm/s\"";
            self.inquiry.ask(Ask::Speed, &[], text.to_owned());
            return Ok(RawMotion::Speed(RawTrack::Missing));
        };
        self.inquiry.map.speed = Some(self.column(place));
        if let (None, Some(Meaning::Speed(unit))) = (self.inquiry.map.speed_unit, self.meanings[place]) {
            self.inquiry.map.speed_unit = unit;
        }
        if self.inquiry.map.speed_unit.is_none() {
            let names: Vec<&str> = SpeedUnit::ALL.iter().map(|unit| unit.name()).collect();
            let most = largest(&self.table.columns[place]);
            let text = format!("the unit of {} is not stated; it goes up to {most:.3}", self.name(&[place]));
            if most > 10.0 * FASTEST_MPS {
                let text = format!("{text}, faster than hands in m/s");
                self.inquiry.guess(Ask::SpeedUnit, SpeedUnit::MillimetersPerSecond.name(), &names, text);
            } else if most > 0.0 && most <= 0.5 * FASTEST_MPS {
                let text = format!("{text}, slower than any stroke in mm/s");
                self.inquiry.guess(Ask::SpeedUnit, SpeedUnit::MetersPerSecond.name(), &names, text);
            } else {
                self.inquiry.ask(Ask::SpeedUnit, &names, text);
            }
        }
        let si = self.inquiry.map.speed_unit.map_or(1.0, SpeedUnit::si);
        Ok(RawMotion::Speed(RawTrack::Column(self.take(place, si))))
    }

    fn force(&mut self) -> Result<RawTrack, RecordingFileError> {
        if let Some(force) = self.inquiry.map.constant_force {
            return Ok(RawTrack::Constant(force.0));
        }
        let named = self.inquiry.map.force.clone().map(|column| self.place(&column)).transpose()?;
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Force(_)));
        let along_z = self.meant(|meaning| matches!(meaning, Meaning::ForceZ(_)));
        let Some(place) = named.or(meant.first().copied()).or(along_z.first().copied()) else {
            let text =
                "the file has no normal force; name a column, or say the constant force, such as \"1 N\"";
            self.inquiry.ask(Ask::Force, &[], text.to_owned());
            return Ok(RawTrack::Missing);
        };
        if named.is_none() && meant.is_empty() {
            let text = format!("{} is taken for the normal force", self.name(&[place]));
            self.inquiry.guess(Ask::Force, &(place + 1).to_string(), &[], text);
        }
        self.inquiry.map.force = Some(self.column(place));
        if let (None, Some(Meaning::Force(unit) | Meaning::ForceZ(unit))) =
            (self.inquiry.map.force_unit, self.meanings[place])
        {
            self.inquiry.map.force_unit = unit;
        }
        let most = largest(&self.table.columns[place]);
        if self.inquiry.map.force_unit.is_none() {
            let names: Vec<&str> = ForceUnit::ALL.iter().map(|unit| unit.name()).collect();
            let text = format!("the unit of {} is not stated; it goes up to {most:.3}", self.name(&[place]));
            if most <= STRONGEST_N {
                self.inquiry.guess(Ask::ForceUnit, ForceUnit::Newtons.name(), &names, text);
            } else {
                self.inquiry.ask(Ask::ForceUnit, &names, format!("{text}, more than a stylus bears in N"));
            }
        }
        let si = self.inquiry.map.force_unit.map_or(1.0, ForceUnit::si);
        let column = &self.table.columns[place];
        if self.inquiry.map.pressing_is_negative.is_none() && median_of(column) < -0.01 * most {
            let text =
                format!("{} is below 0 most of the time, so pressing is negative", self.name(&[place]));
            self.inquiry.guess(Ask::PressingIsNegative, "yes", &["yes", "no"], text);
        }
        let sign = if self.inquiry.map.pressing_is_negative == Some(true) { -1.0 } else { 1.0 };
        Ok(RawTrack::Column(self.take(place, sign * si)))
    }

    fn name_unused(&mut self) {
        let unused: Vec<usize> =
            (0..self.table.names.len()).filter(|place| !self.used.contains(place)).collect();
        if !unused.is_empty() {
            let names: Vec<String> =
                unused.iter().map(|place| format!("{:?}", self.table.names[*place])).collect();
            self.inquiry.warnings.push(format!("not used: {}", names.join(", ")));
        }
    }
}

/// Largest magnitude of the numbers.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()))
}

fn median_of(values: &[f64]) -> f64 {
    median(values.iter().copied().filter(|value| value.is_finite()).collect())
}

/// Whether a column of numbers only goes up.
fn goes_on(values: &[f64]) -> bool {
    values.len() > 2 && values.windows(2).all(|pair| pair[1] > pair[0])
}

/// The unit of times that gives a rate that recordings have, and why, where there is only one.
fn likely_time_unit(times: &[f64]) -> Option<(TimeUnit, String)> {
    let first = times.iter().copied().find(|time| time.is_finite())?;
    // Seconds since 1970 of the years 2001 to 2065.
    let epoch = TimeUnit::ALL.iter().find(|unit| (1e9..3e9).contains(&(first * unit.si())));
    if let Some(unit) = epoch {
        return Some((*unit, format!("{first} is a date, counted in {}", unit.name())));
    }
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0 && step.is_finite());
    let step = median(steps.collect());
    let [low, high] = LIKELY_RATES_HZ;
    let rate_hz = |unit: &TimeUnit| 1.0 / (step * unit.si());
    let mut units = TimeUnit::ALL.iter().filter(|unit| (low..high).contains(&rate_hz(unit)));
    let unit = *units.next()?;
    if units.next().is_some() {
        return None;
    }
    Some((
        unit,
        format!("the middle step is {step:.6}, which is {:.1} Hz in {}", rate_hz(&unit), unit.name()),
    ))
}

/// The unit in which the mean of three axes is as long as gravity while the rest is small, and that length.
fn unit_by_gravity(axes: &[&[f64]], scale: f64) -> Option<(AccelerationUnit, f64)> {
    let [x, y, z] = axes else { return None };
    let moments = |axis: &[f64]| {
        let (n, sum, squares) = axis
            .iter()
            .filter(|value| value.is_finite())
            .fold((0.0, 0.0, 0.0), |(n, sum, squares), value| {
                (n + 1.0, sum + value * scale, squares + (value * scale).powi(2))
            });
        (sum / n, squares / n - (sum / n).powi(2))
    };
    let [x, y, z] = [moments(x), moments(y), moments(z)];
    let length = (x.0.powi(2) + y.0.powi(2) + z.0.powi(2)).sqrt();
    let moving = (x.1 + y.1 + z.1).max(0.0).sqrt();
    let gravity = AccelerationUnit::StandardGravity.si();
    let is_gravity = |unit: &&AccelerationUnit| (length * unit.si() / gravity - 1.0).abs() <= GRAVITY_SHARE;
    let unit = AccelerationUnit::ALL.iter().find(is_gravity)?;
    (moving <= MOVING_SHARE * length).then_some((*unit, length))
}
