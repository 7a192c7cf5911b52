//! The `.json` sidecar file next to a WAV file: one of this program ([`crate::wav::SidecarV1`]), or one written by
//! hand.
//!
//! Besides `units` (of acceleration), `full_scale` and `channels` it may have `speed_unit`, `speed_full_scale`,
//! `force_unit`, `force_full_scale`, `speed_mm_per_s` and `force_n`. `acceleration_unit`, the key of a column map, is
//! an alias of `units`.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;
use shagreen_core::units::{MetersPerSecond, Newtons};

use crate::parser_words::plain;
use crate::recording::RecordingFileError;
use crate::recording::column_map::{Channel, ColumnMap};
use crate::recording::map_builder::MapBuilder;
use crate::recording::units::{AccelerationUnit, ForceUnit, SpeedUnit};
use crate::wav::{FORMAT, TraceV1, VERSION};

/// The keys that describe the samples; other keys are ignored.
#[derive(Default, Deserialize)]
struct Wire {
    format: Option<String>,
    version: Option<String>,
    #[serde(alias = "acceleration_unit")]
    units: Option<String>,
    full_scale: Option<f64>,
    channels: Option<Vec<String>>,
    rate_hz: Option<f64>,
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

/// Permitted keys of a sidecar written by hand: those of [`Wire`].
const KEYS: [&str; 16] = [
    "format",
    "version",
    "units",
    "acceleration_unit",
    "full_scale",
    "channels",
    "rate_hz",
    "speed_units",
    "speed_unit",
    "speed_full_scale",
    "force_units",
    "force_unit",
    "force_full_scale",
    "speed_mm_per_s",
    "force_n",
    "trace",
];

/// Adds the facts of a sidecar to the map unless the map states them; returns the trace of speed and force. `rate_hz`
/// is the sample rate of the WAV file.
pub(super) fn read_sidecar(
    bytes: &[u8],
    rate_hz: f64,
    inquiry: &mut MapBuilder,
) -> Result<Option<TraceV1>, RecordingFileError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let wire: Wire = serde_json::from_slice(bytes).map_err(|failure| error(plain(&failure.to_string())))?;
    if wire.format.as_deref() == Some(FORMAT) {
        let major = |version: &str| version.split('.').next().unwrap_or("").to_owned();
        let version = wire.version.unwrap_or_default();
        if major(&version) != major(VERSION) {
            return Err(error(format!("it has version {version:?}, but this program reads {VERSION}")));
        }
    } else {
        name_unknown(bytes, inquiry);
    }
    if let Some(stated) = wire.rate_hz.filter(|stated| *stated != rate_hz) {
        let text = format!("the sidecar file states {stated} Hz, the WAV file {rate_hz} Hz, which is used");
        inquiry.warnings.push(text);
    }
    settle_units(
        inquiry,
        "acceleration",
        AccelerationUnit::parse,
        AccelerationUnit::name,
        wire.units,
        |map| &mut map.acceleration_unit,
    )?;
    settle_scale(inquiry, "full_scale", wire.full_scale, |map| &mut map.full_scale)?;
    settle_units(inquiry, "speed", SpeedUnit::parse, SpeedUnit::name, wire.speed_units, |map| {
        &mut map.speed_unit
    })?;
    settle_scale(inquiry, "speed_full_scale", wire.speed_full_scale, |map| &mut map.speed_full_scale)?;
    settle_units(inquiry, "force", ForceUnit::parse, ForceUnit::name, wire.force_units, |map| {
        &mut map.force_unit
    })?;
    settle_scale(inquiry, "force_full_scale", wire.force_full_scale, |map| &mut map.force_full_scale)?;
    let channel = |name: &String| {
        Channel::parse(&name.to_lowercase()).ok_or_else(|| error(format!("the channel {name:?} is unknown")))
    };
    let channels = wire.channels.map(|names| names.iter().map(channel).collect::<Result<Vec<_>, _>>());
    let stated = inquiry.map.channels.take();
    inquiry.map.channels =
        inquiry.settle("the list of channels", stated, channels.transpose()?, |channels| {
            channels.iter().map(|channel| channel.name()).collect::<Vec<_>>().join(", ")
        });
    // A measured channel takes precedence over a stated constant, unless the map says otherwise.
    let has = |map: &ColumnMap, kind: Channel| map.channels.iter().flatten().any(|channel| *channel == kind);
    if !has(&inquiry.map, Channel::Speed) {
        let (stated, said) =
            (inquiry.map.constant_speed, wire.speed_mm_per_s.map(MetersPerSecond::from_mm_per_s));
        inquiry.map.constant_speed =
            inquiry.settle("the constant speed", stated, said, |speed| format!("{} mm/s", speed.mm_per_s()));
    }
    if !has(&inquiry.map, Channel::Force) {
        let (stated, said) = (inquiry.map.constant_force, wire.force_n.map(Newtons));
        inquiry.map.constant_force =
            inquiry.settle("the constant force", stated, said, |force| format!("{} N", force.0));
    }
    let Some(trace) = wire.trace.filter(|trace| !trace.time_s.is_empty()) else { return Ok(None) };
    let n = trace.time_s.len();
    let ascends = trace.time_s.windows(2).all(|pair| pair[0] <= pair[1]);
    if trace.speed_mm_per_s.len() != n || trace.force_n.len() != n || !ascends {
        return Err(error("the columns of the trace differ in length, or its times decrease".to_owned()));
    }
    Ok(Some(trace))
}

