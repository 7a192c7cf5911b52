//! Features of textures, feature by feature.

use super::SelectionError;

/// Features of textures. Feature by feature in memory, since selection goes through one feature after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureMatrix {
    n_textures: usize,
    values: Vec<f64>,
}

impl FeatureMatrix {
    /// The table of these rows, one a texture.
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

    /// One feature of all textures.
    ///
    /// # Panics
    /// If there is no such feature.
    pub fn column(&self, feature: usize) -> &[f64] {
        &self.values[feature * self.n_textures..(feature + 1) * self.n_textures]
    }

    /// One feature of one texture.
    ///
    /// # Panics
    /// If there is no such feature or texture.
    pub fn value(&self, texture: usize, feature: usize) -> f64 {
        self.column(feature)[texture]
    }
}
