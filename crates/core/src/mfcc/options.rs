//! What can differ from one way of taking coefficients to another, and the ways that have a name.

use crate::units::Hertz;

/// Every step from samples to coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct MfccOptions {
    /// What results made with these options are called wherever they are shown.
    pub label: &'static str,
    /// Length of a frame in seconds, rounded to samples.
    pub frame_secs: f64,
    /// From the start of one frame to the start of the next in seconds, rounded to samples.
    pub hop_secs: f64,
    /// Where frames begin and what happens at the ends.
    pub framing: Framing,
    /// `p` of `y[t] = x[t] - p x[t-1]`, over the whole signal before it is cut, 0..1; 0 leaves it as it is.
    pub pre_emphasis: f64,
    /// What a frame is multiplied with.
    pub window: Window,
    /// How many samples are transformed; zeros follow the frame.
    pub transform: TransformLength,
    /// What the filters are summed over.
    pub spectrum: Spectrum,
    /// How many mel filters.
    pub n_filters: usize,
    /// Lower edge of the first filter.
    pub low: Hertz,
    /// Upper edge of the last filter, at most half of the rate.
    pub high: Hertz,
    /// On which scale the filters are equally wide.
    pub scale: MelScale,
    /// The form of a filter.
    pub shape: FilterShape,
    /// How sums become logarithms.
    pub logarithm: Logarithm,
    /// How the cosine transform is scaled.
    pub dct: Dct,
    /// How many coefficients, counted from the first.
    pub n_coefficients: usize,
    /// What the first coefficient is.
    pub first: FirstCoefficient,
    /// How the coefficients are weighted in the end.
    pub lifter: Lifter,
}

/// Where frames begin and what happens at the ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// The first frame begins at the first sample; a last one that is not whole is dropped.
    Whole,
    /// The first frame begins at the first sample; zeros follow the signal until the last frame is whole.
    PaddedEnd,
    /// The middle of the transform of frame `i` lies at sample `i * hop`; zeros surround the signal.
    Centered,
}

/// What a frame is multiplied with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// One.
    Rectangular,
    /// Hamming's, symmetric: its first and last values are equal.
    Hamming,
    /// Hann's, periodic: its first value is 0, the one behind its last would be too.
    Hann,
}

/// How many samples are transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformLength {
    /// So many, at any rate.
    Samples(usize),
    /// The power of two that just holds a frame, times this many.
    PowersOfTwo(usize),
}

/// What the filters are summed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spectrum {
    /// `|X|`.
    Magnitude,
    /// `|X|²`.
    Power,
    /// `|X|²` over the number of samples that are transformed.
    PowerPerSample,
}

/// On which scale the filters are equally wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MelScale {
    /// `2595 log₁₀(1 + f / 700)`.
    Htk,
    /// Slaney's: linear below 1 kHz, logarithmic above.
    Slaney,
}

/// The form of a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilterShape {
    /// A triangle of height one.
    Triangle,
    /// A triangle of area one over frequency in Hz.
    UnitArea,
    /// A triangle of height one between edges that are moved down to the bins of a transform one sample longer: with few
    /// bins some are empty.
    FlooredToBins,
}

/// How sums become logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Logarithm {
    /// Natural logarithm of the sum, or of `floor` where that is more.
    Floored {
        /// The least sum, above 0.
        floor: f64,
    },
    /// Natural logarithm of the sum, or of `instead` where the sum is zero.
    ZeroReplaced {
        /// What stands for zero, above 0.
        instead: f64,
    },
    /// `10 log₁₀` of the sum, or of `floor` where that is more; not less than the highest of the signal less `top_db`.
    Decibels {
        /// The least sum, above 0.
        floor: f64,
        /// How far below the highest a value may lie, in dB, above 0; infinite where there is no such bound.
        top_db: f64,
    },
}

/// How the cosine transform over the `M` filters is scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dct {
    /// `sqrt(2 / M)`, and the first row over `sqrt(2)` once more.
    Orthonormal,
    /// `sqrt(2 / M)` everywhere.
    Htk,
}

/// What the first coefficient is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstCoefficient {
    /// The one of the cosine transform.
    OfTransform,
    /// The natural logarithm of the sum over the whole spectrum.
    LogEnergy,
}

/// How coefficient `n` (from 0) is weighted in the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lifter {
    /// Not at all.
    None,
    /// `1 + L/2 sin(π n / L)`.
    FromZero(f64),
    /// `1 + L/2 sin(π (n + 1) / L)`.
    FromOne(f64),
}

/// What the authoring paper says, read to the letter: frames of 25 ms that overlap by 10 ms, 10 to 500 Hz, 13
/// coefficients (W. Hassan, A. Abdulali and S. Jeon, "Authoring new haptic textures based on interpolation of real
/// textures in affective space", 2020).
///
/// What it leaves open is as in [`htk`].
pub fn paper() -> MfccOptions {
    MfccOptions { label: "paper (25 ms frames, overlap 10 ms)", hop_secs: 0.015, ..htk() }
}

/// The same numbers as arguments of a script in the manner of HTK, whose 10 ms are the hop: what the authors are likely to
/// have run.
///
/// Magnitudes of a transform of 32 samples at 1 kHz, 20 filters, a first coefficient that is not scaled down, lifter 22.
/// Scripts of this kind multiply a signal below 1 by 2¹⁵; here the level of a signal stays what it is.
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

/// What suits vibrations: no step that was made for speech (emphasis, lifter), filters that none is empty of, and
/// coefficients of one scale.
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
