//! Lexicon of touch words, with the attributes each word predicts.
//!
//! Each word gives estimates on five attributes of 0 to 100, on the scale of the starter library. The estimates are not
//! human ratings. [`crate::surfaces::prompt`] combines the words of a whole prompt.

use std::collections::{BTreeMap, BTreeSet};

use crate::maths::gaussian_process::Estimate;
use crate::surfaces::material::PatternKind;

/// Names of the attributes, in fixed order.
pub const ATTRIBUTES: [&str; 5] =
    ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];

/// Estimates that a word gives for each attribute; `None` for attributes the word does not describe.
pub type Hints = [Option<Estimate>; ATTRIBUTES.len()];

/// Largest number of words in a phrase.
pub const LONGEST_PHRASE: usize = 3;

/// Meaning of a word.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// A material or an object.
    Surface {
        /// Identifier of the starter library material with the same structure and appearance.
        like: String,
        /// Estimates of all attributes.
        hints: Hints,
        /// Usual color, if it differs from that material.
        color_srgb: Option<[u8; 3]>,
        /// Gloss, 0 to 1, if it differs from that material.
        gloss: Option<f64>,
    },
    /// An adjective.
    Quality {
        /// Estimates of the attributes it describes.
        hints: Hints,
        /// Implied gloss, 0 to 1.
        gloss: Option<f64>,
        /// Implied strength of color flecks, 0 to 1.
        mottle: Option<f64>,
    },
    /// A regular pattern.
    Pattern {
        /// Shape of the pattern.
        kind: PatternKind,
        /// Usual period, in m.
        period_m: f64,
        /// Estimates of the attributes it describes.
        hints: Hints,
    },
    /// A color, sRGB.
    Color([u8; 3]),
    /// A color modifier.
    Shade(Shade),
    /// Factor on pattern periods, the roll-off wavelength and bump radii.
    Size(f64),
    /// A degree word, such as "very", for the next word.
    Degree {
        /// Factor on the precision of the next estimate.
        weight: f64,
        /// Relative shift of the next mean toward the nearer end of the axis, or toward its middle if negative.
        reach: f64,
    },
    /// Negates the next word.
    Negation,
    /// A word without information about a surface.
    Filler,
}

/// A color modification.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    /// Relative lightening, -1 (black) to 1 (white).
    pub lightness: f64,
    /// Relative change of saturation, -1 (gray) to 1.
    pub saturation: f64,
}

/// Words and phrases with their meanings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lexicon {
    meanings: Vec<(String, Meaning)>,
    words: BTreeMap<String, usize>,
    /// Words of pictures and of light.
    depictions: BTreeSet<String>,
    /// Words of surfaces, by the class of materials that they stand for.
    classes: BTreeMap<String, String>,
}

/// Reasons why entries do not form a lexicon.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LexiconError {
    /// A word is listed twice.
    #[error("\"{word}\" is listed twice; keep one of its entries")]
    Twice {
        /// The word.
        word: String,
    },
    /// A word cannot match any phrase of a prompt.
    #[error("\"{word}\" must be one to {LONGEST_PHRASE} lower-case words of letters and digits")]
    NoPhrase {
        /// Given word.
        word: String,
    },
    /// A word of pictures or of light is not a single word.
    #[error("\"{word}\" must be a single lower-case word of letters and digits")]
    NoWord {
        /// Given text.
        word: String,
    },
    /// An entry has no words.
    #[error("an entry has no words; add at least one")]
    NoWords,
    /// A class of materials stands for something that is not a surface.
    #[error("the class \"{class}\" stands for \"{word}\", which is not a word of a surface; give one")]
    NoSurface {
        /// Name of the class.
        class: String,
        /// Word given for it.
        word: String,
    },
}

