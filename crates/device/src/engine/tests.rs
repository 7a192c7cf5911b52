//! Tests of engine and handle together, block by block.

mod lift_off;
mod relief;
mod signals;
#[cfg(target_os = "linux")]
mod soak;
mod tap_latency;
mod taps;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use shagreen_synth::contact::Contact;
use shagreen_synth::drive::DriveConfig;
use shagreen_synth::renderer::{Blend, Mix, Parent};

use super::{
    COMMANDS, ChannelMask, Engine, EngineConfig, Handle, LoadReason, MixError, RETURNED, SCOPE, SLOTS, new,
};
use crate::controls::{Controls, Drive, Input};
use crate::hand::{Hand, Path};
use crate::texture::tests::{white, white_at};
use crate::touch::Touch;
use crate::track::{PenSample, Track};

const CONFIG: EngineConfig = EngineConfig {
    model_rate_hz: 1000.0,
    device_rate_hz: 48_000.0,
    seed: 11,
    drive: DriveConfig::proportional(10.0, 1.0),
    channels: ChannelMask::FIRST_TWO,
    friction: None,
};

const HAND: Hand = Hand { path: Path::Line, speed_mps: 0.8, force_n: 0.9, extent_m: 0.06 };

/// Renders the next frames of one channel, in blocks of a given size over a buffer of NaN.
fn play(engine: &mut Engine, n_frames: usize, block: usize) -> Vec<f32> {
    let mut out = vec![f32::NAN; n_frames];
    out.chunks_mut(block).for_each(|block| engine.process(block, 1));
    out
}

/// An engine with one texture and an automatic stroke.
fn stroking(config: EngineConfig, level_mps2: f32) -> (Handle, Engine) {
    let (mut handle, engine) = new(config).unwrap();
    let id = handle.load(white(level_mps2)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Hand(HAND));
    (handle, engine)
}

fn track(n_samples: u32) -> Track {
    let sample = |i| {
        let time_secs = f64::from(i) * 0.007;
        let touching = i % 40 < 30;
        PenSample { time_secs, x_m: 0.4 * time_secs, force_n: 0.6, touching, ..PenSample::default() }
    };
    Track::new(&(0..n_samples).map(sample).collect::<Vec<_>>()).unwrap()
}

fn peak(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |peak, x| x.abs().max(peak))
}

#[test]
fn output_does_not_depend_on_the_size_of_blocks() {
    let run = |block, input: Input| {
        let (mut handle, mut engine) = stroking(CONFIG, 1.0);
        let mut mix = Mix::silent(Blend::Power);
        for (id, level) in [(1, 2.0), (2, 3.0)] {
            assert_eq!(handle.load(white(level)).unwrap(), id);
        }
        for id in 0..3 {
            mix.parents[usize::from(id)] = Parent { id, weight: 0.2 + 0.1 * f32::from(id) };
        }
        handle.play_track(track(200)).unwrap();
        handle.set_controls(Controls { mix, input, ..Controls::default() }).unwrap();
        play(&mut engine, 48_000, block)
    };
    for input in [Input::Hand(HAND), Input::Hand(Hand { path: Path::Scribble, ..HAND }), Input::Track] {
        let whole = run(48_000, input);
        assert!(whole.iter().all(|x| x.is_finite()) && peak(&whole) > 0.05, "{input:?}");
        for block in [1, 7, 64, 85, 170, 255, 256, 257, 480, 1024, 4095] {
            assert!(run(block, input) == whole, "{input:?} in blocks of {block}");
        }
    }
}

#[test]
fn channels_get_what_they_should() {
    let channels = ChannelMask::only(1).and(ChannelMask::only(3));
    let (_handle, mut engine) = stroking(EngineConfig { channels, ..CONFIG }, 1.0);
    // The buffer has six samples more than whole frames.
    let mut out = vec![f32::NAN; 9600 * 7 + 6];
    engine.process(&mut out, 7);
    let (_handle, mut engine) = stroking(CONFIG, 1.0);
    let expected = play(&mut engine, 9600, 9600);
    let (frames, rest) = out.split_at(9600 * 7);
    for (frame, &x) in frames.chunks(7).zip(&expected) {
        assert_eq!(frame, [0.0, x, 0.0, x, 0.0, 0.0, 0.0]);
    }
    assert_eq!(rest, [0.0; 6]);
    engine.process(&mut [], 2);
    engine.process(&mut [f32::NAN; 3], 0);
}

