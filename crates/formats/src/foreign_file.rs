//! What a file is that is not of the expected format.

/// Content of such a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Found {
    /// JSON with this value of the field `format`, or "missing".
    Json(String),
    /// A file without bytes.
    Empty,
    /// A widespread format, as a noun with its article: "a PNG picture".
    Kind(&'static str),
    /// Unknown bytes.
    Unknown,
}

/// First bytes of widespread formats.
const BEGINNINGS: [(&[u8], &str); 12] = [
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"fLaC", "a FLAC recording"),
    (b"OggS", "an Ogg recording"),
    (b"ID3", "an MP3 recording"),
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a ZIP archive or an office document"),
    (b"\x1f\x8b", "a compressed archive"),
    (b"\x7fELF", "a program"),
    (b"<svg", "an SVG figure"),
    (b"<", "an XML or HTML file"),
];

impl Found {
    /// Returns what bytes are that are not JSON.
    pub fn of(bytes: &[u8]) -> Self {
        if bytes.is_empty() {
            return Self::Empty;
        }
        if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE") {
            return Self::Kind("a WAV file");
        }
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let begins = |beginning: &[u8]| bytes.starts_with(beginning) || text.starts_with(beginning);
        let known = BEGINNINGS.iter().find(|(beginning, _)| begins(beginning));
        known.map_or(Self::Unknown, |&(_, kind)| Self::Kind(kind))
    }

    /// Returns the sentence of an error: the file is not `wanted`, whose field `format` would be `format`.
    pub fn instead_of(&self, wanted: &str, format: &str) -> String {
        match self {
            Self::Json(found) => {
                format!("this is not {wanted}: `format` is {found}, not \"{format}\"; choose another file")
            }
            Self::Empty => "the file is empty; choose another file, or restore it from a copy".to_owned(),
            Self::Kind(kind) => format!("this is {kind}, not {wanted}; choose another file"),
            Self::Unknown => format!("this is not {wanted}; choose another file"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Found;

    #[test]
    fn widespread_formats_are_known_by_their_first_bytes() {
        for (bytes, expected) in [
            (&b""[..], "the file is empty"),
            (b"\x89PNG\r\n\x1a\n", "this is a PNG picture, not a project;"),
            (b"\xff\xd8\xff\xe0", "this is a JPEG picture, not a project;"),
            (b"RIFF\0\0\0\0WAVEfmt ", "this is a WAV file, not a project;"),
            (b"\xef\xbb\xbf <?xml version=\"1.0\"?>", "this is an XML or HTML file, not a project;"),
            (b"<svg>", "this is an SVG figure, not a project;"),
            (b"hello", "this is not a project; choose"),
        ] {
            let text = Found::of(bytes).instead_of("a project", "shagreen-project");
            assert!(text.starts_with(expected), "{text}");
        }
        let other = Found::Json("\"other\"".to_owned()).instead_of("a project", "ours");
        assert_eq!(other, "this is not a project: `format` is \"other\", not \"ours\"; choose another file");
    }
}
