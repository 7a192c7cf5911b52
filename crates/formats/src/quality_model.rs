//! The built-in model of perceived quality: the weights of the paper, with scaling lengths from our own corpus.

use serde::{Deserialize, Serialize};
use shagreen_core::signals::quality::{Feature, QualityModel, QualityModelError, Term};

use crate::layout;

const BYTES: &[u8] = include_bytes!("../../../assets/quality/paper.json");

/// The model, as the JSON file stores it.
#[derive(Debug, Serialize, Deserialize)]
struct ModelV1 {
    /// Description of the corpus that the lengths were computed from, for people.
    corpus: String,
    terms: Vec<TermV1>,
}

#[derive(Debug, Serialize, Deserialize)]
struct TermV1 {
    feature: String,
    weight: f64,
    length: f64,
}

/// Why the model is unavailable.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QualityModelFileError {
    /// The JSON file is invalid.
    #[error("the built-in quality model is damaged: {0}; reinstall the program")]
    Json(#[from] serde_json::Error),
    /// A feature is unknown.
    #[error("the built-in quality model has the unknown feature \"{name}\"; reinstall the program")]
    Feature {
        /// Name of the feature.
        name: String,
    },
    /// The terms do not form a valid model.
    #[error(transparent)]
    Model(#[from] QualityModelError),
}

/// Returns the built-in model, for signals at [`shagreen_core::signals::quality::PAPER_RATE`].
///
/// # Errors
/// Fails only if the embedded file is damaged, which a test excludes.
pub fn built_in_quality_model() -> Result<QualityModel, QualityModelFileError> {
    let model: ModelV1 = serde_json::from_slice(BYTES)?;
    let term = |term: TermV1| match Feature::from_id(&term.feature) {
        Some(feature) => Ok(Term { feature, weight: term.weight, length: term.length }),
        None => Err(QualityModelFileError::Feature { name: term.feature }),
    };
    let terms = model.terms.into_iter().map(term).collect::<Result<_, _>>()?;
    Ok(QualityModel::of_terms(terms)?)
}

/// Serializes a model as JSON; `corpus` describes the data that its lengths were computed from.
pub fn write_quality_model(model: &QualityModel, corpus: &str) -> Vec<u8> {
    let term = |term: &Term| TermV1 {
        feature: term.feature.id().to_owned(),
        weight: term.weight,
        length: format!("{:.4e}", term.length).parse().unwrap_or(term.length),
    };
    layout::to_bytes(
        &ModelV1 { corpus: corpus.to_owned(), terms: model.terms().iter().map(term).collect() },
        2,
    )
}

#[cfg(test)]
mod tests {
    use super::{BYTES, ModelV1, built_in_quality_model, write_quality_model};
    use shagreen_core::signals::quality::{PAPER_FEATURES, PAPER_WEIGHTS};

    #[test]
    fn the_committed_file_is_sound_and_is_what_is_written() {
        let model = built_in_quality_model().unwrap();
        assert!(model.terms().iter().map(|term| term.feature).eq(PAPER_FEATURES));
        assert!(model.terms().iter().map(|term| term.weight).eq(PAPER_WEIGHTS));
        let ModelV1 { corpus, .. } = serde_json::from_slice(BYTES).unwrap();
        assert_eq!(write_quality_model(&model, &corpus), BYTES);
    }
}
