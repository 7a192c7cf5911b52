//! File format of a project, versions 1.0 to 1.3.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::library::CoordinatesV1;
use crate::library::v1::{AttributesV1, LibraryV1, PictureV1, SpaceV1, TextureV1};

#[derive(Serialize, Deserialize)]
pub(super) struct ProjectV1 {
    pub(super) format: String,
    pub(super) version: String,
    pub(super) units: UnitsV1,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) created_by: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) notes: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) axes: Option<Vec<String>>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) renamed: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub(super) starred: BTreeSet<String>,
    #[serde(default)]
    pub(super) selected: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) solo: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) compared: Option<[u32; 2]>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
    pub(super) authored: Vec<AuthoredV1>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) snapshots: Vec<AuthoredV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) space: Option<PlacedSpaceV1>,
    // Large parts last, so that the authored textures precede their source data.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) joined: Vec<TextureV1>,
    pub(super) library: ProjectLibraryV1,
}

#[derive(Serialize, Deserialize)]
pub(super) struct UnitsV1 {
    pub(super) length: String,
    pub(super) time: String,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

/// Exactly one of `built_in`, `file` and `inside`; `sha256` belongs to `file`.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct ProjectLibraryV1 {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) built_in: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) file: Option<Value>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) sha256: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) inside: Option<Box<LibraryV1>>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct AuthoredV1 {
    pub(super) key: u32,
    pub(super) name: String,
    #[serde(default)]
    pub(super) color: u8,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) notes: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) tags: Vec<String>,
    #[serde(flatten)]
    pub(super) at: CoordinatesV1,
    /// Since 1.3, of a snapshot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) axes: Option<Vec<String>>,
    pub(super) blend: BlendV1,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) shape: Option<ShapeV1>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) path: Option<DrawnPathV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) picture: Option<PictureV1>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct BlendV1 {
    pub(super) mode: String,
    pub(super) weights: String,
    pub(super) outside: String,
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub(super) locked: BTreeSet<String>,
}

/// Values that are not neutral.
#[derive(Serialize, Deserialize)]
pub(super) struct ShapeV1 {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) level_db: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) grain: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) brightness_db_per_octave: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) softness: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) friction: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) relief: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) direction_deg: Option<f64>,
    #[serde(flatten)]
    pub(super) unknown: Map<String, Value>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct DrawnPathV1 {
    pub(super) along: String,
    pub(super) at_end: String,
    pub(super) length_mm: f64,
    pub(super) length_s: f64,
    pub(super) points: Vec<Vec<f64>>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct PlacedSpaceV1 {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) axes: Option<Vec<String>>,
    pub(super) textures: Vec<PlacedTextureV1>,
    pub(super) report: Value,
}

#[derive(Serialize, Deserialize)]
pub(super) struct PlacedTextureV1 {
    pub(super) id: String,
    pub(super) space: SpaceV1,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) attributes: Option<AttributesV1>,
}
