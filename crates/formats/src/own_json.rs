//! The header that all Shagreen JSON files share: a `format` name and a `version`.

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;

use crate::foreign_file::Found;
use crate::parser_words::plain;

/// The two fields that identify a Shagreen file.
#[derive(Deserialize)]
pub(crate) struct Header {
    #[serde(default)]
    format: Value,
    #[serde(default)]
    version: Value,
}

/// Why the header of a file does not match the expected format. Each format words its own error from this.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum HeaderFault {
    /// More values than a Shagreen file of this length has.
    TooDense(String),
    /// Not JSON, or truncated.
    Damaged(String),
    /// Another format.
    Format(Found),
    /// The version is not `major.minor`; holds the `version` field.
    Version(String),
    /// An unsupported major version; holds the version.
    Major(String),
}

/// Memory in bytes that parsed values may occupy, whatever the file length.
const MEMORY_BYTES: usize = 48 << 20;
/// Additional memory, in bytes per byte of the file.
const MEMORY_FACTOR: usize = 10;
/// Estimated memory in bytes of one value in an unknown field while parsing; each is held twice, in growing lists.
/// Files with frequencies written to six decimals always pass.
const VALUE_BYTES: usize = 80;

/// Returns the minor version of a file with this format and major version. The minor version may be newer than the
/// known ones.
pub(crate) fn minor_version(bytes: &[u8], format: &str, known_major: u32) -> Result<u32, HeaderFault> {
    check_density(bytes).map_err(HeaderFault::TooDense)?;
    header(bytes)?.minor_version(format, known_major)
}

impl Header {
    /// The header of a file that is already parsed.
    pub(crate) fn of(format: &str, version: &str) -> Self {
        Self { format: format.into(), version: version.into() }
    }

    /// Returns the minor version if format and major version match.
    pub(crate) fn minor_version(&self, format: &str, known_major: u32) -> Result<u32, HeaderFault> {
        if self.format != format {
            return Err(HeaderFault::Format(Found::Json(shown(&self.format))));
        }
        let (major, minor) =
            numbers(&self.version).ok_or_else(|| HeaderFault::Version(shown(&self.version)))?;
        if major == known_major { Ok(minor) } else { Err(HeaderFault::Major(format!("{major}.{minor}"))) }
    }
}

/// Rejects files with an excessive density of values: a list of zeros takes fifty times its file size in memory. The error is
/// the reason, as a clause.
pub(crate) fn check_density(bytes: &[u8]) -> Result<(), String> {
    let n_values = bytes.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count();
    if n_values.saturating_mul(VALUE_BYTES) <= MEMORY_FACTOR.saturating_mul(bytes.len()) + MEMORY_BYTES {
        return Ok(());
    }
    Err(format!("{n_values} values in {} bytes are more than it needs", bytes.len()))
}

/// Parses the header. JSON that is not an object counts as another format.
fn header(bytes: &[u8]) -> Result<Header, HeaderFault> {
    if bytes.trim_ascii_start().first() == Some(&b'{') {
        return serde_json::from_slice(bytes)
            .map_err(|error| HeaderFault::Damaged(plain(&error.to_string())));
    }
    match serde_json::from_slice::<IgnoredAny>(bytes) {
        Ok(_) => Err(HeaderFault::Format(Found::Json(shown(&Value::Null)))),
        // Every Shagreen file begins with a brace, so this is not a truncated Shagreen file.
        Err(_) => Err(HeaderFault::Format(Found::of(bytes))),
    }
}

/// Splits `major.minor` into numbers.
fn numbers(version: &Value) -> Option<(u32, u32)> {
    let (major, minor) = version.as_str()?.split_once('.')?;
    // A part that is not a number makes the version invalid; the caller reports it.
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// A JSON value for an error message, truncated to 40 characters.
fn shown(value: &Value) -> String {
    if value.is_null() {
        return "missing".to_owned();
    }
    let text = value.to_string();
    if text.chars().count() > 40 { text.chars().take(40).chain(['…']).collect() } else { text }
}

#[cfg(test)]
mod tests {
    use super::{Found, HeaderFault, minor_version};

    #[test]
    fn a_file_says_what_it_is() {
        let of = |text: &str| minor_version(text.as_bytes(), "ours", 1);
        assert_eq!(of(r#"{"format": "ours", "version": "1.7", "more": []}"#), Ok(7));
        let fault = |text: &str| of(text).unwrap_err();
        let json = |format: &str| HeaderFault::Format(Found::Json(format.to_owned()));
        assert_eq!(fault("[]"), json("missing"));
        assert_eq!(fault("hello"), HeaderFault::Format(Found::Unknown));
        assert_eq!(fault(""), HeaderFault::Format(Found::Empty));
        assert_eq!(fault(r#"{"format": "other"}"#), json("\"other\""));
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
