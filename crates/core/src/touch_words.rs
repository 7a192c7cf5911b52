//! Words of touch, and what each leads one to expect of a surface.
//!
//! Expectations are estimates on five attributes of 0..100, on the scale of the starter library: nobody rated a word.
//! [`crate::prompt`] puts those of a whole prompt together.

use std::collections::BTreeMap;

use crate::gaussian_process::Estimate;
use crate::material::PatternKind;

/// Names of the attributes, in their order everywhere.
pub const ATTRIBUTES: [&str; 5] =
    ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];

/// What a word says of each attribute; `None` where it says nothing.
pub type Hints = [Option<Estimate>; ATTRIBUTES.len()];

/// Most words of a phrase.
pub const LONGEST_PHRASE: usize = 3;

/// What a word means.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// Something to touch.
    Surface {
        /// The material of the starter library that it is built and looks like.
        like: String,
        /// What it is expected to feel like, in every respect.
        hints: Hints,
        /// Its usual color, where it differs.
        color_srgb: Option<[u8; 3]>,
        /// Its gloss, 0..1, where it differs.
        gloss: Option<f64>,
    },
    /// An adjective.
    Quality {
        /// What it says.
        hints: Hints,
        /// A gloss of 0..1 that it asks for.
        gloss: Option<f64>,
        /// Flecks of this strength, 0..1.
        mottle: Option<f64>,
    },
    /// A regular relief.
    Pattern {
        /// Its shape.
        kind: PatternKind,
        /// Usual distance between neighbors, in m.
        period_m: f64,
        /// What it says.
        hints: Hints,
    },
    /// A color, sRGB.
    Color([u8; 3]),
    /// A way to change colors.
    Shade(Shade),
    /// A factor for the periods of patterns and grain.
    Size(f64),
    /// How much of what follows.
    Degree {
        /// Factor of its precision.
        weight: f64,
        /// Share of the way to the nearer end of the axis by which its mean moves outward; inward below 0.
        reach: f64,
    },
    /// Turns around what follows.
    Negation,
    /// Says nothing of a surface.
    Filler,
}

/// A way to change colors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    /// Share by which a color is lightened, darkened below 0; -1 to 1.
    pub lightness: f64,
    /// Share by which it is more saturated, less below 0; -1 to 1.
    pub saturation: f64,
}

/// Words and their meanings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lexicon {
    meanings: Vec<(String, Meaning)>,
    words: BTreeMap<String, usize>,
}

/// Why words make no lexicon.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LexiconError {
    /// A word stands twice.
    #[error("\"{word}\" stands twice")]
    Twice {
        /// The word.
        word: String,
    },
    /// A word could never be found.
    #[error("\"{word}\" is no phrase of one to {LONGEST_PHRASE} lowercase words")]
    NoPhrase {
        /// What was given.
        word: String,
    },
    /// A meaning has no word.
    #[error("an entry has no words")]
    NoWords,
}

impl Lexicon {
    /// A lexicon of words that share a meaning, the first of them its name.
    ///
    /// # Errors
    /// See [`LexiconError`].
    pub fn new(entries: Vec<(Vec<String>, Meaning)>) -> Result<Self, LexiconError> {
        let mut lexicon = Self::default();
        for (words, meaning) in entries {
            let index = lexicon.meanings.len();
            let name = words.first().ok_or(LexiconError::NoWords)?.clone();
            lexicon.meanings.push((name, meaning));
            for word in words {
                let is_word = |part: &str| {
                    !part.is_empty() && part.chars().all(|c| c.is_alphanumeric() && !c.is_uppercase())
                };
                let parts: Vec<&str> = word.split(' ').collect();
                if parts.len() > LONGEST_PHRASE || !parts.into_iter().all(is_word) {
                    return Err(LexiconError::NoPhrase { word });
                }
                if lexicon.words.contains_key(&word) {
                    return Err(LexiconError::Twice { word });
                }
                lexicon.words.insert(word, index);
            }
        }
        Ok(lexicon)
    }

    /// The name and meaning of a word or phrase, as it stands there.
    pub fn get(&self, word: &str) -> Option<(&str, &Meaning)> {
        let (name, meaning) = &self.meanings[*self.words.get(word)?];
        Some((name, meaning))
    }

    /// All words and phrases with the names of their meanings, in alphabetical order.
    pub fn words(&self) -> impl Iterator<Item = (&str, &str)> {
        self.words.iter().map(|(word, index)| (word.as_str(), self.meanings[*index].0.as_str()))
    }

