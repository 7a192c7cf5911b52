//! Prediction of the attributes of a texture from those of the textures of a library.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::attribute_predictor::{predict, quantities, without_features};
use shagreen_core::texture::TextureModel;
use shagreen_formats::attribute_table::{AttributeTable, attribute_table};
use shagreen_formats::library::Library;

/// Standard deviation of a value that may lie anywhere from 0 to 100 with the same probability, `100/√12`.
pub const UNIFORM_DEVIATION: f64 = 28.87;
/// Name of the predictor of prompts.
pub const LEXICON: &str = "lexicon of estimated attributes";

/// Attributes predicted by a Gaussian process over a library.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictedAttributes {
    /// Training data: the attributes of the library, whose names are those of the estimates.
    pub table: AttributeTable,
    /// Predictions, each 0 to 100 with a standard deviation, in the order of the names.
    pub estimates: Vec<Estimate>,
    /// Mean and standard deviation of the training data. A prediction with at least this standard deviation says nothing.
    pub labels: Vec<Estimate>,
    /// Name of the library.
    pub library: String,
}

impl PredictedAttributes {
    /// Returns what predicted the attributes, as a phrase.
    pub fn predictor(&self) -> String {
        format!("a Gaussian process over {}", self.table.of_library(&self.library))
    }
}

/// Predicts the attributes of a texture.
///
/// # Errors
/// The library has neither attributes nor positions, has too few of them, or has no feature in common with the texture.
pub fn attributes_of_model(library: &Library, model: &TextureModel) -> anyhow::Result<PredictedAttributes> {
    let table = attribute_table(library)?;
    let known = table.known(library);
    let estimates = predict(&known, &quantities(model))?;
    let labels = without_features(&known);
    Ok(PredictedAttributes { table, estimates, labels, library: library.name.clone() })
}

#[cfg(test)]
mod tests {
    use super::attributes_of_model;
    use shagreen_formats::library::Library;
    use shagreen_formats::starter::simulated_library;

    #[test]
    fn each_attribute_of_the_library_has_an_estimate() {
        let library = simulated_library().unwrap();
        let model = library.textures[0].model.clone();
        let predicted = attributes_of_model(&library, &model).unwrap();
        let n = predicted.table.names.len();
        assert_eq!((predicted.estimates.len(), predicted.labels.len()), (n, n));
        assert!(predicted.estimates.iter().all(|of| (0.0..=100.0).contains(&of.mean) && of.deviation > 0.0));
        assert!(predicted.predictor().contains("25 textures"), "{}", predicted.predictor());
        let error = attributes_of_model(&Library::default(), &model).unwrap_err().to_string();
        assert!(error.contains("attributes or a position"), "{error}");
    }
}
