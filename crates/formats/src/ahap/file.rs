//! The fields of an AHAP file, and the checks of what they contain.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::parameter_ids::{ControlId, EventParameterId};
use super::{
    AhapError, AhapEvent, AhapEventKind, AhapPattern, ControlPoint, DynamicParameter, MAX_EVENT_SECS,
    ParameterCurve,
};
use crate::first_faults::FirstFaults;
use crate::imported::Imported;
use crate::text_limits::begin_of;

/// Version of the files.
const VERSION: f64 = 1.0;
/// Longest part of a foreign text in a message, in characters.
const SHOWN: usize = 40;

/// A whole file.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
pub(super) struct PatternFileV1 {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    version: Option<f64>,
    #[serde(default, skip_deserializing)]
    metadata: MetadataV1,
    pattern: Vec<EntryV1>,
}

#[derive(Default, Serialize)]
#[serde(rename_all = "PascalCase")]
struct MetadataV1 {
    description: String,
}

/// An entry of the list, which has one of the fields. They are boxed, because a file of empty entries would take a hundred times
/// its length in memory.
#[derive(Default, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
struct EntryV1 {
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<Box<EventV1>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter: Option<Box<DynamicV1>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter_curve: Option<Box<CurveV1>>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct EventV1 {
    #[serde(default)]
    time: f64,
    event_type: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    event_duration: Option<f64>,
    #[serde(default)]
    event_parameters: Vec<ParameterV1>,
    #[serde(default, skip_serializing)]
    event_waveform_path: Option<String>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct ParameterV1 {
    #[serde(rename = "ParameterID")]
    id: String,
    #[serde(default)]
    parameter_value: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct DynamicV1 {
    #[serde(rename = "ParameterID")]
    id: String,
    #[serde(default)]
    time: f64,
    #[serde(default)]
    parameter_value: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct CurveV1 {
    #[serde(rename = "ParameterID")]
    id: String,
    #[serde(default)]
    time: f64,
    #[serde(default)]
    parameter_curve_control_points: Vec<PointV1>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct PointV1 {
    #[serde(default)]
    time: f64,
    #[serde(default)]
    parameter_value: f64,
}

impl PatternFileV1 {
    pub(super) fn of(pattern: &AhapPattern, description: &str) -> Self {
        let event = |event: &AhapEvent| {
            // A duration of a tap has no meaning, but stays if a file states it.
            let has_duration = event.kind.lasts() || event.duration_secs > 0.0;
            let parameter = |(id, value): &(EventParameterId, f64)| ParameterV1 {
                id: id.name().to_owned(),
                parameter_value: *value,
            };
            let event = EventV1 {
                time: event.time_secs,
                event_type: event.kind.name().to_owned(),
                event_duration: has_duration.then_some(event.duration_secs),
                event_parameters: event.parameters.iter().map(parameter).collect(),
                event_waveform_path: None,
            };
            EntryV1 { event: Some(Box::new(event)), ..EntryV1::default() }
        };
        let dynamic = |parameter: &DynamicParameter| {
            let id = parameter.id.name().to_owned();
            let parameter = DynamicV1 { id, time: parameter.time_secs, parameter_value: parameter.value };
            EntryV1 { parameter: Some(Box::new(parameter)), ..EntryV1::default() }
        };
        let curve = |curve: &ParameterCurve| {
            let point =
                |point: &ControlPoint| PointV1 { time: point.time_secs, parameter_value: point.value };
            let curve = CurveV1 {
                id: curve.id.name().to_owned(),
                time: curve.time_secs,
                parameter_curve_control_points: curve.points.iter().map(point).collect(),
            };
            EntryV1 { parameter_curve: Some(Box::new(curve)), ..EntryV1::default() }
        };
        let curves = pattern.curves.iter().map(curve);
        let parameters = pattern.parameters.iter().map(dynamic);
        Self {
            version: Some(VERSION),
            metadata: MetadataV1 { description: description.to_owned() },
            pattern: curves.chain(parameters).chain(pattern.events.iter().map(event)).collect(),
        }
    }

    /// Checks the file and returns its valid entries, and the faults of the others.
    pub(super) fn pattern(self) -> Result<(Imported<AhapPattern>, FirstFaults<AhapError>), AhapError> {
        if let Some(version) = self.version.filter(|version| !(VERSION..VERSION + 1.0).contains(version)) {
            return Err(AhapError::Version { version });
        }
        let (mut pattern, mut reader) = (AhapPattern::default(), Reader::default());
        let mut faults = FirstFaults::default();
        for (index, entry) in self.pattern.into_iter().enumerate() {
            reader.number = index + 1;
            reader.entry(entry, &mut pattern).unwrap_or_else(|fault| faults.add(fault));
        }
        Ok((Imported { value: pattern, warnings: reader.warnings() }, faults))
    }
}

/// Reads entries, and counts what deserves a warning: a file may have thousands of entries.
#[derive(Default)]
struct Reader {
    /// Number of the present entry.
    number: usize,
    n_clamped: usize,
    n_long: usize,
    n_without_end: usize,
    n_sounds: usize,
    n_empty: usize,
    /// Unknown names of parameters, each once.
    unknown: Vec<String>,
    /// Number of the first curve whose times seem to be counted from the start of the pattern.
    absolute: Option<usize>,
}

/// Largest number of unknown names in a warning.
const MAX_UNKNOWN: usize = 5;

impl Reader {
    /// Adds an entry to a pattern.
    fn entry(&mut self, entry: EntryV1, pattern: &mut AhapPattern) -> Result<(), AhapError> {
        match (entry.event, entry.parameter, entry.parameter_curve) {
            (Some(event), None, None) => pattern.events.push(self.event(*event)?),
            (None, Some(parameter), None) => pattern.parameters.extend(self.dynamic(&parameter)?),
            (None, None, Some(curve)) => pattern.curves.extend(self.curve(*curve)?),
            _ => return Err(AhapError::Entry { number: self.number }),
        }
        Ok(())
    }

    fn event(&mut self, event: EventV1) -> Result<AhapEvent, AhapError> {
        let number = self.number;
        let Some(kind) = AhapEventKind::of(&event.event_type) else {
            return Err(AhapError::Kind { number, kind: begin_of(event.event_type, SHOWN) });
        };
        let time_secs = self.time(event.time)?;
        let duration_secs = self.time(event.event_duration.unwrap_or(0.0))?;
        self.n_long += usize::from(kind.lasts() && duration_secs > MAX_EVENT_SECS);
        self.n_without_end += usize::from(kind.lasts() && duration_secs == 0.0);
        self.n_sounds += usize::from(event.event_waveform_path.is_some());
        let mut parameters = Vec::new();
        for ParameterV1 { id, parameter_value } in event.event_parameters {
            if let Some(known) = EventParameterId::of(&id) {
                parameters.push((known, self.clamped(parameter_value, &known.range())));
            } else {
                self.note_unknown(id);
            }
        }
        Ok(AhapEvent { kind, time_secs, duration_secs, parameters })
    }

    fn dynamic(&mut self, parameter: &DynamicV1) -> Result<Option<DynamicParameter>, AhapError> {
        let Some(id) = ControlId::of(&parameter.id) else {
            self.note_unknown(parameter.id.clone());
            return Ok(None);
        };
        let value = self.clamped(parameter.parameter_value, &id.range());
        Ok(Some(DynamicParameter { id, time_secs: self.time(parameter.time)?, value }))
    }

    fn curve(&mut self, curve: CurveV1) -> Result<Option<ParameterCurve>, AhapError> {
        let Some(id) = ControlId::of(&curve.id) else {
            self.note_unknown(curve.id);
            return Ok(None);
        };
        let time_secs = self.time(curve.time)?;
        let mut points = Vec::with_capacity(curve.parameter_curve_control_points.len());
        let mut previous_secs = 0.0;
        for (index, PointV1 { time, parameter_value }) in
            curve.parameter_curve_control_points.into_iter().enumerate()
        {
            let secs = self.time(time)?;
            if secs < previous_secs {
                return Err(AhapError::Order { number: self.number, point: index + 1, secs });
            }
            previous_secs = secs;
            points.push(ControlPoint { time_secs: secs, value: self.clamped(parameter_value, &id.range()) });
        }
        let Some(first) = points.first() else {
            self.n_empty += 1;
            return Ok(None);
        };
        // Points that begin where the curve begins in the pattern: exporters are known to write absolute times.
        if time_secs > 0.0 && first.time_secs >= time_secs {
            self.absolute = self.absolute.or(Some(self.number));
        }
        Ok(Some(ParameterCurve { id, time_secs, points }))
    }

    fn time(&self, secs: f64) -> Result<f64, AhapError> {
        let is_valid = secs.is_finite() && secs >= 0.0;
        if is_valid { Ok(secs) } else { Err(AhapError::Time { number: self.number, secs }) }
    }

    fn clamped(&mut self, value: f64, range: &RangeInclusive<f64>) -> f64 {
        self.n_clamped += usize::from(!range.contains(&value));
        value.clamp(*range.start(), *range.end())
    }

    fn note_unknown(&mut self, id: String) {
        let id = begin_of(id, SHOWN);
        if self.unknown.len() < MAX_UNKNOWN && !self.unknown.contains(&id) {
            self.unknown.push(id);
        }
    }

    fn warnings(self) -> Vec<String> {
        let counted = |n: usize, one: &str, more: &str| match n {
            0 => None,
            1 => Some(format!("1 {one}")),
            n => Some(format!("{n} {more}")),
        };
        let unknown = (!self.unknown.is_empty())
            .then(|| format!("unknown parameters are ignored: {}", self.unknown.join(", ")));
        let absolute = self.absolute.map(|number| {
            format!(
                "the times of the curve in entry {number} seem to be counted from the start of the pattern; they are read as times from the start of the curve, as players do"
            )
        });
        let all = [
            counted(
                self.n_clamped,
                "value is outside its range and was clamped",
                "values are outside their ranges and were clamped",
            ),
            counted(
                self.n_long,
                "event lasts longer than 30 s, which players cut",
                "events last longer than 30 s, which players cut",
            ),
            counted(
                self.n_without_end,
                "continuous event has no duration and is not played",
                "continuous events have no duration and are not played",
            ),
            counted(
                self.n_sounds,
                "event names a sound file, which is ignored",
                "events name a sound file, which is ignored",
            ),
            counted(
                self.n_empty,
                "curve has no points and is ignored",
                "curves have no points and are ignored",
            ),
            unknown,
            absolute,
        ];
        all.into_iter().flatten().collect()
    }
}

impl AhapEventKind {
    const ALL: [Self; 4] =
        [Self::HapticTransient, Self::HapticContinuous, Self::AudioContinuous, Self::AudioCustom];

    fn name(self) -> &'static str {
        match self {
            Self::HapticTransient => "HapticTransient",
            Self::HapticContinuous => "HapticContinuous",
            Self::AudioContinuous => "AudioContinuous",
            Self::AudioCustom => "AudioCustom",
        }
    }

    fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether the event has a duration.
    fn lasts(self) -> bool {
        matches!(self, Self::HapticContinuous | Self::AudioContinuous)
    }
}
