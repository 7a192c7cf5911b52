//! Runtime tables (`.shgt`): textures for programs that render them without Shagreen.
//!
//! The format is defined in `shagreen_synth::runtime_table`.

use shagreen_core::texture::plane::{About, Plane, TABLE_MAGIC, TableError, table_about};

use crate::library::{Provenance, TextureEntry};
use crate::texture_parts::{Part, lost_description, lost_parts};

/// What every table lacks.
const MODEL: &str =
    "the editable model: the table holds what a renderer needs, and Shagreen cannot read it again";

/// Why a texture cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("texture \"{id}\" cannot be a runtime table: {}", .reason.text())]
pub struct RuntimeTableError {
    /// Identifier of the texture.
    pub id: String,
    /// The violated rule.
    pub reason: TableError,
}

/// Serializes a texture. For a texture that changes along a stroke, it is the one at the start. `created_by` is the program with
/// its version.
///
/// # Errors
/// See [`RuntimeTableError`].
pub fn write_runtime_table(entry: &TextureEntry, created_by: &str) -> Result<Vec<u8>, RuntimeTableError> {
    // Programs in C end a text by a NUL.
    let texts = [&entry.name, &entry.license, &entry.origin].map(|text| text.replace('\0', " "));
    let [name, terms, origin] = texts.each_ref();
    let is_restricted = entry.provenance == Provenance::Restricted;
    let about = About { name, terms, origin, created_by, is_restricted };
    let table = Plane::new(&entry.model).prepare().to_table(entry.model.tap(), about);
    table.map_err(|reason| RuntimeTableError { id: entry.id.clone(), reason })
}

/// Lists the properties of a texture that a runtime table cannot hold.
pub fn lost_in_runtime_table(entry: &TextureEntry) -> Vec<String> {
    let kept = [
        Part::Tap,
        Part::Direction,
        Part::Relief,
        Part::HeightMap,
        Part::Turn,
        Part::StickSlip,
        // The license and the origin are kept, and the others are named below.
        Part::Terms,
    ];
    let mut lost = vec![MODEL.to_owned()];
    lost.extend(lost_parts(entry, &kept));
    lost.extend(lost_description(entry));
    lost
}

/// Whether bytes begin like a runtime table.
pub fn is_runtime_table(bytes: &[u8]) -> bool {
    bytes.starts_with(&TABLE_MAGIC)
}

/// Whether bytes are the runtime table of a texture that must not be redistributed.
pub fn is_restricted_table(bytes: &[u8]) -> bool {
    table_about(bytes).is_some_and(|about| about.is_restricted)
}

#[cfg(test)]
mod tests {
    use super::{is_restricted_table, is_runtime_table, lost_in_runtime_table, write_runtime_table};
    use crate::library::{Provenance, TextureEntry};
    use crate::starter::starter_library;

    #[test]
    fn terms_and_provenance_are_in_the_table() {
        let library = starter_library().unwrap();
        let mut entry = library.with_terms(&library.textures[0]);
        let free = write_runtime_table(&entry, "test 1").unwrap();
        assert!(is_runtime_table(&free) && !is_runtime_table(b"my notes"));
        let holds = |text: &str| free.windows(text.len()).any(|window| window == text.as_bytes());
        assert!(
            [&entry.name, &entry.license, &entry.origin].iter().all(|text| !text.is_empty() && holds(text))
        );
        assert!(holds("test 1"));
        // One flag, and the checksum.
        entry.provenance = Provenance::Restricted;
        let restricted = write_runtime_table(&entry, "test 1").unwrap();
        let end = free.len() - 4;
        let differs = free[..end].iter().zip(&restricted[..end]).filter(|(a, b)| a != b).count();
        assert_eq!((differs, free.len()), (1, restricted.len()));
        assert!(is_restricted_table(&restricted) && !is_restricted_table(&free) && !is_restricted_table(b""));
        // A name with a NUL is written with a space.
        "a\0b".clone_into(&mut entry.name);
        assert!(write_runtime_table(&entry, "test 1").is_ok());
    }

    #[test]
    fn every_table_lacks_the_model_and_what_is_no_vibration() {
        let starter = starter_library().unwrap().textures.swap_remove(0);
        let lost = lost_in_runtime_table(&starter);
        for part in ["the editable model", "the position", "the picture", "tags and description"] {
            assert!(lost.iter().any(|text| text.contains(part)), "{part} in {lost:?}");
        }
        assert!(!lost.iter().any(|text| text.contains("tap") || text.contains("license")), "{lost:?}");
        let bare = TextureEntry::new("a", "A", starter.model.clone());
        assert_eq!(lost_in_runtime_table(&bare).len(), 1);
    }
}
