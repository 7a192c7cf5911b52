//! Models of felt difference (quality models) as files, and the built-in one: the weights of the paper, with scaling lengths
//! from our own corpus.
//!
//! A file is one JSON object with `format`, `version`, `corpus`, `threshold`, `terms` and, if `shagreen quality fit` wrote it,
//! `fit`. Fields of later minor versions are ignored.

use serde::{Deserialize, Serialize};
use shagreen_core::signals::quality::{Feature, QualityModel, QualityModelError, Term};

use crate::foreign_file::Found;
use crate::layout;
use crate::own_json::{HeaderFault, minor_version};
use crate::parser_words::plain;
use crate::text_limits::{self, MAX_NAME, MAX_NOTES, TooLong, begin_of};
use crate::thresholds::ThresholdKind;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-quality-model";

/// Ending of the names of model files.
pub const EXTENSION: &str = "json";

const VERSION_MAJOR: u32 = 1;
const VERSION: &str = "1.0";

const BYTES: &[u8] = include_bytes!("../../../assets/quality/paper.json");

/// A model with the description of its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct QualityModelFile {
    /// The model, for signals at [`shagreen_core::signals::quality::PAPER_RATE`].
    pub model: QualityModel,
    /// Description of the pairs that the lengths were computed from, for people.
    pub corpus: String,
    /// Detection threshold with which the distances of the corpus were computed; `None` if it is unknown.
    pub threshold: Option<ThresholdKind>,
    /// How the weights were fitted; `None` if they come from elsewhere, as those of the built-in model.
    pub fit: Option<ModelFit>,
}

/// How the weights of a model were fitted to rated pairs, and how far it can be trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFit {
    /// SHA-256 of the table of pairs, in hexadecimal digits.
    pub table_sha256: String,
    /// Number of rated pairs.
    pub n_pairs: usize,
    /// Number of textures of these pairs.
    pub n_textures: usize,
    /// R² on these pairs, which is optimistic; `None` if all ratings are equal.
    pub r_squared: Option<f64>,
    /// R² of nested cross-validation, negative for a model that predicts worse than the mean; `None` as above.
    pub nested_r_squared: Option<f64>,
    /// Whether simulated participants gave any of the ratings.
    pub is_simulated: bool,
    /// Relative rise of the squared error at which elimination stopped.
    pub tolerance: f64,
    /// Standard errors of the weights, one for each term of the model; `None` where there is none.
    pub standard_errors: Vec<Option<f64>>,
}

/// The file.
#[derive(Debug, Serialize, Deserialize)]
struct ModelV1 {
    format: String,
    version: String,
    corpus: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    threshold: Option<String>,
    terms: Vec<TermV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    fit: Option<FitV1>,
}

#[derive(Debug, Serialize, Deserialize)]
struct TermV1 {
    feature: String,
    weight: f64,
    length: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    standard_error: Option<f64>,
}

#[derive(Debug, Serialize, Deserialize)]
struct FitV1 {
    table_sha256: String,
    n_pairs: usize,
    n_textures: usize,
    r2: Option<f64>,
    nested_r2: Option<f64>,
    simulated: bool,
    tolerance: f64,
}

/// Why bytes are not a quality model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityModelFileError {
    /// Not JSON, truncated, or a field is missing or of the wrong type.
    #[error("the quality model is damaged: {reason}; restore it from a copy, or fit it again")]
    Damaged {
        /// The parser's message, with line and column.
        reason: String,
    },
    /// The file is of another format.
    #[error("{}", .found.instead_of("a quality model", FORMAT))]
    Format {
        /// What the file is.
        found: Found,
    },
    /// The version is of no known form, or its major version is not known.
    #[error(
        "the quality model has version {found}, but this program reads {VERSION_MAJOR}.x; open it with the version of Shagreen that wrote it, or a newer one"
    )]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// A feature is unknown.
    #[error(
        "the quality model has the unknown feature \"{name}\"; correct it, or use the version of Shagreen that wrote the file"
    )]
    Feature {
        /// Name of the feature.
        name: String,
    },
    /// A feature has two terms.
    #[error("the quality model has two terms of {}; remove one of them", .feature.id())]
    Twice {
        /// The feature.
        feature: Feature,
    },
    /// The detection threshold is unknown.
    #[error(
        "the quality model has the unknown threshold \"{name}\"; correct it, or use the version of Shagreen that wrote the file"
    )]
    Threshold {
        /// Identifier of the threshold.
        name: String,
    },
    /// A text is too long.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// The terms do not form a valid model.
    #[error(transparent)]
    Model(#[from] QualityModelError),
}

