//! The level of friction at the output of a whole engine, and behind a serial line.

use std::f64::consts::TAU;
use std::time::Duration;

use shagreen_synth::drive::{DriveConfig, Driven};
use shagreen_synth::renderer::{Blend, Mix, Parent};

use super::{FRICTION_CEILING, FrictionConfig, FrictionWave};
use crate::controls::{Drive, Input};
use crate::edge::Edge;
use crate::engine::{ChannelMask, Engine, EngineConfig, Handle, new};
use crate::hand::{Hand, Path};
use crate::link::link;
use crate::serial::frame::MAX_WIRE;
use crate::serial::message::{Configure, HostMessage, Mode, write_samples, write_to_device};
use crate::serial::receiver::{About, Receiver};
use crate::signal::Signal;
use crate::texture::OwnedTexture;
use crate::texture::tests::{rubbed, wavy, white};

const CARRIER_HZ: f64 = 120.0;
const HAND: Hand = Hand { path: Path::Line, speed_mps: 0.064, force_n: 1.0, extent_m: 0.06 };

fn config(device_rate_hz: f32, wave: FrictionWave) -> EngineConfig {
    EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz,
        seed: 5,
        drive: DriveConfig::proportional(10.0, 1.0),
        channels: ChannelMask::only(0),
        friction: Some(FrictionConfig { channel_idx: 1, wave }),
    }
}

fn with_carrier() -> EngineConfig {
    config(48_000.0, FrictionWave::Carrier { frequency_hz: CARRIER_HZ as f32 })
}

/// An engine that strokes a mix of textures in equal parts.
fn stroking(config: EngineConfig, textures: Vec<OwnedTexture>) -> (Handle, Engine) {
    let (mut handle, engine) = new(config).unwrap();
    let mut mix = Mix::solo(0);
    let weight = 1.0 / textures.len() as f32;
    for (parent, texture) in mix.parents.iter_mut().zip(textures) {
        *parent = Parent { id: handle.load(texture).unwrap(), weight };
    }
    handle.set_mix(mix).unwrap();
    handle.set_input(Input::Hand(HAND));
    (handle, engine)
}

/// Samples of vibration and friction, of three channels.
fn play(engine: &mut Engine, n_frames: usize, block: usize) -> (Vec<f32>, Vec<f32>) {
    let mut out = vec![f32::NAN; 3 * n_frames];
    out.chunks_mut(3 * block).for_each(|part| engine.process(part, 3));
    assert!(out.chunks(3).all(|frame| frame[2] == 0.0), "a channel without a task must be silent");
    (out.iter().step_by(3).copied().collect(), out.iter().skip(1).step_by(3).copied().collect())
}

/// Envelope detector: the amplitude of the carrier in each of its periods, at 48 kHz.
fn envelope(samples: &[f32]) -> Vec<f32> {
    let period = (48_000.0 / CARRIER_HZ) as usize;
    let amplitude = |part: &[f32]| {
        let sum = |wave: fn(f64) -> f64| -> f64 {
            let at = |(i, x): (usize, &f32)| wave(TAU * i as f64 / period as f64) * f64::from(*x);
            part.iter().enumerate().map(at).sum()
        };
        (2.0 / period as f64 * sum(f64::sin).hypot(sum(f64::cos))) as f32
    };
    samples.chunks_exact(period).map(amplitude).collect()
}

fn is_near(found: f32, expected: f32) -> bool {
    (found - expected).abs() < 0.02 * expected
}

#[test]
fn an_envelope_detector_gets_the_level_back() {
    let (mut handle, mut engine) = stroking(with_carrier(), vec![rubbed(white(1.0), 0.45)]);
    let (_, friction) = play(&mut engine, 48_000, 480);
    let levels: Vec<f32> = envelope(&friction).iter().map(|amplitude| amplitude / FRICTION_CEILING).collect();
    // The level fades in within some times the 20 ms of a fade.
    assert!(levels[0] < 0.1 && levels[20..].iter().all(|level| is_near(*level, 0.45)), "{levels:?}");
    // Beyond the full scale of friction, the carrier keeps to its ceiling.
    let sticky = handle.load(rubbed(white(1.0), 3.0)).unwrap();
    handle.set_mix(Mix::solo(sticky)).unwrap();
    let (_, friction) = play(&mut engine, 48_000, 480);
    assert!(friction.iter().all(|x| x.abs() <= FRICTION_CEILING));
    assert!(is_near(*envelope(&friction).last().unwrap(), FRICTION_CEILING));
}

