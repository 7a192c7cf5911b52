//! Which texture: one of the library, or the one authored at a point of the space.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::authoring::{Authored, Authoring, Blending, Layers, Models, Voice};
use shagreen_core::blend::Mode;
use shagreen_core::plane::Plane;
use shagreen_core::rate::{at_rate, highest_rate};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::tap::Tap;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture_path::TexturePath;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::Project;

use crate::cli::blending::BlendArgs;
use crate::cli::library_source::{self, LibraryArgs};
use crate::cli::motion::Motion;
use crate::cli::near_names::unknown_texture;
use crate::cli::output;
use crate::cli::project_source::{find_authored, load_project, textures_of};

/// What sounds.
#[derive(clap::Args)]
pub(crate) struct SoundArgs {
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Project whose textures are taken instead of those of a library.
    #[arg(long, value_name = "PROJECT", conflicts_with = "library")]
    project: Option<PathBuf>,
    #[command(flatten)]
    blending: BlendArgs,
}

#[derive(clap::Args)]
#[group(required = true, multiple = false)]
struct TargetArgs {
    /// Point of the space: rough-smooth and hard-soft, 0 to 100 each, 0 = roughest, 0 = hardest.
    #[arg(long, value_name = "RS,HS", value_parser = parse_point, allow_hyphen_values = true)]
    at: Option<SpacePoint>,
    /// Texture of the library, by its id.
    #[arg(long, value_name = "ID")]
    texture: Option<String>,
    /// Authored texture of the project, by its name or key, blended as it is there.
    #[arg(long, value_name = "NAME", requires = "project", conflicts_with_all = ["blend", "natural", "extrapolate", "lock"])]
    authored: Option<String>,
}

/// Textures to choose from.
pub(crate) struct Textures {
    pub(crate) library: Library,
    project: Option<Project>,
}

/// What sounds.
pub(crate) struct Chosen {
    /// Textures that have a say, by their index in the library, and weights, largest first, at least one.
    pub(crate) parents: Vec<(usize, f64)>,
    /// How they become one.
    pub(crate) mode: Mode,
    /// How what sounds is mixed.
    pub(crate) mixing: Mode,
    /// What sounds, and its weight; of a path its first texture.
    voices: Vec<(Sounding, f64)>,
    /// How it changes along a stroke, where it does.
    pub(crate) path: Option<TexturePath>,
    /// What a landing sounds like, where that is known.
    pub(crate) tap: Option<Tap>,
    /// The texture named, where one was.
    pub(crate) texture: Option<String>,
    /// The point authored, where one was: the one asked for, or the nearest of the hull.
    pub(crate) at: Option<SpacePoint>,
    /// Whether another point was authored than the one asked for, which lies outside the hull.
    pub(crate) clamped: bool,
    /// Whether the point lies outside the hull and was authored nevertheless.
    pub(crate) extrapolated: bool,
}

/// Most parents that are named to people.
const MOST_SAID: usize = 3;

enum Sounding {
    /// A texture of the library.
    Texture(usize),
    /// A texture that was made for the point.
    Made(TextureModel),
}

/// A point of the space, as `RS,HS`.
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
    /// The library that the arguments name, and what they choose of it.
    pub(crate) fn load(&self) -> anyhow::Result<(Library, Chosen)> {
        let textures = self.load_textures()?;
        let chosen = self.choose(&textures)?;
        Ok((textures.library, chosen))
    }

    /// The textures that the arguments name.
    pub(crate) fn load_textures(&self) -> anyhow::Result<Textures> {
        let project = self.project.as_deref().map(load_project).transpose()?;
        let library = match &project {
            Some(project) => textures_of(project)?,
            None => library_source::load(&self.library)?,
        };
        Ok(Textures { library, project })
    }

    /// The library file or folder, or the project, that was named.
    pub(crate) fn library_path(&self) -> Option<&Path> {
        self.project.as_deref().or(self.library.path())
    }

    /// What the arguments choose of textures.
    pub(crate) fn choose(&self, Textures { library, project }: &Textures) -> anyhow::Result<Chosen> {
        let (point, blending) = match (&self.target.authored, project) {
            (Some(name), Some(project)) => {
                let authored = find_authored(project, name)?;
                (Some(authored.at), authored.blend.blending(|id| library.index_of(id)))
            }
            _ => (self.target.at, self.blending.blending(library)?),
        };
        choose(library, self.target.texture.as_ref(), point, &blending)
    }
}

fn choose(
    library: &Library,
    texture: Option<&String>,
    point: Option<SpacePoint>,
    blending: &Blending,
) -> anyhow::Result<Chosen> {
    let mode = blending.mode;
    if let Some(id) = texture {
        let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
        return Ok(Chosen {
            parents: vec![(index, 1.0)],
            mode,
            mixing: Mode::Shared,
            voices: vec![(Sounding::Texture(index), 1.0)],
            path: library.textures[index].path.clone(),
            tap: library.textures[index].model.tap(),
            texture: Some(id.clone()),
            at: None,
            clamped: false,
            extrapolated: false,
        });
    }
    let Some(point) = point else { bail!(output::Usage("say --at RS,HS or --texture ID".to_owned())) };
    let authored = authoring(library, mode)?
        .author(point, blending)
        .context("no texture of the library has a place; use --texture, or place the textures first")?;
    told(point, &authored);
    let voices: Vec<(Sounding, f64)> = authored
        .voices()
        .into_iter()
        .map(|(voice, weight)| match voice {
            Voice::Texture(index) => (Sounding::Texture(index), weight),
            Voice::Made(model) => (Sounding::Made(model.clone()), weight),
        })
        .collect();
    if voices.is_empty() {
        bail!("the field has no texture at {point}; choose another point, or --blend shared");
    }
    Ok(Chosen {
        mode,
        mixing: authored.mixing(),
        voices,
        path: None,
        tap: authored.tap(|index| library.textures[index].model.tap()),
        texture: None,
        at: Some(authored.location.at),
        clamped: authored.location.clamped,
        extrapolated: authored.is_extrapolated,
        parents: authored.parents,
    })
}

