//! Features of the training textures, centered and scaled to unit length.

use super::FeatureMatrix;
use crate::maths::statistics::{dot, is_constant, mean};

/// Centered features divided by their length, so that the dot product of two is their correlation. A constant feature
/// is zero with length 1, so it correlates with nothing.
pub(super) struct Standardized {
    /// Number of textures.
    pub n: usize,
    /// Mean of each feature.
    pub means: Vec<f64>,
    /// Length of each centered feature, `sqrt(n - 1)` times its standard deviation.
    pub lengths: Vec<f64>,
    values: Vec<f64>,
    constant: Vec<bool>,
}

impl Standardized {
    pub(super) fn new(features: &FeatureMatrix, textures: &[usize]) -> Self {
        let (n, n_features) = (textures.len(), features.n_features());
        let (mut means, mut lengths) = (Vec::with_capacity(n_features), Vec::with_capacity(n_features));
        let (mut values, mut constant) = (Vec::with_capacity(n * n_features), Vec::with_capacity(n_features));
        let mut column = vec![0.0; n];
        for feature in 0..n_features {
            let of_all = features.column(feature);
            for (value, texture) in column.iter_mut().zip(textures) {
                *value = of_all[*texture];
            }
            let center = mean(&column);
            let flat = is_constant(&column);
            for value in &mut column {
                *value = if flat { 0.0 } else { *value - center };
            }
            let length = if flat { 1.0 } else { dot(&column, &column).sqrt() };
            values.extend(column.iter().map(|v| v / length));
            means.push(center);
            lengths.push(length);
            constant.push(flat);
        }
        Self { n, means, lengths, values, constant }
    }

    pub(super) fn column(&self, feature: usize) -> &[f64] {
        &self.values[feature * self.n..(feature + 1) * self.n]
    }

    pub(super) fn columns(&self) -> impl Iterator<Item = &[f64]> + '_ {
        self.values.chunks_exact(self.n)
    }

    /// Indices of the features that are not constant.
    pub(super) fn varying(&self) -> Vec<usize> {
        (0..self.means.len()).filter(|f| !self.constant[*f]).collect()
    }
}
