//! How different two vibrations feel: features of both, their distances, and the discriminability that these predict.
//!
//! After the paper on the prediction of the quality of compressed texture signals: roughness, brightness, regularity,
//! asymmetry, the activation of frequency channels of the skin by power (Bensmaïa) and by amplitude (Okamoto and Yamada),
//! and the envelope in time. A weighted sum of their distances predicts d′, the distance in standard deviations at which
//! people tell two signals apart. [`st_sim`] and [`spqi`] are measures of others, to be compared with.
//!
//! Signals are accelerations in m/s². They are looked at in pieces of [`SEGMENT_SECS`], the length of the paper's stimuli:
//! activations depend on the distance between bins, and so on the length.

mod channels;
mod correlation;
mod d_prime;
mod features;
mod model;
mod real_transform;
mod similarity;
#[cfg(test)]
mod tests;

use crate::threshold::Threshold;
use crate::units::Hertz;

pub use crate::quality::d_prime::{Correction, Counts, d_prime};
pub use crate::quality::features::Features;
pub use crate::quality::model::{
    Elimination, PAPER_FEATURES, PAPER_PAIRS, PAPER_RATE, PAPER_WEIGHTS, QualityModel, QualityModelError,
    RatedPair, Rotation, Term, eliminate, nested_r_squared, rotate,
};
pub use crate::quality::similarity::{snr_db, spqi, st_sim};

use self::channels::Channels;
use self::features::{FeatureMeter, Measured};

/// Length of the pieces that are compared, in s.
pub const SEGMENT_SECS: f64 = 0.8;

/// What two signals are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// Logarithm of the mean power.
    Roughness,
    /// Center of mass of the magnitude spectrum, in Hz.
    Brightness,
    /// Highest autocorrelation at lags of 2 to 50 ms.
    Regularity,
    /// Skewness.
    Asymmetry,
    /// Activation of the channels by power.
    SpectralPower,
    /// Activation of the channels by amplitude.
    SpectralAmplitude,
    /// Envelope in time.
    Envelope,
}

impl Feature {
    /// All, in the order of the paper.
    pub const ALL: [Self; 7] = [
        Self::Roughness,
        Self::Brightness,
        Self::Regularity,
        Self::Asymmetry,
        Self::SpectralPower,
        Self::SpectralAmplitude,
        Self::Envelope,
    ];

    /// As files call it.
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

    /// The feature of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|feature| feature.id() == id)
    }

    /// The unit of its distance, empty where it has none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Roughness => "log10 (m/s²)²",
            Self::Brightness => "Hz",
            Self::Regularity | Self::Asymmetry | Self::Envelope => "",
            Self::SpectralPower | Self::SpectralAmplitude => "activation",
        }
    }
}

/// A distance by each feature, in the order of [`Feature::ALL`], each in its unit; none is below zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distances(pub [f64; 7]);

impl Distances {
    /// The distance by one feature.
    pub fn by(&self, feature: Feature) -> f64 {
        self.0[feature as usize]
    }
}

/// Why two signals cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// Too few samples a second to tell the channels apart.
    #[error("signals at {} Hz say nothing of what is felt; 200 Hz or more are needed", .rate.0)]
    Rate {
        /// The rate.
        rate: Hertz,
    },
    /// Signals of different lengths.
    #[error(
        "{n_reference} samples against {n_other}: signals are compared sample by sample; cut them to one length"
    )]
    Lengths {
        /// Samples of the one.
        n_reference: usize,
        /// Samples of the other.
        n_other: usize,
    },
    /// Less than a piece.
    #[error(
        "the signal has {n_samples} of the {needed} samples that are compared at once ({SEGMENT_SECS} s); take a longer one"
    )]
    Short {
        /// Samples there are.
        n_samples: usize,
        /// Samples of a piece.
        needed: usize,
    },
    /// A sample that is no number.
    #[error("sample {index} is not a finite number")]
    NotFinite {
        /// Which, from zero.
        index: usize,
    },
}

/// Lowest rate of signals, in Hz.
const LEAST_RATE_HZ: f64 = 200.0;

/// Compares signals of one rate: made once, used for many pairs.
#[derive(Clone, Debug)]
pub struct QualityMeter {
    n_segment: usize,
    features: FeatureMeter,
    channels: Channels,
}

impl QualityMeter {
    /// A meter for signals of this rate, felt at this threshold.
    ///
    /// # Errors
    /// [`QualityError::Rate`].
    pub fn new(rate: Hertz, threshold: &Threshold) -> Result<Self, QualityError> {
        // A rate that is not a number is refused too.
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

    /// Samples of a piece.
    pub fn n_segment(&self) -> usize {
        self.n_segment
    }

    /// The features of a signal itself, the mean over its whole pieces.
    ///
    /// # Errors
    /// See [`QualityError`].
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

    /// How far apart two signals are, sample beside sample: the mean over their whole pieces.
    ///
    /// # Errors
    /// See [`QualityError`].
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
