//! A stroke as a file: the table of what was recorded.

use std::sync::Arc;

use shagreen_formats::stroke_csv::is_stroke_table;

use crate::recorded_stroke::RecordedStroke;

/// A stroke on its way into a file.
#[derive(Clone, Debug)]
pub struct StrokeFile {
    bytes: Arc<[u8]>,
    secs: f64,
}

impl StrokeFile {
    /// The file of a stroke.
    pub fn new(stroke: &RecordedStroke) -> Self {
        Self { bytes: stroke.csv().into(), secs: stroke.track().duration_secs() }
    }

    /// How long the stroke is, in seconds.
    pub fn secs(&self) -> f64 {
        self.secs
    }

    /// What goes into the file.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.bytes.to_vec()
    }

    /// Whether a file of these bytes is a stroke too.
    pub(super) fn is_like(bytes: &[u8]) -> bool {
        is_stroke_table(bytes)
    }
}