/// Says where a point that lies outside the textures was taken.
fn told(point: SpacePoint, authored: &Authored) {
    let at = authored.location.at;
    match (authored.location.clamped, authored.is_extrapolated) {
        (false, false) => {}
        (true, false) => output::warn(&format!(
            "{point} lies outside the textures of the library; the nearest point among them, {at}, is used"
        )),
        (false, true) => output::warn(&format!(
            "{point} lies outside the textures of the library; what is there is extrapolated"
        )),
        (true, true) => output::warn(&format!(
            "{point} lies too far outside the textures of the library; {at}, as far as they support, is extrapolated"
        )),
    }
}

/// The space of a library, with what the mode needs.
pub(crate) fn authoring(library: &Library, mode: Mode) -> anyhow::Result<Authoring> {
    let space = Space::new(&library.positions()).context("the textures cannot be placed")?;
    let authoring = Authoring::new(space);
    if !mode.makes_a_model() || authoring.space().sites().is_empty() {
        return Ok(authoring);
    }
    let placed: Vec<usize> = authoring.space().sites().iter().map(|(texture, _)| *texture).collect();
    let rate = highest_rate(placed.iter().map(|texture| &library.textures[*texture].model))
        .context("there is nothing to author; place the textures first")?;
    let mut planes: Vec<Option<Plane>> = vec![None; library.textures.len()];
    for texture in &placed {
        planes[*texture] = Some(plane_at(&library.textures[*texture], rate)?);
    }
    let layers: Vec<Option<Layers<'_>>> = planes
        .iter()
        .zip(&library.textures)
        .map(|(plane, entry)| plane.as_ref().map(|plane| Layers::of(&entry.model, plane)))
        .collect();
    let models = Models::new(authoring.space(), &layers)?;
    Ok(authoring.with_models(Arc::new(models)))
}

/// The plane of a texture at a rate; what a conversion costs is said.
fn plane_at(texture: &TextureEntry, rate: Hertz) -> anyhow::Result<Plane> {
    let own = texture.model.rate();
    let converted = at_rate(&texture.model, rate)
        .with_context(|| format!("\"{}\" cannot be mixed with textures of {rate}", texture.id))?;
    if own != rate {
        output::note(&format!(
            "\"{}\" has a rate of {own} and is converted to {rate} for its neighbors: same levels, spectra \
             within {:.1} dB (median of its speeds and forces; worst {:.1} dB)",
            texture.id, converted.error_db_median, converted.error_db_worst
        ));
    }
    Ok(Plane::new(&converted.model))
}

impl Chosen {
    /// The planes of what sounds at [`Chosen::rate`], and the weights.
    pub(crate) fn planes(&self, library: &Library) -> anyhow::Result<Vec<(Plane, f64)>> {
        let rate = self.rate(library)?;
        let plane = |(voice, weight): &(Sounding, f64)| {
            let plane = match voice {
                Sounding::Texture(index) => plane_at(&library.textures[*index], rate)?,
                Sounding::Made(model) => Plane::new(model),
            };
            Ok((plane, *weight))
        };
        self.voices.iter().map(plane).collect()
    }

    /// The models of what sounds.
    fn models<'a>(&'a self, library: &'a Library) -> impl Iterator<Item = &'a TextureModel> {
        self.voices.iter().map(|(voice, _)| match voice {
            Sounding::Texture(index) => &library.textures[*index].model,
            Sounding::Made(model) => model,
        })
    }

    /// The highest rate of what sounds, to which the rest is converted.
    pub(crate) fn rate(&self, library: &Library) -> anyhow::Result<Hertz> {
        highest_rate(self.models(library)).context("there is nothing to render; choose another point")
    }

    /// Says where the hand leaves what the parents know: beyond it they stay as they are at its edge.
    pub(crate) fn note_limits(&self, library: &Library, motion: &Motion) {
        let highest_speeds = self.models(library).map(|m| m.speed_max().mm_per_s());
        let known_mm_per_s = highest_speeds.fold(f64::INFINITY, f64::min);
        let known_n = self.models(library).map(|m| m.force_max().0).fold(f64::INFINITY, f64::min);
        let trace = motion.trace();
        let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        if highest(&trace.speed_mm_per_s) > known_mm_per_s || highest(&trace.force_n) > known_n {
            output::note(&format!(
                "the texture is known up to {known_mm_per_s:.0} mm/s and {known_n:.1} N; beyond that it stays as it is there"
            ));
        }
    }

    /// The parents as they stand in results.
    pub(crate) fn parents_json(&self, library: &Library) -> Value {
        let parent =
            |(index, weight): &(usize, f64)| json!({"id": library.textures[*index].id, "weight": weight});
        self.parents.iter().map(parent).collect()
    }

    /// The parents in words: those that say something, and how many more there are.
    pub(crate) fn parents_text(&self, library: &Library) -> String {
        let percent = |(index, weight): &(usize, f64)| {
            format!("{} {:.0} %", library.textures[*index].id, 100.0 * weight)
        };
        let said = self.parents.iter().take(MOST_SAID).map(percent).collect::<Vec<_>>().join(", ");
        match self.parents.len().saturating_sub(MOST_SAID) {
            0 => said,
            n => format!("{said} and {n} more"),
        }
    }

    /// The point as it stands in results.
    pub(crate) fn at_json(&self) -> Option<[f64; 2]> {
        self.at.map(|at| [at.rough_smooth, at.hard_soft])
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
