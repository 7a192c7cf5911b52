extern crate std;
use super::{MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, TextureError, Triangle};
use crate::contact::Contact;

/// Order 2 on the unit square of 1 m/s and 1 N: silent but at the corner of full speed and force.
pub(crate) fn square() -> ([Node; 4], [Triangle; 2]) {
    let node = |level_mps2: f32, low: f32| {
        let mut lsf = [0.0; MAX_ORDER];
        (lsf[0], lsf[1]) = (low, low + 0.2);
        Node { level_mps2, lsf }
    };
    let nodes = [node(0.0, 0.5), node(0.0, 0.7), node(1.0, 0.9), node(0.0, 0.6)];
    let ln_gain = [1.0; 6];
    let triangles = [
        // (0,0) (1,0) (1,1): weights 1 - x, x - y, y.
        Triangle {
            nodes: [0, 1, 2],
            neighbors: [NO_NEIGHBOR, 1, NO_NEIGHBOR],
            weights: [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0],
            ln_gain,
        },
        // (0,0) (1,1) (0,1): weights 1 - y, x, y - x.
        Triangle {
            nodes: [0, 2, 3],
            neighbors: [NO_NEIGHBOR, NO_NEIGHBOR, 0],
            weights: [0.0, -1.0, 1.0, 1.0, 0.0, 0.0],
            ln_gain,
        },
    ];
    (nodes, triangles)
}

/// Slices of order 2 at 1 kHz over the unit square.
pub(crate) fn parts<'a>(nodes: &'a [Node], triangles: &'a [Triangle]) -> Parts<'a> {
    Parts { rate_hz: 1000.0, order: 2, speed_max_mps: 1.0, force_max_n: 1.0, nodes, triangles }
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
