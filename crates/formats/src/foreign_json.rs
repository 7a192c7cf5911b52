//! JSON files of formats that are not Shagreen's own: one object, without a header that all of them share.

use serde::de::DeserializeOwned;

use crate::foreign_file::Found;
use crate::own_json::check_density;
use crate::parser_words::plain;

/// Why bytes are no JSON object of the expected fields. Each format words its own error from this.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum ObjectFault {
    /// Not a JSON object.
    Foreign(Found),
    /// More values than a file of this length has, not valid JSON, or a field is missing or wrong.
    Damaged(String),
}

/// Mark at the begin of some UTF-8 files.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads the object of a file.
pub(crate) fn read_object<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, ObjectFault> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    if bytes.trim_ascii_start().first() != Some(&b'{') {
        return Err(ObjectFault::Foreign(Found::of(bytes)));
    }
    check_density(bytes).map_err(ObjectFault::Damaged)?;
    serde_json::from_slice(bytes).map_err(|error| ObjectFault::Damaged(plain(&error.to_string())))
}

#[cfg(test)]
mod tests {
    use super::{ObjectFault, read_object};
    use crate::foreign_file::Found;
    use serde_json::{Value, json};

    #[test]
    fn only_an_object_is_read() {
        let of = |text: &str| read_object::<Value>(text.as_bytes());
        assert_eq!(of(" {\"a\": 1}"), Ok(json!({"a": 1})));
        assert_eq!(of("\u{feff}{\"a\": 1}"), Ok(json!({"a": 1})));
        assert_eq!(of("[1]"), Err(ObjectFault::Foreign(Found::Unknown)));
        assert_eq!(of(""), Err(ObjectFault::Foreign(Found::Empty)));
        let is_damaged = |text: &str, words: &str| match of(text) {
            Err(ObjectFault::Damaged(reason)) => reason.contains(words),
            _ => false,
        };
        assert!(is_damaged("{\"a\": ", "it ends too early"));
        let zeros = format!("{{\"a\": [{}0]}}", "0,".repeat(2_000_000));
        assert!(is_damaged(&zeros, "values in"));
    }
}
