//! Import of texture models from other programs and libraries: one table for the command line and the window.
//!
//! Recordings are no models yet: they ask questions and are fitted, so they have a way of their own
//! (`shagreen_formats::recording`). A new format of models is a file below `import/` and a line in [`FORMATS`].

pub mod directional;
mod hatt;
mod library;

use shagreen_formats::imported::Imported;
use shagreen_formats::library::TextureEntry;

/// A file format that contains texture models.
pub trait ImportFormat: Sync {
    /// The word for scripts.
    fn id(&self) -> &'static str;

    /// Endings of its files in lower case, without the dot.
    fn endings(&self) -> &'static [&'static str];

    /// The textures of a file with warnings. `file_name` names a texture that has no name of its own.
    ///
    /// # Errors
    /// The bytes are damaged or of another format, in one sentence.
    fn read(&self, file_name: &str, bytes: &[u8]) -> Result<Imported<Vec<TextureEntry>>, String>;
}

/// The XML of the Penn Haptic Texture Toolkit.
pub const HATT: &dyn ImportFormat = &hatt::Hatt;

/// All formats of texture models.
pub static FORMATS: [&dyn ImportFormat; 2] = [&library::Library, HATT];

/// Endings of recordings: WAV files, tables and haptic clips, which become signals.
pub const RECORDING_ENDINGS: [&str; 6] = ["wav", "csv", "tsv", "txt", "haptic", "ahap"];

/// Ending of a file that maps the columns of recordings.
pub const MAP_ENDING: &str = "toml";

/// The format of texture models that a file's ending stands for.
pub fn format_of_ending(ending: &str) -> Option<&'static dyn ImportFormat> {
    FORMATS.into_iter().find(|format| format.endings().contains(&ending))
}

/// Whether a file with this ending in lower case can be imported.
pub fn is_importable(ending: &str) -> bool {
    format_of_ending(ending).is_some() || RECORDING_ENDINGS.contains(&ending) || ending == MAP_ENDING
}

#[cfg(test)]
mod tests {
    use super::{FORMATS, format_of_ending, is_importable};
    use shagreen_formats::clip::CLIP_ENDINGS;
    use shagreen_formats::hatt::write_hatt;
    use shagreen_formats::starter::{starter_bytes, starter_library};

    #[test]
    fn a_file_is_read_by_its_ending() {
        for format in FORMATS {
            for ending in format.endings() {
                assert!(format_of_ending(ending).is_some_and(|found| found.id() == format.id()));
            }
            assert!(format.read("notes", b"my notes").is_err());
        }
        let library = starter_library().unwrap();
        let read = |ending: &str, bytes: &[u8]| {
            format_of_ending(ending).unwrap().read("cork.xml", bytes).unwrap().value
        };
        let textures = read("json", starter_bytes());
        assert_eq!(textures.len(), 25);
        assert!(textures.iter().all(|texture| !texture.license.is_empty() && !texture.origin.is_empty()));
        let cork = &read("xml", &write_hatt(&library.textures[0], "test").unwrap())[0];
        assert!(!cork.id.is_empty() && !cork.name.is_empty());
        assert!(is_importable("wav") && is_importable("toml") && !is_importable("png"));
        assert!(CLIP_ENDINGS.into_iter().all(is_importable));
    }
}
