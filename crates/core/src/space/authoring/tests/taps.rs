//! Tap transients of interpolated textures.

use std::sync::Arc;

use proptest::prelude::{ProptestConfig, prop_assert, proptest};

use super::{World, blendings, point, truth};
use crate::maths::rng::Random;
use crate::space::Space;
use crate::space::authoring::{Authoring, Layers, Models};
use crate::texture::TextureModel;
use crate::texture::plane::Plane;
use crate::texture::tap::Tap;
use crate::units::Hertz;

/// Twelve textures at random positions, with tap transients between those of foam and glass that do not follow from the
/// position, and one texture without.
fn tapping(seed: u64, unknown: usize) -> (World, Vec<Option<Tap>>) {
    let mut random = Random::new(seed);
    let mut between = |low: f64, high: f64| low * (high / low).powf(random.uniform());
    let places: Vec<_> = (0..12).map(|_| point(between(1.0, 100.0), between(1.0, 100.0))).collect();
    let taps: Vec<Option<Tap>> = (0..12)
        .map(|index| {
            let tap = Tap {
                frequency: Hertz(between(20.0, 900.0)),
                decay_per_sec: between(55.0, 180.0),
                amplitude_mps2: between(10.0, 300.0),
            };
            (index != unknown).then_some(tap)
        })
        .collect();
    let textures: Vec<TextureModel> =
        places.iter().zip(&taps).map(|(at, tap)| truth(*at, 0.0).with_tap(*tap)).collect();
    let planes: Vec<Plane> = textures.iter().map(Plane::new).collect();
    let layers: Vec<_> = textures.iter().zip(&planes).map(|(t, plane)| Some(Layers::of(t, plane))).collect();
    let space = Space::new(&places.iter().map(|at| Some(*at)).collect::<Vec<_>>()).unwrap();
    let models = Arc::new(Models::new(&space, &layers).unwrap());
    (World { places, planes, authoring: Authoring::new(space).with_models(models) }, taps)
}

/// Name of a parameter of a tap, and the parameter.
type Part = (&'static str, fn(&Tap) -> f64);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_tap_of_a_blend_lies_between_those_of_its_parents(
        seed in 0_u64..1000,
        unknown in 0_usize..12,
        at in (0.0_f64..100.0, 0.0_f64..100.0),
    ) {
        let (world, taps) = tapping(seed, unknown);
        for blending in blendings(&world) {
            let authored = world.authoring.author(point(at.0, at.1), &blending).unwrap();
            if authored.voices().is_empty() {
                continue;
            }
            let parents: Vec<Tap> = authored.parents.iter().filter_map(|(index, _)| taps[*index]).collect();
            let tap = authored.tap(|index| taps[index]);
            prop_assert!(tap.is_some() != parents.is_empty(), "{blending:?}: {tap:?} of {parents:?}");
            let Some(tap) = tap else { continue };
            let parts: [Part; 3] = [
                ("frequency", |tap| tap.frequency.0),
                ("decay", |tap| tap.decay_per_sec),
                ("amplitude", |tap| tap.amplitude_mps2),
            ];
            for (what, of) in parts {
                let low = parents.iter().map(of).fold(f64::INFINITY, f64::min);
                let high = parents.iter().map(of).fold(0.0, f64::max);
                // Logarithm and exponential function round.
                let (low, high) = (low * (1.0 - 1e-9), high * (1.0 + 1e-9));
                prop_assert!(
                    (low..=high).contains(&of(&tap)),
                    "{what} in {blending:?}: {} is not from {low} to {high}", of(&tap)
                );
            }
        }
    }
}
