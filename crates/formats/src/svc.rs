//! Pen recordings in the `*.svc` format of handwriting research.
//!
//! The first line is the number of samples. Each further line is `x y time on-surface azimuth altitude pressure`,
//! separated by white space. The file does not state its units. Its content distinguishes two variants: *raw* files
//! contain whole numbers (tablet counts, clock ticks), and *normalized* files contain fractions (mm, s, 0..1). A
//! [`PenMapping`] holds the assumed units; it can be changed and describes itself.

use std::fmt;

use crate::imported::Imported;
use crate::stroke::PenSample;

/// Pen samples in the numbers of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct PenRecording {
    /// Variant of the file.
    pub flavor: PenFlavor,
    rows: Vec<Row>,
}

/// Variant of a file, by its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenFlavor {
    /// Whole numbers: counts and ticks.
    Raw,
    /// Fractions: mm, s, pressure 0..1.
    Normalized,
}

/// Units of the numbers in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenMapping {
    /// Length of one unit of x and y, in mm.
    pub mm_per_unit: f64,
    /// Duration of one unit of time, in s.
    pub secs_per_unit: f64,
    /// The number for full pressure.
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

/// Why bytes are not a pen recording, or its numbers are invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SvcError {
    /// The first line is not a count.
    #[error(
        "the first line must be the number of samples, but is \"{found}\"; check that the file is a pen recording (.svc)"
    )]
    Count {
        /// Text of the line.
        found: String,
    },
    /// Samples are missing.
    #[error(
        "the recording is damaged: line 1 states {announced} samples, but the file has {found}; get a complete copy"
    )]
    Missing {
        /// Number of samples in the first line.
        announced: usize,
        /// Number of samples found.
        found: usize,
    },
    /// A line has the wrong number of values.
    #[error(
        "line {line} has {found} values, but needs 7: x y time on-surface azimuth altitude pressure; get a complete copy or correct the line"
    )]
    Columns {
        /// The line, from one.
        line: usize,
        /// Number of values found.
        found: usize,
    },
    /// A value is not a finite number.
    #[error("{column} in line {line} is \"{found}\", not a finite number; correct the line")]
    Number {
        /// The line, from one.
        line: usize,
        /// The column.
        column: &'static str,
        /// Text of the field.
        found: String,
    },
    /// Time decreases.
    #[error("time decreases in line {line}, from {before} to {time}; sort the lines by time")]
    TimeGoesBack {
        /// The line, from one.
        line: usize,
        /// Time of the previous line.
        before: f64,
        /// Time of this line.
        time: f64,
    },
    /// A pressure is negative or above full scale.
    #[error(
        "pressure in line {line} is {pressure}, outside the range from 0 to the full scale of {full_scale}; state the value of full pressure of the pen"
    )]
    Pressure {
        /// The line, from one.
        line: usize,
        /// The pressure.
        pressure: f64,
        /// The assumed or stated full scale.
        full_scale: f64,
    },
    /// A part of a mapping is invalid.
    #[error("{what} is {value}; change it to a positive number")]
    Mapping {
        /// The part.
        what: &'static str,
        /// The value.
        value: f64,
    },
}

impl PenMapping {
    /// Assumed units of raw files, which do not state them: 5080 lines per inch, milliseconds, 15 bits of pressure.
    pub const RAW: Self = Self { mm_per_unit: 0.005, secs_per_unit: 0.001, pressure_full_scale: 32_767.0 };
    /// Assumed units of normalized files: mm, s, 0..1.
    pub const NORMALIZED: Self = Self { mm_per_unit: 1.0, secs_per_unit: 1.0, pressure_full_scale: 1.0 };

    /// Assumed units of this variant.
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

    /// Highest pressure, in the numbers of the file.
    pub fn pressure_max(&self) -> f64 {
        self.rows.iter().map(|row| row.pressure).fold(0.0, f64::max)
    }
}

/// Reads a recording.
///
/// If the file has more samples than its first line states, all are used, with a warning.
///
/// # Errors
/// See [`SvcError`].
pub fn read_svc(bytes: &[u8]) -> Result<Imported<PenRecording>, SvcError> {
    // Text that is not UTF-8 is not a number either, and is rejected as such.
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let first = lines.next().map_or("", |(_, line)| line.trim());
    let announced: usize = first.parse().map_err(|_| SvcError::Count { found: short(first) })?;
    // The capacity is limited to what the text can hold, whatever the first line states.
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
            "the recording has {} samples although its first line states {announced}; all are used",
            rows.len()
        ));
    }
    let is_whole = |row: &Row| [row.x, row.y, row.time, row.pressure].iter().all(|v| v.fract() == 0.0);
    let flavor = if rows.iter().all(is_whole) { PenFlavor::Raw } else { PenFlavor::Normalized };
    Ok(Imported { value: PenRecording { flavor, rows }, warnings })
}

/// Converts a recording to samples in SI units, with its first sample at time zero.
///
/// A maximum pressure far below full scale raises a warning, because the pen may have fewer levels.
///
/// # Errors
/// [`SvcError::Mapping`], and [`SvcError::Pressure`] for the first sample outside the full scale.
pub fn pen_samples(
    recording: &PenRecording,
    mapping: &PenMapping,
) -> Result<Imported<Vec<PenSample>>, SvcError> {
    let PenMapping { mm_per_unit, secs_per_unit, pressure_full_scale: full_scale } = *mapping;
    let parts = [
        ("the length of one position unit in mm", mm_per_unit),
        ("the duration of one time unit in s", secs_per_unit),
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
        impact_mps: None,
    };
    let mut warnings = Vec::new();
    let highest = recording.pressure_max();
    if highest > 0.0 && highest < 0.25 * full_scale {
        warnings.push(format!(
            "the highest pressure is {highest} of a full scale of {full_scale}; if the pen has fewer levels, state its value of full pressure"
        ));
    }
    Ok(Imported { value: recording.rows.iter().map(sample).collect(), warnings })
}

/// Length of the shortest row: seven digits, each with a separator.
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

/// Text for a message, truncated to 40 characters.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests;
