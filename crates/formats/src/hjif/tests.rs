use std::f64::consts::PI;
use std::sync::Arc;

use shagreen_core::actuator::Actuator;
use shagreen_core::texture::profile::Profile as Heights;
use shagreen_core::texture::relief::Relief;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use super::{
    ActuatorType, Effect, Hjif, HjifWriteError, Modality, Perception, Profile, hjif_of_texture, iso_date,
    lost_in_hjif, read_hjif, write_hjif,
};
use crate::actuator_toml::built_in_actuators;
use crate::library::{Provenance, TextureEntry};
use crate::starter::starter_library;

const WRITTEN_BY: (&str, &str) = ("shagreen test", "2026-01-31");

/// White noise of 1 m/s² at 100 mm/s and 1 N, and of 2 m/s² at 200 mm/s and 1 N: line spectral frequencies of equal
/// distances are those of a filter without effect.
fn white(rate: Hertz) -> TextureEntry {
    let node = |mm_per_s: f64, level_mps2: f64| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(mm_per_s),
        force: Newtons(1.0),
        lsf: vec![PI / 3.0, 2.0 * PI / 3.0],
        level_mps2,
    };
    let model = TextureModel::new(rate, vec![node(100.0, 1.0), node(200.0, 2.0)], Some(0.4)).unwrap();
    TextureEntry::new("white", "White", model)
}

fn made(entry: &TextureEntry, actuator: Option<&Actuator>) -> Hjif {
    let file = hjif_of_texture(entry, actuator, WRITTEN_BY).unwrap();
    assert_eq!(read_hjif(&write_hjif(&file)).unwrap(), file, "{}", entry.id);
    file
}

/// Acceleration in m/s² of an amplitude of 1.
fn full_scale_mps2(perception: &Perception) -> f64 {
    perception.channels[0].gain * 10_f64.powi(i32::from(perception.perception_unit_exponent.unwrap()))
}

/// Amplitude in m/s² of each effect of the library.
fn amplitudes_mps2(perception: &Perception) -> Vec<f64> {
    let full_mps2 = full_scale_mps2(perception);
    let of = |effect: &Effect| full_mps2 * effect.keyframes[0].amplitude_modulation.unwrap();
    perception.effect_library.iter().map(of).collect()
}

/// Closed form: a band of white noise has a share of the power equal to its share of the frequencies, and a sine has half of
/// its squared amplitude.
#[test]
fn each_sine_has_the_power_of_its_band() {
    for (rate, widths) in [
        (1000.0, vec![50.0, 30.0, 45.0, 75.0, 115.0, 185.0]),
        (320.0, vec![50.0, 30.0, 45.0, 35.0]),
        (4000.0, vec![50.0, 30.0, 45.0, 75.0, 115.0, 185.0, 500.0]),
    ] {
        let file = made(&white(Hertz(rate)), None);
        let vibration = &file.perceptions[0];
        assert_eq!(vibration.channels[0].bands.len(), widths.len());
        let expected = [1.0, 2.0].map(|level_mps2: f64| {
            widths
                .iter()
                .map(move |width| level_mps2 * (2.0 * width / (0.5 * rate)).sqrt())
                .collect::<Vec<_>>()
        });
        let got = amplitudes_mps2(vibration);
        assert_eq!(got.len(), 2 * widths.len());
        for (got, expected) in got.iter().zip(expected.concat()) {
            // Six digits of the largest amplitude, and half of the last one.
            assert!((got - expected).abs() < 1e-5 * expected, "{got} for {expected} at {rate} Hz");
        }
        let centers = vibration.effect_library.iter().map(|effect| &effect.keyframes[0]);
        for (keyframe, band) in centers.zip(vibration.channels[0].bands.iter().cycle()) {
            let hz = keyframe.frequency_modulation.unwrap();
            assert!((band.lower_frequency_limit..=band.upper_frequency_limit).contains(&hz), "{hz}");
        }
    }
}

/// The sum of all amplitudes of the strongest condition is full scale, so that no sample exceeds it.
#[test]
fn the_signal_of_a_condition_stays_within_full_scale() {
    let vibration = made(&white(Hertz(1000.0)), None).perceptions.remove(0);
    let amplitudes = amplitudes_mps2(&vibration);
    let sum: f64 = amplitudes[6..].iter().sum();
    assert!((sum / full_scale_mps2(&vibration) - 1.0).abs() < 1e-5, "{sum}");
    // The channel plays the condition nearest to 100 mm/s and 1 N.
    assert_eq!(vibration.channels[0].description, "speed=100 force=1");
    let played: Vec<Option<i32>> =
        vibration.channels[0].bands.iter().map(|band| band.effects[0].id).collect();
    assert_eq!(played, (1..=6).map(Some).collect::<Vec<_>>());
    let about = &vibration.description;
    assert!(about.contains("speed=200 force=1 has effects 7 to 12"), "{about}");
}

