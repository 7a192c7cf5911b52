//! Conversion of a file's rows to a recording with a regular clock.

use std::slice::from_mut;

use crate::dsp::dft321::dft321_short_time;
use crate::recording::axis::Axis;
use crate::recording::bounds::{ACCELERATION, FORCE, POSITION, SPEED};
use crate::recording::clock::{Count, Timeline, read_clock};
use crate::recording::dropout::{check_signal, dead_value, is_rest, mark_dropouts};
use crate::recording::hum::mains_hum;
use crate::recording::missing::{fill_slower, mark_missing};
use crate::recording::motion::speed_from_positions;
use crate::recording::plausible::check_plausible;
use crate::recording::segment::MIN_FORCE;
use crate::recording::stretch::{Stretch, fast, lay_out, slow};
use crate::recording::{
    Fault, Finding, MIN_USABLE_SECS, RawClock, RawMotion, RawRecording, RawTrack, Recording, RecordingError,
    Where,
};
use crate::units::Hertz;

/// Share of rows with negative force above which they are reported.
const SIGNED_SHARE: f64 = 0.01;

/// Axis of acceleration that is not constant.
struct LiveAxis {
    /// Number of the axis in the file, from 0.
    number: usize,
    /// Column name for findings.
    name: String,
    /// Acceleration in m/s², row by row.
    values: Vec<f64>,
}

/// Columns of a file, checked and laid out on a regular clock.
pub(super) struct Columns {
    axes: Vec<LiveAxis>,
    motion: RawMotion,
    force_n: RawTrack,
    timeline: Timeline,
    stretches: Vec<Stretch>,
    /// Length of the recording in samples, gaps included.
    n_samples: usize,
    findings: Vec<Finding>,
}

impl Recording {
    /// Converts the rows of a file to a recording with a regular clock, and reports findings.
    ///
    /// On a regular clock, rows are used as samples. On an irregular clock, acceleration is interpolated by polynomials
    /// of high degree, speed and force linearly, and never across a gap. Acceleration keeps its mean, including
    /// gravity. Rows that are stuck, clipped or lack a value are excluded from [`Recording::usable`]. Speed, positions
    /// or force from slower sensors, at 25 Hz or more, are interpolated linearly.
    ///
    /// # Errors
    /// [`RecordingError`] with every fault found.
    pub fn from_raw(raw: RawRecording) -> Result<(Self, Vec<Finding>), RecordingError> {
        let mut columns = Columns::of(raw)?;
        let n_axes = columns.axes.len();
        if n_axes > 1 {
            columns.findings.push(Finding::AxesCombined { n_axes });
        }
        columns.into_recording()
    }
}

impl Columns {
    /// Checks the rows of a file, and lays them out on a regular clock.
    ///
    /// # Errors
    /// [`RecordingError`] with every fault found.
    pub(super) fn of(raw: RawRecording) -> Result<Self, RecordingError> {
        let (mut findings, mut faults) = (Vec::new(), Vec::new());
        let n_rows = raw.acceleration_mps2.first().map_or(0, Vec::len);
        check_columns(&raw, n_rows, &mut faults);
        let RawRecording { clock, acceleration_mps2, mut motion, mut force_n, full_scale_mps2 } = raw;
        let timeline = read_clock(clock, n_rows, &mut findings, &mut faults);
        let unequal = faults.iter().any(|fault| matches!(fault, Fault::UnequalColumns { .. }));
        let Some(timeline) = timeline.filter(|timeline| !unequal && !timeline.rows.is_empty()) else {
            return Err(RecordingError { faults, findings });
        };

        match &mut motion {
            RawMotion::Speed(RawTrack::Column(values)) => {
                fill_slower("speed", from_mut(values), &timeline, &mut findings);
            }
            RawMotion::Positions(axes) => fill_slower("positions", axes, &timeline, &mut findings),
            RawMotion::Speed(_) => {}
        }
        if let RawTrack::Column(values) = &mut force_n {
            fill_slower("force", from_mut(values), &timeline, &mut findings);
        }
        let mut usable = vec![true; timeline.rows.len()];
        let speed_rows = rows_of_speed(&motion);
        let force_rows = column_of(&force_n);
        let names = axis_names(acceleration_mps2.len());
        let numbered = names.into_iter().zip(acceleration_mps2).enumerate();
        let mut axes: Vec<LiveAxis> =
            numbered.map(|(number, (name, values))| LiveAxis { number, name, values }).collect();
        // This precedes the check for missing values: values missing in a constant axis do not matter.
        axes.retain(|LiveAxis { name, values, .. }| {
            let dead = dead_value(timeline.rows.iter().map(|row| values[*row]));
            findings.extend(dead.map(|value| Finding::DeadAxis { column: name.clone(), value }));
            dead.is_none()
        });
        for LiveAxis { name, values, .. } in &axes {
            mark_missing(name, &ACCELERATION, &[values], &timeline, &mut usable, &mut findings);
        }
        if let Some(values) = speed_rows {
            mark_missing("speed", &SPEED, &[values], &timeline, &mut usable, &mut findings);
        }
        if let RawMotion::Positions(axes) = &motion {
            let axes: Vec<&[f64]> = axes.iter().map(Vec::as_slice).collect();
            mark_missing("positions", &POSITION, &axes, &timeline, &mut usable, &mut findings);
        }
        if let Some(values) = force_rows {
            mark_missing("force", &FORCE, &[values], &timeline, &mut usable, &mut findings);
        }

        let at_rest = |row: usize| is_rest(speed_rows.map(|v| v[row]), force_rows.map(|v| v[row]));
        for LiveAxis { name, values, .. } in &axes {
            let axis = Axis { column: name, values, full_scale_mps2 };
            mark_dropouts(&axis, &timeline, at_rest, &mut usable, &mut findings, &mut faults);
        }

        let Some((stretches, n_samples)) = lay_out(&timeline, &usable, n_rows, &mut findings, &mut faults)
        else {
            return Err(RecordingError { faults, findings });
        };
        // Without an axis that carries a signal, no segment is usable.
        let stretches = if axes.is_empty() { Vec::new() } else { stretches };
        let usable_secs =
            stretches.iter().map(|stretch| stretch.samples.len()).sum::<usize>() as f64 / timeline.rate_hz;
        let is_told = faults.iter().any(Fault::leaves_nothing);
        if usable_secs < MIN_USABLE_SECS && !is_told {
            faults.push(Fault::NothingUsable { usable_secs });
        }
        say_motion(&motion, &force_n, &timeline, &mut findings);
        if !faults.is_empty() {
            return Err(RecordingError { faults, findings });
        }
        Ok(Self { axes, motion, force_n, timeline, stretches, n_samples, findings })
    }

