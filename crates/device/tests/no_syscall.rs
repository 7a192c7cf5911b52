//! Tests that the audio callback makes no system calls: no waiting lock, no clock that needs a system call, no file, no
//! allocation that grows the heap.
//!
//! The gate is the kernel. A separate program sets up an engine and installs a filter on one of its threads that kills
//! the program at any system call. It plays blocks on that thread and reports by its exit status that it finished.
//! Programs that make system calls must not finish.
//!
//! Locks without contention make no system call, so the callback's source files are searched for forbidden words as
//! well.
#![cfg(all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")))]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

mod support;

use std::os::unix::process::ExitStatusExt as _;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;

use seccompiler::{BpfProgram, SeccompAction, SeccompFilter, apply_filter};
use shagreen_device::controls::{Drive, Input};
use shagreen_device::engine::{self, ChannelMask, EngineConfig};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::signal::Signal;
use shagreen_device::synth::contact::Contact;
use shagreen_device::synth::drive::Driven;
use shagreen_device::synth::renderer::Mix;
use shagreen_device::synth::tap::Tap;
use shagreen_device::touch::Touch;

use support::{DRIVE, FRICTION, texture};

/// Environment variable with the role of the separate program.
const ROLE: &str = "SHAGREEN_SYSCALL_ROLE";
/// Signal by which the kernel kills a program at a forbidden call.
const SIGSYS: i32 = 31;

/// Runs this program again as `role`. Returns whether it finished (true) or was killed by the gate (false).
fn ends_by_itself(role: &str) -> bool {
    let exe = std::env::current_exe().unwrap();
    let mut command = Command::new(exe);
    command.args(["--exact", "the_other_program", "--nocapture"]).env(ROLE, role);
    let output = command.output().unwrap();
    match (output.status.code(), output.status.signal()) {
        (Some(0), _) => true,
        (None, Some(SIGSYS)) => false,
        _ => panic!("{role}: {:?}\n{}", output.status, String::from_utf8_lossy(&output.stderr)),
    }
}

/// Does nothing in the test run itself; in the separate program, it does the work of the role.
#[test]
fn the_other_program() {
    let Ok(role) = std::env::var(ROLE) else { return };
    let done = Arc::new(AtomicBool::new(false));
    let ready = Arc::clone(&done);
    let work = work_of(&role);
    std::thread::spawn(move || {
        let mut work = work;
        apply_filter(&nothing_allowed()).unwrap();
        work();
        ready.store(true, Ordering::Release);
        // Ending the thread would be a system call.
        loop {
            std::hint::spin_loop();
        }
    });
    while !done.load(Ordering::Acquire) {
        std::thread::yield_now();
    }
    std::process::exit(0);
}

/// A filter that kills the program at any system call.
fn nothing_allowed() -> BpfProgram {
    let arch = std::env::consts::ARCH.try_into().unwrap();
    let end = SeccompAction::KillProcess;
    // A filter needs at least one rule; no system call has this number.
    let rules = [(1_000_000, Vec::new())].into_iter().collect();
    SeccompFilter::new(rules, end, SeccompAction::Allow, arch).unwrap().try_into().unwrap()
}

type Work = Box<dyn FnMut() + Send>;

fn work_of(role: &str) -> Work {
    match role {
        "engine" => playing(),
        "nothing" => Box::new(|| {}),
        "clock" => Box::new(|| {
            std::hint::black_box(Instant::now());
        }),
        "print" => Box::new(|| println!("in the callback")),
        "sleep" => Box::new(|| std::thread::sleep(std::time::Duration::from_millis(1))),
        "grow" => Box::new(|| {
            std::hint::black_box(vec![1_u8; 1 << 26]);
        }),
        "lock" => {
            let lock = Arc::new(Mutex::new(0));
            let held = Arc::clone(&lock);
            let (sender, receiver) = std::sync::mpsc::channel();
            std::thread::spawn(move || {
                let _held = held.lock();
                sender.send(()).unwrap();
                std::thread::sleep(std::time::Duration::from_mins(1));
            });
            receiver.recv().unwrap();
            Box::new(move || *lock.lock().unwrap() += 1)
        }
        _ => panic!("no such role: {role}"),
    }
}

