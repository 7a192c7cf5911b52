//! Pictures from prompts: by the procedural generator, or by a diffusion model of the user.

use std::borrow::Cow;

use anyhow::Context as _;
use shagreen_core::space::SpacePoint;
use shagreen_core::surfaces::generated::{GENERATOR, Witness, generate};
use shagreen_core::surfaces::height_field::HeightField;
use shagreen_core::surfaces::prompt::PromptInterpretation;
use shagreen_core::surfaces::shading::{Picture, shade_tile};
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::starter::starter_anchors;
use shagreen_learn::diffusion::Wish;

use crate::felt::GeneratedSurface;
use crate::models::{AddedDiffusion, ModelFolder};

/// Pixels along each side of the picture from which attributes are predicted.
const PREDICTED_SIDE: usize = 512;

/// A generated picture.
#[derive(Clone, Debug)]
pub struct GeneratedPicture {
    /// What generated it.
    pub by: String,
    /// Its pixels.
    pub picture: Picture,
    /// Heights of the pictured surface, where they are known.
    pub relief: Option<PicturedRelief>,
}

/// Heights that a picture shows.
#[derive(Clone, Debug)]
pub struct PicturedRelief {
    /// Height field of the picture.
    pub field: HeightField,
    /// What the height field was computed from.
    pub surface: GeneratedSurface,
}

impl GeneratedPicture {
    /// The picture from which attributes are predicted: the prediction must not depend on the requested number of
    /// pixels.
    pub fn for_prediction(&self) -> Cow<'_, Picture> {
        match &self.relief {
            Some(PicturedRelief { field, surface }) if self.picture.width != PREDICTED_SIDE => {
                Cow::Owned(shade_tile(field, &surface.material, PREDICTED_SIDE))
            }
            _ => Cow::Borrowed(&self.picture),
        }
    }

    /// Whether the picture adds information to the words: a procedural one is computed from them.
    pub fn witness(&self) -> Witness {
        if self.relief.is_some() { Witness::OfTheWords } else { Witness::OnItsOwn }
    }
}

/// The picture of an interpreted prompt by the procedural generator, with `side` pixels along each side.
///
/// # Errors
/// The starter library has no materials.
pub fn generate_procedurally(
    name: &str,
    understood: &PromptInterpretation,
    side: usize,
    seed: u64,
) -> anyhow::Result<GeneratedPicture> {
    let (anchors, span) = starter_anchors()?;
    let made = generate(name, understood, &anchors, &span, side, seed)
        .context("the starter library has no materials; reinstall Shagreen")?;
    Ok(GeneratedPicture {
        by: GENERATOR.to_owned(),
        picture: made.picture,
        relief: Some(PicturedRelief {
            surface: GeneratedSurface { material: made.material, tile: made.field.tile(), seed },
            field: made.field,
        }),
    })
}

/// The picture of a prompt by a diffusion model, or `None` if it was stopped. `on_step` returns whether to continue.
///
/// # Errors
/// The model was changed, cannot be read, or cannot make such a picture.
pub fn generate_by_diffusion(
    models: &ModelFolder,
    added: &AddedDiffusion,
    wish: &Wish<'_>,
    on_step: impl Fn() -> bool,
) -> anyhow::Result<Option<GeneratedPicture>> {
    let picture = models.diffusion(added)?.picture(wish, |_| on_step())?;
    Ok(picture.map(|picture| GeneratedPicture { by: added.name(), picture, relief: None }))
}

/// The `n` textures nearest to a point with their distances, in points of the axes, nearest first.
pub fn nearest(library: &Library, at: SpacePoint, n: usize) -> Vec<(&TextureEntry, f64)> {
    let mut near: Vec<(&TextureEntry, f64)> =
        library.textures.iter().filter_map(|texture| Some((texture, texture.at()?.distance(at)))).collect();
    near.sort_by(|a, b| a.1.total_cmp(&b.1));
    near.truncate(n);
    near
}

#[cfg(test)]
mod tests {
    use super::{PREDICTED_SIDE, generate_procedurally, nearest};
    use shagreen_core::surfaces::prompt::interpret;
    use shagreen_formats::lexicon_toml::built_in_lexicon;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_predicted_picture_does_not_depend_on_the_size_of_the_other() {
        let understood = interpret("a rough brick", built_in_lexicon().unwrap());
        let pictures =
            [64, PREDICTED_SIDE].map(|side| generate_procedurally("brick", &understood, side, 3).unwrap());
        assert_eq!(pictures[0].picture.width, 64);
        assert_eq!(*pictures[0].for_prediction(), *pictures[1].for_prediction());
    }

    #[test]
    fn a_texture_is_nearest_to_its_own_position() {
        let library = starter_library().unwrap();
        let at = library.textures[4].at().unwrap();
        let near = nearest(&library, at, 3);
        assert_eq!((near[0].0.id.as_str(), near[0].1, near.len()), (library.textures[4].id.as_str(), 0.0, 3));
        assert!(near[1].1 <= near[2].1);
    }
}
