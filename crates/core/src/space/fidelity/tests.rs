use proptest::prelude::{prop_assert, proptest};
use serde_json::Value;

use crate::dsp::lsf::lsf_from_ar;
use crate::maths::rng::lcg_noise;
use crate::space::fidelity::{
    Channels, N_CHANNELS, N_CONDITIONS, Profile, chance_db, conditions, error_db, level_error_db,
    mixture_level_mps2, shape_error_db,
};
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;
use crate::texture::test_textures::{arma, two_resonances};
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../../../vectors/o_fidelity/fidelity_vectors.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// A texture of the vector file: nine nodes, one at each condition.
fn texture(vectors: &Value, name: &str) -> Plane {
    let contacts = vectors["conditions"].as_array().unwrap().iter();
    let nodes = contacts.zip(vectors["textures"][name].as_array().unwrap()).map(|(at, node)| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(at[0].as_f64().unwrap()),
        force: Newtons(at[1].as_f64().unwrap()),
        lsf: lsf_from_ar(&numbers(&node["a"])).unwrap(),
        level_mps2: node["level"].as_f64().unwrap(),
    });
    Plane::new(&TextureModel::new(Hertz(1000.0), nodes.collect(), None).unwrap())
}

fn profiles(vectors: &Value) -> Vec<(&'static str, Profile)> {
    let [one, two, quiet] = ["one", "two", "quiet"].map(|name| texture(vectors, name));
    let channels = Channels::of_models();
    let alone = |plane: &Plane| channels.profile(&[(plane, 1.0)], Mode::Field);
    let mixed = |mode| channels.profile(&[(&one, 0.7), (&two, 0.3)], mode);
    vec![
        ("one", alone(&one)),
        ("two", alone(&two)),
        ("quiet", alone(&quiet)),
        ("paper", mixed(Mode::Paper)),
        ("power", mixed(Mode::Power)),
        ("shared", mixed(Mode::Shared)),
    ]
}

/// The golden values to 1e-9 dB: predictors are converted to line spectral frequencies and back.
#[test]
fn golden_profiles_and_distances() {
    let vectors = vectors();
    let profiles = profiles(&vectors);
    for (name, profile) in &profiles {
        let golden = &vectors["profiles"][name];
        let rows = golden["channels_db"].as_array().unwrap();
        let channels: Vec<f64> = rows.iter().flat_map(numbers).collect();
        assert_eq!(channels.len(), N_CONDITIONS * N_CHANNELS);
        for (value, golden) in profile.channels_db.iter().zip(&channels) {
            assert!((value - golden).abs() < 1e-9, "{name}: {value} for {golden}");
        }
        for (value, golden) in profile.levels_db.iter().zip(numbers(&golden["levels_db"])) {
            assert!((value - golden).abs() < 1e-9, "{name}: {value} for {golden}");
        }
    }
    let of = |name: &Value| &profiles.iter().find(|(known, _)| name == known).unwrap().1;
    for pair in vectors["pairs"].as_array().unwrap() {
        let (a, b) = (of(&pair[0]), of(&pair[1]));
        assert!((error_db(a, b) - pair[2].as_f64().unwrap()).abs() < 1e-9, "{pair}");
        assert!((level_error_db(a, b) - pair[3].as_f64().unwrap()).abs() < 1e-9, "{pair}");
    }
}

/// Outside its measured speeds and forces, a texture is compared at the limits of the measured range.
#[test]
fn contacts_stay_where_something_was_measured() {
    let fast = Plane::new(&two_resonances(&[0.09, 0.1], &[0.5, 0.7]));
    let mm_per_s = |c: Contact| c.speed.mm_per_s();
    let contacts = conditions([&fast].into_iter());
    let [first, last] = [contacts[0], contacts[N_CONDITIONS - 1]];
    assert!((mm_per_s(first) - 90.0).abs() < 1e-9 && (mm_per_s(last) - 100.0).abs() < 1e-9);
    assert!((first.force.0, contacts[1].force.0, last.force.0) == (0.5, 0.6, 0.7));
    // If another texture was measured at higher speeds, conditions extend to those speeds.
    let wide = Plane::new(&two_resonances(&[0.03, 0.2], &[0.1, 3.0]));
    let contacts = conditions([&fast, &wide].into_iter());
    assert!((mm_per_s(contacts[0]) - 90.0).abs() < 1e-9);
    assert!((mm_per_s(contacts[N_CONDITIONS - 1]) - 110.0).abs() < 1e-9);
    // A single node gives the same level everywhere.
    let one = Plane::new(&two_resonances(&[0.3], &[2.0]));
    let profile = Channels::of_models().profile(&[(&one, 1.0)], Mode::Shared);
    assert!(profile.levels_db.windows(2).all(|w| (w[0] - w[1]).abs() < 1e-12), "{profile:?}");
}

