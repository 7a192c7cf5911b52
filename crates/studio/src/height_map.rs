//! Reliefs from photos and pictures of heights: height maps of textures, in a size that the user states.

mod followed;
mod project;
#[cfg(test)]
mod tests;

use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;

use anyhow::{Context as _, anyhow, bail};
use shagreen_core::texture::height_map::{HeightMap, HeightMapError, HeightMapOptions};
use shagreen_core::texture::relief::MAX_MPS2;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::height_picture::{HeightPictureError, HeightScale, PictureTile};
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::picture::Picture;
use shagreen_formats::text_limits::{MAX_NOTES, begin_and_end};

use crate::file;
use crate::height_map::followed::impossible;
use crate::near_names::unknown_texture;
use crate::report::Reporter;

pub use crate::height_map::project::{ReliefPlace, join_relief};

/// Valid sides of the surface in the central square of a picture, in mm. The tile of a height map has at least 1 mm, and
/// a picture without seams loses a ninth of its side.
pub const SIDES_MM: RangeInclusive<f64> = 1.2..=1000.0;
/// Valid heights of white above black, in µm. Heights of a height map are at most 10 mm from their mean.
pub const HEIGHTS_UM: RangeInclusive<f64> = 0.01..=10_000.0;
/// Begin of the sentence about a relief in the description of its texture.
const ABOUT: &str = "Relief from a picture: ";

/// Size of the surface in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReliefSize {
    /// Side of the surface in the central square of the picture, in mm, in [`SIDES_MM`].
    pub side_mm: f64,
    /// Height of white above black, in µm, in [`HEIGHTS_UM`]. If the picture
    /// [is stretched](PictureTile::is_stretched), that of its highest pixel above its lowest one.
    pub height_um: f64,
}

/// Why a size gives no height map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReliefSizeError {
    /// The side is out of range.
    #[error(
        "the side of the picture is {side_mm} mm; it must be {} to {} mm",
        SIDES_MM.start(), SIDES_MM.end()
    )]
    Side {
        /// Side in mm.
        side_mm: f64,
    },
    /// The height is out of range.
    #[error(
        "the height of white above black is {height_um} µm; it must be {} to {} µm",
        HEIGHTS_UM.start(), HEIGHTS_UM.end()
    )]
    Height {
        /// Height in µm.
        height_um: f64,
    },
    /// Neighboring heights differ so much that a tip would accelerate by more than [`MAX_MPS2`].
    #[error(
        "a height of {height_um} µm is too steep for a side of {side_mm} mm; use at most {most_um} µm, or a side of at least {least_mm} mm"
    )]
    Steep {
        /// Height in µm.
        height_um: f64,
        /// Side in mm.
        side_mm: f64,
        /// Largest height in µm that is possible with this side.
        most_um: f64,
        /// Smallest side in mm that is possible with this height.
        least_mm: f64,
    },
}

/// Relief made from a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureRelief {
    /// Height map with zero mean.
    pub map: HeightMap,
    /// Picture of the tile, which shows the heights where they are felt.
    pub picture: Picture,
    /// Whether the edges of the picture fit together, so that nothing was changed there.
    pub is_seamless: bool,
    /// Whether the picture has colors: it is a photo rather than a measured height map.
    pub is_colored: bool,
    /// How the heights were found, in one sentence.
    pub assumption: String,
    /// Why no tip can follow these heights, in one sentence, if none can.
    pub warning: Option<String>,
}

/// Reads a picture as a relief. What the heights rest on, and a warning that no tip can follow them, are notes.
///
/// # Errors
/// The file cannot be read, is no picture, or gives no height map in this size ([`ReliefSizeError`]).
pub fn of_picture(
    path: &Path,
    size: ReliefSize,
    options: HeightMapOptions,
    reporter: &dyn Reporter,
) -> anyhow::Result<PictureRelief> {
    let bytes = file::read_file(path, FileKind::Picture)?;
    let tile = PictureTile::read(&bytes).with_context(|| file::in_file(path))?;
    let relief = relief(&tile, size, options).with_context(|| file::in_file(path))?;
    reporter.note(&relief.assumption);
    if let Some(warning) = &relief.warning {
        reporter.note(warning);
    }
    Ok(relief)
}

