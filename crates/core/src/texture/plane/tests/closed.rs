use proptest::prelude::{prop_assert, proptest};

use crate::texture::plane::Plane;
use crate::texture::test_textures::two_resonances;
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Level in m/s² that is linear in speed in m/s and force in N.
fn linear(speed_mps: f64, force_n: f64) -> f64 {
    speed_mps + 0.1 * force_n
}

/// Speeds in m/s and forces in N whose spacing is wider than that of the published boundary.
const SPEEDS_MPS: [f64; 3] = [0.05, 0.1, 0.2];
const FORCES_N: [f64; 3] = [0.3, 0.8, 1.5];

/// Texture with linear levels on a grid of nodes; each node is moved by a share of `most_mps` and `most_n`.
fn texture([most_mps, most_n]: [f64; 2], moves: &[[f64; 2]]) -> TextureModel {
    let nodes = two_resonances(&SPEEDS_MPS, &FORCES_N).nodes().to_vec();
    let moved = |(node, [v, f]): (GrainNode, &[f64; 2])| {
        let (speed, force) = (node.speed.0 + most_mps * v, node.force.0 + most_n * f);
        let level_mps2 = linear(speed, force);
        GrainNode { speed: MetersPerSecond(speed), force: Newtons(force), level_mps2, ..node }
    };
    TextureModel::new(Hertz(1000.0), nodes.into_iter().zip(moves).map(moved).collect(), None).unwrap()
}

fn level(plane: &Plane, speed_mps: f64, force_n: f64) -> f64 {
    plane.at(Contact { speed: MetersPerSecond(speed_mps), force: Newtons(force_n) }).level_mps2
}

/// Before, the boundary repeated the node at 200 mm/s from 160 mm/s on: 0.35 m/s² instead of 0.31 m/s².
#[test]
fn a_linear_level_on_a_grid_is_linear_up_to_the_highest_speed_and_force() {
    let plane = Plane::new(&texture([0.0; 2], &[[0.0; 2]; 9]));
    for speed_mps in [0.06, 0.075, 0.1, 0.125, 0.15, 0.16, 0.175, 0.19, 0.2] {
        for force_n in [0.3, 0.5, 0.8, 1.2, 1.4, 1.5] {
            let (got, expected) = (level(&plane, speed_mps, force_n), linear(speed_mps, force_n));
            assert!((got / expected - 1.0).abs() < 1e-9, "{got} for {expected} at {speed_mps}, {force_n}");
        }
    }
}

proptest! {
    /// Recordings of the same nominal speed or force differ a little. Before, a node of the lowest force was copied to the
    /// highest force: 0.14 m/s² instead of 0.225 m/s² at 75 mm/s and 1.5 N.
    #[test]
    fn nodes_near_a_grid_have_nearly_the_levels_of_the_grid(
        moves in proptest::collection::vec([-1.0_f64..1.0, -1.0_f64..1.0], 9),
        at in [0.06_f64..0.198, 0.32_f64..1.49],
    ) {
        let plane = Plane::new(&texture([1e-3, 0.01], &moves));
        let (got, expected) = (level(&plane, at[0], at[1]), linear(at[0], at[1]));
        // A value on an edge is that of a contact up to twice the move away: 2 mm/s and 0.02 N, which is 0.004 m/s².
        prop_assert!((got - expected).abs() < 0.005, "{got} for {expected} at {at:?}");
    }
}
