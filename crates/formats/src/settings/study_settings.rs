//! What studies with people need to know about a machine.

use serde::{Deserialize, Serialize};

use super::newer;

/// What studies with people need to know about a machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StudySettings {
    /// Pixels of the screen per millimeter, measured with a card; `None` before the measurement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixels_per_mm: Option<f32>,
    /// Id of the output of the masking noise: the headphones of the participant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub masking_output: Option<String>,
}

/// Possible densities of a screen, in pixels per millimeter: from a projector to the finest screens.
pub const PIXELS_PER_MM: std::ops::RangeInclusive<f32> = 0.5..=50.0;

impl StudySettings {
    /// Whether nothing is selected.
    pub(super) fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// The same without an impossible density.
    pub(super) fn checked(self) -> Self {
        Self { pixels_per_mm: self.pixels_per_mm.filter(|density| PIXELS_PER_MM.contains(density)), ..self }
    }

    /// As [`super::merged`].
    pub(super) fn merged(base: &Self, ours: &Self, theirs: Self) -> Self {
        Self {
            pixels_per_mm: newer(&base.pixels_per_mm, &ours.pixels_per_mm, theirs.pixels_per_mm),
            masking_output: newer(&base.masking_output, &ours.masking_output, theirs.masking_output),
        }
    }
}
