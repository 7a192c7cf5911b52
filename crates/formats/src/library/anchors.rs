//! Conversion between the anchors of a file and the nodes of a model.

use serde_json::{Map, Value};
use shagreen_core::texture::{
    Grain, GrainNode, Interpolation, PublishedNode, TextureModel, TextureModelError,
};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use crate::library::LibraryError;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, digits, frequencies};
use crate::library::v1::AnchorV1;

/// Identifiers of the interpolation modes; the first is the default.
const BARYCENTRIC: &str = "barycentric";
const RADIAL_BASIS: &str = "radial_basis";
const PUBLISHED: &str = "published";

/// Names of the lists of anchors, for messages.
const ANCHORS: &str = "anchors";
const ALONG: &str = "anchors_along";

/// Nodes that are read but not validated.
pub(super) struct UncheckedGrain(Grain);

impl UncheckedGrain {
    /// Validates the nodes and returns the model.
    pub(super) fn model(self, rate: Hertz, mu: Option<f64>) -> Result<TextureModel, TextureModelError> {
        match self.0 {
            Grain::Measured { nodes, interpolation } => {
                TextureModel::new(rate, nodes, mu)?.with_interpolation(interpolation)
            }
            Grain::Published { nodes } => TextureModel::published(rate, nodes, mu),
        }
    }
}

/// Converts the anchors of a texture to nodes. `unknown` receives the unknown fields of each node; it stays empty if
/// there are none.
pub(super) fn grain(
    id: &str,
    interpolation: Option<&str>,
    anchors: Vec<AnchorV1>,
    unknown: &mut Vec<Map<String, Value>>,
) -> Result<UncheckedGrain, LibraryError> {
    let interpolation = match interpolation {
        None | Some(BARYCENTRIC) => Some(Interpolation::Barycentric),
        Some(RADIAL_BASIS) => Some(Interpolation::RadialBasis),
        Some(PUBLISHED) => None,
        Some(found) => {
            return Err(LibraryError::Word {
                id: id.to_owned(),
                field: "interpolation",
                found: found.to_owned(),
                expected: "barycentric, radial_basis or published",
            });
        }
    };
    if let Some(interpolation) = interpolation {
        let nodes = measured(id, ANCHORS, anchors, unknown)?;
        return Ok(UncheckedGrain(Grain::Measured { nodes, interpolation }));
    }
    let needed = |value, index, field| needed(value, id, ANCHORS, (index, field));
    let mut rest = Vec::with_capacity(anchors.len());
    let mut nodes = Vec::with_capacity(anchors.len());
    for (index, mut anchor) in anchors.into_iter().enumerate() {
        let (speed, force) = place(&anchor);
        nodes.push(PublishedNode {
            speed,
            force,
            variance: needed(anchor.variance.take(), index, "variance")?,
            gain: needed(anchor.gain.take(), index, "gain")?,
            ar_lsf: std::mem::take(&mut anchor.lsf),
            ma_lsf: anchor.ma_lsf.take().unwrap_or_default(),
        });
        rest.push(without_meaning(anchor));
    }
    keep(rest, unknown);
    Ok(UncheckedGrain(Grain::Published { nodes }))
}

/// Converts the anchors of the grain along the lay to nodes, which are not validated. `unknown` is that of [`grain`].
pub(super) fn nodes_along(
    id: &str,
    anchors: Vec<AnchorV1>,
    unknown: &mut Vec<Map<String, Value>>,
) -> Result<Vec<GrainNode>, LibraryError> {
    measured(id, ALONG, anchors, unknown)
}

fn measured(
    id: &str,
    list: &'static str,
    anchors: Vec<AnchorV1>,
    unknown: &mut Vec<Map<String, Value>>,
) -> Result<Vec<GrainNode>, LibraryError> {
    let mut rest = Vec::with_capacity(anchors.len());
    let mut nodes = Vec::with_capacity(anchors.len());
    for (index, mut anchor) in anchors.into_iter().enumerate() {
        let (speed, force) = place(&anchor);
        let level_mps2 = needed(anchor.level_mps2.take(), id, list, (index, "level_mps2"))?;
        nodes.push(GrainNode { speed, force, lsf: std::mem::take(&mut anchor.lsf), level_mps2 });
        rest.push(without_meaning(anchor));
    }
    keep(rest, unknown);
    Ok(nodes)
}

