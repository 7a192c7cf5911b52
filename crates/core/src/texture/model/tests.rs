use super::test_textures::arma;
use super::{GrainNode, Interpolation, PublishedNode, TextureModel, TextureModelError};
use crate::texture::{LEVELS_MPS2, MAX_RADIAL_NODES};
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
    // Closer than the spacing of f32, between frequencies and to both ends.
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
    // The minimum distance is 1e-4 of 0.2 m/s and 2 N; slightly less and slightly more, also across a column border.
    for speed in [0.1, 0.10001, 0.100_019] {
        assert_eq!(make(&[far, [speed, 1.0], [speed + 1.9e-5, 1.0 - 1.9e-4]]), same);
        assert_eq!(make(&[far, [speed, 1.0], [speed + 2.1e-5, 1.0]]), None);
        assert_eq!(make(&[far, [speed, 1.0], [speed, 1.0 + 2.1e-4]]), None);
    }
    // So close to zero speed that it coincides with the silent boundary.
    assert!(matches!(make(&[far, [1e-5, 1.0]]), Some(TextureModelError::Value { index: 1, .. })));
}

fn published(change: &dyn Fn(&mut Vec<PublishedNode>)) -> Result<TextureModel, TextureModelError> {
    let mut nodes = arma(6, 4).published_nodes().to_vec();
    change(&mut nodes);
    TextureModel::published(Hertz(1000.0), nodes, None)
}

#[test]
fn published_nodes_say_what_they_are() {
    let model = published(&|_| ()).unwrap();
    assert_eq!((model.order(), model.ma_order(), model.n_nodes()), (6, 4, 16));
    assert_eq!((model.nodes().len(), model.published_nodes().len()), (0, 16));
    assert_eq!((model.speed_max(), model.force_max()), (MetersPerSecond(0.2), Newtons(3.0)));
    assert_eq!(model.interpolation(), None);
    assert_eq!(model.with_interpolation(Interpolation::RadialBasis), Err(TextureModelError::Published));
    assert_eq!(published(&|nodes| nodes.iter_mut().for_each(|n| n.ma_lsf.clear())).unwrap().ma_order(), 0);
    // The smallest difference that six decimals can represent.
    assert!(published(&|nodes| nodes[3].ma_lsf[1] = nodes[3].ma_lsf[0] + 1e-6).is_ok());
}

#[test]
fn bad_published_nodes_are_named() {
    let error = |change: &dyn Fn(&mut Vec<PublishedNode>)| published(change).unwrap_err();
    assert_eq!(error(&|n| n.clear()), TextureModelError::Empty);
    assert_eq!(error(&|n| n[2].ar_lsf.truncate(5)), TextureModelError::Order { index: 2, order: 5 });
    assert_eq!(error(&|n| n[2].ma_lsf.truncate(3)), TextureModelError::MaOrder { index: 2, order: 3 });
    let frequencies = |part| TextureModelError::PublishedFrequencies { part, index: 1 };
    assert_eq!(error(&|n| n[1].ar_lsf[0] = f64::NAN), frequencies("AR"));
    assert_eq!(error(&|n| n[1].ma_lsf.swap(0, 1)), frequencies("MA"));
    assert_eq!(error(&|n| n[1].ma_lsf[1] = n[1].ma_lsf[0] + 1e-7), frequencies("MA"));
    let named = |error: TextureModelError, name: &str| {
        assert!(error.to_string().starts_with(name), "{error}");
    };
    for bad in [-1.0, 1e300, f64::NAN, f64::INFINITY] {
        named(error(&|n| n[5].variance = bad), "variance in (m/s²)² of node 5");
        named(error(&|n| n[5].gain = bad), "gain of node 5");
        named(error(&|n| n[5].speed.0 = bad), "speed in m/s of node 5");
        named(error(&|n| n[5].force.0 = bad), "force in N of node 5");
    }
    named(error(&|n| n.iter_mut().for_each(|n| n.force.0 = 0.0)), "highest force in N");
    // Each corner in turn.
    for (index, speed_mps, force_n) in [(0, 0.0, 0.0), (3, 0.0, 3.0), (12, 0.2, 0.0), (15, 0.2, 3.0)] {
        let missing = TextureModelError::Corner { speed_mps, force_n };
        assert_eq!(error(&|n| drop(n.remove(index))), missing);
    }
    assert_eq!(error(&|n| n.push(n[7].clone())), TextureModelError::SamePlace { first: 7, second: 16 });
}

#[test]
fn a_radial_basis_is_for_so_many_nodes_and_no_more() {
    let model = |n: usize| {
        let nodes = (0..n).map(|i| node(0.01 + 1e-4 * i as f64, &[1.0])).collect();
        TextureModel::new(Hertz(1000.0), nodes, None).unwrap().with_interpolation(Interpolation::RadialBasis)
    };
    assert_eq!(model(MAX_RADIAL_NODES).unwrap().interpolation(), Some(Interpolation::RadialBasis));
    let n = MAX_RADIAL_NODES + 1;
    assert_eq!(model(n), Err(TextureModelError::TooManyForRadialBasis { n }));
}
