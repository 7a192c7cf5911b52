//! Regression model of an axis.

/// One feature of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Index of the feature.
    pub feature: usize,
    /// Mean that is subtracted from the feature.
    pub mean: f64,
    /// Weight of the centered feature.
    pub weight: f64,
}

/// Position on an axis as a cubic polynomial of a weighted sum of features.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisModel {
    /// Terms of the sum `t = Σ weight · (feature - mean)`. Without terms, the position is the same for every texture.
    pub terms: Vec<Term>,
    /// Coefficients of 1, t, t² and t³.
    pub polynomial: [f64; 4],
}

impl AxisModel {
    /// Model that predicts the same position for every texture.
    pub fn constant(position: f64) -> Self {
        Self { terms: Vec::new(), polynomial: [position, 0.0, 0.0, 0.0] }
    }

    /// Predicted position of a texture with these features, clipped to 0..100; `None` if a feature of the model is
    /// missing or not finite.
    pub fn predict(&self, features: &[f64]) -> Option<f64> {
        let known = |term: &Term| features.get(term.feature).is_some_and(|f| f.is_finite());
        self.terms.iter().all(known).then(|| self.raw(|feature| features[feature]).clamp(0.0, 100.0))
    }

    /// Indices of the features in the model.
    pub fn features(&self) -> impl Iterator<Item = usize> + '_ {
        self.terms.iter().map(|term| term.feature)
    }

    /// Predicted position before clipping.
    pub(super) fn raw(&self, feature: impl Fn(usize) -> f64) -> f64 {
        let t: f64 = self.terms.iter().map(|term| term.weight * (feature(term.feature) - term.mean)).sum();
        let [c0, c1, c2, c3] = self.polynomial;
        c0 + t * (c1 + t * (c2 + t * c3))
    }
}
