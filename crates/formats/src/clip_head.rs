//! The first fields of Shagreen's own files that describe vibration by numbers from 0 to 1.

use serde::{Deserialize, Serialize};

use crate::clip_scale::ClipScale;

/// Format, origin, duration and scale of such a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClipHeadV1 {
    /// Name of the format.
    pub format: String,
    /// Version of the format.
    pub version: String,
    /// The program that wrote it.
    pub created_by: String,
    /// Texture, motion, scale and terms of use.
    pub description: String,
    /// Duration in s.
    pub seconds: f64,
    /// Acceleration in m/s² of an amplitude of 1.
    pub full_scale_mps2: f64,
}

impl ClipHeadV1 {
    /// Head of a file of this format and version. `about` has the program and the description of the signal.
    pub(crate) fn new(
        (format, version): (&str, &str),
        (created_by, description): (&str, &str),
        seconds: f64,
        scale: ClipScale,
    ) -> Self {
        Self {
            format: format.to_owned(),
            version: version.to_owned(),
            created_by: created_by.to_owned(),
            description: description.to_owned(),
            seconds,
            full_scale_mps2: scale.full_scale_mps2,
        }
    }
}
