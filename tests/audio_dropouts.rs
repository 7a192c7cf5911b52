//! Dropout test: a 5 ms buffer on a sound server, with a texture swapped every 20 ms, a full ring of touches, and a
//! busy thread like that of a window. `SHAGREEN_DROPOUT_SECS` sets the duration; the standard is ten minutes.
//!
//! A shared machine sometimes stalls every process. Each processor therefore has a witness thread of the highest
//! priority that only wakes up: a gap without a late witness is caused by this program. For comparison, the server's
//! own player plays a tone at the same time, on a separate sink with the same latency.
#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may panic, and prints its results"
)]

#[path = "support/guard.rs"]
mod guard;
#[path = "support/sound.rs"]
mod sound;
#[path = "support/witness.rs"]
mod witness;

use std::fmt::{Display, Formatter};
use std::io::{Read as _, Write as _};
use std::ops::Range;
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use guard::{Guard, have};
use rustix::process::{Pid, Signal, kill_process};
use shagreen_core::space::authoring::{Authoring, Layers, Models};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
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
use sound::{RATE_HZ, Recording, SoundServer};
use witness::{Stall, Witness};

/// Environment variable that turns a separate test process into the player; its value is the duration in seconds.
const ROLE: &str = "SHAGREEN_DROPOUT_ROLE";
/// Environment variable with the path of the program whose window is tested.
const WINDOW: &str = "SHAGREEN_DROPOUT_WINDOW";
/// Frames of the buffer: 5 ms.
const BUFFER: u32 = 240;
const CEILING: f32 = 0.9;
/// Number of times that the control test stops the player.
const STALLS: usize = 20;
/// Delay of a witness from which it counts as a stall.
const LATE: Duration = Duration::from_micros(500);
/// Total delay of the stalls around a gap from which they count as its cause: one buffer.
const TAKEN_SECS: f64 = 0.005;
/// Longest time from a stall to the start of its gap, in s: audio buffered in the server, and its latency.
const AFTER_SECS: f64 = 0.06;
/// Longest time from the start of a gap to its stall, in s: a sink may render ahead.
const BEFORE_SECS: f64 = 0.03;
/// Length of a typical gap, in s.
const GAP_SECS: f64 = 0.01;

fn seconds() -> f64 {
    std::env::var("SHAGREEN_DROPOUT_SECS").ok().and_then(|s| s.parse().ok()).unwrap_or(10.0)
}

#[test]
fn nothing_of_ours_drops_out() {
    if !have(&["pulseaudio", "pactl", "parec", "pacat"]) {
        return;
    }
    let server = SoundServer::new();
    let witness = Witness::new(LATE);
    let mut said = String::new();
    let mut recorded = None;
    let control = server.record_of("other", |server| {
        let _control = Guard(control(server));
        recorded = Some(server.record_of("ci", |server| said = play(server, seconds(), |_| ())));
    });
    let (recorded, stalls) = (recorded.unwrap(), witness.stalls());
    let told = said.lines().find(|line| line.starts_with('{')).unwrap();
    println!("{told}");
    let told: serde_json::Value = serde_json::from_str(told).unwrap();
    assert!(recorded.frames.iter().flatten().all(|x| x.is_finite() && x.abs() <= f64::from(CEILING)));
    let theirs = Lost::of(&control, &stalls);
    println!("the server's own player: {theirs}");
    let ours = Lost::of(&recorded, &stalls);
    println!("ours: {ours}");
    ours.assert_seen();
    assert!(told["load"].as_f64().unwrap() < 0.05, "{told}");
    assert!(told["swaps"].as_u64().unwrap() as f64 > 20.0 * ours.secs, "{told}");
    assert_eq!(told["leaked"], 0, "{told}");
}

/// Negative control: gaps of a player that is stopped at intervals while the machine runs are detected.
#[test]
fn a_stall_of_ours_is_seen() {
    if !have(&["pulseaudio", "pactl", "parec"]) {
        return;
    }
    let server = SoundServer::new();
    let witness = Witness::new(LATE);
    let recorded = server.record_of("ci", |server| {
        play(server, 6.0, |player| {
            let player = Pid::from_child(player);
            std::thread::sleep(Duration::from_millis(1500));
            for _ in 0..STALLS {
                std::thread::sleep(Duration::from_millis(150));
                kill_process(player, Signal::STOP).unwrap();
                std::thread::sleep(Duration::from_millis(50));
                kill_process(player, Signal::CONT).unwrap();
            }
        });
    });
    let lost = Lost::of(&recorded, &witness.stalls());
    println!("stopped {STALLS} times: {lost}");
    // Most stops can coincide with stalls of the machine; one detected gap is sufficient.
    assert!(!lost.unseen.is_empty(), "{lost}");
}

/// Tests the window itself, if `SHAGREEN_DROPOUT_WINDOW` is the path of the program. A pointer drags the point around
/// the space, which creates a new texture in every frame.
#[test]
fn the_window_drops_nothing_out() {
    let Ok(program) = std::env::var(WINDOW) else { return };
    assert!(have(&["pulseaudio", "pactl", "parec", "Xvfb", "xdotool"]));
    let server = SoundServer::new();
    let witness = Witness::new(LATE);
    let recorded = server.record_of("ci", |server| {
        let minutes = (seconds() / 60.0).ceil().to_string();
        let status = server.command("scripts/drag_memory").args([&minutes, &program, "pulse:ci"]).status();
        assert!(status.unwrap().success());
    });
    assert!(recorded.frames.iter().flatten().all(|x| x.is_finite() && x.abs() <= f64::from(CEILING)));
    let lost = Lost::of(&recorded, &witness.stalls());
    println!("the window: {lost}");
    lost.assert_seen();
}

