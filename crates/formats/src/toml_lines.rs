//! Problems of TOML files that people write, with the line and the key of each.

use shagreen_core::words::near;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::toml_text::line_after;

/// Something that is wrong with a file, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LocatedProblem {
    /// Line of the key or of its table, from one, if the file has either.
    pub line: Option<usize>,
    /// The key, such as `part[2].pairs`: the second `[[part]]`, its key `pairs`. Entries count from 1.
    pub key: String,
    /// What is wrong and what to do.
    pub text: String,
}

impl std::fmt::Display for LocatedProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}, {}: {}", self.key, self.text),
            None => write!(f, "{}: {}", self.key, self.text),
        }
    }
}

/// Returns problems as one line of text.
pub(crate) fn listed(problems: &[LocatedProblem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// Returns the advice for a key that is not one of these: similar ones, or all.
pub(crate) fn known_keys(known: &[&str], key: &str) -> String {
    let near = near(known.iter().copied(), key);
    if near.is_empty() {
        format!("the keys here are {}", known.join(", "))
    } else {
        format!("did you mean {}?", near.join(", "))
    }
}

/// A file, to find the lines of its keys.
pub(crate) struct Lines<'a> {
    text: &'a str,
    /// `None` if the text is not TOML.
    document: Option<Spanned<DeTable<'a>>>,
}

impl<'a> Lines<'a> {
    pub(crate) fn of(text: &'a str) -> Self {
        // A text that is not TOML is reported by its reader.
        Self { text, document: DeTable::parse(text).ok() }
    }

    /// Line, from one, of a key such as `part[2].pairs`: of the key itself, else of its table; `None` if there is neither.
    pub(crate) fn line_of(&self, key: &str) -> Option<usize> {
        let mut table = self.document.as_ref()?.get_ref();
        let mut begin = None;
        for segment in key.split('.') {
            let (name, number) = parted(segment);
            let Some((found, value)) = table.iter().find(|(key, _)| **key.get_ref() == *name) else { break };
            begin = Some(found.span().start);
            let inner = match (value.get_ref(), number) {
                (DeValue::Array(entries), Some(number)) => {
                    let Some(entry) = number.checked_sub(1).and_then(|index| entries.get(index)) else {
                        break;
                    };
                    begin = Some(entry.span().start);
                    entry.get_ref()
                }
                (other, _) => other,
            };
            let DeValue::Table(inner) = inner else { break };
            table = inner;
        }
        Some(line_after(self.text.get(..begin?)?))
    }
}

/// Name and number of `part[2]`; a segment without brackets has no number.
fn parted(segment: &str) -> (&str, Option<usize>) {
    let with_number = segment.strip_suffix(']').and_then(|begin| begin.split_once('['));
    match with_number {
        Some((name, number)) => (name, number.parse().ok()),
        None => (segment, None),
    }
}

#[cfg(test)]
mod tests {
    use super::{Lines, known_keys};

    #[test]
    fn keys_are_found_in_their_tables() {
        let text = "name = \"a\"\nnoise = { level_db = 3 }\n\n[[part]]\nid = \"a\"\n\n[[part]]\n# pairs\nid = \"\"\"\n[[part]]\n\"\"\"\npairs = []\n";
        for (key, line) in [
            ("name", Some(1)),
            ("noise.level_db", Some(2)),
            ("part", Some(4)),
            ("part[1].id", Some(5)),
            ("part[1].pairs", Some(4)),
            ("part[2].pairs", Some(12)),
            ("part[2].other", Some(7)),
            ("part[3].id", Some(4)),
            ("seed", None),
        ] {
            assert_eq!(Lines::of(text).line_of(key), line, "{key}");
        }
        assert_eq!(Lines::of("not = = toml").line_of("not"), None);
    }

    #[test]
    fn a_misspelled_key_has_a_suggestion() {
        assert_eq!(known_keys(&["texture", "stroke"], "textures"), "did you mean texture?");
        assert_eq!(known_keys(&["texture", "stroke"], "q"), "the keys here are texture, stroke");
    }
}
