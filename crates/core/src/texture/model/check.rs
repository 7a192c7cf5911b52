//! Validation of the numbers in a texture model.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use shagreen_synth::texture::Evaluated;
use shagreen_synth::voice::{MAX_TICK, Voice};

use crate::texture::{
    FORCES_N, GAINS, Grain, GrainNode, LEVELS_MPS2, MAX_MA_ORDER, MAX_NODES, MAX_ORDER, MIN_LSF_GAP,
    MIN_NODE_DISTANCE, MIN_PUBLISHED_LSF_GAP, PublishedNode, RATES_HZ, SPEEDS_MPS, TextureModelError,
    VARIANCES,
};
use crate::units::Hertz;

/// Checks the sample rate, the number of nodes and the friction of a measured or published texture.
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

/// Checks measured nodes. They must not lie at zero speed or force, where the boundary is added.
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

/// Checks that the filters of measured nodes are stable in the renderer.
pub(super) fn stable(nodes: &[GrainNode]) -> Result<(), TextureModelError> {
    match nodes.iter().position(|node| !decays(&node.lsf)) {
        Some(index) => Err(TextureModelError::Unstable { index }),
        None => Ok(()),
    }
}

/// Speeds and forces of the grains along and across the lay may differ by this fraction, for values that a file has
/// rounded differently.
const SAME: f64 = 1e-9;

/// Checks the grain along the lay: measured nodes with the speeds, forces and order of the grain across it.
pub(super) fn along(across: &Grain, along: &[GrainNode]) -> Result<(), TextureModelError> {
    let Grain::Measured { nodes: across, .. } = across else {
        return Err(TextureModelError::AlongPublished);
    };
    if along.len() != across.len() {
        return Err(TextureModelError::AlongCount { n: along.len(), expected: across.len() });
    }
    measured(along).map_err(within_along)?;
    for (index, (along, across)) in along.iter().zip(across).enumerate() {
        let order = |node: &GrainNode| node.lsf.len() as f64;
        for (what, value, expected) in [
            ("speed in m/s", along.speed.0, across.speed.0),
            ("force in N", along.force.0, across.force.0),
            ("order", order(along), order(across)),
        ] {
            if (value - expected).abs() > SAME * expected {
                return Err(TextureModelError::Along { what, index, value, expected });
            }
        }
    }
    Ok(())
}

/// Checks that the filters of the grain along the lay are stable in the renderer.
pub(super) fn stable_along(nodes: &[GrainNode]) -> Result<(), TextureModelError> {
    stable(nodes).map_err(within_along)
}

fn within_along(error: TextureModelError) -> TextureModelError {
    TextureModelError::InAlong(Box::new(error))
}