#[test]
fn muting_and_resuming_is_a_ramp() {
    let (_free, mut engine) = stroking(CONFIG, 1.0);
    let free = play(&mut engine, 48_000, 480);
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    let mut out = Vec::new();
    for drive in [1.0, 0.0, 0.5, 1.0]
        .map(|gain| Drive { muted: gain == 0.0, gain: if gain == 0.0 { 9.0 } else { gain } })
    {
        handle.set_drive(drive);
        out.extend(play(&mut engine, 12_000, 480));
    }
    assert!(out[12_960..24_000].iter().all(|&x| x == 0.0) && peak(&out[30_000..]) > 0.01);
    let step = |x: &[f32], i: usize| (x[i + 1] - x[i]).abs();
    for i in 0..out.len() - 1 {
        // The gain moves by at most 1 in 960 frames (20 ms) and never exceeds 1.
        let allowed = step(&free, i) + free[i].abs().max(free[i + 1].abs()) / 960.0 + 1e-7;
        assert!(step(&out, i) <= allowed, "at {i}: {} above {allowed}", step(&out, i));
    }
    assert_eq!(out[36_960..], free[36_960..], "the signal must match the uninterrupted one");
}

#[test]
fn an_engine_without_a_handle_falls_silent() {
    let (handle, mut engine) = stroking(CONFIG, 1.0);
    assert!(peak(&play(&mut engine, 9600, 480)) > 0.0);
    drop(handle);
    play(&mut engine, 960, 480);
    assert_eq!(peak(&play(&mut engine, 9600, 480)), 0.0);
}

#[test]
fn a_texture_unloaded_while_it_sounds_is_freed_after_its_fade() {
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    play(&mut engine, 9600, 240);
    handle.unload(0);
    assert!(!handle.is_loaded(0));
    let mut fade = Vec::new();
    let mut n_blocks = 0;
    while handle.collect() == 0 {
        fade.extend(play(&mut engine, 240, 240));
        n_blocks += 1;
        assert!(n_blocks < 100, "the texture is never freed");
    }
    // The fade takes 20 ms from the next tick on, with 5 ms per tick and per block; one more block detects its end.
    assert!((4..=6).contains(&n_blocks), "{n_blocks} blocks");
    assert!(peak(&fade[..480]) > 0.01, "the fade is cut off");
    assert_eq!(handle.set_mix(Mix::solo(0)), Err(MixError::NotLoaded { id: 0 }));
    // The id may be reused, but the new texture must not inherit the weight.
    assert_eq!(handle.load(white(5.0)).unwrap(), 0);
    play(&mut engine, 48_000, 240);
    // The resampler's filter decays by e^-36 per second.
    assert!(peak(&play(&mut engine, 9600, 240)) < 1e-12);
}

#[test]
fn a_texture_that_never_sounded_comes_back_at_once() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    let id = handle.load(white(1.0)).unwrap();
    handle.unload(id);
    handle.unload(id);
    handle.unload(63);
    handle.unload(999);
    play(&mut engine, 1, 1);
    assert_eq!(handle.collect(), 1);
}

#[test]
fn every_place_taken_gives_the_texture_back() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    for id in 0..SLOTS {
        assert_eq!(usize::from(handle.load(white(1.0)).unwrap()), id);
    }
    let error = handle.load(white(7.0)).unwrap_err();
    assert_eq!((error.reason, *error.texture), (LoadReason::NoSlot, white(7.0)));
    play(&mut engine, 10, 10);
    handle.unload(5);
    play(&mut engine, 10, 10);
    assert_eq!(handle.load(white(7.0)).unwrap(), 5);
}

#[test]
fn a_full_ring_gives_back_what_was_sent() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    for _ in 0..COMMANDS {
        handle.play_track(track(3)).unwrap();
    }
    assert_eq!(handle.play_track(track(4)), Err(track(4)));
    let error = handle.load(white(2.0)).unwrap_err();
    assert_eq!((error.reason, *error.texture), (LoadReason::RingFull, white(2.0)));
    play(&mut engine, 1, 1);
    handle.load(white(2.0)).unwrap();
}

#[test]
fn an_unload_that_finds_the_ring_full_is_sent_later() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    let id = handle.load(white(1.0)).unwrap();
    for _ in 0..COMMANDS - 1 {
        handle.play_track(track(3)).unwrap();
    }
    handle.unload(id);
    play(&mut engine, 1, 1);
    handle.collect();
    play(&mut engine, 1, 1);
    assert_eq!(handle.collect(), 1);
}

