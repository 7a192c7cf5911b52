//! Attributes of a photo, of a prompt, and of both together.

use std::path::Path;

use anyhow::Context as _;
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::LabelSource;
use shagreen_core::surfaces::generated::{Witness, agree};
use shagreen_core::surfaces::prompt::{PromptInterpretation, interpret};
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::lexicon_toml::{LEXICON_TEXT, built_in_lexicon};
use shagreen_formats::picture::photo_pixels;
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::picture_predictor::{PicturePrediction, PicturePredictor};
use shagreen_studio::attribute_prediction::{LEXICON, UNIFORM_DEVIATION};
use shagreen_studio::file;
use shagreen_studio::photo_predictor::described;
use shagreen_studio::seen_materials::{SeenMaterial, doubt_with_advice, looks_like, seen_materials};

use crate::cli::backbone_source::read_backbone;
use crate::cli::output;
use crate::cli::predict_attributes::{Args, Attribute, as_json, table_text};
use crate::cli::progress::Progress;
use crate::cli::prompt_summary::{disagreement, prompt_summary};
use crate::cli::seen_json::{doubts_json, materials_json};

/// What a model predicts from a photo.
struct Look {
    looker: PicturePredictor,
    seen: PicturePrediction,
    materials: Vec<SeenMaterial>,
}

impl Look {
    /// Attributes with the names that the model gives them.
    fn attributes(&self) -> Vec<Attribute<'_>> {
        let names = self.looker.model().attributes().iter();
        let of_names = names.zip(&self.seen.attributes);
        of_names.map(|(name, of)| Attribute::new(name, *of, UNIFORM_DEVIATION)).collect()
    }
}

/// Predicts the attributes of a photo. With a prompt, the prediction from its words is independent evidence, and the two are
/// weighted by their standard deviations.
pub(super) fn predict_from_photo(args: &Args, photo: &Path, prompt: Option<&str>) -> anyhow::Result<()> {
    let progress = Progress::endless("predicting the attributes of the photo");
    let look = look_at(args, photo)?;
    progress.finish();
    for doubt in &look.seen.doubts {
        output::warn(&format!("{}: {}", doubt_with_advice(*doubt), photo.display()));
    }
    if let Some(prompt) = prompt {
        return print_both(args.json, &look, prompt);
    }
    print_photo(args.json, &look);
    Ok(())
}

/// Predicts the attributes of a prompt.
pub(super) fn predict_from_prompt(is_json: bool, prompt: &str) -> anyhow::Result<()> {
    let understood = interpret(prompt, built_in_lexicon()?);
    let attributes = of_words(&understood.attributes);
    let mut result = json!({
        "attributes": as_json(&attributes),
        "model": LEXICON,
        "model_sha256": sha256_of(LEXICON_TEXT.as_bytes()),
        "label_source": LabelSource::Estimated.id(),
    });
    add_words(&mut result, &understood);
    output::print(is_json, &result, || {
        format!("{}{}", table_text(&attributes, "prompt"), prompt_summary(&understood))
    });
    Ok(())
}

/// A prompt always has an estimate: that of its words, or of no word at all.
fn of_words(attributes: &[Estimate; ATTRIBUTES.len()]) -> Vec<Attribute<'static>> {
    let of_names = ATTRIBUTES.into_iter().zip(attributes);
    of_names.map(|(name, of)| Attribute::new(name, *of, f64::INFINITY)).collect()
}

fn look_at(args: &Args, photo: &Path) -> anyhow::Result<Look> {
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
    let materials = seen_materials(&seen.materials, built_in_lexicon()?);
    Ok(Look { looker, seen, materials })
}

fn print_photo(is_json: bool, look: &Look) {
    let attributes = look.attributes();
    let what = described(&look.looker);
    let result = json!({
        "attributes": as_json(&attributes),
        "model": what,
        "model_sha256": look.looker.sha256(),
        "label_source": LabelSource::Estimated.id(),
        "materials": materials_json(&look.materials),
        "doubts": doubts_json(&look.seen.doubts),
    });
    output::print(is_json, &result, || {
        let mut lines = vec![table_text(&attributes, "photo")];
        lines.extend(looks_like(&look.materials));
        lines.push(format!("predicted by {what}\nan estimate: no person rated it"));
        lines.join("\n")
    });
}

