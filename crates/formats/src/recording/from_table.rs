//! Conversion of a table to columns in SI units, by a column map and by names and numbers in the table.

mod axes;
mod envelope;
mod tracks;

use shagreen_core::recording::{Fault, RawClock, RawRecording, check_clock};
use shagreen_core::units::Hertz;

use crate::recording::column_map::{Column, ColumnMap};
use crate::recording::infer_units::{goes_on, likely_time_unit, other_time_unit, rate_of};
use crate::recording::map_builder::MapBuilder;
use crate::recording::names::{Meaning, meaning_of, time_unit_in};
use crate::recording::question::Ask;
use crate::recording::table::Table;
use crate::recording::units::{AccelerationUnit, TimeUnit};
use crate::recording::{RecordingFile, RecordingFileError};

/// Relative difference below which two sample rates count as equal, because clocks are inexact.
const SAME_RATE_SHARE: f64 = 0.01;

/// Maximum number of columns that a message names.
const MAX_NAMED: usize = 8;

/// Converts a table to a recording.
pub(super) fn recording_of_table(table: Table, map: &ColumnMap) -> Result<RecordingFile, RecordingFileError> {
    let meanings: Vec<Option<Meaning>> =
        table.names.iter().map(|name| if table.header { meaning_of(name) } else { None }).collect();
    let mut reading = Reading { inquiry: MapBuilder::new(map.clone()), table, meanings, used: Vec::new() };
    reading.inquiry.warnings.append(&mut reading.table.warnings);
    if let Some(columns) = reading.envelope_columns() {
        return reading.envelope(&columns);
    }
    let clock = reading.clock()?;
    let faults: Vec<Fault> = clock.as_ref().map_or_else(Vec::new, |clock| check_clock(clock).1);
    let axes = reading.acceleration_columns()?;
    if reading.table.header && axes.as_ref().is_some_and(Vec::is_empty) {
        return Err(RecordingFileError::NoAcceleration { columns: reading.table.names, faults });
    }
    let positions = reading.position_columns()?;
    let acceleration = axes.map(|axes| reading.acceleration(&axes)).transpose()?;
    let motion = reading.motion(&positions)?;
    let force_n = reading.force()?;
    let full_scale = reading.inquiry.map.full_scale;
    reading.name_unused();
    reading.state_dialect();
    let Reading { inquiry, .. } = reading;
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
    inquiry: MapBuilder,
    table: Table,
    meanings: Vec<Option<Meaning>>,
    /// Columns that have been assigned a quantity.
    used: Vec<usize>,
}

