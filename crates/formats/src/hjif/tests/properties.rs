use proptest::collection::vec;
use proptest::option;
use proptest::prelude::{Just, Strategy, any, prop_assert, prop_assert_eq, prop_oneof, proptest};
use proptest::sample::select;
use serde_json::Value;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Contact, Hertz};

use super::rules::{checked, valid};
use super::{amplitudes_mps2, made};
use crate::hjif::{
    ActuatorType, Band, BandType, BaseSignal, Channel, Checked, CurveType, Direction, Effect, EffectType,
    Hjif, Keyframe, Modality, Perception, Profile, ReferenceDevice, SyncPoint, check_hjif, read_hjif,
    write_hjif,
};
use crate::library::TextureEntry;

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-1.0_f64..1.0, Just(0.0), -1e9_f64..1e9]
}

fn keyframe() -> impl Strategy<Value = Keyframe> {
    (option::of(any::<i32>()), option::of(number()), option::of(any::<i32>())).prop_map(
        |(relative_position, amplitude_modulation, frequency_modulation)| Keyframe {
            relative_position,
            amplitude_modulation,
            frequency_modulation,
        },
    )
}

fn effect() -> impl Strategy<Value = Effect> {
    let types = select(vec![EffectType::Basis, EffectType::Reference, EffectType::Composite]);
    let signals = select(vec![BaseSignal::Sine, BaseSignal::SawToothDown]);
    let numbers = (option::of(any::<i32>()), option::of(any::<i32>()), option::of(number()));
    (types, numbers, option::of(signals), option::of("[A-Z/a-z]{0,12}"), vec(keyframe(), 0..4)).prop_map(
        |(effect_type, (id, position, phase), base_signal, semantic_keywords, keyframes)| Effect {
            effect_type,
            id,
            position,
            phase,
            base_signal,
            wavelet_stream: semantic_keywords.clone(),
            semantic_keywords,
            keyframes,
        },
    )
}

fn band() -> impl Strategy<Value = Band> {
    let types =
        select(vec![BandType::Transient, BandType::Curve, BandType::VectorialWave, BandType::WaveletWave]);
    let curves = option::of(select(vec![CurveType::Akima, CurveType::BSpline]));
    (types, curves, option::of(any::<i32>()), any::<[i32; 2]>(), vec(effect(), 0..4)).prop_map(
        |(band_type, curve_type, number, [lower, upper], effects)| Band {
            band_type,
            curve_type,
            block_length: number,
            lower_frequency_limit: lower,
            upper_frequency_limit: upper,
            priority: number,
            effects,
        },
    )
}

fn channel() -> impl Strategy<Value = Channel> {
    let parts = (any::<i32>(), "\\PC{0,8}", number(), any::<u32>(), option::of(any::<[i8; 3]>()));
    (parts, vec(any::<i32>(), 0..3), vec(band(), 0..3)).prop_map(
        |((id, description, gain, mask, direction), vertices, bands)| Channel {
            id,
            body_part_target: vec![description.clone(); vertices.len()],
            description,
            gain,
            mixing_coefficient: 1.0,
            body_part_mask: mask,
            priority: Some(id),
            reference_device_id: None,
            frequency_sampling: Some(mask),
            sample_count: None,
            direction: direction.map(|[x, y, z]| Direction { x, y, z }),
            actuator_resolution: None,
            actuator_target: Vec::new(),
            vertices,
            bands,
        },
    )
}

fn device() -> impl Strategy<Value = ReferenceDevice> {
    (any::<i32>(), "\\PC{0,8}", option::of(any::<u32>()), any::<bool>(), vec(option::of(number()), 11))
        .prop_map(|(id, name, body_part_mask, is_coil, numbers)| ReferenceDevice {
            id,
            name,
            body_part_mask,
            maximum_frequency: numbers[0],
            minimum_frequency: numbers[1],
            resonance_frequency: numbers[2],
            maximum_amplitude: numbers[3],
            impedance: numbers[4],
            maximum_voltage: numbers[5],
            maximum_current: numbers[6],
            maximum_displacement: numbers[7],
            weight: numbers[8],
            size: numbers[9],
            custom: numbers[10],
            kind: is_coil.then_some(ActuatorType::Lra),
        })
}

