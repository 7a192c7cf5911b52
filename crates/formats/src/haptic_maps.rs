//! Height and friction maps of a texture: pictures, a glTF scene that refers to them, and a description of their units.
//!
//! | file | content |
//! |---|---|
//! | `NAME.gltf` | a square with a haptic material (glTF 2.0, extension `MPEG_haptic_material`) |
//! | `NAME.bin` | vertices of the square |
//! | `NAME.height.png` | heights, 16-bit gray |
//! | `NAME.maps.json` | size, height range and friction range of the pictures ([`MapsV1`]) |
//! | `NAME.friction.png` | friction coefficient, 16-bit gray; only if it is known |
//!
//! The extension is of ISO/IEC 23090-14. It says which picture is which, but not what a texel means; that is in `extras` and in
//! `NAME.maps.json`.

mod check;
mod faults;
mod scene;
mod sidecar;
pub(crate) mod uri;

use shagreen_core::texture::height_map::HeightMapOptions;
use shagreen_core::texture::stick_slip::StickSlip;

use crate::layout;
use crate::library::TextureEntry;
use crate::picture::{PictureError, encode_heights, encode_levels};
use crate::texture_parts::{Part, lost_description, lost_parts};

pub use crate::haptic_maps::check::{CheckedGltf, GltfError, ReferredFile, check_gltf};
pub use crate::haptic_maps::faults::GltfFault;
pub use crate::haptic_maps::sidecar::{FORMAT, FrictionMapV1, HeightMapV1, MapsV1};

/// Pixels along a side of the friction map: its coefficient is the same everywhere.
const FRICTION_PIXELS: usize = 16;

/// Ending of the scene.
pub const SCENE: &str = "gltf";
/// What follows the name in each file name: first the files that are always written, the scene as the first, then the
/// friction map.
pub const SUFFIXES: [&str; 5] = ["", ".bin", ".height.png", ".maps.json", ".friction.png"];

/// Where heights come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HeightSource {
    /// The height map of the texture, and how a tip follows it.
    HeightMap(HeightMapOptions),
    /// The surface from which the vibration of the texture was simulated.
    Simulated,
}

/// Maps of a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Maps {
    /// Name of the texture.
    pub name: String,
    /// Where the texture comes from; may be empty.
    pub origin: String,
    /// Terms of use; may be empty.
    pub license: String,
    /// Heights in m, row by row from the upper left of the picture, as many rows as columns.
    pub heights_m: Vec<f64>,
    /// Side of the square in m; it repeats in both directions.
    pub side_m: f64,
    /// Where the heights come from.
    pub source: HeightSource,
    /// Kinetic friction coefficient, if it is known.
    pub friction: Option<f64>,
    /// Friction over tip speed, if the texture sticks and slips.
    pub stick_slip: Option<StickSlip>,
    /// Contact stiffness at 1 N in N/m, if it is known.
    pub stiffness_n_per_m: Option<f64>,
}

/// Returns the files of maps in the order of [`SUFFIXES`], each with its suffix. `stem` is the name of the scene without
/// ending, to which the scene refers, and `created_by` the program with its version.
///
/// # Errors
/// [`PictureError`] if there are not as many rows as columns.
pub fn map_files(
    maps: &Maps,
    stem: &str,
    created_by: &str,
) -> Result<Vec<(&'static str, Vec<u8>)>, PictureError> {
    let n = maps.heights_m.len().isqrt();
    let height = encode_heights(&maps.heights_m, n)?;
    let described = sidecar::describe(maps, stem, created_by);
    let friction = described
        .friction
        .as_ref()
        .map(|friction| encode_levels(&friction_levels(friction), FRICTION_PIXELS));
    let [scene, bin] = scene::scene(&described);
    let json = layout::to_bytes(&described, 1);
    let always = [scene, bin, height, json];
    Ok(SUFFIXES.into_iter().zip(always.into_iter().chain(friction.transpose()?)).collect())
}

/// Levels of a picture with the same friction coefficient everywhere.
fn friction_levels(friction: &FrictionMapV1) -> Vec<u16> {
    let share = friction.coefficient / friction.white;
    vec![(share * f64::from(u16::MAX)).round() as u16; FRICTION_PIXELS * FRICTION_PIXELS]
}

/// Lists the properties of a texture that maps cannot hold.
pub fn lost_in_maps(entry: &TextureEntry) -> Vec<String> {
    let mut lost = vec![
        "the vibration over tip speed and normal force (grain): maps hold heights and friction only"
            .to_owned(),
    ];
    // Without the grain, its direction is lost with it.
    let kept = [Part::HeightMap, Part::StickSlip, Part::PhysicalLabels, Part::Direction, Part::Terms];
    lost.extend(lost_parts(entry, &kept));
    lost.extend(lost_description(entry));
    if entry.physical.is_some() {
        lost.push("the physical label of roughness".to_owned());
    }
    lost
}

#[cfg(test)]
mod tests;
