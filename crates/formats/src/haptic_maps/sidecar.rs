//! Description of maps in numbers, as a file beside the pictures.

use serde::{Deserialize, Serialize};

use crate::haptic_maps::{FRICTION_PIXELS, HeightSource, Maps, SUFFIXES};
use crate::library::{DIGITS, digits};

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-maps";
/// Version of the description.
const VERSION: &str = "1.0";

/// Description of the maps of a texture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapsV1 {
    /// [`FORMAT`].
    pub format: String,
    /// Version of the description.
    pub version: String,
    /// Name of the texture.
    pub name: String,
    /// Where the texture comes from.
    pub origin: String,
    /// Terms of use.
    pub license: String,
    /// The program that wrote it, with its version.
    pub created_by: String,
    /// File with the vertices of the square.
    pub vertices: String,
    /// The height map.
    pub height: HeightMapV1,
    /// The friction map, if friction is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<FrictionMapV1>,
    /// Contact stiffness at 1 N, in N/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_n_per_m: Option<f64>,
}

/// Description of a height map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightMapV1 {
    /// Picture with 16 bits of gray.
    pub picture: String,
    /// Pixels along a side.
    pub pixels: usize,
    /// Side of the square in mm. x points to the right and y up.
    pub side_mm: f64,
    /// Size of a pixel in mm.
    pub mm_per_pixel: f64,
    /// Height of black in µm.
    pub black_um: f64,
    /// Height of white in µm.
    pub white_um: f64,
    /// Whether the picture continues on itself at opposite edges.
    pub tiles: bool,
    /// `height map` of the texture, or `simulated`: the surface from which its vibration was simulated.
    pub source: String,
    /// Normal force in N at which the contact patch has its radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Power of the tip speed that the acceleration follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_exponent: Option<f64>,
    /// Radius of the contact patch in mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub patch_radius_mm: Option<f64>,
}

/// Description of a friction map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrictionMapV1 {
    /// Picture with 16 bits of gray.
    pub picture: String,
    /// Pixels along a side.
    pub pixels: usize,
    /// Kinetic friction coefficient of black.
    pub black: f64,
    /// Kinetic friction coefficient of white.
    pub white: f64,
    /// Kinetic friction coefficient, the same everywhere.
    pub coefficient: f64,
    /// Static over kinetic coefficient, if the texture sticks and slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_ratio: Option<f64>,
    /// Stribeck speed in mm/s, if the texture sticks and slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stribeck_mm_per_s: Option<f64>,
}

/// Describes the maps of a texture; `stem` is the name of the scene without ending.
pub(super) fn describe(maps: &Maps, stem: &str, created_by: &str) -> MapsV1 {
    let [_, vertices, height, _, friction] = SUFFIXES.map(|suffix| format!("{stem}{suffix}"));
    let n = maps.heights_m.len().isqrt();
    let short = |value: f64| digits(value, DIGITS);
    let end =
        |pick: fn(f64, f64) -> f64, begin: f64| short(1e6 * maps.heights_m.iter().copied().fold(begin, pick));
    let (source, options) = match maps.source {
        HeightSource::HeightMap(options) => ("height map", Some(options)),
        HeightSource::Simulated => ("simulated", None),
    };
    let side_mm = 1e3 * maps.side_m;
    let height = HeightMapV1 {
        picture: height,
        pixels: n,
        side_mm: short(side_mm),
        mm_per_pixel: short(side_mm / n as f64),
        black_um: end(f64::min, f64::INFINITY),
        white_um: end(f64::max, f64::NEG_INFINITY),
        tiles: true,
        source: source.to_owned(),
        force_n: options.map(|options| short(options.force.0)),
        speed_exponent: options.map(|options| short(options.speed_exponent)),
        patch_radius_mm: options.map(|options| short(1e3 * options.patch_radius_m)),
    };
    let friction = maps.friction.map(|coefficient| FrictionMapV1 {
        picture: friction,
        pixels: FRICTION_PIXELS,
        black: 0.0,
        // Programs that read texels from 0 to 1 as coefficients are right for almost all textures.
        white: coefficient.ceil().max(1.0),
        coefficient: short(coefficient),
        static_ratio: maps.stick_slip.map(|friction| short(friction.static_ratio)),
        stribeck_mm_per_s: maps.stick_slip.map(|friction| short(friction.stribeck_speed.mm_per_s())),
    });
    MapsV1 {
        format: FORMAT.to_owned(),
        version: VERSION.to_owned(),
        name: maps.name.clone(),
        origin: maps.origin.clone(),
        license: maps.license.clone(),
        created_by: created_by.to_owned(),
        vertices,
        height,
        friction,
        stiffness_n_per_m: maps.stiffness_n_per_m.map(short),
    }
}
