//! Stroke from its files: columns of acceleration, position and force with the clock of the acceleration.

use std::ops::Range;

use shagreen_core::recording::{RawClock, RawMotion, RawRecording, RawTrack};

use crate::recording::RecordingFileError;
use crate::recording::directional::name::{Quantity, StrokeName};
use crate::recording::directional::quantity_table::{QuantityTable, read_quantity};
use crate::recording::directional::slow_track::SlowTrack;
use crate::recording::infer_units::{alternates, median_of};

/// Smallest share of the acceleration's duration that the other quantities must cover.
const MIN_OVERLAP: f64 = 0.5;

/// Ratio of the measured force to that of the file name, or its inverse, from which on it is reported.
const OTHER_FORCE: f64 = 2.0;

/// Contents of the files of one stroke.
#[derive(Clone, Copy, Debug)]
pub struct StrokeBytes<'a> {
    /// Table of accelerations.
    pub acceleration: &'a [u8],
    /// Table of forces, if there is one.
    pub force: Option<&'a [u8]>,
    /// Table of positions, if there is one.
    pub position: Option<&'a [u8]>,
}

/// Stroke in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalStroke {
    /// Its columns in SI units.
    pub raw: RawRecording,
    /// Direction of the motion by the positions in rad, 0 to 2π, counterclockwise from the x axis; that of the axis, 0 to
    /// π, for a stroke there and back. `None` without positions or with a curved path.
    pub direction_rad: Option<f64>,
    /// Sentences for the user, without figures, so that equal ones of many strokes can be counted.
    pub warnings: Vec<String>,
}

/// File of a stroke that cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct StrokeError {
    /// Quantity in the file.
    pub quantity: Quantity,
    /// What is wrong.
    pub reason: RecordingFileError,
}

/// Reads the files of a stroke. Without a force or position file, or if its times do not overlap those of the
/// acceleration, the force or speed of the name holds for the whole stroke, with a warning. Rows outside the common times
/// of the files are left out.
///
/// # Errors
/// [`StrokeError`] for a damaged table; the error states the line where it is known.
pub fn read_stroke(name: &StrokeName, bytes: &StrokeBytes<'_>) -> Result<DirectionalStroke, StrokeError> {
    let mut warnings = Vec::new();
    let acceleration = read(bytes.acceleration, Quantity::Acceleration, &mut warnings)?;
    let span_secs = span_of(&acceleration.times_secs);
    let mut slow = |bytes: Option<&[u8]>, quantity: Quantity| -> Result<Option<SlowTrack>, StrokeError> {
        let Some(bytes) = bytes else {
            warnings.push(format!("there is no {} file; {}", quantity.name(), of_name(quantity)));
            return Ok(None);
        };
        let track = SlowTrack::new(&read(bytes, quantity, &mut warnings)?);
        let track = track.filter(|track| does_overlap(track.span_secs(), span_secs));
        if track.is_none() {
            warnings.push(format!(
                "the times of the {} file do not cover those of the acceleration; {}",
                quantity.name(),
                of_name(quantity)
            ));
        }
        Ok(track)
    };
    let force = slow(bytes.force, Quantity::Force)?;
    let position = slow(bytes.position, Quantity::Position)?;

    let rows = common_rows(&acceleration.times_secs, [&force, &position]);
    let times_secs = &acceleration.times_secs[rows.clone()];
    let force_n = force_track(force.as_ref(), times_secs, name, &mut warnings);
    let motion = match &position {
        Some(position) => RawMotion::Positions(position.at(times_secs)),
        None => RawMotion::Speed(RawTrack::Constant(name.speed.0)),
    };
    let raw = RawRecording {
        clock: RawClock::Times(times_secs.to_vec()),
        acceleration_mps2: acceleration.columns.iter().map(|column| column[rows.clone()].to_vec()).collect(),
        motion,
        force_n,
        full_scale_mps2: None,
    };
    let direction_rad = position.as_ref().and_then(SlowTrack::direction_rad);
    Ok(DirectionalStroke { raw, direction_rad, warnings })
}

fn read(bytes: &[u8], quantity: Quantity, warnings: &mut Vec<String>) -> Result<QuantityTable, StrokeError> {
    let mut table = read_quantity(bytes, quantity).map_err(|reason| StrokeError { quantity, reason })?;
    warnings.append(&mut table.warnings);
    Ok(table)
}

/// What holds instead of a missing quantity.
fn of_name(quantity: Quantity) -> &'static str {
    if quantity == Quantity::Force {
        "the force of the file name is used"
    } else {
        "the speed of the file name is used"
    }
}

/// Lowest and highest finite time.
fn span_of(times_secs: &[f64]) -> [f64; 2] {
    let finite = || times_secs.iter().copied().filter(|time| time.is_finite());
    [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)]
}

fn does_overlap(track: [f64; 2], acceleration: [f64; 2]) -> bool {
    let common_secs = track[1].min(acceleration[1]) - track[0].max(acceleration[0]);
    common_secs > 0.0 && common_secs >= MIN_OVERLAP * (acceleration[1] - acceleration[0])
}

/// Rows of the acceleration within the times of all tracks.
fn common_rows(times_secs: &[f64], tracks: [&Option<SlowTrack>; 2]) -> Range<usize> {
    let spans = || tracks.into_iter().flatten().map(SlowTrack::span_secs);
    let from = spans().map(|span| span[0]).fold(f64::NEG_INFINITY, f64::max);
    let to = spans().map(|span| span[1]).fold(f64::INFINITY, f64::min);
    let is_within = |time: &f64| (from..=to).contains(time);
    let first = times_secs.iter().position(is_within).unwrap_or(0);
    let end = times_secs.iter().rposition(is_within).map_or(0, |last| last + 1);
    first..end.max(first)
}

/// Normal force at the times of the acceleration, or that of the name.
fn force_track(
    force: Option<&SlowTrack>,
    times_secs: &[f64],
    name: &StrokeName,
    warnings: &mut Vec<String>,
) -> RawTrack {
    let Some(mut values) = force.and_then(|force| force.at(times_secs).into_iter().next()) else {
        return RawTrack::Constant(name.force.0);
    };
    if alternates(&values) {
        warnings.push(
            "the force is positive part of the time and negative part of the time; the force of the file name is used"
                .to_owned(),
        );
        return RawTrack::Constant(name.force.0);
    }
    if median_of(&values) < 0.0 {
        warnings.push("the force is negative while the tip presses; its sign was changed".to_owned());
        for value in &mut values {
            *value = -*value;
        }
    }
    let ratio = median_of(&values) / name.force.0;
    if !(OTHER_FORCE.recip()..=OTHER_FORCE).contains(&ratio) {
        warnings.push(
            "the measured force is less than half or more than twice that of the file name; the measured force is used"
                .to_owned(),
        );
    }
    RawTrack::Column(values)
}