#[test]
fn a_mix_has_the_mean_of_the_known_coefficients() {
    let textures = vec![rubbed(white(1.0), 0.2), white(1.0), rubbed(white(1.0), 0.6)];
    let (_handle, mut engine) = stroking(with_carrier(), textures);
    let (_, friction) = play(&mut engine, 48_000, 480);
    assert!(is_near(envelope(&friction)[100], 0.4 * FRICTION_CEILING));
    let (_handle, mut engine) = stroking(with_carrier(), vec![white(1.0)]);
    assert!(play(&mut engine, 48_000, 480).1.iter().all(|x| *x == 0.0), "an unknown coefficient is silent");
}

#[test]
fn a_lifted_tip_a_muted_output_and_a_signal_are_without_friction() {
    let (mut handle, mut engine) = stroking(with_carrier(), vec![rubbed(white(1.0), 0.45)]);
    let level = |engine: &mut Engine| {
        play(engine, 9600, 480);
        let (_, friction) = play(engine, 4800, 480);
        friction.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()))
    };
    let full = level(&mut engine);
    assert!(full > 0.4);
    handle.set_input(Input::Lifted);
    assert_eq!(level(&mut engine), 0.0);
    handle.set_input(Input::Hand(HAND));
    assert!(is_near(level(&mut engine), full));
    handle.set_drive(Drive { muted: true, gain: 1.0 });
    assert_eq!(level(&mut engine), 0.0);
    // The gain of the vibration does not scale friction.
    handle.set_drive(Drive { muted: false, gain: 0.1 });
    assert!(is_near(level(&mut engine), full));
    let silence = Signal::new(vec![0.0; 96_000], 48_000.0, Driven::Drive).unwrap();
    handle.play_signal(silence).unwrap();
    assert_eq!(level(&mut engine), 0.0);
    drop(handle);
    assert_eq!(level(&mut engine), 0.0);
}

#[test]
fn the_channel_changes_nothing_in_the_vibration_and_has_no_jumps() {
    let run = |friction, block| {
        let config = EngineConfig { friction, ..with_carrier() };
        let (mut handle, mut engine) = stroking(config, vec![rubbed(white(1.0), 0.45)]);
        let mut out = play(&mut engine, 24_000, block);
        handle.set_input(Input::Lifted);
        let rest = play(&mut engine, 24_000, block);
        out.0.extend(rest.0);
        out.1.extend(rest.1);
        out
    };
    let friction = with_carrier().friction;
    let (vibration, felt) = run(friction, 480);
    let (alone, none) = run(None, 480);
    assert!(vibration == alone && none.iter().all(|x| *x == 0.0));
    // A step of the carrier itself, and a little for the fades.
    let steepest = felt.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(steepest < 1.1 * 0.45 * FRICTION_CEILING * (TAU * CARRIER_HZ / 48e3) as f32, "{steepest}");
    assert_eq!(run(friction, 96), (vibration, felt), "blocks must not matter");
}

/// Waves of 0.64 mm with 1 m/s² at 1 N accelerate 40 g with 0.04 N: friction varies by 4 % of its mean, at 100 Hz under a
/// tip of 64 mm/s.
#[test]
fn a_relief_varies_the_level_over_place() {
    let (_handle, mut engine) = stroking(config(10_000.0, FrictionWave::Level), vec![rubbed(wavy(), 0.5)]);
    let (_, levels) = play(&mut engine, 7000, 200);
    let steady = &levels[2000..7000];
    let mean = steady.iter().sum::<f32>() / steady.len() as f32;
    assert!(is_near(mean, 0.5), "{mean}");
    let part = |of: fn(f64) -> f64| -> f64 {
        let at = |(i, x): (usize, &f32)| of(TAU * 100.0 * i as f64 / 1e4) * f64::from(*x);
        2.0 * steady.iter().enumerate().map(at).sum::<f64>() / steady.len() as f64
    };
    let amplitude = part(f64::sin).hypot(part(f64::cos)) as f32;
    assert!((amplitude / 0.02 - 1.0).abs() < 0.1, "{amplitude}");
}

