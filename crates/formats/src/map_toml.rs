//! The columns of a recording, said in a TOML file.

use crate::recording::ColumnMap;

/// Why bytes are no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// Not UTF-8.
    #[error("the map is not UTF-8 text from byte {at} on; save the file as UTF-8")]
    NotText {
        /// The first byte that is not.
        at: usize,
    },
    /// Not TOML, or a key is unknown or its value has no meaning.
    #[error("the map cannot be read: {reason}; correct the file")]
    Damaged {
        /// What is wrong, with the line, on one line.
        reason: String,
    },
}

/// Reads a map.
///
/// # Errors
/// See [`MapError`].
pub fn read_map(_bytes: &[u8]) -> Result<ColumnMap, MapError> {
    Ok(ColumnMap::default())
}
