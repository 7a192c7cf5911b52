//! Selection of a texture: one of the library, or one authored at a point of the space.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::space::SpacePoint;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::Library;
use shagreen_formats::project::Project;
use shagreen_studio::project::{find_authored, load_project, textures_of};
use shagreen_studio::sound::Sound;

use crate::cli::blending::BlendArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;
use crate::cli::shape_args::ShapeArgs;

/// Texture to render or play.
#[derive(clap::Args)]
pub(crate) struct SoundArgs {
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Project file. --at and --texture then use the textures of the project: its library and the textures added to it.
    #[arg(long, value_name = "PROJECT", conflicts_with = "library")]
    project: Option<PathBuf>,
    #[command(flatten)]
    blending: BlendArgs,
    #[command(flatten)]
    shape: ShapeArgs,
}

#[derive(clap::Args)]
#[group(required = true, multiple = false)]
struct TargetArgs {
    /// Position in the space as RS,HS, each 0 to 100. RS (rough-smooth): 0 = roughest, 100 = smoothest. HS (hard-soft):
    /// 0 = hardest, 100 = softest.
    #[arg(long, value_name = "RS,HS", value_parser = parse_point, allow_hyphen_values = true)]
    at: Option<SpacePoint>,
    /// Texture of the library, by id.
    #[arg(long, value_name = "ID")]
    texture: Option<String>,
    /// Authored texture of the project, by name or number, with its interpolation settings and its shape in the project.
    /// `shagreen project show` lists names and numbers.
    #[arg(long, value_name = "NAME", requires = "project", conflicts_with_all = ["blend", "natural", "extrapolate", "lock"])]
    authored: Option<String>,
}

/// Textures to select from. Those that take no part in the interpolation of the selected texture have no position.
pub(crate) struct Textures {
    pub(crate) library: Library,
    project: Option<Project>,
}

/// Parses a point of the space, as `RS,HS`.
pub(crate) fn parse_point(text: &str) -> Result<SpacePoint, String> {
    let number = |part: &str| {
        part.trim()
            .parse::<f64>()
            .map_err(|_| format!("\"{}\" is not a number; write RS,HS as in 30,70", part.trim()))
    };
    let (rough_smooth, hard_soft) = text.split_once(',').ok_or("write RS,HS as in 30,70")?;
    SpacePoint::new(number(rough_smooth)?, number(hard_soft)?).map_err(|error| error.to_string())
}

impl SoundArgs {
    /// Loads the library that the arguments name and selects a texture of it.
    pub(crate) fn load(&self) -> anyhow::Result<(Library, Sound)> {
        let textures = self.load_textures()?;
        let chosen = self.choose(&textures)?;
        Ok((textures.library, chosen))
    }

    /// Loads the textures that the arguments name.
    pub(crate) fn load_textures(&self) -> anyhow::Result<Textures> {
        let project = self
            .project
            .as_deref()
            .map(|path| load_project(path, &permitted_libraries(), &Printed))
            .transpose()?;
        let library = match &project {
            Some(project) => self.textures_in(project)?,
            None => self.library.load()?,
        };
        Ok(Textures { library, project })
    }

    /// The textures of a project, for its authored texture that the arguments name, or for a point with the pins that they
    /// name.
    fn textures_in(&self, project: &Project) -> anyhow::Result<Library> {
        let textures = textures_of(project)?;
        let Some(name) = &self.target.authored else {
            return Ok(project.with_places_of(&textures, |id| self.blending.pins(id)));
        };
        let locked = &find_authored(project, name)?.blend.locked;
        Ok(project.with_places_of(&textures, |id| locked.contains(id)))
    }

    /// Returns the library file or folder, or the project, that was named.
    pub(crate) fn library_path(&self) -> Option<&Path> {
        self.project.as_deref().or(self.library.path())
    }

    /// Selects the texture that the arguments name.
    pub(crate) fn choose(&self, Textures { library, project }: &Textures) -> anyhow::Result<Sound> {
        let (point, blending, own_shape) = match (&self.target.authored, project) {
            (Some(name), Some(project)) => {
                let authored = find_authored(project, name)?;
                let blending = authored.blend.blending(|id| library.index_of(id));
                (Some(authored.at), blending, authored.shape)
            }
            _ => (self.target.at, self.blending.blending(library)?, Shape::default()),
        };
        let shape = self.shape.or(own_shape);
        if let Some(id) = &self.target.texture {
            return Sound::of_texture(library, id, blending.mode, &shape);
        }
        let Some(point) = point else {
            bail!(output::Usage("no texture is selected; give --at RS,HS, --texture ID, or --project FILE with --authored NAME".to_owned()))
        };
        Sound::of_point(library, point, (&blending, &shape), &Printed)
    }
}

#[cfg(test)]
mod tests {
    use super::parse_point;

    #[test]
    fn points_say_what_is_wrong() {
        assert_eq!(parse_point("30, 70.5").unwrap().hard_soft, 70.5);
        for (text, words) in [
            ("30", "RS,HS"),
            ("a,70", "\"a\""),
            ("130,70", "rough-smooth is 130"),
            ("30,-1", "hard-soft is -1"),
            ("NaN,1", "rough-smooth is NaN"),
        ] {
            let error = parse_point(text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