/// A wavy texture and one without heights in turn, at some phases of the wave: the variation is no steeper than the wave itself,
/// which changes by 0.0013 in a sample of 0.1 ms.
#[test]
fn the_variation_over_place_fades_at_a_change_of_the_mix() {
    for n_frames in [2000, 2025, 2050, 2075] {
        let wave = rubbed(wavy(), 0.5);
        let (mut handle, mut engine) = stroking(config(10_000.0, FrictionWave::Level), vec![wave]);
        play(&mut engine, n_frames, 25);
        let plain = handle.load(rubbed(white(1.0), 0.5)).unwrap();
        handle.set_mix(Mix::solo(plain)).unwrap();
        let (_, levels) = play(&mut engine, 1000, 25);
        let steepest = levels.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
        assert!(steepest < 0.002, "{steepest} after {n_frames} frames");
        assert!(levels[500..].iter().all(|level| (level - 0.5).abs() < 1e-3));
    }
}

/// The weights end 20 ms after a silent mix, when the coefficient is still at 37 % of its value. What the waves add to the level
/// of a texture without heights must have faded by then: it bends by less than 0.0005 in 0.1 ms, and a step of 4 % of that
/// coefficient within 0.25 ms would bend it by up to 0.003.
#[test]
fn the_variation_over_place_fades_with_the_texture_into_silence() {
    for n_frames in [2000, 2025, 2050, 2075] {
        let levels = |texture: OwnedTexture| {
            let texture = rubbed(texture, 0.5);
            let (mut handle, mut engine) = stroking(config(10_000.0, FrictionWave::Level), vec![texture]);
            play(&mut engine, n_frames, 25);
            handle.set_mix(Mix::silent(Blend::Shared)).unwrap();
            play(&mut engine, 1000, 25).1
        };
        let (wavy, plain) = (levels(wavy()), levels(white(1.0)));
        let added: Vec<f32> = wavy.iter().zip(&plain).map(|(wavy, plain)| wavy - plain).collect();
        let bend = |three: &[f32]| (three[2] - 2.0 * three[1] + three[0]).abs();
        let sharpest = added.windows(3).map(bend).fold(0.0, f32::max);
        assert!(sharpest < 8e-4, "{sharpest} after {n_frames} frames");
        assert!(added[..100].iter().any(|x| x.abs() > 0.01), "the waves are felt before");
        assert!(added[500..].iter().all(|x| x.abs() < 1e-6));
    }
}

#[test]
fn the_reference_receiver_gets_the_level_back() {
    let config = EngineConfig {
        channels: ChannelMask::NONE,
        friction: Some(FrictionConfig { channel_idx: 0, wave: FrictionWave::Level }),
        ..config(10_000.0, FrictionWave::Level)
    };
    let (mut handle, engine) = stroking(config, vec![rubbed(white(1.0), 0.45)]);
    let (reporter, monitor) = link();
    handle.watch(monitor);
    let mut edge = Edge::new(engine, reporter.shared.clone(), 10_000.0);
    let configure = Configure {
        config: 1,
        mode: Mode::Friction,
        rate_hz: 10_000,
        ceiling: 32_767,
        watchdog_ms: 50,
        window: 100,
        prefill: 60,
        report: 20,
        fade: 30,
        full_scale_cmps2: 0,
    };
    let mut receiver = Receiver::<256>::new(About { has_friction: true, ..About::STREAM });
    let mut wire = [0; MAX_WIRE];
    let len = write_to_device(HostMessage::Configure(configure), &mut wire);
    wire[..len].iter().for_each(|&byte| receiver.receive(byte));
    let (mut played, mut samples) = (Vec::new(), [0_i16; 40]);
    for block in 0..250_u16 {
        edge.fill(&mut samples, 1, Duration::ZERO);
        let len = write_samples(40 * block, receiver.status().run, &samples, &mut wire);
        wire[..len].iter().for_each(|&byte| receiver.receive(byte));
        played.extend((0..40).map(|_| receiver.tick(0)));
    }
    let status = receiver.status();
    assert_eq!((status.underruns, status.bad_frames, status.dropped), (0, 0, 0));
    let levels: Vec<f32> = played.iter().map(|level| f32::from(*level) / 32_767.0).collect();
    assert!(levels.iter().all(|level| (0.0..0.46).contains(level)));
    assert!(levels[3000..].iter().all(|level| is_near(*level, 0.45)), "{:?}", &levels[9990..]);
}
