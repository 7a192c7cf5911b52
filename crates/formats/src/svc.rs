//! Pen recordings of the kind used for handwriting: `*.svc`.
//!
//! The first line is the number of samples; each further line is `x y time on-surface azimuth altitude pressure`, parted
//! by white space. The file does not state its units. Two flavors are told apart by their content: *raw* files hold
//! whole numbers (counts of the tablet, ticks of its clock), *normalized* ones fractions (mm, s, 0..1). What is assumed
//! is a [`PenMapping`], which can be changed and says itself in words.

use std::fmt;

use crate::imported::Imported;
use crate::stroke::PenSample;

/// Samples of a pen in the numbers of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct PenRecording {
    /// What the numbers look like.
    pub flavor: PenFlavor,
    rows: Vec<Row>,
}

/// What the numbers of a file look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenFlavor {
    /// Whole numbers: counts, ticks.
    Raw,
    /// Fractions: mm, s, pressure 0..1.
    Normalized,
}

/// What the numbers of a file mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenMapping {
    /// Length of one unit of x and y, in mm.
    pub mm_per_unit: f64,
    /// Length of one unit of time, in s.
    pub secs_per_unit: f64,
    /// The number that stands for full pressure.
    pub pressure_full_scale: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    line: usize,
    x: f64,
    y: f64,
    time: f64,
    touching: bool,
    pressure: f64,
}

/// Why bytes are no pen recording, or its numbers have no meaning.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SvcError {
    /// The first line is not a count.
    #[error(
        "the first line must be the number of samples, got \"{found}\"; check that this is a pen recording (.svc)"
    )]
    Count {
        /// What stands there.
        found: String,
    },
    /// Samples are missing.
    #[error(
        "the recording is damaged: line 1 announces {announced} samples, {found} are there; get a complete copy"
    )]
    Missing {
        /// The count in the first line.
        announced: usize,
        /// The samples found.
        found: usize,
    },
    /// A line has too few or too many values.
    #[error(
        "line {line} has {found} values, needs 7: x y time on-surface azimuth altitude pressure; get a complete copy or correct the line"
    )]
    Columns {
        /// The line, from one.
        line: usize,
        /// The values found.
        found: usize,
    },
    /// A value is not a finite number.
    #[error("{column} in line {line} is \"{found}\", not a finite number; correct the line")]
    Number {
        /// The line, from one.
        line: usize,
        /// The column.
        column: &'static str,
        /// What stands there.
        found: String,
    },
    /// Time goes back.
    #[error("time goes back in line {line}, from {before} to {time}; put the lines in the order of time")]
    TimeGoesBack {
        /// The line, from one.
        line: usize,
        /// Time of the line ahead.
        before: f64,
        /// Time of this line.
        time: f64,
    },
    /// A pressure is below zero or above the full scale.
    #[error(
        "pressure in line {line} is {pressure}, outside 0 to the full scale of {full_scale}; state the pen's full scale"
    )]
    Pressure {
        /// The line, from one.
        line: usize,
        /// The pressure.
        pressure: f64,
        /// The full scale assumed or given.
        full_scale: f64,
    },
    /// A mapping is not usable.
    #[error("{what} is {value}; it must be a positive number")]
    Mapping {
        /// Which part.
        what: &'static str,
        /// Its value.
        value: f64,
    },
}

impl PenMapping {
    /// What raw files are taken to mean: 5080 lines per inch, milliseconds, 15 bits of pressure. No raw file states it.
    pub const RAW: Self = Self { mm_per_unit: 0.005, secs_per_unit: 0.001, pressure_full_scale: 32_767.0 };
    /// What normalized files are taken to mean: mm, s, 0..1.
    pub const NORMALIZED: Self = Self { mm_per_unit: 1.0, secs_per_unit: 1.0, pressure_full_scale: 1.0 };

    /// What files of this flavor are taken to mean.
    pub fn of(flavor: PenFlavor) -> Self {
        match flavor {
            PenFlavor::Raw => Self::RAW,
            PenFlavor::Normalized => Self::NORMALIZED,
        }
    }
}

impl fmt::Display for PenMapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mm_per_unit, secs_per_unit, pressure_full_scale } = self;
        write!(f, "{mm_per_unit} mm and {secs_per_unit} s per unit, full pressure at {pressure_full_scale}")
    }
}

impl fmt::Display for PenFlavor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Raw => "raw counts (whole numbers)",
            Self::Normalized => "normalized values (fractions)",
        })
    }
}

impl PenRecording {
    /// Number of samples, at least one.
    pub fn n_samples(&self) -> usize {
        self.rows.len()
    }

