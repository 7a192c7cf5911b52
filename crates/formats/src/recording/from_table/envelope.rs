//! Tables of an envelope: time, amplitude and frequency, as design tools for haptic signals export them.

use shagreen_core::signals::haptic_envelope::{
    Curve, EnvelopeError, HapticEnvelope, Law, MAX_SECS, USUAL_BAND_HZ, Voice,
};

use crate::recording::from_clip::recording_of_envelope;
use crate::recording::from_table::Reading;
use crate::recording::infer_units::largest;
use crate::recording::names::{Meaning, time_unit_in};
use crate::recording::question::Ask;
use crate::recording::units::{AccelerationUnit, TimeUnit, letters};
use crate::recording::{RecordingFile, RecordingFileError};

/// Name of such a table in messages.
const WHAT: &str = "the table of an envelope";
/// Words for the two quantities, without their units.
const AMPLITUDES: [&str; 3] = ["amplitude", "amp", "intensity"];
const FREQUENCIES: [&str; 2] = ["frequency", "freq"];
/// Unit of a frequency, in lower case.
const HERTZ: &str = "hz";

/// Columns of an envelope, by their places.
pub(super) struct EnvelopeColumns {
    time: usize,
    amplitude: usize,
    /// Unit of the amplitude; without one, it is from 0 to 1.
    unit: Option<AccelerationUnit>,
    frequency: usize,
    /// Whether the name of the frequency states Hz.
    is_hertz: bool,
}

impl Reading {
    /// Columns of an envelope; `None` if the table is another one. A table with acceleration, or whose map names its columns,
    /// is another one.
    pub(super) fn envelope_columns(&self) -> Option<EnvelopeColumns> {
        let map = &self.inquiry.map;
        let is_named = map.acceleration.is_some() || map.speed.is_some() || map.positions.is_some();
        let has_acceleration = !self.meant(|meaning| matches!(meaning, Meaning::Acceleration(_))).is_empty();
        if is_named || has_acceleration || !self.table.header {
            return None;
        }
        let times = self.meant(|meaning| matches!(meaning, Meaning::Time(_)));
        let named = map.time.clone().and_then(|column| self.place(&column).ok()); // A wrong name is reported by other tables.
        let find = |words: &[&str], is_unit: &dyn Fn(&str) -> bool| {
            self.table.names.iter().enumerate().find_map(|(place, name)| {
                let unit = unit_after(name, words)?;
                (unit.is_empty() || is_unit(&unit)).then_some((place, unit))
            })
        };
        let (amplitude, unit) = find(&AMPLITUDES, &|unit| AccelerationUnit::parse(unit).is_some())?;
        let (frequency, hertz) = find(&FREQUENCIES, &|unit| unit == HERTZ)?;
        Some(EnvelopeColumns {
            time: named.or(times.first().copied())?,
            amplitude,
            unit: AccelerationUnit::parse(&unit),
            frequency,
            is_hertz: !hertz.is_empty(),
        })
    }

    /// Converts an envelope to a recording.
    pub(super) fn envelope(mut self, columns: &EnvelopeColumns) -> Result<RecordingFile, RecordingFileError> {
        let names = [columns.amplitude, columns.frequency].map(|place| self.table.names[place].clone());
        let [amplitude_name, frequency_name] = names;
        let time_si = self.envelope_time_unit(columns.time).si();
        self.inquiry.map.time = Some(self.column(columns.time));
        let times = self.take(columns.time, time_si)?;
        let amplitudes = self.take(columns.amplitude, 1.0)?;
        let frequencies = self.take(columns.frequency, 1.0)?;
        let full_scale = self.envelope_scale(&amplitude_name, &amplitudes, columns.unit)?;
        let is_relative = !columns.is_hertz && largest(&frequencies) <= 1.0;
        if let Some(lowest) = frequencies.iter().copied().find(|hz| *hz < 0.0) {
            let reason = format!(
                "the column {frequency_name:?} has the value {lowest}; frequencies are at least 0: correct it"
            );
            return Err(RecordingFileError::Clip { reason });
        }
        let start_secs = times.iter().copied().find(|secs| secs.is_finite()).unwrap_or(0.0);
        let points = |values: &[f64], scale: f64| -> Vec<[f64; 2]> {
            let rows = times.iter().zip(values).map(|(secs, value)| [secs - start_secs, value / scale]);
            // Missing values are those of a straight line between the others.
            rows.filter(|[secs, value]| secs.is_finite() && value.is_finite()).collect()
        };
        let range = match (is_relative, self.inquiry.map.frequency_range_hz) {
            (true, Some(range)) => range,
            (true, None) => USUAL_BAND_HZ,
            (false, _) => [0.0, 1.0],
        };
        let voice =
            voice_of(points(&amplitudes, full_scale), points(&frequencies, 1.0), range).map_err(|error| {
                RecordingFileError::Clip { reason: format!("{WHAT} cannot be read: {error}") }
            })?;
        self.name_unused();
        self.state_dialect();
        let envelope = HapticEnvelope { voices: vec![voice], bursts: Vec::new() };
        recording_of_envelope(self.inquiry, &envelope, WHAT, is_relative)
    }

