use super::{GrainNode, LEVELS_MPS2, TextureModel, TextureModelError};
use crate::units::{Hertz, MetersPerSecond, Newtons};

fn node(speed: f64, lsf: &[f64]) -> GrainNode {
    GrainNode { speed: MetersPerSecond(speed), force: Newtons(1.0), lsf: lsf.to_vec(), level_mps2: 1.0 }
}

#[test]
fn bad_numbers_are_named() {
    let make = |rate: f64, nodes: Vec<GrainNode>| TextureModel::new(Hertz(rate), nodes, None).unwrap_err();
    assert_eq!(make(1000.0, vec![]), TextureModelError::Empty);
    assert_eq!(make(100.0, vec![node(0.1, &[1.0])]), TextureModelError::Rate { rate_hz: 100.0 });
    let many = vec![node(0.1, &[1.0]); 20_001];
    assert_eq!(make(1000.0, many), TextureModelError::TooMany { n: 20_001 });
    let orders = vec![node(0.1, &[1.0]), node(0.2, &[1.0, 2.0])];
    assert_eq!(make(1000.0, orders), TextureModelError::Order { index: 1, order: 2 });
    assert_eq!(make(1000.0, vec![node(0.1, &[2.0, 1.0])]), TextureModelError::Frequencies { index: 0 });
    assert_eq!(make(1000.0, vec![node(0.1, &[f64::NAN])]), TextureModelError::Frequencies { index: 0 });
    // One ulp of f32 apart, and as near to the ends.
    for lsf in [[1.0, 1.0 + 1e-7], [1e-7, 1.0], [1.0, std::f64::consts::PI - 1e-7]] {
        assert_eq!(make(1000.0, vec![node(0.1, &lsf)]), TextureModelError::Frequencies { index: 0 });
    }
}

#[test]
fn numbers_that_cannot_be_rendered_are_refused_with_their_range() {
    let error = |node: GrainNode| TextureModel::new(Hertz(1000.0), vec![node], None).unwrap_err();
    for bad in [0.0, -1.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
        let text = error(node(bad, &[1.0])).to_string();
        assert!(text.starts_with("speed in m/s of node 0") && text.ends_with("and 100"), "{text}");
        let text = error(GrainNode { force: Newtons(bad), ..node(0.1, &[1.0]) }).to_string();
        assert!(text.starts_with("force in N of node 0") && text.ends_with("and 10000"), "{text}");
    }
    for bad in [-1.0, 1e300, f64::NAN, f64::INFINITY] {
        let error = error(GrainNode { level_mps2: bad, ..node(0.1, &[1.0]) });
        let TextureModelError::Value { what, low, high, .. } = error else { panic!("{error}") };
        assert_eq!((what, low..=high), ("level in m/s²", LEVELS_MPS2));
    }
}

#[test]
fn nodes_at_one_place_are_refused_and_neighbors_are_not() {
    let make = |places: &[[f64; 2]]| {
        let at = |[speed, force]: &[f64; 2]| GrainNode { force: Newtons(*force), ..node(*speed, &[1.0]) };
        TextureModel::new(Hertz(1000.0), places.iter().map(at).collect(), None).err()
    };
    let far = [0.2, 2.0];
    let same = Some(TextureModelError::SamePlace { first: 1, second: 2 });
    assert_eq!(make(&[far, [0.1, 1.0], [0.1, 1.0]]), same);
    // A hundredth of a percent of 0.2 m/s and of 2 N, just less and just more, across the border of a cell too.
    for speed in [0.1, 0.10001, 0.100_019] {
        assert_eq!(make(&[far, [speed, 1.0], [speed + 1.9e-5, 1.0 - 1.9e-4]]), same);
        assert_eq!(make(&[far, [speed, 1.0], [speed + 2.1e-5, 1.0]]), None);
        assert_eq!(make(&[far, [speed, 1.0], [speed, 1.0 + 2.1e-4]]), None);
    }
    // So near to zero speed that silence lies at the same place.
    assert!(matches!(make(&[far, [1e-5, 1.0]]), Some(TextureModelError::Value { index: 1, .. })));
}
