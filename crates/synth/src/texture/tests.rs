extern crate std;
use super::{Excitation, MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, TextureError, Triangle};
use crate::contact::Contact;

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
        relief: None,
    }
}

#[test]
fn evaluates_and_walks_between_triangles() {
    let (nodes, triangles) = square();
    let texture = Texture::new(parts(&nodes, &triangles)).unwrap();
    let mut hint = 0;
    for (speed_mps, force_n, level, low, triangle) in [
        (1.0, 1.0, 1.0, 0.9, 0),
        (0.5, 0.25, 0.25, 0.5 * 0.5 + 0.25 * 0.7 + 0.25 * 0.9, 0),
        (0.25, 0.5, 0.25, 0.5 * 0.5 + 0.25 * 0.9 + 0.25 * 0.6, 1),
        (9.0, 9.0, 1.0, 0.9, 1),
        (0.5, 0.0, 0.0, 0.6, 0),
    ] {
        let at = texture.evaluate(Contact { speed_mps, force_n }, &mut hint);
        assert!((at.level_mps2 - level).abs() < 1e-6, "level at {speed_mps} {force_n}: {}", at.level_mps2);
        assert!((at.lsf[0] - low).abs() < 1e-6);
        assert!((at.sigma_mps2 - level * (-0.5_f32).exp()).abs() < 1e-6);
        assert_eq!(hint, triangle);
    }
}

#[test]
fn nonsense_contacts_and_hints_are_silent_not_fatal() {
    let (nodes, triangles) = square();
    let texture = Texture::new(parts(&nodes, &triangles)).unwrap();
    for x in [f32::NAN, f32::INFINITY, -3.0] {
        let mut hint = u16::MAX;
        assert_eq!(texture.evaluate(Contact { speed_mps: x, force_n: x }, &mut hint).level_mps2, 0.0);
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
        let at = texture.evaluate(full, &mut 7);
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
    assert_eq!(error(1000.0, 33, &nodes, &triangles), Some(TextureError::Order));
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
        let mut ma_lsf = [0.0; MAX_ORDER];
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
        let at = texture.evaluate(Contact { speed_mps, force_n }, &mut 0);
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
    let sigma = |speed_mps, force_n| texture.evaluate(Contact { speed_mps, force_n }, &mut 0).sigma_mps2;
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
