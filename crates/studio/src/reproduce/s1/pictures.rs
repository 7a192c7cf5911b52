//! Pictures of textures as training data: those of the library, and further ones rendered from the same materials.

use anyhow::Context as _;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::space::LabelSource;
use shagreen_core::surfaces::height_field::{STARTER_TILE, synthesize};
use shagreen_core::surfaces::material::Material;
use shagreen_core::surfaces::picture_features::square;
use shagreen_core::surfaces::shading::{Picture, shade};
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::picture::decode;
use shagreen_formats::starter::starter_anchors;
use shagreen_learn::picture_model::rivals::pixels;
use shagreen_learn::picture_predictor::see;

use crate::parallel::in_parallel;
use crate::reproduce::ReproduceOptions;

/// A texture with a position and at least one picture.
pub(super) struct Pictured {
    /// Name of the texture.
    pub(super) name: String,
    /// Position on both axes, 0 to 100.
    pub(super) labels: Vec<f64>,
    /// Features of each picture, that of the library first.
    pub(super) features: Vec<Features>,
}

/// Features of one picture.
pub(super) struct Features {
    extracted: Vec<f32>,
    pixels: Vec<f32>,
}

impl Features {
    /// Features by a backbone network, or statistics of the picture.
    pub(super) fn extracted(&self) -> &[f32] {
        &self.extracted
    }

    /// Pixels, for networks that read them; empty unless all networks are trained.
    pub(super) fn pixels(&self) -> &[f32] {
        &self.pixels
    }
}

/// Textures of a library with a picture and a position that is not an estimate. Textures of the starter library get further
/// pictures, rendered from the same materials with other random numbers.
pub(super) fn pictures(library: &Library, options: &ReproduceOptions<'_>) -> anyhow::Result<Vec<Pictured>> {
    let (anchors, _) = starter_anchors()?;
    let material =
        |id: &str| anchors.iter().map(|anchor| &anchor.material).find(|material| material.id == id);
    let of_texture = |index: usize| -> anyhow::Result<Option<Pictured>> {
        let texture = &library.textures[index];
        let Some(labels) = labels_of(texture) else { return Ok(None) };
        pictured(texture, labels, material(&texture.id), options)
            .with_context(|| format!("the picture of \"{}\"", texture.id))
    };
    let found = in_parallel(library.textures.len(), of_texture);
    let found = found.into_iter().collect::<anyhow::Result<Vec<Option<Pictured>>>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// Names of the sources of the positions that are used.
pub(super) fn label_source(library: &Library) -> String {
    let known = library.label_sources().into_iter().filter(|source| *source != LabelSource::Estimated);
    known.map(LabelSource::label).collect::<Vec<_>>().join(" and ")
}

/// Position of a texture on both axes, unless it is an estimate.
fn labels_of(texture: &TextureEntry) -> Option<Vec<f64>> {
    let place = texture.place.filter(|place| place.source != LabelSource::Estimated)?;
    Some(vec![place.at.x(), place.at.y()])
}

fn pictured(
    texture: &TextureEntry,
    labels: Vec<f64>,
    material: Option<&Material>,
    options: &ReproduceOptions<'_>,
) -> anyhow::Result<Option<Pictured>> {
    let Some(picture) = &texture.picture else { return Ok(None) };
    let own = decode(picture)?.into_surface(picture.millimeters);
    let mut features = vec![features_of(&own, options)?];
    for number in 1..=options.extent.n_pictures {
        let Some(material) = material else { break };
        let field =
            synthesize(material, STARTER_TILE, derive_seed(options.seed, &format!("picture {number}")));
        features.push(features_of(&shade(&field, material, &FRAMING), options)?);
    }
    Ok(Some(Pictured { name: texture.name.clone(), labels, features }))
}

fn features_of(picture: &Picture, options: &ReproduceOptions<'_>) -> anyhow::Result<Features> {
    let pixels = if options.is_full { pixels(&square(picture)?) } else { Vec::new() };
    Ok(Features { extracted: see(options.backbone, picture)?, pixels })
}

#[cfg(test)]
mod tests {
    use super::pictures;
    use crate::reproduce::{Extent, ReproduceOptions};
    use shagreen_core::space::LabelSource;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_texture_has_its_own_picture_and_others_of_its_material() {
        let mut library = starter_library().unwrap();
        library.textures.truncate(3);
        library.textures[1].place.as_mut().unwrap().source = LabelSource::Estimated;
        "not a material".clone_into(&mut library.textures[2].id);
        let options = ReproduceOptions {
            library: None,
            judgments: None,
            backbone: None,
            is_full: true,
            extent: Extent { n_pictures: 1, ..Extent::small() },
            seed: 1,
            command: String::new(),
        };
        let found = pictures(&library, &options).unwrap();
        // Estimated positions are no labels.
        assert_eq!(found.iter().map(|of| of.features.len()).collect::<Vec<_>>(), [2, 1]);
        let [own, other] = &found[0].features[..] else { panic!("two pictures") };
        assert!(own.extracted() != other.extracted() && own.pixels().len() == 56 * 56 * 3);
        assert_eq!(found[0].labels, library.textures[0].at().unwrap().coordinates());
    }
}
