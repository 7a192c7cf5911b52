//! The option `--model` of commands that predict d'.

use std::path::PathBuf;

use serde_json::{Value, json};
use shagreen_studio::quality_model::{ChosenModel, load_quality_model};

use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct ModelArgs {
    /// Model of d': a file that `shagreen quality fit` wrote. Default: the built-in model, with published weights.
    #[arg(long, value_name = "MODEL.json")]
    model: Option<PathBuf>,
}

impl ModelArgs {
    /// Loads the model, and warns of one that predicts nothing or that simulated participants rated.
    pub(crate) fn load(&self) -> anyhow::Result<ChosenModel> {
        let chosen = load_quality_model(self.model.as_deref())?;
        if let Some(doubt) = chosen.doubt() {
            output::warn(&doubt);
        }
        Ok(chosen)
    }
}

/// Describes a model for scripts: name, hash, and how it was fitted.
pub(crate) fn model_json(model: &ChosenModel) -> Value {
    let fit = model.file.fit.as_ref();
    json!({
        "name": model.name,
        "sha256": model.sha256,
        "n": fit.map(|fit| fit.n_pairs),
        "nested_r2": fit.and_then(|fit| fit.nested_r_squared),
        "simulated": fit.map(|fit| fit.is_simulated),
    })
}