impl From<HeaderFault> for QualityModelFileError {
    fn from(fault: HeaderFault) -> Self {
        match fault {
            HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => Self::Damaged { reason },
            HeaderFault::Format(found) => Self::Format { found },
            HeaderFault::Version(found) | HeaderFault::Major(found) => Self::Version { found },
        }
    }
}

/// Returns the built-in model.
///
/// # Errors
/// Fails only if the embedded file is damaged, which a test excludes.
pub fn built_in_quality_model() -> Result<QualityModelFile, QualityModelFileError> {
    read_quality_model(BYTES)
}

/// Reads a model.
///
/// # Errors
/// See [`QualityModelFileError`].
pub fn read_quality_model(bytes: &[u8]) -> Result<QualityModelFile, QualityModelFileError> {
    minor_version(bytes, FORMAT, VERSION_MAJOR)?;
    let wire: ModelV1 = serde_json::from_slice(bytes)
        .map_err(|error| QualityModelFileError::Damaged { reason: plain(&error.to_string()) })?;
    text_limits::check("the description of the corpus", &wire.corpus, MAX_NOTES)?;
    let mut terms: Vec<Term> = Vec::with_capacity(wire.terms.len().min(Feature::ALL.len()));
    for TermV1 { feature, weight, length, .. } in &wire.terms {
        let known = Feature::from_id(feature);
        let feature = known
            .ok_or_else(|| QualityModelFileError::Feature { name: begin_of(feature.clone(), SHOWN_CHARS) })?;
        if terms.iter().any(|term| term.feature == feature) {
            return Err(QualityModelFileError::Twice { feature });
        }
        terms.push(Term { feature, weight: *weight, length: *length });
    }
    let threshold = |name: String| {
        let known = ThresholdKind::from_id(&name);
        known.ok_or_else(|| QualityModelFileError::Threshold { name: begin_of(name, SHOWN_CHARS) })
    };
    let standard_errors = wire.terms.iter().map(|term| term.standard_error).collect();
    let fit = match wire.fit {
        Some(fit) => {
            text_limits::check("the hash of the table", &fit.table_sha256, MAX_NAME)?;
            Some(fit.with(standard_errors))
        }
        None => None,
    };
    Ok(QualityModelFile {
        model: QualityModel::of_terms(terms)?,
        corpus: wire.corpus,
        threshold: wire.threshold.map(threshold).transpose()?,
        fit,
    })
}

/// Characters of a name from a file that an error shows.
const SHOWN_CHARS: usize = 40;

impl FitV1 {
    fn with(self, standard_errors: Vec<Option<f64>>) -> ModelFit {
        let Self { table_sha256, n_pairs, n_textures, r2, nested_r2, simulated, tolerance } = self;
        ModelFit {
            table_sha256,
            n_pairs,
            n_textures,
            r_squared: r2,
            nested_r_squared: nested_r2,
            is_simulated: simulated,
            tolerance,
            standard_errors,
        }
    }

    fn of(fit: &ModelFit) -> Self {
        Self {
            table_sha256: fit.table_sha256.clone(),
            n_pairs: fit.n_pairs,
            n_textures: fit.n_textures,
            r2: fit.r_squared,
            nested_r2: fit.nested_r_squared,
            simulated: fit.is_simulated,
            tolerance: fit.tolerance,
        }
    }
}

/// Serializes a model as JSON.
pub fn write_quality_model(file: &QualityModelFile) -> Vec<u8> {
    let standard_error = |index: usize| file.fit.as_ref()?.standard_errors.get(index).copied().flatten();
    let term = |(index, term): (usize, &Term)| TermV1 {
        feature: term.feature.id().to_owned(),
        weight: term.weight,
        length: term.length,
        standard_error: standard_error(index),
    };
    let wire = ModelV1 {
        format: FORMAT.to_owned(),
        version: VERSION.to_owned(),
        corpus: file.corpus.clone(),
        threshold: file.threshold.map(|kind| kind.id().to_owned()),
        terms: file.model.terms().iter().enumerate().map(term).collect(),
        fit: file.fit.as_ref().map(FitV1::of),
    };
    layout::to_bytes(&wire, 2)
}

#[cfg(test)]
mod tests {
    use super::{
        BYTES, ModelFit, QualityModelFile, QualityModelFileError, built_in_quality_model, read_quality_model,
        write_quality_model,
    };
    use crate::thresholds::ThresholdKind;
    use shagreen_core::signals::quality::{
        Feature, PAPER_FEATURES, PAPER_WEIGHTS, QualityModel, QualityModelError, Term,
    };

