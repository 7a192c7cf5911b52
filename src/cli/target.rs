//! Selection of a texture: one of the library, or one authored at a point of the space.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::space::SpacePoint;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_core::words::counted;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::Project;
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::points::point_name;
use shagreen_studio::project::{find_authored, load_project, textures_by_id, textures_of};
use shagreen_studio::sound::Sound;

use crate::cli::axes_args::AxesArgs;
use crate::cli::blending::BlendArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;
use crate::cli::point::{PointArg, parse_point};
use crate::cli::shape_args::ShapeArgs;

/// Texture to render or play.
#[derive(clap::Args)]
pub(crate) struct SoundArgs {
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    axes: AxesArgs,
    /// Project file. --at and --texture then use the textures of the project: its library and the textures added to it, on
    /// the axes of the project.
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
    /// Position in the space: one coordinate for each axis, each 0 to 100, as in 30,70. The usual axes are rough-smooth (0 =
    /// roughest, 100 = smoothest) and hard-soft (0 = hardest, 100 = softest). Or coordinates by the names of the axes, as in
    /// rough-smooth=30,centroid=60: an axis that is not named has its local mean. Without --axes, a name that is no axis of
    /// the library's positions becomes a further axis.
    #[arg(long, value_name = "POINT", value_parser = parse_point, allow_hyphen_values = true)]
    at: Option<PointArg>,
    /// Texture of the library, by id.
    #[arg(long, value_name = "ID")]
    texture: Option<String>,
    /// Authored texture of the project, by name or number, with its interpolation settings and its shape in the project.
    /// `shagreen project show` lists names and numbers.
    #[arg(long, value_name = "NAME", requires = "project", conflicts_with_all = ["blend", "natural", "extrapolate", "lock", "axes"])]
    authored: Option<String>,
}

/// A selected texture with its name.
pub(crate) struct NamedSound {
    /// Name of the texture of the library, of the authored texture, or of the point.
    pub(crate) name: String,
    /// The texture.
    pub(crate) sound: Sound,
}

impl NamedSound {
    /// Returns all textures of a library, in a shape.
    pub(crate) fn all_of(library: &Library, shape: &Shape) -> anyhow::Result<Vec<Self>> {
        let named = |entry: &TextureEntry| {
            let sound = Sound::of_texture(library, &entry.id, Mode::default(), shape)?;
            Ok(Self { name: entry.name.clone(), sound })
        };
        library.textures.iter().map(named).collect()
    }

    /// Returns the id of a texture of a library, or else the name.
    pub(crate) fn id(&self) -> &str {
        self.sound.texture.as_deref().unwrap_or(&self.name)
    }
}

/// Textures to select from, and the point that the arguments name. Textures that take no part in the interpolation of the
/// selected texture have no position.
struct Textures {
    library: Library,
    project: Option<Project>,
    at: Option<SpacePoint>,
}

impl SoundArgs {
    /// Loads the library that the arguments name and selects a texture of it.
    pub(crate) fn load(&self) -> anyhow::Result<(Library, Sound)> {
        self.load_without(None)
    }

    /// As [`SoundArgs::load`], after the texture with this id was removed from the library.
    pub(crate) fn load_without(&self, left_out: Option<&str>) -> anyhow::Result<(Library, Sound)> {
        let textures = self.load_textures(left_out)?;
        let chosen = self.choose(&textures)?;
        Ok((textures.library, chosen))
    }

