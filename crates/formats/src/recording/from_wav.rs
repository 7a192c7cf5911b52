//! Conversion of the channels of a WAV file to columns in SI units.

use shagreen_core::recording::{Fault, RawClock, RawMotion, RawRecording, RawTrack, check_clock};
use shagreen_core::units::Hertz;

use crate::recording::column_map::{Channel, ColumnMap};
use crate::recording::infer_units::largest;
use crate::recording::map_builder::MapBuilder;
use crate::recording::question::Ask;
use crate::recording::sidecar::read_sidecar;
use crate::recording::units::{AccelerationUnit, ForceUnit, SpeedUnit};
use crate::recording::wav::{WavSamples, read_wav};
use crate::recording::{RecordingFile, RecordingFileError};

/// Converts a WAV file to a recording.
pub(super) fn recording_of_wav(
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    map: &ColumnMap,
) -> Result<RecordingFile, RecordingFileError> {
    let WavSamples { rate_hz, mut channels, float, warnings } = read_wav(bytes)?;
    let mut inquiry = MapBuilder::new(map.clone());
    inquiry.warnings = warnings;
    let rate_hz = f64::from(rate_hz);
    let trace = sidecar.map(|bytes| read_sidecar(bytes, rate_hz, &mut inquiry)).transpose()?.flatten();
    name_columns(&mut inquiry);
    let stated = inquiry.map.rate_hz;
    inquiry.map.rate_hz =
        inquiry.settle("the sample rate", stated, Some(rate_hz), |rate| format!("{rate} Hz"));
    let rate_hz = inquiry.map.rate_hz.unwrap_or(rate_hz);
    let clock = RawClock::Rate(Hertz(rate_hz));
    // The number of samples is kept, because channels are emptied when they are used.
    let n_samples = channels.first().map_or(0, Vec::len);
    let faults: Vec<Fault> = check_clock(&clock).1;
    let Some(kinds) = channel_kinds(&mut inquiry, channels.len())? else {
        return inquiry.close(None, faults);
    };
    let axes: Vec<usize> = (0..kinds.len()).filter(|place| kinds[*place] == Channel::Acceleration).collect();
    let place = |wanted: Channel| kinds.iter().position(|kind| *kind == wanted);
    let (speed, force) = (place(Channel::Speed), place(Channel::Force));
    if !(1..=3).contains(&axes.len()) {
        let problem = format!("a recording needs one to three channels of acceleration, not {}", axes.len());
        return Err(RecordingFileError::Map { problem });
    }

    let unit_names: Vec<&str> = AccelerationUnit::ALL.iter().map(|unit| unit.name()).collect();
    if inquiry.map.acceleration_unit.is_none() {
        let text =
            "a WAV file does not state the unit of acceleration, and there is no sidecar file that does";
        inquiry.ask(Ask::AccelerationUnit, &unit_names, text.to_owned());
    }
    if inquiry.map.full_scale.is_none() {
        let text = "the full scale, the acceleration of a sample of 1.0, is not stated; give it in the unit of acceleration";
        inquiry.ask(Ask::FullScale, &[], text.to_owned());
    }
    let unit = inquiry.map.acceleration_unit.map_or(1.0, AccelerationUnit::si);
    let full_scale_mps2 = unit * inquiry.map.full_scale.unwrap_or(1.0);

    let speed_mps = if let Some(speed) = inquiry.map.constant_speed {
        RawTrack::Constant(speed.0)
    } else if let Some(place) = speed {
        let names: Vec<&str> = SpeedUnit::ALL.iter().map(|unit| unit.name()).collect();
        let scale = track_scale(&mut inquiry, &channels[place], float, Ask::SpeedFullScale);
        if inquiry.map.speed_unit.is_none() {
            inquiry.ask(Ask::SpeedUnit, &names, "the unit of the speed channel is not stated".to_owned());
        }
        let si = scale * inquiry.map.speed_unit.map_or(1.0, SpeedUnit::si);
        RawTrack::Column(scaled(&mut channels[place], si))
    } else if let Some(trace) = &trace {
        on_clock(&trace.time_s, &trace.speed_mm_per_s, 1e-3, n_samples, rate_hz)
    } else {
        inquiry.map.refuse_column(Ask::Speed, "a WAV file")?;
        let text = "neither a channel nor a sidecar file gives the speed; state a constant speed such as \"100 mm/s\"";
        inquiry.ask(Ask::Speed, &[], text.to_owned());
        RawTrack::Missing
    };
    let force_n = if let Some(force) = inquiry.map.constant_force {
        RawTrack::Constant(force.0)
    } else if let Some(place) = force {
        let names: Vec<&str> = ForceUnit::ALL.iter().map(|unit| unit.name()).collect();
        let scale = track_scale(&mut inquiry, &channels[place], float, Ask::ForceFullScale);
        if inquiry.map.force_unit.is_none() {
            inquiry.ask(Ask::ForceUnit, &names, "the unit of the force channel is not stated".to_owned());
        }
        let sign = if inquiry.map.pressing_is_negative == Some(true) { -1.0 } else { 1.0 };
        let si = sign * scale * inquiry.map.force_unit.map_or(1.0, ForceUnit::si);
        RawTrack::Column(scaled(&mut channels[place], si))
    } else if let Some(trace) = &trace {
        on_clock(&trace.time_s, &trace.force_n, 1.0, n_samples, rate_hz)
    } else {
        inquiry.map.refuse_column(Ask::Force, "a WAV file")?;
        let text = "neither a channel nor a sidecar file gives the normal force; state a constant force such as \"1 N\"";
        inquiry.ask(Ask::Force, &[], text.to_owned());
        RawTrack::Missing
    };
    let acceleration_mps2 = axes.iter().map(|place| scaled(&mut channels[*place], full_scale_mps2)).collect();
    let raw = RawRecording {
        clock,
        acceleration_mps2,
        motion: RawMotion::Speed(speed_mps),
        force_n,
        // Float samples may exceed 1.0; integers clip there.
        full_scale_mps2: (!float).then_some(full_scale_mps2),
    };
    inquiry.close(Some(raw), faults)
}