fn print_both(is_json: bool, look: &Look, prompt: &str) -> anyhow::Result<()> {
    let understood = interpret(prompt, built_in_lexicon()?);
    let (words, picture) = (of_words(&understood.attributes), look.attributes());
    let (attributes, differ) = both(&words, &picture);
    let what = described(&look.looker);
    let mut result = json!({
        "attributes": as_json(&attributes),
        "by_words": as_json(&words),
        "by_picture": as_json(&picture),
        "words_and_picture_differ": differ,
        "model": format!("{LEXICON}, and {what}"),
        "model_sha256": look.looker.sha256(),
        "lexicon_sha256": sha256_of(LEXICON_TEXT.as_bytes()),
        "label_source": LabelSource::Estimated.id(),
        "materials": materials_json(&look.materials),
        "doubts": doubts_json(&look.seen.doubts),
    });
    add_words(&mut result, &understood);
    output::print(is_json, &result, || {
        let mut lines = vec![table_text(&attributes, "photo")];
        lines.extend(disagreement(&differ, Witness::OnItsOwn));
        lines.extend(looks_like(&look.materials));
        lines.push(format!("photo: predicted by {what}"));
        format!("{}{}", lines.join("\n"), prompt_summary(&understood))
    });
    Ok(())
}

/// Returns the attributes that words or picture predict, combined where both do, and the names of those on which the two
/// disagree.
fn both<'a>(words: &[Attribute<'a>], picture: &[Attribute<'a>]) -> (Vec<Attribute<'a>>, Vec<&'a str>) {
    let mut differ = Vec::new();
    let combined = words.iter().map(|said| {
        let Some(seen) = picture.iter().find(|seen| seen.name == said.name) else { return said.clone() };
        let agreed = agree(said.estimate, seen.estimate, Witness::OnItsOwn);
        if agreed.differ {
            differ.push(said.name);
        }
        Attribute { estimate: agreed.estimate, ..said.clone() }
    });
    let mut attributes: Vec<Attribute<'a>> = combined.collect();
    let is_new = |seen: &&Attribute<'a>| words.iter().all(|said| said.name != seen.name);
    attributes.extend(picture.iter().filter(is_new).cloned());
    (attributes, differ)
}

/// Adds what the words of a prompt were taken for.
fn add_words(result: &mut Value, understood: &PromptInterpretation) {
    let words = understood.words.iter();
    result["words"] = words
        .map(|word| json!({"text": word.text, "taken_for": word.taken_for, "denied": word.is_denied}))
        .collect();
    result["unknown"] = json!(understood.unknown);
    result["disputed"] = json!(understood.disputed);
    result["is_about_touch"] = json!(understood.is_about_touch());
}

#[cfg(test)]
mod tests {
    use super::{Attribute, Estimate, both};

    #[test]
    fn words_and_photo_are_combined_where_both_predict() {
        let of = |name, mean, deviation| Attribute::new(name, Estimate { mean, deviation }, f64::INFINITY);
        let words = [of("rough-smooth", 40.0, 10.0), of("hard-soft", 10.0, 3.0), of("flat-bumpy", 70.0, 9.0)];
        let picture = [of("hard-soft", 60.0, 4.0), of("rough-smooth", 50.0, 5.0), of("warm-cold", 30.0, 8.0)];
        let (attributes, differ) = both(&words, &picture);
        let names: Vec<&str> = attributes.iter().map(|of| of.name).collect();
        assert_eq!(names, ["rough-smooth", "hard-soft", "flat-bumpy", "warm-cold"]);
        assert_eq!(differ, ["hard-soft"]);
        // (40/10² + 50/5²) / (1/10² + 1/5²), and ten times 3 · 4 / 5.
        assert!((attributes[0].estimate.mean - 48.0).abs() < 1e-9);
        assert!((attributes[1].estimate.deviation - 24.0).abs() < 1e-9);
        assert_eq!(attributes[2].estimate, words[2].estimate);
        assert_eq!(attributes[3].estimate, picture[2].estimate);
    }
}
