//! The envelope of an AHAP pattern.
//!
//! The rules are those by which [`crate::ahap::of_clip`] writes patterns: the amplitude is the square of the intensity, and the
//! frequency of a continuous event is the square of its sharpness, from 0 to 1 in the band. That of a transient is its
//! sharpness.

use shagreen_core::signals::haptic_envelope::{BURST_DECAY_SECS, Burst, Curve, HapticEnvelope, Law, Voice};
use shagreen_core::units::Hertz;
use shagreen_core::words::counted;

use crate::ahap::{AhapEvent, AhapEventKind, AhapPattern, ControlId, EventParameterId};
use crate::clip::ClipError;
use crate::imported::Imported;

/// Intensity and sharpness of an event that states none.
const USUAL_INTENSITY: f64 = 1.0;
const USUAL_SHARPNESS: f64 = 0.5;
/// Largest number of points of all voices: more would take far more memory than the file.
const MAX_POINTS: usize = 500_000;
/// Parameters and controls of the course of an event, which have no effect here.
const COURSE: [EventParameterId; 3] =
    [EventParameterId::AttackTime, EventParameterId::DecayTime, EventParameterId::ReleaseTime];
const COURSE_CONTROLS: [ControlId; 3] = [
    ControlId::HapticAttackTimeControl,
    ControlId::HapticDecayTimeControl,
    ControlId::HapticReleaseTimeControl,
];

/// Returns the vibration of a pattern. Sounds are left out. Attack, decay and release times have no effect, and events that are
/// not sustained keep their level; warnings say so.
pub(super) fn envelope_of_pattern(
    pattern: &AhapPattern,
    band_hz: [f64; 2],
) -> Result<Imported<HapticEnvelope>, ClipError> {
    let intensity = control_points(pattern, ControlId::HapticIntensityControl);
    let sharpness = control_points(pattern, ControlId::HapticSharpnessControl);
    let [low_hz, high_hz] = band_hz;
    let mut envelope = HapticEnvelope::default();
    let (mut n_points, mut n_sounds, mut n_courses) = (0, 0, 0);
    for event in &pattern.events {
        let from_secs = event.time_secs;
        let strength = event.value(EventParameterId::HapticIntensity).unwrap_or(USUAL_INTENSITY);
        let own = event.value(EventParameterId::HapticSharpness).unwrap_or(USUAL_SHARPNESS);
        let tone = |control: f64| (own + control).clamp(0.0, 1.0);
        n_courses += usize::from(has_course(event));
        match event.kind {
            AhapEventKind::AudioContinuous | AhapEventKind::AudioCustom => n_sounds += 1,
            AhapEventKind::HapticTransient => envelope.bursts.push(Burst {
                start_secs: from_secs,
                amplitude: (strength * value_at(&intensity, from_secs)).powi(2),
                frequency: Hertz(low_hz + tone(value_at(&sharpness, from_secs)) * (high_hz - low_hz)),
                decay_secs: BURST_DECAY_SECS,
            }),
            AhapEventKind::HapticContinuous => {
                let during = [from_secs, from_secs + event.duration_secs];
                let level = within(&intensity, during, |control| strength * control);
                let tone = within(&sharpness, during, tone);
                n_points += level.len() + tone.len();
                if n_points > MAX_POINTS {
                    return Err(ClipError::TooManyPoints { most: MAX_POINTS });
                }
                envelope.voices.push(Voice {
                    level: Curve::new(level, Law::Squared, [0.0, 1.0])?,
                    frequency: Curve::new(tone, Law::Squared, band_hz)?,
                });
            }
        }
    }
    let mut warnings = Vec::new();
    if n_sounds > 0 {
        let are = if n_sounds == 1 { "is" } else { "are" };
        warnings.push(format!("{} {are} left out: only vibration is read", counted(n_sounds, "audio event")));
    }
    if n_courses > 0 {
        let have = if n_courses == 1 { "has" } else { "have" };
        let events = counted(n_courses, "event");
        warnings.push(format!(
            "{events} {have} attack, decay or release times or no sustained level, which are not applied"
        ));
    }
    let mut controls =
        pattern.curves.iter().map(|curve| curve.id).chain(pattern.parameters.iter().map(|p| p.id));
    if controls.any(|id| COURSE_CONTROLS.contains(&id)) {
        warnings.push("controls of attack, decay or release times are not applied".to_owned());
    }
    Ok(Imported { value: envelope, warnings })
}

fn has_course(event: &AhapEvent) -> bool {
    let has_times = COURSE.into_iter().any(|id| event.value(id).is_some_and(|value| value > 0.0));
    has_times || event.value(EventParameterId::Sustained).is_some_and(|value| value < 1.0)
}

/// Points of a control over the time of the pattern: times in s, ascending, and values. Of overlapping curves, the one that
/// begins later counts.
fn control_points(pattern: &AhapPattern, id: ControlId) -> Vec<[f64; 2]> {
    let of_curves = pattern.curves.iter().filter(|curve| curve.id == id).map(|curve| {
        let points = curve.points.iter().map(|point| [curve.time_secs + point.time_secs, point.value]);
        points.collect::<Vec<_>>()
    });
    let single = pattern.parameters.iter().filter(|parameter| parameter.id == id);
    let of_parameters = single.map(|parameter| vec![[parameter.time_secs, parameter.value]]);
    let mut parts: Vec<Vec<[f64; 2]>> = of_curves.chain(of_parameters).collect();
    parts.retain(|part| !part.is_empty());
    parts.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]));
    let mut points = vec![[0.0, id.neutral()]];
    for part in parts {
        let from_secs = part[0][0];
        let before = value_at(&points, from_secs);
        points.truncate(points.partition_point(|[secs, _]| *secs <= from_secs));
        points.push([from_secs, before]);
        points.extend(part);
    }
    points
}

/// Value at a time, linear between points, and held before the first and after the last one.
fn value_at(points: &[[f64; 2]], secs: f64) -> f64 {
    let next = points.partition_point(|[time, _]| *time <= secs);
    let before = next.checked_sub(1).and_then(|before| points.get(before));
    match (before, points.get(next)) {
        (Some([from_secs, from]), Some([to_secs, to])) => {
            from + (secs - from_secs) / (to_secs - from_secs) * (to - from)
        }
        (Some([_, value]), None) | (None, Some([_, value])) => *value,
        (None, None) => 0.0,
    }
}

/// Points of a control during an event, each with a changed value.
fn within(points: &[[f64; 2]], [from_secs, to_secs]: [f64; 2], change: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let first = points.partition_point(|[secs, _]| *secs <= from_secs);
    let last = points.partition_point(|[secs, _]| *secs <= to_secs).max(first);
    let mut within = vec![[from_secs, change(value_at(points, from_secs))]];
    within.extend(points[first..last].iter().map(|[secs, value]| [*secs, change(*value)]));
    within.push([to_secs, change(value_at(points, to_secs))]);
    within
}
