//! Sources of strokes: the pen, the automatic stroke, and stroke recordings.

use std::sync::Arc;

use shagreen_device::controls::Input;

use super::pen::Pen;
use crate::state::recorded_stroke::RecordedStroke;
use crate::state::recorder::Recorder;

#[derive(Default)]
pub(super) struct HandState {
    pub(super) pen: Pen,
    /// The automatic stroke, while it runs.
    pub(super) automatic: Option<Input>,
    /// The recording that the automatic stroke can repeat.
    pub(super) stroke: Option<Arc<RecordedStroke>>,
    /// Number of recordings so far.
    pub(super) n_strokes: u64,
    /// The recording in progress.
    pub(super) recorder: Option<Recorder>,
}
