//! Textures that every format can represent.

use std::sync::Arc;

use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_formats::library::Library;
use shagreen_formats::starter::starter_library;

/// The starter library, in which each texture has a small height map.
pub(super) fn library_with_heights() -> Library {
    let mut library = starter_library().unwrap();
    let heights_m = (0..256).map(|index| 1e-6 * f64::from(index / 16 % 3)).collect();
    let map = Arc::new(HeightMap::new(heights_m, 0.008, HeightMapOptions::HARD_PLASTIC).unwrap());
    for texture in &mut library.textures {
        texture.model = texture.model.clone().with_height_map(Some(Arc::clone(&map)));
    }
    library
}
