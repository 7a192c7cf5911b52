//! Feature matrix of a set of textures.

use super::{MIN_TEXTURES, SelectionError};
use crate::maths::statistics::is_constant;

/// Features of textures, stored feature by feature, because selection scans one feature after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureMatrix {
    n_textures: usize,
    values: Vec<f64>,
}

impl FeatureMatrix {
    /// Matrix from rows of features, one row per texture.
    ///
    /// # Errors
    /// [`SelectionError::NoFeatures`], [`SelectionError::RowLength`] or [`SelectionError::FeatureNotFinite`].
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, SelectionError> {
        let n_features = rows.first().map_or(0, Vec::len);
        if n_features == 0 {
            return Err(SelectionError::NoFeatures);
        }
        let mut values = vec![0.0; rows.len() * n_features];
        for (texture, row) in rows.iter().enumerate() {
            if row.len() != n_features {
                return Err(SelectionError::RowLength { texture, n: row.len(), expected: n_features });
            }
            for (feature, value) in row.iter().enumerate() {
                if !value.is_finite() {
                    return Err(SelectionError::FeatureNotFinite { texture, feature });
                }
                values[feature * rows.len() + texture] = *value;
            }
        }
        Ok(Self { n_textures: rows.len(), values })
    }

    /// Number of textures.
    pub fn n_textures(&self) -> usize {
        self.n_textures
    }

    /// Number of features.
    pub fn n_features(&self) -> usize {
        self.values.len() / self.n_textures
    }

    /// Values of one feature for all textures.
    ///
    /// # Panics
    /// If the feature index is out of range.
    pub fn column(&self, feature: usize) -> &[f64] {
        &self.values[feature * self.n_textures..(feature + 1) * self.n_textures]
    }

    /// Value of one feature of one texture.
    ///
    /// # Panics
    /// If an index is out of range.
    pub fn value(&self, texture: usize, feature: usize) -> f64 {
        self.column(feature)[texture]
    }
}

/// Checks that features and target positions are valid for a selection.
///
/// # Errors
/// See [`SelectionError`].
pub(super) fn check(features: &FeatureMatrix, target: &[f64]) -> Result<(), SelectionError> {
    let n = features.n_textures();
    if n != target.len() {
        return Err(SelectionError::TargetLength { n_features: n, n_target: target.len() });
    }
    if let Some(texture) = target.iter().position(|t| !(0.0..=100.0).contains(t)) {
        return Err(SelectionError::Target { texture, value: target[texture] });
    }
    if n < MIN_TEXTURES {
        return Err(SelectionError::TooFew { n });
    }
    if is_constant(target) {
        return Err(SelectionError::ConstantTarget);
    }
    if (0..features.n_features()).all(|f| is_constant(features.column(f))) {
        return Err(SelectionError::ConstantFeatures);
    }
    Ok(())
}
