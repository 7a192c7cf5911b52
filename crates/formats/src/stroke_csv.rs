//! Strokes as CSV tables, separated by commas, semicolons or tabs, with or without a header.
//!
//! With a header, columns are found by name: `t` or `time`, then either `x` and `y` with `pressure` (0..1) or `force`, or
//! `speed` with `force`. A name may state a unit of [`crate::recording`], as in `t_ms`, `speed_m/s` or `force_mN`; without
//! one, mm, mm/s and N are assumed. `touching` (0 or 1) may state contact; otherwise the tip is lifted at zero pressure or
//! force. `speed_normal` may state how fast the tip lands; an empty field of this column is unknown, and without a unit it has
//! that of `speed`. Without a header, three columns are time, speed and force, and four are time, x, y and force. Decimal commas
//! are accepted, in quotes if commas separate the columns.

mod columns;

use std::fmt::Write as _;

use shagreen_core::dsp::spectrum::median;

use crate::csv_text::{self, TableTextError, line_of, number};
use crate::imported::Imported;
use crate::stroke::{PenSample, PressUnit, Stroke, TimedContact};
use crate::stroke_csv::columns::{Columns, Kind};

/// Maximum duration for which an unlabeled time column is read as seconds, in s.
pub const LONGEST_IN_SECONDS: f64 = 60.0;

/// Median speed of the moving tip below which m/s were probably meant, if mm/s are assumed, in mm/s.
const SLOWEST_MM_PER_S: f64 = 1.0;

/// Median interval between rows of positions above which the motion between them is not known, in s.
const LONGEST_INTERVAL_SECS: f64 = 0.05;

/// Why bytes are not a stroke.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrokeCsvError {
    /// Not text.
    #[error(transparent)]
    Text(#[from] TableTextError),
    /// There are no rows.
    #[error(
        "the table has no rows of numbers; add rows of time, speed and force, or of time, x, y and force or pressure"
    )]
    Empty,
    /// Columns are missing or unknown.
    #[error("{problem}; name the columns t, x, y, force or t, speed, force in a header line")]
    Header {
        /// What is wrong.
        problem: String,
    },
    /// A row has the wrong number of values.
    #[error("line {line} has {found} values, but the table has {expected} columns; correct the line")]
    Columns {
        /// The line, from one.
        line: u64,
        /// Number of values found.
        found: usize,
        /// Number of columns of the table.
        expected: usize,
    },
    /// A value is not a finite number.
    #[error("{column} in line {line} is \"{found}\", not a finite number; correct the line")]
    Number {
        /// The line, from one.
        line: u64,
        /// The column.
        column: &'static str,
        /// Text of the field.
        found: String,
    },
    /// A value is out of range.
    #[error("{column} in line {line} is {value}, but must be {needs}; correct the line")]
    Range {
        /// The line, from one.
        line: u64,
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
        /// The permitted range.
        needs: &'static str,
    },
    /// Time does not increase.
    #[error(
        "time does not increase in line {line}, from {before} to {time}; sort the lines by time and remove repeated times"
    )]
    TimeGoesBack {
        /// The line, from one.
        line: u64,
        /// Time of the previous line.
        before: f64,
        /// Time of this line.
        time: f64,
    },
}

/// A row of numbers, in the order of [`Columns`].
struct Row {
    line: u64,
    time: f64,
    values: [f64; 3],
    touching: Option<bool>,
    impact_mps: Option<f64>,
}

