//! The rules of `.haptic` clips, and what an error says about them.

use std::fmt;

use super::{AmplitudePoint, HapticClip, MAX_CLIP_SECS};
use crate::first_faults::FirstFaults;

/// How strictly a clip is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClipRules {
    /// All rules.
    Strict,
    /// All rules, except that points of the frequency envelope may lie outside the times of the amplitude envelope, as in clips
    /// of old editors.
    Legacy,
}

/// A point of a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipPlace {
    /// `amplitude` or `frequency`.
    pub envelope: &'static str,
    /// Number of the point in its envelope, the first 1.
    pub number: usize,
}

impl fmt::Display for ClipPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "point {} of the {} envelope", self.number, self.envelope)
    }
}

/// Why bytes are no clip.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HapticClipError {
    /// The bytes are not JSON, or fields are missing.
    #[error("the file is not a .haptic clip: {0}. Export the clip again")]
    Json(String),
    /// The file has more values than a clip of its length.
    #[error(
        "the file is not a .haptic clip: it has too many values for its {n_bytes} bytes. Export the clip again"
    )]
    TooDense {
        /// Length of the file in bytes.
        n_bytes: usize,
    },
    /// Another version.
    #[error("the clip has version {major}, but only version 1 can be read; export it as version 1")]
    Version {
        /// Major version of the file.
        major: u32,
    },
    /// The amplitude envelope is no curve.
    #[error("the amplitude envelope has {n} points, but needs at least two; add points")]
    TooFewPoints {
        /// Number of its points.
        n: usize,
    },
    /// A time is negative, later than [`MAX_CLIP_SECS`], or not finite.
    #[error("{place}: the time is {secs} s, but must be from 0 to {MAX_CLIP_SECS} s; correct it")]
    Time {
        /// The point.
        place: ClipPlace,
        /// Its time in s.
        secs: f64,
    },
    /// A point is earlier than the one before it.
    #[error("{place}: the time is {secs} s, which is before the previous point; sort the points by time")]
    Order {
        /// The point.
        place: ClipPlace,
        /// Its time in s.
        secs: f64,
    },
    /// A value is not from 0 to 1.
    #[error("{place}: the {what} is {value}, but must be from 0 to 1; correct it")]
    Range {
        /// The point.
        place: ClipPlace,
        /// The value's name.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// An emphasis is weaker than the envelope.
    #[error(
        "{place}: the amplitude of the emphasis is {emphasis}, below the amplitude of the point, {amplitude}; raise it, or remove the emphasis"
    )]
    WeakEmphasis {
        /// The point.
        place: ClipPlace,
        /// Amplitude of the emphasis.
        emphasis: f64,
        /// Amplitude of the point.
        amplitude: f64,
    },
    /// All points of the amplitude envelope have the same time.
    #[error("the clip has no duration: all points of the amplitude envelope are at {secs} s; spread them")]
    NoDuration {
        /// The time in s.
        secs: f64,
    },
    /// A point of the frequency envelope lies outside the times of the amplitude envelope.
    #[error(
        "{place}: the time is {secs} s, but the amplitude envelope lasts from {start_secs} to {end_secs} s; move the point into it"
    )]
    FrequencyOutside {
        /// The point.
        place: ClipPlace,
        /// Its time in s.
        secs: f64,
        /// First time of the amplitude envelope in s.
        start_secs: f64,
        /// Last time of the amplitude envelope in s.
        end_secs: f64,
    },
}

/// Returns the broken rules; of the values of a point, the first one. Numbers are compared in 32 bits, as players hold them:
/// editors write ends of envelopes, and sums such as 0.7 + 0.3, with different rounding.
pub(super) fn check(clip: &HapticClip, rules: ClipRules) -> FirstFaults<HapticClipError> {
    let mut faults = FirstFaults::default();
    let n = clip.amplitude.len();
    if n < 2 {
        faults.add(HapticClipError::TooFewPoints { n });
    }
    check_times("amplitude", clip.amplitude.iter().map(|point| point.time_secs), &mut faults);
    // Without valid times, the clip has no begin and no end that a rule could be about.
    let has_times = faults.n == 0;
    for (index, point) in clip.amplitude.iter().enumerate() {
        let place = ClipPlace { envelope: "amplitude", number: index + 1 };
        check_amplitude(place, point).unwrap_or_else(|fault| faults.add(fault));
    }
    let (start_secs, end_secs) = (clip.start_secs(), clip.end_secs());
    let has_duration = end_secs > start_secs;
    if has_times && !has_duration {
        faults.add(HapticClipError::NoDuration { secs: start_secs });
    }
    check_times("frequency", clip.frequency.iter().map(|point| point.time_secs), &mut faults);
    let is_bounded = has_times && has_duration && rules == ClipRules::Strict;
    for (index, point) in clip.frequency.iter().enumerate() {
        let (place, secs) = (ClipPlace { envelope: "frequency", number: index + 1 }, point.time_secs);
        check_range(place, "frequency", point.frequency).unwrap_or_else(|fault| faults.add(fault));
        let in_envelope = (start_secs as f32..=end_secs as f32).contains(&(secs as f32));
        // A time that no clip may have was a fault already.
        if is_bounded && !in_envelope && is_time(secs) {
            faults.add(HapticClipError::FrequencyOutside { place, secs, start_secs, end_secs });
        }
    }
    faults
}

fn check_amplitude(place: ClipPlace, point: &AmplitudePoint) -> Result<(), HapticClipError> {
    check_range(place, "amplitude", point.amplitude)?;
    let Some(emphasis) = point.emphasis else { return Ok(()) };
    check_range(place, "amplitude of the emphasis", emphasis.amplitude)?;
    check_range(place, "frequency of the emphasis", emphasis.frequency)?;
    if (emphasis.amplitude as f32) < point.amplitude as f32 {
        return Err(HapticClipError::WeakEmphasis {
            place,
            emphasis: emphasis.amplitude,
            amplitude: point.amplitude,
        });
    }
    Ok(())
}

fn check_times(
    envelope: &'static str,
    times_secs: impl Iterator<Item = f64>,
    faults: &mut FirstFaults<HapticClipError>,
) {
    let mut previous_secs = 0.0;
    for (index, secs) in times_secs.enumerate() {
        let place = ClipPlace { envelope, number: index + 1 };
        if !is_time(secs) {
            faults.add(HapticClipError::Time { place, secs });
            continue;
        }
        if secs < previous_secs {
            faults.add(HapticClipError::Order { place, secs });
        }
        // Also after one that is too early, so that a single late point is one fault.
        previous_secs = secs;
    }
}

/// Whether a clip may have this time.
fn is_time(secs: f64) -> bool {
    (0.0..=MAX_CLIP_SECS).contains(&secs)
}

fn check_range(place: ClipPlace, what: &'static str, value: f64) -> Result<(), HapticClipError> {
    // A number that is not finite is in no range.
    let is_valid = value >= 0.0 && value as f32 <= 1.0;
    if is_valid { Ok(()) } else { Err(HapticClipError::Range { place, what, value }) }
}
