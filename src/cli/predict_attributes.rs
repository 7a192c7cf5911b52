//! `shagreen predict attributes`: predicts the attributes of a recording, a photo or a prompt.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::{self, FitOptions, Stroke};
use shagreen_core::space::LabelSource;
use shagreen_core::space::attribute_predictor::{predict, quantities, without_features};
use shagreen_core::surfaces::prompt::interpret;
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_core::texture::patterns::{PAPER_FORCES_N, PAPER_RATE, PAPER_SPEEDS_MM_PER_S};
use shagreen_formats::attribute_table::attribute_table;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::lexicon_toml::{LEXICON_TEXT, built_in_lexicon};
use shagreen_formats::picture::photo_pixels;
use shagreen_formats::recording::{Ask, ColumnMap};
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::picture_predictor::PicturePredictor;
use shagreen_learn::stroke_model::StrokeModel;

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::prompt_summary::prompt_summary;
use crate::cli::recording_answers::{map_of, parse_answer};
use crate::cli::recording_source::read_recording_file;
use shagreen_studio::file;

/// Predicts the perceptual attributes of a recorded stroke, a photo or a prompt: 0 to 100, each with its standard
/// deviation.
///
/// Recordings: predicted from a library of textures with known attributes; by default the simulated library, which no
/// person rated. With --model, a network trained on strokes predicts them instead. Photos: predicted by a model trained
/// on pictures of materials with computed roughness and hardness. Prompts: predicted from a lexicon with estimated
/// attributes of words.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true))]
pub(crate) struct Args {
    /// Recordings of strokes on one texture: acceleration, speed and force, as WAV files or tables.
    #[arg(long, value_name = "FILE", num_args = 1.., group = "what", conflicts_with = "backbone")]
    recording: Vec<PathBuf>,
    /// Photo of a surface, as JPEG or PNG.
    #[arg(long, value_name = "FILE", group = "what", conflicts_with = "library")]
    photo: Option<PathBuf>,
    /// Description of a surface in words.
    #[arg(long, value_name = "TEXT", group = "what", conflicts_with_all = ["backbone", "library", "model"])]
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
    match (&args.prompt, &args.photo) {
        (Some(prompt), _) => of_prompt(args, prompt),
        (_, Some(photo)) => of_photo(args, photo),
        _ => of_recording(args),
    }
}

fn of_photo(args: &Args, photo: &Path) -> anyhow::Result<()> {
    let progress = Progress::endless("predicting the attributes of the photo");
    let backbone = read_backbone(&args.backbone)?;
    let looker = match &args.model {
        Some(model) => PicturePredictor::new(&file::read_file(model, FileKind::Network)?, backbone)
            .with_context(|| file::in_file(model))?,
        None => PicturePredictor::built_in(backbone)?,
    };
    let pixels =
        photo_pixels(&file::read_file(photo, FileKind::Picture)?).with_context(|| file::in_file(photo))?;
    // The size of the surface in a photo is unknown; no feature depends on it.
    let seen =
        looker.look(&pixels.into_surface(FRAMING.millimeters)).with_context(|| file::in_file(photo))?;
    let model = looker.model();
    let names = model.attributes().iter().map(String::as_str);
    let attributes: Vec<Attribute<'_>> =
        names.zip(seen).map(|(name, of)| Attribute::new(name, of, UNIFORM_DEVIATION)).collect();
    let what = format!("{}, trained on {}", model.eyes().name(), model.learned_from());
    let result = json!({
        "attributes": as_json(&attributes),
        "model": what,
        "model_sha256": looker.sha256(),
        "label_source": LabelSource::Estimated.id(),
    });
    progress.finish();
    output::print(args.json, &result, || {
        let table = table_text(&attributes, "photo");
        format!("{table}\npredicted by {what}\nan estimate: no person rated it")
    });
    Ok(())
}

fn of_prompt(args: &Args, prompt: &str) -> anyhow::Result<()> {
    let understood = interpret(prompt, built_in_lexicon()?);
    // A prompt always has an estimate: that of its words, or of no word at all.
    let of_words = ATTRIBUTES.into_iter().zip(understood.attributes);
    let attributes: Vec<Attribute<'_>> =
        of_words.map(|(name, of)| Attribute::new(name, of, f64::INFINITY)).collect();
    let words: Vec<Value> = understood
        .words
        .iter()
        .map(|word| json!({"text": word.text, "taken_for": word.taken_for, "denied": word.is_denied}))
        .collect();
    let result = json!({
        "attributes": as_json(&attributes),
        "model": "lexicon of estimated attributes",
        "model_sha256": sha256_of(LEXICON_TEXT.as_bytes()),
        "label_source": LabelSource::Estimated.id(),
        "words": words,
        "unknown": understood.unknown,
        "disputed": understood.disputed,
        "is_about_touch": understood.is_about_touch(),
    });
    output::print(args.json, &result, || {
        format!("{}{}", table_text(&attributes, "prompt"), prompt_summary(&understood))
    });
    Ok(())
}

