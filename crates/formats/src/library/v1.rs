//! File format of a library, versions 1.0 to 1.9.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::library::coordinates::CoordinatesV1;

#[derive(Serialize, Deserialize)]
pub(crate) struct LibraryV1 {
    pub(super) format: String,
    pub(super) version: String,
    pub(super) units: UnitsV1,
    pub(super) name: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) description: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) origin: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) licence: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) created_by: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) seed: Option<u64>,
    /// Since 1.3; another number of names than two since 1.8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) axes: Option<Vec<String>>,
    /// Since 1.2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) space_report: Option<Value>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
    // Last, so that the library's metadata precedes the long list.
    pub(super) textures: Vec<TextureV1>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct UnitsV1 {
    pub(super) speed: String,
    pub(super) force: String,
    pub(super) acceleration: String,
    pub(super) rate: String,
    pub(super) lsf: String,
    pub(super) length: String,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct TextureV1 {
    pub(crate) id: String,
    pub(super) name: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) tags: Vec<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) licence: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) origin: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) description: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) space: Option<SpaceV1>,
    /// Since 1.2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) attributes: Option<AttributesV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) physical: Option<PhysicalV1>,
    /// Since 1.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) provenance: Option<String>,
    pub(super) rate_hz: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) mu: Option<f64>,
    /// Since 1.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) interpolation: Option<String>,
    /// Since 1.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) tap: Option<TapV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) stick_slip: Option<StickSlipV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) turn_deg: Option<f64>,
    #[serde(flatten)]
    pub(crate) unknown: Map<String, Value>,
    pub(super) anchors: Vec<AnchorV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) anchors_along: Option<Vec<AnchorV1>>,
    /// Since 1.4.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) path: Option<PathV1>,
    /// Since 1.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) relief: Option<ReliefV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) height_map: Option<HeightMapV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) picture: Option<PictureV1>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct PathV1 {
    pub(super) along: String,
    pub(super) at_end: String,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
    pub(super) keys: Vec<KeyV1>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct KeyV1 {
    pub(super) along: f64,
    #[serde(flatten)]
    pub(super) at: CoordinatesV1,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) stop: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) mu: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) tap: Option<TapV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) stick_slip: Option<StickSlipV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) turn_deg: Option<f64>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
    pub(super) anchors: Vec<AnchorV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) anchors_along: Option<Vec<AnchorV1>>,
    /// Since 1.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) relief: Option<ReliefV1>,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) height_map: Option<HeightMapV1>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct ReliefV1 {
    pub(super) step_mm: f64,
    pub(super) force_n: f64,
    pub(super) mps2: Vec<f64>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

/// A height map of `n` by `n` heights: integers of 16 bits, little endian, in steps of `step_m`, row by row.
#[derive(Serialize, Deserialize)]
pub(super) struct HeightMapV1 {
    pub(super) side_mm: f64,
    pub(super) n: usize,
    pub(super) force_n: f64,
    pub(super) speed_exponent: f64,
    pub(super) patch_radius_mm: f64,
    pub(super) step_m: f64,
    pub(super) base64: String,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct StickSlipV1 {
    pub(super) static_ratio: f64,
    pub(super) stribeck_mm_per_s: f64,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct SpaceV1 {
    #[serde(flatten)]
    pub(super) at: CoordinatesV1,
    pub(super) label_source: String,
    /// Since 1.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) sd: Option<[f64; 2]>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct AttributesV1 {
    pub(super) label_source: String,
    pub(super) values: Vec<AttributeV1>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct AttributeV1 {
    pub(super) name: String,
    pub(super) value: f64,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct PhysicalV1 {
    pub(super) roughness_log10_mps2: f64,
    pub(super) hardness_log10_n_per_m: f64,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct TapV1 {
    pub(super) frequency_hz: f64,
    pub(super) decay_per_s: f64,
    pub(super) amplitude_mps2: f64,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

/// An anchor: a measured one has a level. A published one (since 1.1) has variance, gain and MA frequencies instead.
#[derive(Serialize, Deserialize)]
pub(super) struct AnchorV1 {
    pub(super) speed_mm_per_s: f64,
    pub(super) force_n: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) level_mps2: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) variance: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) gain: Option<f64>,
    pub(super) lsf: Vec<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) ma_lsf: Option<Vec<f64>>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct PictureV1 {
    pub(super) media_type: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) millimeters: f64,
    pub(super) base64: String,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

/// Identifier of [`crate::library::Provenance::Restricted`].
pub(super) const RESTRICTED: &str = "restricted";

/// Quantities of the format and their units, in the order of [`UnitsV1`].
pub(super) const UNITS: [(&str, &str); 6] = [
    ("speed", "mm/s"),
    ("force", "N"),
    ("acceleration", "m/s^2"),
    ("rate", "Hz"),
    ("lsf", "rad"),
    ("length", "mm"),
];
