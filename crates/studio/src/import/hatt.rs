//! The XML of the Penn Haptic Texture Toolkit.

use shagreen_formats::hatt::read_hatt;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{TextureEntry, id_from_name, name_from_file};

use super::ImportFormat;

pub(super) struct Hatt;

impl ImportFormat for Hatt {
    fn id(&self) -> &'static str {
        "hatt"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["xml"]
    }

    fn read(&self, file_name: &str, bytes: &[u8]) -> Result<Imported<Vec<TextureEntry>>, String> {
        let Imported { value: texture, warnings } = read_hatt(bytes).map_err(|error| error.to_string())?;
        let mut entry = texture.into_entry(String::new());
        if entry.name.is_empty() {
            entry.name = name_from_file(file_name);
        }
        entry.id = id_from_name(&entry.name);
        Ok(Imported { value: vec![entry], warnings })
    }
}
