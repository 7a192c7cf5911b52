//! The authoring space of a library.

use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::space::Space;
use shagreen_core::space::authoring::{Authoring, Layers, Models};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::{at_rate, highest_rate};
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Library, TextureEntry};

use crate::report::Reporter;

/// Returns the space of a library, with the texture models that the interpolation mode needs. In a space without triangles,
/// every mode is the field, which needs them.
///
/// # Errors
/// The positions cannot be triangulated, or the textures have no common rate.
pub fn authoring(library: &Library, mode: Mode, reporter: &dyn Reporter) -> anyhow::Result<Authoring> {
    let space = Space::new(&library.positions())
        .context("cannot compute the space from the positions of the textures")?;
    let authoring = Authoring::new(space);
    let makes_a_model = mode.makes_a_model() || !authoring.space().is_triangulated();
    if !makes_a_model || authoring.space().sites().is_empty() {
        return Ok(authoring);
    }
    let placed: Vec<usize> = authoring.space().sites().iter().map(|(texture, _)| *texture).collect();
    let rate = highest_rate(placed.iter().map(|texture| &library.textures[*texture].model))
        .context("no texture has a position, so none can be interpolated; assign positions first")?;
    let mut planes: Vec<Option<Plane>> = vec![None; library.textures.len()];
    for texture in &placed {
        planes[*texture] = Some(plane_at(&library.textures[*texture], rate, reporter)?);
    }
    let layers: Vec<Option<Layers<'_>>> = planes
        .iter()
        .zip(&library.textures)
        .map(|(plane, entry)| plane.as_ref().map(|plane| Layers::of(&entry.model, plane)))
        .collect();
    let models = Models::new(authoring.space(), &layers)?;
    Ok(authoring.with_models(Arc::new(models)))
}

/// Returns the speed-force plane of a texture at a rate in Hz. The spectral error of a conversion goes to `reporter`.
///
/// # Errors
/// The texture cannot be converted to this rate; the message names it.
pub fn plane_at(texture: &TextureEntry, rate: Hertz, reporter: &dyn Reporter) -> anyhow::Result<Plane> {
    plane_of(&texture.id, &texture.model, rate, reporter)
}

/// As [`plane_at`], for the texture in a shape.
///
/// # Errors
/// The texture cannot be shaped, or not be converted to this rate; the message names it.
pub fn shaped_plane_at(
    texture: &TextureEntry,
    shape: &Shape,
    rate: Hertz,
    reporter: &dyn Reporter,
) -> anyhow::Result<Plane> {
    if shape.is_neutral() {
        return plane_at(texture, rate, reporter);
    }
    plane_of(&texture.id, &shaped_model(texture, shape)?, rate, reporter)
}

/// Returns the model of a texture in a shape.
///
/// # Errors
/// The texture cannot be shaped; the message names it.
pub(crate) fn shaped_model(texture: &TextureEntry, shape: &Shape) -> anyhow::Result<TextureModel> {
    shape.apply(&texture.model).with_context(|| format!("\"{}\" cannot have the shape {shape}", texture.id))
}

/// The plane of the texture with this id.
fn plane_of(id: &str, model: &TextureModel, rate: Hertz, reporter: &dyn Reporter) -> anyhow::Result<Plane> {
    let own = model.rate();
    if own == rate {
        return Ok(Plane::new(model));
    }
    let converted =
        at_rate(model, rate).with_context(|| format!("\"{id}\" cannot be mixed with textures of {rate}"))?;
    reporter.note(&format!(
        "\"{id}\" has a model rate of {own} and is converted to {rate}, the rate of the other textures: the levels stay \
         the same, the spectra change by {:.1} dB (median over its speeds and forces; at most {:.1} dB)",
        converted.error_db_median, converted.error_db_worst
    ));
    Ok(Plane::new(&converted.model))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use shagreen_core::space::authoring::{Authored, Blending, Outside, Voice};
    use shagreen_core::space::{LabelSource, SpacePoint};
    use shagreen_core::texture::TextureModel;
    use shagreen_core::texture::blend::Mode;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::library::{Place, TextureEntry};
    use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project};

    use super::authoring;
    use crate::felt::join_felt;
    use crate::project::{new_project, textures_of};
    use crate::report::Warnings;

    /// The first authored texture of a project, in each mode.
    fn first_of(project: &Project) -> [Authored; 5] {
        let list = textures_of(project).unwrap();
        let AuthoredTexture { at, blend, .. } = &*project.authored[0];
        let used = project.with_places_of(&list, |id| blend.locked.contains(id));
        Mode::ALL.map(|mode| {
            let blending = BlendChoice { mode, ..blend.clone() }.blending(|id| list.index_of(id));
            authoring(&used, mode, &Warnings::default()).unwrap().author(*at, &blending).unwrap()
        })
    }

    /// To the bit, in every mode; not if the texture is used in the whole space.
    #[test]
    fn a_texture_generated_for_one_authored_texture_changes_no_other() {
        let library = BuiltIn::Starter.read().unwrap();
        let generated = |id: &str, rs: f64, hs: f64| {
            let place = Some(Place::new(SpacePoint::new(rs, hs).unwrap(), LabelSource::Estimated));
            Arc::new(TextureEntry { id: id.to_owned(), place, ..library.textures[3].clone() })
        };
        let mut project = new_project();
        Arc::make_mut(&mut project.authored[0]).at = SpacePoint::new(42.0, 58.0).unwrap();
        let without = first_of(&project);
        join_felt(&mut project, 1, generated("first", 41.5, 58.3), None);
        let before = first_of(&project);
        assert!(before.iter().zip(&without).all(|(before, without)| before != without), "its own counts");
        project.authored.push(Arc::new(AuthoredTexture::new(2, "Second")));
        join_felt(&mut project, 2, generated("second", 42.2, 57.9), None);
        assert_eq!(first_of(&project), before);
        assert!(project.own.remove("second"));
        let shared = first_of(&project);
        assert!(shared.iter().zip(&before).all(|(shared, before)| shared != before));
    }

    /// Blends are not judged when they are made; a model that is read from a file is.
    #[test]
    fn no_blend_of_the_starter_library_would_be_refused_in_a_file() {
        let library = BuiltIn::Starter.read().unwrap();
        for (mode, outside) in [
            (Mode::Field, Outside::Clamped),
            (Mode::Field, Outside::Extrapolated),
            (Mode::Parametric, Outside::Clamped),
        ] {
            let authoring = authoring(&library, mode, &Warnings::default()).unwrap();
            for step in 0..121 {
                let at = SpacePoint::new(f64::from(step % 11) * 10.0, f64::from(step / 11) * 10.0).unwrap();
                let authored =
                    authoring.author(at, &Blending { mode, outside, ..Blending::default() }).unwrap();
                for (voice, _) in authored.voices() {
                    let Voice::Made(model) = voice else { continue };
                    TextureModel::new(model.rate(), model.nodes().to_vec(), model.friction()).unwrap();
                }
            }
        }
    }
}