    /// Highest pressure, in the file's numbers.
    pub fn pressure_max(&self) -> f64 {
        self.rows.iter().map(|row| row.pressure).fold(0.0, f64::max)
    }
}

/// Reads a recording.
///
/// More samples than the first line announces are used, with a warning.
///
/// # Errors
/// See [`SvcError`].
pub fn read_svc(bytes: &[u8]) -> Result<Imported<PenRecording>, SvcError> {
    // What is not UTF-8 is no number either, and is refused as such.
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let first = lines.next().map_or("", |(_, line)| line.trim());
    let announced: usize = first.parse().map_err(|_| SvcError::Count { found: short(first) })?;
    // Room that the text can fill, whatever its first line says.
    let mut rows = Vec::with_capacity(announced.min(text.len() / SHORTEST_ROW_BYTES));
    for (index, line) in lines {
        rows.push(parse_row(index + 1, line)?);
    }
    if rows.is_empty() || rows.len() < announced {
        return Err(SvcError::Missing { announced, found: rows.len() });
    }
    for pair in rows.windows(2) {
        if pair[1].time < pair[0].time {
            return Err(SvcError::TimeGoesBack {
                line: pair[1].line,
                before: pair[0].time,
                time: pair[1].time,
            });
        }
    }
    let mut warnings = Vec::new();
    if rows.len() > announced {
        warnings.push(format!(
            "the recording has {} samples although its first line announces {announced}; all are used",
            rows.len()
        ));
    }
    let is_whole = |row: &Row| [row.x, row.y, row.time, row.pressure].iter().all(|v| v.fract() == 0.0);
    let flavor = if rows.iter().all(is_whole) { PenFlavor::Raw } else { PenFlavor::Normalized };
    Ok(Imported { value: PenRecording { flavor, rows }, warnings })
}

/// The samples of a recording in SI units, its first sample at time zero.
///
/// A highest pressure far below the full scale is usable, and warned of: the pen may well have fewer levels.
///
/// # Errors
/// [`SvcError::Mapping`], and [`SvcError::Pressure`] for the first sample that does not fit the full scale.
pub fn pen_samples(
    recording: &PenRecording,
    mapping: &PenMapping,
) -> Result<Imported<Vec<PenSample>>, SvcError> {
    let PenMapping { mm_per_unit, secs_per_unit, pressure_full_scale: full_scale } = *mapping;
    let parts = [
        ("the length of a unit in mm", mm_per_unit),
        ("the length of a unit of time in s", secs_per_unit),
        ("the full scale of pressure", full_scale),
    ];
    for (what, value) in parts {
        if !(value.is_finite() && value > 0.0) {
            return Err(SvcError::Mapping { what, value });
        }
    }
    if let Some(row) = recording.rows.iter().find(|row| !(0.0..=full_scale).contains(&row.pressure)) {
        return Err(SvcError::Pressure { line: row.line, pressure: row.pressure, full_scale });
    }
    let start = recording.rows.first().map_or(0.0, |row| row.time);
    let sample = |row: &Row| PenSample {
        time_secs: (row.time - start) * secs_per_unit,
        x_m: 1e-3 * row.x * mm_per_unit,
        y_m: 1e-3 * row.y * mm_per_unit,
        press: row.pressure / full_scale,
        touching: row.touching,
    };
    let mut warnings = Vec::new();
    let highest = recording.pressure_max();
    if highest > 0.0 && highest < 0.25 * full_scale {
        warnings.push(format!(
            "the highest pressure is {highest} of a full scale of {full_scale}; if the pen has fewer levels, state its full scale"
        ));
    }
    Ok(Imported { value: recording.rows.iter().map(sample).collect(), warnings })
}

/// Seven digits, each with what parts it from the next.
const SHORTEST_ROW_BYTES: usize = 14;

fn parse_row(line: usize, text: &str) -> Result<Row, SvcError> {
    const COLUMNS: [&str; 7] = ["x", "y", "time", "on-surface", "azimuth", "altitude", "pressure"];
    let words = text.split_whitespace();
    let found = words.clone().count();
    if found != COLUMNS.len() {
        return Err(SvcError::Columns { line, found });
    }
    let mut values = [0.0; COLUMNS.len()];
    for ((value, text), column) in values.iter_mut().zip(words).zip(COLUMNS) {
        *value = match text.parse::<f64>() {
            Ok(number) if number.is_finite() => number,
            _ => return Err(SvcError::Number { line, column, found: short(text) }),
        };
    }
    let [x, y, time, on_surface, _, _, pressure] = values;
    Ok(Row { line, x, y, time, touching: on_surface != 0.0, pressure })
}

/// Text for a message, cut off where it is long.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests;
