//! The workspace Signals: two signals side by side, what is felt of them, and what may be thrown away.

pub mod analysis;
pub mod bench_signal;
pub mod editor;
mod editor_ui;
mod features_ui;
mod figures;
mod known;
mod maps;
mod number_ui;
pub mod page;
mod playing;
pub(crate) mod reading;
mod slot;
mod slot_ui;
mod spatial_ui;

use shagreen_core::codec::bitrate::Bitrate;

use crate::import::source::Source;

pub use self::slot::Slot;

/// What can be asked of the bench.
#[derive(Clone, Debug)]
pub enum SignalsCommand {
    /// Look for a file.
    AskWhatToOpen(Slot),
    /// Read a file.
    Read(Slot, Source),
    /// Read files that were dropped, into the places that are free.
    ReadAll(Vec<Source>),
    /// Take what is heard in the workspace Author, at the speed and force of the hand.
    TakeHeard(Slot),
    /// Let the pen feel a signal, or what is authored again.
    Feel(Option<Slot>),
    /// Play a signal as it was recorded.
    Play(Slot),
    /// Make B of A.
    MakeB(FromA),
    /// Make a texture of a signal.
    Keep(Slot),
}

/// How B is made of A.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FromA {
    /// It is the same.
    Copy,
    /// It is what the codec leaves.
    Codec,
    /// It is made of the spatial spectrogram alone.
    Spectrogram,
}

/// What is set for making B of A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remaking {
    /// Bits a second of the codec.
    pub(crate) rate: Bitrate,
    /// Steps of refinement of a spectrogram.
    pub(crate) n_steps: usize,
}
