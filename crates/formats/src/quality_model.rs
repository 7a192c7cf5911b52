//! The quality model that is built into the program: the weights of the paper, with the lengths of a corpus of ours.

use serde::{Deserialize, Serialize};
use shagreen_core::quality::{Feature, QualityModel, QualityModelError, Term};

use crate::layout;

const BYTES: &[u8] = include_bytes!("../../../assets/quality/paper.json");

/// The model as JSON.
#[derive(Debug, Serialize, Deserialize)]
struct ModelV1 {
    /// What the lengths are those of, for people.
    corpus: String,
    terms: Vec<TermV1>,
}

#[derive(Debug, Serialize, Deserialize)]
struct TermV1 {
    feature: String,
    weight: f64,
    length: f64,
}

/// Why there is no model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QualityModelFileError {
    /// No JSON of a model.
    #[error("the quality model is damaged: {0}; install the program again")]
    Json(#[from] serde_json::Error),
    /// A feature that there is not.
    #[error("the quality model has a feature \"{name}\", which there is not; install the program again")]
    Feature {
        /// Its name.
        name: String,
    },
    /// Terms that make no model.
    #[error(transparent)]
    Model(#[from] QualityModelError),
}

/// The model of the program, for signals of [`shagreen_core::quality::PAPER_RATE`].
///
/// # Errors
/// None, as long as the committed file is sound, which a test holds.
pub fn built_in_quality_model() -> Result<QualityModel, QualityModelFileError> {
    let model: ModelV1 = serde_json::from_slice(BYTES)?;
    let term = |term: TermV1| match Feature::from_id(&term.feature) {
        Some(feature) => Ok(Term { feature, weight: term.weight, length: term.length }),
        None => Err(QualityModelFileError::Feature { name: term.feature }),
    };
    let terms = model.terms.into_iter().map(term).collect::<Result<_, _>>()?;
    Ok(QualityModel::of_terms(terms)?)
}

/// A model as the bytes of its file; `corpus` says what its lengths are those of.
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
    use shagreen_core::quality::{PAPER_FEATURES, PAPER_WEIGHTS};

    #[test]
    fn the_committed_file_is_sound_and_is_what_is_written() {
        let model = built_in_quality_model().unwrap();
        assert!(model.terms().iter().map(|term| term.feature).eq(PAPER_FEATURES));
        assert!(model.terms().iter().map(|term| term.weight).eq(PAPER_WEIGHTS));
        let ModelV1 { corpus, .. } = serde_json::from_slice(BYTES).unwrap();
        assert_eq!(write_quality_model(&model, &corpus), BYTES);
    }
}
