//! Texture and project of a generated picture.

use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::surfaces::felt_material::n_steps;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, Place, TextureEntry, free_id, id_from_name};
use shagreen_formats::picture::Picture;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::authoring::authoring;
use shagreen_studio::felt::{GeneratedSurface, felt, felt_entry, join_felt};

use crate::cli::output::{self, Printed};
use crate::cli::progress::Progress;

/// Returns the texture of a picture at its position: simulated from the surface that the picture shows, else interpolated
/// from the library.
pub(crate) fn texture_of_picture(
    surface: Option<&GeneratedSurface>,
    library: &Library,
    name: &str,
    at: SpacePoint,
    picture: &Picture,
) -> anyhow::Result<TextureEntry> {
    if let Some(surface) = surface {
        return simulated(surface, name, at, picture.clone());
    }
    Ok(TextureEntry {
        description: format!("Generated from the prompt \"{name}\"; nobody rated it."),
        place: Some(Place::new(at, LabelSource::Estimated)),
        picture: Some(picture.clone()),
        ..TextureEntry::new(id_from_name(name), name, interpolated_at(library, at)?)
    })
}

/// Returns a project on the starter library with one authored texture. A simulated texture joins its list.
pub(crate) fn project_of_picture(
    texture: AuthoredTexture,
    simulated: Option<&TextureEntry>,
    library: &Library,
) -> Project {
    let key = texture.key;
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), &texture.name);
    project.authored = vec![Arc::new(texture)];
    if let Some(entry) = simulated {
        let id = free_id(&entry.id, |id| library.index_of(id).is_some());
        // Two textures at one position form no space.
        let is_free = library.textures.iter().all(|texture| texture.at() != entry.at());
        let place = entry.place.filter(|_| is_free);
        join_felt(&mut project, key, Arc::new(TextureEntry { id, place, ..entry.clone() }), None);
    }
    project
}

fn simulated(
    surface: &GeneratedSurface,
    name: &str,
    at: SpacePoint,
    picture: Picture,
) -> anyhow::Result<TextureEntry> {
    let progress = Progress::new("simulating the texture", n_steps(&surface.material));
    let model = felt(surface, |_, _| {
        progress.step();
        true
    })?;
    progress.finish();
    let model = model.context("the simulation was stopped")?;
    let about = format!("Generated from the prompt \"{name}\".");
    Ok(felt_entry(id_from_name(name), name, &about, model, picture, Some(at)))
}

/// Returns the interpolated texture at a position; a note reports a position outside the hull.
fn interpolated_at(library: &Library, at: SpacePoint) -> anyhow::Result<TextureModel> {
    let authoring = authoring(library, Mode::Field, &Printed)?;
    let blending = Blending::default();
    let authored = authoring
        .author(at, &blending)
        .context("the starter library has no positions; reinstall Shagreen")?;
    if authored.location.clamped && at.most_different_axis(authored.location.at).is_some() {
        output::note(&format!(
            "the predicted position {at} lies outside the convex hull of the textures; the nearest point of the hull is used"
        ));
    }
    authored.model.with_context(|| {
        format!("the interpolated field has no texture at {at}; use a more specific prompt, or another one")
    })
}
