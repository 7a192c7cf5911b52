//! Libraries of this program.

use shagreen_formats::imported::Imported;
use shagreen_formats::library::{TextureEntry, read_library};

use super::ImportFormat;

pub(super) struct Library;

impl ImportFormat for Library {
    fn id(&self) -> &'static str {
        "library"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["json"]
    }

    fn read(&self, _: &str, bytes: &[u8]) -> Result<Imported<Vec<TextureEntry>>, String> {
        let Imported { value: library, warnings } = read_library(bytes).map_err(|error| error.to_string())?;
        let mut textures = library.textures.clone();
        for texture in &mut textures {
            // Terms and origin of the library hold for a texture that states none.
            texture.license = library.license_of(texture).to_owned();
            if texture.origin.is_empty() {
                texture.origin.clone_from(&library.origin);
            }
        }
        Ok(Imported { value: textures, warnings })
    }
}