/// Runs the player in a separate process, calls `during` meanwhile, and returns the player's output.
fn play(server: &SoundServer, secs: f64, during: impl FnOnce(&Child)) -> String {
    let mut player = server
        .command(std::env::current_exe().unwrap().to_str().unwrap())
        .args(["--exact", "the_one_who_plays", "--nocapture"])
        .env(ROLE, secs.to_string())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    during(&player);
    let mut said = String::new();
    player.stdout.take().unwrap().read_to_string(&mut said).unwrap();
    assert!(player.wait().unwrap().success(), "{said}");
    said
}

/// Starts the server's own player, with a tone on the other sink at the latency that the program requests.
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
        // Writing blocks while the player has enough data, and fails once it ends.
        while input.write_all(&block).is_ok() {}
    });
    player
}

/// Gaps of a recording between its first and its last non-zero sample.
struct Lost {
    secs: f64,
    /// Start and end of each gap, in seconds after the start of the recording.
    gaps: Vec<(f64, f64)>,
    /// Gaps during which no processor stalled.
    unseen: Vec<(f64, f64)>,
    /// Fraction of times at which a gap would be attributed to the machine.
    chance: f64,
}

impl Lost {
    fn of(recording: &Recording, stalls: &[Stall]) -> Self {
        let sounds = |f: &[f64; 2]| f[0] != 0.0;
        let frames = &recording.frames;
        let first = frames.iter().position(sounds).expect("the recording is not silent");
        let last = frames.iter().rposition(sounds).expect("the recording is not silent");
        let at = |frame: usize| frame as f64 / RATE_HZ;
        let gaps: Vec<_> = gaps(&frames[first..=last])
            .into_iter()
            .map(|gap| (at(first + gap.start), at(first + gap.end)))
            .collect();
        // A gap starts once the buffered audio has been played, and ends once the server has received more.
        let seen: Vec<_> = stalls
            .iter()
            .map(|stall| {
                let from = since(recording.begun, stall.from) - BEFORE_SECS;
                let to = since(recording.begun, stall.to) + AFTER_SECS;
                (from, to, stall.late.as_secs_f64())
            })
            .collect();
        let is_seen = |gap: &(f64, f64)| {
            let around = seen.iter().filter(|(from, to, _)| gap.0 <= *to && gap.1 >= *from);
            around.map(|(.., late_secs)| late_secs).sum::<f64>() >= TAKEN_SECS
        };
        let n_probes = 10_000;
        let probe = |i: usize| at(first) + (at(last) - at(first)) * i as f64 / f64::from(n_probes);
        let n_seen = (0..n_probes as usize).filter(|i| is_seen(&(probe(*i), probe(*i) + GAP_SECS))).count();
        Self {
            secs: at(last) - at(first),
            unseen: gaps.iter().copied().filter(|gap| !is_seen(gap)).collect(),
            gaps,
            chance: n_seen as f64 / f64::from(n_probes),
        }
    }
}

impl Lost {
    /// Asserts that every gap has a stall of the machine as its cause.
    fn assert_seen(&self) {
        let first = &self.unseen[..self.unseen.len().min(5)];
        assert!(
            first.is_empty(),
            "gaps without a stall of the machine, first start and end times in s: {first:.3?}; {self}"
        );
    }
}

impl Display for Lost {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let length_ms = |gap: &(f64, f64)| 1e3 * (gap.1 - gap.0);
        write!(
            f,
            "{} gaps in {:.1} s, {:.1} ms in total, the longest {:.1} ms; {} without a stall of the machine, \
             {:.0} % expected by chance",
            self.gaps.len(),
            self.secs,
            self.gaps.iter().map(length_ms).sum::<f64>() + 0.0,
            self.gaps.iter().map(length_ms).fold(0.0, f64::max),
            self.unseen.len(),
            100.0 * (1.0 - self.chance)
        )
    }
}

/// Returns the seconds from one instant to another, negative if the second is earlier.
fn since(from: Instant, to: Instant) -> f64 {
    to.duration_since(from).as_secs_f64() - from.duration_since(to).as_secs_f64()
}

/// Returns the stretches of exact silence that are longer than 0.1 ms: a texture is noise and never exactly zero for
/// that long.
fn gaps(recorded: &[[f64; 2]]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut n_silent = 0;
    for (i, frame) in recorded.iter().enumerate() {
        if frame[0] == 0.0 {
            n_silent += 1;
        } else {
            if n_silent > 5 {
                found.push(i - n_silent..i);
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
    assert_eq!(gaps(&recorded), vec![100..340]);
}

/// The player process; without its environment variable this test does nothing.
#[test]
fn the_one_who_plays() {
    let Some(secs) = std::env::var(ROLE).ok().and_then(|secs| secs.parse().ok()) else { return };
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
        friction: None,
        take_over: false,
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
    let swaps = swap_textures(&mut handle, secs);
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

/// Authors a texture every 20 ms along a circle and replaces the previous one, with an automatic stroke and a full ring
/// of touches. Returns the number of swaps.
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
        let point = SpacePoint::plane(50.0 + 20.0 * t.sin(), 50.0 + 20.0 * t.cos());
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
