//! From the channels of a WAV file to columns in SI units.

use shagreen_core::recording::{Fault, RawClock, RawMotion, RawRecording, RawTrack, check_clock};
use shagreen_core::units::Hertz;

use crate::recording::column_map::{Channel, ColumnMap};
use crate::recording::inquiry::Inquiry;
use crate::recording::question::Ask;
use crate::recording::sidecar::read_sidecar;
use crate::recording::told::largest;
use crate::recording::units::{AccelerationUnit, ForceUnit, SpeedUnit};
use crate::recording::wav::{WavSamples, read_wav};
use crate::recording::{RecordingFile, RecordingFileError};

/// Reads the recording out of a WAV file.
pub(super) fn recording_of_wav(
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    map: &ColumnMap,
) -> Result<RecordingFile, RecordingFileError> {
    let WavSamples { rate_hz, mut channels, float, warnings } = read_wav(bytes)?;
    let mut inquiry = Inquiry::new(map.clone());
    inquiry.warnings = warnings;
    let rate_hz = f64::from(rate_hz);
    let trace = sidecar.map(|bytes| read_sidecar(bytes, rate_hz, &mut inquiry)).transpose()?.flatten();
    name_columns(&mut inquiry);
    let stated = inquiry.map.rate_hz;
    inquiry.map.rate_hz = inquiry.settle("the rate", stated, Some(rate_hz), |rate| format!("{rate} Hz"));
    let rate_hz = inquiry.map.rate_hz.unwrap_or(rate_hz);
    let clock = RawClock::Rate(Hertz(rate_hz));
    // Channels are emptied as they are taken.
    let n_samples = channels.first().map_or(0, Vec::len);
    let faults: Vec<Fault> = check_clock(&clock).1;
    let Some(kinds) = channel_kinds(&mut inquiry, channels.len())? else {
        return inquiry.close(None, faults);
    };
    let axes: Vec<usize> = (0..kinds.len()).filter(|place| kinds[*place] == Channel::Acceleration).collect();
    let place = |wanted: Channel| kinds.iter().position(|kind| *kind == wanted);
    let (speed, force) = (place(Channel::Speed), place(Channel::Force));
    if !(1..=3).contains(&axes.len()) {
        let problem = format!("a recording has one to three channels of acceleration, not {}", axes.len());
        return Err(RecordingFileError::Map { problem });
    }

    let unit_names: Vec<&str> = AccelerationUnit::ALL.iter().map(|unit| unit.name()).collect();
    if inquiry.map.acceleration_unit.is_none() {
        let text = "a WAV file does not say the unit of acceleration, and there is no sidecar that does";
        inquiry.ask(Ask::AccelerationUnit, &unit_names, text.to_owned());
    }
    if inquiry.map.full_scale.is_none() {
        let text = "the acceleration of a sample of 1.0, the full scale, is not stated; give it in the unit of acceleration";
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
        let text =
            "neither a channel nor a sidecar says the speed; say the constant speed, such as \"100 mm/s\"";
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
        let text =
            "neither a channel nor a sidecar says the normal force; say the constant force, such as \"1 N\"";
        inquiry.ask(Ask::Force, &[], text.to_owned());
        RawTrack::Missing
    };
    let acceleration_mps2 = axes.iter().map(|place| scaled(&mut channels[*place], full_scale_mps2)).collect();
    let raw = RawRecording {
        clock,
        acceleration_mps2,
        motion: RawMotion::Speed(speed_mps),
        force_n,
        // Floats may go beyond 1.0; integers cannot.
        full_scale_mps2: (!float).then_some(full_scale_mps2),
    };
    inquiry.close(Some(raw), faults)
}

/// Says which columns of a map a WAV file cannot have.
fn name_columns(inquiry: &mut Inquiry) {
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
        let text = format!("the map names columns ({}), a WAV file has channels instead", named.join(", "));
        inquiry.warnings.push(text);
    }
}

/// What the channels are; nothing where that has to be asked.
fn channel_kinds(
    inquiry: &mut Inquiry,
    n_channels: usize,
) -> Result<Option<Vec<Channel>>, RecordingFileError> {
    if let Some(kinds) = inquiry.map.channels.clone() {
        if kinds.len() != n_channels {
            let problem = format!("{} channels are named, the file has {n_channels}", kinds.len());
            return Err(RecordingFileError::Map { problem });
        }
        return Ok(Some(kinds));
    }
    let all = vec!["acceleration"; n_channels].join(",");
    match n_channels {
        1 => inquiry.map.channels = Some(vec![Channel::Acceleration]),
        3 => {
            let text =
                "what the three channels are is not stated; taken for the axes of acceleration".to_owned();
            inquiry.guess(Ask::Channels, &all, &[], text);
        }
        _ => {
            let text = format!(
                "what the {n_channels} channels are is not stated; list acceleration, speed, force or unused for each"
            );
            inquiry.ask(Ask::Channels, &[], text);
        }
    }
    Ok(inquiry.map.channels.clone())
}

/// What a sample of 1.0 of a channel of speed or force is, in its unit.
fn track_scale(inquiry: &mut Inquiry, samples: &[f64], float: bool, what: Ask) -> f64 {
    let stated = |map: &ColumnMap| match what {
        Ask::SpeedFullScale => map.speed_full_scale,
        _ => map.force_full_scale,
    };
    if stated(&inquiry.map).is_none() {
        let text = "what a sample of 1.0 is in that channel is not stated".to_owned();
        if float && largest(samples) > 1.0 {
            let text = format!("{text}; the samples go beyond 1.0, so they are in the unit itself");
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

/// A trace on the clock of the samples: straight lines between, its ends held.
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
