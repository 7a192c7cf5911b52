extern crate std;
use super::{
    Along, Evaluated, Excitation, MAX_MA_ORDER, MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, TextureError,
    Triangle,
};
use crate::contact::{Contact, Place};
use crate::direction::Direction;
use crate::lsf::ar_from_lsf;
use crate::power_gain::ln_power_gain;
use crate::relief::Passage;
use crate::stick_slip::Friction;
use core::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// A model of order 2 on the unit square of 1 m/s and 1 N. Its level is nonzero only at full speed and force.
pub(crate) fn square() -> ([Node; 4], [Triangle; 2]) {
    let node = |level_mps2: f32, low: f32| {
        let mut lsf = [0.0; MAX_ORDER];
        (lsf[0], lsf[1]) = (low, low + 0.2);
        Node { level_mps2, lsf }
    };
    let nodes = [node(0.0, 0.5), node(0.0, 0.7), node(1.0, 0.9), node(0.0, 0.6)];
    let ln_gain = [1.0; 6];
    let triangles = [
        // Corners (0,0) (1,0) (1,1): weights 1 - x, x - y, y.
        Triangle {
            nodes: [0, 1, 2],
            neighbors: [NO_NEIGHBOR, 1, NO_NEIGHBOR],
            weights: [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0],
            ln_gain,
        },
        // Corners (0,0) (1,1) (0,1): weights 1 - y, x, y - x.
        Triangle {
            nodes: [0, 2, 3],
            neighbors: [NO_NEIGHBOR, NO_NEIGHBOR, 0],
            weights: [0.0, -1.0, 1.0, 1.0, 0.0, 0.0],
            ln_gain,
        },
    ];
    (nodes, triangles)
}

/// Texture data of order 2 at 1 kHz over the unit square.
pub(crate) fn parts<'a>(nodes: &'a [Node], triangles: &'a [Triangle]) -> Parts<'a> {
    Parts {
        rate_hz: 1000.0,
        order: 2,
        ma_order: 0,
        speed_max_mps: 1.0,
        force_max_n: 1.0,
        nodes,
        excitations: &[],
        triangles,
        along: None,
        turn_rad: 0.0,
        relief: None,
        height_map: None,
        friction: None,
    }
}

/// Model for a stroke at an angle on the pad.
fn evaluated(texture: &Texture<'_>, speed_mps: f32, force_n: f32, angle_rad: f32) -> Evaluated {
    texture.evaluate(Contact { speed_mps, force_n }, Direction::at_angle(angle_rad), &mut [0; 2])
}

#[test]
fn evaluates_and_walks_between_triangles() {
    let (nodes, triangles) = square();
    let texture = Texture::new(parts(&nodes, &triangles)).unwrap();
    let mut hints = [0; 2];
    for (speed_mps, force_n, level, low, triangle) in [
        (1.0, 1.0, 1.0, 0.9, 0),
        (0.5, 0.25, 0.25, 0.5 * 0.5 + 0.25 * 0.7 + 0.25 * 0.9, 0),
        (0.25, 0.5, 0.25, 0.5 * 0.5 + 0.25 * 0.9 + 0.25 * 0.6, 1),
        (9.0, 9.0, 1.0, 0.9, 1),
        (0.5, 0.0, 0.0, 0.6, 0),
    ] {
        let at = texture.evaluate(Contact { speed_mps, force_n }, Direction::UNKNOWN, &mut hints);
        assert!((at.level_mps2 - level).abs() < 1e-6, "level at {speed_mps} {force_n}: {}", at.level_mps2);
        assert!((at.lsf[0] - low).abs() < 1e-6);
        assert!((at.sigma_mps2 - level * (-0.5_f32).exp()).abs() < 1e-6);
        assert_eq!(hints, [triangle, 0]);
    }
}

#[test]
fn nonsense_contacts_and_hints_are_silent_not_fatal() {
    let (nodes, triangles) = square();
    let texture = Texture::new(parts(&nodes, &triangles)).unwrap();
    for x in [f32::NAN, f32::INFINITY, -3.0] {
        let contact = Contact { speed_mps: x, force_n: x };
        let at = texture.evaluate(contact, Direction::at_angle(1.0), &mut [u16::MAX; 2]);
        assert_eq!(at.level_mps2, 0.0);
    }
}

