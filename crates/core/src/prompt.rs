//! What a prompt leads one to expect of a surface: of its attributes, with how unsure that is, and of its looks.
//!
//! Words are taken one by one, the longest known phrase first. On each attribute their estimates are averaged by their
//! precisions; where they disagree by more than they are unsure, the result is as unsure as they disagree (R. Birge 1932). A
//! word that says nothing leaves an attribute open: its middle, as unsure as if any value were as likely.

mod tokens;

use crate::gaussian_process::Estimate;
use crate::material::PatternKind;
use crate::prompt::tokens::{Token, tokens};
use crate::touch_words::{ATTRIBUTES, Hints, LONGEST_PHRASE, Lexicon, Meaning, Shade};

/// What is known of an attribute of which nothing was said: any value from 0 to 100 is as likely.
pub const OPEN: Estimate = Estimate { mean: 50.0, deviation: 28.9 };
/// Words alone are never surer than this, in points.
const SUREST: f64 = 4.0;
/// Factor of the deviation of what is denied: "not rough" is not at the other end for sure.
const DENIED: f64 = 1.4;
/// Factor of the deviation of a surface that only goes before another: a "steel table" feels of steel, a "stone carpet" not.
const BEFORE_ANOTHER: f64 = 1.5;
/// Words after which a negation or degree has nothing to go with.
const HOLDS_FOR: usize = 4;
/// Words beyond this many are left out.
pub const MOST_WORDS: usize = 400;

/// What a prompt was understood as.
#[derive(Clone, Debug, PartialEq)]
pub struct Understood {
    /// The attributes in the order of [`ATTRIBUTES`], 0..100.
    pub attributes: [Estimate; ATTRIBUTES.len()],
    /// What it is to look like.
    pub looks: Looks,
    /// Words that were understood, in their order.
    pub words: Vec<Word>,
    /// Words that were not.
    pub unknown: Vec<String>,
    /// Attributes on which the words disagree.
    pub disputed: Vec<&'static str>,
    /// Words that were left out because there were too many.
    pub n_left_out: usize,
}

/// A word that was understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// As it stands in the prompt.
    pub text: String,
    /// The name of what it was taken for.
    pub taken_for: String,
    /// What kind of word it is.
    pub role: Role,
    /// Whether it was denied.
    pub is_denied: bool,
}

/// What kind of word it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Something to touch.
    Surface,
    /// An adjective.
    Quality,
    /// A regular relief.
    Pattern,
    /// A color, or a change of it.
    Color,
    /// A size, or a length.
    Size,
}

/// What a surface is to look like; `None` where nothing was said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Looks {
    /// The material of the starter library that it is like.
    pub like: Option<String>,
    /// Its color.
    pub color_srgb: Option<[u8; 3]>,
    /// A second color.
    pub second_srgb: Option<[u8; 3]>,
    /// What all colors are changed by.
    pub shade: Shade,
    /// Its gloss, 0..1.
    pub gloss: Option<f64>,
    /// Strength of its flecks, 0..1.
    pub mottle: Option<f64>,
    /// Its regular relief, with the distance between neighbors in m.
    pub pattern: Option<(PatternKind, f64)>,
    /// Factor of all periods.
    pub scale: f64,
}

/// A name for what a prompt describes: one line of at most so many letters (2 or more); `None` of nothing.
pub fn title(prompt: &str, most: usize) -> Option<String> {
    let line = prompt.split_whitespace().collect::<Vec<_>>().join(" ");
    let letters: Vec<char> = line.chars().filter(|c| !c.is_control()).collect();
    match letters.len() {
        0 => None,
        n if n <= most => Some(letters.into_iter().collect()),
        _ => Some(letters[..most - 1].iter().chain(&['…']).collect()),
    }
}

impl Understood {
    /// Whether anything was said that can be felt.
    pub fn is_about_touch(&self) -> bool {
        self.words.iter().any(|word| matches!(word.role, Role::Surface | Role::Quality | Role::Pattern))
    }
}

/// What was collected of a prompt.
struct Reading<'a> {
    lexicon: &'a Lexicon,
    /// What was said of each attribute, but by surfaces.
    said: [Vec<Estimate>; ATTRIBUTES.len()],
    /// What surfaces say, in their order.
    surfaces: Vec<Hints>,
    looks: Looks,
    words: Vec<Word>,
    unknown: Vec<String>,
    /// A length that waits for its pattern, or a pattern's own.
    length_m: Option<f64>,
    pending: Pending,
}

/// What goes with the next word that can be felt.
#[derive(Clone, Copy)]
struct Pending {
    is_denied: bool,
    weight: f64,
    reach: f64,
    /// Words until it is forgotten.
    n_left: usize,
}

impl Pending {
    const NOTHING: Self = Self { is_denied: false, weight: 1.0, reach: 0.0, n_left: 0 };
}

/// What a prompt of any length and script leads one to expect.
pub fn understand(prompt: &str, lexicon: &Lexicon) -> Understood {
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
    /// Takes the longest phrase at the beginning, and returns how many tokens it has.
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

    /// A phrase as it stands there, or with the ending of its last word taken off.
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
                // "Not wood" says little of what it is instead.
                if !pending.is_denied {
                    // Named again it is still one.
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
                }
            }
        }
        self.pending = Pending::NOTHING;
    }

    /// A length is that of a pattern, before or after it.
    fn lengthen(&mut self, meters: f64) {
        self.length_m = Some(meters);
        if let Some((_, period_m)) = &mut self.looks.pattern {
            *period_m = meters;
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

    fn finish(mut self, n_left_out: usize) -> Understood {
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
        Understood {
            attributes,
            looks: self.looks,
            words: self.words,
            unknown: self.unknown,
            disputed,
            n_left_out,
        }
    }
}

/// Adds what was said, once: a word that is said again says nothing new.
fn tell(said: &mut Vec<Estimate>, more: Option<Estimate>) {
    said.extend(more.filter(|estimate| !said.contains(estimate)));
}

/// An estimate with what goes with it: denied, stronger or weaker.
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

/// The mean by precisions, and whether the estimates disagree by more than they are unsure.
fn combined(estimates: &[Estimate]) -> (Estimate, bool) {
    if estimates.is_empty() {
        return (OPEN, false);
    }
    let precision = |estimate: &Estimate| 1.0 / (estimate.deviation * estimate.deviation);
    let total: f64 = estimates.iter().map(precision).sum();
    let mean = estimates.iter().map(|estimate| precision(estimate) * estimate.mean).sum::<f64>() / total;
    let off: f64 =
        estimates.iter().map(|estimate| precision(estimate) * (estimate.mean - mean).powi(2)).sum();
    // One estimate has nothing to disagree with.
    let ratio = off / (estimates.len() - 1).max(1) as f64;
    let deviation = (ratio.max(1.0) / total).sqrt().clamp(SUREST, OPEN.deviation);
    (Estimate { mean: mean.clamp(0.0, 100.0), deviation }, ratio > 4.0)
}

#[cfg(test)]
mod tests;
