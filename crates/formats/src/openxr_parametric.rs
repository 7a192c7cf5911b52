//! Points for the extension `XR_EXT_haptic_parametric` of OpenXR, in a JSON file: the arguments of one call of
//! `xrApplyHapticFeedback`, or of several that form a stream.
//!
//! Times are in ns from the start of the first call on, also in later calls. A call has at most [`MAX_POINTS`] points of each
//! kind. The first point of amplitude and of frequency is at 0, and nothing is later than the last amplitude.

use serde::{Deserialize, Serialize};

use crate::clip_head::ClipHeadV1;
use crate::clip_scale::ClipScale;
use crate::haptic_clip::{AmplitudePoint, HapticClip, USUAL_FREQUENCY};
use crate::layout;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-openxr-parametric";
/// Version of the format.
pub const VERSION: &str = "1.0";
/// Largest number of points of amplitude, of frequency and of transients in a call.
pub const MAX_POINTS: usize = 500;
/// Lowest and highest frequency that the extension accepts, in Hz.
const LIMITS_HZ: (f64, f64) = (1.0, 1000.0);
/// Levels of objects and lists that are written over several lines: one line for each point.
const OPEN_DEPTH: usize = 4;

/// A file with the calls of a signal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenXrParametricV1 {
    /// Its format is [`FORMAT`], and its version [`VERSION`].
    #[serde(flatten)]
    pub head: ClipHeadV1,
    /// Frequency in Hz of a frequency of 0: the argument `minFrequencyHz` of the first call.
    pub min_frequency_hz: f64,
    /// Frequency in Hz of a frequency of 1: the argument `maxFrequencyHz` of the first call.
    pub max_frequency_hz: f64,
    /// The calls, in order.
    pub calls: Vec<CallV1>,
}

/// Arguments of one call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CallV1 {
    /// Place of the call in the stream.
    pub frame: FrameV1,
    /// Points of amplitude.
    pub amplitude: Vec<PointV1>,
    /// Points of frequency.
    pub frequency: Vec<PointV1>,
    /// Short events.
    pub transients: Vec<TransientV1>,
}

/// Place of a call in a stream: the argument `streamFrameType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FrameV1 {
    /// The only call.
    None,
    /// The first call of a stream.
    First,
    /// A call between the first and the last.
    Intermediate,
    /// The last call of a stream.
    Last,
}

/// Point of amplitude or frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointV1 {
    /// Time in ns.
    pub time_ns: i64,
    /// Value, 0 to 1.
    pub value: f64,
}

/// Short event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TransientV1 {
    /// Time in ns.
    pub time_ns: i64,
    /// Amplitude, 0 to 1.
    pub amplitude: f64,
    /// Frequency, 0 to 1.
    pub frequency: f64,
}

/// Returns the calls of a clip that keeps the strict rules of clips and whose points have different times. `about` has the
/// program and the description of the signal.
pub fn openxr_parametric(clip: &HapticClip, scale: ClipScale, about: (&str, &str)) -> OpenXrParametricV1 {
    let [min_frequency_hz, max_frequency_hz] =
        scale.band.map(|hertz| hertz.0.clamp(LIMITS_HZ.0, LIMITS_HZ.1));
    OpenXrParametricV1 {
        head: ClipHeadV1::new((FORMAT, VERSION), about, clip.end_secs() - clip.start_secs(), scale),
        min_frequency_hz,
        max_frequency_hz,
        calls: calls(&all_points(clip)),
    }
}

/// Serializes calls as JSON.
pub fn write_openxr_parametric(calls: &OpenXrParametricV1) -> Vec<u8> {
    layout::to_bytes(calls, OPEN_DEPTH)
}

