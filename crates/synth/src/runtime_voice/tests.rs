extern crate std;
use super::stroke::Stroke;
use super::{Lent, RuntimeVoice, Touch, VoiceError, VoiceSettings};
use crate::contact::{Contact, ContactSource, Place};
use crate::drive::KNEE_SHARE;
use crate::impact::TAP_SHARE;
use crate::lift_gate::SILENT_AFTER_SECS;
use crate::renderer::Mix;
use crate::stick_slip::Friction;
use crate::stream::Stream;
use crate::tap::{Tap, Taps};
use crate::texture::tests::{parts, square};
use crate::texture::{Node, Parts, Texture, Triangle};
use proptest::prelude::{any, prop, prop_assert, proptest};
use std::vec;
use std::vec::Vec;

const SETTINGS: VoiceSettings = VoiceSettings { sample_rate_hz: 48_000.0, max_mps2: 1000.0, seed: 9 };
const WOOD: Tap = Tap { frequency_hz: 180.0, decay_per_sec: 90.0, amplitude_mps2: 6.0 };
const LIFTED: Touch = Touch { x_m: 0.0, y_m: 0.0, contact: Contact::LIFTED };
const NONE: &[Touch] = &[];
/// Frames in a tick of 5 ms.
const TICK: usize = 240;

fn texture((nodes, triangles): &([Node; 4], [Triangle; 2])) -> Texture<'_> {
    Texture::new(parts(nodes, triangles)).unwrap()
}

fn pressed(x_m: f64, speed_mps: f32, force_n: f32) -> Touch {
    Touch { x_m, y_m: 0.0, contact: Contact { speed_mps, force_n } }
}

/// Contacts that are given for each tick.
struct Ticks(Vec<Touch>, usize);

impl ContactSource for Ticks {
    fn contact_at(&mut self, _time_secs: f64) -> Contact {
        self.1 += 1;
        self.0[self.1 - 1].contact
    }

    fn place(&self) -> Place {
        let Touch { x_m, y_m, .. } = self.0[self.1 - 1];
        Place { x_m, y_m, n_jumps: 0 }
    }
}

/// While the tip touches, the samples are those of the stream, bit by bit. Each tick has the touch at its begin: all but one
/// frame of the block before.
#[test]
fn samples_in_contact_are_those_of_the_stream() {
    let data = square();
    let texture = texture(&data);
    let touch = |i: usize| match i {
        0 => LIFTED,
        _ => pressed(1e-3 * i as f64, 0.2 + 0.01 * i as f32, 1.0 - 0.015 * i as f32),
    };
    let n_blocks = 60;
    let mut voice = RuntimeVoice::new(&texture, None, SETTINGS).unwrap();
    let mut out = vec![f32::NAN; n_blocks * TICK];
    for (i, block) in out.chunks_mut(TICK).enumerate() {
        voice.process(&texture, &[touch(i)], block);
    }
    let at_begin = |i: usize| {
        let touches = [touch(i)];
        Stroke::new(touch(i.saturating_sub(1)), &touches, (TICK * i) as u64, TICK).at((TICK * i) as f64)
    };
    let mut ticks = Ticks((0..=n_blocks).map(at_begin).collect(), 0);
    let mut stream = Stream::new(1000.0, 48_000.0, 9);
    stream.set_mix(Mix::solo(0));
    let mut expected = vec![f32::NAN; out.len()];
    stream.process(&Lent(texture), &mut ticks, &mut expected);
    // The gate opens within 50 µs of the landing.
    let landed = TICK + 3;
    assert!(out[..TICK].iter().all(|x| *x == 0.0));
    let differs = out[landed..].iter().zip(&expected[landed..]).position(|(x, y)| x.to_bits() != y.to_bits());
    assert_eq!(differs, None);
    assert!(out[2000..].iter().any(|x| x.abs() > 0.1));
}

/// Frames with the tip lifted, then pressed at one place.
fn steady(texture: &Texture<'_>, block: usize) -> Vec<f32> {
    let mut voice = RuntimeVoice::new(texture, Some(WOOD), SETTINGS).unwrap();
    let mut out = vec![f32::NAN; 20 * TICK + 9600];
    let (before, after) = out.split_at_mut(20 * TICK);
    before.chunks_mut(block).for_each(|part| voice.process(texture, &[LIFTED], part));
    voice.tap(Some(0.1));
    after.chunks_mut(block).for_each(|part| voice.process(texture, &[pressed(0.0, 0.8, 0.9)], part));
    out
}