fn of_recording(args: &Args) -> anyhow::Result<()> {
    let map: ColumnMap = map_of(args.map.as_deref(), &args.answers)?;
    let _progress = Progress::endless("predicting the attributes of the recordings");
    let mut recordings = Vec::new();
    for file in &args.recording {
        let read = read_recording_file(file, &map);
        for warning in &read.warnings {
            output::warn(&format!("{warning}: {}", file.display()));
        }
        for note in &read.notes {
            output::note(&format!("{note}: {}", file.display()));
        }
        match read.recording {
            Ok(recording) => recordings.push(recording),
            Err(reason) => bail!("{reason}: {}", file.display()),
        }
    }
    if let Some(model) = &args.model {
        return by_network(args, model, &recordings);
    }
    let fitted =
        fit::fit(&recordings, &FitOptions::usual()).with_context(|| file::in_file(&args.recording[0]))?;
    for note in &fitted.report.notes {
        output::note(note);
    }
    let library = match args.library.path() {
        Some(_) => args.library.load()?,
        None => BuiltIn::Simulated.read()?,
    };
    let table = attribute_table(&library)?;
    let known = table.known(&library);
    let estimates = predict(&known, &quantities(&fitted.model))?;
    let labels = without_features(&known);
    let of_names = table.names.iter().zip(estimates).zip(&labels);
    let attributes: Vec<Attribute<'_>> =
        of_names.map(|((name, of), labels)| Attribute::new(name, of, labels.deviation)).collect();
    let what = format!("a Gaussian process over {}", table.of_library(&library.name));
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

/// Predicts the attributes of the recordings with a network trained on strokes. The standard deviations are its
/// leave-one-texture-out RMSE.
fn by_network(args: &Args, path: &Path, recordings: &[Recording]) -> anyhow::Result<()> {
    let bytes = file::read_file(path, FileKind::Network)?;
    let (network, card) = StrokeModel::from_bytes(&bytes).with_context(|| file::in_file(path))?;
    let strokes = fit::strokes(recordings, PAPER_RATE).with_context(|| file::in_file(&args.recording[0]))?;
    let predicted = network.predict(&strokes)?.with_context(|| {
        let least = network.architecture().n_samples as f64 / PAPER_RATE.0;
        format!(
            "no stroke is as long as the {least} s that the network needs; leave --model out, or record longer strokes"
        )
    })?;
    warn_of_unknown(recordings, &strokes);
    let estimates = predicted.into_iter().zip(&card.left_out_rmse);
    let of_names = card.attributes.iter().zip(estimates);
    let attributes: Vec<Attribute<'_>> = of_names
        .map(|(name, (mean, deviation))| {
            Attribute::new(name, Estimate { mean, deviation: *deviation }, UNIFORM_DEVIATION)
        })
        .collect();
    let what = format!("the network {}, trained on {}", card.network, card.learned_from);
    let result = json!({
        "attributes": as_json(&attributes),
        "model": what,
        "model_sha256": sha256_of(&bytes),
        "label_source": card.label_sources,
        "strokes": strokes.len(),
    });
    output::print(args.json, &result, || {
        format!("{}\npredicted by {what}", table_text(&attributes, "recording"))
    });
    Ok(())
}

/// Warns of strokes outside the training range of the networks: the standard deviations do not show it.
fn warn_of_unknown(recordings: &[Recording], strokes: &[Stroke]) {
    let known = |values: &[f64], scale: f64| {
        let (first, last) = (scale * values[0], scale * values[values.len() - 1]);
        // The training strokes are points in the speed-force plane. Values from half the lowest to 1.5 times the
        // highest count as near them.
        move |x: &f64| (0.5 * first..=1.5 * last).contains(x)
    };
    let is_speed = known(&PAPER_SPEEDS_MM_PER_S, 1e-3);
    let is_force = known(&PAPER_FORCES_N, 1.0);
    let rows = || strokes.iter().flat_map(|stroke| stroke.speed_mps.iter().zip(&stroke.force_n));
    let n_unknown = rows().filter(|(speed, force)| !is_speed(speed) || !is_force(force)).count();
    let percent = 100.0 * n_unknown as f64 / rows().count().max(1) as f64;
    if percent >= 1.0 {
        output::warn(&format!(
            "{percent:.0} % of the samples lie outside the range of speeds and forces on which the network was trained (50 to 250 mm/s, 0.1 to 0.5 N); its standard deviations are not valid there"
        ));
    }
    if let Some(recording) = recordings.iter().find(|recording| recording.rate.0 < 0.999 * PAPER_RATE.0) {
        output::warn(&format!(
            "the network was trained at {} Hz; a recording at {:.0} Hz lacks the highest frequencies",
            PAPER_RATE.0, recording.rate.0
        ));
    }
}

/// Predicted attribute.
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

/// Standard deviation of a value that may lie anywhere from 0 to 100 with the same probability, `100/√12`.
const UNIFORM_DEVIATION: f64 = 28.87;

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
