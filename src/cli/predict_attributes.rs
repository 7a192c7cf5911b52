//! `shagreen predict attributes`: predicts the attributes of a recording, a photo or a prompt.

mod by_network;
mod photo_and_prompt;

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::recording::fit::{self, FitOptions};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::recording::{Ask, ColumnMap};
use shagreen_learn::model_file::sha256_of;

use crate::cli::backbone_source::BackboneArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Usage};
use crate::cli::predict_attributes::by_network::predict_by_network;
use crate::cli::predict_attributes::photo_and_prompt::{predict_from_photo, predict_from_prompt};
use crate::cli::progress::Progress;
use crate::cli::recording_answers::{map_of, parse_answer};
use crate::cli::recording_source::{read_recording_file, read_recording_files};
use shagreen_studio::attribute_prediction::{PredictedAttributes, attributes_of_model};
use shagreen_studio::file;

/// Predicts the perceptual attributes of a recorded stroke, a photo or a prompt: 0 to 100, each with its standard
/// deviation.
///
/// Recordings: predicted from a library of textures with known attributes; by default the simulated library, which no
/// person rated. With --model, a network trained on strokes predicts them instead. Photos: predicted by a model trained
/// on pictures of materials with computed roughness and hardness. Prompts: predicted from a lexicon with estimated
/// attributes of words. A photo and a prompt together are two independent predictions, weighted by their standard
/// deviations.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true).multiple(true))]
pub(crate) struct Args {
    /// Recordings of strokes on one texture: acceleration, speed and force, as WAV files or tables.
    #[arg(
        long,
        value_name = "FILE",
        num_args = 1..,
        group = "what",
        conflicts_with_all = ["backbone", "photo", "prompt"]
    )]
    recording: Vec<PathBuf>,
    /// Photo of a surface, as JPEG, PNG, WebP, BMP or TIFF.
    #[arg(long, value_name = "FILE", group = "what", conflicts_with = "library")]
    photo: Option<PathBuf>,
    /// Description of a surface in words.
    #[arg(long, value_name = "TEXT", group = "what", conflicts_with = "library")]
    prompt: Option<String>,
    /// Model for photos, from `shagreen train photo`, or for recordings, from `shagreen train attributes`. Default: the
    /// built-in model for photos; a prediction from the library for recordings.
    #[arg(long, value_name = "MODEL", conflicts_with = "library")]
    model: Option<PathBuf>,
    #[command(flatten)]
    backbone: BackboneArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Column map: a TOML file that states the columns of recordings and their units.
    #[arg(long, value_name = "MAP.toml", requires = "recording")]
    map: Option<PathBuf>,
    /// State a property that a recording does not contain, for example acceleration_unit=g; overrides the column map.
    /// Can be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_answer, requires = "recording")]
    answers: Vec<(Ask, String)>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    match (&args.photo, &args.prompt) {
        (Some(photo), prompt) => predict_from_photo(args, photo, prompt.as_deref()),
        (None, Some(prompt)) => {
            let given = [("--backbone", args.backbone.is_given()), ("--model", args.model.is_some())];
            if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
                bail!(Usage(format!("{option} needs a photo; add --photo, or leave {option} out")));
            }
            predict_from_prompt(args.json, prompt)
        }
        (None, None) => of_recording(args),
    }
}

fn of_recording(args: &Args) -> anyhow::Result<()> {
    let map: ColumnMap = map_of(args.map.as_deref(), &args.answers)?;
    let _progress = Progress::endless("predicting the attributes of the recordings");
    if let Some(model) = &args.model {
        return predict_by_network(args, model, &map);
    }
    let recordings = read_recording_files(&args.recording, &map, read_recording_file)?;
    let fitted =
        fit::fit(&recordings, &FitOptions::usual()).with_context(|| file::in_file(&args.recording[0]))?;
    for note in &fitted.report.notes {
        output::note(note);
    }
    let library = match args.library.path() {
        Some(_) => args.library.load()?,
        None => BuiltIn::Simulated.read()?,
    };
    let predicted = attributes_of_model(&library, &fitted.model)?;
    let what = predicted.predictor();
    let PredictedAttributes { table, estimates, labels, .. } = &predicted;
    let of_names = table.names.iter().zip(estimates).zip(labels);
    let attributes: Vec<Attribute<'_>> =
        of_names.map(|((name, of), labels)| Attribute::new(name, *of, labels.deviation)).collect();
    // The training data identify the model.
    let learned = serde_json::to_vec(&json!([table.names, table.values]))?;
    let result = json!({
        "attributes": as_json(&attributes),
        "model": what,
        "model_sha256": sha256_of(&learned),
        "label_source": table.source_ids().collect::<Vec<_>>(),
        "segments": fitted.report.segments.len(),
    });
    output::print(args.json, &result, || {
        let table = table_text(&attributes, "recording");
        format!(
            "{table}\npredicted by {what}\nOther labels give other predictions: --library selects them. The window predicts from the labels of the open library."
        )
    });
    Ok(())
}

/// Predicted attribute.
#[derive(Clone)]
struct Attribute<'a> {
    name: &'a str,
    estimate: Estimate,
    /// Standard deviation from which a prediction says nothing: that of the labels, or of any value.
    limit: f64,
}

impl<'a> Attribute<'a> {
    fn new(name: &'a str, estimate: Estimate, limit: f64) -> Self {
        Self { name, estimate, limit }
    }

    fn is_told(&self) -> bool {
        self.estimate.deviation < self.limit
    }
}

fn as_json(attributes: &[Attribute<'_>]) -> BTreeMap<String, Value> {
    let of = |attribute: &Attribute<'_>| {
        let Estimate { mean, deviation } = attribute.estimate;
        (attribute.name.to_owned(), json!({"value": mean, "sd": deviation, "told": attribute.is_told()}))
    };
    attributes.iter().map(of).collect()
}

/// Returns one line per attribute, without a number for those that `source` does not determine.
fn table_text(attributes: &[Attribute<'_>], source: &str) -> String {
    let widest = attributes.iter().map(|attribute| attribute.name.len()).max().unwrap_or(0);
    let line = |attribute: &Attribute<'_>| {
        let Attribute { name, estimate: Estimate { mean, deviation }, limit } = attribute;
        if attribute.is_told() {
            format!("{name:<widest$}  {mean:5.1} ± {deviation:.1}")
        } else {
            format!(
                "{name:<widest$}  cannot be told from this {source} (± {deviation:.0}; ± {limit:.0} without the {source})"
            )
        }
    };
    attributes.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::{Attribute, Estimate, as_json, table_text};

    #[test]
    fn an_attribute_that_is_unknown_is_said_in_words() {
        let attributes = [
            Attribute::new("rough-smooth", Estimate { mean: 40.0, deviation: 9.0 }, 31.0),
            Attribute::new("hard-soft", Estimate { mean: 100.0, deviation: 72.1 }, 31.0),
        ];
        let text = table_text(&attributes, "recording");
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "rough-smooth   40.0 ± 9.0");
        assert_eq!(
            lines[1],
            "hard-soft     cannot be told from this recording (± 72; ± 31 without the recording)"
        );
        let json = as_json(&attributes);
        assert_eq!(
            (&json["rough-smooth"]["told"], &json["hard-soft"]["told"]),
            (&true.into(), &false.into())
        );
        assert_eq!(json["hard-soft"]["value"], 100.0);
    }
}
