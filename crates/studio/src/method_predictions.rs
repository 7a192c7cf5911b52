//! Predictions of attributes by a method for textures that it was not trained on, and their errors.

use shagreen_core::maths::statistics::mean;

/// Predictions of one method for all textures.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodPredictions {
    /// Name of the method.
    pub name: String,
    /// Predicted attributes: textures × attributes, 0..100.
    pub predicted: Vec<Vec<f64>>,
}

/// Name of the baseline.
const BASELINE: &str = "mean of the others";

impl MethodPredictions {
    /// Returns whether this is the baseline, which does not look at a texture.
    pub fn is_baseline(&self) -> bool {
        self.name == BASELINE
    }

    /// Baseline: the prediction for each texture is the mean of the others. `values` are textures × attributes.
    pub fn mean_of_others(values: &[Vec<f64>]) -> Self {
        let n_attributes = values.first().map_or(0, Vec::len);
        let without = |index: usize, attribute: usize| {
            let others = values.iter().enumerate().filter(|(i, _)| *i != index);
            mean(&others.map(|(_, values)| values[attribute]).collect::<Vec<f64>>())
        };
        let of = |index| (0..n_attributes).map(|attribute| without(index, attribute)).collect();
        Self { name: BASELINE.to_owned(), predicted: (0..values.len()).map(of).collect() }
    }

    /// Returns the mean absolute error of each attribute, in points of 0..100. `values` are the true ones (textures ×
    /// attributes).
    pub fn mae(&self, values: &[Vec<f64>]) -> Vec<f64> {
        self.by_attribute(values, mean)
    }

    /// Returns the root mean square error (RMSE) of each attribute, in points of 0..100. `values` are the true ones
    /// (textures × attributes).
    pub fn rmse(&self, values: &[Vec<f64>]) -> Vec<f64> {
        let square =
            |errors: &[f64]| mean(&errors.iter().map(|error| error * error).collect::<Vec<f64>>()).sqrt();
        self.by_attribute(values, square)
    }

    /// `of` the absolute errors of each attribute.
    fn by_attribute(&self, values: &[Vec<f64>], of: impl Fn(&[f64]) -> f64) -> Vec<f64> {
        let n_attributes = values.first().map_or(0, Vec::len);
        let errors = |attribute: usize| -> Vec<f64> {
            self.predicted.iter().zip(values).map(|(p, v)| (p[attribute] - v[attribute]).abs()).collect()
        };
        (0..n_attributes).map(|attribute| of(&errors(attribute))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::MethodPredictions;

    #[test]
    fn errors_are_their_definitions() {
        let values = vec![vec![10.0, 0.0], vec![20.0, 50.0], vec![60.0, 100.0]];
        let mean = MethodPredictions::mean_of_others(&values);
        assert_eq!(mean.predicted, [[40.0, 75.0], [35.0, 50.0], [15.0, 25.0]]);
        assert_eq!(mean.mae(&values)[0], 30.0);
        let predicted = vec![vec![13.0, 0.0], vec![24.0, 50.0], vec![60.0, 95.0]];
        let near = MethodPredictions { name: "near".to_owned(), predicted };
        assert!((near.mae(&values)[0] - 7.0 / 3.0).abs() < 1e-12);
        assert!((near.rmse(&values)[0] - (25.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert!(mean.is_baseline() && !near.is_baseline());
        assert!(near.mae(&[]).is_empty());
    }
}