/// Two seconds of all functions of an engine, with commands in its queues.
fn playing() -> Work {
    handle_time();
    let (mut handle, mut engine) = engine::new(EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz: 48_000.0,
        seed: 1,
        drive: DRIVE,
        channels: ChannelMask::only(0),
        friction: Some(FRICTION),
    })
    .unwrap();
    let ids: Vec<_> = (0..8).map(|_| handle.load(texture(3.0)).unwrap()).collect();
    handle.set_mix(Mix::solo(ids[0])).unwrap();
    handle.set_input(Input::Hand(Hand {
        path: Path::Scribble,
        speed_mps: 0.5,
        force_n: 0.5,
        extent_m: 0.06,
    }));
    handle.set_tap(Tap { frequency_hz: 200.0, decay_per_sec: 80.0, amplitude_mps2: 5.0 });
    handle.play_signal(Signal::new(vec![0.1; 4800], 48_000.0, Driven::Drive).unwrap()).unwrap();
    let mut live = handle.take_live_input().unwrap();
    let mut out = [0.0_f32; 256];
    let mut n_blocks = 0_usize;
    Box::new(move || {
        let mut highest = 0.0_f32;
        for _ in 0..750 {
            engine.process(&mut out, 2);
            highest = out.iter().fold(highest, |h, x| h.max(x.abs()));
            // Commands from the same thread; their queues make no system calls either.
            n_blocks += 1;
            match n_blocks % 50 {
                10 => handle.set_input(Input::Live),
                20 => live.send(Touch::default(), handle_time()).unwrap(),
                30 => {
                    // So slow that the tip sticks, after a fast landing.
                    let touch =
                        Touch { contact: Contact { speed_mps: 0.03, force_n: 0.5 }, ..Touch::default() };
                    live.land(touch, handle_time(), Some(0.2)).unwrap();
                }
                40 => {
                    handle.set_drive(Drive { muted: n_blocks % 100 == 40, gain: 1.5 });
                    handle.unload(ids[n_blocks / 50 % 8]);
                    handle.reset_limiter();
                }
                _ => {}
            }
        }
        assert!(highest > 0.01);
    })
}

/// A time without reading the clock, which needs a system call on some machines.
fn handle_time() -> Instant {
    static BEGUN: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    *BEGUN.get_or_init(Instant::now)
}

#[test]
fn the_engine_calls_nobody() {
    assert!(ends_by_itself("engine"));
}

#[test]
fn the_gate_lets_through_what_calls_nobody_and_ends_what_does() {
    assert!(ends_by_itself("nothing"));
    for role in ["print", "sleep", "grow", "lock"] {
        assert!(!ends_by_itself(role), "{role} was not killed");
    }
    // The device adapter reads the clock twice a block; on most machines this only reads memory.
    println!(
        "reading the clock is {}",
        if ends_by_itself("clock") { "no system call" } else { "a system call" }
    );
}

/// Source files of the callback.
const CALLBACK: &[(&str, &str)] = &[
    ("edge.rs", include_str!("../src/edge.rs")),
    ("engine.rs", include_str!("../src/engine.rs")),
    ("engine/friction_channel.rs", include_str!("../src/engine/friction_channel.rs")),
    ("engine/meter.rs", include_str!("../src/engine/meter.rs")),
    ("engine/place.rs", include_str!("../src/engine/place.rs")),
    ("engine/player.rs", include_str!("../src/engine/player.rs")),
    ("engine/render.rs", include_str!("../src/engine/render.rs")),
    ("engine/signal_player.rs", include_str!("../src/engine/signal_player.rs")),
    ("engine/slots.rs", include_str!("../src/engine/slots.rs")),
];
const FORBIDDEN: &[&str] = &[
    "Mutex",
    "RwLock",
    "Condvar",
    "Barrier",
    "mpsc",
    "println!",
    "eprintln!",
    "format!",
    "log::",
    "sleep",
    "park",
    ".lock()",
    ".join()",
    "std::fs",
    "std::io",
    "std::net",
    "std::env",
];

/// Returns the forbidden words in a file, without its tests and comments.
fn forbidden_in(source: &str) -> Vec<&'static str> {
    let code = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.collect::<Vec<_>>().join("\n");
    FORBIDDEN.iter().filter(|word| code.contains(**word)).copied().collect()
}

#[test]
fn the_callback_holds_no_lock_and_says_nothing() {
    for (file, source) in CALLBACK {
        assert_eq!(forbidden_in(source), [""; 0], "{file}");
    }
    let planted = "use std::sync::Mutex;\nfn f() { M.lock(); }\n#[cfg(test)]\nmod tests {\n println!(); }";
    assert_eq!(forbidden_in(planted), ["Mutex", ".lock()"]);
    assert_eq!(forbidden_in("// a Mutex would wait\nfn f() {}"), [""; 0]);
}
