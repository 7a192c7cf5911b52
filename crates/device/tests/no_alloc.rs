//! Tests that the audio callback neither allocates nor frees memory, whatever the controls are.
//!
//! The gate is the global allocator of this test program. It counts allocations and releases inside `assert_no_alloc`.

#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::time::Instant;

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use shagreen_device::controls::{Drive, Input, Takeover};
use shagreen_device::engine::{self, ChannelMask, Engine, EngineConfig, Handle, SLOTS};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::repeat::Repeat;
use shagreen_device::signal::Signal;
use shagreen_device::synth::contact::Contact;
use shagreen_device::synth::drive::Driven;
use shagreen_device::synth::renderer::{Blend, Mix, Parent};
use shagreen_device::synth::tap::Tap;
use shagreen_device::touch::Touch;
use shagreen_device::track::{PenSample, Track};

use support::{DRIVE, FRICTION, texture};

#[global_allocator]
static GATE: AllocDisabler = AllocDisabler;

const HAND: Hand = Hand { path: Path::Line, speed_mps: 0.5, force_n: 0.5, extent_m: 0.06 };

fn track() -> Track {
    let sample = |i: u32| PenSample {
        time_secs: f64::from(i) * 0.008,
        x_m: f64::from(i) * 1e-3,
        y_m: 0.0,
        force_n: 0.4,
        touching: i % 5 != 4,
        impact_mps: Some(0.02 * f64::from(i)),
    };
    Track::new(&(0..20).map(sample).collect::<Vec<_>>()).unwrap()
}

fn engine() -> (Handle, Engine) {
    let config = EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz: 48_000.0,
        seed: 1,
        drive: DRIVE,
        channels: ChannelMask::only(0),
        friction: Some(FRICTION),
    };
    engine::new(config).unwrap()
}

/// Plays blocks under the gate and checks that every sample is written. Returns the highest magnitude.
fn play(engine: &mut Engine, n_blocks: usize) -> f32 {
    let mut highest = 0.0_f32;
    let mut out = [f32::NAN; 512];
    for _ in 0..n_blocks {
        out.fill(f32::NAN);
        reset_violation_count();
        assert_no_alloc(|| engine.process(&mut out, 2));
        assert_eq!(violation_count(), 0, "the callback allocated or freed");
        assert!(out.iter().all(|x| x.abs() <= 0.9));
        highest = out.iter().fold(highest, |highest, x| highest.max(x.abs()));
    }
    highest
}

#[test]
fn the_gate_sees_an_allocation_and_a_release() {
    reset_violation_count();
    let boxed = assert_no_alloc(|| Box::new(7_u64));
    assert_eq!(violation_count(), 1);
    assert_no_alloc(|| drop(boxed));
    assert_eq!(violation_count(), 2);
}

#[test]
fn the_gate_sees_a_texture_that_is_freed_with_its_engine() {
    let (mut handle, mut engine) = engine();
    handle.load(texture(1.0)).unwrap();
    play(&mut engine, 1);
    reset_violation_count();
    assert_no_alloc(|| drop(engine));
    assert!(violation_count() > 0);
}

#[test]
fn loads_mixes_swaps_and_unloads() {
    let (mut handle, mut engine) = engine();
    assert_eq!(play(&mut engine, 3), 0.0);
    handle.set_input(Input::Hand(HAND));
    for round in 0..200_u16 {
        let id = handle.load(texture(1.0 + f32::from(round % 7))).unwrap();
        let mut mix = Mix {
            blend: [Blend::Paper, Blend::Power, Blend::Shared][usize::from(round % 3)],
            ..Mix::solo(id)
        };
        let other = (id + 1) % 5;
        if handle.is_loaded(other) {
            mix.parents[0].weight = 0.5;
            mix.parents[1] = Parent { id: other, weight: 0.5 };
        }
        handle.set_mix(mix).unwrap();
        let highest = play(&mut engine, 1 + usize::from(round % 11));
        assert!(round < 20 || highest > 0.0);
        // Unloads a playing or an older texture, and collects only occasionally.
        if round % 2 == 0 {
            handle.unload(id);
        } else {
            handle.unload(round % 5);
        }
        if round % 8 == 0 {
            handle.collect();
        }
    }
    assert_eq!(handle.status().leaked, 0);
}

