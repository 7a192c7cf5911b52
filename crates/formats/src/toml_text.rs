//! Texts of TOML files: strings to write, and errors with their line.

use crate::parser_words::plain;

/// A TOML string: JSON escapes, plus one for DEL, which TOML also requires.
pub(crate) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007F")
}

/// The parser's message on one line, with the line number in the file.
pub(crate) fn reason(error: &toml::de::Error, text: &str) -> String {
    let message = plain(error.message());
    match error.span().and_then(|span| text.get(..span.start)) {
        Some(before) => format!("{message} at line {}", line_after(before)),
        None => message,
    }
}

/// Number, from one, of the line that follows a text.
pub(crate) fn line_after(before: &str) -> usize {
    before.matches('\n').count() + 1
}
