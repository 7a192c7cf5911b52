//! A `.haptic` clip as AHAP patterns.
//!
//! Intensity is the root of the amplitude, and sharpness the root of the frequency; at an emphasis, the continuous intensity is
//! reduced to [`DUCKED`]. Clips that were exported by the tool of the clip format show these rules, and tests compare with such
//! files.

use super::parameter_ids::{ControlId, EventParameterId};
use super::{
    AhapEvent, AhapEventKind, AhapPattern, ControlPoint, MAX_CURVE_POINTS, MAX_EVENT_SECS, ParameterCurve,
};
use crate::haptic_clip::{HapticClip, USUAL_FREQUENCY};

/// Factor of the continuous intensity at an emphasis.
pub const DUCKED: f64 = 0.8;

/// The two patterns of a clip, which are played at the same time.
#[derive(Clone, Debug, PartialEq)]
pub struct AhapPair {
    /// Continuous vibration, with its curves.
    pub continuous: AhapPattern,
    /// Emphases; `None` if the clip has none. They have a pattern of their own, because curves act on all events of a pattern.
    pub transients: Option<AhapPattern>,
}

/// Returns the patterns of a clip that keeps the rules of clips.
pub fn ahap_of_clip(clip: &HapticClip) -> AhapPair {
    let amplitudes = clip.amplitude.iter().map(|point| {
        let factor = if point.emphasis.is_some() { DUCKED } else { 1.0 };
        (point.time_secs, factor * point.amplitude.sqrt())
    });
    let mut all_curves = curves(ControlId::HapticIntensityControl, &amplitudes.collect::<Vec<_>>());
    let (start_secs, end_secs) = (clip.start_secs(), clip.end_secs());
    let mut frequencies: Vec<(f64, f64)> =
        clip.frequency.iter().map(|point| (point.time_secs, point.frequency.sqrt())).collect();
    // Before a curve begins, its control is neutral, whereas a clip holds its first frequency.
    if let Some((_, first)) = frequencies.first().copied().filter(|(secs, _)| *secs > start_secs) {
        frequencies.insert(0, (start_secs, first));
    }
    all_curves.extend(curves(ControlId::HapticSharpnessControl, &frequencies));
    let sharpness = if frequencies.is_empty() { USUAL_FREQUENCY.sqrt() } else { 0.0 };
    let continuous = AhapPattern {
        events: continuous_events(start_secs, end_secs, sharpness),
        curves: all_curves,
        parameters: Vec::new(),
    };
    let emphases: Vec<AhapEvent> = clip
        .amplitude
        .iter()
        .filter_map(|point| {
            let emphasis = point.emphasis?;
            Some(AhapEvent {
                kind: AhapEventKind::HapticTransient,
                time_secs: point.time_secs,
                duration_secs: 0.0,
                parameters: vec![
                    (EventParameterId::HapticIntensity, emphasis.amplitude.sqrt()),
                    (EventParameterId::HapticSharpness, emphasis.frequency),
                ],
            })
        })
        .collect();
    let transients =
        (!emphases.is_empty()).then_some(AhapPattern { events: emphases, ..AhapPattern::default() });
    AhapPair { continuous, transients }
}

/// Events of full intensity from one time to another, none of them longer than [`MAX_EVENT_SECS`].
fn continuous_events(start_secs: f64, end_secs: f64, sharpness: f64) -> Vec<AhapEvent> {
    let n = ((end_secs - start_secs) / MAX_EVENT_SECS).ceil().max(1.0) as usize;
    let event = |index: usize| {
        let time_secs = start_secs + MAX_EVENT_SECS * index as f64;
        AhapEvent {
            kind: AhapEventKind::HapticContinuous,
            time_secs,
            duration_secs: (end_secs - time_secs).clamp(0.0, MAX_EVENT_SECS),
            parameters: vec![
                (EventParameterId::HapticIntensity, 1.0),
                (EventParameterId::HapticSharpness, sharpness),
            ],
        }
    };
    (0..n).map(event).collect()
}

/// Curves through points of a time in s and a value, each of at most [`MAX_CURVE_POINTS`]: the last point of a curve is the
/// first one of the next. Times of points count from the start of their curve.
fn curves(id: ControlId, points: &[(f64, f64)]) -> Vec<ParameterCurve> {
    let mut curves = Vec::new();
    let mut first = 0;
    while let Some((time_secs, _)) = points.get(first).copied() {
        let last = (first + MAX_CURVE_POINTS - 1).min(points.len() - 1);
        let point = |(secs, value): &(f64, f64)| ControlPoint { time_secs: secs - time_secs, value: *value };
        curves.push(ParameterCurve {
            id,
            time_secs,
            points: points[first..=last].iter().map(point).collect(),
        });
        // A curve of only the shared point would add nothing.
        first = if last + 1 < points.len() { last } else { points.len() };
    }
    curves
}
