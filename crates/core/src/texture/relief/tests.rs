use std::f64::consts::TAU;

use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
use shagreen_synth::relief::Relief as SynthRelief;

use super::{MAX_MPS2, MAX_VALUES, Relief, ReliefError};
use crate::texture::profile::Profile;
use crate::units::Newtons;

fn relief(step_m: f64, values: Vec<f64>, force_n: f64) -> Relief {
    Relief::new(Profile::new(step_m, values).unwrap(), Newtons(force_n)).unwrap()
}

#[test]
fn what_is_no_relief_is_named() {
    let error = |step_m: f64, values: Vec<f64>, force_n: f64| {
        Relief::new(Profile::new(step_m, values).unwrap(), Newtons(force_n)).unwrap_err()
    };
    assert_eq!(error(1e-8, vec![0.0; 4], 1.0), ReliefError::Step { step_m: 1e-8 });
    assert_eq!(error(1e-5, vec![0.0; MAX_VALUES + 1], 1.0), ReliefError::Long { n: MAX_VALUES + 1 });
    assert_eq!(error(1e-5, vec![0.0, -2e6], 1.0), ReliefError::Value { index: 1, value: -2e6 });
    assert!(matches!(error(1e-5, vec![0.0; 4], f64::NAN), ReliefError::Force { .. }));
}

#[test]
fn heights_get_a_level() {
    let heights = Profile::new(1e-5, (0..100).map(|i| 7.0 + 1e-6 * f64::from(i % 10)).collect()).unwrap();
    let relief = Relief::of_level(&heights, 1.5, Newtons(1.0)).unwrap();
    let values = relief.profile().values();
    assert!((values.iter().map(|x| x * x).sum::<f64>() / 100.0 - 2.25).abs() < 1e-6);
    assert!(values.iter().sum::<f64>().abs() < 1e-6 && values[9] > values[0]);
    let flat = Profile::new(1e-5, vec![0.1; 100]).unwrap();
    assert_eq!(Relief::of_level(&flat, 1.0, Newtons(1.0)), Err(ReliefError::Flat));
    for level_mps2 in [0.0, -1.0, f64::INFINITY] {
        let error = Relief::of_level(&heights, level_mps2, Newtons(1.0));
        assert_eq!(error, Err(ReliefError::Level { level_mps2 }));
    }
}

/// Values at their positions, linear interpolation between them, and mirroring beyond the ends.
#[test]
fn beyond_its_end_it_comes_back() {
    let relief = relief(1e-3, vec![1.0, 2.0, 4.0], 1.0);
    for (place_mm, wanted) in [(0.0, 1.0), (0.5, 1.5), (2.0, 4.0), (2.5, 4.0), (3.0, 4.0), (4.5, 1.5)] {
        for whole in [0.0, 6.0, -6.0, -60.0] {
            let got = relief.at(1e-3 * (place_mm + whole));
            assert!((got - wanted).abs() < 1e-9, "got {got}, expected {wanted} at {place_mm} + {whole} mm");
        }
    }
    assert!((relief.at(-1e-3) - 1.0).abs() < 1e-12 && (relief.at(-2e-3) - 2.0).abs() < 1e-12);
}

/// The first octave contains all values that its band can represent; each further octave is the lower half of the band.
#[test]
fn octaves_are_the_relief_and_its_lower_bands() {
    // Cosines with whole periods over the mirrored length are represented exactly, at any length.
    let wave = |k: usize, n: usize, i: usize| (TAU * (k * (2 * i + 1)) as f64 / (4 * n) as f64).cos();
    for n in [100, 257] {
        let values = (0..n).map(|i| wave(6, n, i) + 0.5 * wave(45, n, i)).collect();
        let octaves = relief(1e-4, values, 2.0).octaves();
        let view = octaves.view();
        assert!(view.n() >= 4 * n && view.n() < 8 * n && view.force_n() == 2.0);
        let length_m = f64::from(view.step_m()) * view.n() as f64;
        assert!((length_m / (2e-4 * n as f64) - 1.0).abs() < 1e-6);
        let (mut begin, mut m) = (0, view.n());
        while m >= 4 {
            let holds = |k: usize| 4 * k <= m;
            for (i, got) in view.octaves()[begin..begin + m].iter().enumerate() {
                // Position in values, from the middle of the first one.
                let at = 2.0 * n as f64 * i as f64 / m as f64 + 0.5;
                let part = |k: usize| {
                    if holds(k) { (TAU * k as f64 * at / (2 * n) as f64).cos() } else { 0.0 }
                };
                let wanted = part(6) + 0.5 * part(45);
                assert!(
                    (f64::from(*got) - wanted).abs() < 1e-5,
                    "got {got}, expected {wanted}, at {i} of {m}"
                );
            }
            (begin, m) = (begin + m, m / 2);
        }
        assert_eq!(begin, view.octaves().len());
    }
}

#[test]
fn a_blend_is_the_sum_by_weight() {
    let bumps = relief(1e-4, (0..300).map(|i| f64::from(i % 7)).collect(), 1.0);
    let waves = relief(3e-4, (0..50).map(|i| (0.3 * f64::from(i)).sin()).collect(), 2.0);
    let blend = Relief::blended(&[(Some(&bumps), 0.5), (Some(&waves), 0.25), (None, 0.25)]).unwrap();
    assert!((blend.force().0 - 4.0 / 3.0).abs() < 1e-12);
    assert!((blend.profile().step_m(), blend.profile().values().len()) == (1e-4, 300));
    for i in 0..300 {
        let place_m = 1e-4 * f64::from(i);
        // At the same force, independent of each relief's own force.
        let wanted = 0.5 * bumps.at(place_m) + 0.25 * waves.at(place_m) / 2.0;
        assert!((blend.at(place_m) / blend.force().0 - wanted).abs() < 1e-9);
    }
    assert_eq!(Relief::blended(&[(Some(&bumps), 1.0), (Some(&waves), 0.0)]), Some(bumps.clone()));
    assert_eq!(Relief::blended(&[(None, 1.0)]), None);
    assert_eq!(Relief::blended(&[]), None);
    // Weights of a field sum to one, and some are negative.
    let field = Relief::blended(&[(Some(&bumps), 1.25), (Some(&bumps), -0.25)]).unwrap();
    assert!((0..300).all(|i| (field.at(1e-4 * f64::from(i)) - bumps.at(1e-4 * f64::from(i))).abs() < 1e-9));
    // A long relief and a fine one together exceed the maximum number of values: the length is cut.
    let long = relief(1e-2, vec![1.0; 6000], 1.0);
    let both = Relief::blended(&[(Some(&bumps), 0.5), (Some(&long), 0.5)]).unwrap();
    assert_eq!((both.profile().values().len(), both.profile().step_m()), (MAX_VALUES, 1e-4));
}

proptest! {
    #[test]
    fn what_is_accepted_is_taken_by_the_renderer(
        values in prop::collection::vec(-MAX_MPS2..MAX_MPS2, 2..300),
        ln_step in -16.1_f64..-4.7,
        force_n in 1e-3_f64..1e3,
    ) {
        let octaves = relief(ln_step.exp(), values, force_n).octaves();
        let view = octaves.view();
        let checked = SynthRelief::new(view.step_m(), view.force_n(), view.n(), view.octaves());
        prop_assert_eq!(checked, Ok(view));
        prop_assert!(view.n().is_power_of_two());
    }
}
