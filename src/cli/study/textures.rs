//! The options `--library` and `--project` of a study.

use std::path::PathBuf;

use shagreen_studio::project::load_project;
use shagreen_studio::study::textures::StudyTextures;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::Printed;
use crate::cli::own_folder::permitted_libraries;

#[derive(clap::Args)]
pub(crate) struct TextureArgs {
    #[command(flatten)]
    library: LibraryArgs,
    /// Project file: the stimuli can be textures of its library, textures added to it, and its authored textures by name.
    #[arg(long, value_name = "PROJECT", conflicts_with = "library")]
    project: Option<PathBuf>,
}

impl TextureArgs {
    /// Returns whether a project was named.
    pub(crate) fn has_project(&self) -> bool {
        self.project.is_some()
    }

    /// Returns whether a library or a project was named.
    pub(crate) fn is_given(&self) -> bool {
        self.has_project() || self.library.path().is_some()
    }

    /// Loads the textures that a plan can name.
    pub(crate) fn load(&self) -> anyhow::Result<StudyTextures> {
        match &self.project {
            Some(path) => StudyTextures::of_project(&load_project(path, &permitted_libraries(), &Printed)?),
            None => Ok(StudyTextures::of_library(self.library.load()?)),
        }
    }
}
