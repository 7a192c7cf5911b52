//! Line of a key in a plan file.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::toml_text::line_after;

/// A plan file, to find the lines of its keys.
pub(super) struct Lines<'a> {
    text: &'a str,
    /// `None` if the text is not TOML.
    document: Option<Spanned<DeTable<'a>>>,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        // A text that is not TOML is reported by its reader.
        Self { text, document: DeTable::parse(text).ok() }
    }

    /// Line, from one, of a key such as `part[2].pairs`: of the key itself, else of its table; `None` if there is neither.
    pub(super) fn line_of(&self, key: &str) -> Option<usize> {
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
    use super::Lines;

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
}
