//! Haptic clips of other programs as envelopes: `.haptic` clips ([`crate::haptic_clip`]), AHAP patterns ([`crate::ahap`]) and
//! clips of the editor Macaron.
//!
//! Clips have amplitudes from 0 to 1 and no stroke. Most have frequencies from 0 to 1 too, which a player maps to the band of
//! its actuator. [`crate::recording`] asks for what they lack.

mod from_ahap;
mod from_haptic;
mod macaron;

use serde::Deserialize;
use serde::de::IgnoredAny;
use shagreen_core::signals::haptic_envelope::{EnvelopeError, HapticEnvelope};

use crate::ahap::{AhapError, AhapPattern};
use crate::clip::from_ahap::envelope_of_pattern;
use crate::clip::from_haptic::{envelope_of_clip, read_haptic};
use crate::clip::macaron::{envelope_of_macaron, without_data_uri};
use crate::haptic_clip::HapticClipError;

/// Format of a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClipKind {
    /// `.haptic`, version 1.
    Haptic,
    /// AHAP.
    Ahap,
    /// JSON of Macaron.
    Macaron,
}

/// Endings of the names of clips in lower case, without the dot. A clip of Macaron ends in `json`, as many other files do.
pub const CLIP_ENDINGS: [&str; 2] = ["haptic", "ahap"];

/// A clip that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipEnvelope {
    /// Its format.
    pub kind: ClipKind,
    /// Its vibration.
    pub envelope: HapticEnvelope,
    /// Whether its frequencies are from 0 to 1, so that the band that was given matters.
    pub has_relative_frequencies: bool,
    /// Sentences for the user.
    pub warnings: Vec<String>,
}

/// Why bytes are not a clip that can be rendered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClipError {
    /// A damaged `.haptic` clip.
    #[error(transparent)]
    Haptic(#[from] HapticClipError),
    /// A damaged AHAP pattern.
    #[error(transparent)]
    Ahap(#[from] AhapError),
    /// A damaged clip of Macaron.
    #[error("cannot read the clip of Macaron: {reason}; export it again")]
    Macaron {
        /// What is wrong, with its place.
        reason: String,
    },
    /// The curves of a pattern act on so many events that they cannot be rendered.
    #[error(
        "the curves of the pattern act on too many events: together they have more than {most} points; leave events out"
    )]
    TooManyPoints {
        /// Largest number of points.
        most: usize,
    },
    /// The envelope cannot be rendered.
    #[error("the clip cannot be made into a signal: {0}")]
    Envelope(#[from] EnvelopeError),
}

/// Fields that tell the formats apart.
#[derive(Deserialize)]
struct ProbeV1 {
    signals: Option<IgnoredAny>,
    #[serde(rename = "Pattern")]
    pattern: Option<IgnoredAny>,
    parameters: Option<IgnoredAny>,
    duration: Option<IgnoredAny>,
    /// Files of this program have it.
    format: Option<IgnoredAny>,
}

impl ClipKind {
    /// Format of a file, from its content; of a damaged file, from the ending of its name. `None` if it is not a clip.
    pub fn of(file_name: &str, bytes: &[u8]) -> Option<Self> {
        let text = without_data_uri(bytes);
        if text.trim_ascii_start().first() != Some(&b'{') {
            return Self::of_ending(file_name);
        }
        match serde_json::from_slice::<ProbeV1>(&text) {
            Ok(ProbeV1 { format: Some(_), .. }) => None,
            Ok(ProbeV1 { signals: Some(_), .. }) => Some(Self::Haptic),
            Ok(ProbeV1 { pattern: Some(_), .. }) => Some(Self::Ahap),
            Ok(ProbeV1 { parameters: Some(_), duration: Some(_), .. }) => Some(Self::Macaron),
            Ok(_) | Err(_) => Self::of_ending(file_name),
        }
    }

    fn of_ending(file_name: &str) -> Option<Self> {
        match file_name.to_lowercase().rsplit_once('.')?.1 {
            "haptic" => Some(Self::Haptic),
            "ahap" => Some(Self::Ahap),
            _ => None,
        }
    }

    /// Name for messages, with its article.
    pub fn name(self) -> &'static str {
        match self {
            Self::Haptic => "a .haptic clip",
            Self::Ahap => "an AHAP pattern",
            Self::Macaron => "a clip of Macaron",
        }
    }
}

/// Reads a clip. Its frequencies from 0 to 1 are mapped linearly to `band_hz`.
///
/// # Errors
/// See [`ClipError`].
pub fn read_clip(kind: ClipKind, bytes: &[u8], band_hz: [f64; 2]) -> Result<ClipEnvelope, ClipError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let (envelope, has_relative_frequencies, warnings) = match kind {
        ClipKind::Haptic => {
            let read = read_haptic(bytes)?;
            (envelope_of_clip(&read.value, band_hz)?, true, read.warnings)
        }
        ClipKind::Ahap => {
            let read = AhapPattern::from_json(bytes)?;
            let made = envelope_of_pattern(&read.value, band_hz)?;
            (made.value, true, read.warnings.into_iter().chain(made.warnings).collect())
        }
        ClipKind::Macaron => {
            let made = envelope_of_macaron(bytes, band_hz)?;
            (made.envelope, made.has_relative_frequencies, made.warnings)
        }
    };
    Ok(ClipEnvelope { kind, envelope, has_relative_frequencies, warnings })
}

#[cfg(test)]
mod tests;
