use super::test_textures::{arma, two_resonances};
use super::{GrainNode, Interpolation, PublishedNode, TextureModel, TextureModelError};
use crate::texture::stick_slip::StickSlip;
use crate::texture::tap::Tap;
use crate::texture::{LEVELS_MPS2, MAX_RADIAL_NODES, MIN_LSF_GAP};
use crate::units::{Hertz, MetersPerSecond, Newtons};
use std::f64::consts::{PI, TAU};

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
    for lsf in [[1.0, 1.0 + 1e-7], [1e-7, 1.0], [1.0, PI - 1e-7]] {
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

/// Nodes of the texture of [`two_resonances`], with half of its levels, after a change.
fn along(change: &dyn Fn(&mut Vec<GrainNode>)) -> Result<TextureModel, TextureModelError> {
    let model = two_resonances(&[0.05, 0.2], &[0.5, 1.0]);
    let half = |n: &GrainNode| GrainNode { level_mps2: 0.5 * n.level_mps2, ..n.clone() };
    let mut nodes: Vec<GrainNode> = model.nodes().iter().map(half).collect();
    change(&mut nodes);
    model.with_along(Some(nodes))
}

#[test]
fn a_grain_along_the_lay_has_the_nodes_of_that_across_it() {
    let model = along(&|_| ()).unwrap();
    assert_eq!(model.along().unwrap().len(), 4);
    let alone = model.along_model().unwrap();
    assert_eq!(
        (alone.nodes(), alone.rate(), alone.friction()),
        (model.along().unwrap(), model.rate(), Some(0.3))
    );
    assert_eq!((alone.along(), alone.interpolation()), (None, model.interpolation()));
    assert_eq!(model.with_along(None).unwrap(), two_resonances(&[0.05, 0.2], &[0.5, 1.0]));
    // Speeds and forces that a file rounds at the tenth digit are the same.
    assert!(along(&|n| n[1].speed.0 *= 1.0 + 1e-10).is_ok());
    let error = |change: &dyn Fn(&mut Vec<GrainNode>)| along(change).unwrap_err();
    assert_eq!(error(&|n| n.truncate(3)), TextureModelError::AlongCount { n: 3, expected: 4 });
    assert_eq!(error(&|n| n.clear()), TextureModelError::AlongCount { n: 0, expected: 4 });
    let differs = |error: TextureModelError, named: &str, of: usize| {
        let TextureModelError::Along { what, index, .. } = error else { panic!("{error:?}") };
        assert_eq!((what, index), (named, of));
    };
    differs(error(&|n| n[2].speed.0 *= 0.999_999), "speed in m/s", 2);
    differs(error(&|n| n[3].force.0 *= 1.000_001), "force in N", 3);
    differs(error(&|n| n.swap(0, 1)), "force in N", 0);
    differs(error(&|n| n.iter_mut().for_each(|n| n.lsf.truncate(4))), "order", 0);
    assert_eq!(arma(4, 0).with_along(Some(vec![node(0.1, &[1.0])])), Err(TextureModelError::AlongPublished));
}

#[test]
fn bad_numbers_along_the_lay_are_named_as_such() {
    let inner = |change: &dyn Fn(&mut Vec<GrainNode>)| match along(change).unwrap_err() {
        TextureModelError::InAlong(error) => *error,
        other => panic!("{other:?}"),
    };
    assert_eq!(inner(&|n| n[1].lsf.swap(0, 1)), TextureModelError::Frequencies { index: 1 });
    assert!(matches!(inner(&|n| n[2].level_mps2 = f64::NAN), TextureModelError::Value { index: 2, .. }));
    let crowded = |node: &mut GrainNode| {
        node.lsf.iter_mut().zip(1..).for_each(|(w, i)| *w = 1.001 * MIN_LSF_GAP * f64::from(i));
    };
    // Six frequencies at the minimum distance grow in the renderer.
    assert_eq!(inner(&|n| crowded(&mut n[0])), TextureModelError::Unstable { index: 0 });
}

#[test]
fn layers_are_taken_over_and_the_grains_stay() {
    let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 4.0 };
    let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
    let layered = two_resonances(&[0.1], &[1.0])
        .with_tap(Some(tap))
        .with_stick_slip(Some(stick_slip))
        .with_turn_rad(0.5);
    let model = along(&|_| ()).unwrap();
    let both = model.clone().with_layers_of(&layered);
    assert_eq!((both.tap(), both.stick_slip(), both.turn_rad()), (Some(tap), Some(stick_slip), 0.5));
    assert_eq!(
        (both.along(), both.nodes(), both.friction()),
        (model.along(), model.nodes(), model.friction())
    );
}

#[test]
fn rotations_stay_within_half_a_turn() {
    let turned = |turn_rad: f64| two_resonances(&[0.1], &[1.0]).with_turn_rad(turn_rad).turn_rad();
    for same in [0.0, 1.0, -3.0, PI, -PI] {
        assert_eq!(turned(same), same);
    }
    assert!((turned(TAU + 0.25) - 0.25).abs() < 1e-12 && (turned(-4.0) - (TAU - 4.0)).abs() < 1e-12);
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(turned(bad), 0.0);
    }
}
