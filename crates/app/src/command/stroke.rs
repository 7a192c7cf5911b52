//! Commands about stroke recordings.

use crate::state::source::Source;

/// Command about stroke recordings.
#[derive(Clone, Debug)]
pub enum StrokeCommand {
    /// Starts or finishes a recording.
    Record,
    /// Finishes the recording after a click on the button. If a pen clicked, its tap on the button is not part of the
    /// stroke.
    FinishByPointer,
    /// Asks for a stroke recording to open.
    AskWhatToOpen,
    /// Opens the first of these files; the automatic stroke repeats only one recording.
    Read(Vec<Source>),
    /// Asks for a path and saves the stroke recording.
    Save,
}