/// For one texture, the integral over the density is the level of its model.
#[test]
fn the_level_of_one_texture_is_that_of_its_model() {
    let contact = Contact::from_mm_per_s_and_n(85.0, 0.7);
    for model in [two_resonances(&[0.03, 0.15], &[0.3, 1.0]), arma(12, 4)] {
        let plane = Plane::new(&model);
        let want = plane.at(contact).level_mps2;
        for mode in Mode::ALL {
            assert!((mixture_level_mps2(&[(&plane, 1.0)], mode, contact) / want - 1.0).abs() < 1e-12);
            // Two halves of the same texture add up to one signal if they share their excitation.
            let halves = mixture_level_mps2(&[(&plane, 0.5), (&plane, 0.5)], mode, contact);
            let loss = if mode == Mode::Paper { 0.5_f64.sqrt() } else { 1.0 };
            assert!((halves / want - loss).abs() < 1e-9, "{mode:?}: {halves} for {want}");
        }
    }
    assert_eq!(mixture_level_mps2(&[], Mode::Shared, contact), 0.0);
}

/// Differences of +3 and -1 dB in equal number: their mean is 1 dB, and 2 dB remain around it.
#[test]
fn the_shape_error_is_the_spread_of_the_differences() {
    let flat = Profile { channels_db: vec![-20.0; 4], levels_db: vec![0.0; 2] };
    let uneven = Profile { channels_db: vec![-17.0, -21.0, -17.0, -21.0], levels_db: vec![0.0; 2] };
    assert!((shape_error_db(&uneven, &flat) - 2.0).abs() < 1e-12);
    assert!((error_db(&uneven, &flat).powi(2) - 5.0).abs() < 1e-12, "the squares of 2 dB and 1 dB add up");
    let louder = Profile { channels_db: vec![-9.5; 4], levels_db: vec![10.5; 2] };
    assert_eq!(shape_error_db(&louder, &flat), 0.0);
}

/// White noise of known level: every channel has its density, within the random error.
#[test]
fn signals_have_the_profile_of_their_model() {
    let (rate, seconds) = (Hertz(2000.0), 30.0);
    let signals: Vec<Vec<f64>> =
        (0..9).map(|seed| lcg_noise((seconds * rate.0) as usize, seed + 1)).collect();
    let channels = Channels::of_signals(rate);
    let got = channels.profile_of_signals(&signals, rate);
    let variance = signals[0].iter().map(|x| x * x).sum::<f64>() / signals[0].len() as f64;
    let white = Profile {
        channels_db: vec![10.0 * (2.0 * variance / rate.0).log10(); N_CONDITIONS * N_CHANNELS],
        levels_db: vec![10.0 * variance.log10(); N_CONDITIONS],
    };
    let (error, chance) = (error_db(&got, &white), chance_db(seconds));
    // 360 estimates determine their spread to a tenth; overlapping windows increase it somewhat.
    assert!((0.8..1.3).contains(&(error / chance)), "{error} for {chance}");
    assert!(level_error_db(&got, &white) < 0.1);
    assert!((chance_db(4.0 * seconds) / chance - 0.5).abs() < 1e-12);
}

proptest! {
    /// Distance axioms: zero to itself, symmetric, triangle inequality. A gain changes the distance by exactly that
    /// gain.
    #[test]
    fn errors_are_distances(gain_db in -20.0_f64..20.0, shift in 0.8_f64..1.0) {
        let base = two_resonances(&[0.03, 0.15], &[0.3, 1.0]);
        let changed = |gain_db: f64, shift: f64| {
            let nodes = base.nodes().iter().map(|n| GrainNode {
                lsf: n.lsf.iter().map(|w| w * shift).collect(),
                level_mps2: n.level_mps2 * 10.0_f64.powf(gain_db / 20.0),
                ..n.clone()
            });
            let plane = Plane::new(&TextureModel::new(base.rate(), nodes.collect(), None).unwrap());
            Channels::of_models().profile(&[(&plane, 1.0)], Mode::Shared)
        };
        let (a, b, c) = (changed(0.0, 1.0), changed(gain_db, 1.0), changed(gain_db, shift));
        prop_assert!(error_db(&a, &a) == 0.0 && (error_db(&a, &c) - error_db(&c, &a)).abs() < 1e-12);
        prop_assert!((error_db(&a, &b) - gain_db.abs()).abs() < 1e-9);
        prop_assert!((level_error_db(&a, &c) - gain_db.abs()).abs() < 1e-9);
        // Nothing remains of a pure level difference.
        prop_assert!(shape_error_db(&a, &b) < 1e-9);
        prop_assert!(shape_error_db(&a, &c) <= error_db(&a, &c) + 1e-12);
        prop_assert!(error_db(&a, &c) <= error_db(&a, &b) + error_db(&b, &c) + 1e-12);
    }
}
