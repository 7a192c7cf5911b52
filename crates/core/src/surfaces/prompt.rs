//! Attributes and appearance of a surface, predicted from a text prompt.
//!
//! The longest known phrase is matched first. The estimates that words give for an attribute are averaged, weighted by
//! their precision. Where they disagree by more than their uncertainty, the standard deviation grows by the Birge ratio
//! (R. Birge 1932). An attribute without a word stays at [`OPEN`].

mod tokens;

use crate::maths::gaussian_process::Estimate;
use crate::surfaces::material::PatternKind;
use crate::surfaces::prompt::tokens::{Token, tokens};
use crate::surfaces::touch_words::{ATTRIBUTES, Hints, LONGEST_PHRASE, Lexicon, Meaning, Shade};

/// Estimate of an attribute that no word describes: mean and standard deviation of a uniform distribution over 0 to
/// 100.
pub const OPEN: Estimate = Estimate { mean: 50.0, deviation: 28.9 };
/// Smallest standard deviation of a prediction from words alone, in points.
const SUREST: f64 = 4.0;
/// Factor on the standard deviation of a negated word: "not rough" is not certainly smooth.
const DENIED: f64 = 1.4;
/// Factor on the standard deviation of a surface followed by another: "steel table" feels of steel, "stone carpet" does
/// not feel of stone.
const BEFORE_ANOTHER: f64 = 1.5;
/// Number of known words within which a negation or degree word applies.
const HOLDS_FOR: usize = 4;
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

/// State while reading a prompt.
struct Reading<'a> {
    lexicon: &'a Lexicon,
    /// Estimates for each attribute, except those from surfaces.
    said: [Vec<Estimate>; ATTRIBUTES.len()],
    /// Estimates from surfaces, in prompt order.
    surfaces: Vec<Hints>,
    looks: Looks,
    words: Vec<Word>,
    unknown: Vec<String>,
    /// A length read before its pattern or after it.
    length_m: Option<f64>,
    pending: Pending,
}

/// Modifiers of the next word about touch.
#[derive(Clone, Copy)]
struct Pending {
    is_denied: bool,
    weight: f64,
    reach: f64,
    /// Remaining known words before the modifiers expire.
    n_left: usize,
}

impl Pending {
    const NOTHING: Self = Self { is_denied: false, weight: 1.0, reach: 0.0, n_left: 0 };
}

/// Returns the interpretation of a prompt of any length and script.
pub fn interpret(prompt: &str, lexicon: &Lexicon) -> PromptInterpretation {
    let mut tokens = tokens(prompt);
    let n_left_out = tokens.iter().skip(MOST_WORDS).filter(|token| matches!(token, Token::Word(_))).count();
    tokens.truncate(MOST_WORDS);
    let mut reading = Reading {
        lexicon,
        said: Default::default(),
        surfaces: Vec::new(),
        looks: Looks { scale: 1.0, ..Looks::default() },
        words: Vec::new(),
        unknown: Vec::new(),
        length_m: None,
        pending: Pending::NOTHING,
    };
    let mut at = 0;
    while at < tokens.len() {
        at += reading.take(&tokens[at..]);
    }
    reading.finish(n_left_out)
}

impl<'a> Reading<'a> {
    /// Applies the longest known phrase at the start, and returns its number of tokens.
    fn take(&mut self, tokens: &[Token]) -> usize {
        match &tokens[0] {
            Token::Break => {
                self.pending = Pending::NOTHING;
                return 1;
            }
            Token::Length { text, meters } => {
                self.note(text, text, Role::Size, false);
                self.lengthen(*meters);
                return 1;
            }
            Token::Word(_) => {}
        }
        let words: Vec<&str> = tokens.iter().map_while(Token::word).take(LONGEST_PHRASE).collect();
        for n in (1..=words.len()).rev() {
            let phrase = words[..n].join(" ");
            if let Some((name, meaning)) = self.known(&phrase) {
                self.apply(&phrase, name, meaning);
                return n;
            }
        }
        let guessed = self.lexicon.misspelled(words[0]).and_then(|known| self.lexicon.get(known));
        match guessed {
            Some((name, meaning)) => self.apply(words[0], name, meaning),
            None => self.unknown.push(words[0].to_owned()),
        }
        1
    }

    /// Looks up a phrase as written, then with the ending of its last word removed.
    fn known(&self, phrase: &str) -> Option<(&'a str, &'a Meaning)> {
        let lexicon = self.lexicon;
        lexicon.get(phrase).or_else(|| tokens::stems(phrase).iter().find_map(|stem| lexicon.get(stem)))
    }

