//! Projects: new projects, the textures that they use, and their authored textures by name.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::Library;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

use crate::axes::{placed_on, placed_with};
use crate::open::{Opened, open};
use crate::permitted_libraries::Permitted;
use crate::report::Reporter;

/// Name of the first texture of a new project.
const NEW_TEXTURE: &str = "New texture";

/// A new project on the starter library, with one authored texture.
pub fn new_project() -> Project {
    Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), NEW_TEXTURE)
}

/// Reads a project; its warnings go to `reporter`.
///
/// # Errors
/// The file cannot be read or is not a project.
pub fn load_project(path: &Path, permitted: &Permitted, reporter: &dyn Reporter) -> anyhow::Result<Project> {
    match open(path, permitted)? {
        Opened::Project(opened) => {
            for warning in &opened.warnings {
                reporter.warn(&format!("{warning}: {}", path.display()));
            }
            Ok(opened.project)
        }
        Opened::Library(_) => {
            bail!("{}: this is a library, not a project; give it to --library instead", path.display())
        }
    }
}

/// Returns the textures of a project: those of its library, then those that were added to the project.
///
/// # Errors
/// The built-in library is damaged.
pub fn textures_of(project: &Project) -> anyhow::Result<Library> {
    let library = project.library.read().context("the built-in library is damaged; reinstall Shagreen")?;
    Ok(project.textures_on(library))
}

/// Returns the textures of a project ([`textures_of`]), placed on the axes of the project if it has its own.
///
/// # Errors
/// The built-in library is damaged, or the textures cannot have positions on these axes ([`crate::axes::AxesError`]).
pub fn textures_on_axes(project: &Project) -> anyhow::Result<Library> {
    let library = textures_of(project)?;
    match &project.axes {
        Some(axes) => {
            placed_with(&library, axes, &project.coordinates).context("the project cannot have its axes")
        }
        None => Ok(library),
    }
}

/// Returns whether the textures of the library of a project can be placed on the axes that the project chooses. `false` if it chooses
/// none, or those of the positions.
pub fn can_have_its_axes(project: &Project) -> bool {
    let Some(axes) = &project.axes else { return false };
    let Ok(library) = project.library.read() else { return false };
    let library = match &project.space {
        Some(space) => space.place(&library),
        None => library,
    };
    library.axis_names() != *axes && placed_on(&library, axes).is_ok()
}

/// Returns the textures of a project for the selection of one by its identifier, which needs no positions: on the axes of the
/// project ([`textures_on_axes`]), or as [`textures_of`] if none can be placed on these axes. A note then says so.
///
/// # Errors
/// The built-in library is damaged.
pub fn textures_by_id(project: &Project, reporter: &dyn Reporter) -> anyhow::Result<Library> {
    if let Ok(library) = textures_on_axes(project) {
        return Ok(library);
    }
    // A damaged library fails here again, so that what remains is an error of the axes.
    let library = textures_of(project)?;
    let axes = project.axes.as_deref().unwrap_or_default().join(", ");
    reporter.note(&format!(
        "no texture can be placed on the axes of the project ({axes}), so these axes are not used"
    ));
    Ok(library)
}

/// Returns the authored texture with this name, or else with this key.
///
/// # Errors
/// No texture has this name or key, or several have the name.
pub fn find_authored<'a>(project: &'a Project, name: &str) -> anyhow::Result<&'a AuthoredTexture> {
    let named: Vec<&AuthoredTexture> =
        project.authored.iter().map(|texture| &**texture).filter(|texture| texture.name == name).collect();
    let of_key =
        |key: u32| project.authored.iter().map(|texture| &**texture).find(|texture| texture.key == key);
    match (&named[..], name.parse().ok().and_then(of_key)) {
        ([one], _) => Ok(one),
        ([], Some(one)) => Ok(one),
        ([], None) => {
            let names: Vec<String> = project.authored.iter().map(|t| format!("\"{}\"", t.name)).collect();
            bail!("the project has no authored texture \"{name}\"; choose one of {}", names.join(", "))
        }
        (several, _) => {
            let keys: Vec<String> = several.iter().map(|texture| texture.key.to_string()).collect();
            bail!(
                "{} authored textures have the name \"{name}\"; choose one by its number: {}",
                several.len(),
                keys.join(", ")
            )
        }
    }
}