impl Reading {
    /// Index of the column that a map refers to.
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
            let missing = match column {
                Column::Name(_) => format!("column {column}"),
                Column::Number(_) => column.to_string(),
            };
            RecordingFileError::Map { problem: format!("there is no {missing}; the columns are {names}") }
        })
    }

    fn places(&self, columns: &[Column]) -> Result<Vec<usize>, RecordingFileError> {
        columns.iter().map(|column| self.place(column)).collect()
    }

    /// Columns with a meaning, in file order.
    fn meant(&self, is: impl Fn(Meaning) -> bool) -> Vec<usize> {
        let meanings = self.meanings.iter().enumerate();
        meanings.filter(|(_, meaning)| meaning.is_some_and(&is)).map(|(place, _)| place).collect()
    }

    /// The reference to a column in a map.
    fn column(&self, place: usize) -> Column {
        let name = &self.table.names[place];
        let named = Column::Name(name.clone());
        // If two columns have the same name, the name refers to the first.
        if self.table.header && !name.is_empty() && self.place(&named).is_ok_and(|found| found == place) {
            named
        } else {
            Column::Number(place + 1)
        }
    }

    fn name(&self, places: &[usize]) -> String {
        places.iter().map(|place| self.table.names[*place].as_str()).collect::<Vec<_>>().join(", ")
    }

    /// Moves the values of a column out of the table and converts them to SI units; a table may be large, and a column
    /// has one meaning.
    fn take(&mut self, place: usize, si: f64) -> Result<Vec<f64>, RecordingFileError> {
        self.used.push(place);
        let cells = self.table.not_numbers[place];
        let n_rows = self.table.columns[place].len();
        // Reading the file again with the resulting map must give the same outcome, so a guess counts as stated.
        if self.table.decimal_comma && 2 * cells.n > n_rows {
            let is_stated = self.inquiry.map.decimal_comma.is_some();
            let problem = format!(
                "{}, {} of {n_rows} cells of {:?} are not numbers, the first in line {}; {}, or state the separator",
                if is_stated { "with decimal_comma = true" } else { "with the guessed decimal commas" },
                cells.n,
                self.table.names[place],
                cells.first_line,
                if is_stated { "remove that setting" } else { "set decimal_comma = false" },
            );
            return Err(if is_stated {
                RecordingFileError::Map { problem }
            } else {
                RecordingFileError::Table { problem, line: None }
            });
        }
        if cells.n > 0 {
            let name = &self.table.names[place];
            self.inquiry.warnings.push(format!(
                "{} cells of {name:?} are not numbers, the first in line {}; they count as missing",
                cells.n, cells.first_line
            ));
        }
        let mut values = std::mem::take(&mut self.table.columns[place]);
        if values.is_empty() {
            let problem = format!("{} cannot hold two quantities; assign it to one", self.column(place));
            return Err(RecordingFileError::Map { problem });
        }
        for value in &mut values {
            *value *= si;
        }
        Ok(values)
    }

    fn clock(&mut self) -> Result<Option<RawClock>, RecordingFileError> {
        let named = self.inquiry.map.time.clone().map(|column| self.place(&column)).transpose()?;
        if let (Some(rate_hz), None) = (self.inquiry.map.rate_hz, named) {
            let time = self.meant(|meaning| matches!(meaning, Meaning::Time(_)));
            if let Some(place) = time.first() {
                let name = &self.table.names[*place];
                let unit = self.inquiry.map.time_unit.or(match self.meanings[*place] {
                    Some(Meaning::Time(unit)) => unit,
                    _ => None,
                });
                let by_times_hz = unit.map(|unit| rate_of(&self.table.columns[*place], unit.si()));
                let differs = by_times_hz.filter(|hz| (hz / rate_hz - 1.0).abs() > SAME_RATE_SHARE);
                let more =
                    differs.map(|hz| format!("; its times give {hz:.1} Hz, the column map {rate_hz} Hz"));
                let more = more.unwrap_or_default();
                self.inquiry
                    .warnings
                    .push(format!("{name:?} is not used, because the sample rate is stated{more}"));
                self.used.push(*place);
            }
            return Ok(Some(RawClock::Rate(Hertz(rate_hz))));
        }
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Time(_)));
        let Some(place) = named.or(meant.first().copied()) else {
            if !self.table.header && self.table.names.len() > 1 && goes_on(&self.table.columns[0]) {
                let text = "the time column is not stated; column 1 always increases".to_owned();
                if self.inquiry.guess(Ask::Time, "1", &[], text) {
                    return Ok(Some(self.times(0)));
                }
            }
            let text = format!(
                "there is no time column, and the sample rate is not stated; state it in Hz{}",
                self.other_columns()
            );
            self.inquiry.ask(Ask::RateHz, &[], text);
            return Ok(None);
        };
        self.inquiry.map.time = Some(self.column(place));
        Ok(Some(self.times(place)))
    }

    /// Second half of a sentence: the columns of unknown meaning, which may include the time; empty if there are none.
    fn other_columns(&self) -> String {
        let names = self.table.names.iter().zip(&self.meanings);
        let unknown: Vec<&String> = names
            .filter(|(name, meaning)| meaning.is_none() && !name.is_empty())
            .map(|(name, _)| name)
            .collect();
        let Some(first) = unknown.first().filter(|_| self.table.header) else { return String::new() };
        let all: Vec<String> = unknown.iter().take(MAX_NAMED).map(|name| format!("{name:?}")).collect();
        let more = if unknown.len() > MAX_NAMED { ", …" } else { "" };
        format!(
            ", or name the time column, as in time={first:?} (columns of unknown meaning: {}{more})",
            all.join(", ")
        )
    }

    fn times(&mut self, place: usize) -> RawClock {
        let by_name = match self.meanings[place] {
            Some(Meaning::Time(unit)) => unit,
            _ => time_unit_in(&self.table.names[place]),
        };
        let (name, stated) = (self.name(&[place]), self.inquiry.map.time_unit);
        self.inquiry.map.time_unit =
            self.inquiry
                .settle(&format!("the unit of {name}"), stated, by_name, |unit| unit.name().to_owned());
        let names: Vec<&str> = TimeUnit::ALL.iter().map(|unit| unit.name()).collect();
        if self.inquiry.map.time_unit.is_none() {
            let text = format!("the unit of {name} is not stated");
            match likely_time_unit(&self.table.columns[place]) {
                Some((unit, why)) => {
                    self.inquiry.guess(Ask::TimeUnit, unit.name(), &names, format!("{text}; {why}"));
                }
                None => self.inquiry.ask(Ask::TimeUnit, &names, text),
            }
        }
        if let Some(unit) = self.inquiry.map.time_unit {
            let hint = other_time_unit(&self.table.columns[place], unit);
            self.inquiry.warnings.extend(hint.map(|hint| format!("the times of {name} {hint}")));
        }
        let si = self.inquiry.map.time_unit.map_or(1.0, TimeUnit::si);
        let start = self.table.columns[place].iter().copied().find(|time| time.is_finite()).unwrap_or(0.0);
        // Times relative to the start keep their precision even if they count from 1970.
        self.used.push(place);
        RawClock::Times(self.table.columns[place].iter().map(|time| (time - start) * si).collect())
    }

    /// Completes the map with the dialect of the table.
    fn state_dialect(&mut self) {
        let Self { inquiry, table, .. } = self;
        inquiry.map.separator = Some(table.separator);
        inquiry.map.decimal_comma = Some(table.decimal_comma);
        inquiry.map.header = Some(table.header);
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
