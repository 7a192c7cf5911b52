//! Predicted attributes of textures, photos and prompts.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Context as _;
use pyo3::types::{PyAnyMethods as _, PyDict, PyDictMethods as _};
use pyo3::{Bound, PyAny, PyResult, Python, pyfunction};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::prompt::interpret;
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::picture::{MAX_PHOTO_SIDE, Rgb, photo_pixels};
use shagreen_studio::attribute_prediction::{LEXICON, UNIFORM_DEVIATION, attributes_of_model};
use shagreen_studio::file::{in_file, read_file};
use shagreen_studio::photo_predictor::{described, photo_predictor};
use shagreen_studio::seen_materials::doubt_with_advice;

use crate::arrays::pixels;
use crate::errors::{refused, run};
use crate::library::PyLibrary;
use crate::texture::PyTexture;

/// Predicts the attributes of a texture from those of the textures of a library, as `shagreen predict attributes --recording`
/// does: 0 to 100, with standard deviations.
///
/// Without a library, it is "simulated", whose attributes no person rated. Returns a dictionary: `attributes` by their names,
/// each with `value`, `sd` and `informative` (whether the prediction is more certain than the mean of the library), the `model`, and
/// the `label_sources` of the training data.
#[pyfunction]
#[pyo3(signature = (texture, library=None))]
pub(crate) fn predict_attributes<'py>(
    py: Python<'py>,
    texture: &PyTexture,
    library: Option<&PyLibrary>,
) -> PyResult<Bound<'py, PyDict>> {
    let (sounding, library) = (Arc::clone(&texture.0), library.map(|library| Arc::clone(&library.0)));
    let predicted = run(py, move |_| {
        let model = sounding.entry()?.model;
        match library {
            Some(library) => attributes_of_model(&library, &model),
            None => attributes_of_model(&BuiltIn::Simulated.read()?, &model),
        }
    })?;
    let attributes = PyDict::new(py);
    for ((name, estimate), labels) in
        predicted.table.names.iter().zip(&predicted.estimates).zip(&predicted.labels)
    {
        attributes.set_item(name, of_estimate(py, *estimate, estimate.deviation < labels.deviation)?)?;
    }
    let result = PyDict::new(py);
    result.set_item("attributes", attributes)?;
    result.set_item("model", predicted.predictor())?;
    result.set_item("label_sources", predicted.table.source_ids().collect::<Vec<_>>())?;
    Ok(result)
}

/// Predicts the attributes of a surface from a photo, as `shagreen predict attributes --photo` does without a downloaded
/// network: by statistics of the picture. It is an estimate; no person rated it.
///
/// `photo` is a path, or an array of uint8 of the shape (height, width, 3) in sRGB, at most 768 pixels wide and high to give
/// the result of a file. Returns a dictionary: `attributes` by their names, each with `value` and `sd`, the likely `materials` with
/// their probabilities, the `doubts` about the picture, and the `model`.
#[pyfunction]
pub(crate) fn predict_photo<'py>(py: Python<'py>, photo: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let source = match photo.extract::<PathBuf>() {
        Ok(path) => Source::File(path),
        Err(_) => Source::Pixels(rgb_of(photo)?),
    };
    let (names, seen, model) = run(py, move |_| {
        let predictor = photo_predictor(None, None)?;
        let rgb = match source {
            Source::Pixels(rgb) => rgb,
            Source::File(path) => {
                photo_pixels(&read_file(&path, FileKind::Picture)?).with_context(|| in_file(&path))?
            }
        };
        // The size of the surface in a photo is unknown; no feature depends on it.
        let seen = predictor.look(&rgb.into_surface(FRAMING.millimeters))?;
        Ok((predictor.model().attributes().to_vec(), seen, described(&predictor)))
    })?;
    let attributes = PyDict::new(py);
    for (name, estimate) in names.iter().zip(&seen.attributes) {
        attributes.set_item(name, of_estimate(py, *estimate, estimate.deviation < UNIFORM_DEVIATION)?)?;
    }
    let materials = PyDict::new(py);
    for material in &seen.materials {
        materials.set_item(&material.name, material.probability)?;
    }
    let doubts: Vec<String> = seen.doubts.iter().map(|doubt| doubt_with_advice(*doubt)).collect();
    let result = PyDict::new(py);
    result.set_item("attributes", attributes)?;
    result.set_item("materials", materials)?;
    result.set_item("doubts", doubts)?;
    result.set_item("model", model)?;
    Ok(result)
}

/// Predicts the attributes of a surface from a description in words, as `shagreen predict attributes --prompt` does: from a
/// lexicon of estimated attributes. No person rated it.
///
/// Returns a dictionary: `attributes` by their names, each with `value` (0 to 100), `sd` and `informative`, the `words` that were
/// understood, each with `text`, `taken_for` and `denied`, the `unknown` words, the attributes that are `disputed` between words,
/// whether the prompt `is_about_touch`, and the `model`.
#[pyfunction]
pub(crate) fn predict_prompt<'py>(py: Python<'py>, prompt: &str) -> PyResult<Bound<'py, PyDict>> {
    let prompt = prompt.to_owned();
    let understood = run(py, move |_| Ok(interpret(&prompt, built_in_lexicon()?)))?;
    let attributes = PyDict::new(py);
    for (name, estimate) in ATTRIBUTES.into_iter().zip(&understood.attributes) {
        attributes.set_item(name, of_estimate(py, *estimate, estimate.deviation < UNIFORM_DEVIATION)?)?;
    }
    let mut words = Vec::with_capacity(understood.words.len());
    for word in &understood.words {
        let of = PyDict::new(py);
        of.set_item("text", &word.text)?;
        of.set_item("taken_for", &word.taken_for)?;
        of.set_item("denied", word.is_denied)?;
        words.push(of);
    }
    let result = PyDict::new(py);
    result.set_item("attributes", attributes)?;
    result.set_item("is_about_touch", understood.is_about_touch())?;
    result.set_item("words", words)?;
    result.set_item("unknown", understood.unknown)?;
    result.set_item("disputed", understood.disputed)?;
    result.set_item("model", LEXICON)?;
    Ok(result)
}

/// Photo to look at.
enum Source {
    File(PathBuf),
    Pixels(Rgb),
}

fn rgb_of(photo: &Bound<'_, PyAny>) -> PyResult<Rgb> {
    let (width, height, pixels) = pixels(photo, "photo")?;
    let side = |n: usize| u32::try_from(n).ok().filter(|n| (1..=MAX_PHOTO_SIDE).contains(n));
    match (side(width), side(height)) {
        (Some(width), Some(height)) => Ok(Rgb { width, height, pixels }),
        _ => Err(refused(format!(
            "the photo has {width} x {height} pixels; each side must have 1 to {MAX_PHOTO_SIDE}"
        ))),
    }
}

fn of_estimate(py: Python<'_>, estimate: Estimate, is_informative: bool) -> PyResult<Bound<'_, PyDict>> {
    let of = PyDict::new(py);
    of.set_item("value", estimate.mean)?;
    of.set_item("sd", estimate.deviation)?;
    of.set_item("informative", is_informative)?;
    Ok(of)
}