#[test]
fn what_finds_no_way_back_waits_in_its_slot_or_is_leaked_and_counted() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    for _ in 0..SLOTS {
        handle.load(white(1.0)).unwrap();
    }
    play(&mut engine, 1, 1);
    (0..SLOTS as u16).for_each(|id| handle.unload(id));
    play(&mut engine, 1, 1);
    play(&mut engine, 1, 1);
    assert_eq!(handle.status().leaked, 0);
    // The return queue is full, so the other textures stay in their slots. A replaced track cannot stay.
    for _ in 0..4 {
        handle.play_track(track(3)).unwrap();
    }
    play(&mut engine, 1, 1);
    assert_eq!(handle.status().leaked, 3, "the first track replaces none");
    assert_eq!(handle.collect(), RETURNED);
    play(&mut engine, 1, 1);
    assert_eq!(handle.collect(), SLOTS - RETURNED);
    for _ in 0..SLOTS {
        handle.load(white(1.0)).unwrap();
    }
}

#[test]
fn refuses_textures_of_another_rate_and_mixes_that_are_none() {
    let (mut handle, _engine) = stroking(CONFIG, 1.0);
    let error = handle.load(white_at(2000.0, 1.0).unwrap()).unwrap_err();
    assert_eq!(error.reason, LoadReason::Rate { texture_rate_hz: 2000.0, model_rate_hz: 1000.0 });
    assert!(error.to_string().contains("2000 Hz") && error.texture.rate_hz() == 2000.0);
    let before = handle.controls();
    assert_eq!(handle.set_mix(Mix::solo(1)), Err(MixError::NotLoaded { id: 1 }));
    for weight in [f32::NAN, -0.1, 1.5, f32::INFINITY] {
        let mut mix = Mix::solo(0);
        mix.parents[0].weight = weight;
        assert!(matches!(handle.set_mix(mix), Err(MixError::Weight { id: 0, .. })), "{weight}");
    }
    assert_eq!(handle.controls(), before);
    handle.set_mix(Mix::silent(Blend::Power)).unwrap();
}

#[test]
fn nonsense_latches_silence_until_a_person_resets_it() {
    // The level exceeds the range of `f32`.
    let (mut handle, mut engine) = stroking(CONFIG, f32::MAX);
    let out = play(&mut engine, 24_000, 256);
    assert!(out.iter().all(|x| x.is_finite() && x.abs() <= 1.0));
    assert!(handle.status().tripped);
    assert_eq!(peak(&out[12_000..]), 0.0);
    let good = handle.load(white(1.0)).unwrap();
    handle.set_mix(Mix::solo(good)).unwrap();
    assert_eq!(peak(&play(&mut engine, 24_000, 256)), 0.0, "silence must still be latched");
    assert!(handle.status().tripped);
    handle.reset_limiter();
    let out = play(&mut engine, 24_000, 256);
    let status = handle.status();
    assert!(!status.tripped && peak(&out) > 0.01 && status.level_mps2.is_finite() && status.level_mps2 > 0.1);
    // Without latched silence, a reset changes nothing.
    let (_other, mut undisturbed) = stroking(CONFIG, 1.0);
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    play(&mut engine, 1000, 256);
    play(&mut undisturbed, 1000, 256);
    handle.reset_limiter();
    assert_eq!(play(&mut engine, 1000, 256), play(&mut undisturbed, 1000, 256));
}

#[test]
fn the_ceiling_is_never_exceeded_and_bent_samples_are_counted() {
    let (mut handle, mut engine) =
        stroking(EngineConfig { drive: DriveConfig::proportional(10.0, 0.25), ..CONFIG }, 50.0);
    let out = play(&mut engine, 48_000, 256);
    assert!(peak(&out) <= 0.25 && peak(&out) > 0.2);
    let status = handle.status();
    let bent = out.iter().filter(|x| x.abs() > 0.2).count() as u64;
    // A sample that is limited by less than a rounding error stays at the knee.
    assert!(status.limited_samples.abs_diff(bent) <= 2, "{} {bent}", status.limited_samples);
    assert!(status.peak <= 0.25 && status.peak > 0.2);
}

#[test]
fn the_scope_shows_the_signal_before_gain_and_limiter() {
    let (mut handle, mut engine) =
        stroking(EngineConfig { drive: DriveConfig::proportional(1000.0, 1.0), ..CONFIG }, 1.0);
    handle.set_drive(Drive { muted: false, gain: 0.5 });
    let out = play(&mut engine, 9600, 256);
    let mut scope = vec![f32::NAN; 20_000];
    assert_eq!(handle.read_scope(&mut scope), 9600);
    // After the gain ramp, the output is m/s² × gain / full scale.
    for (drawn, played) in scope[960..9600].iter().zip(&out[960..]) {
        assert!((drawn * 0.5 / 1000.0 - played).abs() < 1e-9);
    }
    // Unread samples are dropped, which is not an error.
    play(&mut engine, 2 * SCOPE, 256);
    let mut scope = vec![f32::NAN; 3 * SCOPE];
    assert_eq!(handle.read_scope(&mut scope), SCOPE);
    assert_eq!(handle.status().leaked, 0);
}

