//! Latency of a tap transient on an output that plays each block as soon as it is rendered, as the null output does. Time
//! is counted in frames, so the result does not depend on the machine.

use std::time::{Duration, Instant};

use shagreen_synth::contact::Contact;
use shagreen_synth::drive::{DriveConfig, Inverse};
use shagreen_synth::equalizer::Resonance;
use shagreen_synth::tap::Tap;

use super::CONFIG;
use crate::controls::Input;
use crate::engine::{CallbackAdapter, EngineConfig, new};
use crate::status::TAP_BUDGET_SECS;
use crate::touch::Touch;

const RATE_HZ: f64 = 48_000.0;
/// Frames of 5 ms.
const FIVE_MS: usize = 240;
/// Limit for a tap with a buffer of 5 ms, in seconds: the buffer, the look-ahead and a millisecond.
const LIMIT_SECS: f64 = 0.008;
/// An actuator with known response, whose limiter looks ahead.
const ACTUATOR: DriveConfig = DriveConfig {
    inverse: Some(Inverse {
        resonance: Resonance { frequency_hz: 65.0, q: 4.0, gain_mps2_per_volt: 2.0 },
        lowest_hz: 20.0,
    }),
    look_ahead_secs: 0.002,
    ..DriveConfig::proportional(5.0, 0.9)
};

/// Time from a report to the first sample of its tap transient, in seconds, and the time that the status states. The
/// report arrives `late` frames after a block of this size has been rendered.
fn tap_secs(drive: DriveConfig, block: usize, late: usize) -> (f64, f64) {
    let (mut handle, mut engine) = new(EngineConfig { drive, ..CONFIG }).unwrap();
    handle.set_tap(Tap { frequency_hz: 250.0, decay_per_sec: 100.0, amplitude_mps2: 1.0 });
    handle.set_input(Input::Live);
    let mut live = handle.take_live_input().unwrap();
    let begun = Instant::now();
    let time_of = |frame: usize| begun + Duration::from_secs_f64(frame as f64 / RATE_HZ);
    // Fades from the start of the engine are over by then.
    let reported = 20 * block + late;
    let mut unsent = Some(Touch { contact: Contact { speed_mps: 0.0, force_n: 0.5 }, ..Touch::default() });
    let mut played: Vec<f32> = Vec::new();
    while played.len() < reported + 3 * block + 960 {
        // The block is rendered at the time when its first frame is played.
        let now = time_of(played.len());
        if played.len() >= reported
            && let Some(touch) = unsent.take()
        {
            live.send(touch, time_of(reported)).unwrap();
        }
        engine.begin_block(CallbackAdapter { now, load: 0.0, load_max: 0.0, device_latency_secs: 0.0 });
        let mut out = vec![f32::NAN; block];
        engine.process(&mut out, 1);
        played.extend(out);
    }
    let first = played.iter().position(|x| *x != 0.0).unwrap();
    assert!(first >= reported, "the transient comes before its report");
    ((first - reported) as f64 / RATE_HZ, f64::from(handle.status().latency.tap_secs))
}

/// Longest latency of a tap, in seconds, over all times of its report within a block.
fn worst_secs(drive: DriveConfig, block: usize) -> f64 {
    let late = (0..block).step_by(7).chain([1, block - 1]);
    let measured = late.map(|late| {
        let (secs, stated_secs) = tap_secs(drive, block, late);
        // The first sample of a sinusoid is zero.
        assert!((secs - stated_secs - 1.0 / RATE_HZ).abs() < 1e-6, "{secs} s for {stated_secs} s");
        secs
    });
    measured.fold(0.0, f64::max)
}

#[test]
fn a_tap_waits_for_its_block_and_for_the_look_ahead_only() {
    for drive in [CONFIG.drive, ACTUATOR] {
        for block in [64, 128, 192, FIVE_MS, 256] {
            let expected = block as f64 / RATE_HZ + f64::from(drive.look_ahead_secs);
            let worst = worst_secs(drive, block);
            assert!((worst - expected).abs() < 1e-6, "{worst} s for {expected} s with {block} frames");
        }
    }
}

#[test]
fn a_tap_is_in_time_with_a_buffer_of_five_milliseconds() {
    assert!(worst_secs(ACTUATOR, FIVE_MS) <= LIMIT_SECS);
    // The recommended limit is kept without a look-ahead, and with one if the buffer has 4 ms.
    let recommended_secs = f64::from(TAP_BUDGET_SECS) + 1e-6;
    assert!(worst_secs(CONFIG.drive, FIVE_MS) <= recommended_secs);
    assert!(worst_secs(ACTUATOR, 192) <= recommended_secs);
    // Negative control: twice the buffer is too much.
    assert!(worst_secs(ACTUATOR, 2 * FIVE_MS) > LIMIT_SECS);
}