    /// Unit of the times, which have other steps than those of samples: that of the name, else the one in which the envelope is
    /// not too long.
    fn envelope_time_unit(&mut self, place: usize) -> TimeUnit {
        let by_name = match self.meanings[place] {
            Some(Meaning::Time(unit)) => unit,
            _ => time_unit_in(&self.table.names[place]),
        };
        if let Some(unit) = self.inquiry.map.time_unit.or(by_name) {
            self.inquiry.map.time_unit = Some(unit);
            return unit;
        }
        let longest = largest(&self.table.columns[place]);
        let unit = if longest <= MAX_SECS { TimeUnit::Seconds } else { TimeUnit::Milliseconds };
        let names: Vec<&str> = TimeUnit::ALL.iter().map(|unit| unit.name()).collect();
        let text =
            format!("the unit of {} is not stated; the last time is {longest}", self.table.names[place]);
        self.inquiry.guess(Ask::TimeUnit, unit.name(), &names, text);
        unit
    }

    /// Amplitude that is 1 in the envelope. If the column has a unit, it is the highest one, and the map states it.
    fn envelope_scale(
        &mut self,
        name: &str,
        amplitudes: &[f64],
        unit: Option<AccelerationUnit>,
    ) -> Result<f64, RecordingFileError> {
        if amplitudes.iter().any(|amplitude| *amplitude < 0.0) {
            let reason = format!(
                "the column {name:?} has negative values, so that it is a waveform and not an envelope; name it as acceleration in the column map: acceleration={name:?}"
            );
            return Err(RecordingFileError::Clip { reason });
        }
        let highest = largest(amplitudes);
        let Some(unit) = unit else {
            if highest > 1.0 {
                let reason = format!(
                    "the column {name:?} has the value {highest}, but amplitudes without a unit are from 0 to 1; divide them, or state their unit in the header, as in \"amplitude [m/s^2]\""
                );
                return Err(RecordingFileError::Clip { reason });
            }
            return Ok(1.0);
        };
        let scale = if highest > 0.0 { highest } else { 1.0 };
        let by_map = self.inquiry.map.acceleration_unit;
        let name_of = |unit: &AccelerationUnit| unit.name().to_owned();
        self.inquiry.map.acceleration_unit =
            self.inquiry.settle("the unit of the amplitude", by_map, Some(unit), name_of);
        self.inquiry.map.full_scale = Some(scale);
        Ok(scale)
    }
}

fn voice_of(level: Vec<[f64; 2]>, frequency: Vec<[f64; 2]>, range: [f64; 2]) -> Result<Voice, EnvelopeError> {
    Ok(Voice {
        level: Curve::new(level, Law::Linear, [0.0, 1.0])?,
        frequency: Curve::new(frequency, Law::Linear, range)?,
    })
}

/// Letters of a column name after one of these words; `None` if it begins with none of them.
fn unit_after(name: &str, words: &[&str]) -> Option<String> {
    let name = letters(name);
    words.iter().find_map(|word| name.strip_prefix(word).map(str::to_owned))
}