#[test]
fn blocks_of_any_size_give_the_same_samples() {
    let data = square();
    let whole = steady(&texture(&data), 100_000);
    assert!(whole.iter().all(|x| x.is_finite()) && whole.iter().any(|x| x.abs() > 0.1));
    for block in [1, 7, 64, 239, 240, 241, 1000, 4096] {
        assert!(steady(&texture(&data), block) == whole, "blocks of {block}");
    }
}

#[test]
fn a_tap_begins_with_the_next_sample() {
    let (mut nodes, triangles) = square();
    nodes[2].level_mps2 = 0.0;
    let data = (nodes, triangles);
    let texture = texture(&data);
    let mut voice = RuntimeVoice::new(&texture, Some(WOOD), SETTINGS).unwrap();
    let mut out = vec![f32::NAN; 4800];
    voice.process(&texture, NONE, &mut out[..1001]);
    voice.tap(None);
    voice.process(&texture, NONE, &mut out[1001..]);
    let mut taps = Taps::new(48_000.0);
    taps.strike(WOOD, 1.0);
    let mut expected = vec![0.0; 3799];
    taps.add_to(&mut expected);
    assert!(out[..1001].iter().all(|x| *x == 0.0));
    assert_eq!(out[1001..], expected);
    // A tap that the limiter would bend is played within its linear range.
    let settings = VoiceSettings { max_mps2: 2.0, ..SETTINGS };
    let mut voice = RuntimeVoice::new(&texture, Some(WOOD), settings).unwrap();
    voice.tap(None);
    voice.process(&texture, NONE, &mut out);
    let peak = out.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
    assert!((0.5..1.0).contains(&(peak / (TAP_SHARE * KNEE_SHARE * 2.0))), "{peak}");
}

#[test]
fn the_output_is_silent_a_quarter_of_a_second_after_lift_off() {
    let (mut nodes, triangles) = square();
    // A resonance that rings for minutes.
    for node in &mut nodes {
        (node.lsf[0], node.lsf[1]) = (0.5, 0.500_01);
    }
    let data = (nodes, triangles);
    let texture = texture(&data);
    let mut voice = RuntimeVoice::new(&texture, None, SETTINGS).unwrap();
    let mut out = vec![0.0; 4800];
    voice.process(&texture, &[pressed(0.0, 1.0, 1.0)], &mut out);
    assert!(out.iter().any(|x| x.abs() > 1e-3));
    let mut out = vec![f32::NAN; 48_000];
    out.chunks_mut(TICK).for_each(|part| voice.process(&texture, &[LIFTED], part));
    // The contact ends with the tick of the lift-off.
    let silent = (SILENT_AFTER_SECS * 48_000.0) as usize + 2 * TICK;
    assert!(out[silent..].iter().all(|x| *x == 0.0));
    assert!(out[..TICK].iter().any(|x| *x != 0.0));
}

#[test]
fn a_sample_that_is_not_finite_silences_until_a_reset() {
    let data = square();
    let good = texture(&data);
    let (mut nodes, triangles) = data;
    nodes[2].level_mps2 = f32::INFINITY;
    let bad = Texture::checked_before(parts(&nodes, &triangles));
    let mut voice = RuntimeVoice::new(&good, None, SETTINGS).unwrap();
    let mut out = vec![f32::NAN; 4800];
    voice.process(&bad, &[pressed(0.0, 1.0, 1.0)], &mut out);
    assert!(voice.is_tripped() && out.iter().all(|x| x.is_finite()));
    voice.process(&good, &[pressed(0.0, 1.0, 1.0)], &mut out);
    assert!(out.iter().all(|x| *x == 0.0));
    voice.reset();
    voice.process(&good, &[pressed(0.0, 1.0, 1.0)], &mut out);
    let mut fresh = RuntimeVoice::new(&good, None, SETTINGS).unwrap();
    let mut expected = vec![f32::NAN; 4800];
    fresh.process(&good, &[pressed(0.0, 1.0, 1.0)], &mut expected);
    assert!(!voice.is_tripped() && out == expected && out.iter().any(|x| *x != 0.0));
}

