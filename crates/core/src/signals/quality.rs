//! Perceptual quality of a degraded vibration: features of two signals, their distances, and predicted
//! discriminability.
//!
//! After the paper on predicting the quality of compressed texture signals. Its features are roughness, brightness,
//! regularity and asymmetry, the activation of the skin's frequency channels by power (Bensmaïa) and by amplitude
//! (Okamoto and Yamada), and the temporal envelope. A weighted sum of the distances predicts d′, the discriminability
//! of two signals in standard deviations. [`st_sim`] and [`spqi`] are published measures for comparison.
//!
//! The model applies to a signal and a processed version of it, whose waveforms correlate ([`Agreement`]). A d′ above
//! [`MOST_D_PRIME`] is stated as "above" it.
//!
//! Signals are accelerations in m/s². They are compared in segments of [`SEGMENT_SECS`], the length of the paper's
//! stimuli. Channel activations depend on the bin spacing, and therefore on the segment length.

mod channels;
mod correlation;
mod features;
mod fit;
mod model;
mod real_transform;
mod relation;
mod selection;
mod similarity;
#[cfg(test)]
mod tests;

use crate::dsp::threshold::Threshold;
use crate::units::Hertz;

pub use crate::signals::quality::features::Features;
pub use crate::signals::quality::fit::{QualityFit, USUAL_TOLERANCE, fit_quality_model};
pub use crate::signals::quality::model::{
    MOST_PAIRS, MOST_TEXTURES, PAPER_FEATURES, PAPER_PAIRS, PAPER_RATE, PAPER_WEIGHTS, QualityModel,
    QualityModelError, RatedPair, Term,
};
pub use crate::signals::quality::relation::{Agreement, Relation};
pub use crate::signals::quality::selection::{
    Elimination, NestedValidation, Rotation, eliminate, nested_validation, rotate,
};
pub use crate::signals::quality::similarity::{snr_db, spqi, st_sim};

use self::channels::Channels;
use self::features::{FeatureMeter, Measured};

/// Length of a compared segment, in s.
pub const SEGMENT_SECS: f64 = 0.8;

/// Largest d′ that is stated as a number. At 5, an unbiased observer answers 99.4 % of yes-no questions correctly
/// ([`crate::people::study::same_different::proportion_correct`]), so that larger values mean the same.
pub const MOST_D_PRIME: f64 = 5.0;

/// A feature that two signals are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// Log₁₀ of the mean power.
    Roughness,
    /// Centroid of the magnitude spectrum, in Hz.
    Brightness,
    /// Largest autocorrelation at lags of 2 to 50 ms.
    Regularity,
    /// Skewness of the samples.
    Asymmetry,
    /// Channel activation by power.
    SpectralPower,
    /// Channel activation by amplitude.
    SpectralAmplitude,
    /// Temporal envelope.
    Envelope,
}

impl Feature {
    /// All features, in the order of the paper.
    pub const ALL: [Self; 7] = [
        Self::Roughness,
        Self::Brightness,
        Self::Regularity,
        Self::Asymmetry,
        Self::SpectralPower,
        Self::SpectralAmplitude,
        Self::Envelope,
    ];

    /// Returns the identifier used in files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Roughness => "roughness",
            Self::Brightness => "brightness",
            Self::Regularity => "regularity",
            Self::Asymmetry => "asymmetry",
            Self::SpectralPower => "spectral_power",
            Self::SpectralAmplitude => "spectral_amplitude",
            Self::Envelope => "envelope",
        }
    }

    /// Returns the feature with this identifier.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|feature| feature.id() == id)
    }

    /// Returns the unit of the feature's distance; empty if it is dimensionless.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Roughness => "log10 (m/s²)²",
            Self::Brightness => "Hz",
            Self::Regularity | Self::Asymmetry | Self::Envelope => "",
            Self::SpectralPower | Self::SpectralAmplitude => "activation",
        }
    }
}

/// Distances by feature, in the order of [`Feature::ALL`], each in its unit, 0 or more.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distances(pub [f64; 7]);

impl Distances {
    /// Returns the distance by one feature.
    pub fn by(&self, feature: Feature) -> f64 {
        self.0[feature as usize]
    }
}