    /// Returns the three axes on the clock of the recording, in the order of the file. A constant axis is 0; samples
    /// that are not usable are NaN.
    pub(super) fn three_axes(&self) -> [Vec<f64>; 3] {
        std::array::from_fn(|number| {
            let axis = self.axes.iter().find(|axis| axis.number == number);
            let mut samples = vec![f64::NAN; self.n_samples];
            for stretch in &self.stretches {
                let into = &mut samples[stretch.samples.clone()];
                match axis {
                    Some(axis) => into.copy_from_slice(&fast(&axis.values, &self.timeline, stretch)),
                    None => into.fill(0.0),
                }
            }
            samples
        })
    }

    /// Combines the axes by DFT321, and returns the recording with all findings.
    ///
    /// # Errors
    /// [`RecordingError`] if the recording is implausible.
    pub(super) fn into_recording(self) -> Result<(Recording, Vec<Finding>), RecordingError> {
        let Self { axes, motion, force_n, timeline, stretches, n_samples, mut findings } = self;
        let nothing = || vec![f64::NAN; n_samples];
        let mut recording = Recording {
            rate: Hertz(timeline.rate_hz),
            acceleration_mps2: nothing(),
            speed_mps: nothing(),
            force_n: nothing(),
            usable: stretches.iter().map(|stretch| stretch.samples.clone()).collect(),
        };
        for stretch in &stretches {
            let at = stretch.samples.clone();
            let axes: Vec<Vec<f64>> =
                axes.iter().map(|axis| fast(&axis.values, &timeline, stretch)).collect();
            let axes: Vec<&[f64]> = axes.iter().map(Vec::as_slice).collect();
            // All axes are cut to the same segment, so they have the same length.
            if let Ok(combined) = dft321_short_time(&axes, recording.rate) {
                recording.acceleration_mps2[at.clone()].copy_from_slice(&combined);
            }
            recording.speed_mps[at.clone()].copy_from_slice(&speed_of(&motion, &timeline, stretch));
            recording.force_n[at].copy_from_slice(&track_of(&force_n, &timeline, stretch));
        }
        match check_plausible(&recording, &mut findings) {
            None => {
                findings.extend(mains_hum(&recording));
                Ok((recording, findings))
            }
            Some(fault) => Err(RecordingError { faults: vec![fault], findings }),
        }
    }
}

/// Names of the axes in findings.
fn axis_names(n_axes: usize) -> Vec<String> {
    if n_axes == 1 {
        return vec!["acceleration".to_owned()];
    }
    (1..=n_axes).map(|axis| format!("acceleration {axis}")).collect()
}

fn column_of(track: &RawTrack) -> Option<&[f64]> {
    if let RawTrack::Column(values) = track { Some(values) } else { None }
}

fn rows_of_speed(motion: &RawMotion) -> Option<&[f64]> {
    if let RawMotion::Speed(track) = motion { column_of(track) } else { None }
}