#[test]
fn every_starter_texture_follows_the_rules_and_keeps_its_levels() {
    let library = starter_library().unwrap();
    for entry in &library.textures {
        let file = made(entry, None);
        assert_eq!((file.profile, file.level, file.timescale), (Profile::Main, 1, Some(1000)));
        let modalities: Vec<Modality> =
            file.perceptions.iter().map(|perception| perception.perception_modality).collect();
        let expected = [Modality::VibrotactileTexture, Modality::Friction, Modality::Stiffness];
        assert_eq!(modalities, expected);
        let vibration = &file.perceptions[0];
        let n_bands = vibration.channels[0].bands.len();
        let amplitudes = amplitudes_mps2(vibration);
        for (node, sines) in entry.model.nodes().iter().zip(amplitudes.chunks(n_bands)) {
            let power: f64 = sines.iter().map(|amplitude| 0.5 * amplitude * amplitude).sum();
            let level = power.sqrt();
            // Amplitudes have six digits, also those that are a small part of the level.
            assert!((level / node.level_mps2 - 1.0).abs() < 1e-5, "{} {level}", entry.id);
        }
        let constant = |index: usize| {
            let of = &file.perceptions[index];
            full_scale_mps2(of)
                * of.channels[0].bands[0].effects[0].keyframes[0].amplitude_modulation.unwrap()
        };
        assert!((constant(1) / entry.model.friction().unwrap() - 1.0).abs() < 1e-5);
        let stiffness = 10_f64.powf(entry.physical.unwrap().hardness_log10_n_per_m);
        assert!((constant(2) / stiffness - 1.0).abs() < 1e-5);
    }
}

#[test]
fn an_actuator_becomes_the_reference_device() {
    let entry = white(Hertz(1000.0));
    for actuator in built_in_actuators().unwrap() {
        let file = made(&entry, Some(&actuator));
        let vibration = &file.perceptions[0];
        let device = &vibration.reference_devices[0];
        assert_eq!((&device.name, device.kind), (&actuator.name, Some(ActuatorType::Vca)));
        let resonance_hz = actuator.response().ok().map(|response| response.resonance().0);
        assert_eq!(
            (device.resonance_frequency, device.minimum_frequency),
            (resonance_hz, Some(actuator.lowest.0))
        );
        assert_eq!(vibration.channels[0].reference_device_id, Some(device.id));
    }
    let mut actuator = built_in_actuators().unwrap().swap_remove(0);
    actuator.lowest = Hertz(100.0);
    let device = made(&entry, Some(&actuator)).perceptions.remove(0).reference_devices.remove(0);
    assert_eq!(device.minimum_frequency, None, "it would be above the resonance");
}

#[test]
fn a_texture_without_grain_is_refused() {
    let values = (0..100).map(|i| f64::from(i % 7)).collect();
    let relief = Relief::new(Heights::new(1e-5, values).unwrap(), Newtons(1.0)).unwrap();
    let model = TextureModel::of_relief(Arc::new(relief), Hertz(1000.0)).unwrap();
    let refused = hjif_of_texture(&TextureEntry::new("bumps", "Bumps", model), None, WRITTEN_BY).unwrap_err();
    assert_eq!(refused, HjifWriteError::Silent { id: "bumps".to_owned() });
    assert!(refused.to_string().contains("height map"), "{refused}");
}

#[test]
fn what_is_lost_and_restricted_is_said() {
    let library = starter_library().unwrap();
    let rubber = &library.textures[library.index_of("bumpy-rubber").unwrap()];
    let lost = lost_in_hjif(rubber).join("; ");
    for part in ["randomness", "player must choose", "tap", "direction", "stick-slip", "label of roughness"] {
        assert!(lost.contains(part), "{part}: {lost}");
    }
    assert!(!lost.contains("above 1000 Hz"), "{lost}");
    let plain = lost_in_hjif(&white(Hertz(4000.0)));
    assert!(plain.len() == 3 && plain[2].contains("above 1000 Hz"), "{plain:?}");
    let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
    let mut restricted = white(Hertz(1000.0));
    restricted.model = restricted.model.with_stick_slip(Some(stick_slip));
    restricted.provenance = Provenance::Restricted;
    assert!(made(&restricted, None).description.contains("redistribution requires"));
    assert!(lost_in_hjif(&restricted).join("; ").contains("stick-slip"));
}

/// The layout puts each effect of the library on a line.
#[test]
fn a_written_file_is_readable_as_text() {
    let text = String::from_utf8(write_hjif(&made(&white(Hertz(1000.0)), None))).unwrap();
    let effects =
        text.lines().filter(|line| line.trim_start().starts_with("{\"effect_type\":\"Basis\",\"id\":"));
    assert_eq!(effects.count(), 12, "{text}");
    assert!(text.contains("\"perception_modality\": \"Vibrotactile Texture\""), "{text}");
    assert!(!text.contains("null"), "{text}");
    let day = iso_date(1_769_817_600);
    assert!(made(&white(Hertz(1000.0)), None).date == day && text.contains(&day), "{day}");
}

mod properties;
mod rules;