    fn apply(&mut self, text: &str, name: &str, meaning: &Meaning) {
        let pending = self.pending;
        self.pending.n_left = pending.n_left.saturating_sub(1);
        if pending.n_left == 0 {
            self.pending = Pending::NOTHING;
        }
        match meaning {
            Meaning::Filler => return,
            Meaning::Negation => {
                self.pending = Pending { is_denied: !pending.is_denied, n_left: HOLDS_FOR, ..self.pending };
                return;
            }
            Meaning::Degree { weight, reach } => {
                let (weight, reach) = (self.pending.weight * weight, self.pending.reach + reach);
                self.pending = Pending { weight, reach, n_left: HOLDS_FOR, ..self.pending };
                return;
            }
            Meaning::Color(srgb) => {
                self.note(text, name, Role::Color, self.pending.is_denied);
                match (self.pending.is_denied, self.looks.color_srgb) {
                    (true, _) => {}
                    (false, None) => self.looks.color_srgb = Some(*srgb),
                    (false, Some(_)) => self.looks.second_srgb = Some(*srgb),
                }
                return;
            }
            Meaning::Shade(Shade { lightness, saturation }) => {
                self.note(text, name, Role::Color, self.pending.is_denied);
                let sign = if self.pending.is_denied { -1.0 } else { 1.0 };
                let shade = &mut self.looks.shade;
                shade.lightness = (shade.lightness + sign * lightness).clamp(-1.0, 1.0);
                shade.saturation = (shade.saturation + sign * saturation).clamp(-1.0, 1.0);
                return;
            }
            Meaning::Size(factor) => {
                self.note(text, name, Role::Size, self.pending.is_denied);
                let factor = if self.pending.is_denied { 1.0 / factor } else { *factor };
                self.looks.scale = (self.looks.scale * factor).clamp(0.1, 10.0);
                return;
            }
            Meaning::Surface { like, hints, color_srgb, gloss } => {
                self.note(text, name, Role::Surface, pending.is_denied);
                // "Not wood" says little about the actual material.
                if !pending.is_denied {
                    // A repeated surface counts once.
                    self.surfaces.retain(|before| before != hints);
                    self.surfaces.push(*hints);
                    self.looks.like = Some(like.clone());
                    if self.looks.color_srgb.is_none() {
                        self.looks.color_srgb = *color_srgb;
                    }
                    self.looks.gloss = self.looks.gloss.or(*gloss);
                }
            }
            Meaning::Quality { hints, gloss, mottle } => {
                self.note(text, name, Role::Quality, pending.is_denied);
                self.say(hints, pending);
                if !pending.is_denied {
                    self.looks.gloss = gloss.or(self.looks.gloss);
                    self.looks.mottle = mottle.or(self.looks.mottle);
                }
            }
            Meaning::Pattern { kind, period_m, hints } => {
                self.note(text, name, Role::Pattern, pending.is_denied);
                self.say(hints, pending);
                if !pending.is_denied {
                    self.looks.pattern = Some((*kind, self.length_m.unwrap_or(*period_m)));
                    self.looks.is_period_stated = self.length_m.is_some();
                }
            }
        }
        self.pending = Pending::NOTHING;
    }

    /// Assigns a length to the pattern before or after it.
    fn lengthen(&mut self, meters: f64) {
        self.length_m = Some(meters);
        if let Some((_, period_m)) = &mut self.looks.pattern {
            *period_m = meters;
            self.looks.is_period_stated = true;
        }
    }

    fn note(&mut self, text: &str, name: &str, role: Role, is_denied: bool) {
        let word = Word { text: text.to_owned(), taken_for: name.to_owned(), role, is_denied };
        if !self.words.contains(&word) {
            self.words.push(word);
        }
    }

    fn say(&mut self, hints: &Hints, pending: Pending) {
        for (said, hint) in self.said.iter_mut().zip(hints) {
            tell(said, hint.map(|hint| qualified(hint, pending)));
        }
    }

    fn finish(mut self, n_left_out: usize) -> PromptInterpretation {
        let last = self.surfaces.len().saturating_sub(1);
        for (index, hints) in self.surfaces.iter().enumerate() {
            let widened = if index == last { 1.0 } else { BEFORE_ANOTHER };
            for (said, hint) in self.said.iter_mut().zip(hints) {
                tell(said, hint.map(|hint| Estimate { deviation: widened * hint.deviation, ..hint }));
            }
        }
        let mut disputed = Vec::new();
        let attributes = std::array::from_fn(|attribute| {
            let (estimate, is_disputed) = combined(&self.said[attribute]);
            if is_disputed {
                disputed.push(ATTRIBUTES[attribute]);
            }
            estimate
        });
        PromptInterpretation {
            attributes,
            looks: self.looks,
            words: self.words,
            unknown: self.unknown,
            disputed,
            n_left_out,
        }
    }
}

/// Adds an estimate unless it is already present: a repeated word adds no information.
fn tell(said: &mut Vec<Estimate>, more: Option<Estimate>) {
    said.extend(more.filter(|estimate| !said.contains(estimate)));
}

/// Applies degree and negation to an estimate.
fn qualified(hint: Estimate, pending: Pending) -> Estimate {
    let Estimate { mut mean, mut deviation } = hint;
    deviation /= pending.weight.sqrt();
    let end = if mean < 50.0 { 0.0 } else { 100.0 };
    let toward = if pending.reach < 0.0 { 50.0 } else { end };
    mean += pending.reach.abs().min(1.0) * (toward - mean);
    if pending.is_denied {
        mean = 100.0 - mean;
        deviation *= DENIED;
    }
    Estimate { mean, deviation }
}

/// Returns the precision-weighted mean, and whether the Birge ratio of the estimates exceeds 2.
fn combined(estimates: &[Estimate]) -> (Estimate, bool) {
    if estimates.is_empty() {
        return (OPEN, false);
    }
    let precision = |estimate: &Estimate| 1.0 / (estimate.deviation * estimate.deviation);
    let total: f64 = estimates.iter().map(precision).sum();
    let mean = estimates.iter().map(|estimate| precision(estimate) * estimate.mean).sum::<f64>() / total;
    let off: f64 =
        estimates.iter().map(|estimate| precision(estimate) * (estimate.mean - mean).powi(2)).sum();
    // A single estimate cannot disagree.
    let ratio = off / (estimates.len() - 1).max(1) as f64;
    let deviation = (ratio.max(1.0) / total).sqrt().clamp(SUREST, OPEN.deviation);
    (Estimate { mean: mean.clamp(0.0, 100.0), deviation }, ratio > 4.0)
}

#[cfg(test)]
mod tests;
