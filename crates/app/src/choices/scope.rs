//! Views of the scope.

/// View of the scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Acceleration of the output signal over time.
    Waveform,
    /// Power spectral densities of the contributing textures, the mixture and the output signal.
    Spectrum,
    /// Spectrogram of the output signal.
    Spectrogram,
    /// Level of the output signal, absolute and relative to the detection threshold.
    Level,
    /// Tip speed and normal force.
    Contact,
}