fn place(anchor: &AnchorV1) -> (MetersPerSecond, Newtons) {
    (MetersPerSecond::from_mm_per_s(anchor.speed_mm_per_s), Newtons(anchor.force_n))
}

fn needed(
    value: Option<f64>,
    id: &str,
    list: &'static str,
    (index, field): (usize, &'static str),
) -> Result<f64, LibraryError> {
    value.ok_or_else(|| LibraryError::Anchor { id: id.to_owned(), list, index, field })
}

/// Keeps the rest of all anchors, if there is any.
fn keep(rest: Vec<Map<String, Value>>, unknown: &mut Vec<Map<String, Value>>) {
    if rest.iter().any(|fields| !fields.is_empty()) {
        *unknown = rest;
    }
}

/// The rest of an anchor after its numbers are taken: unknown fields, and known ones that its interpolation mode does
/// not use.
fn without_meaning(anchor: AnchorV1) -> Map<String, Value> {
    let mut rest = anchor.unknown;
    let numbers = [("level_mps2", anchor.level_mps2), ("variance", anchor.variance), ("gain", anchor.gain)];
    for (field, value) in numbers {
        rest.extend(value.map(|value| (field.to_owned(), value.into())));
    }
    rest.extend(anchor.ma_lsf.map(|lsf| ("ma_lsf".to_owned(), lsf.into())));
    rest
}

/// Identifier of the interpolation mode; `None` for the default.
pub(super) fn interpolation_word(model: &TextureModel) -> Option<&'static str> {
    match model.interpolation() {
        Some(Interpolation::Barycentric) => None,
        Some(Interpolation::RadialBasis) => Some(RADIAL_BASIS),
        None => Some(PUBLISHED),
    }
}

/// Converts the nodes of a model to anchors, with the unknown fields of each.
pub(super) fn anchors(model: &TextureModel, unknown: &[Map<String, Value>]) -> Vec<AnchorV1> {
    match model.grain() {
        Grain::Measured { nodes, .. } => anchors_of(nodes, unknown),
        Grain::Published { nodes } => {
            let anchor = |(index, node): (usize, &PublishedNode)| AnchorV1 {
                variance: Some(digits(node.variance, DIGITS)),
                gain: Some(digits(node.gain, DIGITS)),
                ma_lsf: Some(frequencies(&node.ma_lsf)).filter(|lsf| !lsf.is_empty()),
                unknown: unknown_at(index, nodes.len(), unknown),
                ..bare(node.speed, node.force, &node.ar_lsf)
            };
            nodes.iter().enumerate().map(anchor).collect()
        }
    }
}

/// Converts measured nodes, across or along the lay, to anchors, with the unknown fields of each.
pub(super) fn anchors_of(nodes: &[GrainNode], unknown: &[Map<String, Value>]) -> Vec<AnchorV1> {
    let anchor = |(index, node): (usize, &GrainNode)| AnchorV1 {
        level_mps2: Some(digits(node.level_mps2, DIGITS)),
        unknown: unknown_at(index, nodes.len(), unknown),
        ..bare(node.speed, node.force, &node.lsf)
    };
    nodes.iter().enumerate().map(anchor).collect()
}

fn bare(speed: MetersPerSecond, force: Newtons, lsf: &[f64]) -> AnchorV1 {
    AnchorV1 {
        speed_mm_per_s: digits(speed.mm_per_s(), CONVERSION_DIGITS),
        force_n: digits(force.0, CONVERSION_DIGITS),
        level_mps2: None,
        variance: None,
        gain: None,
        lsf: frequencies(lsf),
        ma_lsf: None,
        unknown: Map::new(),
    }
}

/// Unknown fields of one of `n` nodes. If nodes were added or removed, the unknown fields cannot be assigned to nodes
/// and are dropped.
fn unknown_at(index: usize, n: usize, unknown: &[Map<String, Value>]) -> Map<String, Value> {
    match unknown.get(index) {
        Some(fields) if unknown.len() == n => Map::clone(fields),
        _ => Map::new(),
    }
}
