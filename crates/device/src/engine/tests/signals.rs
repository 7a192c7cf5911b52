//! Signals that are played instead of textures.

use shagreen_synth::drive::Driven;

use super::{CONFIG, new, peak, play, stroking};
use crate::controls::Drive;
use crate::signal::Signal;

#[test]
fn a_signal_takes_the_place_of_the_texture_and_gives_it_back() {
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    let (_undisturbed, mut undisturbed) = stroking(CONFIG, 1.0);
    play(&mut engine, 9600, 256);
    let samples: Vec<f32> = (0..4800).map(|i| 0.5 * (i as f32 * 0.05).sin()).collect();
    handle.play_signal(Signal::new(samples.clone(), 48_000.0, Driven::Drive).unwrap()).unwrap();
    handle.set_drive(Drive { muted: false, gain: 0.1 });
    let out = play(&mut engine, 48_000, 256);
    // The texture fades within 960 samples, and a signal starts with a block.
    assert!(out[1024..5824] == samples, "the gain must not affect the signal");
    assert!(peak(&out[5900..]) < 0.1 && peak(&out[20_000..]) > 0.0);
    assert_eq!(handle.collect(), 1);
    assert!(!handle.status().plays_signal);
    play(&mut undisturbed, 57_600, 256);
    handle.set_drive(Drive::default());
    let (before, after) = (play(&mut undisturbed, 9600, 256), play(&mut engine, 9600, 256));
    assert!(before[960..] == after[960..], "the texture must continue during the signal");
}

#[test]
fn signals_are_stopped_muted_replaced_and_limited() {
    let signal = |level| Signal::new(vec![level; 480_000], 48_000.0, Driven::Drive).unwrap();
    let (mut handle, mut engine) = stroking(CONFIG, 1.0);
    handle.play_signal(signal(7.0)).unwrap();
    let out = play(&mut engine, 9600, 256);
    assert!(handle.status().plays_signal && peak(&out) <= 1.0 && out[9000] > 0.9);
    handle.set_drive(Drive { muted: true, gain: 1.0 });
    play(&mut engine, 960, 256);
    assert_eq!(peak(&play(&mut engine, 9600, 256)), 0.0);
    handle.set_drive(Drive::default());
    handle.play_signal(signal(0.25)).unwrap();
    let out = play(&mut engine, 9600, 256);
    assert_eq!((out[9000], handle.collect()), (0.25, 1));
    handle.stop_signal();
    let out = play(&mut engine, 9600, 256);
    let steps = out.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f32::max);
    assert!(steps < 0.05, "the signal must fade, largest step {steps}");
    assert!(!handle.status().plays_signal && handle.collect() == 1);
    // A stop request without a signal does not affect later signals.
    handle.stop_signal();
    play(&mut engine, 256, 256);
    handle.play_signal(signal(0.25)).unwrap();
    assert_eq!(play(&mut engine, 9600, 256)[9000], 0.25);
}

#[test]
fn a_signal_after_a_stop_is_played_and_one_before_it_is_not() {
    let signal = |level| Signal::new(vec![level; 9600], 48_000.0, Driven::Drive).unwrap();
    // All requests fall into one block. The stop applies to no signal, to one that has not started, and to one that
    // plays.
    for n_before in 0..3 {
        let (mut handle, mut engine) = new(CONFIG).unwrap();
        if n_before > 0 {
            handle.play_signal(signal(0.5)).unwrap();
        }
        if n_before == 2 {
            assert_eq!(play(&mut engine, 4800, 256)[4000], 0.5);
        }
        handle.stop_signal();
        handle.play_signal(signal(0.25)).unwrap();
        let out = play(&mut engine, 24_000, 256);
        // The fade of the previous signal may also pass this level.
        let n_frames = out.iter().filter(|x| **x == 0.25).count();
        assert!((9600..=9601).contains(&n_frames), "{n_frames} after {n_before}");
        assert!(n_before == 2 || peak(&out) == 0.25);
        assert_eq!(handle.collect(), if n_before == 0 { 1 } else { 2 });
        handle.play_signal(signal(0.25)).unwrap();
        handle.stop_signal();
        assert_eq!(peak(&play(&mut engine, 9600, 256)), 0.0);
        assert_eq!((handle.collect(), handle.status().plays_signal), (1, false));
    }
}

#[test]
fn a_signal_that_takes_over_another_begins_when_that_has_faded() {
    let ramp = |from: f32| {
        let samples = (0..9600).map(|i| from + 1e-5 * i as f32).collect();
        Signal::new(samples, 48_000.0, Driven::Drive).unwrap()
    };
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    handle.play_signal(ramp(0.5)).unwrap();
    play(&mut engine, 4864, 256);
    // The second signal never starts.
    handle.play_signal(ramp(0.2)).unwrap();
    handle.play_signal(ramp(0.0)).unwrap();
    let out = play(&mut engine, 24_000, 256);
    let begin = out.windows(2).position(|w| w == [0.0, 1e-5]).unwrap();
    // The level changes by 0.55 within the 960 frames of the fade.
    let steps = out[..begin].windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f32::max);
    assert!(steps < 7e-4, "{steps}");
    assert!(out[begin..begin + 9600] == *ramp(0.0).part(0, 9600), "the signal must start at its beginning");
    assert!((960..=960 + 256).contains(&begin) && peak(&out[begin + 9600..]) == 0.0, "{begin}");
    assert_eq!(handle.collect(), 3);
}
