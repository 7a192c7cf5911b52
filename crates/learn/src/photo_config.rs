//! Settings of a training on labelled photos.

use serde::{Deserialize, Serialize};
use shagreen_core::maths::kernel_ridge::KernelRidgeConfig;

/// Settings of a training on labelled photos.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoConfig {
    /// Exponent on the number of photos of a class that gives the weight of each of them: -1 weights all classes equally, 0
    /// all photos.
    pub class_exponent: f64,
    /// Penalty of the ridge regression, per unit of weight; above 0.
    pub ridge_penalty: f64,
    /// Penalty of the class probabilities: half the sum of squared coefficients is multiplied by it; above 0.
    pub class_penalty: f64,
    /// Settings of the small networks.
    pub network: SmallNetworkConfig,
    /// Settings of the kernel regression.
    #[serde(default)]
    pub kernel: KernelConfig,
    /// Contributions of the heads to the hardness.
    pub hardness: HeadWeights,
    /// Contribution of the class probabilities to the roughness, 0 to 1; the rest is that of the heads trained on drawn
    /// materials.
    pub roughness_of_classes: f64,
    /// Photos on whose errors the standard deviations are scaled.
    pub calibration: Calibration,
    /// Seed of all random draws.
    pub seed: u64,
}

/// Contributions of the heads; only their ratios matter. A head with 0 is not trained, except the class probabilities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadWeights {
    /// Ridge regression.
    pub ridge: f64,
    /// Mean hardness of the classes, weighted by their probabilities.
    pub classes: f64,
    /// Small networks.
    pub network: f64,
    /// Kernel regression. It helps with classes that were left out, but not with sources; the usual settings have none.
    #[serde(default)]
    pub kernel: f64,
}

impl HeadWeights {
    /// Returns whether the weights are usable: finite, 0 or more, and not all zero.
    pub fn is_sound(&self) -> bool {
        let weights = [self.ridge, self.classes, self.network, self.kernel];
        weights.iter().all(|weight| weight.is_finite() && *weight >= 0.0) && weights.iter().sum::<f64>() > 0.0
    }
}

/// Settings of the small networks: one hidden layer with dropout (N. Srivastava and others 2014) and decoupled weight
/// decay (I. Loshchilov and F. Hutter 2019).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SmallNetworkConfig {
    /// Units of the hidden layer.
    pub n_hidden: usize,
    /// Probability that a unit is left out of a training step, 0 to below 1.
    pub dropout: f64,
    /// Weight decay: the share of each weight that is lost per step, relative to the learning rate.
    pub weight_decay: f64,
    /// Learning rate of Adam.
    pub learning_rate: f64,
    /// Number of epochs.
    pub n_epochs: usize,
    /// Rows per batch.
    pub n_batch: usize,
    /// Number of networks, whose predictions are averaged.
    pub n_networks: usize,
}

/// Settings of the kernel regression.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KernelConfig {
    /// Number of principal components of the features.
    pub n_components: usize,
    /// Decay of the kernel with the mean squared difference of the components; above 0.
    pub decay: f64,
    /// Penalty of a photo of mean weight; above 0.
    pub penalty: f64,
}

impl Default for KernelConfig {
    /// The settings with the smallest error on classes that were left out.
    fn default() -> Self {
        Self { n_components: 60, decay: 0.5, penalty: 0.2 }
    }
}

impl From<KernelConfig> for KernelRidgeConfig {
    fn from(config: KernelConfig) -> Self {
        let KernelConfig { n_components, decay, penalty } = config;
        Self { n_components, decay, penalty }
    }
}

/// Photos on whose errors the standard deviations are scaled. Each was left out of the training that predicted it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Calibration {
    /// Photos whose whole class was left out.
    Classes,
    /// Photos whose whole source was left out.
    Sources,
    /// Both.
    Both,
}

impl PhotoConfig {
    /// Returns the usual settings with this seed.
    pub fn usual(seed: u64) -> Self {
        Self {
            class_exponent: -0.8,
            // 30 for each of 640 features and 15,000 rows.
            ridge_penalty: 1.28,
            class_penalty: 0.01,
            network: SmallNetworkConfig {
                n_hidden: 64,
                dropout: 0.5,
                weight_decay: 0.03,
                learning_rate: 1e-3,
                n_epochs: 20,
                n_batch: 128,
                n_networks: 3,
            },
            kernel: KernelConfig::default(),
            hardness: HeadWeights { ridge: 1.0, classes: 1.0, network: 1.0, kernel: 0.0 },
            roughness_of_classes: 0.5,
            calibration: Calibration::Classes,
            seed,
        }
    }

    /// Returns whether all settings are usable.
    pub fn is_sound(&self) -> bool {
        let is_positive = |x: f64| x.is_finite() && x > 0.0;
        let SmallNetworkConfig {
            n_hidden,
            dropout,
            weight_decay,
            learning_rate,
            n_epochs,
            n_batch,
            n_networks,
        } = self.network;
        self.class_exponent.is_finite()
            && is_positive(self.ridge_penalty)
            && is_positive(self.class_penalty)
            && KernelRidgeConfig::from(self.kernel).is_sound()
            && self.hardness.is_sound()
            && (0.0..=1.0).contains(&self.roughness_of_classes)
            && (0.0..1.0).contains(&dropout)
            && weight_decay.is_finite()
            && weight_decay >= 0.0
            && is_positive(learning_rate)
            && [n_hidden, n_epochs, n_batch, n_networks].iter().all(|n| (1..=1 << 14).contains(n))
    }
}

#[cfg(test)]
mod tests {
    use super::{HeadWeights, KernelConfig, PhotoConfig, SmallNetworkConfig};

    #[test]
    fn unusable_settings_are_found() {
        let usual = PhotoConfig::usual(1);
        assert!(usual.is_sound());
        let none = HeadWeights { ridge: 0.0, classes: 0.0, network: 0.0, kernel: 0.0 };
        let negative = HeadWeights { classes: -1.0, ..usual.hardness };
        let network = |change: fn(&mut SmallNetworkConfig)| {
            let mut config = usual.clone();
            change(&mut config.network);
            config
        };
        for config in [
            PhotoConfig { ridge_penalty: 0.0, ..usual.clone() },
            PhotoConfig { class_penalty: f64::NAN, ..usual.clone() },
            PhotoConfig { roughness_of_classes: 1.1, ..usual.clone() },
            PhotoConfig { hardness: none, ..usual.clone() },
            PhotoConfig { kernel: KernelConfig { penalty: 0.0, ..usual.kernel }, ..usual.clone() },
            PhotoConfig { hardness: negative, ..usual.clone() },
            network(|config| config.dropout = 1.0),
            network(|config| config.n_networks = 0),
        ] {
            assert!(!config.is_sound(), "{config:?}");
        }
    }
}
