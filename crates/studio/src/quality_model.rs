//! Models of felt difference that a user chooses: the built-in one, or a file of `shagreen quality fit`.

use std::path::Path;

use anyhow::Context as _;
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::project::sha256_hex;
use shagreen_formats::quality_model::{
    ModelFit, QualityModelFile, built_in_quality_model, read_quality_model,
};
use shagreen_formats::thresholds::ThresholdKind;

use crate::file::{in_file, read_file, shown_name};

/// A model that predicts d′, with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenModel {
    /// Name of the file, or [`BUILT_IN`].
    pub name: String,
    /// SHA-256 of the file, in hexadecimal digits; `None` for the built-in model.
    pub sha256: Option<String>,
    /// The model and its origin.
    pub file: QualityModelFile,
}

/// Name of the built-in model.
pub const BUILT_IN: &str = "built-in";

/// Nested R² up to which a model says nothing about other textures. Always stating the mean of all ratings has an R² of 0; the
/// limit is ours.
pub const NOTHING_PREDICTED: f64 = 0.1;

/// Loads a model file; `None` is the built-in model.
///
/// # Errors
/// The file cannot be read, or it is no model that this version knows; the message says which and what to do.
pub fn load_quality_model(path: Option<&Path>) -> anyhow::Result<ChosenModel> {
    let Some(path) = path else {
        let file = built_in_quality_model().context("the built-in model is damaged; reinstall Shagreen")?;
        return Ok(ChosenModel { name: BUILT_IN.to_owned(), sha256: None, file });
    };
    let bytes = read_file(path, FileKind::Small)?;
    let file = read_quality_model(&bytes).with_context(|| in_file(path))?;
    Ok(ChosenModel { name: shown_name(path), sha256: Some(sha256_hex(&bytes)), file })
}

impl ChosenModel {
    /// Detection threshold with which the model was fitted, or else the usual one.
    pub fn threshold(&self) -> ThresholdKind {
        self.file.threshold.unwrap_or_default()
    }

    /// Origin and validation of the model in one clause: "fitted to 25 pairs of 5 textures, nested R² 0.71".
    pub fn origin(&self) -> String {
        self.file.fit.as_ref().map_or_else(|| "published weights".to_owned(), origin_of)
    }

    /// Why the predictions of the model are of little use, or a doubt about its ratings; `None` without either.
    pub fn doubt(&self) -> Option<String> {
        let fit = self.file.fit.as_ref()?;
        if fit.is_simulated {
            return Some(format!("{}: simulated participants rated its pairs, not people", self.name));
        }
        predicts_nothing(fit.nested_r_squared).then(|| {
            format!("{}: it predicts nothing about other textures; fit a model to more pairs", self.name)
        })
    }
}

/// Whether a model with this nested R² says nothing about other textures; `None` is that of equal ratings.
pub fn predicts_nothing(nested_r_squared: Option<f64>) -> bool {
    nested_r_squared.is_none_or(|r_squared| r_squared <= NOTHING_PREDICTED)
}

fn origin_of(fit: &ModelFit) -> String {
    let by = if fit.is_simulated { ", simulated participants" } else { "" };
    let nested = fit.nested_r_squared.map_or_else(|| "not defined".to_owned(), |r| format!("{r:.2}"));
    format!(
        "fitted to {} of {}{by}, nested R² {nested}",
        counted(fit.n_pairs, "pair"),
        counted(fit.n_textures, "texture")
    )
}

#[cfg(test)]
mod tests {
    use super::{BUILT_IN, ChosenModel, load_quality_model, predicts_nothing};
    use crate::file::one_line;
    use shagreen_formats::quality_model::{ModelFit, write_quality_model};
    use shagreen_formats::thresholds::ThresholdKind;

    fn fitted(nested_r_squared: Option<f64>, is_simulated: bool) -> ChosenModel {
        let mut model = load_quality_model(None).unwrap();
        "lab.json".clone_into(&mut model.name);
        model.file.fit = Some(ModelFit {
            table_sha256: "ab".repeat(32),
            n_pairs: 25,
            n_textures: 5,
            r_squared: Some(0.9),
            nested_r_squared,
            is_simulated,
            tolerance: 0.2,
            standard_errors: vec![None; 4],
        });
        model
    }

    #[test]
    fn a_model_is_loaded_with_its_name_and_hash_or_refused_in_one_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lab.json");
        let mut wanted = fitted(Some(0.7), false);
        wanted.file.threshold = Some(ThresholdKind::Pacinian);
        let bytes = write_quality_model(&wanted.file);
        std::fs::write(&path, &bytes).unwrap();
        let model = load_quality_model(Some(&path)).unwrap();
        assert_eq!((&model.name, &model.file), (&wanted.name, &wanted.file));
        assert_eq!(model.sha256.as_ref().map(String::len), Some(64));
        assert_eq!(model.threshold(), ThresholdKind::Pacinian);
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        let error = one_line(&load_quality_model(Some(&path)).unwrap_err());
        assert!(error.contains("damaged") && error.ends_with("lab.json"), "{error}");
        std::fs::write(&path, r#"{"format": "shagreen-library", "version": "1.0"}"#).unwrap();
        let error = one_line(&load_quality_model(Some(&path)).unwrap_err());
        assert!(error.starts_with("this is not a quality model"), "{error}");
        let error = one_line(&load_quality_model(Some(folder.path())).unwrap_err());
        assert!(error.contains("it is a folder"), "{error}");
    }

    #[test]
    fn origins_and_doubts_are_said() {
        let built_in = load_quality_model(None).unwrap();
        assert_eq!((built_in.name.as_str(), built_in.doubt()), (BUILT_IN, None));
        assert_eq!(built_in.origin(), "published weights");
        let good = fitted(Some(0.713), false);
        assert_eq!(
            (good.origin().as_str(), good.doubt()),
            ("fitted to 25 pairs of 5 textures, nested R² 0.71", None)
        );
        for nothing in [Some(-0.3), Some(0.05), None] {
            assert!(predicts_nothing(nothing));
            assert!(fitted(nothing, false).doubt().unwrap().contains("predicts nothing"), "{nothing:?}");
        }
        let simulated = fitted(Some(0.9), true);
        assert!(simulated.origin().contains("simulated participants"));
        assert!(simulated.doubt().unwrap().contains("not people"));
    }
}
