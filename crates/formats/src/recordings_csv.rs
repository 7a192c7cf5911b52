//! Recordings of textures as a table: one row for each file.
//!
//! ```csv
//! texture,recording
//! cork,cork-1.csv
//! cork,cork-2.csv
//! felt,more/felt.wav
//! ```
//!
//! `texture` is the identifier of a texture in a library, `recording` the path of a file. Other columns are not used.

use std::collections::HashMap;

use crate::named_table::{NamedTable, NamedTableError};

/// A recording of strokes on a texture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureRecording {
    /// Identifier of the texture.
    pub texture: String,
    /// Path of the file as the table states it.
    pub recording: String,
    /// Line in the table, from one.
    pub line: u64,
}

/// Why a table names no recordings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingsCsvError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A recording is listed twice. A network that was trained on it would know the texture that it is tested on.
    #[error(
        "the recording \"{recording}\" is in line {first} and again in line {line}; remove one of the two lines"
    )]
    Twice {
        /// Path of the file.
        recording: String,
        /// The first line, from one.
        first: u64,
        /// The second line, from one.
        line: u64,
    },
}

/// Reads a table of recordings.
///
/// # Errors
/// See [`RecordingsCsvError`].
pub fn read_recordings_csv(bytes: &[u8]) -> Result<Vec<TextureRecording>, RecordingsCsvError> {
    let table = NamedTable::read(bytes, "texture, recording", "recording")?;
    let texture_column = table.need(&["texture", "texture_id", "id"])?;
    let recording_column = table.need(&["recording", "file"])?;
    let mut recordings = Vec::new();
    let mut lines: HashMap<&str, u64> = HashMap::new();
    for row in table.rows() {
        let (texture, recording) = (row.at(texture_column).word()?, row.at(recording_column).word()?);
        let line = row.line();
        if let Some(first) = lines.insert(recording, line) {
            return Err(RecordingsCsvError::Twice { recording: recording.to_owned(), first, line });
        }
        recordings.push(TextureRecording {
            texture: texture.to_owned(),
            recording: recording.to_owned(),
            line,
        });
    }
    Ok(recordings)
}

#[cfg(test)]
mod tests {
    use super::{RecordingsCsvError, TextureRecording, read_recordings_csv};

    #[test]
    fn each_row_is_a_recording() {
        let expected = |texture: &str, recording: &str, line: u64| TextureRecording {
            texture: texture.to_owned(),
            recording: recording.to_owned(),
            line,
        };
        for table in [
            "texture,recording\ncork,cork 1.csv\n\nfelt,more/felt.wav\n",
            "Texture ID;File;Note\ncork;cork 1.csv;slow\n\nfelt;more/felt.wav;\n",
        ] {
            assert_eq!(
                read_recordings_csv(table.as_bytes()).unwrap(),
                [expected("cork", "cork 1.csv", 2), expected("felt", "more/felt.wav", 4)]
            );
        }
    }

    #[test]
    fn what_names_no_recordings_is_refused_with_its_line() {
        let check = |table: &str, words: &str| {
            let message = read_recordings_csv(table.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        check("", "no rows");
        check("texture,rating\ncork,4\n", "\"recording\" or \"file\"");
        check("texture,recording\ncork,\n", "line 2 has no recording");
        check("texture,recording\n,a.csv\n", "line 2 has no texture");
        let twice = read_recordings_csv(b"texture,recording\ncork,a.csv\nfelt,a.csv\n").unwrap_err();
        assert_eq!(twice, RecordingsCsvError::Twice { recording: "a.csv".to_owned(), first: 2, line: 3 });
    }
}
