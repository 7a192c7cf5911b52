//! Options of each MFCC step, and named presets.

use crate::units::Hertz;

/// Maximum number of samples of a transform.
pub const MAX_TRANSFORM: usize = 1 << 16;

/// Largest magnitude of a sample; larger ones make the energy of a frame overflow.
pub const MAX_SAMPLE: f64 = 1e100;

/// Options of every step from samples to coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct MfccOptions {
    /// Name of these options, shown beside results.
    pub label: &'static str,
    /// Frame length in seconds, rounded to samples.
    pub frame_secs: f64,
    /// Time from the start of one frame to the start of the next in seconds, rounded to samples.
    pub hop_secs: f64,
    /// Position of the frames and handling of the signal's ends.
    pub framing: Framing,
    /// Pre-emphasis coefficient `p` of `y[t] = x[t] - p x[t-1]`, applied to the whole signal before framing; 0 to 1, 0
    /// is off.
    pub pre_emphasis: f64,
    /// Window function of a frame.
    pub window: Window,
    /// Transform length; the frame is padded with zeros to this length.
    pub transform: TransformLength,
    /// Spectrum that the mel filters are applied to.
    pub spectrum: Spectrum,
    /// Number of mel filters.
    pub n_filters: usize,
    /// Lower edge of the first filter.
    pub low: Hertz,
    /// Upper edge of the last filter, at most the Nyquist frequency.
    pub high: Hertz,
    /// Mel scale on which the filters have equal width.
    pub scale: MelScale,
    /// Shape of the filters.
    pub shape: FilterShape,
    /// Logarithm of the filter outputs.
    pub logarithm: Logarithm,
    /// Scaling of the discrete cosine transform.
    pub dct: Dct,
    /// Number of coefficients, counted from the first.
    pub n_coefficients: usize,
    /// Definition of the first coefficient.
    pub first: FirstCoefficient,
    /// Liftering: weights applied to the coefficients.
    pub lifter: Lifter,
}

/// Position of the frames and handling of the signal's ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// The first frame starts at the first sample; an incomplete last frame is dropped.
    Whole,
    /// The first frame starts at the first sample; the signal is padded with zeros until the last frame is complete.
    PaddedEnd,
    /// The center of the transform of frame `i` is at sample `i * hop`; the signal is padded with zeros at both ends.
    Centered,
}

/// Window function of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// Rectangular: all values are one.
    Rectangular,
    /// Hamming, symmetric: the first and last values are equal.
    Hamming,
    /// Hann, periodic: the first value is 0, and so would be the value after the last.
    Hann,
}

/// Transform length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformLength {
    /// Number of samples, independent of the sample rate.
    Samples(usize),
    /// Smallest power of two that holds a frame, times this factor.
    PowersOfTwo(usize),
}

/// Spectrum that the mel filters are applied to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spectrum {
    /// `|X|`.
    Magnitude,
    /// `|X|²`.
    Power,
    /// `|X|²` divided by the transform length.
    PowerPerSample,
}

/// Mel scale on which the filters have equal width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MelScale {
    /// HTK: `2595 log₁₀(1 + f / 700)`.
    Htk,
    /// Slaney: linear below 1 kHz, logarithmic above.
    Slaney,
}

/// Shape of a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilterShape {
    /// A triangle of height one.
    Triangle,
    /// A triangle with unit area over frequency in Hz.
    UnitArea,
    /// A triangle of height one whose edges are rounded down to bins of a transform one sample longer. With few bins,
    /// some filters are empty.
    FlooredToBins,
}

/// Logarithm of the filter outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Logarithm {
    /// Natural logarithm of the larger of the sum and `floor`.
    Floored {
        /// Minimum of the sum, above 0.
        floor: f64,
    },
    /// Natural logarithm of the sum, or of `instead` if the sum is zero.
    ZeroReplaced {
        /// Replacement for zero, above 0.
        instead: f64,
    },
    /// `10 log₁₀` of the larger of the sum and `floor`, limited to at least the signal's maximum minus `top_db`.
    Decibels {
        /// Minimum of the sum, above 0.
        floor: f64,
        /// Dynamic range below the maximum in dB, above 0; infinite for no limit.
        top_db: f64,
    },
}

/// Scaling of the discrete cosine transform over the `M` filters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dct {
    /// `sqrt(2 / M)`, and the first row divided by `sqrt(2)` in addition.
    Orthonormal,
    /// `sqrt(2 / M)` for all rows.
    Htk,
}

/// Definition of the first coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstCoefficient {
    /// Coefficient 0 of the cosine transform.
    OfTransform,
    /// Natural logarithm of the frame energy, the sum over the whole spectrum.
    LogEnergy,
}

/// Liftering: weight of coefficient `n`, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lifter {
    /// No liftering.
    None,
    /// `1 + L/2 sin(π n / L)`.
    FromZero(f64),
    /// `1 + L/2 sin(π (n + 1) / L)`.
    FromOne(f64),
}

/// Literal reading of the authoring paper: 25 ms frames with 10 ms overlap, 10 to 500 Hz, 13 coefficients (W. Hassan,
/// A. Abdulali and S. Jeon, "Authoring new haptic textures based on interpolation of real textures in affective space",
/// 2020).
///
/// Options that the paper does not state are as in [`htk`].
pub fn paper() -> MfccOptions {
    MfccOptions { label: "paper (25 ms frames, overlap 10 ms)", hop_secs: 0.015, ..htk() }
}

/// Same numbers as arguments of an HTK-style script, whose 10 ms are the hop; the authors probably ran such a script.
///
/// Magnitude spectrum of a 32-sample transform at 1 kHz, 20 filters, unscaled first coefficient, lifter 22. Such
/// scripts multiply a signal with values below 1 by 2¹⁵. This preset keeps the signal's level.
pub fn htk() -> MfccOptions {
    MfccOptions {
        label: "htk (25 ms frames, hop 10 ms)",
        frame_secs: 0.025,
        hop_secs: 0.010,
        framing: Framing::Whole,
        pre_emphasis: 0.97,
        window: Window::Hamming,
        transform: TransformLength::PowersOfTwo(1),
        spectrum: Spectrum::Magnitude,
        n_filters: 20,
        low: Hertz(10.0),
        high: Hertz(500.0),
        scale: MelScale::Htk,
        shape: FilterShape::Triangle,
        logarithm: Logarithm::ZeroReplaced { instead: f64::EPSILON },
        dct: Dct::Htk,
        n_coefficients: 13,
        first: FirstCoefficient::OfTransform,
        lifter: Lifter::FromZero(22.0),
    }
}

/// Options for vibrations: no speech-specific steps (pre-emphasis, lifter), no empty filters, and an orthonormal cosine
/// transform, so that all coefficients have the same scale.
pub fn recommended() -> MfccOptions {
    MfccOptions {
        label: "recommended (25 ms frames, hop 15 ms, no emphasis, no lifter)",
        frame_secs: 0.025,
        hop_secs: 0.015,
        framing: Framing::Whole,
        pre_emphasis: 0.0,
        window: Window::Hamming,
        transform: TransformLength::PowersOfTwo(2),
        spectrum: Spectrum::PowerPerSample,
        n_filters: 20,
        low: Hertz(10.0),
        high: Hertz(500.0),
        scale: MelScale::Htk,
        shape: FilterShape::Triangle,
        logarithm: Logarithm::Floored { floor: 1e-12 },
        dct: Dct::Orthonormal,
        n_coefficients: 13,
        first: FirstCoefficient::OfTransform,
        lifter: Lifter::None,
    }
}
