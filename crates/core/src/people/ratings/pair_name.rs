//! Parsing and formatting of adjective pairs as one name, such as `rough-smooth`.

use std::str::FromStr;

use crate::people::ratings::AdjectivePair;

/// Reasons why a name cannot be parsed as an adjective pair.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PairNameError {
    /// The name contains only one pole.
    #[error(
        "\"{name}\" names only one pole; name both, separated by a hyphen, with the pole at 0 first: \"rough-smooth\""
    )]
    OnePole {
        /// The name given.
        name: String,
    },
    /// The name can be split in more than one place.
    #[error(
        "\"{name}\" can be split into poles in several ways; put spaces around the hyphen between the poles: \"non-stick - sticky\""
    )]
    Ambiguous {
        /// The name given.
        name: String,
    },
}

/// Characters that may separate the two poles.
const SEPARATORS: [char; 5] = ['-', '\u{2013}', '\u{2014}', '/', '_'];

impl FromStr for AdjectivePair {
    type Err = PairNameError;

    /// Parses two poles separated by a hyphen, dash, slash or underscore. If a pole itself contains such a character,
    /// the separator must have spaces around it.
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

/// The two poles of an attribute name; if it is not an adjective pair, the name itself and an empty string.
pub fn poles(name: &str) -> [String; 2] {
    name.parse().map_or_else(|_| [name.to_owned(), String::new()], |AdjectivePair { low, high }| [low, high])
}

impl AdjectivePair {
    /// Name of the pair, in the form that [`FromStr`] parses.
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
