//! Height and friction maps with a glTF scene.
//!
//! The heights are those of the height map of a texture. A texture of the starter library has none, but was simulated from a
//! surface, whose heights are computed again.

use std::sync::LazyLock;

use anyhow::Context as _;
use shagreen_core::surfaces::height_field::{STARTER_TILE, synthesize};
use shagreen_core::surfaces::material::Material;
use shagreen_core::texture::height_map::HeightMap;
use shagreen_formats::haptic_maps::{
    HeightSource, Maps, SCENE, SUFFIXES, check_gltf, lost_in_maps, map_files,
};
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::starter::{starter_anchors, starter_library};

use super::signal_format::FilePart;
use super::{ExportContext, ExportFormat};

/// Name of the scene in bytes without files beside them.
const ALONE: &str = "texture";

/// The starter library with the material of each texture; `None` if an embedded file is damaged, which a test excludes.
static STARTER: LazyLock<Option<(Library, Vec<Material>)>> = LazyLock::new(|| {
    let (anchors, _) = starter_anchors().ok()?; // Only a damaged embedded file fails, as below.
    let library = starter_library().ok()?; // The same.
    Some((library, anchors.into_iter().map(|anchor| anchor.material).collect()))
});

pub(super) struct HapticMaps;

impl ExportFormat for HapticMaps {
    fn id(&self) -> &'static str {
        "maps"
    }

    fn name(&self) -> &'static str {
        "Height and friction maps (glTF)"
    }

    fn ending(&self) -> &'static str {
        SCENE
    }

    fn help(&self) -> &'static str {
        "Pictures of heights and friction with a glTF scene, for scene tools and height-field renderers"
    }

    fn lost(&self, texture: &TextureEntry) -> Vec<String> {
        lost_in_maps(texture)
    }

    fn suffixes(&self) -> &'static [&'static str] {
        &SUFFIXES
    }

    fn refusal(&self, texture: &TextureEntry) -> Option<String> {
        let has_heights = texture.model.height_map().is_some() || starter_material(texture).is_some();
        (!has_heights).then(|| {
            "the texture has no height map; give it a relief from a picture, or choose another texture or format"
                .to_owned()
        })
    }

    fn bytes(&self, texture: &TextureEntry, created_by: &str) -> anyhow::Result<Vec<u8>> {
        let files = self.files(texture, ALONE, &ExportContext::new(created_by))?;
        files.into_iter().next().map(|part| part.bytes).context("there is no scene")
    }

    fn files(
        &self,
        texture: &TextureEntry,
        stem: &str,
        context: &ExportContext<'_>,
    ) -> anyhow::Result<Vec<FilePart>> {
        let files = map_files(&maps(texture)?, stem, context.created_by)?;
        Ok(files.into_iter().map(|(suffix, bytes)| FilePart { suffix, bytes }).collect())
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        check_gltf(bytes).is_ok_and(|scene| scene.n_haptic_materials > 0)
    }
}

/// Maps of a texture.
///
/// # Errors
/// It has no heights.
fn maps(texture: &TextureEntry) -> anyhow::Result<Maps> {
    let (heights_m, side_m, source) = if let Some(map) = texture.model.height_map() {
        (rows_from_the_top(map), map.side_m(), HeightSource::HeightMap(map.options()))
    } else {
        let material = starter_material(texture);
        let (material, seed) =
            material.context("a texture without heights has no maps; choose another one")?;
        // Its picture has the first row at the top too.
        let field = synthesize(material, STARTER_TILE, seed);
        (field.heights_m().to_vec(), STARTER_TILE.side_m(), HeightSource::Simulated)
    };
    Ok(Maps {
        name: texture.name.clone(),
        origin: texture.origin.clone(),
        license: texture.license.clone(),
        heights_m,
        side_m,
        source,
        friction: texture.model.friction(),
        stick_slip: texture.model.stick_slip(),
        stiffness_n_per_m: texture.physical.and_then(|physical| physical.stiffness_n_per_m()),
    })
}

/// Heights of a map as those of its picture: a map begins with its lowest row.
fn rows_from_the_top(map: &HeightMap) -> Vec<f64> {
    map.heights_m().chunks(map.n()).rev().flatten().copied().collect()
}

/// Material from which a texture was simulated, with the random seed, if it is one of the starter library without a change.
fn starter_material(texture: &TextureEntry) -> Option<(&'static Material, u64)> {
    let (library, materials) = STARTER.as_ref()?;
    let starter = &library.textures[library.index_of(&texture.id)?];
    let material = materials.iter().find(|material| material.id == texture.id)?;
    (starter.model == texture.model).then_some((material, library.seed?))
}

#[cfg(test)]
mod tests {
    use super::super::test_support::library_with_heights;
    use super::super::{ExportContext, ExportFormat as _, shaped};
    use super::{HapticMaps, rows_from_the_top};
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::haptic_maps::{MapsV1, check_gltf};
    use shagreen_formats::picture::brightness_row;
    use shagreen_formats::starter::starter_library;

    /// A starter texture has the heights that it was simulated from, and its friction.
    #[test]
    fn a_starter_texture_has_simulated_heights() {
        let library = starter_library().unwrap();
        let brick = &library.textures[library.index_of("brick").unwrap()];
        assert_eq!(HapticMaps.refusal(brick), None);
        let files = HapticMaps.files(brick, "brick", &ExportContext::new("test")).unwrap();
        let scene = check_gltf(&files[0].bytes).unwrap();
        assert_eq!((scene.n_faults, scene.n_haptic_materials), (0, 1));
        let described: MapsV1 = serde_json::from_slice(&files[3].bytes).unwrap();
        let height = &described.height;
        assert_eq!((height.source.as_str(), height.pixels, height.mm_per_pixel), ("simulated", 1024, 0.04));
        assert!(height.white_um > height.black_um && height.black_um < 0.0, "{height:?}");
        assert_eq!(described.friction.unwrap().coefficient, 0.55);
        assert!(described.stiffness_n_per_m.is_some_and(|stiffness| stiffness > 1e5));
    }

    #[test]
    fn a_texture_without_heights_is_refused_with_a_remedy() {
        let library = starter_library().unwrap();
        let quiet = shaped(&library.textures[0], &Shape { level_db: -6.0, ..Shape::default() }).unwrap();
        let reason = HapticMaps.refusal(&quiet).unwrap();
        assert!(reason.contains("no height map") && reason.contains("relief from a picture"), "{reason}");
        assert!(HapticMaps.bytes(&quiet, "test").is_err());
        let mut renamed = library.textures[0].clone();
        "another".clone_into(&mut renamed.id);
        assert!(HapticMaps.refusal(&renamed).is_some(), "no material is known for it");
    }

    /// The first row of a picture is the last one of a map.
    #[test]
    fn the_picture_is_upright() {
        let library = library_with_heights();
        let texture = &library.textures[0];
        let map = texture.model.height_map().unwrap();
        let rows = rows_from_the_top(map);
        assert_eq!((&rows[..16], &rows[240..]), (&map.heights_m()[240..], &map.heights_m()[..16]));
        let files = HapticMaps.files(texture, "a", &ExportContext::new("test")).unwrap();
        // Rows 0, 1 and 2 of the map have 0, 1 and 2 µm, and so on up to row 15, which has 0 µm.
        let gray = |row: u32| brightness_row(&files[2].bytes, Some(row)).unwrap()[0];
        assert_eq!([gray(0), gray(15), gray(13)], [0.0, 0.0, 1.0]);
    }
}