/// Returns the relief of a picture in this size. Takes up to some tenths of a second.
///
/// # Errors
/// [`ReliefSizeError`], or an option is out of range.
pub fn relief(
    tile: &PictureTile,
    size: ReliefSize,
    options: HeightMapOptions,
) -> anyhow::Result<PictureRelief> {
    let ReliefSize { side_mm, height_um } = size;
    if !SIDES_MM.contains(&side_mm) {
        return Err(ReliefSizeError::Side { side_mm }.into());
    }
    if !HEIGHTS_UM.contains(&height_um) {
        return Err(ReliefSizeError::Height { height_um }.into());
    }
    let scale = HeightScale { side_m: 1e-3 * side_mm, height_m: 1e-6 * height_um };
    let map = match tile.height_map(scale, options) {
        Err(HeightPictureError::Map(HeightMapError::Steep { mps2, .. })) => {
            return Err(too_steep(size, mps2).into());
        }
        map => map?,
    };
    let picture = tile.picture(scale.side_m)?;
    let PictureTile { is_seamless, is_colored, .. } = *tile;
    let assumption = assumption(tile, height_um);
    let warning = impossible(&map);
    Ok(PictureRelief { map, picture, is_seamless, is_colored, assumption, warning })
}

/// Returns a texture with this relief, with the picture of the relief, and with what its heights rest on in its
/// description. A height map that is replaced is a warning, another picture that is replaced is a note.
///
/// # Errors
/// It is a texture path.
pub fn with_relief(
    entry: &TextureEntry,
    relief: &PictureRelief,
    reporter: &dyn Reporter,
) -> anyhow::Result<TextureEntry> {
    if entry.path.is_some() {
        bail!(
            "\"{}\" is a texture path, which cannot have a height map; add it to the textures that the path is made from, then make the path again",
            entry.id
        );
    }
    if entry.model.height_map().is_some() {
        reporter.warn(&format!("\"{}\" already has a height map, which is replaced", entry.id));
    } else if entry.picture.is_some() {
        reporter.note(&format!("the picture of \"{}\" is replaced by that of the relief", entry.id));
    }
    Ok(TextureEntry {
        model: entry.model.clone().with_height_map(Some(Arc::new(relief.map.clone()))),
        picture: Some(relief.picture.clone()),
        description: described(&entry.description, &relief.assumption),
        ..entry.clone()
    })
}

/// Gives a texture of a library this relief ([`with_relief`]).
///
/// # Errors
/// The library has no such texture, or it is a texture path.
pub fn add_to_texture(
    library: &mut Library,
    id: &str,
    relief: &PictureRelief,
    reporter: &dyn Reporter,
) -> anyhow::Result<()> {
    let index = library.index_of(id).ok_or_else(|| anyhow!(unknown_texture(library, id)))?;
    let entry = &mut library.textures[index];
    *entry = with_relief(entry, relief, reporter)?;
    Ok(())
}

/// The largest height and the smallest side that are possible where an upper bound of the acceleration is too large: it is
/// proportional to the height and to the inverse square of the side.
fn too_steep(size: ReliefSize, mps2: f64) -> ReliefSizeError {
    let ReliefSize { side_mm, height_um } = size;
    let excess = mps2 / MAX_MPS2;
    // Rounded to the safe side.
    let most_um = (height_um / excess * 10.0).floor() / 10.0;
    let least_mm = (side_mm * excess.sqrt() * 10.0).ceil() / 10.0;
    ReliefSizeError::Steep { height_um, side_mm, most_um, least_mm }
}

fn assumption(tile: &PictureTile, height_um: f64) -> String {
    let source = if tile.is_colored {
        "the heights are assumed, not measured: the brightness of the photo"
    } else if tile.is_stretched {
        "the number in each pixel of the picture"
    } else {
        "the gray value of the picture"
    };
    let [low, high] = if tile.is_stretched { ["lowest", "highest"] } else { ["black", "white"] };
    let edges = if tile.is_seamless {
        "its edges fit together"
    } else {
        "its edges do not fit together, so its slope was removed and its borders were faded into each other"
    };
    format!("{source} is the height, from 0 µm ({low}) to {height_um} µm ({high}); {edges}")
}

/// A description with the sentence about a relief, in place of an earlier one. A long description is shortened before it.
fn described(description: &str, assumption: &str) -> String {
    let before = description.split(ABOUT).next().unwrap_or_default().trim_end();
    begin_and_end(before, &format!("{ABOUT}{assumption}."), MAX_NOTES)
}
