//! Hours of use in simulated time: memory stays flat, and every sample stays below the ceiling.
#![allow(clippy::print_stdout, reason = "a soak reports what it measured")]

use std::time::Instant;

use shagreen_synth::contact::Contact;
use shagreen_synth::noise::Noise;
use shagreen_synth::renderer::{Blend, Mix};
use shagreen_synth::tap::Tap;

use super::{CONFIG, play};
use crate::controls::{Drive, Input};
use crate::engine::new;
use crate::texture::tests::with_lsf;
use crate::touch::Touch;

/// Simulated hours in a test; `scripts/abuse` asks for eight.
const USUAL_HOURS: f64 = 0.02;
/// Memory that may be added after the first tenth, in bytes: less than one byte for 100 samples would still show.
const FLAT_BYTES: usize = 2 << 20;

/// Resident memory of this process, in bytes.
fn resident_bytes() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<usize>().unwrap() << 10
}

/// Strokes, taps, drags and changes of texture as in a long day of work, by a seeded generator.
#[test]
fn memory_stays_flat_over_hours() {
    let hours = std::env::var("SHAGREEN_SOAK_HOURS").map_or(USUAL_HOURS, |hours| hours.parse().unwrap());
    let n_blocks = (hours * 3600.0 * 48_000.0 / 480.0) as u64;
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    handle.set_input(Input::Live);
    let mut live = handle.take_live_input().unwrap();
    let mut random = Noise::new(8);
    let mut loaded = Vec::new();
    let mut x_m = 0.0_f32;
    let (mut early_bytes, mut peak) = (0, 0.0_f32);
    let mut n_moves = 0_u64;
    for block in 0..n_blocks {
        let share = random.uniform() as f32;
        // A new texture four times a minute, as while a point is dragged with pauses.
        if block % 1500 == 0 {
            let lsf = [0.3 + share, 1.5 + 0.5 * share, 2.2 + 0.5 * share];
            let id = handle.load(with_lsf(1000.0, 0.5 + 5.0 * share, &lsf).unwrap()).unwrap();
            handle.set_mix(Mix::solo(id)).unwrap();
            handle.set_tap(Tap {
                frequency_hz: 100.0 + 200.0 * share,
                decay_per_sec: 90.0,
                amplitude_mps2: 3.0,
            });
            loaded.push(id);
            if loaded.len() > 3 {
                handle.unload(loaded.remove(0));
            }
        }
        if block % 4000 == 3999 {
            handle.set_mix(Mix::silent(Blend::Shared)).unwrap();
            handle.set_drive(Drive { gain: share, ..Drive::default() });
        }
        // Strokes of a second, with a lift in between.
        let phase = block % 120;
        let speed_mps = 0.1 + 0.2 * share;
        x_m += 0.01 * speed_mps;
        let touch = if phase < 100 {
            Touch { x_m, y_m: 0.0, contact: Contact { speed_mps, force_n: 1.0 } }
        } else {
            Touch::default()
        };
        n_moves += 1;
        if phase == 0 {
            live.land(touch, Instant::now(), Some(0.1)).unwrap();
        } else {
            live.send(touch, Instant::now()).unwrap();
        }
        let out = play(&mut engine, 480, 240);
        peak = out.iter().fold(peak, |peak, x| peak.max(x.abs()));
        assert!(out.iter().all(|x| x.abs() <= 1.0), "block {block}");
        handle.collect();
        if block == n_blocks / 10 {
            early_bytes = resident_bytes();
        }
    }
    let late_bytes = resident_bytes();
    println!(
        "{hours} h in {n_blocks} blocks, {n_moves} movements: {} kB after a tenth, {} kB at the end, peak {peak:.2}",
        early_bytes >> 10,
        late_bytes >> 10
    );
    assert!(peak > 0.05, "nothing was played");
    // Other tests of this program run beside a short one.
    if hours > 1.0 {
        assert!(late_bytes <= early_bytes + FLAT_BYTES, "{early_bytes} bytes grew to {late_bytes}");
    }
}