fn error(reason: String) -> RecordingFileError {
    RecordingFileError::Sidecar { reason }
}

/// Warns about unknown keys in a sidecar written by hand, because they may be misspelled.
fn name_unknown(bytes: &[u8], inquiry: &mut MapBuilder) {
    #[expect(clippy::zero_sized_map_values, reason = "serde_json reads an object as a map only")]
    // A list has no keys, so it raises no warning.
    let keys: BTreeMap<String, IgnoredAny> = serde_json::from_slice(bytes).unwrap_or_default();
    let unknown: Vec<String> =
        keys.keys().filter(|key| !KEYS.contains(&key.as_str())).map(|key| format!("{key:?}")).collect();
    if !unknown.is_empty() {
        let text = format!(
            "the sidecar file has unknown keys, which are ignored: {}; known keys are {}",
            unknown.join(", "),
            KEYS.join(", ")
        );
        inquiry.warnings.push(text);
    }
}

/// The unit of a quantity, from the map or the sidecar.
fn settle_units<T: Copy + PartialEq>(
    inquiry: &mut MapBuilder,
    what: &str,
    parse: impl Fn(&str) -> Option<T>,
    name: impl Fn(T) -> &'static str,
    text: Option<String>,
    slot: impl Fn(&mut ColumnMap) -> &mut Option<T>,
) -> Result<(), RecordingFileError> {
    let unknown = |text: &str| error(format!("the unit of {what} is {text:?}, which is not a known unit"));
    let unit = text.map(|text| parse(&text).ok_or_else(|| unknown(&text))).transpose()?;
    let stated = *slot(&mut inquiry.map);
    let settled = inquiry.settle(&format!("the unit of {what}"), stated, unit, |unit| name(*unit).to_owned());
    *slot(&mut inquiry.map) = settled;
    Ok(())
}

/// A full scale, from the map or the sidecar.
fn settle_scale(
    inquiry: &mut MapBuilder,
    key: &str,
    value: Option<f64>,
    slot: impl Fn(&mut ColumnMap) -> &mut Option<f64>,
) -> Result<(), RecordingFileError> {
    if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
        return Err(error(format!("{key} is {value}, but must be a number above 0")));
    }
    let stated = *slot(&mut inquiry.map);
    let settled = inquiry.settle(key, stated, value, f64::to_string);
    *slot(&mut inquiry.map) = settled;
    Ok(())
}