/// Reads a stroke. Assumptions about a missing header or unit are warnings.
///
/// # Errors
/// See [`StrokeCsvError`].
pub fn read_stroke_csv(bytes: &[u8]) -> Result<Imported<Stroke>, StrokeCsvError> {
    let text = csv_text::text(bytes)?;
    let (delimiter, text, mut records) = csv_text::records(&text);
    let first = records.next().ok_or(StrokeCsvError::Empty)?;
    let mut warnings = Vec::new();
    let is_header =
        first.iter().all(|field| number(field, delimiter).is_none() && !is_nonsense_number(field));
    let columns = if is_header { Columns::from_header(&first)? } else { Columns::by_count(first.len())? };
    if !is_header {
        warnings.push(format!("the table has no header; the columns are read as {}", columns.in_words()));
    }
    let first_row = (!is_header).then_some(first);
    // The capacity is limited to what the text can hold: at least a digit and a separator per value.
    let n_lines = text.bytes().filter(|byte| matches!(byte, b'\n' | b'\r')).count() + 1;
    let mut rows = Vec::with_capacity(n_lines.min(text.len() / (2 * columns.n) + 1));
    for record in first_row.into_iter().chain(records) {
        rows.push(parse_row(&columns, &record, line_of(text, &record), delimiter)?);
    }
    let secs_per_unit = secs_per_unit(&columns, &rows, &mut warnings)?;
    warnings.extend(columns.assumed_units());
    let [first_si, second_si, third_si] = columns.values_si();
    let start = rows.first().map_or(0.0, |row| row.time);
    let time_secs = |row: &Row| (row.time - start) * secs_per_unit;
    let stroke = match columns.kind {
        Kind::Contacts => Stroke::Contacts(
            rows.iter()
                .map(|row| TimedContact {
                    time_secs: time_secs(row),
                    speed_mps: first_si * row.values[0],
                    force_n: if row.touching == Some(false) { 0.0 } else { second_si * row.values[1] },
                    impact_mps: row.impact_mps,
                })
                .collect(),
        ),
        Kind::Pen(press_unit) => {
            let sample = |row: &Row| PenSample {
                time_secs: time_secs(row),
                x_m: first_si * row.values[0],
                y_m: second_si * row.values[1],
                press: third_si * row.values[2],
                touching: row.touching.unwrap_or(row.values[2] > 0.0),
                impact_mps: row.impact_mps,
            };
            Stroke::Pen { samples: rows.iter().map(sample).collect(), press_unit }
        }
    };
    warnings.extend(match &stroke {
        Stroke::Contacts(contacts) => slow_speeds(contacts).filter(|_| columns.speed_is_assumed()),
        Stroke::Pen { samples, .. } => long_intervals(samples),
    });
    Ok(Imported { value: stroke, warnings })
}

/// Returns a warning if the tip moves so slowly that the speeds are probably in m/s.
fn slow_speeds(contacts: &[TimedContact]) -> Option<String> {
    let moving = contacts.iter().filter(|contact| contact.force_n > 0.0 && contact.speed_mps > 0.0);
    let mm_per_s = 1e3 * median(moving.map(|contact| contact.speed_mps).collect());
    (mm_per_s < SLOWEST_MM_PER_S).then(|| {
        format!(
            "the median speed in contact is {mm_per_s:.3} mm/s; did you mean {mm_per_s:.3} m/s? Then name the column speed_m/s"
        )
    })
}

/// Returns a warning if the rows of positions are too far apart to show how the tip moves between them.
fn long_intervals(samples: &[PenSample]) -> Option<String> {
    let interval_secs =
        median(samples.windows(2).map(|pair| pair[1].time_secs - pair[0].time_secs).collect());
    (interval_secs > LONGEST_INTERVAL_SECS).then(|| {
        format!(
            "the rows are {interval_secs:.3} s apart (median); the tip speed between them is distance over time, and faster changes are unknown: record at least 20 rows a second"
        )
    })
}

/// Returns whether a table is a stroke by the names in its header; `head` must contain the whole header line. Column
/// names that acceleration recordings also use, such as a bare `x` and `y`, do not suffice.
pub fn is_stroke_table(head: &[u8]) -> bool {
    let text = csv_text::text_with_odd_letters(head);
    let first = csv_text::records(&text).2.next();
    first.is_some_and(|first| Columns::from_header(&first).is_ok_and(|columns| columns.are_of_a_stroke_only))
}

