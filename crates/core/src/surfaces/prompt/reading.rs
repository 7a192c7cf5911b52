//! Reads the tokens of a prompt one after another.

use crate::maths::gaussian_process::Estimate;
use crate::surfaces::prompt::combining::{Modifiers, combined, qualified, tell};
use crate::surfaces::prompt::tokens::{self, Token};
use crate::surfaces::prompt::{Looks, PromptInterpretation, Role, Word};
use crate::surfaces::touch_words::{ATTRIBUTES, Hints, LONGEST_PHRASE, Lexicon, Meaning, Shade};

/// Factor on the standard deviation of a surface followed by another: "steel table" feels of steel, "stone carpet" does
/// not feel of stone.
const BEFORE_ANOTHER: f64 = 1.5;
/// Number of known words within which a negation or degree word applies.
const HOLDS_FOR: usize = 4;
/// Words that join adjectives. A word of light before one of them is an adjective, too: "soft light and thin".
const CONJUNCTIONS: [&str; 3] = ["and", "but", "or"];

/// State while reading a prompt.
pub(super) struct Reading<'a> {
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
    modifiers: Modifiers,
    /// Remaining known words before the modifiers expire.
    n_left: usize,
}

impl Pending {
    const NOTHING: Self = Self { modifiers: Modifiers::NONE, n_left: 0 };
}

/// A known phrase of a prompt.
struct Found<'a> {
    n_tokens: usize,
    phrase: String,
    /// Name of its lexicon entry.
    name: &'a str,
    meaning: &'a Meaning,
}

impl<'a> Reading<'a> {
    pub(super) fn new(lexicon: &'a Lexicon) -> Self {
        Self {
            lexicon,
            said: Default::default(),
            surfaces: Vec::new(),
            looks: Looks { scale: 1.0, ..Looks::default() },
            words: Vec::new(),
            unknown: Vec::new(),
            length_m: None,
            pending: Pending::NOTHING,
        }
    }

    /// Applies the longest known phrase at the start, and returns its number of tokens.
    pub(super) fn take(&mut self, tokens: &[Token]) -> usize {
        let first = match &tokens[0] {
            Token::Break => {
                self.pending = Pending::NOTHING;
                return 1;
            }
            Token::Length { text, meters } => {
                self.note(text, text, Role::Size, false);
                self.lengthen(*meters);
                return 1;
            }
            Token::Word(first) => first,
        };
        let Some(Found { n_tokens, phrase, name, meaning }) = self.longest(tokens) else {
            let guessed = self.lexicon.misspelled(first).and_then(|known| self.lexicon.get(known));
            match guessed {
                Some((name, meaning)) => self.apply(first, name, meaning),
                None => self.unknown.push(first.clone()),
            }
            return 1;
        };
        let is_quality = matches!(meaning, Meaning::Quality { .. });
        if let Some(n_tokens) = is_quality.then(|| self.depicted(tokens)).flatten() {
            self.pending = Pending::NOTHING;
            return n_tokens;
        }
        self.apply(&phrase, name, meaning);
        n_tokens
    }