#[test]
fn slices_that_were_never_checked_are_silent_not_fatal() {
    let (nodes, triangles) = square();
    let full = Contact { speed_mps: 1.0, force_n: 1.0 };
    for (nodes, triangles) in
        [(&nodes[..1], &triangles[..]), (&nodes[..], &triangles[..0]), (&nodes[..], &triangles[1..])]
    {
        let texture = Texture::checked_before(Parts { order: 99, ..parts(nodes, triangles) });
        let at = texture.evaluate(full, Direction::UNKNOWN, &mut [7; 2]);
        assert!(at.level_mps2 == 0.0 || triangles.len() == 1);
    }
}

#[test]
fn broken_slices_are_refused() {
    let (nodes, triangles) = square();
    let error = |rate, order, nodes: &[Node], triangles: &[Triangle]| {
        Texture::new(Parts { rate_hz: rate, order, ..parts(nodes, triangles) }).err()
    };
    assert_eq!(error(1000.0, 0, &nodes, &triangles), Some(TextureError::Order));
    assert_eq!(error(1000.0, MAX_ORDER + 1, &nodes, &triangles), Some(TextureError::Order));
    assert_eq!(error(f32::NAN, 2, &nodes, &triangles), Some(TextureError::Range));
    assert_eq!(error(1000.0, 2, &nodes, &[]), Some(TextureError::Triangle));
    assert_eq!(error(1000.0, 2, &nodes[..2], &triangles), Some(TextureError::Triangle));
    let mut bad = nodes;
    bad[1].lsf[1] = 0.1;
    assert_eq!(error(1000.0, 2, &bad, &triangles), Some(TextureError::Number));
    bad = nodes;
    bad[1].level_mps2 = f32::NAN;
    assert_eq!(error(1000.0, 2, &bad, &triangles), Some(TextureError::Number));
}

/// Excitations for the four nodes of the square, with a moving average of order 1.
fn published(variances: [f32; 4], gains: [f32; 4]) -> [Excitation; 4] {
    core::array::from_fn(|i| {
        let mut ma_lsf = [0.0; MAX_MA_ORDER];
        ma_lsf[0] = 1.0 + 0.2 * i as f32;
        Excitation { variance: variances[i], gain: gains[i], ma_lsf }
    })
}

#[test]
fn published_textures_interpolate_variance_and_gain() {
    let (nodes, triangles) = square();
    let excitations = published([0.0, 0.0, 4.0, 0.0], [1.0, 2.0, 3.0, 2.0]);
    let parts = Parts { ma_order: 1, excitations: &excitations, ..parts(&nodes, &triangles) };
    let texture = Texture::new(parts).unwrap();
    for (speed_mps, force_n, variance, gain, ma) in
        [(1.0, 1.0, 4.0, 3.0, 1.4_f32), (0.5, 0.25, 1.0, 0.5 + 0.25 * 2.0 + 0.25 * 3.0, 0.5 + 0.3 + 0.35)]
    {
        let at = evaluated(&texture, speed_mps, force_n, 0.0);
        let sigma = gain * f32::sqrt(variance);
        assert!((at.sigma_mps2 - sigma).abs() < 1e-5, "{} for {sigma}", at.sigma_mps2);
        // The ln gain is 1 at all six points.
        assert!((at.level_mps2 - sigma * 0.5_f32.exp()).abs() < 1e-5);
        assert_eq!(at.ma_order, 1);
        assert!((at.ma_lsf[0] - ma).abs() < 1e-6);
    }
}

#[test]
fn published_textures_are_silent_in_the_air_even_where_their_axes_are_not() {
    let (nodes, triangles) = square();
    let excitations = published([1.0; 4], [1.0; 4]);
    let texture = Texture::new(Parts { excitations: &excitations, ..parts(&nodes, &triangles) }).unwrap();
    let sigma = |speed_mps, force_n| evaluated(&texture, speed_mps, force_n, 0.0).sigma_mps2;
    assert_eq!((sigma(0.5, 0.0), sigma(0.0, 0.5)), (0.0, 0.0));
    assert!((sigma(0.5, 1e-4) - 1.0).abs() < 1e-6);
}

