//! No dropout of ours: a buffer of 5 ms on a sound server, with a texture swapped every 20 ms, a full ring of touches, and a
//! thread that is as busy as a window. `SHAGREEN_DROPOUT_SECS` says how long; ten minutes are the measure.
//!
//! A machine that is shared stalls everybody now and then. So the server's own player plays a tone beside it, on a sink of
//! its own with the same latency: what it loses is the machine's, and we may not lose more than that.
#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may stop and speak"
)]

#[path = "support/guard.rs"]
mod guard;
#[path = "support/sound.rs"]
mod sound;

use std::io::Write as _;
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use guard::{Guard, have};
use shagreen_core::authoring::{Authoring, Layers, Models};
use shagreen_core::blend::Mode;
use shagreen_core::plane::Plane;
use shagreen_core::space::{Space, SpacePoint};
use shagreen_device::controls::Input;
use shagreen_device::engine::{ChannelMask, Handle};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::output::{OpenOptions, open};
use shagreen_device::synth::budget::Budget;
use shagreen_device::synth::contact::Contact;
use shagreen_device::synth::drive::{DriveConfig, Inverse};
use shagreen_device::synth::equalizer::Resonance;
use shagreen_device::synth::renderer::Mix;
use shagreen_device::texture::OwnedTexture;
use shagreen_device::touch::Touch;
use shagreen_formats::starter::starter_library;
use sound::{RATE_HZ, SoundServer};

/// Names the program of its own that plays.
const ROLE: &str = "SHAGREEN_DROPOUT_ROLE";
/// Frames of the buffer: 5 ms.
const BUFFER: u32 = 240;
const CEILING: f32 = 0.9;

fn seconds() -> f64 {
    std::env::var("SHAGREEN_DROPOUT_SECS").ok().and_then(|s| s.parse().ok()).unwrap_or(10.0)
}

#[test]
fn nothing_of_ours_drops_out() {
    if !have(&["pulseaudio", "pactl", "parec", "pacat"]) {
        return;
    }
    let server = SoundServer::new();
    let mut said = String::new();
    let mut recorded = Vec::new();
    let control = server.record_of("other", |server| {
        let _control = Guard(control(server));
        recorded = server.record(|server| said = play(server));
    });
    let told = said.lines().find(|line| line.starts_with('{')).unwrap();
    println!("{told}");
    let told: serde_json::Value = serde_json::from_str(told).unwrap();
    assert!(recorded.iter().flatten().all(|x| x.is_finite() && x.abs() <= f64::from(CEILING)));
    let (secs, ours) = silence_in("ours", &recorded);
    let (_, theirs) = silence_in("the server's own player", &control);
    // Stalls fall where they fall: over ten minutes of a machine that lost seconds, one had a quarter more than the other.
    assert!(ours <= 2.0 * theirs + 0.2, "{ours} s lost, the server's own player {theirs} s");
    assert!(told["load"].as_f64().unwrap() < 0.05, "{told}");
    assert!(told["swaps"].as_u64().unwrap() as f64 > 20.0 * secs, "{told}");
    assert_eq!(told["leaked"], 0, "{told}");
}

/// Plays in a program of its own, and returns what it said.
fn play(server: &SoundServer) -> String {
    let output = server
        .command(std::env::current_exe().unwrap().to_str().unwrap())
        .args(["--exact", "the_one_who_plays", "--nocapture"])
        .env(ROLE, "1")
        .stderr(Stdio::inherit())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    said
}

/// The server's own player, with a tone on the other sink at the latency that we ask for.
fn control(server: &SoundServer) -> Child {
    let mut player = server
        .command("pacat")
        .args([
            "-d",
            "other",
            "--latency-msec=15",
            "--format=float32le",
            "--rate=48000",
            "--channels=2",
            "--raw",
        ])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = player.stdin.take().unwrap();
    std::thread::spawn(move || {
        // Never exactly zero.
        let tone = |n: i32| (0.3 + 0.1 * (f64::from(n) / 480.0 * std::f64::consts::TAU).sin()) as f32;
        let block: Vec<u8> = (0..480).flat_map(|n| [tone(n).to_le_bytes(); 2].concat()).collect();
        // The pipe is full as long as the player has enough; it ends with the player.
        while input.write_all(&block).is_ok() {}
    });
    player
}

/// How long something sounds, and how much of it is silence, in seconds.
fn silence_in(who: &str, recorded: &[[f64; 2]]) -> (f64, f64) {
    let sounds = |f: &[f64; 2]| f[0] != 0.0;
    let first = recorded.iter().position(sounds).expect("something sounds");
    let last = recorded.iter().rposition(sounds).expect("something sounds");
    let (secs, gaps) = ((last - first) as f64 / RATE_HZ, gaps(&recorded[first..=last]));
    let lost_secs = gaps.iter().map(|n| *n as f64 / RATE_HZ).sum::<f64>();
    let longest_ms = gaps.iter().max().map_or(0.0, |n| 1e3 * *n as f64 / RATE_HZ);
    let n_gaps = gaps.len();
    println!(
        "{who}: {n_gaps} gaps in {secs:.1} s, {:.1} ms in all, the longest {longest_ms:.1} ms",
        1e3 * lost_secs
    );
    (secs, lost_secs)
}

