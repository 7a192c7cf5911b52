//! Attributes and appearance of a surface, predicted from a text prompt.
//!
//! The longest known phrase is matched first. The estimates that words give for an attribute are averaged, weighted by
//! their precision. Where they disagree by more than their uncertainty, the standard deviation grows by the Birge ratio
//! (R. Birge 1932). An attribute without a word stays at [`OPEN`]. Adjectives of a picture or of light do not count, as in
//! "a rough sketch of velvet".

mod combining;
mod reading;
mod tokens;

use crate::maths::gaussian_process::Estimate;
use crate::surfaces::material::PatternKind;
use crate::surfaces::prompt::reading::Reading;
use crate::surfaces::prompt::tokens::{Token, tokens};
use crate::surfaces::touch_words::{ATTRIBUTES, Lexicon, Shade};

/// Estimate of an attribute that no word describes: mean and standard deviation of a uniform distribution over 0 to
/// 100.
pub const OPEN: Estimate = Estimate { mean: 50.0, deviation: 28.9 };
/// Largest number of tokens read from a prompt; the rest is ignored.
pub const MOST_WORDS: usize = 400;

/// Interpretation of a prompt.
#[derive(Clone, Debug, PartialEq)]
pub struct PromptInterpretation {
    /// Predicted attributes in the order of [`ATTRIBUTES`], 0 to 100.
    pub attributes: [Estimate; ATTRIBUTES.len()],
    /// Requested appearance.
    pub looks: Looks,
    /// Known words, in prompt order.
    pub words: Vec<Word>,
    /// Unknown words.
    pub unknown: Vec<String>,
    /// Attributes on which the words disagree.
    pub disputed: Vec<&'static str>,
    /// Number of words ignored because the prompt is longer than [`MOST_WORDS`].
    pub n_left_out: usize,
}

/// A known word of a prompt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Text in the prompt.
    pub text: String,
    /// Name of the matching lexicon entry.
    pub taken_for: String,
    /// Kind of the word.
    pub role: Role,
    /// Whether the word is negated.
    pub is_denied: bool,
}

/// Kind of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A material or an object.
    Surface,
    /// An adjective.
    Quality,
    /// A regular pattern.
    Pattern,
    /// A color or a color modifier.
    Color,
    /// A size or a length.
    Size,
}

/// Requested appearance of a surface; `None` where the prompt does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Looks {
    /// Identifier of the most similar material in the starter library.
    pub like: Option<String>,
    /// Main color, sRGB.
    pub color_srgb: Option<[u8; 3]>,
    /// Second color, sRGB.
    pub second_srgb: Option<[u8; 3]>,
    /// Modification of all colors.
    pub shade: Shade,
    /// Gloss, 0 to 1.
    pub gloss: Option<f64>,
    /// Strength of color flecks, 0 to 1.
    pub mottle: Option<f64>,
    /// Regular pattern and its period in m.
    pub pattern: Option<(PatternKind, f64)>,
    /// Whether the prompt states the period as a length; [`Looks::scale`] then does not apply to it.
    pub is_period_stated: bool,
    /// Factor on pattern periods, the roll-off wavelength and bump radii.
    pub scale: f64,
}

/// Returns a one-line title of at most `most` characters (2 or more) from a prompt; `None` if the prompt is empty.
pub fn title(prompt: &str, most: usize) -> Option<String> {
    let line = prompt.split_whitespace().collect::<Vec<_>>().join(" ");
    let letters: Vec<char> = line.chars().filter(|c| !c.is_control()).collect();
    match letters.len() {
        0 => None,
        n if n <= most => Some(letters.into_iter().collect()),
        _ => Some(letters[..most - 1].iter().chain(&['…']).collect()),
    }
}

impl PromptInterpretation {
    /// Returns whether the prompt contains any word about touch.
    pub fn is_about_touch(&self) -> bool {
        self.words.iter().any(|word| matches!(word.role, Role::Surface | Role::Quality | Role::Pattern))
    }
}

/// Returns the interpretation of a prompt of any length and script.
pub fn interpret(prompt: &str, lexicon: &Lexicon) -> PromptInterpretation {
    let mut tokens = tokens(prompt);
    let n_left_out = tokens.iter().skip(MOST_WORDS).filter(|token| matches!(token, Token::Word(_))).count();
    tokens.truncate(MOST_WORDS);
    let mut reading = Reading::new(lexicon);
    let mut at = 0;
    while at < tokens.len() {
        at += reading.take(&tokens[at..]);
    }
    reading.finish(n_left_out)
}

#[cfg(test)]
mod tests;
