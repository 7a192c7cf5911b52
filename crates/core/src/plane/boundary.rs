//! The boundary around measured nodes: silence at zero speed or force, copies along the edges of full speed and force.

use crate::plane::values::Values;
use crate::texture::GrainNode;
use crate::triangulation::Xy;

// The boundary, and its spacings in mm/s and N, are those of H. Culbertson, J. Unwin and K. Kuchenbecker, "Modeling and
// rendering realistic textures from unconstrained tool-surface interactions" (2014).
/// Spacing of silent models along the axis of zero force, in m/s.
const SPEED_STEP_MPS: f64 = 0.040;
/// Spacing of silent models along the axis of zero speed, in N, after the first at [`FIRST_FORCE_N`].
const FORCE_STEP_N: f64 = 1.25;
/// First silent model on the axis of zero speed, in N.
const FIRST_FORCE_N: f64 = 0.5;

/// Points of the boundary around `nodes`, which lie at `measured`, and what is there: places in shares of the highest
/// speed and force.
pub(super) fn boundary(
    nodes: &[GrainNode],
    measured: &[Xy],
    speed_max_mps: f64,
    force_max_n: f64,
) -> Vec<(Xy, Values)> {
    // A boundary model has the spectrum of the measured one nearest in mm/s and N.
    let nearest = |speed_mps: f64, force_n: f64| {
        let distance = |node: &GrainNode| (1e3 * (node.speed.0 - speed_mps)).hypot(node.force.0 - force_n);
        nodes.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(&nodes[0])
    };
    let speeds = steps(speed_max_mps, SPEED_STEP_MPS, SPEED_STEP_MPS);
    let forces = steps(force_max_n, FIRST_FORCE_N, FORCE_STEP_N);
    let silent = speeds.iter().map(|v| [*v, 0.0]).chain(forces.iter().map(|f| [0.0, *f])).chain([[0.0, 0.0]]);
    let silence = |[v, f]: [f64; 2]| {
        ([v / speed_max_mps, f / force_max_n], Values::measured(nearest(v, f).lsf.clone(), 0.0))
    };
    let mut out: Vec<(Xy, Values)> = silent.map(silence).collect();
    // Copies along the far edges, but where something was measured on the edge close by.
    let far = forces.iter().map(|f| [speed_max_mps, *f]).chain(speeds.iter().map(|v| [*v, force_max_n]));
    for [v, f] in far {
        let at = [v / speed_max_mps, f / force_max_n];
        let reach = [SPEED_STEP_MPS / speed_max_mps, FORCE_STEP_N / force_max_n];
        let is_corner = at == [1.0, 1.0];
        let is_near = |p: &Xy| {
            (at[0] == 1.0 && p[0] == 1.0 && (p[1] - at[1]).abs() < reach[1])
                || (at[1] == 1.0 && p[1] == 1.0 && (p[0] - at[0]).abs() < reach[0])
        };
        let taken = measured.iter().any(|p| *p == at || (!is_corner && is_near(p)))
            || out.iter().any(|(p, _)| *p == at);
        if !taken {
            let node = nearest(v, f);
            out.push((at, Values::measured(node.lsf.clone(), node.level_mps2)));
        }
    }
    out
}

/// `first, first + step, …` below `max` by more than a hundredth of a step, and `max` itself.
fn steps(max: f64, first: f64, step: f64) -> Vec<f64> {
    let below = max - 0.01 * step;
    let mut out: Vec<f64> =
        (0..1000).map(|i| first + step * f64::from(i)).take_while(|x| *x < below).collect();
    out.push(max);
    out
}