fn file() -> impl Strategy<Value = Hjif> {
    let modalities = select(vec![Modality::VibrotactileTexture, Modality::Other]);
    let parts = (vec(device(), 0..2), vec(effect(), 0..3), vec(channel(), 0..3));
    let perception = (any::<[i32; 2]>(), modalities, option::of(any::<i8>()), parts).prop_map(
        |([id, avatar_id], perception_modality, exponent, (reference_devices, effect_library, channels))| {
            Perception {
                id,
                avatar_id,
                description: String::new(),
                perception_modality,
                priority: None,
                unit_exponent: exponent,
                perception_unit_exponent: exponent,
                effect_semantic_scheme: exponent.map(|exponent| exponent.to_string()),
                reference_devices,
                effect_library,
                channels,
            }
        },
    );
    (any::<u32>(), "\\PC{0,12}", option::of(any::<u32>()), vec(perception, 0..3), any::<i32>()).prop_map(
        |(level, text, timescale, perceptions, timestamp)| Hjif {
            version: text.clone(),
            profile: if level % 2 == 0 { Profile::Main } else { Profile::SimpleParametric },
            level,
            date: text.clone(),
            description: text,
            timescale,
            avatars: Vec::new(),
            perceptions,
            syncs: vec![SyncPoint { timestamp, timescale }],
        },
    )
}

/// JSON of any shape with the names of fields of the format.
fn json_of_any_shape() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        select(vec!["Main", "2023", "Basis", "Reference", "Curve", "Friction", ""]).prop_map(Value::from),
    ];
    leaf.prop_recursive(6, 60, 6, |inner| {
        let names = select(vec![
            "version",
            "profile",
            "level",
            "date",
            "description",
            "timescale",
            "avatars",
            "perceptions",
            "syncs",
            "id",
            "avatar_id",
            "effect_library",
            "channels",
            "bands",
            "effects",
            "keyframes",
            "gain",
        ]);
        prop_oneof![
            vec(inner.clone(), 0..6).prop_map(Value::from),
            vec((names, inner), 0..6).prop_map(|fields| {
                Value::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
            }),
        ]
    })
}

proptest! {
    /// The types come back as they were, whatever rules they break, and the check of any of them ends.
    #[test]
    fn every_file_comes_back(file in file()) {
        let bytes = write_hjif(&file);
        let checked = check_hjif(&bytes).unwrap();
        prop_assert_eq!(&checked.file, &file);
        prop_assert_eq!(read_hjif(&bytes).is_ok(), checked.n_faults == 0);
    }

    /// Any JSON, also in the place of a part of a valid file, is checked without a panic.
    #[test]
    fn any_json_is_checked(any in json_of_any_shape(), pointer in select(vec![
        "", "/avatars", "/perceptions", "/perceptions/0", "/perceptions/0/effect_library",
        "/perceptions/0/channels/0", "/perceptions/0/channels/0/bands/0/effects",
        "/perceptions/0/channels/0/bands/1/effects/0/keyframes/0",
    ])) {
        let mut file = valid();
        *file.pointer_mut(pointer).unwrap() = any;
        if let Ok(Checked { file, .. }) = checked(&file) {
            prop_assert!(check_hjif(&write_hjif(&file)).is_ok());
        }
    }

    /// The power of a condition is that of the grain at its node, wherever the nodes lie.
    #[test]
    fn conditions_are_those_of_the_nodes(
        mm_per_s in 5.0_f64..400.0, force_n in 0.05_f64..5.0, level_mps2 in 0.01_f64..50.0,
        low in 0.2_f64..1.0, gap in 0.1_f64..1.0,
    ) {
        let contact = Contact::from_mm_per_s_and_n(mm_per_s, force_n);
        let lsf = vec![low, low + gap, low + gap + 0.4];
        let node = GrainNode { speed: contact.speed, force: contact.force, lsf, level_mps2 };
        let model = TextureModel::new(Hertz(1000.0), vec![node], None).unwrap();
        let made = made(&TextureEntry::new("a", "A", model), None);
        let power: f64 = amplitudes_mps2(&made.perceptions[0]).iter().map(|a| 0.5 * a * a).sum();
        prop_assert!((power.sqrt() / level_mps2 - 1.0).abs() < 1e-5, "{} for {}", power.sqrt(), level_mps2);
    }
}