    /// The one word that this one is misspelled for: it differs by one letter put in, left out, exchanged with its neighbor
    /// or put in the place of another, from eight letters on by two. `None` where several are as near.
    pub fn misspelled(&self, word: &str) -> Option<&str> {
        const SHORTEST: usize = 5;
        const LONG: usize = 8;
        let letters: Vec<char> = word.chars().collect();
        if letters.len() < SHORTEST {
            return None;
        }
        let limit = if letters.len() < LONG { 1 } else { 2 };
        let mut best: Option<(usize, &str)> = None;
        let mut n_best = 0;
        for known in self.words.keys().map(String::as_str).filter(|known| known.len() >= SHORTEST - 1) {
            let distance = distance(&letters, known, limit);
            match best {
                _ if distance > limit => {}
                Some((least, _)) if distance > least => {}
                Some((least, other)) if distance == least => {
                    // Words of one meaning do not contend.
                    n_best += usize::from(self.words[known] != self.words[other]);
                }
                _ => (best, n_best) = (Some((distance, known)), 1),
            }
        }
        best.filter(|_| n_best == 1).map(|(_, known)| known)
    }
}

/// Letters put in, left out, exchanged with a neighbor or replaced (F. Damerau 1964), or more than `limit`.
fn distance(letters: &[char], known: &str, limit: usize) -> usize {
    let known: Vec<char> = known.chars().collect();
    if letters.len().abs_diff(known.len()) > limit {
        return limit + 1;
    }
    let mut rows = vec![vec![0; known.len() + 1]; letters.len() + 1];
    for (i, row) in rows.iter_mut().enumerate() {
        row[0] = i;
    }
    for (j, first) in rows[0].iter_mut().enumerate() {
        *first = j;
    }
    for i in 1..=letters.len() {
        for j in 1..=known.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(letters[i - 1] != known[j - 1]);
            let mut least = replaced.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
            if i > 1 && j > 1 && letters[i - 1] == known[j - 2] && letters[i - 2] == known[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = least;
        }
    }
    rows[letters.len()][known.len()]
}

#[cfg(test)]
mod tests {
    use super::{Lexicon, LexiconError, Meaning, distance};

    fn lexicon(entries: &[(&[&str], Meaning)]) -> Result<Lexicon, LexiconError> {
        let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
        Lexicon::new(entries.iter().map(|(of, meaning)| (words(of), meaning.clone())).collect())
    }

    #[test]
    fn words_lead_to_the_name_and_meaning_of_their_entry() {
        let lexicon =
            lexicon(&[(&["tiny", "very small"], Meaning::Size(0.4)), (&["not"], Meaning::Negation)]).unwrap();
        assert_eq!(lexicon.get("very small"), Some(("tiny", &Meaning::Size(0.4))));
        assert_eq!(lexicon.get("small"), None);
        assert_eq!(
            lexicon.words().collect::<Vec<_>>(),
            [("not", "not"), ("tiny", "tiny"), ("very small", "tiny")]
        );
    }

    #[test]
    fn words_that_could_not_be_found_are_refused() {
        let error = |words: &[&str]| lexicon(&[(words, Meaning::Filler)]).unwrap_err();
        assert_eq!(error(&["a", "a"]), LexiconError::Twice { word: "a".to_owned() });
        for wrong in ["", "Wood", "wood  chip", "wood-chip", "one two three four"] {
            assert_eq!(error(&[wrong]), LexiconError::NoPhrase { word: wrong.to_owned() });
        }
        assert_eq!(error(&[]), LexiconError::NoWords);
    }

    #[test]
    fn a_letter_amiss_is_forgiven_where_only_one_word_is_meant() {
        let words: [(&[&str], Meaning); 4] = [
            (&["carpet"], Meaning::Filler),
            (&["silky", "silkie"], Meaning::Filler),
            (&["milky"], Meaning::Filler),
            (&["corrugated"], Meaning::Filler),
        ];
        let lexicon = lexicon(&words).unwrap();
        for (wrong, right) in [
            ("carpt", Some("carpet")),
            ("carpett", Some("carpet")),
            ("capret", Some("carpet")),
            ("karpet", Some("carpet")),
            ("karpett", None),
            ("corugatd", Some("corrugated")),
            ("bilky", None),
            ("silkye", Some("silkie")),
            ("carp", None),
        ] {
            assert_eq!(lexicon.misspelled(wrong), right, "{wrong}");
        }
    }

    #[test]
    fn distances_are_those_of_the_definition() {
        let of = |a: &str, b: &str| distance(&a.chars().collect::<Vec<_>>(), b, 3);
        assert_eq!(
            [of("ab", "ab"), of("ab", "ba"), of("ab", "abc"), of("abc", "xbc"), of("abcd", "xy")],
            [0, 1, 1, 1, 4]
        );
        assert_eq!(of("a", "abcdefgh"), 4, "more than the limit");
    }
}
