//! `.haptic` clips, version 1: amplitude and frequency of a vibration over time, with emphases, as players on phones and
//! controllers read them.
//!
//! All values but times are from 0 to 1: a clip states neither accelerations nor frequencies in Hz. The player maps a frequency
//! linearly to the band of its actuator ([`crate::acf`]). Between two points, values change linearly.

mod file;
pub mod of_outline;
mod rules;

pub use self::rules::{ClipPlace, ClipRules, HapticClipError};

use self::file::{ClipFileV1, VersionFileV1};
use crate::first_faults::FirstFaults;
use crate::layout;
use crate::own_json::check_density;
use crate::parser_words::plain;

/// Major version of the files.
pub const CLIP_VERSION: u32 = 1;
/// Frequency of a clip without a frequency envelope.
pub const USUAL_FREQUENCY: f64 = 0.5;
/// Latest time of a clip that is read, in s: a day. The format has no limit, but a wrong number must not become work without end.
pub const MAX_CLIP_SECS: f64 = 86_400.0;
/// Levels of objects and lists that are written over several lines: one line for each point.
const OPEN_DEPTH: usize = 5;

/// A clip.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HapticClip {
    /// Free text, which players ignore.
    pub metadata: ClipMetadata,
    /// Amplitude envelope, at least two points in the order of their times.
    pub amplitude: Vec<AmplitudePoint>,
    /// Frequency envelope in the order of times; empty if the clip has the frequency [`USUAL_FREQUENCY`]. Before its first and
    /// after its last point, the frequency is that of the point.
    pub frequency: Vec<FrequencyPoint>,
}

/// Free text about a clip.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClipMetadata {
    /// Program that wrote it.
    pub editor: String,
    /// Its author.
    pub author: String,
    /// What it was made from.
    pub source: String,
    /// Its project.
    pub project: String,
    /// Keywords.
    pub tags: Vec<String>,
    /// Description.
    pub description: String,
}

/// Point of the amplitude envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmplitudePoint {
    /// Time in s, 0 to [`MAX_CLIP_SECS`].
    pub time_secs: f64,
    /// Amplitude, 0 to 1.
    pub amplitude: f64,
    /// Short event that begins here.
    pub emphasis: Option<Emphasis>,
}

/// Short event that stands out from the continuous vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emphasis {
    /// Amplitude, 0 to 1, at least that of the envelope.
    pub amplitude: f64,
    /// Frequency, 0 to 1.
    pub frequency: f64,
}

/// Point of the frequency envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrequencyPoint {
    /// Time in s.
    pub time_secs: f64,
    /// Frequency, 0 to 1.
    pub frequency: f64,
}

impl HapticClip {
    /// Reads a clip. Unknown fields are ignored.
    ///
    /// # Errors
    /// The bytes are no clip of version 1, or the clip breaks one of the rules.
    pub fn from_json(bytes: &[u8], rules: ClipRules) -> Result<Self, HapticClipError> {
        let (clip, faults) = Self::with_faults(bytes, rules)?;
        faults.or_first(clip)
    }

    /// Reads a clip that may break rules, and returns the broken ones. Unknown fields are ignored.
    ///
    /// # Errors
    /// The bytes are no clip of version 1.
    pub fn with_faults(
        bytes: &[u8],
        rules: ClipRules,
    ) -> Result<(Self, FirstFaults<HapticClipError>), HapticClipError> {
        check_density(bytes).map_err(|_| HapticClipError::TooDense { n_bytes: bytes.len() })?;
        let damaged = |error: serde_json::Error| HapticClipError::Json(plain(&error.to_string()));
        // First: a later version may have other fields.
        let version: VersionFileV1 = serde_json::from_slice(bytes).map_err(damaged)?;
        if version.major() != CLIP_VERSION {
            return Err(HapticClipError::Version { major: version.major() });
        }
        let file: ClipFileV1 = serde_json::from_slice(bytes).map_err(damaged)?;
        let clip = Self::from(file);
        let faults = rules::check(&clip, rules);
        Ok((clip, faults))
    }

    /// Returns the clip if it keeps the rules.
    ///
    /// # Errors
    /// The first rule that it breaks.
    pub fn checked(self, rules: ClipRules) -> Result<Self, HapticClipError> {
        rules::check(&self, rules).or_first(self)
    }

    /// Returns the bytes of a file. Numbers that are not finite would become `null`; [`HapticClip::checked`] refuses them.
    pub fn to_json(&self) -> Vec<u8> {
        layout::to_bytes(&ClipFileV1::from(self), OPEN_DEPTH)
    }

    /// Time of the first point of the amplitude envelope, in s; 0 without points.
    pub fn start_secs(&self) -> f64 {
        self.amplitude.first().map_or(0.0, |point| point.time_secs)
    }

    /// Time of the last point of the amplitude envelope, in s; 0 without points.
    pub fn end_secs(&self) -> f64 {
        self.amplitude.last().map_or(0.0, |point| point.time_secs)
    }
}

#[cfg(test)]
mod tests;
