//! Validation of the data of a texture.

use super::{
    Along, Excitation, MAX_MA_ORDER, MAX_NODES, MAX_ORDER, NO_NEIGHBOR, Node, Parts, TextureError, Triangle,
};
use crate::stick_slip::Friction;

/// Checks the data of a texture. Relief and height map were checked when they were made.
pub(super) fn parts(parts: &Parts<'_>) -> Result<(), TextureError> {
    let Parts { rate_hz, order, ma_order, speed_max_mps, force_max_n, nodes, excitations, .. } = *parts;
    let positive = |x: f32| x.is_finite() && x > 0.0;
    let is_published = !excitations.is_empty();
    if order == 0 || order > MAX_ORDER || ma_order > MAX_MA_ORDER || (ma_order > 0 && !is_published) {
        return Err(TextureError::Order);
    }
    if !(positive(rate_hz) && positive(speed_max_mps) && positive(force_max_n)) {
        return Err(TextureError::Range);
    }
    plane(nodes, parts.triangles, order)?;
    if is_published && excitations.len() != nodes.len() {
        return Err(TextureError::Excitation);
    }
    let excitation_is_good = |excitation: &Excitation| {
        let Excitation { variance, gain, ma_lsf } = excitation;
        [variance, gain].iter().all(|x| x.is_finite() && **x >= 0.0) && ascends(&ma_lsf[..ma_order])
    };
    if !excitations.iter().all(excitation_is_good) {
        return Err(TextureError::Number);
    }
    if let Some(Along { nodes, triangles }) = parts.along {
        if is_published {
            return Err(TextureError::Along);
        }
        plane(nodes, triangles, order)?;
    }
    let friction_is_good = parts.friction.is_none_or(|friction| {
        let Friction { kinetic, static_ratio, stribeck_speed_mps } = friction;
        [kinetic, static_ratio, stribeck_speed_mps].iter().all(|x| x.is_finite() && *x >= 0.0)
    });
    if !(parts.turn_rad.is_finite() && friction_is_good) {
        return Err(TextureError::Layer);
    }
    Ok(())
}

/// Checks the nodes and triangles of one (speed, force) plane.
fn plane(nodes: &[Node], triangles: &[Triangle], order: usize) -> Result<(), TextureError> {
    let node_is_good =
        |node: &Node| node.level_mps2.is_finite() && node.level_mps2 >= 0.0 && ascends(&node.lsf[..order]);
    if !nodes.iter().all(node_is_good) {
        return Err(TextureError::Number);
    }
    let n_triangles = triangles.len();
    if nodes.len() > MAX_NODES || n_triangles == 0 || n_triangles >= usize::from(NO_NEIGHBOR) {
        return Err(TextureError::Triangle);
    }
    for triangle in triangles {
        let neighbor_is_good = |&t: &u16| t == NO_NEIGHBOR || usize::from(t) < n_triangles;
        if !triangle.nodes.iter().all(|&n| usize::from(n) < nodes.len())
            || !triangle.neighbors.iter().all(neighbor_is_good)
        {
            return Err(TextureError::Triangle);
        }
        if !triangle.weights.iter().chain(&triangle.ln_gain).all(|x| x.is_finite()) {
            return Err(TextureError::Number);
        }
    }
    Ok(())
}

/// Whether frequencies ascend within (0, π); true for an empty slice.
fn ascends(lsf: &[f32]) -> bool {
    lsf.first().is_none_or(|low| *low > 0.0)
        && lsf.last().is_none_or(|high| *high < core::f32::consts::PI)
        && lsf.windows(2).all(|w| w[0] < w[1])
}
