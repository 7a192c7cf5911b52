//! What is known at a point of a plane, all of it interpolated in straight lines.

use crate::lsf::ar_from_lsf;
use crate::plane::Grain;
use crate::units::Hertz;
use crate::{ar, arma};

/// Highest ln of a power gain, for predictors that rounding makes unstable: what such a model sounds like is silence.
const HIGHEST_LN_GAIN: f64 = 60.0;

/// Spectrum and strength at a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    /// Line spectral frequencies of the predictor.
    pub(super) lsf: Vec<f64>,
    /// Those of the moving average; none where there is none.
    pub(super) ma_lsf: Vec<f64>,
    /// How strong it is.
    pub(super) strength: Strength,
}

/// How strong a grain is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strength {
    /// By its output.
    Level { level_mps2: f64 },
    /// By what drives its filter.
    Excitation { variance: f64, gain: f64 },
}

impl Values {
    /// Of a measured node.
    pub(super) fn measured(lsf: Vec<f64>, level_mps2: f64) -> Self {
        Self { lsf, ma_lsf: Vec::new(), strength: Strength::Level { level_mps2 } }
    }

    /// The weighted mean of values of one kind, at least one.
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

    /// ln of the power gain of the filter.
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

    /// Output level, the root mean square in m/s².
    pub(super) fn level_mps2(&self) -> f64 {
        match self.strength {
            Strength::Level { level_mps2 } => level_mps2,
            Strength::Excitation { variance, gain } => gain * variance.sqrt() * (0.5 * self.ln_gain()).exp(),
        }
    }

    /// The grain that these are.
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
    /// What is interpolated: the level, or variance and gain.
    fn numbers(&self) -> [f64; 2] {
        match *self {
            Self::Level { level_mps2 } => [level_mps2, 0.0],
            Self::Excitation { variance, gain } => [variance, gain],
        }
    }

    /// Silence of the same kind.
    pub(super) fn silent(self) -> Self {
        match self {
            Self::Level { .. } => Self::Level { level_mps2: 0.0 },
            Self::Excitation { gain, .. } => Self::Excitation { variance: 0.0, gain },
        }
    }
}