#[test]
fn broken_excitations_are_refused() {
    let (nodes, triangles) = square();
    let good = published([1.0; 4], [1.0; 4]);
    let error = |ma_order, excitations: &[Excitation]| {
        Texture::new(Parts { ma_order, excitations, ..parts(&nodes, &triangles) }).err()
    };
    assert_eq!(error(1, &good), None);
    assert_eq!(error(1, &[]), Some(TextureError::Order));
    assert_eq!(error(33, &good), Some(TextureError::Order));
    assert_eq!(error(1, &good[..3]), Some(TextureError::Excitation));
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        assert_eq!(error(1, &published([1.0, bad, 1.0, 1.0], [1.0; 4])), Some(TextureError::Number));
        assert_eq!(error(1, &published([1.0; 4], [1.0, bad, 1.0, 1.0])), Some(TextureError::Number));
    }
    // With order 2, the second frequency is zero.
    assert_eq!(error(2, &good), Some(TextureError::Number));
}

/// The grain of the square, three times as strong and with higher frequencies.
fn square_along() -> ([Node; 4], [Triangle; 2]) {
    let (mut nodes, triangles) = square();
    for node in &mut nodes {
        node.level_mps2 *= 3.0;
        node.lsf[..2].iter_mut().for_each(|w| *w += 1.0);
    }
    (nodes, triangles)
}

#[test]
fn power_and_frequencies_turn_with_the_stroke() {
    let (nodes, triangles) = square();
    let (along_nodes, along_triangles) = square_along();
    let along = Some(Along { nodes: &along_nodes, triangles: &along_triangles });
    for turn_rad in [0.0, 0.4, -2.0] {
        let texture = Texture::new(Parts { along, turn_rad, ..parts(&nodes, &triangles) }).unwrap();
        for (angle_rad, share) in
            [(0.0, 0.0), (FRAC_PI_2, 1.0), (FRAC_PI_4, 0.5), (-FRAC_PI_4, 0.5), (PI, 0.0), (PI / 6.0, 0.25)]
        {
            let at = evaluated(&texture, 1.0, 0.5, angle_rad + turn_rad);
            // Across, half of the level of 1 m/s² at full speed and force; along, three times as much.
            let power = (1.0 - share) * 0.25 + share * 2.25;
            assert!((at.level_mps2 * at.level_mps2 - power).abs() < 1e-5, "{at:?} for a share of {share}");
            let low = 0.8 + share;
            assert!((at.lsf[0] - low).abs() < 1e-5 && (at.lsf[1] - low - 0.2).abs() < 1e-5);
            // The excitation gives this level through the mixed filter.
            let mut ar = [0.0; 2];
            ar_from_lsf(&[low, low + 0.2], &mut ar);
            let level = at.sigma_mps2 * (0.5 * ln_power_gain(&ar).unwrap()).exp();
            assert!((level / at.level_mps2 - 1.0).abs() < 1e-4, "{level} for {}", at.level_mps2);
        }
    }
}

/// A texture without a grain along the lay is the same in all directions, bit by bit, and so is one that is stroked
/// across its lay before the tip has moved.
#[test]
fn isotropic_textures_do_not_turn() {
    let (nodes, triangles) = square();
    let texture = Texture::new(Parts { turn_rad: 0.7, ..parts(&nodes, &triangles) }).unwrap();
    let still = texture.evaluate(Contact { speed_mps: 0.8, force_n: 0.6 }, Direction::UNKNOWN, &mut [0; 2]);
    for angle_rad in [0.0, 0.3, 1.5, 3.0] {
        let at = evaluated(&texture, 0.8, 0.6, angle_rad);
        assert_eq!((at.lsf, at.level_mps2, at.sigma_mps2), (still.lsf, still.level_mps2, still.sigma_mps2));
    }
    let (along_nodes, along_triangles) = square_along();
    let along = Some(Along { nodes: &along_nodes, triangles: &along_triangles });
    let texture = Texture::new(Parts { along, turn_rad: 0.7, ..parts(&nodes, &triangles) }).unwrap();
    let at = texture.evaluate(Contact { speed_mps: 0.8, force_n: 0.6 }, Direction::UNKNOWN, &mut [0; 2]);
    assert_eq!((at.lsf, at.level_mps2), (still.lsf, still.level_mps2));
}

