use std::f64::consts::{FRAC_PI_2, TAU};

use super::{Hand, RenderPlan, render};
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;
use crate::texture::profile::Profile;
use crate::texture::relief::Relief;
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

fn steady() -> Contact {
    Contact::from_mm_per_s_and_n(100.0, 1.0)
}

/// Straight stroke at 100 mm/s and 1 N, at an angle on the pad in rad.
struct Straight(f64);

impl Hand for Straight {
    fn contact_at(&mut self, _: f64) -> Contact {
        steady()
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<[f64; 2]> {
        let (sin, cos) = self.0.sin_cos();
        Some([0.1 * time_secs * cos, 0.1 * time_secs * sin])
    }
}

/// One second of a texture alone, under this stroke.
fn stroked(model: &TextureModel, hand: &mut dyn Hand) -> Vec<f32> {
    let prepared = Plane::new(model).prepare();
    let plan = RenderPlan {
        parents: &[(&prepared, 1.0)],
        mode: Mode::Power,
        rate: Hertz(1000.0),
        seconds: 1.0,
        seed: 1,
    };
    render(&plan, hand).unwrap()
}

fn power(x: &[f32]) -> f64 {
    x.iter().map(|v| f64::from(*v).powi(2)).sum::<f64>() / x.len() as f64
}

fn are_near(a: &[f32], b: &[f32]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3)
}

/// A texture that is rotated by the angle of the stroke feels as one that is not, under a stroke to the right.
#[test]
fn a_rotated_relief_is_stroked_in_its_own_axes() {
    let values = (0..1000).map(|i| (0.01 * TAU * f64::from(i)).cos());
    let relief = Relief::new(Profile::new(2e-5, values.collect()).unwrap(), Newtons(1.0)).unwrap();
    let waves = TextureModel::of_relief(relief.into(), Hertz(1000.0)).unwrap();
    let straight = stroked(&waves, &mut Straight(0.0));
    assert!(power(&straight) > 0.4, "{}", power(&straight));
    for angle in [0.6, -2.0, FRAC_PI_2] {
        // A rotation in `f32` displaces the stroke of 0.1 m by at most 1e-8 m of 2 mm.
        let turned = stroked(&waves.clone().with_turn_rad(angle), &mut Straight(angle));
        assert!(are_near(&turned, &straight), "at {angle}");
    }
    let silent = stroked(&waves, &mut Straight(FRAC_PI_2));
    assert!(power(&silent) < 1e-6, "{}", power(&silent));
}

/// Strokes along the lay have the level of the grain along it. A stroke without positions moves to the right.
#[test]
fn the_grain_turns_with_the_stroke() {
    let node = |level_mps2: f64| GrainNode {
        speed: MetersPerSecond(0.1),
        force: Newtons(1.0),
        lsf: vec![1.0, 2.0],
        level_mps2,
    };
    let isotropic = TextureModel::new(Hertz(1000.0), vec![node(1.0)], None).unwrap();
    let model = isotropic.clone().with_along(Some(vec![node(3.0)])).unwrap();
    let to_right = stroked(&model, &mut Straight(0.0));
    assert_eq!(to_right, stroked(&model, &mut |_: f64| steady()));
    assert!(are_near(&to_right, &stroked(&isotropic, &mut Straight(0.0))));
    // The noise is the same in all strokes, so their powers have the ratios of the squared levels.
    for (angle, ratio) in [(90.0_f64, 9.0), (45.0, 5.0), (-45.0, 5.0), (180.0, 1.0), (30.0, 3.0)] {
        let got = power(&stroked(&model, &mut Straight(angle.to_radians()))) / power(&to_right);
        assert!((got / ratio - 1.0).abs() < 1e-3, "{got} for {ratio} at {angle}°");
    }
    let turned = stroked(&model.with_turn_rad(FRAC_PI_2), &mut |_: f64| steady());
    assert!((power(&turned) / power(&to_right) / 9.0 - 1.0).abs() < 1e-3);
}

/// Without a grain along the lay and without a relief, positions have no effect at all.
#[test]
fn an_isotropic_grain_does_not_depend_on_positions() {
    let node =
        GrainNode { speed: MetersPerSecond(0.1), force: Newtons(1.0), lsf: vec![1.0, 2.0], level_mps2: 1.0 };
    let model = TextureModel::new(Hertz(1000.0), vec![node], None).unwrap();
    let without = stroked(&model, &mut |_: f64| steady());
    for angle in [0.0, 1.0, -2.5] {
        assert_eq!(stroked(&model.clone().with_turn_rad(0.7), &mut Straight(angle)), without);
    }
}
