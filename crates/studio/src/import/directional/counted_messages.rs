//! Messages about many strokes, of which equal ones are counted.

use std::collections::BTreeMap;
use std::path::Path;

use shagreen_core::words::counted;

use crate::file::file_name;

/// Messages by their first words, each with its number and the first file.
#[derive(Debug, Default)]
pub(super) struct CountedMessages(BTreeMap<String, Message>);

#[derive(Debug)]
struct Message {
    text: String,
    file: String,
    n: usize,
}

impl CountedMessages {
    /// Adds a message about a file. Messages with the same words up to a colon count as equal; their figures differ.
    pub(super) fn add(&mut self, text: &str, file: &Path) {
        let words = text.split_once(": ").map_or(text, |(words, _)| words);
        let message = self.0.entry(words.to_owned()).or_insert_with(|| Message {
            text: text.to_owned(),
            file: file_name(file),
            n: 0,
        });
        message.n += 1;
    }

    /// One sentence for each kind of message, in alphabetical order.
    pub(super) fn into_sentences(self) -> Vec<String> {
        let sentence = |Message { text, file, n }| match n {
            1 => format!("{file}: {text}"),
            n => format!("{}, first {file}: {text}", counted(n, "stroke")),
        };
        self.0.into_values().map(sentence).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::CountedMessages;
    use std::path::Path;

    #[test]
    fn equal_messages_are_counted() {
        let mut messages = CountedMessages::default();
        for (text, file) in [
            ("gaps: 3 of 9 rows", "data/a.csv"),
            ("no force file", "data/a.csv"),
            ("gaps: 2 of 9 rows", "data/b.csv"),
        ] {
            messages.add(text, Path::new(file));
        }
        assert_eq!(
            messages.into_sentences(),
            ["2 strokes, first a.csv: gaps: 3 of 9 rows", "a.csv: no force file"]
        );
    }
}
