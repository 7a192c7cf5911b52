//! Contact onsets: tap transients, and a hand that takes over.

use std::time::Instant;

use shagreen_synth::contact::Contact;
use shagreen_synth::impact::TAP_SHARE;
use shagreen_synth::tap::Tap;

use super::{CONFIG, HAND, peak, play, stroking, track};
use crate::controls::{Input, Takeover};
use crate::engine::{Engine, Handle, new};
use crate::live::LiveInput;
use crate::touch::Touch;

const WOOD: Tap = Tap { frequency_hz: 200.0, decay_per_sec: 80.0, amplitude_mps2: 5.0 };

fn landed(force_n: f32) -> Touch {
    Touch { contact: Contact { speed_mps: 0.0, force_n }, ..Touch::default() }
}

/// A silent texture with live input and tap transients.
fn tapping() -> (Handle, Engine, LiveInput) {
    let (mut handle, engine) = new(CONFIG).unwrap();
    handle.set_tap(WOOD);
    handle.set_input(Input::Live);
    let live = handle.take_live_input().unwrap();
    (handle, engine, live)
}

#[test]
fn a_landing_sounds_from_the_first_sample_of_the_next_block() {
    let (mut handle, mut engine, mut live) = tapping();
    assert_eq!(peak(&play(&mut engine, 4800, 480)), 0.0);
    live.send(landed(0.5), Instant::now()).unwrap();
    let out = play(&mut engine, 4800, 480);
    for (i, x) in out.iter().enumerate() {
        let t = i as f64 / 48_000.0;
        let expected = 0.5 * (-80.0 * t).exp() * (std::f64::consts::TAU * 200.0 * t).sin();
        assert!((f64::from(*x) - expected).abs() < 1e-5, "{x} for {expected} at {t}");
    }
    // Holding the tip down is not a contact onset. Lifting and touching faster is one, and stronger by the law of Hertz
    // contact.
    live.send(landed(0.6), Instant::now()).unwrap();
    assert!(peak(&play(&mut engine, 48_000, 480)) < 1e-2);
    live.send(Touch::default(), Instant::now()).unwrap();
    play(&mut engine, 480, 480);
    live.land(landed(0.5), Instant::now(), Some(0.12)).unwrap();
    let strong = play(&mut engine, 4800, 480);
    assert!((peak(&strong) / peak(&out) - 1.2_f32.powf(1.2)).abs() < 1e-3);
    assert!(handle.status().latency.n_touches == 4);
    // Invalid impact speeds and contact bounce are not.
    play(&mut engine, 48_000, 480);
    for landing in [f32::NAN, f32::INFINITY, -1.0] {
        for _ in 0..10 {
            live.send(Touch::default(), Instant::now()).unwrap();
            live.land(landed(0.5), Instant::now(), Some(landing)).unwrap();
            assert!(peak(&play(&mut engine, 48, 48)) < 2.0);
        }
    }
}

#[test]
fn a_tap_beyond_the_output_is_reduced_before_the_limiter() {
    let (mut handle, mut engine, mut live) = tapping();
    handle.set_tap(Tap { amplitude_mps2: 700.0, ..WOOD });
    // The output has faded in.
    play(&mut engine, 4800, 480);
    live.send(landed(0.5), Instant::now()).unwrap();
    let reduced = peak(&play(&mut engine, 4800, 480));
    let linear = CONFIG.drive.linear_mps2() / CONFIG.drive.full_scale_mps2();
    assert!((0.8 * TAP_SHARE * linear..TAP_SHARE * linear).contains(&reduced), "{reduced}");
    // A slower impact is weaker, and a faster one uses the rest of the range but no more.
    for (impact_mps, share) in [(0.05, TAP_SHARE * 0.5_f32.powf(1.2)), (0.2, 1.0), (3.0, 1.0)] {
        live.send(Touch::default(), Instant::now()).unwrap();
        play(&mut engine, 4800, 480);
        live.land(landed(0.5), Instant::now(), Some(impact_mps)).unwrap();
        let landing = peak(&play(&mut engine, 4800, 480));
        assert!((0.8 * share * linear..share * linear).contains(&landing), "{landing} at {impact_mps} m/s");
    }
    assert_eq!(handle.status().limited_samples, 0);
}

#[test]
fn a_hand_that_takes_over_is_heard_from_the_first_sample_of_the_next_block() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    handle.set_tap(WOOD);
    handle.set_input(Input::Hand(HAND));
    handle.set_takeover(Some(Takeover::USUAL));
    let mut live = handle.take_live_input().unwrap();
    assert_eq!(peak(&play(&mut engine, 9600, 480)), 0.0);
    assert!(!handle.status().follows_live);
    live.send(landed(0.5), Instant::now()).unwrap();
    let out = play(&mut engine, 4800, 480);
    let expected = 0.5 * (-80.0 / 48_000.0_f64).exp() * (std::f64::consts::TAU * 200.0 / 48_000.0).sin();
    assert!((f64::from(out[1]) - expected).abs() < 1e-5, "{} for {expected}", out[1]);
    assert!(handle.status().follows_live && handle.status().touch == landed(0.5));
    // Live input continues for a while after release, and a pen that is near takes over before it touches.
    live.send(Touch::default(), Instant::now()).unwrap();
    play(&mut engine, 48_000, 480);
    assert!(!handle.status().follows_live);
    assert_eq!(handle.status().touch.contact.force_n, 0.9, "the force must be that of the automatic stroke");
    live.hover(landed(0.5), Instant::now()).unwrap();
    play(&mut engine, 4800, 480);
    assert!(handle.status().follows_live && handle.status().touch.contact.force_n == 0.0);
}

#[test]
fn landings_of_a_stroke_do_not_depend_on_blocks() {
    let run = |block| {
        let (mut handle, mut engine) = stroking(CONFIG, 1.0);
        handle.set_tap(WOOD);
        handle.play_track(track(200)).unwrap();
        play(&mut engine, 48_000, block)
    };
    let whole = run(48_000);
    for block in [1, 7, 85, 256, 480] {
        assert!(run(block) == whole, "blocks of {block}");
    }
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    handle.play_track(track(200)).unwrap();
    assert_ne!(play(&mut engine, 48_000, 256), whole, "tap transients must change the output");
}
