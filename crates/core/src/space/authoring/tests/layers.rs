//! Layers of interpolated textures: direction, height map, stick-slip friction and rotation.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use super::{contact, point, truth};
use crate::space::authoring::{Authoring, Blending, Layers, Models};
use crate::space::{Space, SpacePoint};
use crate::texture::blend::Mode;
use crate::texture::height_map::{HeightMap, HeightMapOptions};
use crate::texture::plane::Plane;
use crate::texture::stick_slip::StickSlip;
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Hertz, MetersPerSecond, Newtons, Radians};

const PLACES: [(f64, f64); 5] = [(10.0, 10.0), (90.0, 10.0), (90.0, 90.0), (10.0, 90.0), (45.0, 50.0)];
/// Index of the directional texture.
const BRUSHED: usize = 4;
/// Level of the brushed texture along its lay, relative to that across it.
const ALONG: f64 = 0.25;
const STICK_SLIP: StickSlip = StickSlip { static_ratio: 1.6, stribeck_speed: MetersPerSecond(0.02) };
const TURN_RAD: f64 = 2.5;

fn places() -> [SpacePoint; 5] {
    PLACES.map(|(rough_smooth, hard_soft)| point(rough_smooth, hard_soft))
}

fn bumps() -> Arc<HeightMap> {
    let heights_m = (0..256).map(|i| 2e-5 * (0.25 * PI * f64::from(i % 16)).cos()).collect();
    let options = HeightMapOptions { force: Newtons(1.0), speed_exponent: 1.5, patch_radius_m: 5e-4 };
    Arc::new(HeightMap::new(heights_m, 0.01, options).unwrap())
}

fn isotropic() -> Vec<TextureModel> {
    places().into_iter().map(|at| truth(at, 0.0)).collect()
}

/// A texture that is quieter along its lay.
fn brushed(model: TextureModel) -> TextureModel {
    let quiet = |n: &GrainNode| GrainNode { level_mps2: ALONG * n.level_mps2, ..n.clone() };
    let along: Vec<GrainNode> = model.nodes().iter().map(quiet).collect();
    model.with_along(Some(along)).unwrap()
}

fn with_brushed(height_map: &Arc<HeightMap>) -> Vec<TextureModel> {
    let mut textures = isotropic();
    textures[BRUSHED] = brushed(textures[BRUSHED].clone())
        .with_height_map(Some(Arc::clone(height_map)))
        .with_stick_slip(Some(STICK_SLIP))
        .with_turn_rad(TURN_RAD);
    textures
}

fn authoring(textures: &[TextureModel]) -> Authoring {
    let space = Space::new(&places().map(Some)).unwrap();
    let planes: Vec<Plane> = textures.iter().map(Plane::new).collect();
    let layers: Vec<_> = textures.iter().zip(&planes).map(|(t, plane)| Some(Layers::of(t, plane))).collect();
    let models = Models::new(&space, &layers).unwrap();
    Authoring::new(space).with_models(Arc::new(models))
}

fn model_at(authoring: &Authoring, at: SpacePoint, mode: Mode) -> TextureModel {
    authoring.author(at, &mode.into()).unwrap().model.unwrap()
}

/// Level along the lay relative to that across it, at 90 mm/s and 0.7 N.
fn level_ratio(model: &TextureModel) -> f64 {
    let level = |model: &TextureModel| Plane::new(model).at(contact()).level_mps2;
    level(&model.along_model().unwrap()) / level(model)
}

