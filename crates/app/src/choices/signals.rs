//! Slots, views and tools of the Signals workspace.

/// Slot for a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// Original signal.
    A,
    /// Signal that is compared with A, computed from A, or edited.
    B,
}

/// Computation of B from A.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FromA {
    /// Copy of A.
    Copy,
    /// A, encoded and decoded by the codec.
    Codec,
    /// Resynthesis from the magnitude of the spatial spectrogram.
    Spectrogram,
}

/// View of both signals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// Spectrograms: frequency over time.
    #[default]
    Times,
    /// Spatial spectrograms: spatial frequency over position, with the editor.
    Places,
    /// Features, distances and the predicted d'.
    Differences,
}

/// Tool of the spectrogram editor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Increases the amplitude under the pointer.
    #[default]
    Louder,
    /// Decreases the amplitude under the pointer.
    Softer,
    /// Erases a rectangle.
    Erase,
    /// Copies a rectangle.
    Copy,
    /// Pastes the copied rectangle at a click.
    Paste,
}