/// Checks the columns for faults that do not depend on single values.
fn check_columns(raw: &RawRecording, n_rows: usize, faults: &mut Vec<Fault>) {
    faults.extend(check_signal(&raw.acceleration_mps2));
    if raw.acceleration_mps2.is_empty() {
        faults.push(Fault::NoAcceleration);
    } else if n_rows < 2 {
        faults.push(Fault::TooFewRows { n_rows });
    }
    let mut columns: Vec<(String, usize)> = axis_names(raw.acceleration_mps2.len())
        .into_iter()
        .zip(raw.acceleration_mps2.iter().map(Vec::len))
        .collect();
    if let RawClock::Times(times) = &raw.clock {
        columns.push(("time".to_owned(), times.len()));
    }
    match &raw.motion {
        RawMotion::Speed(track) => {
            check_track(track, ("speed in mm/s", 1e3), SPEED.most, Fault::NoSpeed, faults);
            columns.extend(column_of(track).map(|values| ("speed".to_owned(), values.len())));
        }
        RawMotion::Positions(axes) if axes.is_empty() => faults.push(Fault::NoSpeed),
        RawMotion::Positions(axes) => {
            columns.extend(axes.iter().map(|values| ("positions".to_owned(), values.len())));
        }
    }
    check_track(&raw.force_n, ("force in N", 1.0), FORCE.most, Fault::NoForce, faults);
    columns.extend(column_of(&raw.force_n).map(|values| ("force".to_owned(), values.len())));
    if raw.acceleration_mps2.is_empty() {
        return;
    }
    let unequal = columns.into_iter().filter(|(_, n)| *n != n_rows);
    faults.extend(unequal.map(|(column, n)| Fault::UnequalColumns { column, n_rows: n, of_rows: n_rows }));
}

/// Checks a track whose constant may be at most `most` in its SI unit. `what` names it with a common unit, and `per_si`
/// is the number of these units in one SI unit.
fn check_track(
    track: &RawTrack,
    (what, per_si): (&'static str, f64),
    most: f64,
    missing: Fault,
    faults: &mut Vec<Fault>,
) {
    match track {
        RawTrack::Missing => faults.push(missing),
        RawTrack::Constant(value) if !(0.0..=most).contains(value) => {
            faults.push(Fault::BadConstant { what, value: per_si * value, most: per_si * most });
        }
        RawTrack::Constant(_) | RawTrack::Column(_) => {}
    }
}

/// Reports constants, negative speeds and forces, and speeds computed from positions.
fn say_motion(motion: &RawMotion, force: &RawTrack, timeline: &Timeline, findings: &mut Vec<Finding>) {
    match motion {
        RawMotion::Positions(_) => findings.push(Finding::SpeedFromPositions),
        RawMotion::Speed(RawTrack::Constant(value)) => {
            findings.push(Finding::Constant { what: "speed in mm/s", value: 1e3 * value });
        }
        RawMotion::Speed(RawTrack::Column(values)) => {
            findings.extend(rows_below(values, 0.0, timeline).map(Finding::SignedSpeed));
        }
        RawMotion::Speed(RawTrack::Missing) => {}
    }
    match force {
        RawTrack::Constant(value) => findings.push(Finding::Constant { what: "force in N", value: *value }),
        RawTrack::Column(values) => {
            let below = rows_below(values, -MIN_FORCE.0, timeline);
            let is_often = |at: &Where| at.n_rows as f64 > SIGNED_SHARE * at.of_rows as f64;
            findings.extend(below.filter(is_often).map(Finding::SignedForce));
        }
        RawTrack::Missing => {}
    }
}

/// Rows of a column below `least`.
fn rows_below(values: &[f64], least: f64, timeline: &Timeline) -> Option<Where> {
    let mut below = Count::default();
    for (row, time) in timeline.rows.iter().zip(&timeline.times) {
        if values[*row] < least {
            below.add(*time);
        }
    }
    below.found(timeline.rows.len())
}

fn track_of(track: &RawTrack, timeline: &Timeline, stretch: &Stretch) -> Vec<f64> {
    match track {
        RawTrack::Column(values) => slow(values, timeline, stretch),
        RawTrack::Constant(value) => vec![*value; stretch.samples.len()],
        // A missing track is a fault, so no recording is returned in this case.
        RawTrack::Missing => vec![f64::NAN; stretch.samples.len()],
    }
}

fn speed_of(motion: &RawMotion, timeline: &Timeline, stretch: &Stretch) -> Vec<f64> {
    match motion {
        RawMotion::Speed(track) => track_of(track, timeline, stretch).iter().map(|v| v.abs()).collect(),
        RawMotion::Positions(axes) => {
            let times: Vec<f64> =
                stretch.samples.clone().map(|sample| sample as f64 / timeline.rate_hz).collect();
            let axes: Vec<Vec<f64>> = axes.iter().map(|values| slow(values, timeline, stretch)).collect();
            speed_from_positions(&times, &axes.iter().map(Vec::as_slice).collect::<Vec<_>>())
        }
    }
}

#[cfg(test)]
mod tests;
