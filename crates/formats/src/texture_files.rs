//! Files that belong to textures as a table: one row for each file.
//!
//! ```csv
//! texture,picture
//! cork,cork-1.jpg
//! cork,cork-2.tif
//! felt,more/felt.png
//! ```
//!
//! `texture` is the identifier of a texture in a library. The other column has the name of what the files are, or `file`.
//! Further columns are not used.

use std::collections::HashMap;

use crate::named_table::{NamedTable, NamedTableError};

/// What the files of a table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFileKind {
    /// Pictures of the surface.
    Picture,
    /// Recordings of strokes.
    Recording,
}

impl TextureFileKind {
    /// Name of the column of the files, if it is not `file`.
    fn column(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Recording => "recording",
        }
    }

    /// Columns that an empty table needs.
    fn wanted(self) -> &'static str {
        match self {
            Self::Picture => "texture, file",
            Self::Recording => "texture, recording",
        }
    }
}

/// A file of a texture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureFile {
    /// Identifier of the texture.
    pub texture: String,
    /// Path of the file as the table states it.
    pub file: String,
    /// Line in the table, from one.
    pub line: u64,
}

/// Why a table names no files of textures.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureFilesError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A file is listed twice. A predictor that was trained on it would know the texture that it is tested on.
    #[error("the {what} \"{file}\" is in line {first} and again in line {line}; remove one of the two lines")]
    Twice {
        /// What the file is.
        what: &'static str,
        /// Path of the file.
        file: String,
        /// The first line, from one.
        first: u64,
        /// The second line, from one.
        line: u64,
    },
}

/// Reads a table of files.
///
/// # Errors
/// See [`TextureFilesError`].
pub fn read_texture_files(
    bytes: &[u8],
    kind: TextureFileKind,
) -> Result<Vec<TextureFile>, TextureFilesError> {
    let what = kind.column();
    let table = NamedTable::read(bytes, kind.wanted(), what)?;
    let texture_column = table.need(&["texture", "texture_id", "id"])?;
    let file_column = table.need(&[what, "file"])?;
    let mut files = Vec::new();
    let mut lines: HashMap<&str, u64> = HashMap::new();
    for row in table.rows() {
        let (texture, file) = (row.at(texture_column).word()?, row.at(file_column).word()?);
        let line = row.line();
        if let Some(first) = lines.insert(file, line) {
            return Err(TextureFilesError::Twice { what, file: file.to_owned(), first, line });
        }
        files.push(TextureFile { texture: texture.to_owned(), file: file.to_owned(), line });
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::{TextureFile, TextureFileKind, TextureFilesError, read_texture_files};

    fn expected(texture: &str, file: &str, line: u64) -> TextureFile {
        TextureFile { texture: texture.to_owned(), file: file.to_owned(), line }
    }

    #[test]
    fn each_row_is_a_recording() {
        for table in [
            "texture,recording\ncork,cork 1.csv\n\nfelt,more/felt.wav\n",
            "Texture ID;File;Note\ncork;cork 1.csv;slow\n\nfelt;more/felt.wav;\n",
        ] {
            assert_eq!(
                read_texture_files(table.as_bytes(), TextureFileKind::Recording).unwrap(),
                [expected("cork", "cork 1.csv", 2), expected("felt", "more/felt.wav", 4)]
            );
        }
    }

    #[test]
    fn what_names_no_recordings_is_refused_with_its_line() {
        let read = |table: &str| read_texture_files(table.as_bytes(), TextureFileKind::Recording);
        let check = |table: &str, words: &str| {
            let message = read(table).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        check("", "no rows");
        check("texture,rating\ncork,4\n", "\"recording\" or \"file\"");
        check("texture,recording\ncork,\n", "line 2 has no recording");
        check("texture,recording\n,a.csv\n", "line 2 has no texture");
        let twice = read("texture,recording\ncork,a.csv\nfelt,a.csv\n").unwrap_err();
        let file = "a.csv".to_owned();
        assert_eq!(twice, TextureFilesError::Twice { what: "recording", file, first: 2, line: 3 });
    }

    #[test]
    fn each_row_is_a_file() {
        for head in ["texture,picture", "id,file,note", "Texture ID,Picture"] {
            let more = if head.contains("note") { ",mine" } else { "" };
            let text = format!("{head}\ncork,a.jpg{more}\n\ncork,\"b, c.tif\"{more}\nfelt,sub/d.png{more}\n");
            let read = read_texture_files(text.as_bytes(), TextureFileKind::Picture).unwrap();
            let files = [
                expected("cork", "a.jpg", 2),
                expected("cork", "b, c.tif", 4),
                expected("felt", "sub/d.png", 5),
            ];
            assert_eq!(read, files, "{head}");
        }
    }

    #[test]
    fn what_cannot_be_used_says_where() {
        let check = |text: &str, words: &str| {
            let message =
                read_texture_files(text.as_bytes(), TextureFileKind::Picture).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        check("", "one row per picture");
        check("texture,path\ncork,a.jpg\n", "\"picture\" or \"file\"");
        check("texture,file\ncork,\n", "line 2 has no file");
        check("texture,file\n,a.jpg\n", "line 2 has no texture");
        let twice = "texture,file\ncork,a.jpg\nfelt,a.jpg\n";
        check(twice, "the picture \"a.jpg\" is in line 2 and again in line 3");
    }
}
