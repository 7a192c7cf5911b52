//! The lexicon of touch words, read from a TOML file. The built-in one is `assets/words/lexicon.toml`, which documents
//! its fields.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::Deserialize;
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::touch_words::{Hints, Lexicon, LexiconError, Meaning, Shade};

use crate::materials_toml::PatternKindV1;

/// Text of the built-in lexicon.
pub const LEXICON_TEXT: &str = include_str!("../../../assets/words/lexicon.toml");

/// Why text is not a lexicon.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LexiconFileError {
    /// Not TOML, or a key is missing, unknown or of the wrong type.
    #[error("cannot read the lexicon: {0}; correct the file")]
    Damaged(#[from] toml::de::Error),
    /// A number is out of range.
    #[error("{what} of \"{word}\" is {value}; change it to a value from {low} to {high}")]
    OutOfRange {
        /// The first word of the entry.
        word: String,
        /// Name of the number.
        what: &'static str,
        /// The value in the file.
        value: f64,
        /// Lowest permitted value.
        low: f64,
        /// Highest permitted value.
        high: f64,
    },
    /// An adjective or pattern has no estimate.
    #[error("\"{word}\" has no estimate of any attribute; add one, or remove the entry")]
    Empty {
        /// The first word of the entry.
        word: String,
    },
    /// An entry is incomplete.
    #[error("the entry \"{word}\" lacks {what}; add it")]
    Lacks {
        /// The first word of the entry.
        word: String,
        /// The missing keys.
        what: &'static str,
    },
    /// The words themselves are invalid.
    #[error(transparent)]
    Words(#[from] LexiconError),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileV1 {
    negations: Vec<String>,
    fillers: Vec<String>,
    surface: Vec<FeltV1>,
    quality: Vec<FeltV1>,
    pattern: Vec<FeltV1>,
    color: Vec<ColorV1>,
    shade: Vec<ShadeV1>,
    size: Vec<SizeV1>,
    degree: Vec<DegreeV1>,
    #[serde(default)]
    depictions: Vec<String>,
    #[serde(default)]
    classes: BTreeMap<String, String>,
}

/// Mean and standard deviation, on a scale of 0 to 100.
type HintV1 = Option<[f64; 2]>;

/// A word for a tactile property: a surface, an adjective or a pattern.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FeltV1 {
    words: Vec<String>,
    #[serde(rename = "rough-smooth")]
    rough_smooth: HintV1,
    #[serde(rename = "hard-soft")]
    hard_soft: HintV1,
    #[serde(rename = "flat-bumpy")]
    flat_bumpy: HintV1,
    #[serde(rename = "sticky-slippery")]
    sticky_slippery: HintV1,
    #[serde(rename = "irritating-pleasant")]
    irritating_pleasant: HintV1,
    /// Surfaces only.
    like: Option<String>,
    /// Surfaces only.
    color: Option<[u8; 3]>,
    /// Surfaces and adjectives.
    gloss: Option<f64>,
    /// Adjectives only.
    mottle: Option<f64>,
    /// Patterns only.
    kind: Option<PatternKindV1>,
    /// Patterns only.
    period_mm: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ColorV1 {
    words: Vec<String>,
    srgb: [u8; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ShadeV1 {
    words: Vec<String>,
    lightness: f64,
    saturation: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SizeV1 {
    words: Vec<String>,
    factor: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DegreeV1 {
    words: Vec<String>,
    weight: f64,
    reach: f64,
}

/// Returns the built-in lexicon.
///
/// # Errors
/// Fails only if the program file is damaged.
pub fn built_in_lexicon() -> Result<&'static Lexicon, LexiconFileError> {
    static LEXICON: OnceLock<Result<Lexicon, LexiconFileError>> = OnceLock::new();
    let read = || read_lexicon(LEXICON_TEXT);
    LEXICON.get_or_init(read).as_ref().map_err(Clone::clone)
}

/// Reads a lexicon.
///
/// # Errors
/// See [`LexiconFileError`].
pub fn read_lexicon(text: &str) -> Result<Lexicon, LexiconFileError> {
    let file: FileV1 = toml::from_str(text)?;
    let mut entries = Vec::new();
    let alone =
        |words: Vec<String>, meaning: Meaning| words.into_iter().map(move |w| (vec![w], meaning.clone()));
    entries.extend(alone(file.negations, Meaning::Negation));
    entries.extend(alone(file.fillers, Meaning::Filler));
    for of in file.surface {
        let (hints, gloss) = (of.hints()?, of.share("gloss", of.gloss)?);
        let like = of.like.ok_or_else(|| LexiconFileError::Lacks { word: name(&of.words), what: "like" })?;
        entries.push((of.words, Meaning::Surface { like, hints, color_srgb: of.color, gloss }));
    }
    for of in file.quality {
        let (gloss, mottle) = (of.share("gloss", of.gloss)?, of.share("mottle", of.mottle)?);
        let meaning = Meaning::Quality { hints: of.hints()?, gloss, mottle };
        entries.push((of.words, meaning));
    }
    for of in file.pattern {
        let hints = of.hints()?;
        let word = name(&of.words);
        let (Some(kind), Some(period_mm)) = (of.kind, of.period_mm) else {
            return Err(LexiconFileError::Lacks { word, what: "kind and period_mm" });
        };
        let period_m = 1e-3 * within(&word, "period_mm", period_mm, 0.1, 50.0)?;
        entries.push((of.words, Meaning::Pattern { kind: kind.into(), period_m, hints }));
    }
    entries.extend(file.color.into_iter().map(|of| (of.words, Meaning::Color(of.srgb))));
    for of in file.shade {
        let word = name(&of.words);
        let shade = Shade {
            lightness: within(&word, "lightness", of.lightness, -1.0, 1.0)?,
            saturation: within(&word, "saturation", of.saturation, -1.0, 1.0)?,
        };
        entries.push((of.words, Meaning::Shade(shade)));
    }
    for of in file.size {
        let factor = within(&name(&of.words), "factor", of.factor, 0.05, 20.0)?;
        entries.push((of.words, Meaning::Size(factor)));
    }
    for of in file.degree {
        let word = name(&of.words);
        let weight = within(&word, "weight", of.weight, 0.05, 20.0)?;
        let reach = within(&word, "reach", of.reach, -1.0, 1.0)?;
        entries.push((of.words, Meaning::Degree { weight, reach }));
    }
    Ok(Lexicon::new(entries)?.with_depictions(file.depictions)?.with_classes(file.classes)?)
}

fn name(words: &[String]) -> String {
    words.first().cloned().unwrap_or_default()
}

impl FeltV1 {
    /// Returns the estimates, with means from 0 to 100 and plausible standard deviations; there must be at least one.
    fn hints(&self) -> Result<Hints, LexiconFileError> {
        let word = name(&self.words);
        let values = [
            self.rough_smooth,
            self.hard_soft,
            self.flat_bumpy,
            self.sticky_slippery,
            self.irritating_pleasant,
        ];
        let mut hints = [None; 5];
        for (hint, value) in hints.iter_mut().zip(values) {
            let Some([mean, deviation]) = value else { continue };
            let mean = within(&word, "a mean", mean, 0.0, 100.0)?;
            let deviation = within(&word, "a standard deviation", deviation, 1.0, 50.0)?;
            *hint = Some(Estimate { mean, deviation });
        }
        if hints.iter().all(Option::is_none) {
            return Err(LexiconFileError::Empty { word });
        }
        Ok(hints)
    }

    fn share(&self, what: &'static str, value: Option<f64>) -> Result<Option<f64>, LexiconFileError> {
        value.map(|value| within(&name(&self.words), what, value, 0.0, 1.0)).transpose()
    }
}

fn within(word: &str, what: &'static str, value: f64, low: f64, high: f64) -> Result<f64, LexiconFileError> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(LexiconFileError::OutOfRange { word: word.to_owned(), what, value, low, high })
}

#[cfg(test)]
mod tests;