/// Checks published nodes, which must include the boundary.
pub(super) fn published(nodes: &[PublishedNode]) -> Result<(), TextureModelError> {
    let (order, ma_order) = (nodes[0].ar_lsf.len(), nodes[0].ma_lsf.len());
    for (index, node) in nodes.iter().enumerate() {
        if node.ar_lsf.len() != order || order == 0 || order > MAX_ORDER {
            return Err(TextureModelError::Order { index, order: node.ar_lsf.len() });
        }
        if node.ma_lsf.len() != ma_order || ma_order > MAX_MA_ORDER {
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
        if !decays(&node.ar_lsf) {
            return Err(TextureModelError::Unstable { index });
        }
    }
    let places: Vec<[f64; 2]> = nodes.iter().map(|n| [n.speed.0, n.force.0]).collect();
    let [speed_mps, force_n] = highest(&places);
    // The rectangle needs a non-zero extent.
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
    // Written so that NaN fails the test.
    let ends = [0.0, PI];
    let above = ends[..1].iter().chain(lsf).zip(lsf.iter().chain(&ends[1..]));
    above.into_iter().all(|(low, high)| high - low >= gap)
}

/// Length of the tested impulse response, in samples: 4 s of a texture at 4 kHz.
const RESPONSE_SAMPLES: usize = 16_384;
/// Largest valid ratio of the energy of the second half of the response to that of the first half. A pole on the unit
/// circle, within the rounding of `f32`, stays below this ratio; such resonances occur in published models.
const MAX_GROWTH: f64 = 1.5;
/// Energy of one tick of the response, relative to the energy of the first half so far, below which the response counts
/// as decayed.
const DECAYED: f64 = 1e-9;

/// Whether the impulse response of the renderer's filter, in its own precision, does not grow. Ascending line spectral
/// frequencies describe a stable filter, but if many of them are close together, its `f32` coefficients need not be
/// stable.
pub(in crate::texture) fn decays(lsf: &[f64]) -> bool {
    let (own, ma_lsf) = ([0.0; MAX_ORDER], [0.0; MAX_MA_ORDER]);
    let mut at = Evaluated { lsf: own, ma_lsf, ma_order: 0, level_mps2: 1.0, sigma_mps2: 1.0 };
    for (to, from) in at.lsf.iter_mut().zip(lsf) {
        *to = *from as f32;
    }
    let mut voice = Voice::new();
    // The second call begins a tick of constant level.
    voice.aim(lsf.len(), &at);
    voice.aim(lsf.len(), &at);
    let mut halves = [0.0_f64; 2];
    for start in (0..RESPONSE_SAMPLES).step_by(MAX_TICK) {
        let mut impulse = [0.0; MAX_TICK];
        impulse[0] = if start == 0 { 1.0 } else { 0.0 };
        let mut response = [0.0; MAX_TICK];
        voice.add_tick(&impulse, (1.0, 1.0), &mut response);
        let energy: f64 = response.iter().map(|y| f64::from(*y).powi(2)).sum();
        if !energy.is_finite() {
            return false;
        }
        halves[usize::from(start >= RESPONSE_SAMPLES / 2)] += energy;
        if energy <= DECAYED * halves[0] {
            return true;
        }
    }
    halves[1] <= MAX_GROWTH * halves[0]
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

/// Node coordinates in units of the minimum distance.
struct InColumn {
    column: i64,
    x: f64,
    y: f64,
    index: usize,
}

/// Checks that all nodes keep the minimum distance.
fn apart_in_plane(places: &[[f64; 2]], highest: [f64; 2]) -> Result<(), TextureModelError> {
    // Nodes are sorted into columns of one minimum distance, by height within each column. A node that is too close is
    // then the next one in its column, or is in the column to the right.
    let in_column = |(index, place): (usize, &[f64; 2])| {
        let [x, y] = [0, 1].map(|axis| place[axis] / highest[axis] / MIN_NODE_DISTANCE);
        InColumn { column: x as i64, x, y, index }
    };
    let mut ordered: Vec<InColumn> = places.iter().enumerate().map(in_column).collect();
    ordered.sort_by(|a, b| a.column.cmp(&b.column).then(a.y.total_cmp(&b.y)));
    for (i, node) in ordered.iter().enumerate() {
        let rest = &ordered[i + 1..];
        let is_right = |other: &InColumn| other.column == node.column + 1;
        let is_before =
            |other: &InColumn| other.column <= node.column || (is_right(other) && other.y <= node.y - 1.0);
        let above = rest.first().filter(|other| other.column == node.column);
        let right = rest[rest.partition_point(is_before)..].iter();
        let right = right.take_while(|other| is_right(other) && other.y < node.y + 1.0);
        let is_near = |other: &&InColumn| (node.x - other.x).abs().max((node.y - other.y).abs()) < 1.0;
        if let Some(other) = above.into_iter().chain(right).find(is_near) {
            let (first, second) = (node.index.min(other.index), node.index.max(other.index));
            return Err(TextureModelError::SamePlace { first, second });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{MIN_NODE_DISTANCE, apart_in_plane, decays};
    use proptest::prelude::{Strategy, prop, prop_assert, prop_assert_eq, prop_assume, proptest};

    #[test]
    fn a_filter_that_would_grow_in_the_renderer_is_found() {
        let apart =
            |n: u8, from: f64, gap: f64| -> Vec<f64> { (0..n).map(|i| from + gap * f64::from(i)).collect() };
        // Ten frequencies 0.01 rad apart are a stable filter in exact numbers only.
        assert!(!decays(&apart(10, 0.5, 0.01)));
        assert!(decays(&apart(10, 0.25, 0.28)));
        // A resonance that decays over a second is none of them.
        assert!(decays(&[0.5, 0.501, 1.5, 2.0, 2.5, 3.0]));
        assert!(decays(&[1.0]) && decays(&[1e-4, 3.1]));
    }

    /// Ascending frequencies, often in tight clusters.
    fn frequencies(order: usize) -> impl Strategy<Value = Vec<f64>> {
        let gap = (-3.0_f64..0.0, 0.0_f64..1.0).prop_map(|(low, share)| 10_f64.powf(low) * (0.1 + share));
        prop::collection::vec(gap, order + 1).prop_map(|gaps| {
            let sum: f64 = gaps.iter().sum();
            let mut at = 0.0;
            let next = |gap: &f64| {
                at += gap * std::f64::consts::PI / sum;
                at
            };
            gaps[..gaps.len() - 1].iter().map(next).collect()
        })
    }

    proptest! {
        /// Why blends are not tested again.
        #[test]
        fn means_of_stable_frequencies_are_stable(
            (a, b, c) in (1_usize..=32).prop_flat_map(|n| (frequencies(n), frequencies(n), frequencies(n))),
            shares in (0.0_f64..1.0, 0.0_f64..1.0),
        ) {
            prop_assume!(decays(&a) && decays(&b) && decays(&c));
            let w = [shares.0, (1.0 - shares.0) * shares.1, (1.0 - shares.0) * (1.0 - shares.1)];
            let mean: Vec<f64> = (0..a.len()).map(|i| w[0] * a[i] + w[1] * b[i] + w[2] * c[i]).collect();
            prop_assert!(decays(&mean));
        }

        #[test]
        fn whoever_is_too_near_is_found(
            cells in prop::collection::vec((0_u8..12, 0_u8..12, 0.0_f64..1.0, 0.0_f64..1.0), 1..30)
        ) {
            let place = |(i, j, x, y): &(u8, u8, f64, f64)| {
                [f64::from(*i) + x, f64::from(*j) + y].map(|cell| cell * MIN_NODE_DISTANCE)
            };
            let places: Vec<[f64; 2]> = cells.iter().map(place).collect();
            let is_near = |a: &[f64; 2], b: &[f64; 2]| {
                let apart = |axis: usize| (a[axis] / MIN_NODE_DISTANCE - b[axis] / MIN_NODE_DISTANCE).abs();
                apart(0).max(apart(1)) < 1.0
            };
            let any = (0..places.len()).any(|i| places[..i].iter().any(|b| is_near(&places[i], b)));
            prop_assert_eq!(apart_in_plane(&places, [1.0, 1.0]).is_err(), any);
        }
    }
}
