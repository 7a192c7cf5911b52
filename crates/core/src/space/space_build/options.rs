//! Options for building a space.

use crate::dsp::mfcc::MfccOptions;
use crate::people::mds::{MdsOptions, Transform};
use crate::people::ratings::AdjectivePair;
use crate::space::selection::Method;

/// Options for building a space; [`SpaceOptions::usual`] gives reasonable defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceOptions {
    /// Number of dimensions of the perceptual space, 2 to [`MAX_DIMS`](crate::people::mds::MAX_DIMS). Without sorts, it
    /// has no effect, and neither have `mds`, `transform`, `is_orthogonal` and `n_draws`.
    pub n_dims: usize,
    /// Options of the multidimensional scaling.
    pub mds: MdsOptions,
    /// Transformation of the dissimilarities. `None` uses that of `mds`, and interval scaling instead if its solution is
    /// degenerate ([`DegenerateScaling`](crate::space::space_build::DegenerateScaling)).
    pub transform: Option<Transform>,
    /// Adjective pairs of the two axes, the pole at 0 first. `None` selects rough-smooth and hard-soft if both are
    /// usable: rated, not excluded by relevance votes, and with a direction in the perceptual space. Otherwise `None`
    /// selects, for each of the first two dimensions of the perceptual space, the usable pair whose ratings have the
    /// highest absolute correlation with it. Without sorts, `None` selects the two pairs whose mean ratings have the
    /// lowest absolute correlation, among those with reliable ratings
    /// ([`RELIABLE_ALPHA`](crate::space::space_build::RELIABLE_ALPHA)).
    pub axes: Option<[AdjectivePair; 2]>,
    /// Whether the second axis is made orthogonal to the first.
    pub is_orthogonal: bool,
    /// Kind of features of the vibrations.
    pub features: FeatureKind,
    /// Options of the mel-frequency cepstral coefficients (MFCC). They describe a pattern: a stroke rendered at
    /// constant speed and force ([`crate::texture::patterns`]).
    pub mfcc: MfccOptions,
    /// Method that predicts an axis from features.
    pub method: Method,
    /// Kind of positions. `None` selects, for each axis, predicted positions if the nested correlation reaches
    /// [`TRUSTED_NESTED_R`](crate::space::space_build::TRUSTED_NESTED_R), else perceived positions. Without sorts, `None`
    /// selects perceived positions, the mean ratings.
    pub placement: Option<PlacedBy>,
    /// Number of permutations for the null distribution of the nested correlation; 0 omits the permutation test.
    pub n_permutations: usize,
    /// Number of bootstrap samples of the participants, for the stability of the perceived positions; 0 omits the
    /// bootstrap.
    pub n_draws: usize,
    /// Seed of scaling, noise, folds, permutations and bootstrap.
    pub seed: u64,
}

/// Kind of features that describe the vibrations of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// For each pattern, the mean of every mel-frequency cepstral coefficient over its frames.
    Mfcc,
    /// For each pattern, every coefficient of every frame, as in the paper (see the module documentation).
    MfccFrames,
    /// Physical features ([`crate::space::features::Physical`]): level, exponents of the level over speed and force,
    /// spectral centroid, friction coefficient, and tap transient.
    Physical,
    /// [`FeatureKind::Mfcc`] and [`FeatureKind::Physical`].
    MfccAndPhysical,
}

/// Kind of position of a texture on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlacedBy {
    /// Perceived position, computed from the judgments.
    Felt,
    /// Position predicted from features. The paper uses these positions: its axes are computed from features.
    Predicted,
}

impl SpaceOptions {
    /// Default options: two dimensions, [`FeatureKind::Mfcc`] with the recommended MFCC options, [`Method::Practical`],
    /// an automatic kind of positions, a thousand permutations and a hundred bootstrap samples.
    pub fn usual(seed: u64) -> Self {
        Self {
            n_dims: 2,
            mds: MdsOptions::usual(seed),
            transform: None,
            axes: None,
            is_orthogonal: false,
            features: FeatureKind::Mfcc,
            mfcc: crate::dsp::mfcc::recommended(),
            method: Method::Practical,
            placement: None,
            n_permutations: 1000,
            n_draws: 100,
            seed,
        }
    }
}

impl FeatureKind {
    /// All kinds, in the order in which the user interface lists them.
    pub const ALL: [Self; 4] = [Self::Mfcc, Self::MfccAndPhysical, Self::Physical, Self::MfccFrames];

    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Mfcc => "mfcc",
            Self::MfccFrames => "mfcc-frames",
            Self::Physical => "physical",
            Self::MfccAndPhysical => "mfcc+physical",
        }
    }
}

impl PlacedBy {
    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Felt => "felt",
            Self::Predicted => "predicted",
        }
    }
}
