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
const BEGINNINGS: [(&[u8], &str); 16] = [
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"II*\0", "a TIFF picture"),
    (b"MM\0*", "a TIFF picture"),
    (b"II+\0", "a TIFF picture"),
    (b"MM\0+", "a TIFF picture"),
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
        if let Some(picture) = picture_of(bytes) {
            return Self::Kind(picture);
        }
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let begins = |beginning: &[u8]| bytes.starts_with(beginning) || text.starts_with(beginning);
        let known = BEGINNINGS.iter().find(|(beginning, _)| begins(beginning));
        known.map_or(Self::Unknown, |&(_, kind)| Self::Kind(kind))
    }

    /// Returns whether the file is a picture.
    pub fn is_picture(&self) -> bool {
        matches!(self, Self::Kind(kind) if kind.ends_with(" picture"))
    }

    /// Returns the sentence of an error: the file is not a photo of a format that is read.
    pub fn instead_of_photo(&self) -> String {
        match self {
            Self::Kind(kind) => {
                format!(
                    "this is {kind}, but only JPEG, PNG, WebP, BMP and TIFF are read; save it as JPEG or PNG"
                )
            }
            Self::Empty => "the file is empty; restore it from a copy, as JPEG or PNG".to_owned(),
            Self::Json(_) | Self::Unknown => {
                "this is not a picture that can be read; save it as JPEG or PNG".to_owned()
            }
        }
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

/// Returns the kind of a picture whose format more than its first bytes identify.
fn picture_of(bytes: &[u8]) -> Option<&'static str> {
    let at = |range: std::ops::Range<usize>| bytes.get(range).unwrap_or_default();
    if at(0..4) == b"RIFF" && at(8..12) == b"WEBP" {
        return Some("a WebP picture");
    }
    // The brand of an ISO media file.
    if at(4..8) == b"ftyp" {
        return match at(8..12) {
            b"heic" | b"heix" | b"hevc" | b"hevx" | b"heim" | b"heis" => Some("a HEIC picture"),
            // The brand of the container, which does not name the codec.
            b"mif1" | b"msf1" => Some("a HEIF picture"),
            b"avif" | b"avis" => Some("an AVIF picture"),
            _ => None,
        };
    }
    // After the letters come the size of the file and four zeros.
    if at(0..2) == b"BM" && at(6..10) == [0; 4] {
        return Some("a BMP picture");
    }
    match at(0..3) {
        [b'P', b'1' | b'4', after] if after.is_ascii_whitespace() => Some("a PBM picture"),
        [b'P', b'2' | b'5', after] if after.is_ascii_whitespace() => Some("a PGM picture"),
        [b'P', b'3' | b'6', after] if after.is_ascii_whitespace() => Some("a PPM picture"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Found;

    #[test]
    fn a_picture_of_another_format_is_named() {
        for (bytes, name) in [
            (&b"P6\n2 2\n255\n"[..], "a PPM picture"),
            (b"P3 2 2 255", "a PPM picture"),
            (b"P5\n# made", "a PGM picture"),
            (b"P4\n8 8\n", "a PBM picture"),
            (b"GIF89a", "a GIF picture"),
            (b"\0\0\0\x18ftypheic\0\0\0\0", "a HEIC picture"),
            (b"\0\0\0\x18ftypmif1\0\0\0\0", "a HEIF picture"),
            (b"\0\0\0\x18ftypavif\0\0\0\0", "an AVIF picture"),
        ] {
            let text = Found::of(bytes).instead_of_photo();
            assert!(Found::of(bytes).is_picture());
            let expected =
                format!("this is {name}, but only JPEG, PNG, WebP, BMP and TIFF are read; save it");
            assert!(text.starts_with(&expected), "{text}");
        }
        // Texts that begin with the same letters, and films.
        for bytes in [&b"P60,1\n"[..], b"BM,speed,force", b"P", b"\0\0\0\x18ftypisom", b"no picture"] {
            assert_eq!(Found::of(bytes), Found::Unknown);
            assert!(Found::of(bytes).instead_of_photo().contains("JPEG or PNG"));
        }
        assert!(Found::Empty.instead_of_photo().contains("empty"));
    }

    #[test]
    fn widespread_formats_are_known_by_their_first_bytes() {
        for (bytes, expected) in [
            (&b""[..], "the file is empty"),
            (b"\x89PNG\r\n\x1a\n", "this is a PNG picture, not a project;"),
            (b"\xff\xd8\xff\xe0", "this is a JPEG picture, not a project;"),
            (b"RIFF\0\0\0\0WEBPVP8 ", "this is a WebP picture, not a project;"),
            (b"II*\0\x08\0\0\0", "this is a TIFF picture, not a project;"),
            (b"MM\0*\0\0\0\x08", "this is a TIFF picture, not a project;"),
            (b"II+\0\x08\0\0\0", "this is a TIFF picture, not a project;"),
            (b"BM\x36\0\0\0\0\0\0\0\x36", "this is a BMP picture, not a project;"),
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
