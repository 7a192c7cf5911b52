//! Fit of a model of felt difference (a quality model) to rated pairs of signals.

mod figures;
mod pairs;
mod report;
#[cfg(test)]
mod tests;

use shagreen_core::signals::quality::{Feature, QualityFit, fit_quality_model};
use shagreen_core::words::counted;
use shagreen_formats::quality_model::{ModelFit, QualityModelFile};

pub use figures::{FIGURE_NAMES, fit_figures};
pub use pairs::{RatedPairs, load_pairs, signal_file};
pub use report::{FORMAT, fit_report, fit_text, verdict};

/// A model with the pairs that it was fitted to.
#[derive(Clone, Debug)]
pub struct FittedModel {
    /// The pairs.
    pub pairs: RatedPairs,
    /// Features among which the model was selected.
    pub candidates: Vec<Feature>,
    /// Relative rise of the squared error at which elimination stopped.
    pub tolerance: f64,
    /// Selection, weights and validation.
    pub fit: QualityFit,
}

/// Fits a model to rated pairs. `candidates` are the features to select from; `None` takes all whose distances are known.
/// `tolerance` is the relative rise of the squared error at which the elimination stops, 0 or more.
///
/// # Errors
/// There are too few pairs or textures, no two signals or no two ratings differ, or a candidate has no distances; the message says what to do.
pub fn fit_pairs(
    pairs: RatedPairs,
    candidates: Option<&[Feature]>,
    tolerance: f64,
) -> anyhow::Result<FittedModel> {
    let candidates = candidates.map_or_else(|| pairs.features.clone(), <[Feature]>::to_vec);
    if let Some(missing) = candidates.iter().find(|feature| !pairs.features.contains(feature)) {
        let known: Vec<&str> = pairs.features.iter().map(|feature| feature.id()).collect();
        anyhow::bail!(
            "the table states no distances in {}, only in {}; choose among these, or add the column",
            missing.id(),
            known.join(", ")
        );
    }
    let fit = fit_quality_model(&candidates, &pairs.rated, tolerance)?;
    Ok(FittedModel { pairs, candidates, tolerance, fit })
}

impl FittedModel {
    /// The model file, with its origin.
    pub fn file(&self) -> QualityModelFile {
        let Self { pairs, fit, .. } = self;
        let (n_pairs, n_textures) = (pairs.rated.len(), pairs.textures.len());
        QualityModelFile {
            model: fit.model.clone(),
            corpus: format!(
                "{} of {} in {}, {}",
                counted(n_pairs, "rated pair"),
                counted(n_textures, "texture"),
                pairs.table,
                self.source()
            ),
            threshold: pairs.threshold,
            fit: Some(ModelFit {
                table_sha256: pairs.sha256.clone(),
                n_pairs,
                n_textures,
                r_squared: fit.r_squared,
                nested_r_squared: fit.nested.r_squared,
                is_simulated: pairs.is_simulated(),
                tolerance: self.tolerance,
                standard_errors: fit.standard_errors.clone(),
            }),
        }
    }

    /// Who rated the pairs, as far as the table says it.
    pub fn source(&self) -> &'static str {
        if self.pairs.is_simulated() { "rated by simulated participants" } else { "as rated in the table" }
    }
}