impl Lexicon {
    /// Returns a lexicon of entries; the first word of an entry is its name.
    ///
    /// # Errors
    /// [`LexiconError`] at the first invalid entry.
    pub fn new(entries: Vec<(Vec<String>, Meaning)>) -> Result<Self, LexiconError> {
        let mut lexicon = Self::default();
        for (words, meaning) in entries {
            let index = lexicon.meanings.len();
            let name = words.first().ok_or(LexiconError::NoWords)?.clone();
            lexicon.meanings.push((name, meaning));
            for word in words {
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

    /// Returns the lexicon with these words of pictures and of light, such as "sketch". An adjective before one of them does
    /// not describe a surface. They may have another meaning, too.
    ///
    /// # Errors
    /// [`LexiconError::NoWord`] at the first one that is not a single word.
    pub fn with_depictions(self, words: Vec<String>) -> Result<Self, LexiconError> {
        match words.iter().find(|word| !is_word(word)) {
            Some(word) => Err(LexiconError::NoWord { word: word.clone() }),
            None => Ok(Self { depictions: words.into_iter().collect(), ..self }),
        }
    }

    /// Returns the lexicon with these classes of materials and the words of the surfaces that stand for them. A class whose
    /// name is the word of a surface needs none.
    ///
    /// # Errors
    /// [`LexiconError::NoSurface`] at the first class whose word is not that of a surface.
    pub fn with_classes(self, classes: BTreeMap<String, String>) -> Result<Self, LexiconError> {
        match classes.iter().find(|(_, word)| self.surface(word).is_none()) {
            Some((class, word)) => Err(LexiconError::NoSurface { class: class.clone(), word: word.clone() }),
            None => Ok(Self { classes, ..self }),
        }
    }

    /// Returns whether a word, as written, is one of pictures or of light.
    pub fn is_depiction(&self, word: &str) -> bool {
        self.depictions.contains(word)
    }

    /// Returns the name of the entry that stands for a class of materials, and its estimates; `None` if there is none.
    /// Hyphens and underscores in the name of the class count as spaces.
    pub fn material(&self, class: &str) -> Option<(&str, &Hints)> {
        let class = class.to_lowercase().replace(['-', '_'], " ");
        self.surface(self.classes.get(&class).map_or(class.as_str(), String::as_str))
    }

    fn surface(&self, word: &str) -> Option<(&str, &Hints)> {
        match self.get(word)? {
            (name, Meaning::Surface { hints, .. }) => Some((name, hints)),
            _ => None,
        }
    }

    /// Returns the name and meaning of a word or phrase as written.
    pub fn get(&self, word: &str) -> Option<(&str, &Meaning)> {
        let (name, meaning) = &self.meanings[*self.words.get(word)?];
        Some((name, meaning))
    }

    /// Returns all words and phrases with the name of their entry, in alphabetical order.
    pub fn words(&self) -> impl Iterator<Item = (&str, &str)> {
        self.words.iter().map(|(word, index)| (word.as_str(), self.meanings[*index].0.as_str()))
    }

    /// Returns the single known word that this one is a misspelling of.
    ///
    /// The edit distance is at most one, or two from eight letters on. A replaced letter counts as two, because it often makes
    /// another ordinary word ("store" and "stone"). `None` if several meanings are equally near.
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
                    // Synonyms do not make a match ambiguous.
                    n_best += usize::from(self.words[known] != self.words[other]);
                }
                _ => (best, n_best) = (Some((distance, known)), 1),
            }
        }
        best.filter(|_| n_best == 1).map(|(_, known)| known)
    }
}

/// Returns whether a text is one lower-case word of letters and digits.
fn is_word(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() && !c.is_uppercase())
}

/// Returns the edit distance (F. Damerau 1964), or any number above `limit`: insertions, deletions and transpositions count as
/// one, replacements as two.
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
            let replaced = rows[i - 1][j - 1] + 2 * usize::from(letters[i - 1] != known[j - 1]);
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
    use crate::maths::gaussian_process::Estimate;

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
    fn classes_of_materials_lead_to_surfaces() {
        let hints = [Some(Estimate { mean: 30.0, deviation: 9.0 }); 5];
        let surface =
            Meaning::Surface { like: "loop-carpet".to_owned(), hints, color_srgb: None, gloss: None };
        let lexicon = lexicon(&[
            (&["carpet", "rug"], surface.clone()),
            (&["wood chip"], surface),
            (&["plush"], Meaning::Filler),
        ])
        .unwrap();
        let classes = |pairs: &[(&str, &str)]| {
            pairs.iter().map(|(class, word)| ((*class).to_owned(), (*word).to_owned())).collect()
        };
        let lexicon =
            lexicon.with_classes(classes(&[("plush", "rug"), ("wood chips", "wood chip")])).unwrap();
        for (class, name) in [
            ("carpet", Some("carpet")),
            ("rug", Some("carpet")),
            ("plush", Some("carpet")),
            ("Wood-chips", Some("wood chip")),
            ("wood_chip", Some("wood chip")),
            ("lava", None),
        ] {
            assert_eq!(lexicon.material(class).map(|(name, _)| name), name, "{class}");
        }
        assert_eq!(lexicon.material("plush").unwrap().1, &hints);
        let error = lexicon.with_classes(classes(&[("wool", "plush")])).unwrap_err();
        assert!(error.to_string().contains("\"wool\" stands for \"plush\""), "{error}");
    }

    #[test]
    fn words_of_pictures_are_single_words() {
        let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
        let lexicon = Lexicon::default().with_depictions(words(&["light", "sketch"])).unwrap();
        assert!(lexicon.is_depiction("light") && !lexicon.is_depiction("wood"));
        let error = lexicon.with_depictions(words(&["light", "close up"])).unwrap_err();
        assert_eq!(error, LexiconError::NoWord { word: "close up".to_owned() });
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
            ("karpet", None),
            ("corugatd", Some("corrugated")),
            ("bilky", None),
            ("silkye", Some("silky")),
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
            [0, 1, 1, 2, 6]
        );
        assert_eq!(of("a", "abcdefgh"), 4, "above the limit");
    }
}