#[test]
fn changes_of_input_and_nonsense_touches() {
    let (mut handle, mut engine) = engine();
    let id = handle.load(texture(1.0)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    let mut live = handle.take_live_input().unwrap();
    let nonsense = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 1e38, 0.0, f32::from_bits(1)];
    let inputs = [
        Input::Live,
        Input::Hand(HAND),
        Input::Hand(Hand { path: Path::Circle, speed_mps: 0.2, ..HAND }),
        Input::Hand(Hand { path: Path::Scribble, speed_mps: f32::NAN, ..HAND }),
        Input::Hand(Hand { extent_m: 0.0, force_n: f32::INFINITY, ..HAND }),
        Input::Track,
        Input::Repeat(Repeat { tempo: 1.5, force: 2.0 }),
        Input::Repeat(Repeat { tempo: f32::NAN, force: f32::INFINITY }),
        Input::Lifted,
    ];
    for round in 0..210 {
        let x = nonsense[round % nonsense.len()];
        let y = nonsense[round / 7 % nonsense.len()];
        for _ in 0..round % 3 {
            live.send(
                Touch { x_m: x, y_m: y, contact: Contact { speed_mps: y, force_n: x } },
                Instant::now(),
            )
            .unwrap();
        }
        if round % 6 == 0 {
            let hovering = Touch { x_m: y, y_m: x, contact: Contact { speed_mps: x, force_n: y } };
            live.hover(hovering, Instant::now()).unwrap();
        }
        handle.set_takeover((round % 4 != 0).then_some(Takeover { lifted_secs: x, stale_secs: y }));
        handle.set_input(inputs[round / 3 % inputs.len()]);
        handle
            .set_drive(Drive { muted: round % 10 == 9, gain: nonsense[round / 2 % nonsense.len()].min(2.0) });
        if round % 9 == 0 {
            handle.play_track(track()).unwrap();
        }
        if round % 13 == 0 {
            let driven = if round % 2 == 0 { Driven::Drive } else { Driven::Acceleration };
            handle
                .play_signal(Signal::new(vec![x.clamp(-1e9, 1e9).max(-1e9); 1500], 48_000.0, driven).unwrap())
                .unwrap();
        }
        if round % 17 == 0 {
            handle.stop_signal();
        }
        handle.set_tap(Tap { frequency_hz: x, decay_per_sec: y, amplitude_mps2: 3.0 });
        play(&mut engine, 1 + round % 5);
        handle.collect();
        handle.read_scope(&mut [0.0; 2048]);
        assert!(!handle.status().tripped);
    }
}

/// Slow strokes in all directions, in which the tip sticks, and landings of all speeds.
#[test]
fn strokes_that_stick_and_landings() {
    let (mut handle, mut engine) = engine();
    let id = handle.load(texture(1.0)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Live);
    handle.set_tap(Tap { frequency_hz: 900.0, decay_per_sec: 150.0, amplitude_mps2: 700.0 });
    let mut live = handle.take_live_input().unwrap();
    let mut highest = 0.0_f32;
    for round in 0..400_u16 {
        let (sin, cos) = (0.02 * f32::from(round)).sin_cos();
        let is_down = round % 20 < 15;
        let contact = Contact { speed_mps: 0.03, force_n: if is_down { 0.8 } else { 0.0 } };
        let touch = Touch { x_m: 0.01 * cos, y_m: 0.01 * sin, contact };
        let impact_mps = (round % 3 > 0).then_some(1e-3 * f32::from(round));
        live.land(touch, Instant::now(), impact_mps).unwrap();
        highest = highest.max(play(&mut engine, 1));
    }
    assert!(highest > 0.1, "{highest}");
}

#[test]
fn a_full_way_back_leaks_and_never_frees() {
    let (mut handle, mut engine) = engine();
    for _ in 0..SLOTS {
        handle.load(texture(1.0)).unwrap();
    }
    play(&mut engine, 1);
    for id in 0..SLOTS as u16 {
        handle.unload(id);
    }
    play(&mut engine, 2);
    for _ in 0..10 {
        handle.play_track(track()).unwrap();
        play(&mut engine, 1);
    }
    assert_eq!(handle.status().leaked, 9);
    // For ten seconds, nobody reads the scope or collects.
    play(&mut engine, 1900);
    assert!(handle.collect() > 0);
    play(&mut engine, 1);
}

#[test]
fn tripping_and_starting_again() {
    let (mut handle, mut engine) = engine();
    let loud = handle.load(texture(f32::MAX)).unwrap();
    handle.set_mix(Mix::solo(loud)).unwrap();
    handle.set_input(Input::Hand(HAND));
    play(&mut engine, 100);
    assert!(handle.status().tripped);
    let good = handle.load(texture(1.0)).unwrap();
    handle.set_mix(Mix::solo(good)).unwrap();
    handle.unload(loud);
    handle.reset_limiter();
    assert!(play(&mut engine, 100) > 0.0);
    assert!(!handle.status().tripped && handle.collect() == 1);
}

#[test]
fn the_handle_may_go_first() {
    let (mut handle, mut engine) = engine();
    let id = handle.load(texture(1.0)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Hand(HAND));
    handle.play_track(track()).unwrap();
    let live = handle.take_live_input();
    drop(handle);
    drop(live);
    play(&mut engine, 100);
    assert_eq!(play(&mut engine, 10), 0.0);
}
