//! Silence after lift-off, and bounds on the output, for any texture, tap transient and actuator.

use std::time::Instant;

use proptest::prelude::{Just, ProptestConfig, Strategy, prop, prop_assert, prop_oneof, proptest};
use shagreen_synth::contact::Contact;
use shagreen_synth::drive::{DriveConfig, Inverse};
use shagreen_synth::equalizer::Resonance;
use shagreen_synth::renderer::{Blend, Mix};
use shagreen_synth::tap::Tap;

use super::{CONFIG, play};
use crate::controls::{Drive, Input};
use crate::engine::{EngineConfig, new};
use crate::texture::OwnedTexture;
use crate::texture::tests::{layered, with_lsf};
use crate::touch::Touch;
use crate::track::{PenSample, Track};

/// Longest time from lift-off to silence that users are promised, in seconds.
const PROMISED_SECS: f64 = 0.3;
const LIFT_SECS: f64 = 0.4;

/// Number of cases: few in a test, many by `scripts/abuse`.
fn n_cases() -> u32 {
    std::env::var("SHAGREEN_ABUSE_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(48)
}

/// Line spectral frequencies with these gaps, in any proportion.
fn lsf_of(gaps: &[f32]) -> Vec<f32> {
    let sum: f32 = gaps.iter().sum();
    let mut at = 0.0;
    let next = |gap: &f32| {
        at += gap * std::f32::consts::PI / sum;
        at
    };
    gaps[..gaps.len() - 1].iter().map(next).collect()
}

/// Rotation, height, kinetic coefficient and static ratio of a texture with all layers; `None` has none.
type Layers = Option<[f32; 4]>;

fn any_layers() -> impl Strategy<Value = Layers> {
    let layers = (-10.0_f32..10.0, -0.1_f32..0.1, 0.0_f32..20.0, 0.0_f32..8.0);
    prop::option::of(layers.prop_map(|(turn, height, kinetic, ratio)| [turn, height, kinetic, ratio]))
}

/// A texture with these layers, if it is valid.
fn with_layers(texture: OwnedTexture, layers: Layers) -> Option<OwnedTexture> {
    match layers {
        None => Some(texture),
        Some(layers) => layered(&texture, layers).ok(),
    }
}

/// One thing that someone, or a faulty device, does to a running engine.
#[derive(Clone, Debug)]
enum Abuse {
    /// Loads a texture of these gaps, level and layers, and fades to it.
    Load(Vec<f32>, f32, Layers),
    /// Fades out the texture with this index.
    Unload(usize),
    Tap(f32, f32, f32),
    Touch(f32, f32, f32),
    Gain(f32),
    /// Only waits.
    Wait(u16),
}

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -2.0_f32..10.0,
        1 => Just(f32::NAN),
        1 => Just(f32::INFINITY),
        1 => -1e38_f32..1e38,
        1 => Just(0.0_f32),
    ]
}

fn any_abuse() -> impl Strategy<Value = Abuse> {
    let gaps = prop::collection::vec(1e-4_f32..1.0, 2..=33);
    prop_oneof![
        2 => (gaps, 0.0_f32..1e6, any_layers()).prop_map(|(gaps, level, layers)| Abuse::Load(gaps, level, layers)),
        1 => (0_usize..8).prop_map(Abuse::Unload),
        1 => (any_number(), any_number(), any_number()).prop_map(|(f, b, a)| Abuse::Tap(100.0 * f, b, a)),
        6 => (any_number(), any_number(), any_number()).prop_map(|(x, v, f)| Abuse::Touch(x, v, f)),
        1 => any_number().prop_map(Abuse::Gain),
        3 => (1_u16..4000).prop_map(Abuse::Wait),
    ]
}

