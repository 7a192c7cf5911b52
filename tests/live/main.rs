//! The program beside real devices: sound servers, serial ports, a virtual display. Most of these tests wait for the
//! clock, so they run side by side in one test program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may panic, and prints its results"
)]

#[path = "../support/guard.rs"]
mod guard;
#[cfg(target_os = "linux")]
#[path = "../support/sound.rs"]
mod sound;
#[path = "../support/mod.rs"]
mod support;

mod calibrate;
#[cfg(target_os = "linux")]
mod calibrate_by_sound;
#[cfg(target_os = "linux")]
mod latency;
#[cfg(target_os = "linux")]
mod null_sink;
#[cfg(target_os = "linux")]
mod one_owner;
#[cfg(unix)]
mod serial;
#[cfg(target_os = "linux")]
mod sound_output;
#[cfg(target_os = "linux")]
mod window;