    /// Finds the longest known phrase at the start.
    fn longest(&self, tokens: &[Token]) -> Option<Found<'a>> {
        let words: Vec<&str> = tokens.iter().map_while(Token::word).take(LONGEST_PHRASE).collect();
        (1..=words.len()).rev().find_map(|n_tokens| {
            let phrase = words[..n_tokens].join(" ");
            let (name, meaning) = self.known(&phrase)?;
            Some(Found { n_tokens, phrase, name, meaning })
        })
    }

    /// Returns the number of tokens up to the word of a picture or of light that the adjective at the start describes, if
    /// there is one: "soft light on silk", "a rough sketch of silk".
    fn depicted(&self, tokens: &[Token]) -> Option<usize> {
        let mut at = self.longest(tokens)?.n_tokens;
        loop {
            let rest = tokens.get(at..)?;
            if self.is_depiction(rest) {
                return Some(at + 1);
            }
            let next = self.longest(rest)?;
            let is_adjective = matches!(
                next.meaning,
                Meaning::Quality { .. }
                    | Meaning::Degree { .. }
                    | Meaning::Color(_)
                    | Meaning::Shade(_)
                    | Meaning::Size(_)
            );
            if !is_adjective {
                return None;
            }
            at += next.n_tokens;
        }
    }

    /// Returns whether the first word is one of pictures or of light, and no adjective of what follows: "soft light wool" is
    /// a soft wool.
    fn is_depiction(&self, tokens: &[Token]) -> bool {
        let Some(word) = tokens.first().and_then(Token::word) else { return false };
        let lexicon = self.lexicon;
        if !lexicon.is_depiction(word) && !tokens::stems(word).iter().any(|stem| lexicon.is_depiction(stem)) {
            return false;
        }
        match tokens.get(1) {
            None | Some(Token::Break) => !self.surfaces.is_empty(),
            Some(next) => {
                next.word().is_none_or(|next| !CONJUNCTIONS.contains(&next))
                    && self
                        .longest(&tokens[1..])
                        .is_some_and(|found| matches!(found.meaning, Meaning::Filler))
            }
        }
    }

    /// Looks up a phrase as written, then with the ending of its last word removed.
    fn known(&self, phrase: &str) -> Option<(&'a str, &'a Meaning)> {
        let lexicon = self.lexicon;
        lexicon.get(phrase).or_else(|| tokens::stems(phrase).iter().find_map(|stem| lexicon.get(stem)))
    }

    fn apply(&mut self, text: &str, name: &str, meaning: &Meaning) {
        let Pending { modifiers: before, n_left } = self.pending;
        self.pending.n_left = n_left.saturating_sub(1);
        if n_left == 0 {
            self.pending = Pending::NOTHING;
        }
        // A modifier holds for some words only.
        let now = self.pending.modifiers;
        match meaning {
            Meaning::Filler => return,
            Meaning::Negation => {
                let modifiers = Modifiers { is_denied: !before.is_denied, ..now };
                self.pending = Pending { modifiers, n_left: HOLDS_FOR };
                return;
            }
            Meaning::Degree { weight, reach } => {
                let (weight, reach) = (now.weight * weight, now.reach + reach);
                let modifiers = Modifiers { weight, reach, ..now };
                self.pending = Pending { modifiers, n_left: HOLDS_FOR };
                return;
            }
            Meaning::Color(srgb) => {
                self.note(text, name, Role::Color, now.is_denied);
                match (now.is_denied, self.looks.color_srgb) {
                    (true, _) => {}
                    (false, None) => self.looks.color_srgb = Some(*srgb),
                    (false, Some(_)) => self.looks.second_srgb = Some(*srgb),
                }
                return;
            }
            Meaning::Shade(Shade { lightness, saturation }) => {
                self.note(text, name, Role::Color, now.is_denied);
                let sign = if now.is_denied { -1.0 } else { 1.0 };
                let shade = &mut self.looks.shade;
                shade.lightness = (shade.lightness + sign * lightness).clamp(-1.0, 1.0);
                shade.saturation = (shade.saturation + sign * saturation).clamp(-1.0, 1.0);
                return;
            }
            Meaning::Size(factor) => {
                self.note(text, name, Role::Size, now.is_denied);
                let factor = if now.is_denied { 1.0 / factor } else { *factor };
                self.looks.scale = (self.looks.scale * factor).clamp(0.1, 10.0);
                return;
            }
            Meaning::Surface { like, hints, color_srgb, gloss } => {
                self.note(text, name, Role::Surface, before.is_denied);
                // "Not wood" says little about the actual material.
                if !before.is_denied {
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
                self.note(text, name, Role::Quality, before.is_denied);
                self.say(hints, before);
                if !before.is_denied {
                    self.looks.gloss = gloss.or(self.looks.gloss);
                    self.looks.mottle = mottle.or(self.looks.mottle);
                }
            }
            Meaning::Pattern { kind, period_m, hints } => {
                self.note(text, name, Role::Pattern, before.is_denied);
                self.say(hints, before);
                if !before.is_denied {
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

    fn say(&mut self, hints: &Hints, modifiers: Modifiers) {
        for (said, hint) in self.said.iter_mut().zip(hints) {
            tell(said, hint.map(|hint| qualified(hint, modifiers)));
        }
    }

    pub(super) fn finish(mut self, n_left_out: usize) -> PromptInterpretation {
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