#[test]
fn the_status_tells_what_is_played() {
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    handle.set_input(Input::Hand(Hand { path: Path::Circle, ..HAND }));
    play(&mut engine, 48_000, 480);
    let status = handle.status();
    assert_eq!(status.frames_played, 48_000);
    assert_eq!(status.touch.contact, Contact { speed_mps: 0.8, force_n: 0.9 });
    // The texture's level is the smaller of speed and force. 50 ms are 50 model samples; the bound is five standard
    // errors.
    assert!((status.level_mps2 / 0.8 - 1.0).abs() < 0.5, "{}", status.level_mps2);
    assert!((status.input_secs - 1.0).abs() < 0.006, "{}", status.input_secs);
    assert!(status.peak > 0.05 && !status.tripped && status.limited_samples == 0);
    let expected = Hand { path: Path::Circle, ..HAND }.touch_at(status.input_secs);
    assert!((status.touch.x_m - expected.x_m).abs() < 1e-6 && (status.touch.y_m - expected.y_m).abs() < 1e-6);
}

#[test]
fn live_touches_sound_and_fall_silent_when_they_end() {
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    handle.set_input(Input::Live);
    let mut live = handle.take_live_input().unwrap();
    assert!(handle.take_live_input().is_some() && handle.take_live_input().is_none());
    let touch = Touch { x_m: 0.01, y_m: 0.0, contact: Contact { speed_mps: 0.9, force_n: 0.9 } };
    for _ in 0..50 {
        live.send(Touch { x_m: -1.0, ..touch }, Instant::now()).unwrap();
        live.send(touch, Instant::now()).unwrap();
        play(&mut engine, 480, 480);
    }
    let status = handle.status();
    assert!(status.touch == touch && status.level_mps2 > 0.3, "{status:?}");
    play(&mut engine, 48_000, 480);
    let status = handle.status();
    // The meter dominates the decay: exp(-0.8 s / 50 ms) of the mean square.
    assert!(status.touch.contact.speed_mps < 1e-9 && status.level_mps2 < 1e-3, "{status:?}");
    while live.send(touch, Instant::now()).is_ok() {}
    assert_eq!(live.send(touch, Instant::now()), Err(touch));
    live.send(Touch::default(), Instant::now()).unwrap_err();
}

#[test]
fn a_new_output_begins_like_the_first() {
    let run = || play(&mut stroking(CONFIG, 1.0).1, 4800, 480);
    assert_eq!(run(), run());
    let other = play(&mut stroking(EngineConfig { seed: 12, ..CONFIG }, 1.0).1, 4800, 480);
    assert_ne!(run(), other);
}

#[test]
fn both_halves_may_live_on_their_own_threads() {
    fn is_send<T: Send>() {}
    is_send::<Handle>();
    is_send::<Engine>();
    is_send::<crate::live::LiveInput>();
    is_send::<crate::output::Running>();
}

#[test]
fn a_texture_and_the_mix_that_names_it_arrive_together() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    handle.set_input(Input::Hand(Hand { path: Path::Circle, ..HAND }));
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    // Blocks run as fast as possible, so that they start at every moment of the handle's actions.
    let callback = std::thread::spawn(move || {
        while !stopped.load(Ordering::Relaxed) {
            engine.process(&mut [0.0; 48], 1);
        }
    });
    let begun = Instant::now();
    let wait = |handle: &mut Handle, what: &str, is_done: &dyn Fn(&mut Handle) -> bool| {
        while !is_done(handle) {
            assert!(begun.elapsed().as_secs() < 60, "{what} never happened");
            std::thread::yield_now();
        }
    };
    for _ in 0..30 {
        let id = handle.load(white(1.0)).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        wait(&mut handle, "output", &|handle| handle.status().level_mps2 > 0.1);
        handle.unload(id);
        wait(&mut handle, "the return of the texture", &|handle| handle.collect() == 1);
        wait(&mut handle, "silence", &|handle| handle.status().level_mps2 < 0.05);
    }
    assert_eq!(handle.status().leaked, 0);
    stop.store(true, Ordering::Relaxed);
    callback.join().unwrap();
}
