//! What the `.json` beside a WAV file says: ours ([`crate::wav::SidecarV1`]) or one written by hand.
//!
//! Beside `units` (of acceleration), `full_scale` and `channels` it may have `speed_unit`, `speed_full_scale`, `force_unit` and
//! `force_full_scale`; `acceleration_unit` is `units` under the name that a map has for it.

use serde::Deserialize;
use shagreen_core::units::{MetersPerSecond, Newtons};

use crate::recording::RecordingFileError;
use crate::recording::column_map::{Channel, ColumnMap};
use crate::recording::units::{AccelerationUnit, ForceUnit, SpeedUnit};
use crate::wav::{FORMAT, TraceV1, VERSION};

/// The keys that say something of the samples; what else the file holds is not ours to judge.
#[derive(Default, Deserialize)]
struct Wire {
    format: Option<String>,
    version: Option<String>,
    #[serde(alias = "acceleration_unit")]
    units: Option<String>,
    full_scale: Option<f64>,
    channels: Option<Vec<String>>,
    #[serde(alias = "speed_unit")]
    speed_units: Option<String>,
    speed_full_scale: Option<f64>,
    #[serde(alias = "force_unit")]
    force_units: Option<String>,
    force_full_scale: Option<f64>,
    speed_mm_per_s: Option<f64>,
    force_n: Option<f64>,
    trace: Option<TraceV1>,
}

/// What a sidecar adds to a map, where the map does not say otherwise; and the trace of speed and force.
pub(super) fn read_sidecar(bytes: &[u8], map: &mut ColumnMap) -> Result<Option<TraceV1>, RecordingFileError> {
    let error = |reason: String| RecordingFileError::Sidecar { reason };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let wire: Wire = serde_json::from_slice(bytes).map_err(|failure| error(failure.to_string()))?;
    if wire.format.as_deref() == Some(FORMAT) {
        let major = |version: &str| version.split('.').next().unwrap_or("").to_owned();
        let version = wire.version.unwrap_or_default();
        if major(&version) != major(VERSION) {
            return Err(error(format!("it has version {version:?}, this program reads {VERSION}")));
        }
    }
    let positive = |key: &str, value: Option<f64>| match value {
        Some(value) if !(value.is_finite() && value > 0.0) => {
            Err(error(format!("{key} is {value}, needs a number above 0")))
        }
        other => Ok(other),
    };
    let unknown = |key: &str, text: &str| error(format!("{key} is {text:?}, which is no unit that is known"));
    let unit = wire.units.map(|text| AccelerationUnit::parse(&text).ok_or_else(|| unknown("units", &text)));
    map.acceleration_unit = map.acceleration_unit.or(unit.transpose()?);
    map.full_scale = map.full_scale.or(positive("full_scale", wire.full_scale)?);
    let unit =
        wire.speed_units.map(|text| SpeedUnit::parse(&text).ok_or_else(|| unknown("speed_units", &text)));
    map.speed_unit = map.speed_unit.or(unit.transpose()?);
    map.speed_full_scale = map.speed_full_scale.or(positive("speed_full_scale", wire.speed_full_scale)?);
    let unit =
        wire.force_units.map(|text| ForceUnit::parse(&text).ok_or_else(|| unknown("force_units", &text)));
    map.force_unit = map.force_unit.or(unit.transpose()?);
    map.force_full_scale = map.force_full_scale.or(positive("force_full_scale", wire.force_full_scale)?);
    if let (None, Some(names)) = (&map.channels, wire.channels) {
        let channel = |name: &String| {
            Channel::parse(&name.to_lowercase())
                .ok_or_else(|| error(format!("the channel {name:?} is not known")))
        };
        map.channels = Some(names.iter().map(channel).collect::<Result<_, _>>()?);
    }
    // What was measured counts more than what was said, unless the map says otherwise.
    let has = |kind: Channel| map.channels.iter().flatten().any(|channel| *channel == kind);
    let (has_speed, has_force) =
        (map.speed.is_some() || has(Channel::Speed), map.force.is_some() || has(Channel::Force));
    if !has_speed {
        map.constant_speed = map.constant_speed.or(wire.speed_mm_per_s.map(MetersPerSecond::from_mm_per_s));
    }
    if !has_force {
        map.constant_force = map.constant_force.or(wire.force_n.map(Newtons));
    }
    let Some(trace) = wire.trace.filter(|trace| !trace.time_s.is_empty()) else { return Ok(None) };
    let n = trace.time_s.len();
    let ascends = trace.time_s.windows(2).all(|pair| pair[0] <= pair[1]);
    if trace.speed_mm_per_s.len() != n || trace.force_n.len() != n || !ascends {
        return Err(error("the columns of the trace differ in length, or its times go back".to_owned()));
    }
    Ok(Some(trace))
}