    fn fitted() -> QualityModelFile {
        let term = |feature, weight| Term { feature, weight, length: 1.0 / 3.0 };
        let terms = vec![term(Feature::Roughness, 1.25), term(Feature::Envelope, 0.0)];
        QualityModelFile {
            model: QualityModel::of_terms(terms).unwrap(),
            corpus: "12 simulated pairs".to_owned(),
            threshold: None,
            fit: Some(ModelFit {
                table_sha256: "ab".repeat(32),
                n_pairs: 12,
                n_textures: 4,
                r_squared: Some(0.5),
                nested_r_squared: None,
                is_simulated: true,
                tolerance: 0.2,
                standard_errors: vec![Some(0.25), None],
            }),
        }
    }

    #[test]
    fn the_committed_file_is_sound_and_is_what_is_written() {
        let file = built_in_quality_model().unwrap();
        assert!(file.model.terms().iter().map(|term| term.feature).eq(PAPER_FEATURES));
        assert!(file.model.terms().iter().map(|term| term.weight).eq(PAPER_WEIGHTS));
        assert_eq!((file.threshold, &file.fit), (Some(ThresholdKind::default()), &None));
        assert_eq!(write_quality_model(&file), BYTES);
    }

    #[test]
    fn a_fitted_model_comes_back_with_its_origin() {
        let file = fitted();
        let bytes = write_quality_model(&file);
        assert_eq!(read_quality_model(&bytes).unwrap(), file);
        let text = String::from_utf8(bytes).unwrap();
        assert!(
            text.contains(r#"{"feature":"envelope","weight":0.0,"length":0.3333333333333333}"#),
            "{text}"
        );
        // A later minor version may have further fields.
        let later = text.replace("\"1.0\"", "\"1.7\"").replace("\"n_pairs\"", "\"later\": [1], \"n_pairs\"");
        assert_eq!(read_quality_model(later.as_bytes()).unwrap(), file);
    }

    /// As version 1.0 was first written, with a fit and without.
    #[test]
    fn the_first_version_stays_readable() {
        let with_fit = r#"{
 "format": "shagreen-quality-model",
 "version": "1.0",
 "corpus": "12 simulated pairs",
 "terms": [
  {"feature":"roughness","weight":1.25,"length":0.3333333333333333,"standard_error":0.25},
  {"feature":"envelope","weight":0.0,"length":0.3333333333333333}
 ],
 "fit": {"table_sha256":"HASH","n_pairs":12,"n_textures":4,"r2":0.5,"nested_r2":null,"simulated":true,"tolerance":0.2}
}"#;
        let with_fit = with_fit.replace("HASH", &"ab".repeat(32));
        assert_eq!(read_quality_model(with_fit.as_bytes()).unwrap(), fitted());
        let (without_fit, _) = with_fit.split_once(",\n \"fit\"").unwrap();
        let read = read_quality_model(format!("{without_fit}\n}}").as_bytes()).unwrap();
        assert_eq!(read, QualityModelFile { fit: None, ..fitted() });
    }

    #[test]
    fn what_is_no_model_says_so() {
        let text = String::from_utf8(write_quality_model(&fitted())).unwrap();
        let check = |text: &str, words: &str| {
            let message = read_quality_model(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        check("", "the file is empty");
        check("RIFF", "this is not a quality model; choose another file");
        check(r#"{"format": "shagreen-library", "version": "1.0"}"#, "this is not a quality model");
        check(&text.replace("\"1.0\"", "\"2.0\""), "version 2.0, but this program reads 1.x");
        check(&text[..text.len() / 2], "the quality model is damaged");
        check(&text.replace("\"weight\"", "\"width\""), "damaged: the field `weight` is missing");
        check(&text.replace("envelope", "warmth"), "the unknown feature \"warmth\"");
        check(&text.replace("envelope", "roughness"), "two terms of roughness");
        check(&text.replace("\"terms\"", "\"threshold\": \"skin\", \"terms\""), "unknown threshold \"skin\"");
        check(&text.replace("1.25", "-1.25"), "the weight of roughness must be 0 or more");
        let none = text.replace("\"terms\"", "\"terms\": [], \"before\"");
        let nothing = QualityModelFileError::Model(QualityModelError::Nothing);
        assert_eq!(read_quality_model(none.as_bytes()), Err(nothing));
    }
}