/// Stretches of silence to the last bit, longer than a tenth of a millisecond: a texture is noise and never that.
fn gaps(recorded: &[[f64; 2]]) -> Vec<usize> {
    let mut found = Vec::new();
    let mut n_silent = 0;
    for frame in recorded {
        if frame[0] == 0.0 {
            n_silent += 1;
        } else {
            if n_silent > 5 {
                found.push(n_silent);
            }
            n_silent = 0;
        }
    }
    found
}

#[test]
fn gaps_are_found() {
    let mut recorded = vec![[0.1, 0.1]; 1000];
    recorded[100..340].fill([0.0; 2]);
    recorded[700] = [0.0; 2];
    assert_eq!(gaps(&recorded), [240]);
}

/// Does nothing in the test run itself.
#[test]
fn the_one_who_plays() {
    if std::env::var(ROLE).is_err() {
        return;
    }
    let options = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: None,
        buffer_frames: Some(BUFFER),
        seed: 1,
        drive: DriveConfig {
            inverse: Some(Inverse {
                resonance: Resonance { frequency_hz: 65.0, q: 4.0, gain_mps2_per_volt: 2.1 },
                lowest_hz: 20.0,
            }),
            full_scale: 5.0,
            ceiling: CEILING,
            look_ahead_secs: 0.002,
            budget: Some(Budget { rms: 0.28, time_secs: 10.0 }),
        },
        channels: ChannelMask::FIRST_TWO,
    };
    let (mut handle, running) = open("pulse:ci", options).unwrap();
    let busy = Arc::new(AtomicBool::new(true));
    let is_busy = Arc::clone(&busy);
    let window = std::thread::spawn(move || {
        let library = starter_library().unwrap();
        while is_busy.load(Ordering::Relaxed) {
            for texture in &library.textures {
                std::hint::black_box(Plane::new(&texture.model).prepare());
            }
        }
    });
    let swaps = swap_textures(&mut handle, seconds());
    let status = handle.status();
    busy.store(false, Ordering::Relaxed);
    window.join().unwrap();
    println!(
        "{}",
        serde_json::json!({
            "underruns": status.underruns, "load": status.load, "load_max": status.load_max, "swaps": swaps,
            "leaked": status.leaked, "limited": status.limited_samples, "rate_hz": running.rate_hz(),
            "block_frames": running.buffer_frames(), "latency_ms": 1e3 * running.latency_secs(&status),
        })
    );
}

/// Authors a texture every 20 ms along a circle, lets it sound and the one before go, under an automatic hand, while touches
/// fill their ring; says how often.
fn swap_textures(handle: &mut Handle, secs: f64) -> u64 {
    let library = starter_library().unwrap();
    let space = Space::new(&library.positions()).unwrap();
    let planes: Vec<Plane> = library.textures.iter().map(|t| Plane::new(&t.model)).collect();
    let layers: Vec<Option<Layers<'_>>> =
        library.textures.iter().zip(&planes).map(|(t, plane)| Some(Layers::of(&t.model, plane))).collect();
    let models = Models::new(&space, &layers).unwrap();
    let authoring = Authoring::new(space).with_models(Arc::new(models));
    let mut live = handle.take_live_input().unwrap();
    handle.set_input(Input::Hand(Hand { path: Path::Circle, speed_mps: 0.12, force_n: 0.8, extent_m: 0.06 }));
    let begun = Instant::now();
    let (mut n_swaps, mut sounding) = (0_u64, None);
    while begun.elapsed().as_secs_f64() < secs {
        let due = Duration::from_millis(20 * n_swaps);
        std::thread::sleep(due.saturating_sub(begun.elapsed()));
        let t = begun.elapsed().as_secs_f64();
        let point = SpacePoint { rough_smooth: 50.0 + 20.0 * t.sin(), hard_soft: 50.0 + 20.0 * t.cos() };
        let model = authoring.author(point, &Mode::Field.into()).unwrap().model.unwrap();
        let texture = OwnedTexture::new(Plane::new(&model).prepare().parts()).unwrap();
        handle.collect();
        if let Ok(id) = handle.load(texture) {
            handle.set_mix(Mix::solo(id)).unwrap();
            if let Some(before) = sounding.replace(id) {
                handle.unload(before);
            }
        }
        let touch = Touch { contact: Contact { speed_mps: 0.1, force_n: 0.5 }, ..Touch::default() };
        while live.send(touch, Instant::now()).is_ok() {}
        handle.read_scope(&mut [0.0; 4096]);
        n_swaps += 1;
    }
    n_swaps
}
