//! Paths in JSON. A path that is UTF-8 is a string; any other is `{"unix_bytes": "base64"}`, so that it comes back
//! unchanged.

use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize as _, Deserializer, Serialize as _, Serializer};
use serde_json::{Value, json};

const BYTES: &str = "unix_bytes";

/// JSON of a path.
pub(crate) fn to_json(path: &Path) -> Value {
    path.to_str()
        .map_or_else(|| json!({BYTES: STANDARD.encode(path.as_os_str().as_encoded_bytes())}), Value::from)
}

/// Path in JSON; `None` if it is none, or one of another system.
pub(crate) fn from_json(value: &Value) -> Option<PathBuf> {
    if let Some(text) = value.as_str() {
        return Some(PathBuf::from(text));
    }
    let bytes = STANDARD.decode(value.get(BYTES)?.as_str()?).ok()?;
    #[cfg(unix)]
    return Some(PathBuf::from(std::os::unix::ffi::OsStrExt::from_bytes(&bytes) as &std::ffi::OsStr));
    #[cfg(not(unix))]
    return String::from_utf8(bytes).ok().map(PathBuf::from);
}

/// Serializes a path for a struct field.
pub(crate) fn serialize<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    to_json(path).serialize(serializer)
}

/// Deserializes a path of a struct field.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PathBuf, D::Error> {
    let value = Value::deserialize(deserializer)?;
    from_json(&value).ok_or_else(|| serde::de::Error::custom("it is not a path of this system"))
}

/// Serializes paths for a struct field.
pub(crate) fn serialize_all<S: Serializer>(paths: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(paths.iter().map(|path| to_json(path)))
}

/// Serializes an optional path for a struct field.
#[expect(clippy::ref_option, reason = "serde calls it with a reference to the field")]
pub(crate) fn serialize_option<S: Serializer>(
    path: &Option<PathBuf>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match path {
        Some(path) => serializer.serialize_some(&to_json(path)),
        None => serializer.serialize_none(),
    }
}

#[cfg(test)]
mod tests {
    use super::{from_json, to_json};
    use std::path::Path;

    #[test]
    fn every_path_comes_back() {
        assert_eq!(to_json(Path::new("/a/ä")), "/a/ä");
        assert_eq!(from_json(&to_json(Path::new("/a/ä"))).unwrap(), Path::new("/a/ä"));
        assert_eq!(from_json(&3.into()), None);
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt as _;
            let path = Path::new(std::ffi::OsStr::from_bytes(b"/a/\xff/b"));
            assert_eq!(from_json(&to_json(path)).unwrap(), path);
        }
    }
}
