//! Export of a stroke recording as a CSV table.

use std::sync::Arc;

use shagreen_formats::stroke_csv::is_stroke_table;

use crate::state::recorded_stroke::RecordedStroke;

/// Stroke recording to be exported.
#[derive(Clone, Debug)]
pub struct StrokeFile {
    bytes: Arc<[u8]>,
    secs: f64,
}

impl StrokeFile {
    /// Content of the file for a stroke recording.
    pub fn new(stroke: &RecordedStroke) -> Self {
        Self { bytes: stroke.csv().into(), secs: stroke.track().duration_secs() }
    }

    /// Duration of the stroke, in seconds.
    pub fn secs(&self) -> f64 {
        self.secs
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.bytes.to_vec()
    }

    /// Whether a file with these bytes is a stroke too.
    pub(crate) fn is_like(bytes: &[u8]) -> bool {
        is_stroke_table(bytes)
    }
}
