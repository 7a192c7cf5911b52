//! Clips of the editor Macaron, as JSON: a duration in ms, and points of amplitude and frequency.
//!
//! ```json
//! {"duration": 3000, "parameters": {
//!   "amplitude": {"valueScale": [0, 1], "data": [{"id": 0, "t": 600, "value": 0.5}]},
//!   "frequency": {"valueScale": [50, 500], "data": [{"id": 1, "t": 0, "value": 250}]}}}
//! ```
//!
//! Times are in ms, frequencies in Hz. A downloaded file begins with the head of a data URI, which is not part of the JSON.

use std::borrow::Cow;

use serde::Deserialize;
use shagreen_core::signals::haptic_envelope::{Curve, HapticEnvelope, Law, Voice};

use crate::clip::ClipError;
use crate::haptic_maps::uri::name_of;
use crate::own_json::check_density;
use crate::parser_words::plain;

/// Longest head of a data URI, in bytes.
const MAX_HEAD: usize = 200;
/// Scale of an amplitude that states none.
const USUAL_SCALE: [f64; 2] = [0.0, 1.0];
/// Highest value of a frequency scale that is no scale in Hz.
const RELATIVE: f64 = 1.0;

#[derive(Deserialize)]
struct ClipV1 {
    duration: f64,
    parameters: ParametersV1,
}

#[derive(Deserialize)]
struct ParametersV1 {
    amplitude: ParameterV1,
    frequency: ParameterV1,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ParameterV1 {
    value_scale: Option<[f64; 2]>,
    data: Vec<PointV1>,
}

#[derive(Clone, Copy, Deserialize)]
struct PointV1 {
    t: f64,
    value: f64,
}

/// A clip that was read.
pub(super) struct MacaronEnvelope {
    pub(super) envelope: HapticEnvelope,
    pub(super) has_relative_frequencies: bool,
    pub(super) warnings: Vec<String>,
}

/// Returns bytes without a byte order mark and without the head of a data URI. The content of a copied address is decoded.
pub(super) fn without_data_uri(bytes: &[u8]) -> Cow<'_, [u8]> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !bytes.trim_ascii_start().starts_with(b"data:") {
        return Cow::Borrowed(bytes);
    }
    let head = &bytes[..bytes.len().min(MAX_HEAD)];
    if let Some(begin) = head.iter().position(|byte| *byte == b'{') {
        return Cow::Borrowed(&bytes[begin..]);
    }
    let content = head.iter().position(|byte| *byte == b',').map(|comma| &bytes[comma + 1..]);
    // Other bytes are no address.
    let decoded = content.and_then(|content| name_of(std::str::from_utf8(content).ok()?));
    decoded.map_or(Cow::Borrowed(bytes), |text| Cow::Owned(text.into_bytes()))
}

pub(super) fn envelope_of_macaron(bytes: &[u8], band_hz: [f64; 2]) -> Result<MacaronEnvelope, ClipError> {
    let damaged = |reason: String| ClipError::Macaron { reason };
    let json = without_data_uri(bytes);
    check_density(&json).map_err(|_| damaged("it has too many values for its length".to_owned()))?;
    let clip: ClipV1 = serde_json::from_slice(&json).map_err(|error| damaged(plain(&error.to_string())))?;
    if !(clip.duration.is_finite() && clip.duration > 0.0) {
        return Err(damaged(format!("`duration` is {} ms, but must be above 0", clip.duration)));
    }
    let mut reader = Reader { duration_ms: clip.duration, n_late: 0 };
    let ParametersV1 { amplitude, frequency } = clip.parameters;
    let amplitude_scale = amplitude.value_scale.unwrap_or(USUAL_SCALE);
    let level = reader.points("amplitude", amplitude.data, amplitude_scale)?;
    let scale = frequency.value_scale.unwrap_or([0.0, f64::INFINITY]);
    let tones = reader.points("frequency", frequency.data, scale)?;
    let [_, loudest] = amplitude_scale;
    let level = level.into_iter().map(|[secs, value]| [secs, value / loudest]).collect();
    let has_relative_frequencies = scale[1] <= RELATIVE;
    let range = if has_relative_frequencies { band_hz } else { [0.0, 1.0] };
    let voice = Voice {
        level: Curve::new(level, Law::Linear, [0.0, 1.0])?,
        frequency: Curve::new(tones, Law::Linear, range)?,
    };
    let warnings = reader.warnings();
    let envelope = HapticEnvelope { voices: vec![voice], bursts: Vec::new() };
    Ok(MacaronEnvelope { envelope, has_relative_frequencies, warnings })
}

struct Reader {
    duration_ms: f64,
    /// Number of points after the end.
    n_late: usize,
}

impl Reader {
    /// Times in s and values of a parameter, from the beginning to the end of the clip.
    fn points(
        &mut self,
        name: &str,
        mut data: Vec<PointV1>,
        [low, high]: [f64; 2],
    ) -> Result<Vec<[f64; 2]>, ClipError> {
        let damaged = |reason: String| ClipError::Macaron { reason };
        if !(low >= 0.0 && high > low) {
            return Err(damaged(format!(
                "`valueScale` of {name} is [{low}, {high}], but must be two numbers of at least 0, the lower one first"
            )));
        }
        for (index, PointV1 { t, value }) in data.iter().enumerate() {
            if !(t.is_finite() && *t >= 0.0) {
                return Err(damaged(format!("point {} of {name} is at {t} ms", index + 1)));
            }
            if !(low..=high).contains(value) {
                return Err(damaged(format!(
                    "point {} of {name} is {value}, outside its `valueScale` [{low}, {high}]",
                    index + 1
                )));
            }
        }
        // The editor keeps points in the order in which they were made.
        data.sort_by(|a, b| a.t.total_cmp(&b.t));
        let points: Vec<[f64; 2]> = data.iter().map(|point| [1e-3 * point.t, point.value]).collect();
        let curve = Curve::new(points, Law::Linear, USUAL_SCALE)?;
        let end_secs = 1e-3 * self.duration_ms;
        let n_within = data.partition_point(|point| 1e-3 * point.t < end_secs);
        self.n_late += data[n_within..].iter().filter(|point| point.t > self.duration_ms).count();
        let mut points = vec![[0.0, curve.at(0.0)]];
        points.extend(data[..n_within].iter().map(|point| [1e-3 * point.t, point.value]));
        points.push([end_secs, curve.at(end_secs)]);
        Ok(points)
    }

    fn warnings(&self) -> Vec<String> {
        let late = (self.n_late > 0).then(|| {
            format!(
                "the clip is cut off at its duration of {} ms; points after it: {}",
                self.duration_ms, self.n_late
            )
        });
        late.into_iter().collect()
    }
}
