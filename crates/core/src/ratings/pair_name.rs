//! Adjective pairs as one name: `rough-smooth`.

use std::str::FromStr;

use crate::ratings::AdjectivePair;

/// Why a name is no pair of adjectives.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PairNameError {
    /// There is one word only.
    #[error(
        "\"{name}\" names one pole; name both with a hyphen between them, as \"rough-smooth\", the one at 0 first"
    )]
    OnePole {
        /// The name.
        name: String,
    },
    /// There is more than one place to part it.
    #[error(
        "\"{name}\" can be parted in several ways; put spaces around the hyphen between the poles, as \"non-stick - sticky\""
    )]
    Ambiguous {
        /// The name.
        name: String,
    },
}

/// What may stand between the poles.
const SEPARATORS: [char; 5] = ['-', '\u{2013}', '\u{2014}', '/', '_'];

impl FromStr for AdjectivePair {
    type Err = PairNameError;

    /// The pair of a name with a hyphen, dash, slash or underscore between its poles. Where a pole has one itself, spaces
    /// stand around the one between the poles.
    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let is_separator = |c: char| SEPARATORS.contains(&c);
        let words: Vec<&str> = name.split_whitespace().collect();
        let mut alone = words.iter().enumerate().filter(|(_, word)| word.chars().all(is_separator));
        let (low, high) = match (alone.next(), alone.next()) {
            (Some((at, _)), None) => (words[..at].join(" "), words[at + 1..].join(" ")),
            (Some(_), Some(_)) => return Err(PairNameError::Ambiguous { name: name.to_owned() }),
            (None, _) => {
                let parts: Vec<&str> = name.split(is_separator).map(str::trim).collect();
                match parts[..] {
                    [low, high] => (low.to_owned(), high.to_owned()),
                    [_] => return Err(PairNameError::OnePole { name: name.to_owned() }),
                    _ => return Err(PairNameError::Ambiguous { name: name.to_owned() }),
                }
            }
        };
        if low.is_empty() || high.is_empty() {
            return Err(PairNameError::OnePole { name: name.to_owned() });
        }
        Ok(Self { low, high })
    }
}

/// The words at both ends of an attribute: the poles of a pair; of a name that is none, itself and nothing.
pub fn poles(name: &str) -> [String; 2] {
    name.parse().map_or_else(|_| [name.to_owned(), String::new()], |AdjectivePair { low, high }| [low, high])
}

impl AdjectivePair {
    /// The pair as one name that [`FromStr`] reads back.
    pub fn name(&self) -> String {
        let plain = |pole: &str| !pole.contains(SEPARATORS);
        if plain(&self.low) && plain(&self.high) {
            format!("{}-{}", self.low, self.high)
        } else {
            format!("{} - {}", self.low, self.high)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AdjectivePair, PairNameError, poles};

    #[test]
    fn names_are_parted_and_put_together() {
        for (name, low, high) in [
            ("rough-smooth", "rough", "smooth"),
            ("Rough \u{2013} Smooth", "Rough", "Smooth"),
            ("flat_bumpy", "flat", "bumpy"),
            ("sticky/slippery", "sticky", "slippery"),
            ("not so hard - very soft", "not so hard", "very soft"),
            ("non-stick - sticky", "non-stick", "sticky"),
        ] {
            let pair: AdjectivePair = name.parse().unwrap();
            assert_eq!((pair.low.as_str(), pair.high.as_str()), (low, high));
            assert_eq!(pair.name().parse(), Ok(pair));
        }
        for name in ["rough", "rough-", "-smooth", "", " - "] {
            assert!(matches!(name.parse::<AdjectivePair>(), Err(PairNameError::OnePole { .. })), "{name}");
        }
        for name in ["non-stick-sticky", "a - b - c"] {
            assert!(matches!(name.parse::<AdjectivePair>(), Err(PairNameError::Ambiguous { .. })), "{name}");
        }
    }

    #[test]
    fn an_attribute_has_two_ends_or_one() {
        assert_eq!(poles("rough-smooth"), ["rough", "smooth"]);
        assert_eq!(poles("not hard - very soft"), ["not hard", "very soft"]);
        assert_eq!(poles("warm"), ["warm", ""]);
        assert_eq!(poles("a-b-c"), ["a-b-c", ""]);
    }
}
