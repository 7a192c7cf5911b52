//! A sound as a texture of its own, for files and further work.

use anyhow::bail;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{Library, Provenance, TextureEntry};

use crate::export::shaped;
use crate::sound::Sound;

/// Returns a sound as a library entry: the texture of the library that was selected, with its name, or the interpolated texture
/// with this name, in the shape of the sound. `library` has the textures of the sound.
///
/// # Errors
/// The sound mixes signals, so that there is no single texture; no file can hold the texture, which is extrapolated too far; or
/// the texture cannot have the shape.
pub fn entry_of_sound(library: &Library, sound: &Sound, name: &str) -> anyhow::Result<TextureEntry> {
    if let Some(texture) = sound.named_entry(library) {
        return shaped(texture, &sound.shape);
    }
    let mut voices = sound.voice_models(library)?.into_iter();
    let (Some((model, _)), None) = (voices.next(), voices.next()) else {
        bail!(
            "this texture mixes the signals of several textures, so there is no single texture model; choose mode field or \
             parametric, and a point that is not close to a pinned texture"
        );
    };
    // Far beyond the textures, a blend may be what no file may hold.
    model.check_stable()?;
    let parents: Vec<usize> = sound.parents.iter().map(|(texture, _)| *texture).collect();
    let mut entry = library.entry_of_point(name, sound.at.unwrap_or_default(), model, &parents);
    if sound.at.is_none() {
        entry.origin = format!("Interpolated from {}.", sound.parents_text(library));
    }
    if !sound.shape.is_neutral() {
        entry.origin = format!("{} Shape: {}.", entry.origin, sound.shape);
    }
    Ok(entry)
}

/// Returns the terms of use of a sound, which are those of all textures that contribute, and whether it may be redistributed.
pub fn terms_of_sound(library: &Library, sound: &Sound) -> (String, Provenance) {
    if let Some(texture) = sound.named_entry(library) {
        return (library.license_of(texture).to_owned(), texture.provenance);
    }
    let parents: Vec<usize> = sound.parents.iter().map(|(texture, _)| *texture).collect();
    let Some(first) = parents.first() else { return (String::new(), Provenance::default()) };
    // Terms do not depend on the model.
    let model = library.textures[*first].model.clone();
    let entry = library.entry_of_point("", SpacePoint::default(), model, &parents);
    (entry.license, entry.provenance)
}

#[cfg(test)]
mod tests {
    use super::{entry_of_sound, terms_of_sound};
    use crate::report::Warnings;
    use crate::sound::Sound;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::authoring::Blending;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::library::{Library, Provenance};
    use shagreen_formats::starter::starter_library;

    fn authored(library: &Library, mode: Mode, shape: &Shape) -> Sound {
        let point = SpacePoint::new(42.0, 58.0).unwrap();
        Sound::of_point(library, point, (&Blending::from(mode), shape), &Warnings::default()).unwrap()
    }

    #[test]
    fn one_voice_is_a_texture_and_several_are_none() {
        let library = starter_library().unwrap();
        let neutral = Shape::default();
        let cork = Sound::of_texture(&library, "cork", Mode::default(), &neutral).unwrap();
        let entry = entry_of_sound(&library, &cork, "other").unwrap();
        assert_eq!(&entry, &library.textures[library.index_of("cork").unwrap()]);
        let field = authored(&library, Mode::Field, &neutral);
        let entry = entry_of_sound(&library, &field, "Between").unwrap();
        assert_eq!((entry.name.as_str(), entry.id.as_str()), ("Between", "between"));
        assert_eq!(entry.model, field.voice_models(&library).unwrap()[0].0);
        assert!(!entry.license.is_empty() && !entry.origin.contains("Shape"));
        let quiet = authored(&library, Mode::Field, &Shape { level_db: -6.0, ..neutral });
        assert!(entry_of_sound(&library, &quiet, "Quiet").unwrap().origin.contains("level=-6"));
        assert_eq!(terms_of_sound(&library, &cork).0, library.license);
        let mut restricted = library.clone();
        let mixed = authored(&library, Mode::Shared, &neutral);
        restricted.textures[mixed.parents[0].0].provenance = Provenance::Restricted;
        assert_eq!(terms_of_sound(&library, &mixed), (library.license.clone(), Provenance::Free));
        assert_eq!(terms_of_sound(&restricted, &mixed).1, Provenance::Restricted);
        let error = entry_of_sound(&library, &mixed, "Mixed").unwrap_err().to_string();
        assert!(error.contains("no single texture model"), "{error}");
    }
}