/// All points of a clip in one call.
fn all_points(clip: &HapticClip) -> CallV1 {
    let start_secs = clip.start_secs();
    let time_ns = |secs: f64| (1e9 * (secs - start_secs)).round().max(0.0) as i64;
    let point = |secs: f64, value: f64| PointV1 { time_ns: time_ns(secs), value };
    let first = clip.frequency.first().map_or(USUAL_FREQUENCY, |point| point.frequency);
    // The frequency of the start is that of the first point.
    let later = clip.frequency.iter().filter(|point| point.time_secs > start_secs);
    let frequency = std::iter::once(point(start_secs, first))
        .chain(later.map(|later| point(later.time_secs, later.frequency)));
    let transient = |point: &AmplitudePoint| {
        let emphasis = point.emphasis?;
        let time_ns = time_ns(point.time_secs);
        Some(TransientV1 { time_ns, amplitude: emphasis.amplitude, frequency: emphasis.frequency })
    };
    CallV1 {
        frame: FrameV1::None,
        amplitude: clip.amplitude.iter().map(|of| point(of.time_secs, of.amplitude)).collect(),
        frequency: frequency.collect(),
        transients: clip.amplitude.iter().filter_map(transient).collect(),
    }
}

/// Splits points into calls.
fn calls(all: &CallV1) -> Vec<CallV1> {
    let CallV1 { amplitude, frequency, transients, .. } = all;
    if [amplitude.len(), frequency.len(), transients.len()].into_iter().all(|n| n <= MAX_POINTS) {
        return vec![all.clone()];
    }
    let mut calls: Vec<CallV1> = Vec::new();
    let (mut amplitude, mut frequency, mut transients) = (&amplitude[..], &frequency[..], &transients[..]);
    let mut before = None;
    while !amplitude.is_empty() {
        let end_ns = [
            end(amplitude, |point| point.time_ns),
            end(frequency, |point| point.time_ns),
            end(transients, |transient| transient.time_ns),
        ];
        let end_ns = end_ns.into_iter().flatten().min();
        let is_first = calls.is_empty();
        let frame = match end_ns {
            None => FrameV1::Last,
            Some(_) if is_first => FrameV1::First,
            Some(_) => FrameV1::Intermediate,
        };
        let mut call = CallV1 {
            frame,
            amplitude: taken(&mut amplitude, end_ns, |point| point.time_ns),
            frequency: taken(&mut frequency, end_ns, |point| point.time_ns),
            transients: taken(&mut transients, end_ns, |transient| transient.time_ns),
        };
        // Each call has an amplitude at its end, so that nothing in it is later.
        let last = call.amplitude.last().copied().or(before);
        if let (Some(end_ns), Some(last), Some(next)) = (end_ns, last, amplitude.first())
            && last.time_ns < end_ns
        {
            call.amplitude.push(between(last, *next, end_ns));
        }
        before = call.amplitude.last().copied();
        calls.push(call);
    }
    calls
}

/// Time at which a call must end so that it has at most [`MAX_POINTS`] of these points, with room for one more; `None` if all of
/// them fit into it.
fn end<T>(points: &[T], time_ns: impl Fn(&T) -> i64) -> Option<i64> {
    if points.len() < MAX_POINTS { None } else { points.get(MAX_POINTS - 2).map(time_ns) }
}

/// Takes the points up to a time from the front of a list; all of them without a time.
fn taken<T: Clone>(points: &mut &[T], end_ns: Option<i64>, time_ns: impl Fn(&T) -> i64) -> Vec<T> {
    let n = end_ns.map_or(points.len(), |end_ns| points.partition_point(|point| time_ns(point) <= end_ns));
    let (taken, left) = points.split_at(n);
    *points = left;
    taken.to_vec()
}

/// Point of the line between two points.
fn between(from: PointV1, to: PointV1, time_ns: i64) -> PointV1 {
    let share = (time_ns - from.time_ns) as f64 / (to.time_ns - from.time_ns).max(1) as f64;
    PointV1 { time_ns, value: from.value + share * (to.value - from.value) }
}

#[cfg(test)]
mod tests;
