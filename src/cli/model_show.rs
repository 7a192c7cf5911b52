//! `shagreen model show`: shows what a model file predicts, what it was trained on, and how large its errors are.

use std::path::PathBuf;

use anyhow::Context as _;
use serde_json::{Value, json};
use shagreen_formats::bounded_file::FileKind;
use shagreen_learn::attribute_model::AttributeModel;
use shagreen_learn::model_file::{kind_of, sha256_of};
use shagreen_learn::stroke_model::{self, StrokeModel};

use crate::cli::output;
use shagreen_studio::file;

/// Shows the card of a trained model: what it predicts, its training data with their licenses, its errors and its limits.
///
/// Models come from `shagreen train photo` and `shagreen train attributes`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Model file.
    model: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let bytes = file::read_file(&args.model, FileKind::Network)?;
    let (result, lines) = described(&bytes).with_context(|| file::in_file(&args.model))?;
    output::print(args.json, &result, || lines.join("\n"));
    Ok(())
}

/// Returns the description of a model as JSON and as lines.
fn described(bytes: &[u8]) -> anyhow::Result<(Value, Vec<String>)> {
    let kind = kind_of(bytes)?;
    let sha256 = sha256_of(bytes);
    if kind == stroke_model::MODEL {
        let (_, card) = StrokeModel::from_bytes(bytes)?;
        let lines = vec![
            format!("{kind}: {}", card.attributes.join(", ")),
            format!("network: {}", card.network),
            format!("trained on {}", card.learned_from),
        ];
        return Ok((json!({"kind": kind, "sha256": sha256, "card": card}), lines));
    }
    let model = AttributeModel::from_bytes(bytes)?;
    let mut lines = vec![
        format!("{kind}: {}", model.attributes().join(", ")),
        format!("features: {}", model.eyes().name()),
    ];
    match model.card() {
        Some(card) => lines.extend(card.lines()),
        None => lines.push(format!("trained on {}", model.learned_from())),
    }
    let result = json!({
        "kind": kind,
        "sha256": sha256,
        "attributes": model.attributes(),
        "features": model.eyes().name(),
        "learned_from": model.learned_from(),
        "card": model.card(),
    });
    Ok((result, lines))
}
