//! What all JSON files of the program have in common: they say what they are, and in which version.

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;

/// Enough of any file to tell whether it is ours.
#[derive(Deserialize)]
pub(crate) struct Header {
    #[serde(default)]
    format: Value,
    #[serde(default)]
    version: Value,
}

/// Why the head of a file is not that of a format; each format has words of its own for it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum HeaderFault {
    /// More values than any file of ours needs bytes for.
    TooDense(String),
    /// Not JSON, or cut off.
    Damaged(String),
    /// JSON of another kind: what `format` holds.
    Format(String),
    /// Not `major.minor`: what `version` holds.
    Version(String),
    /// Another major version.
    Major(String),
}

/// Memory that values may take while they are read, whatever the length of a file.
const MEMORY_BYTES: usize = 48 << 20;
/// Memory beyond that, by the length of the file.
const MEMORY_FACTOR: usize = 10;
/// What a value of the unknown fields takes while it is read, about: it is kept twice, in lists that grow. Frequencies to
/// six decimals always pass.
const VALUE_BYTES: usize = 80;

/// The minor version of a file of this format and major version, which is one or lies above what is known.
pub(crate) fn minor_version(bytes: &[u8], format: &str, known_major: u32) -> Result<u32, HeaderFault> {
    check_density(bytes)?;
    header(bytes)?.minor_version(format, known_major)
}

impl Header {
    /// The header of something that is read already.
    pub(crate) fn of(format: &str, version: &str) -> Self {
        Self { format: format.into(), version: version.into() }
    }

    /// The minor version, where format and major version are these.
    pub(crate) fn minor_version(&self, format: &str, known_major: u32) -> Result<u32, HeaderFault> {
        if self.format != format {
            return Err(HeaderFault::Format(shown(&self.format)));
        }
        let (major, minor) =
            numbers(&self.version).ok_or_else(|| HeaderFault::Version(shown(&self.version)))?;
        if major == known_major { Ok(minor) } else { Err(HeaderFault::Major(format!("{major}.{minor}"))) }
    }
}

/// Refuses files of more values than anybody needs bytes for: a list of zeros takes fifty times its text.
fn check_density(bytes: &[u8]) -> Result<(), HeaderFault> {
    let n_values = bytes.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count();
    if n_values.saturating_mul(VALUE_BYTES) <= MEMORY_FACTOR.saturating_mul(bytes.len()) + MEMORY_BYTES {
        return Ok(());
    }
    Err(HeaderFault::TooDense(format!("{n_values} values in {} bytes are more than it needs", bytes.len())))
}

/// What kind of file it is. JSON that is no object is of another kind, whatever it holds.
fn header(bytes: &[u8]) -> Result<Header, HeaderFault> {
    if bytes.trim_ascii_start().first() == Some(&b'{') {
        return serde_json::from_slice(bytes).map_err(|error| HeaderFault::Damaged(error.to_string()));
    }
    match serde_json::from_slice::<IgnoredAny>(bytes) {
        Ok(_) => Err(HeaderFault::Format(shown(&Value::Null))),
        // A file of ours begins with a brace: what does not is no JSON of ours that was cut off.
        Err(_) => Err(HeaderFault::Format("missing".to_owned())),
    }
}

/// `major.minor` as numbers.
fn numbers(version: &Value) -> Option<(u32, u32)> {
    let (major, minor) = version.as_str()?.split_once('.')?;
    // Not a number is not a version: the caller says so.
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// A value for a message: short, whatever stood there.
fn shown(value: &Value) -> String {
    if value.is_null() {
        return "missing".to_owned();
    }
    let text = value.to_string();
    if text.chars().count() > 40 { text.chars().take(40).chain(['…']).collect() } else { text }
}

#[cfg(test)]
mod tests {
    use super::{HeaderFault, minor_version};

    #[test]
    fn a_file_says_what_it_is() {
        let of = |text: &str| minor_version(text.as_bytes(), "ours", 1);
        assert_eq!(of(r#"{"format": "ours", "version": "1.7", "more": []}"#), Ok(7));
        let fault = |text: &str| of(text).unwrap_err();
        assert_eq!(fault("[]"), HeaderFault::Format("missing".to_owned()));
        assert_eq!(fault("hello"), HeaderFault::Format("missing".to_owned()));
        assert_eq!(fault(r#"{"format": "other"}"#), HeaderFault::Format("\"other\"".to_owned()));
        assert_eq!(fault(r#"{"format": "ours"}"#), HeaderFault::Version("missing".to_owned()));
        assert_eq!(
            fault(r#"{"format": "ours", "version": "1.x"}"#),
            HeaderFault::Version("\"1.x\"".to_owned())
        );
        assert_eq!(fault(r#"{"format": "ours", "version": "2.0"}"#), HeaderFault::Major("2.0".to_owned()));
        assert!(matches!(fault("{\"format\""), HeaderFault::Damaged(_)));
        let zeros = format!("[{}0]", "0,".repeat(2_000_000));
        assert!(matches!(fault(&zeros), HeaderFault::TooDense(_)));
    }
}