#[test]
fn a_blend_lies_between_a_directional_and_an_isotropic_texture() {
    let authoring = authoring(&with_brushed(&bumps()));
    let brushed = places()[BRUSHED];
    let between = |t: f64| point((1.0 - t) * brushed.x() + t * 90.0, (1.0 - t) * brushed.y() + t * 10.0);
    // On the straight line to an isotropic texture, an edge of the triangulation, the weights are 1 - t and t.
    for t in [0.0, 0.25, 0.5, 0.75] {
        let ratio = level_ratio(&model_at(&authoring, between(t), Mode::Parametric));
        assert!((ratio / ALONG.powf(1.0 - t) - 1.0).abs() < 1e-6, "{ratio} at {t}");
    }
    let ratios = [0.0, 0.5, 0.9].map(|t| level_ratio(&model_at(&authoring, between(t), Mode::Field)));
    // Levels of fitted predictors are sums over 128 bins.
    assert!(ratios.iter().all(|ratio| (ALONG - 1e-3..=1.0 + 1e-3).contains(ratio)), "{ratios:?}");
    assert!(ratios[0] < ratios[1] && ratios[1] < ratios[2] && ratios[0] < 0.8, "{ratios:?}");
}

#[test]
fn the_grain_across_the_lay_does_not_depend_on_that_along_it() {
    let (directional, isotropic) = (authoring(&with_brushed(&bumps())), authoring(&isotropic()));
    for mode in [Mode::Field, Mode::Parametric] {
        for at in [point(30.0, 40.0), point(60.0, 45.0), places()[BRUSHED]] {
            let made = model_at(&directional, at, mode);
            assert!(made.along().is_some(), "{mode:?} at {at}");
            let plain = isotropic_at(&isotropic, at, mode);
            assert!(made.nodes() == plain.nodes(), "{mode:?} at {at}");
            assert_eq!((made.friction(), made.tap()), (plain.friction(), plain.tap()));
        }
    }
}

/// A texture made of isotropic ones, which has no layer of direction.
fn isotropic_at(authoring: &Authoring, at: SpacePoint, mode: Mode) -> TextureModel {
    let model = model_at(authoring, at, mode);
    assert!(model.along().is_none() && model.height_map().is_none() && model.stick_slip().is_none());
    assert_eq!(model.turn_rad(), 0.0);
    model
}

#[test]
fn a_mean_of_isotropic_textures_beside_a_directional_one_is_isotropic() {
    let authoring = authoring(&with_brushed(&bumps()));
    // On the lower edge, only the two lower corners contribute.
    let model = isotropic_at(&authoring, point(50.0, 10.0), Mode::Parametric);
    assert!(model.relief().is_none());
}

#[test]
fn a_pinned_texture_is_exact_in_all_layers() {
    let height_map = bumps();
    let textures = with_brushed(&height_map);
    let authoring = authoring(&textures);
    let pinned = Blending { locked: vec![BRUSHED, 0], ..Mode::Field.into() };
    let (own, at) = (&textures[BRUSHED], places()[BRUSHED]);
    let authored = authoring.author(at, &pinned).unwrap();
    assert_eq!((authored.parents.as_slice(), authored.lock), (&[(BRUSHED, 1.0)][..], Some((BRUSHED, 1.0))));
    let model = authoring.model(at, &pinned).unwrap();
    let level = |model: &TextureModel| Plane::new(model).at(contact()).level_mps2;
    let along = |model: &TextureModel| level(&model.along_model().unwrap());
    // Levels of fitted predictors are sums over 128 bins.
    assert!((level(&model) / level(own) - 1.0).abs() < 1e-3);
    assert!((along(&model) / along(own) - 1.0).abs() < 1e-3);
    assert!(model.height_map().is_some_and(|found| Arc::ptr_eq(found, &height_map)));
    assert_eq!((model.stick_slip(), model.turn_rad()), (Some(STICK_SLIP), TURN_RAD));
    // A pinned isotropic texture has no direction at all.
    let model = authoring.model(places()[0], &pinned).unwrap();
    assert!((level_ratio(&model) - 1.0).abs() < 1e-6 && model.height_map().is_none());
    assert_eq!((model.stick_slip(), model.turn_rad()), (None, 0.0));
}