/// Writes a pen stroke as a table that [`read_stroke_csv`] reads: `t_s`, `x_mm`, `y_mm`, `pressure` or `force_n`,
/// `touching`, and `speed_normal` if it is known of any sample. Time starts at zero. Of several samples at one time only the last is written, because the reader
/// requires increasing times.
pub fn stroke_csv(samples: &[PenSample], press_unit: PressUnit) -> String {
    let press = match press_unit {
        PressUnit::FullScale => "pressure",
        PressUnit::Newtons => "force_n",
    };
    let start_secs = samples.first().map_or(0.0, |sample| sample.time_secs);
    let has_impacts = samples.iter().any(|sample| sample.impact_mps.is_some());
    let speed_normal = if has_impacts { ",speed_normal" } else { "" };
    let mut text = format!("t_s,x_mm,y_mm,{press},touching{speed_normal}\n");
    for (index, sample) in samples.iter().enumerate() {
        if samples.get(index + 1).is_some_and(|next| next.time_secs <= sample.time_secs) {
            continue;
        }
        let PenSample { time_secs, x_m, y_m, press, touching, impact_mps } = sample;
        let (time_secs, x_mm, y_mm) = (time_secs - start_secs, 1e3 * x_m, 1e3 * y_m);
        // Writing to a string cannot fail.
        let _ = write!(text, "{time_secs},{x_mm},{y_mm},{press},{}", u8::from(*touching));
        if has_impacts {
            text.push(',');
            if let Some(impact_mps) = impact_mps {
                let _ = write!(text, "{}", 1e3 * impact_mps);
            }
        }
        text.push('\n');
    }
    text
}

/// Returns whether a field is NaN or infinity in words, which is not a column name.
fn is_nonsense_number(field: &str) -> bool {
    field.parse::<f64>().is_ok()
}

fn parse_row(
    columns: &Columns,
    record: &csv::StringRecord,
    line: u64,
    delimiter: u8,
) -> Result<Row, StrokeCsvError> {
    if record.len() != columns.n {
        return Err(StrokeCsvError::Columns { line, found: record.len(), expected: columns.n });
    }
    let value_of = |column: &'static str, index: usize| {
        let field = record.get(index).unwrap_or("");
        let found = || field.chars().take(40).collect();
        number(field, delimiter).ok_or_else(|| StrokeCsvError::Number { line, column, found: found() })
    };
    let time = value_of("time", columns.time)?;
    let mut values = [0.0; 3];
    for (value, (column, index)) in values.iter_mut().zip(columns.named_values()) {
        *value = value_of(column, index)?;
        let needs = match column {
            "speed" | "force" if *value < 0.0 => Some("at least 0"),
            "pressure" if !(0.0..=1.0).contains(value) => Some("0 to 1"),
            _ => None,
        };
        if let Some(needs) = needs {
            return Err(StrokeCsvError::Range { line, column, value: *value, needs });
        }
    }
    let touching = columns.touching.map(|index| value_of("touching", index)).transpose()?;
    let is_stated = |index: &usize| record.get(*index).is_some_and(|field| !field.trim().is_empty());
    let column = "speed_normal";
    let speed_normal =
        columns.speed_normal.filter(is_stated).map(|index| value_of(column, index)).transpose()?;
    if let Some(value) = speed_normal.filter(|value| *value < 0.0) {
        return Err(StrokeCsvError::Range { line, column, value, needs: "at least 0" });
    }
    Ok(Row {
        line,
        time,
        values,
        touching: touching.map(|value| value != 0.0),
        impact_mps: speed_normal.map(|speed| columns.speed_normal_mps() * speed),
    })
}

/// Returns the time unit in seconds, after checking that time increases.
fn secs_per_unit(columns: &Columns, rows: &[Row], warnings: &mut Vec<String>) -> Result<f64, StrokeCsvError> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Err(StrokeCsvError::Empty) };
    for pair in rows.windows(2) {
        if pair[1].time <= pair[0].time {
            let (before, time) = (pair[0].time, pair[1].time);
            return Err(StrokeCsvError::TimeGoesBack { line: pair[1].line, before, time });
        }
    }
    Ok(match columns.time_secs {
        Some(secs) => secs,
        None if last.time - first.time <= LONGEST_IN_SECONDS => {
            warnings.push(
                "the unit of time is not stated; seconds are assumed (name the column t_s or t_ms)"
                    .to_owned(),
            );
            1.0
        }
        None => {
            warnings.push(
                "the unit of time is not stated; milliseconds are assumed, because in seconds the stroke would last over a minute (name the column t_s or t_ms)"
                    .to_owned(),
            );
            1e-3
        }
    })
}

#[cfg(test)]
mod tests;
