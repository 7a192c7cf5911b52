//! Conversion of a haptic clip, or of another envelope, to acceleration in SI units.

use shagreen_core::recording::{MAX_RATE_HZ, MIN_RATE_HZ, RawClock, RawMotion, RawRecording, RawTrack};
use shagreen_core::signals::haptic_envelope::{HapticEnvelope, USUAL_BAND_HZ};
use shagreen_core::units::Hertz;

use crate::clip::{ClipKind, read_clip};
use crate::recording::column_map::ColumnMap;
use crate::recording::map_builder::MapBuilder;
use crate::recording::question::Ask;
use crate::recording::units::AccelerationUnit;
use crate::recording::{RecordingFile, RecordingFileError};

/// Sample rate of the signals in Hz, if none is stated: far above the frequencies of actuators.
const RATE_HZ: f64 = 4000.0;

/// Converts a clip to a recording.
pub(super) fn recording_of_clip(
    kind: ClipKind,
    bytes: &[u8],
    map: &ColumnMap,
) -> Result<RecordingFile, RecordingFileError> {
    if map.constant_speed.is_none() {
        map.refuse_column(Ask::Speed, kind.name())?;
    }
    if map.constant_force.is_none() {
        map.refuse_column(Ask::Force, kind.name())?;
    }
    let band_hz = map.frequency_range_hz.unwrap_or(USUAL_BAND_HZ);
    let clip = read_clip(kind, bytes, band_hz)
        .map_err(|error| RecordingFileError::Clip { reason: error.to_string() })?;
    let mut inquiry = MapBuilder::new(map.clone());
    inquiry.warnings = clip.warnings;
    recording_of_envelope(inquiry, &clip.envelope, kind.name(), clip.has_relative_frequencies)
}

/// Renders an envelope, and asks for what it does not state. `what` names the file.
pub(super) fn recording_of_envelope(
    mut inquiry: MapBuilder,
    envelope: &HapticEnvelope,
    what: &str,
    has_relative_frequencies: bool,
) -> Result<RecordingFile, RecordingFileError> {
    if has_relative_frequencies && inquiry.map.frequency_range_hz.is_none() {
        let [low, high] = USUAL_BAND_HZ;
        let text = format!(
            "the frequencies of {what} are from 0 to 1; state the frequencies in Hz that these are, which depend on its actuator"
        );
        inquiry.guess(Ask::FrequencyRange, &format!("{low}-{high}"), &[], text);
    }
    let unit_names: Vec<&str> = AccelerationUnit::ALL.iter().map(|unit| unit.name()).collect();
    let si = AccelerationUnit::MetersPerSecondSquared;
    if inquiry.map.full_scale.is_none() {
        let unit = inquiry.map.acceleration_unit.get_or_insert(si).name();
        let text =
            format!("{what} does not state its full scale, the acceleration of an amplitude of 1, in {unit}");
        inquiry.guess(Ask::FullScale, "1", &[], text);
    } else if inquiry.map.acceleration_unit.is_none() {
        let text = "the unit of the full scale is not stated".to_owned();
        inquiry.guess(Ask::AccelerationUnit, si.name(), &unit_names, text);
    }
    let speed = inquiry.map.constant_speed;
    if speed.is_none() {
        let text = format!("{what} has no stroke; state the tip speed of the stroke, such as \"100 mm/s\"");
        inquiry.ask(Ask::Speed, &[], text);
    }
    let force = inquiry.map.constant_force;
    if force.is_none() {
        let text = format!("{what} has no stroke; state the normal force of the stroke, such as \"1 N\"");
        inquiry.ask(Ask::Force, &[], text);
    }
    let rate_hz = *inquiry.map.rate_hz.get_or_insert(RATE_HZ);
    if !(MIN_RATE_HZ..=MAX_RATE_HZ).contains(&rate_hz) {
        let problem = format!("rate_hz is {rate_hz}, but must be from {MIN_RATE_HZ} to {MAX_RATE_HZ}");
        return Err(RecordingFileError::Map { problem });
    }
    let unit = inquiry.map.acceleration_unit.map_or(1.0, AccelerationUnit::si);
    let full_scale_mps2 = unit * inquiry.map.full_scale.unwrap_or(1.0);
    let samples_mps2 = envelope.render(Hertz(rate_hz), full_scale_mps2).map_err(|error| {
        RecordingFileError::Clip { reason: format!("{what} cannot be made into a signal: {error}") }
    })?;
    let raw = RawRecording {
        clock: RawClock::Rate(Hertz(rate_hz)),
        acceleration_mps2: vec![samples_mps2],
        motion: RawMotion::Speed(speed.map_or(RawTrack::Missing, |speed| RawTrack::Constant(speed.0))),
        force_n: force.map_or(RawTrack::Missing, |force| RawTrack::Constant(force.0)),
        full_scale_mps2: None,
    };
    inquiry.close(Some(raw), Vec::new())
}
