//! Scaling of features to the mean and standard deviation of the training pictures.

use candle_core::{Device, Result, Tensor};
use shagreen_core::maths::statistics::{mean, standard_deviation};

use crate::model_file::Numbers;

/// Smallest standard deviation that a feature is divided by; a nearly constant feature is not informative.
const LEAST_DEVIATION: f32 = 1e-6;
/// Limit of scaled features, in standard deviations, so that an unusual picture cannot cause an extreme prediction.
const LARGEST: f32 = 6.0;

/// Mean and standard deviation of each feature.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FeatureScale {
    means: Vec<f32>,
    deviations: Vec<f32>,
}

impl FeatureScale {
    /// Returns the scale of rows with the same number of features.
    pub(crate) fn of(rows: &[&[f32]]) -> Self {
        let column =
            |feature: usize| -> Vec<f64> { rows.iter().map(|row| f64::from(row[feature])).collect() };
        let n_features = rows.first().map_or(0, |row| row.len());
        let means = (0..n_features).map(|feature| mean(&column(feature)) as f32).collect();
        let deviations = (0..n_features).map(|feature| standard_deviation(&column(feature)) as f32).collect();
        Self { means, deviations }
    }

    /// Returns the number of features.
    pub(crate) fn n_features(&self) -> usize {
        self.means.len()
    }

    /// Returns the scaled features: mean 0 and standard deviation 1 over the training pictures, within -6 to 6.
    pub(crate) fn apply(&self, features: &[f32]) -> Vec<f32> {
        let of = |((x, mean), deviation): ((&f32, &f32), &f32)| {
            ((x - mean) / deviation.max(LEAST_DEVIATION)).clamp(-LARGEST, LARGEST)
        };
        features.iter().zip(&self.means).zip(&self.deviations).map(of).collect()
    }

    /// Adds the scale to the tensors of a file, with names that begin with `prefix`.
    pub(crate) fn add_to(&self, numbers: &mut Numbers, prefix: &str) -> Result<()> {
        for (name, values) in [("scale.mean", &self.means), ("scale.deviation", &self.deviations)] {
            let tensor = Tensor::from_slice(values, values.len(), &Device::Cpu)?;
            numbers.insert(format!("{prefix}{name}"), tensor);
        }
        Ok(())
    }

    /// Reads what [`FeatureScale::add_to`] wrote.
    ///
    /// # Errors
    /// A tensor is missing or does not have `n_features` values.
    pub(crate) fn read(numbers: &Numbers, prefix: &str, n_features: usize) -> Result<Self> {
        let values = |name: &str| {
            let name = format!("{prefix}{name}");
            match numbers.get(&name) {
                Some(tensor) if tensor.dims() == [n_features] => tensor.to_vec1::<f32>(),
                _ => candle_core::bail!("tensor \"{name}\" does not have {n_features} values"),
            }
        };
        Ok(Self { means: values("scale.mean")?, deviations: values("scale.deviation")? })
    }
}

/// Returns the RMS of scaled features (unlikeness): about one for a picture similar to the training set.
pub(crate) fn unlikeness(row: &[f32]) -> f64 {
    mean(&row.iter().map(|x| f64::from(*x).powi(2)).collect::<Vec<f64>>()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{FeatureScale, unlikeness};
    use crate::model_file::Numbers;

    #[test]
    fn features_are_standardized_and_limited() {
        let rows: [&[f32]; 3] = [&[1.0, 5.0], &[3.0, 5.0], &[5.0, 5.0]];
        let scale = FeatureScale::of(&rows);
        assert_eq!(scale.apply(&[5.0, 5.0]), [1.0, 0.0]);
        assert_eq!(scale.apply(&[1e9, 4.0]), [6.0, -6.0]);
        assert_eq!(unlikeness(&[1.0, 0.0, 2.0, -2.0]), 1.5);
        let mut numbers = Numbers::new();
        scale.add_to(&mut numbers, "x.").unwrap();
        assert_eq!(FeatureScale::read(&numbers, "x.", 2).unwrap(), scale);
        assert!(
            FeatureScale::read(&numbers, "x.", 3).is_err() && FeatureScale::read(&numbers, "", 2).is_err()
        );
    }
}
