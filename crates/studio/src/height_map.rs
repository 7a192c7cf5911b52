//! Height maps of textures from photos and pictures of heights.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context as _, anyhow, bail};
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::height_picture::{HeightPicture, HeightScale, height_picture};
use shagreen_formats::library::Library;

use crate::file;
use crate::near_names::unknown_texture;
use crate::report::Reporter;

/// Reads a picture as a height map. What the heights rest on is a note.
///
/// # Errors
/// The file cannot be read, is no picture, or gives no valid height map.
pub fn of_picture(
    path: &Path,
    scale: HeightScale,
    options: HeightMapOptions,
    reporter: &dyn Reporter,
) -> anyhow::Result<HeightPicture> {
    let bytes = file::read_file(path, FileKind::Picture)?;
    let picture = height_picture(&bytes, scale, options).with_context(|| file::in_file(path))?;
    reporter.note(&assumption(&picture, scale));
    Ok(picture)
}

/// Returns how the heights of a picture were found, in one sentence.
pub fn assumption(picture: &HeightPicture, scale: HeightScale) -> String {
    // Whole nanometers: 50 µm in m and back are not exactly 50 µm.
    let height_um = (1e9 * scale.height_m).round() / 1e3;
    let source = if picture.is_colored {
        "the heights are assumed, not measured: the brightness of the photo"
    } else {
        "the gray value of the picture"
    };
    let edges = if picture.is_seamless {
        "its edges fit together"
    } else {
        "its edges do not fit together, so its slope was removed and its borders were faded into each other"
    };
    format!("{source} is the height, from 0 µm (black) to {height_um} µm (white); {edges}")
}

/// Gives a texture of a library this height map. A height map that is replaced is a warning.
///
/// # Errors
/// The library has no such texture, or it is a texture path.
pub fn add_to_texture(
    library: &mut Library,
    id: &str,
    map: HeightMap,
    reporter: &dyn Reporter,
) -> anyhow::Result<()> {
    let index = library.index_of(id).ok_or_else(|| anyhow!(unknown_texture(library, id)))?;
    let entry = &mut library.textures[index];
    if entry.path.is_some() {
        bail!(
            "\"{id}\" is a texture path, which cannot have a height map; add it to the textures that the path is made from, then make the path again"
        );
    }
    if entry.model.height_map().is_some() {
        reporter.warn(&format!("\"{id}\" already has a height map, which is replaced"));
    }
    entry.model = entry.model.clone().with_height_map(Some(Arc::new(map)));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{HeightMap, HeightMapOptions, HeightPicture, HeightScale, add_to_texture, assumption};
    use crate::report::Warnings;
    use shagreen_formats::starter::starter_library;

    fn flat() -> HeightMap {
        HeightMap::new(vec![0.0; 256], 0.04, HeightMapOptions::HARD_PLASTIC).unwrap()
    }

    #[test]
    fn the_heights_of_a_photo_are_said_to_be_assumed() {
        let scale = HeightScale { side_m: 0.04, height_m: 5e-5 };
        let photo = HeightPicture { map: flat(), is_seamless: false, is_colored: true };
        let said = assumption(&photo, scale);
        assert!(said.contains("assumed, not measured") && said.contains("50 µm (white)"), "{said}");
        assert!(said.contains("faded into each other"), "{said}");
        let heights = HeightPicture { map: flat(), is_seamless: true, is_colored: false };
        let said = assumption(&heights, scale);
        assert!(!said.contains("assumed") && said.contains("fit together"), "{said}");
    }

    #[test]
    fn a_texture_gets_a_height_map_and_a_replaced_one_is_reported() {
        let mut library = starter_library().unwrap();
        let warnings = Warnings::default();
        let before = library.textures[library.index_of("cork").unwrap()].model.height_map().is_some();
        add_to_texture(&mut library, "cork", flat(), &warnings).unwrap();
        add_to_texture(&mut library, "cork", flat().scaled(2.0), &warnings).unwrap();
        let model = &library.textures[library.index_of("cork").unwrap()].model;
        assert_eq!(model.height_map().map(|map| map.n()), Some(16));
        let warnings = warnings.into_vec();
        assert_eq!(warnings.len(), 1 + usize::from(before), "{warnings:?}");
        let error = add_to_texture(&mut library, "crok", flat(), &Warnings::default());
        assert!(error.unwrap_err().to_string().contains("did you mean cork?"));
    }
}
