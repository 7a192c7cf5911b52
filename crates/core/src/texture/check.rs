//! What the numbers of a texture must keep.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use crate::texture::{
    FORCES_N, GAINS, GrainNode, LEVELS_MPS2, MAX_NODES, MAX_ORDER, MIN_LSF_GAP, MIN_NODE_DISTANCE,
    MIN_PUBLISHED_LSF_GAP, PublishedNode, RATES_HZ, SPEEDS_MPS, TextureModelError, VARIANCES,
};
use crate::units::Hertz;

/// What measured and published textures share.
pub(super) fn frame(rate: Hertz, n_nodes: usize, friction: Option<f64>) -> Result<(), TextureModelError> {
    if !RATES_HZ.contains(&rate.0) {
        return Err(TextureModelError::Rate { rate_hz: rate.0 });
    }
    if n_nodes == 0 {
        return Err(TextureModelError::Empty);
    }
    if n_nodes > MAX_NODES {
        return Err(TextureModelError::TooMany { n: n_nodes });
    }
    match friction.filter(|f| !(f.is_finite() && *f >= 0.0)) {
        Some(value) => Err(TextureModelError::Friction { value }),
        None => Ok(()),
    }
}

/// Measured nodes: off the axes, where others join them.
pub(super) fn measured(nodes: &[GrainNode]) -> Result<(), TextureModelError> {
    let order = nodes[0].lsf.len();
    for (index, node) in nodes.iter().enumerate() {
        if node.lsf.len() != order || order == 0 || order > MAX_ORDER {
            return Err(TextureModelError::Order { index, order: node.lsf.len() });
        }
        if !are_apart(&node.lsf, MIN_LSF_GAP) {
            return Err(TextureModelError::Frequencies { index });
        }
        in_range("speed in m/s", index, node.speed.0, &SPEEDS_MPS)?;
        in_range("force in N", index, node.force.0, &FORCES_N)?;
        in_range("level in m/s²", index, node.level_mps2, &LEVELS_MPS2)?;
    }
    let places: Vec<[f64; 2]> = nodes.iter().map(|n| [n.speed.0, n.force.0]).collect();
    let highest = highest(&places);
    for (index, [speed_mps, force_n]) in places.iter().enumerate() {
        in_range("speed in m/s", index, *speed_mps, &(MIN_NODE_DISTANCE * highest[0]..=highest[0]))?;
        in_range("force in N", index, *force_n, &(MIN_NODE_DISTANCE * highest[1]..=highest[1]))?;
    }
    apart_in_plane(&places, highest)
}

/// Published nodes: the boundary is among them, and closes the plane.
pub(super) fn published(nodes: &[PublishedNode]) -> Result<(), TextureModelError> {
    let (order, ma_order) = (nodes[0].ar_lsf.len(), nodes[0].ma_lsf.len());
    for (index, node) in nodes.iter().enumerate() {
        if node.ar_lsf.len() != order || order == 0 || order > MAX_ORDER {
            return Err(TextureModelError::Order { index, order: node.ar_lsf.len() });
        }
        if node.ma_lsf.len() != ma_order || ma_order > MAX_ORDER {
            return Err(TextureModelError::MaOrder { index, order: node.ma_lsf.len() });
        }
        for (part, lsf) in [("AR", &node.ar_lsf), ("MA", &node.ma_lsf)] {
            if !are_apart(lsf, MIN_PUBLISHED_LSF_GAP) {
                return Err(TextureModelError::PublishedFrequencies { part, index });
            }
        }
        in_range("speed in m/s", index, node.speed.0, &(0.0..=*SPEEDS_MPS.end()))?;
        in_range("force in N", index, node.force.0, &(0.0..=*FORCES_N.end()))?;
        in_range("variance in (m/s²)²", index, node.variance, &VARIANCES)?;
        in_range("gain", index, node.gain, &GAINS)?;
    }
    let places: Vec<[f64; 2]> = nodes.iter().map(|n| [n.speed.0, n.force.0]).collect();
    let [speed_mps, force_n] = highest(&places);
    // A plane needs an extent.
    in_range("highest speed in m/s", 0, speed_mps, &SPEEDS_MPS)?;
    in_range("highest force in N", 0, force_n, &FORCES_N)?;
    for corner in [[0.0, 0.0], [speed_mps, 0.0], [0.0, force_n], [speed_mps, force_n]] {
        let is_at = |p: &[f64; 2]| {
            (p[0] - corner[0]).abs() < MIN_NODE_DISTANCE * speed_mps
                && (p[1] - corner[1]).abs() < MIN_NODE_DISTANCE * force_n
        };
        if !places.iter().any(is_at) {
            return Err(TextureModelError::Corner { speed_mps: corner[0], force_n: corner[1] });
        }
    }
    apart_in_plane(&places, [speed_mps, force_n])
}

fn are_apart(lsf: &[f64], gap: f64) -> bool {
    // Not written as a comparison of gaps with a bound: what is not a number must be refused.
    let ends = [0.0, PI];
    let above = ends[..1].iter().chain(lsf).zip(lsf.iter().chain(&ends[1..]));
    above.into_iter().all(|(low, high)| high - low >= gap)
}

fn in_range(
    what: &'static str,
    index: usize,
    value: f64,
    range: &RangeInclusive<f64>,
) -> Result<(), TextureModelError> {
    let (low, high) = (*range.start(), *range.end());
    if range.contains(&value) {
        Ok(())
    } else {
        Err(TextureModelError::Value { what, index, value, low, high })
    }
}

fn highest(places: &[[f64; 2]]) -> [f64; 2] {
    places.iter().fold([0.0, 0.0], |[v, f], p| [v.max(p[0]), f.max(p[1])])
}

/// Whether nodes lie far enough from each other.
fn apart_in_plane(places: &[[f64; 2]], highest: [f64; 2]) -> Result<(), TextureModelError> {
    // Columns as wide as the smallest distance, and from bottom to top in each: whoever is too near is the next one in the
    // column, or in the column to the right.
    let at = |place: &[f64; 2]| [0, 1].map(|axis| place[axis] / highest[axis] / MIN_NODE_DISTANCE);
    let mut ordered: Vec<(i64, [f64; 2], usize)> = places
        .iter()
        .enumerate()
        .map(|(index, place)| {
            let at = at(place);
            (at[0] as i64, at, index)
        })
        .collect();
    ordered.sort_by(|a, b| a.0.cmp(&b.0).then(a.1[1].total_cmp(&b.1[1])));
    for (i, (column, at, index)) in ordered.iter().enumerate() {
        let rest = &ordered[i + 1..];
        let is_before = |other: &(i64, [f64; 2], usize)| {
            other.0 <= *column || (other.0 == column + 1 && other.1[1] <= at[1] - 1.0)
        };
        let right = &rest[rest.partition_point(is_before)..];
        let right = right.iter().take_while(|other| other.0 == column + 1 && other.1[1] < at[1] + 1.0);
        let mut near = rest.iter().take_while(|other| other.0 == *column).take(1).chain(right);
        let is_near = |other: &&(i64, [f64; 2], usize)| {
            (at[0] - other.1[0]).abs().max((at[1] - other.1[1]).abs()) < 1.0
        };
        if let Some((_, _, other)) = near.find(is_near) {
            return Err(TextureModelError::SamePlace { first: *index.min(other), second: *index.max(other) });
        }
    }
    Ok(())
}