/// Reasons why two signals cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// The sampling rate is out of range.
    #[error("the sampling rate is {} Hz, needs 200 Hz to 1 MHz; use signals of another rate", .rate.0)]
    Rate {
        /// Given sampling rate.
        rate: Hertz,
    },
    /// The signals have different lengths.
    #[error(
        "the reference has {n_reference} samples, the other signal {n_other}; cut both to the same length"
    )]
    Lengths {
        /// Samples of the reference.
        n_reference: usize,
        /// Samples of the other signal.
        n_other: usize,
    },
    /// The signal is shorter than one segment.
    #[error(
        "the signal has {n_samples} samples, one segment needs {needed} ({SEGMENT_SECS} s); use a longer one"
    )]
    Short {
        /// Samples of the signal.
        n_samples: usize,
        /// Samples of a segment.
        needed: usize,
    },
    /// A sample is not a finite number.
    #[error("sample {index} is not a finite number; cut it out")]
    NotFinite {
        /// Index of the sample, from 0.
        index: usize,
    },
}

/// Lowest sampling rate, in Hz.
const LEAST_RATE_HZ: f64 = 200.0;

/// Compares signals of one sampling rate; build once and use for many pairs.
#[derive(Clone, Debug)]
pub struct QualityMeter {
    n_segment: usize,
    features: FeatureMeter,
    channels: Channels,
}

impl QualityMeter {
    /// Returns a meter for signals of this rate, with this detection threshold.
    ///
    /// # Errors
    /// [`QualityError::Rate`] outside 200 Hz to 1 MHz.
    pub fn new(rate: Hertz, threshold: &Threshold) -> Result<Self, QualityError> {
        // Written so that NaN fails too.
        if !(rate.0 >= LEAST_RATE_HZ && rate.0 <= 1e6) {
            return Err(QualityError::Rate { rate });
        }
        let n_segment = (SEGMENT_SECS * rate.0).round() as usize;
        Ok(Self {
            n_segment,
            features: FeatureMeter::new(n_segment, rate),
            channels: Channels::new(n_segment, rate, threshold),
        })
    }

    /// Returns the samples per segment.
    pub fn n_segment(&self) -> usize {
        self.n_segment
    }

    /// Returns the features of a signal, averaged over its whole segments.
    ///
    /// # Errors
    /// [`QualityError::Short`] and [`QualityError::NotFinite`].
    pub fn features(&self, signal: &[f64]) -> Result<Features, QualityError> {
        self.check(signal)?;
        let pieces = signal.chunks_exact(self.n_segment);
        let share = 1.0 / pieces.len() as f64;
        let mut sum = Features::default();
        for piece in pieces {
            sum.add(&self.features.measure(piece).features, share);
        }
        Ok(sum)
    }

    /// Returns the distances of two aligned signals, averaged over their whole segments.
    ///
    /// # Errors
    /// [`QualityError::Lengths`], [`QualityError::Short`] and [`QualityError::NotFinite`].
    pub fn distances(&self, reference: &[f64], other: &[f64]) -> Result<Distances, QualityError> {
        if reference.len() != other.len() {
            return Err(QualityError::Lengths { n_reference: reference.len(), n_other: other.len() });
        }
        self.check(reference)?;
        self.check(other)?;
        let pieces = reference.chunks_exact(self.n_segment).zip(other.chunks_exact(self.n_segment));
        let share = 1.0 / pieces.len() as f64;
        let mut sum = Distances::default();
        for (a, b) in pieces {
            let (a, b) = (self.features.measure(a), self.features.measure(b));
            for (sum, distance) in sum.0.iter_mut().zip(self.of_pieces(&a, &b)) {
                *sum += share * distance;
            }
        }
        Ok(sum)
    }

    fn of_pieces(&self, a: &Measured, b: &Measured) -> [f64; 7] {
        let (x, y) = (&a.features, &b.features);
        let [power, amplitude] = self.channels.distances(&a.spectrum, &b.spectrum);
        [
            (x.roughness - y.roughness).abs(),
            (x.brightness_hz - y.brightness_hz).abs(),
            (x.regularity - y.regularity).abs(),
            (x.asymmetry - y.asymmetry).abs(),
            power,
            amplitude,
            self.features.envelope_distance(&a.envelope, &b.envelope),
        ]
    }

    fn check(&self, signal: &[f64]) -> Result<(), QualityError> {
        let n_samples = signal.len();
        if n_samples < self.n_segment {
            return Err(QualityError::Short { n_samples, needed: self.n_segment });
        }
        match signal.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(QualityError::NotFinite { index }),
            None => Ok(()),
        }
    }
}
