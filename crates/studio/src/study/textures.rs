//! Textures of which the stimuli of a study are made: those of a library, or those of a project with its authored textures.

use shagreen_core::people::study::plan::Source;
use shagreen_core::signals::profile_stimuli::PaperTexture;
use shagreen_core::words::near;
use shagreen_formats::library::Library;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::project::textures_on_axes;

/// Textures that a plan can name: by the identifier in the library, or else by the name in the project.
#[derive(Clone, Debug)]
pub struct StudyTextures {
    library: Library,
    project: Option<Project>,
}

/// What a name of a plan leads to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Found<'a> {
    /// Texture of the library, by its index.
    Texture(usize),
    /// Authored texture of the project.
    Authored(&'a AuthoredTexture),
}

impl StudyTextures {
    /// Textures of a library.
    pub fn of_library(library: Library) -> Self {
        Self { library, project: None }
    }

    /// Textures of a project: those of its library, those added to it, and its authored textures.
    ///
    /// # Errors
    /// The built-in library is damaged, or the textures cannot have positions on the axes of the project.
    pub fn of_project(project: &Project) -> anyhow::Result<Self> {
        Ok(Self { library: textures_on_axes(project)?, project: Some(project.clone()) })
    }

    /// Whether there is such a texture or profile. A name that several authored textures have leads to none.
    pub fn has(&self, source: &Source) -> bool {
        match source {
            Source::Texture(name) => self.find(name).is_some(),
            Source::Profile(name) => profile(name).is_some(),
        }
    }

    /// What to do about a texture or profile that does not exist; `None` about one that does.
    pub fn advice(&self, source: &Source) -> Option<String> {
        if self.has(source) {
            return None;
        }
        let authored = self.project.iter().flat_map(|project| &project.authored);
        let authored = authored.map(|texture| texture.name.as_str());
        let near = match source {
            Source::Texture(name) if authored.clone().any(|of| of == name) => {
                return Some(
                    "it is the name of several authored textures; rename them in the project".to_owned(),
                );
            }
            Source::Texture(name) => {
                let library = self.library.textures.iter().map(|texture| texture.id.as_str());
                near(library.chain(authored), name)
            }
            Source::Profile(name) => near(PaperTexture::ALL.map(PaperTexture::name), name),
        };
        Some(if near.is_empty() {
            "correct the name, or add it to the library".to_owned()
        } else {
            format!("did you mean {}?", near.join(", "))
        })
    }

    /// The textures of the library or project.
    pub(super) fn library(&self) -> &Library {
        &self.library
    }

    /// The project, if there is one.
    pub(super) fn project(&self) -> Option<&Project> {
        self.project.as_ref()
    }

    pub(super) fn find(&self, name: &str) -> Option<Found<'_>> {
        if let Some(index) = self.library.index_of(name) {
            return Some(Found::Texture(index));
        }
        let authored = self.project.iter().flat_map(|project| &project.authored);
        let mut named = authored.filter(|texture| texture.name == name);
        let only = named.next()?;
        named.next().is_none().then_some(Found::Authored(only))
    }
}

/// Published profile of this name.
pub(super) fn profile(name: &str) -> Option<PaperTexture> {
    PaperTexture::ALL.into_iter().find(|texture| texture.name() == name)
}