/// Warns about columns in the map, because a WAV file has channels instead.
fn name_columns(inquiry: &mut MapBuilder) {
    let map = &inquiry.map;
    let named = [
        ("time", map.time.is_some()),
        ("acceleration", map.acceleration.is_some()),
        ("speed", map.speed.is_some()),
        ("positions", map.positions.is_some()),
        ("force", map.force.is_some()),
    ];
    let named: Vec<&str> = named.iter().filter(|(_, is_named)| *is_named).map(|(key, _)| *key).collect();
    if !named.is_empty() {
        let text =
            format!("the column map names columns ({}), but a WAV file has channels", named.join(", "));
        inquiry.warnings.push(text);
    }
}

/// Returns the contents of the channels; `None` if the user must state them.
fn channel_kinds(
    inquiry: &mut MapBuilder,
    n_channels: usize,
) -> Result<Option<Vec<Channel>>, RecordingFileError> {
    if let Some(kinds) = inquiry.map.channels.clone() {
        if kinds.len() != n_channels {
            let problem = format!("{} channels are named, but the file has {n_channels}", kinds.len());
            return Err(RecordingFileError::Map { problem });
        }
        return Ok(Some(kinds));
    }
    let all = vec!["acceleration"; n_channels].join(",");
    match n_channels {
        1 => inquiry.map.channels = Some(vec![Channel::Acceleration]),
        3 => {
            let text =
                "the contents of the three channels are not stated; they are read as the axes of acceleration".to_owned();
            inquiry.guess(Ask::Channels, &all, &[], text);
        }
        _ => {
            let text = format!(
                "the contents of the {n_channels} channels are not stated; list acceleration, speed, force or unused for each"
            );
            inquiry.ask(Ask::Channels, &[], text);
        }
    }
    Ok(inquiry.map.channels.clone())
}

/// Value of a sample of 1.0 in a speed or force channel, in its unit.
fn track_scale(inquiry: &mut MapBuilder, samples: &[f64], float: bool, what: Ask) -> f64 {
    let stated = |map: &ColumnMap| match what {
        Ask::SpeedFullScale => map.speed_full_scale,
        _ => map.force_full_scale,
    };
    if stated(&inquiry.map).is_none() {
        let text = "the value of a sample of 1.0 in that channel is not stated".to_owned();
        if float && largest(samples) > 1.0 {
            let text = format!("{text}; samples exceed 1.0, so they are in the unit itself");
            inquiry.guess(what, "1", &[], text);
        } else {
            inquiry.ask(what, &[], text);
        }
    }
    stated(&inquiry.map).unwrap_or(1.0)
}

fn scaled(samples: &mut Vec<f64>, si: f64) -> Vec<f64> {
    let mut samples = std::mem::take(samples);
    for sample in &mut samples {
        *sample *= si;
    }
    samples
}

/// Resamples a trace at the times of the samples: linear interpolation, with its end values held.
fn on_clock(times: &[f64], values: &[f64], si: f64, n_samples: usize, rate_hz: f64) -> RawTrack {
    let mut after = 0;
    let at = |sample: usize| {
        let time = sample as f64 / rate_hz;
        while after < times.len() && times[after] <= time {
            after += 1;
        }
        let value = match (after.checked_sub(1), values.get(after)) {
            (None, _) => values[0],
            (Some(before), None) => values[before],
            (Some(before), Some(next)) => {
                let share = (time - times[before]) / (times[after] - times[before]);
                values[before] + share * (next - values[before])
            }
        };
        value * si
    };
    RawTrack::Column((0..n_samples).map(at).collect())
}