/// Stroke that touches from 0.1 s to [`LIFT_SECS`].
fn stroke() -> Track {
    let sample = |i: u32| {
        let time_secs = f64::from(i) * 0.01;
        let touching = i >= 10 && time_secs < LIFT_SECS;
        PenSample {
            time_secs,
            x_m: 0.3 * time_secs,
            force_n: if touching { 1.0 } else { 0.0 },
            touching,
            impact_mps: Some(0.3),
            ..PenSample::default()
        }
    };
    Track::new(&(0..150).map(sample).collect::<Vec<_>>()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: n_cases(), ..ProptestConfig::default() })]

    #[test]
    fn everything_is_silent_soon_after_lift_off(
        gaps in prop::collection::vec(1e-4_f32..1.0, 4..=33),
        model_rate_hz in 200.0_f32..4000.0,
        level in 0.0_f32..1e6,
        tap in (0.0_f32..3000.0, -10.0_f32..1e3, -1e30_f32..1e30),
        coil in (30.0_f64..300.0, 0.5_f64..3000.0, 0.01_f64..30.0),
        layers in any_layers(),
    ) {
        let lsf = lsf_of(&gaps);
        let (frequency_hz, q, lowest_hz) = coil;
        let inverse = Inverse { resonance: Resonance { frequency_hz, q, gain_mps2_per_volt: 1.0 }, lowest_hz };
        let drive = DriveConfig { inverse: Some(inverse), look_ahead_secs: 0.002, ..DriveConfig::proportional(5.0, 0.9) };
        let (mut handle, mut engine) = new(EngineConfig { model_rate_hz, drive, ..CONFIG }).unwrap();
        let Ok(texture) = with_lsf(model_rate_hz, level, &lsf) else { return Ok(()) };
        let Some(texture) = with_layers(texture, layers) else { return Ok(()) };
        let id = handle.load(texture).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        handle.set_tap(Tap { frequency_hz: tap.0, decay_per_sec: tap.1, amplitude_mps2: tap.2 });
        handle.play_track(stroke()).unwrap();
        let out = play(&mut engine, 72_000, 256);
        prop_assert!(out.iter().all(|x| x.abs() <= 0.9), "above the ceiling, or not finite");
        let begun = out.iter().position(|x| *x != 0.0);
        let silent = ((LIFT_SECS + PROMISED_SECS) * 48_000.0) as usize;
        prop_assert!(out[silent..].iter().all(|x| *x == 0.0));
        prop_assert!(begun.is_none_or(|frame| frame > 3000), "before contact");
    }

    #[test]
    fn no_abuse_reaches_the_coil(steps in prop::collection::vec(any_abuse(), 1..60), look_ahead in prop::bool::ANY) {
        let look_ahead_secs = if look_ahead { 0.002 } else { 0.0 };
        let drive = DriveConfig { look_ahead_secs, ..DriveConfig::proportional(5.0, 0.9) };
        let (mut handle, mut engine) = new(EngineConfig { drive, ..CONFIG }).unwrap();
        handle.set_input(Input::Live);
        let mut live = handle.take_live_input().unwrap();
        let mut loaded = Vec::new();
        let mut n_frames = 0;
        for step in steps {
            let mut frames = 480;
            match step {
                Abuse::Load(gaps, level, layers) => {
                    let texture = with_lsf(1000.0, level, &lsf_of(&gaps)).ok();
                    let texture = texture.and_then(|texture| with_layers(texture, layers));
                    if let Some(texture) = texture && let Ok(id) = handle.load(texture) {
                        loaded.push(id);
                        handle.set_mix(Mix::solo(id)).unwrap();
                    }
                }
                Abuse::Unload(index) => {
                    if index < loaded.len() {
                        let id = loaded.swap_remove(index);
                        handle.set_mix(Mix::silent(Blend::Shared)).unwrap();
                        handle.unload(id);
                    }
                }
                Abuse::Tap(frequency_hz, decay_per_sec, amplitude_mps2) => {
                    handle.set_tap(Tap { frequency_hz, decay_per_sec, amplitude_mps2 });
                }
                Abuse::Touch(x_m, speed_mps, force_n) => {
                    let touch = Touch { x_m, y_m: x_m, contact: Contact { speed_mps, force_n } };
                    live.land(touch, Instant::now(), Some(speed_mps)).unwrap();
                }
                Abuse::Gain(gain) => handle.set_drive(Drive { gain, ..Drive::default() }),
                Abuse::Wait(n) => frames = usize::from(n),
            }
            let out = play(&mut engine, frames, 256);
            n_frames += frames;
            prop_assert!(out.iter().all(|x| x.abs() <= 0.9), "after {n_frames} frames");
            handle.collect();
        }
        live.send(Touch::default(), Instant::now()).unwrap();
        let after = play(&mut engine, 24_000, 256);
        prop_assert!(after.iter().all(|x| x.abs() <= 0.9));
        prop_assert!(after[(PROMISED_SECS * 48_000.0) as usize..].iter().all(|x| *x == 0.0));
    }
}

/// Negative control: while the tip touches, the same texture sounds on.
#[test]
fn a_texture_sounds_on_while_the_tip_touches() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    let id = handle.load(with_lsf(1000.0, 1.0, &[0.5, 0.51, 2.0]).unwrap()).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Hand(super::HAND));
    let out = play(&mut engine, 96_000, 256);
    assert!(out[90_000..].iter().any(|x| x.abs() > 0.01));
}
