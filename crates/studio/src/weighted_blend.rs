//! Interpolation of a few textures with given weights, without positions in a space.
//!
//! The textures become the corners of a line or a triangle, in which the barycentric weights of a point are the weights that
//! were given.

use std::sync::Arc;

use anyhow::{bail, ensure};
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::{Library, Place, TextureEntry};

use crate::report::Reporter;
use crate::sound::Sound;

/// Modes that take weights.
pub const MODES: [Mode; 3] = [Mode::Parametric, Mode::Shared, Mode::Power];
/// Largest number of textures.
pub const MOST_TEXTURES: usize = 3;

/// Name of the library of the textures, and of its axis if there are two.
const NAME: &str = "blend";

/// Returns the textures as a library, and their mixture with these weights, which are 0 or more and are divided by their sum.
///
/// # Errors
/// There is no texture or more than [`MOST_TEXTURES`], a weight is missing, negative or not finite, all weights are zero, the
/// mode is not one of [`MODES`], the textures have no common rate, or the mixture cannot have the shape.
pub fn weighted_blend(
    entries: Vec<TextureEntry>,
    weights: &[f64],
    (mode, shape): (Mode, &Shape),
    reporter: &dyn Reporter,
) -> anyhow::Result<(Library, Sound)> {
    ensure!(
        (1..=MOST_TEXTURES).contains(&entries.len()),
        "a blend has 1 to {MOST_TEXTURES} textures, got {}; interpolate more at a point of a space",
        entries.len()
    );
    ensure!(
        weights.len() == entries.len(),
        "there are {} textures and {} weights; give one weight for each texture",
        entries.len(),
        weights.len()
    );
    if let Some(weight) = weights.iter().find(|weight| !weight.is_finite() || **weight < 0.0) {
        bail!("a weight is {weight}; weights must be 0 or greater");
    }
    let sum: f64 = weights.iter().sum();
    ensure!(sum > 0.0 && sum.is_finite(), "the sum of the weights is {sum}; it must be above 0 and finite");
    ensure!(
        MODES.contains(&mode),
        "mode {} takes no weights; choose {}",
        mode.id(),
        MODES.map(Mode::id).join(", ")
    );
    let share = |index: usize| (100.0 * weights.get(index).copied().unwrap_or(0.0) / sum).min(100.0);
    let is_line = entries.len() < MOST_TEXTURES;
    let mut library = Library { name: NAME.to_owned(), ..Library::default() };
    library.axes = is_line.then(|| vec![NAME.to_owned()]);
    library.join(&entries.into_iter().map(Arc::new).collect::<Vec<_>>());
    if let [only] = &library.textures[..] {
        let sound = Sound::of_texture(&library, &only.id, mode, shape)?;
        return Ok((library, sound));
    }
    let corners: &[&[f64]] =
        if is_line { &[&[0.0], &[100.0]] } else { &[&[0.0, 0.0], &[100.0, 0.0], &[0.0, 100.0]] };
    for (texture, corner) in library.textures.iter_mut().zip(corners) {
        texture.place = Some(Place::new(SpacePoint::of(corner)?, LabelSource::Estimated));
    }
    let point = if is_line { SpacePoint::of(&[share(1)])? } else { SpacePoint::of(&[share(1), share(2)])? };
    let mut sound = Sound::of_point(&library, point, (&Blending::from(mode), shape), reporter)?;
    // The point means nothing to anyone.
    sound.at = None;
    sound.clamped = false;
    Ok((library, sound))
}

#[cfg(test)]
mod tests {
    use super::{Library, Mode, Shape, Sound, TextureEntry, weighted_blend};
    use crate::report::Warnings;
    use crate::sound_entry::entry_of_sound;
    use shagreen_formats::starter::starter_library;

    fn blended(n: usize, weights: &[f64], mode: Mode) -> anyhow::Result<(Library, Sound)> {
        let entries: Vec<TextureEntry> = starter_library().unwrap().textures[..n].to_vec();
        weighted_blend(entries, weights, (mode, &Shape::default()), &Warnings::default())
    }

    #[test]
    fn the_weights_are_those_given() {
        for (weights, shares) in [
            (&[2.0][..], &[1.0][..]),
            (&[1.0, 3.0], &[0.25, 0.75]),
            (&[0.0, 1.0], &[0.0, 1.0]),
            (&[0.2, 0.3, 0.5], &[0.2, 0.3, 0.5]),
            (&[0.0, 1.0, 1.0], &[0.0, 0.5, 0.5]),
        ] {
            for mode in super::MODES {
                let (_, sound) = blended(weights.len(), weights, mode).unwrap();
                let of = |texture: usize| {
                    sound
                        .parents
                        .iter()
                        .find(|(index, _)| *index == texture)
                        .map_or(0.0, |(_, weight)| *weight)
                };
                for (texture, share) in shares.iter().enumerate() {
                    assert!((of(texture) - share).abs() < 1e-9, "{mode:?} {weights:?}: {:?}", sound.parents);
                }
                assert!(sound.at.is_none() && !sound.clamped);
            }
        }
    }

    #[test]
    fn a_parametric_blend_is_a_texture_and_the_ends_of_a_mixture_are_its_textures() {
        let (library, sound) = blended(2, &[1.0, 1.0], Mode::Parametric).unwrap();
        let entry = entry_of_sound(&library, &sound, "Half").unwrap();
        assert!(entry.origin.starts_with("Interpolated from ") && entry.origin.contains("50 %"));
        let (library, sound) = blended(2, &[1.0, 0.0], Mode::Shared).unwrap();
        let voices = sound.voice_models(&library).unwrap();
        assert_eq!(voices.len(), 1);
        assert_eq!(voices[0].0, starter_library().unwrap().textures[0].model);
    }

    #[test]
    fn a_blend_says_what_is_wrong() {
        for (n, weights, mode, words) in [
            (0, &[][..], Mode::Shared, "1 to 3 textures, got 0"),
            (4, &[1.0; 4], Mode::Shared, "got 4"),
            (2, &[1.0], Mode::Shared, "2 textures and 1 weights"),
            (2, &[1.0, -1.0], Mode::Shared, "a weight is -1"),
            (2, &[1.0, f64::NAN], Mode::Shared, "a weight is NaN"),
            (2, &[0.0, 0.0], Mode::Shared, "the sum of the weights is 0"),
            (2, &[1.0, 1.0], Mode::Field, "mode field takes no weights"),
        ] {
            let error = blended(n, weights, mode).err().unwrap().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
