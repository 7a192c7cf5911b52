//! Where projects come from.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_app::document::{Read, read_file};
use shagreen_formats::library::Library;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::cli::output;

/// Reads a project; what is odd about it is said.
pub(crate) fn load_project(path: &Path) -> anyhow::Result<Project> {
    match read_file(path)? {
        Read::Project(imported) => {
            for warning in &imported.warnings {
                output::warn(&format!("{warning}: {}", path.display()));
            }
            Ok(imported.value)
        }
        Read::Library(_) => {
            bail!("{}: this is a library, not a project; give it to --library instead", path.display())
        }
    }
}

/// The textures that a project authors from.
pub(crate) fn textures_of(project: &Project) -> anyhow::Result<Library> {
    let library =
        project.library.read().context("the library of the program is damaged; install Shagreen again")?;
    Ok(project.textures_on(library))
}

/// The authored texture of this name, or else of this key.
pub(crate) fn find_authored<'a>(project: &'a Project, name: &str) -> anyhow::Result<&'a AuthoredTexture> {
    let named: Vec<&AuthoredTexture> =
        project.authored.iter().map(|texture| &**texture).filter(|texture| texture.name == name).collect();
    let of_key =
        |key: u32| project.authored.iter().map(|texture| &**texture).find(|texture| texture.key == key);
    match (&named[..], name.parse().ok().and_then(of_key)) {
        ([one], _) => Ok(one),
        ([], Some(one)) => Ok(one),
        ([], None) => {
            let names: Vec<String> = project.authored.iter().map(|t| format!("\"{}\"", t.name)).collect();
            bail!("the project has no authored texture \"{name}\"; it has {}", names.join(", "))
        }
        (several, _) => {
            let keys: Vec<String> = several.iter().map(|texture| texture.key.to_string()).collect();
            bail!(
                "{} authored textures have this name; say which by its key: {}",
                several.len(),
                keys.join(", ")
            )
        }
    }
}