/// A change of angle by a tenth of a degree changes power and frequencies in proportion.
#[test]
fn no_angle_makes_a_jump() {
    let (nodes, triangles) = square();
    let (along_nodes, along_triangles) = square_along();
    let along = Some(Along { nodes: &along_nodes, triangles: &along_triangles });
    let texture = Texture::new(Parts { along, ..parts(&nodes, &triangles) }).unwrap();
    let at = |i: u16| evaluated(&texture, 1.0, 1.0, f32::from(i) * PI / 1800.0);
    for i in 0..3600 {
        let (before, after) = (at(i), at(i + 1));
        // The share changes by at most π/1800, and from end to end the power changes by 8 (m/s²)².
        let power = after.level_mps2.powi(2) - before.level_mps2.powi(2);
        assert!(power.abs() < 8.0 * 0.001_8, "{power} at {i}");
        assert!((after.sigma_mps2 - before.sigma_mps2).abs() < 0.01);
        assert!((after.lsf[0] - before.lsf[0]).abs() < 0.001_8);
    }
}

#[test]
fn passages_turn_into_the_axes_of_a_texture() {
    let (nodes, triangles) = square();
    let at = |x_m: f64, y_m: f64| Place { x_m, y_m, n_jumps: 0 };
    let on_pad = Passage::default().on(at(0.01, 0.02), 1.0).on(at(0.012, 0.021), 0.5);
    let turned =
        |turn_rad| Texture::new(Parts { turn_rad, ..parts(&nodes, &triangles) }).unwrap().passage(&on_pad);
    assert_eq!(turned(0.0), on_pad);
    assert_eq!(on_pad.turned((1.0, 0.0)), on_pad);
    // A texture whose x axis points up on the pad has its y axis to the left.
    let up = turned(FRAC_PI_2);
    for (got, expected) in [(up.x_m.0, 0.02), (up.x_m.1, 0.021), (up.y_m.0, -0.01), (up.y_m.1, -0.012)] {
        // A cosine in `f32` is zero to within 1e-7.
        assert!((got - expected).abs() < 1e-8, "{got} for {expected}");
    }
    assert_eq!((up.forces_n, up.is_elsewhere), ((1.0, 0.5), false));
}

#[test]
fn broken_layers_are_refused() {
    let (nodes, triangles) = square();
    let (along_nodes, along_triangles) = square_along();
    let error = |changed: Parts<'_>| Texture::new(changed).err();
    let good = parts(&nodes, &triangles);
    let along = Along { nodes: &along_nodes, triangles: &along_triangles };
    assert_eq!(error(Parts { along: Some(along), ..good }), None);
    let fewer = Along { nodes: &along_nodes[..2], ..along };
    assert_eq!(error(Parts { along: Some(fewer), ..good }), Some(TextureError::Triangle));
    let none = Along { triangles: &[], ..along };
    assert_eq!(error(Parts { along: Some(none), ..good }), Some(TextureError::Triangle));
    let mut bad = along_nodes;
    bad[2].level_mps2 = -1.0;
    let negative = Along { nodes: &bad, ..along };
    assert_eq!(error(Parts { along: Some(negative), ..good }), Some(TextureError::Number));
    let excitations = published([1.0; 4], [1.0; 4]);
    let both = Parts { along: Some(along), excitations: &excitations, ..good };
    assert_eq!(error(both), Some(TextureError::Along));
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(error(Parts { turn_rad: bad, ..good }), Some(TextureError::Layer));
        let friction = Some(Friction { kinetic: bad, static_ratio: 1.5, stribeck_speed_mps: 0.02 });
        assert_eq!(error(Parts { friction, ..good }), Some(TextureError::Layer));
    }
    let friction = Some(Friction { kinetic: -0.1, static_ratio: 1.5, stribeck_speed_mps: 0.02 });
    assert_eq!(error(Parts { friction, ..good }), Some(TextureError::Layer));
}