    fn load_textures(&self, left_out: Option<&str>) -> anyhow::Result<Textures> {
        let project = self
            .project
            .as_deref()
            .map(|path| load_project(path, &permitted_libraries(), &Printed))
            .transpose()?;
        if self.target.texture.is_some() && !self.axes.is_empty() {
            output::note("the axes of --axes do not change the texture of --texture");
        }
        let points: Vec<&PointArg> = self.target.at.iter().collect();
        let mut library = match &project {
            Some(project) => {
                let placed = if self.target.texture.is_some() && self.axes.is_empty() {
                    textures_by_id(project, &Printed)?
                } else {
                    self.axes.place(textures_of(project)?, Some(project), &points)?
                };
                self.textures_in(project, &placed)?
            }
            None => self.axes.place(self.library.load()?, None, &points)?,
        };
        if let Some(id) = left_out {
            let index = library.index_of(id).with_context(|| unknown_texture(&library, id))?;
            library.textures.remove(index);
        }
        let at = self.target.at.as_ref().map(|at| at.in_space(&library)).transpose()?;
        Ok(Textures { library, project, at })
    }

    /// The textures of a project, for its authored texture that the arguments name, or for a point with the pins that they
    /// name.
    fn textures_in(&self, project: &Project, textures: &Library) -> anyhow::Result<Library> {
        let Some(name) = &self.target.authored else {
            return Ok(project.with_places_of(textures, |id| self.blending.pins(id)));
        };
        let locked = &find_authored(project, name)?.blend.locked;
        Ok(project.with_places_of(textures, |id| locked.contains(id)))
    }

    /// Loads the textures, and selects one with its name if the arguments name one: for commands that can also use all textures.
    /// A point has the name of its coordinates, as in a batch.
    pub(crate) fn load_any(&self) -> anyhow::Result<(Library, Option<NamedSound>)> {
        let TargetArgs { at, texture, authored } = &self.target;
        if at.is_none() && texture.is_none() && authored.is_none() {
            let Some(path) = &self.project else { return Ok((self.library.load()?, None)) };
            let project = load_project(path, &permitted_libraries(), &Printed)?;
            if !project.authored.is_empty() {
                output::note(&format!(
                    "left out: {} of the project; --authored NAME selects one, and `shagreen project show` lists them",
                    counted(project.authored.len(), "authored texture")
                ));
            }
            return Ok((textures_by_id(&project, &Printed)?, None));
        }
        let textures = self.load_textures(None)?;
        let sound = self.choose(&textures)?;
        let name = name_of(&textures, &sound, authored.as_deref())?;
        Ok((textures.library, Some(NamedSound { name, sound })))
    }

    /// Returns the shape that was given; the neutral one without one.
    pub(crate) fn shape(&self) -> Shape {
        self.shape.or(Shape::default())
    }

    /// Returns the library file or folder, or the project, that was named.
    pub(crate) fn library_path(&self) -> Option<&Path> {
        self.project.as_deref().or(self.library.path())
    }

    /// Selects the texture that the arguments name.
    fn choose(&self, Textures { library, project, at }: &Textures) -> anyhow::Result<Sound> {
        if let (Some(name), Some(project)) = (&self.target.authored, project) {
            let authored = find_authored(project, name)?;
            return Sound::of_authored(library, authored, &self.shape.or(authored.shape), &Printed);
        }
        let (blending, shape) = (self.blending.blending(library)?, self.shape.or(Shape::default()));
        if let Some(id) = &self.target.texture {
            return Sound::of_texture(library, id, blending.mode, &shape);
        }
        let Some(point) = *at else {
            bail!(output::Usage("no texture is selected; give --at POINT, --texture ID, or --project FILE with --authored NAME".to_owned()))
        };
        Sound::of_point(library, point, (&blending, &shape), &Printed)
    }
}

/// Name of a selected texture; `authored` is the name or number of an authored texture.
fn name_of(
    Textures { library, project, .. }: &Textures,
    sound: &Sound,
    authored: Option<&str>,
) -> anyhow::Result<String> {
    if let (Some(name), Some(project)) = (authored, project) {
        return Ok(find_authored(project, name)?.name.clone());
    }
    if let Some(texture) = sound.named_entry(library) {
        return Ok(texture.name.clone());
    }
    Ok(point_name(sound.at.unwrap_or_default().coordinates()))
}