#[test]
fn height_map_friction_and_rotation_follow_the_weights() {
    let height_map = bumps();
    let authoring = authoring(&with_brushed(&height_map));
    let at = point(50.0, 50.0);
    for mode in [Mode::Parametric, Mode::Field] {
        let authored = authoring.author(at, &mode.into()).unwrap();
        let weight = authored.parents.iter().find(|(texture, _)| *texture == BRUSHED).unwrap().1;
        let model = authored.model.unwrap();
        let rms = |map: &HeightMap| crate::dsp::spectrum::rms(map.heights_m());
        let share = rms(model.height_map().unwrap()) / rms(&height_map);
        assert!((share - weight).abs() < 0.02, "{mode:?}: {share} for {weight}");
        let stick_slip = model.stick_slip().unwrap();
        assert!((stick_slip.static_ratio / STICK_SLIP.static_ratio.powf(weight) - 1.0).abs() < 1e-9);
        assert!((stick_slip.stribeck_speed.0 / STICK_SLIP.stribeck_speed.0 - 1.0).abs() < 1e-9);
        // The only texture with a direction.
        assert!((model.turn_rad() - TURN_RAD).abs() < 1e-9, "{mode:?}: {}", model.turn_rad());
        let bare = model_at(&authoring.clone().without_reliefs(), at, mode);
        assert!(bare.height_map().is_none() && bare == model.with_height_map(None));
    }
}

/// Levels in m/s² of strokes in twelve directions on the pad, and the signal of a stroke over the height map.
fn felt(model: &TextureModel) -> Vec<f64> {
    let plane = Plane::new(model);
    let level = |i: u32| {
        let angle = Radians(PI * f64::from(i) / 12.0 - model.turn_rad());
        plane.at_angle(contact(), angle).level_mps2
    };
    let (sin, cos) = model.turn_rad().sin_cos();
    let path_m: Vec<[f64; 2]> = (0..12)
        .map(|i| [2e-3 * f64::from(i), 1e-3 * f64::from(i)])
        .map(|[x_m, y_m]| [cos * x_m + sin * y_m, cos * y_m - sin * x_m])
        .collect();
    let still = vec![0.0; path_m.len()];
    let signal = |map: &Arc<HeightMap>| map.acceleration(&path_m, Newtons(1.0), Hertz(50.0));
    (0..12).map(level).chain(model.height_map().map_or(still, signal)).collect()
}

/// Lays at right angles cancel halfway; from there on, the axes of the other texture hold.
#[test]
fn halfway_between_two_lays_at_right_angles_no_direction_differs_and_nothing_jumps() {
    let mut textures = isotropic();
    for (i, turn_rad) in [(0, 0.4), (1, 0.4 + FRAC_PI_2)] {
        textures[i] = brushed(textures[i].clone()).with_turn_rad(turn_rad);
    }
    textures[0] = textures[0].clone().with_height_map(Some(bumps()));
    textures[1] = textures[1].clone().with_height_map(Some(Arc::new(bumps().stretched(1.1))));
    let authoring = authoring(&textures);
    let at = |t: f64| felt(&model_at(&authoring, point(10.0 + 80.0 * t, 10.0), Mode::Parametric));
    let (begin, halfway) = (at(0.0), at(0.5));
    let span = |felt: &[f64]| {
        let (low, high) =
            felt[..12].iter().fold((f64::MAX, 0.0_f64), |(low, high), x| (low.min(*x), high.max(*x)));
        low / high
    };
    assert!((span(&begin) - ALONG).abs() < 0.05, "{begin:?}");
    assert!((span(&halfway) - 1.0).abs() < 1e-6, "{halfway:?}");
    for mode in [Mode::Parametric, Mode::Field] {
        let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let at = |t: f64| felt(&model_at(&authoring, point(10.0 + 80.0 * t, 10.0), mode));
        let (mut low, mut high) = ((0.1, at(0.1)), (0.9, at(0.9)));
        for _ in 0..30 {
            let t = 0.5 * (low.0 + high.0);
            let middle = (t, at(t));
            if apart(&low.1, &middle.1) > apart(&middle.1, &high.1) {
                high = middle;
            } else {
                low = middle;
            }
        }
        let most = begin.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(apart(&low.1, &high.1) < 1e-4 * most, "{mode:?}: a jump at {}", low.0);
    }
}
