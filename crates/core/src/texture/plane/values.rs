//! Values at a point of the plane, all of them interpolated linearly.

use crate::dsp::lsf::ar_from_lsf;
use crate::dsp::{ar, arma};
use crate::texture::plane::Grain;
use crate::units::Hertz;

/// Upper limit of a logarithmic power gain, for predictors that are unstable due to rounding; such a model is silent.
const HIGHEST_LN_GAIN: f64 = 60.0;

/// Spectrum and strength at a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    /// Line spectral frequencies of the AR part.
    pub(super) lsf: Vec<f64>,
    /// Line spectral frequencies of the moving-average part; empty without such a part.
    pub(super) ma_lsf: Vec<f64>,
    /// Strength of the vibration.
    pub(super) strength: Strength,
}

/// Strength of a grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strength {
    /// Given by the output level.
    Level { level_mps2: f64 },
    /// Given by the excitation of the filter.
    Excitation { variance: f64, gain: f64 },
}

impl Values {
    /// Values of a measured node.
    pub(super) fn measured(lsf: Vec<f64>, level_mps2: f64) -> Self {
        Self { lsf, ma_lsf: Vec::new(), strength: Strength::Level { level_mps2 } }
    }

    /// Weighted mean of values of the same kind; at least one.
    pub(super) fn mean(parts: &[(&Self, f64)]) -> Self {
        let mix = |of: &dyn Fn(&Self) -> f64| parts.iter().map(|(values, w)| w * of(values)).sum::<f64>();
        let first = parts[0].0;
        let strength = match first.strength {
            Strength::Level { .. } => Strength::Level { level_mps2: mix(&|v| v.strength.numbers()[0]) },
            Strength::Excitation { .. } => Strength::Excitation {
                variance: mix(&|v| v.strength.numbers()[0]),
                gain: mix(&|v| v.strength.numbers()[1]),
            },
        };
        Self {
            lsf: (0..first.lsf.len()).map(|i| mix(&|v| v.lsf[i])).collect(),
            ma_lsf: (0..first.ma_lsf.len()).map(|i| mix(&|v| v.ma_lsf[i])).collect(),
            strength,
        }
    }

    /// Mixture of these values, measured across the lay of a texture, with those measured along it, whose share is 0..1.
    /// Line spectral frequencies and squared level are linear in the share.
    pub(super) fn mixed_with_along(&self, along: &Self, share: f64) -> Self {
        let power = (1.0 - share) * self.level_mps2().powi(2) + share * along.level_mps2().powi(2);
        let strength = Strength::Level { level_mps2: power.sqrt() };
        Self { strength, ..Self::mean(&[(self, 1.0 - share), (along, share)]) }
    }

    /// Natural logarithm of the filter's power gain.
    pub(super) fn ln_gain(&self) -> f64 {
        self.power_gain().ln().min(HIGHEST_LN_GAIN)
    }

    fn power_gain(&self) -> f64 {
        let predictor = ar_from_lsf(&self.lsf);
        if self.ma_lsf.is_empty() {
            ar::power_gain(&predictor)
        } else {
            arma::power_gain(&predictor, &ar_from_lsf(&self.ma_lsf))
        }
    }

    /// Output level: root mean square acceleration in m/s².
    pub(super) fn level_mps2(&self) -> f64 {
        match self.strength {
            Strength::Level { level_mps2 } => level_mps2,
            Strength::Excitation { variance, gain } => gain * variance.sqrt() * (0.5 * self.ln_gain()).exp(),
        }
    }

    /// Converts the values to a grain.
    pub(super) fn into_grain(self, rate: Hertz) -> Grain {
        let level_mps2 = self.level_mps2();
        let sigma_mps2 = match self.strength {
            Strength::Level { level_mps2 } => level_mps2 / self.power_gain().sqrt(),
            Strength::Excitation { variance, gain } => gain * variance.sqrt(),
        };
        Grain { rate, lsf: self.lsf, ma_lsf: self.ma_lsf, level_mps2, sigma_mps2 }
    }
}

impl Strength {
    /// Interpolated quantities: the level, or variance and gain.
    fn numbers(&self) -> [f64; 2] {
        match *self {
            Self::Level { level_mps2 } => [level_mps2, 0.0],
            Self::Excitation { variance, gain } => [variance, gain],
        }
    }

    /// Zero strength of the same kind.
    pub(super) fn silent(self) -> Self {
        match self {
            Self::Level { .. } => Self::Level { level_mps2: 0.0 },
            Self::Excitation { gain, .. } => Self::Excitation { variance: 0.0, gain },
        }
    }
}
