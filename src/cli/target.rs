//! Which texture: one of the library, or the one authored at a point of the space.

use std::path::Path;

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::blend::{Mode, author};
use shagreen_core::plane::Plane;
use shagreen_core::rate::{at_rate, highest_rate};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::units::Hertz;
use shagreen_formats::library::Library;

use crate::cli::library_source::{self, LibraryArgs};
use crate::cli::motion::Motion;
use crate::cli::output;

/// What sounds.
#[derive(clap::Args)]
pub(crate) struct SoundArgs {
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// How the textures around a point become one.
    #[arg(long, value_name = "MODE", value_parser = blend_parser(), default_value = Mode::default().id())]
    blend: Mode,
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
}

/// What sounds: parents by their index in the library, largest weight first, at least one.
pub(crate) struct Chosen {
    /// Parents and weights.
    pub(crate) parents: Vec<(usize, f64)>,
    /// How they are mixed.
    pub(crate) mode: Mode,
    /// The texture named, where one was.
    pub(crate) texture: Option<String>,
    /// The point authored, where one was: the one asked for, or the nearest of the hull.
    pub(crate) at: Option<SpacePoint>,
    /// Whether the point asked for lies outside the hull.
    pub(crate) clamped: bool,
}

fn parse_point(text: &str) -> Result<SpacePoint, String> {
    let number = |part: &str| {
        part.trim()
            .parse::<f64>()
            .map_err(|_| format!("\"{}\" is not a number; write RS,HS as in 30,70", part.trim()))
    };
    let (rough_smooth, hard_soft) = text.split_once(',').ok_or("write RS,HS as in 30,70")?;
    SpacePoint::new(number(rough_smooth)?, number(hard_soft)?).map_err(|error| error.to_string())
}

fn blend_parser() -> impl clap::builder::TypedValueParser<Value = Mode> {
    use clap::builder::TypedValueParser as _;
    clap::builder::PossibleValuesParser::new(Mode::ALL.map(Mode::id))
        .map(|id| Mode::from_id(&id).unwrap_or_default())
}

impl SoundArgs {
    /// The library that the arguments name, and what they choose of it.
    pub(crate) fn load(&self) -> anyhow::Result<(Library, Chosen)> {
        let library = self.load_library()?;
        let chosen = self.choose(&library)?;
        Ok((library, chosen))
    }

    /// The library that the arguments name.
    pub(crate) fn load_library(&self) -> anyhow::Result<Library> {
        library_source::load(&self.library)
    }

    /// The library file or folder that was named.
    pub(crate) fn library_path(&self) -> Option<&Path> {
        self.library.path()
    }

    /// What the arguments choose of a library.
    pub(crate) fn choose(&self, library: &Library) -> anyhow::Result<Chosen> {
        choose(library, &self.target, self.blend)
    }
}

fn choose(library: &Library, target: &TargetArgs, mode: Mode) -> anyhow::Result<Chosen> {
    if let Some(id) = &target.texture {
        let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
        let parents = vec![(index, 1.0)];
        return Ok(Chosen { parents, mode, texture: Some(id.clone()), at: None, clamped: false });
    }
    let Some(point) = target.at else { bail!(output::Usage("say --at RS,HS or --texture ID".to_owned())) };
    let space = Space::new(&library.positions()).context("the textures cannot be placed")?;
    let authored = author(&space, point, mode)
        .context("no texture of the library has a place; use --texture, or place the textures first")?;
    let location = authored.location;
    if location.clamped {
        output::warn(&format!(
            "{point} lies outside the textures of the library; the nearest point among them, {}, is used",
            location.at
        ));
    }
    let (at, clamped) = (Some(location.at), location.clamped);
    Ok(Chosen { parents: authored.parents, mode, texture: None, at, clamped })
}

impl Chosen {
    /// The planes of the parents at [`Chosen::rate`], in their order, and the weights.
    pub(crate) fn planes(&self, library: &Library) -> anyhow::Result<Vec<(Plane, f64)>> {
        let rate = self.rate(library)?;
        let plane = |(index, weight): &(usize, f64)| {
            let texture = &library.textures[*index];
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
            Ok((Plane::new(&converted.model), *weight))
        };
        self.parents.iter().map(plane).collect()
    }

    /// The highest rate of the parents, to which the others are converted.
    pub(crate) fn rate(&self, library: &Library) -> anyhow::Result<Hertz> {
        let models = self.parents.iter().map(|(index, _)| &library.textures[*index].model);
        highest_rate(models).context("there is nothing to render; choose another point")
    }

    /// Says where the hand leaves what the parents know: beyond it they stay as they are at its edge.
    pub(crate) fn note_limits(&self, library: &Library, motion: &Motion) {
        let models = || self.parents.iter().map(|(index, _)| &library.textures[*index].model);
        let known_mm_per_s = models().map(|m| m.speed_max().mm_per_s()).fold(f64::INFINITY, f64::min);
        let known_n = models().map(|m| m.force_max().0).fold(f64::INFINITY, f64::min);
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

    /// The parents in words.
    pub(crate) fn parents_text(&self, library: &Library) -> String {
        let parent = |(index, weight): &(usize, f64)| {
            format!("{} {:.0} %", library.textures[*index].id, 100.0 * weight)
        };
        self.parents.iter().map(parent).collect::<Vec<_>>().join(", ")
    }

    /// The point as it stands in results.
    pub(crate) fn at_json(&self) -> Option<[f64; 2]> {
        self.at.map(|at| [at.rough_smooth, at.hard_soft])
    }
}

/// That there is no such texture, and which have a name like it.
pub(crate) fn unknown_texture(library: &Library, id: &str) -> String {
    format!("the library has no texture \"{id}\"; {}", meant(library, id))
}

/// Which textures may have been meant by what is the name of none.
pub(crate) fn meant(library: &Library, id: &str) -> String {
    let near = near_ids(library, id);
    if near.is_empty() {
        "`shagreen library list` shows what there is".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    }
}

/// Up to three identifiers like `id`, the nearest first.
fn near_ids<'a>(library: &'a Library, id: &str) -> Vec<&'a str> {
    let wanted = id.to_lowercase();
    let mut near: Vec<(usize, &str)> = library
        .textures
        .iter()
        .filter_map(|texture| {
            let distance = edits(&wanted, &texture.id.to_lowercase());
            let is_part = wanted.len() > 2 && texture.id.contains(&wanted);
            let is_near = distance <= 1 + wanted.chars().count() / 3;
            (is_part || is_near).then_some((if is_part { 0 } else { distance }, texture.id.as_str()))
        })
        .collect();
    near.sort_unstable();
    near.into_iter().take(3).map(|(_, id)| id).collect()
}

/// Letters to insert, delete or replace to make one word of the other (Levenshtein).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{edits, parse_point};

    #[test]
    fn edits_are_counted() {
        for (a, b, n) in
            [("", "", 0), ("cork", "cork", 0), ("crok", "cork", 2), ("", "abc", 3), ("kitten", "sitting", 3)]
        {
            assert_eq!((edits(a, b), edits(b, a)), (n, n), "{a} {b}");
        }
    }

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
