//! The library that is built into the program.

use crate::library::{Library, LibraryError, read_library};

const BYTES: &[u8] = include_bytes!("../../../assets/starter/starter.json");

/// The starter library: simulated everyday surfaces, placed by physical labels.
///
/// # Errors
/// None, as long as the committed file is sound, which a test holds; reading it costs some milliseconds.
pub fn starter_library() -> Result<Library, LibraryError> {
    read_library(BYTES).map(|imported| imported.value)
}

/// The file of the starter library, as it was written.
pub fn starter_bytes() -> &'static [u8] {
    BYTES
}

#[cfg(test)]
mod tests {
    use super::{BYTES, starter_library};
    use crate::library::{read_library, write_library};
    use crate::picture::decode;
    use shagreen_core::space::LabelSource;

    #[test]
    fn the_committed_file_is_sound() {
        let imported = read_library(BYTES).unwrap();
        assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
        let library = starter_library().unwrap();
        assert_eq!(library.label_source(), Some(LabelSource::PhysicalLabels));
        assert!(library.textures.iter().all(|t| t.place.is_some() && t.physical.is_some()));
        for texture in &library.textures {
            decode(texture.picture.as_ref().unwrap()).unwrap();
        }
    }

    #[test]
    fn the_committed_file_is_what_is_written() {
        assert_eq!(write_library(&starter_library().unwrap()), BYTES);
    }
}