#[test]
fn friction_is_the_coefficient_times_the_force() {
    let data = square();
    let friction = Friction { kinetic: 0.4, static_ratio: 1.0, stribeck_speed_mps: 0.02 };
    let rubbed = Texture::new(Parts { friction: Some(friction), ..texture(&data).parts() }).unwrap();
    let mut voice = RuntimeVoice::new(&rubbed, None, SETTINGS).unwrap();
    for (touch, friction_n) in
        [(pressed(0.0, 0.1, 2.0), 0.8), (LIFTED, 0.0), (pressed(0.0, 0.1, f32::NAN), 0.0)]
    {
        voice.process(&rubbed, &[touch], &mut [0.0; 8]);
        assert_eq!(voice.friction_n(&rubbed), friction_n);
    }
    voice.process(&rubbed, &[pressed(0.0, 0.1, 2.0)], &mut [0.0; 8]);
    assert_eq!(voice.friction_n(&texture(&data)), 0.0);
    // A block without frames moves the tip, too.
    voice.process(&rubbed, &[pressed(0.0, 0.1, 1.0)], &mut []);
    assert_eq!(voice.friction_n(&rubbed), 0.4);
}

#[test]
fn touches_are_linear_between_and_held_at_a_landing() {
    let touches = [pressed(1.0, 0.0, 1.0), pressed(2.0, 1.0, 3.0), LIFTED, pressed(4.0, 0.5, 1.0)];
    let stroke = Stroke::new(LIFTED, &touches, 100, 40);
    let at = |frame: f64| {
        let Touch { x_m, contact: Contact { speed_mps, force_n }, .. } = stroke.at(frame);
        (x_m, speed_mps, force_n)
    };
    // The touches lie at frames 109, 119, 129 and 139.
    for (frame, expected) in [
        (0.0, (1.0, 0.0, 1.0)),
        (100.0, (1.0, 0.0, 1.0)),
        (109.0, (1.0, 0.0, 1.0)),
        (114.0, (1.5, 0.5, 2.0)),
        (124.0, (1.0, 0.5, 1.5)),
        (134.0, (4.0, 0.5, 1.0)),
        (139.0, (4.0, 0.5, 1.0)),
        (900.0, (4.0, 0.5, 1.0)),
    ] {
        assert_eq!(at(frame), expected, "{frame}");
    }
    let held = Stroke::new(touches[1], NONE, 0, 10);
    assert_eq!(held.at(5.0), touches[1]);
}

#[test]
fn settings_that_cannot_be_played_are_refused() {
    let data = square();
    let error = |change: VoiceSettings| RuntimeVoice::new(&texture(&data), None, change).err();
    for sample_rate_hz in [f32::NAN, 0.0, -1.0, 999.0, 800_000.0, f32::INFINITY] {
        assert_eq!(error(VoiceSettings { sample_rate_hz, ..SETTINGS }), Some(VoiceError::Rate));
    }
    for max_mps2 in [f32::NAN, 0.0, -1.0, f32::INFINITY] {
        assert_eq!(error(VoiceSettings { max_mps2, ..SETTINGS }), Some(VoiceError::Limit));
    }
    assert_eq!(error(VoiceSettings { sample_rate_hz: 1000.0, ..SETTINGS }), None);
    let fast = Texture::new(Parts { rate_hz: 8000.0, ..texture(&data).parts() }).unwrap();
    assert_eq!(RuntimeVoice::new(&fast, None, SETTINGS).err(), Some(VoiceError::Rate));
}

/// A voice is small enough for a microcontroller.
#[test]
fn a_voice_takes_less_than_20_kb() {
    assert!(size_of::<RuntimeVoice>() < 20_000, "{}", size_of::<RuntimeVoice>());
}

proptest! {
    #[test]
    fn no_touch_gives_a_sample_above_the_limit(
        values in prop::collection::vec((any::<f64>(), any::<f32>(), any::<f32>()), 0..20),
        block in 1_usize..600,
        max_mps2 in 0.01_f32..10.0,
    ) {
        let data = square();
        let texture = texture(&data);
        let mut voice = RuntimeVoice::new(&texture, Some(WOOD), VoiceSettings { max_mps2, ..SETTINGS }).unwrap();
        let touches: Vec<Touch> =
            values.into_iter().map(|(x_m, speed_mps, force_n)| pressed(x_m, speed_mps, force_n)).collect();
        let mut out = vec![f32::NAN; block];
        for few in touches.chunks(3) {
            voice.tap(few.first().map(|touch| touch.contact.speed_mps));
            voice.process(&texture, few, &mut out);
            prop_assert!(out.iter().all(|x| x.abs() <= max_mps2), "{out:?}");
        }
    }
}
