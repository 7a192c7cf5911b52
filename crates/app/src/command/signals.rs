//! Commands of the Signals workspace.

use std::path::PathBuf;
use std::sync::Arc;

use crate::choices::signals::{FromA, Slot};
use crate::state::bench_signal::BenchSignal;
use crate::state::source::Source;

/// Command of the Signals workspace.
#[derive(Clone, Debug)]
pub enum SignalsCommand {
    /// Asks for a file to load into a slot.
    AskWhatToOpen(Slot),
    /// Loads a file into a slot.
    Read(Slot, Source),
    /// Loads dropped files: a single one into an empty slot, or else into B; the first two of several into A and B.
    ReadAll(Vec<Source>),
    /// Renders the audible texture of the Author workspace at the speed and force of the automatic stroke.
    TakeHeard(Slot),
    /// Plays a signal by position under the pen, or the authored texture again.
    Feel(Option<Slot>),
    /// Plays a signal at its own speed.
    Play(Slot),
    /// Computes B from A.
    MakeB(FromA),
    /// Adds a signal to the list of textures, as a relief.
    Keep(Slot),
    /// Asks for a model of d'.
    AskWhichModel,
    /// Loads a model of d'.
    ReadModel(PathBuf),
    /// Returns to the built-in model of d'.
    UseBuiltInModel,
    /// Notes that a signal was exported, so that leaving it loses nothing.
    NoteExported(Arc<BenchSignal>),
}
